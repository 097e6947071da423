//! Grids homed on the GPU: stepped there, drawn there; what is read back is read back by the host's copies.
//!
//! All grids share their state buffers and one list of tiles, so a tick costs one dispatch that lists the busy tiles, one
//! that prepares and two for each sub-step (tiles without and with cells of the layer), however many grids there are; where
//! a medium is felt, one more that stores it and two more for each sub-step. Grids of the dispersive scheme add one that
//! prepares, one for each sub-step, and one where their medium is stored. All but the first are indirect: the last
//! sub-step marks the tiles that hold waves, and the next tick steps these and their neighbours, as the CPU's grids do.
//! How many they were comes back some ticks later; a grid sleeps once there was none and nothing has disturbed it since.

mod activity;
mod buffers;
mod encode;
mod grid;
mod heights;
mod holes;
mod land;
mod pack;
mod pass;
mod query;
mod water;
mod water_pass;

use std::collections::VecDeque;
use std::sync::Arc;

use glam::DVec2;
use open_water_shaders::grid as shader;

use crate::cpu::foam::FoamLaw;
use crate::medium::{Medium, SharedMedium};
use crate::source::footprint::{Footprint, Shape, Site};
use crate::window::{Move, Place};
use crate::{Border, GridDesc, GridError, Scheme, Source, Window};

use activity::Activity;
use buffers::Buffers;
use grid::Grid;
use pack::Packer;
use pass::Passes;
use query::Queries;
use water::{Bases, Water};

pub use heights::Stored;
pub use open_water_shaders::pipeline::{Frame, Staging};
pub use query::{Answer, MAX_QUERY_POINTS};

/// Most grids.
pub const MAX_GRIDS: usize = open_water_shaders::surface::MAX_GRIDS;
/// Most bytes that all grids' heights may take: what WebGPU promises for one binding.
const MAX_STATE_BYTES: u64 = 128 << 20;
/// Most ticks queued between two calls of [`GpuGrids::encode`].
pub const MAX_TICKS: usize = 64;

/// Names a grid of a [`GpuGrids`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct GpuGridId(usize);

/// Grids of interactive waves on the GPU.
#[derive(Debug)]
pub struct GpuGrids {
    grids: Vec<Grid>,
    medium: Option<SharedMedium>,
    origin: DVec2,
    passes: Passes,
    buffers: Buffers,
    packer: Packer,
    ticks: VecDeque<pack::Tick>,
    /// What frames took with them whose encoders may yet be dropped, the oldest first.
    sent: VecDeque<(u64, VecDeque<pack::Tick>)>,
    /// Scratch of sources.
    weights: [Vec<f32>; 2],
    /// What is drawn.
    drawn: Vec<shader::GridDraw>,
    drawing: Option<encode::Drawing>,
    activity: Activity,
    queries: Queries,
    /// Ticks queued and ticks encoded so far, those included that had nothing to do.
    queued_ticks: u64,
    encoded_ticks: u64,
}

impl GpuGrids {
    /// No grids yet. The first one has the pipelines compiled ([`Self::prepare`]), unless [`Self::compiler`] did.
    pub fn new(device: &wgpu::Device) -> Self {
        let passes = Passes::new(device);
        let buffers = Buffers::new(device);
        Self {
            grids: Vec::new(),
            medium: None,
            origin: DVec2::ZERO,
            passes,
            buffers,
            packer: Packer::default(),
            ticks: VecDeque::new(),
            sent: VecDeque::new(),
            weights: Default::default(),
            drawn: Vec::new(),
            drawing: None,
            activity: Activity::new(device),
            queries: Queries::new(device),
            queued_ticks: 0,
            encoded_ticks: 0,
        }
    }

    /// Adds a calm grid around the world's origin.
    ///
    /// # Errors
    /// As [`crate::WaveGrid::new`], when its scheme is [`Scheme::Spectral`], when its border does not absorb by a matched layer,
    /// when there are [`MAX_GRIDS`] already, and when all grids together would have too many cells: 8,388,608, of the
    /// dispersive scheme at most 3,050,402.
    pub fn insert(&mut self, desc: GridDesc) -> Result<GpuGridId, GridError> {
        let stepping = desc.stepping()?;
        if desc.scheme == Scheme::Spectral {
            let bound = "a scheme of local stencils: the spectral one is for grids on the CPU";
            return Err(GridError::InvalidValue { field: "scheme (3, spectral)", value: 3.0, bound });
        }
        if !matches!(desc.border, Border::Absorbing { .. }) {
            let bound = "absorbing: grids on the GPU have no other";
            return Err(GridError::InvalidValue { field: "border: width", value: desc.border.width().into(), bound });
        }
        let count = self.grids.iter().filter(|grid| !grid.removed).count();
        if count >= MAX_GRIDS {
            let value = count as f64 + 1.0;
            return Err(GridError::InvalidValue { field: "grids", value, bound: "at most 32 grids" });
        }
        let torus = desc.cells.map(|n| (n as usize).next_multiple_of(crate::TILE));
        let alike = |grid: &Grid| {
            let dispersive = [grid.desc.scheme, desc.scheme].map(|scheme| scheme == Scheme::Dispersive);
            // What a layer remembers takes more room the wider it is.
            dispersive[0] == dispersive[1]
                && (!dispersive[0] || (grid.desc.border, grid.desc.cells) == (desc.border, desc.cells))
        };
        let free = self.grids.iter().position(|grid| grid.removed && grid.torus == torus && alike(grid));
        let bases = match free.and_then(|at| self.grids[at].water.as_ref()) {
            Some(water) => water.bases,
            None => self.water_end(),
        };
        let water = Water::new(&desc, &stepping, torus, bases);
        let base = free.map_or(self.state_vectors(), |at| self.grids[at].base);
        let bytes = 16 * (u64::from(base) + (torus[0] * torus[1]) as u64);
        let most = water.as_ref().map_or(0, |water| water.end().fields.max(water.end().faces));
        if 16 * u64::from(most) > MAX_STATE_BYTES {
            let bound = "such that all dispersive grids together hold at most 3,050,402 cells";
            return Err(GridError::InvalidValue { field: "cells", value: (torus[0] * torus[1]) as f64, bound });
        }
        if bytes > MAX_STATE_BYTES {
            let bound = "such that all grids together hold at most 8,388,608 cells";
            return Err(GridError::InvalidValue { field: "cells", value: (torus[0] * torus[1]) as f64, bound });
        }
        let mut grid = Grid {
            land: None,
            water,
            holes: Vec::new(),
            place: Place::new(&desc),
            law: FoamLaw::new(&desc, &stepping),
            moving: false,
            torus,
            base,
            parity: 0,
            flip: free.map_or(0, |at| self.grids[at].flip),
            // What comes back of the earlier one is older than these.
            ticks: free.map_or(0, |at| self.grids[at].ticks),
            disturbed: free.map_or(0, |at| self.grids[at].ticks),
            active: None,
            shift: [0; 2],
            // What an earlier grid left there.
            clear: free.is_some(),
            sources: Vec::new(),
            awake: 0,
            dropped: 0,
            removed: false,
            stepping,
            desc,
        };
        grid.set_medium(self.medium.clone());
        if let Some(at) = free {
            self.grids[at] = grid;
            return Ok(GpuGridId(at));
        }
        self.grids.push(grid);
        Ok(GpuGridId(self.grids.len() - 1))
    }

    /// As [`crate::WaveGrid::set_medium`], for all grids, felt from the next tick on.
    pub fn set_medium(&mut self, medium: Option<Arc<dyn Medium>>) {
        self.medium = medium.map(SharedMedium);
        for grid in &mut self.grids {
            grid.set_medium(self.medium.clone());
        }
    }

    /// Removes a grid; its memory is for the next one of its size.
    pub fn remove(&mut self, id: GpuGridId) {
        let grid = &mut self.grids[id.0];
        grid.removed = true;
        grid.awake = 0;
        grid.sources.clear();
    }

    /// `vec4`s of the heights of all grids.
    fn state_vectors(&self) -> u32 {
        self.grids.last().map_or(0, |g| g.base + shader::ARRAYS * g.stride())
    }

    /// One past what dispersive grids have in the buffers of fields and faces.
    fn water_end(&self) -> Bases {
        let ends = self.grids.iter().filter_map(|grid| Some(grid.water.as_ref()?.end()));
        ends.fold(Bases::default(), |most, end| Bases {
            fields: most.fields.max(end.fields),
            faces: most.faces.max(end.faces),
        })
    }

    /// As [`crate::WaveGrid::center_on`], felt from the next tick on.
    pub fn center_on(&mut self, id: GpuGridId, target: DVec2) {
        let grid = &mut self.grids[id.0];
        match grid.place.follow(target) {
            Move::Stay => {}
            Move::Shift(shift) => {
                if grid.awake > 0 {
                    grid.moving = true;
                }
                for (sum, by) in grid.shift.iter_mut().zip(shift) {
                    *sum += by;
                }
                if let Some(land) = &mut grid.land {
                    land.shift(shift);
                }
            }
            Move::Clear => {
                grid.clear = true;
                grid.moving = false;
                if let Some(water) = &mut grid.water {
                    water.clear();
                }
                grid.sources.clear();
                let medium = grid.land.take().map(|land| land.ground.medium);
                grid.set_medium(medium);
            }
        }
    }

    /// As [`crate::WaveGrid::set_origin`], for all grids.
    pub fn set_origin(&mut self, origin: DVec2) {
        if origin.is_finite() {
            self.origin = origin;
        }
    }

    /// As [`crate::WaveGrid::add`]. [`Source::Box`] is not known here, nor is [`Source::Pressure`] on grids of the wave
    /// equation: dropped and counted.
    pub fn add(&mut self, id: GpuGridId, source: Source) -> bool {
        let origin = self.origin;
        let [first, second] = &mut self.weights;
        let grid = &mut self.grids[id.0];
        let rim = grid.desc.border.width() as usize + 2;
        let site = Site { window: &grid.place.window, origin, rim, cells: grid.cells() };
        let parts = site.place(source, [first, second]);
        let presses = grid.water.is_some();
        let known = |part: &Footprint| matches!(part.shape, Shape::Disc { .. }) && (presses || part.head == 0.0);
        let Some(parts) = parts.filter(|parts| parts.iter().flatten().all(known)) else {
            grid.dropped += 1;
            return false;
        };
        let corner = grid.place.window.corner;
        grid.sources.extend(parts.into_iter().flatten().map(|part| (part, corner)));
        grid.awake = grid.rest_ticks();
        grid.disturbed = grid.ticks;
        true
    }

    /// Queues one tick of every awake grid. Returns whether it was queued: not when [`MAX_TICKS`] wait already.
    pub fn tick(&mut self) -> bool {
        if self.ticks.len() >= MAX_TICKS {
            return false;
        }
        self.queued_ticks += 1;
        for grid in &mut self.grids {
            if let Some(water) = &mut grid.water {
                water.note(&grid.place, &grid.stepping);
            }
        }
        let tick = self.packer.pack(&mut self.grids);
        if !tick.substeps.is_empty() {
            self.ticks.push_back(tick);
        }
        true
    }

    /// Dispatches that the next [`Self::encode`] will encode; zero when all grids sleep.
    pub fn pending_dispatches(&self) -> usize {
        self.ticks.iter().map(|tick| tick.dispatches().count()).sum()
    }

    /// Where a grid's window stands.
    pub fn window(&self, id: GpuGridId) -> Window {
        self.grids[id.0].place.window
    }

    /// The description a grid was made from.
    pub fn desc(&self, id: GpuGridId) -> &GridDesc {
        &self.grids[id.0].desc
    }

    /// Whether a grid is calm and costs nothing.
    pub fn is_asleep(&self, id: GpuGridId) -> bool {
        self.grids[id.0].awake == 0
    }

    /// Tiles that a grid stepped in the last tick of which the GPU has told; `None` before the first.
    pub fn active_tiles(&self, id: GpuGridId) -> Option<u32> {
        self.grids[id.0].active
    }

    /// Bytes that a grid's state has in the device's memory, what it knows of its medium included.
    pub fn bytes(&self, id: GpuGridId) -> u64 {
        let grid = &self.grids[id.0];
        let felt = grid.cells().is_some();
        let ground = if felt { shader::MEDIUM_ARRAYS } else { 0 };
        // Heights and memory.
        let vectors = (2 * shader::ARRAYS + ground) * grid.stride();
        16 * u64::from(vectors) + grid.water.as_ref().map_or(0, |water| water.bytes(felt))
    }

    /// Sources of a grid dropped so far.
    pub fn dropped_sources(&self, id: GpuGridId) -> u64 {
        self.grids[id.0].dropped
    }
}

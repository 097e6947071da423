//! Grids homed on the GPU: stepped there, drawn there, never read back here.
//!
//! All grids share their state buffers and one list of tiles, so a tick costs one dispatch that lists the busy tiles, one
//! that prepares and two for each sub-step (tiles without and with cells of the layer), however many grids there are; where
//! a medium is felt, one more that stores it and two more for each sub-step. All but the first are indirect: the last
//! sub-step marks the tiles that hold waves, and the next tick steps these and their neighbours, as the CPU's grids do.
//! How many they were comes back some ticks later; a grid sleeps once there was none and nothing has disturbed it since.

mod activity;
mod buffers;
mod grid;
mod land;
mod pack;
mod pass;
mod query;

use std::collections::VecDeque;
use std::sync::Arc;

use glam::DVec2;
use open_water_shaders::grid::{self as shader, DRAW_THREADS, TickParams};

use crate::cpu::foam::FoamLaw;
use crate::medium::{Medium, SharedMedium};
use crate::source::footprint::{Footprint, Shape, Site};
use crate::window::{Move, Place};
use crate::{GridDesc, GridError, Source, Window};

use activity::Activity;
use buffers::Buffers;
use grid::Grid;
use pack::{Kind, Packer};
use pass::Passes;
use query::Queries;

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
    /// Scratch of sources.
    weights: [Vec<f32>; 2],
    activity: Activity,
    queries: Queries,
    /// Ticks queued and ticks encoded so far, those included that had nothing to do.
    queued_ticks: u64,
    encoded_ticks: u64,
}

impl GpuGrids {
    /// No grids yet. Compiles the pipelines.
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
            weights: Default::default(),
            activity: Activity::new(device),
            queries: Queries::new(device),
            queued_ticks: 0,
            encoded_ticks: 0,
        }
    }

    /// Adds a calm grid around the world's origin.
    ///
    /// # Errors
    /// As [`crate::WaveGrid::new`], and when there are [`MAX_GRIDS`] already.
    pub fn insert(&mut self, desc: GridDesc) -> Result<GpuGridId, GridError> {
        let stepping = desc.stepping()?;
        let count = self.grids.iter().filter(|grid| !grid.removed).count();
        if count >= MAX_GRIDS {
            let value = count as f64 + 1.0;
            return Err(GridError::InvalidValue { field: "grids", value, bound: "at most 32 grids" });
        }
        let torus = desc.cells.map(|n| (n as usize).next_multiple_of(crate::TILE));
        let free = self.grids.iter().position(|grid| grid.removed && grid.torus == torus);
        let base = free.map_or(self.state_vectors(), |at| self.grids[at].base);
        let bytes = 16 * (u64::from(base) + (torus[0] * torus[1]) as u64);
        if bytes > MAX_STATE_BYTES {
            let bound = "such that all grids together hold at most 8,388,608 cells";
            return Err(GridError::InvalidValue { field: "cells", value: (torus[0] * torus[1]) as f64, bound });
        }
        let mut grid = Grid {
            land: None,
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

    /// As [`crate::WaveGrid::add`]. [`Source::Box`] and [`Source::Pressure`] are not known here: dropped and counted.
    pub fn add(&mut self, id: GpuGridId, source: Source) -> bool {
        let origin = self.origin;
        let [first, second] = &mut self.weights;
        let grid = &mut self.grids[id.0];
        let rim = grid.desc.pml_width as usize + 2;
        let site = Site { window: &grid.place.window, origin, rim, cells: grid.cells() };
        let parts = site.place(source, [first, second]);
        let known = |part: &Footprint| matches!(part.shape, Shape::Disc { .. }) && part.head == 0.0;
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

    fn reserve(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        let felt = self.grids.iter().any(|grid| grid.cells().is_some());
        self.buffers.reserve_state(device, encoder, u64::from(self.state_vectors()), felt);
    }

    /// Encodes the queued ticks, and takes what has come back of earlier ones. Submit the encoder before encoding again.
    pub fn encode(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder) {
        self.activity.poll(device, &mut self.grids);
        self.encoded_ticks = self.queued_ticks;
        let Some(last) = self.ticks.back() else { return };
        self.activity.expect(&last.grids);
        let counts = (self.ticks.len() - 1) as u64 * u64::from(4 * shader::COUNT_WORDS);
        self.reserve(device, encoder);
        let groups = self.buffers.upload(device, queue, &self.passes, &mut self.packer, &self.ticks);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("grids"), ..Default::default() });
        let mut dispatch = 0;
        for (index, tick) in (0..).zip(self.ticks.drain(..)) {
            let params = index * size_of::<TickParams>() as u32;
            for work in tick.dispatches() {
                pass.set_pipeline(self.passes.of(work.kind));
                pass.set_bind_group(0, &groups.state, &[dispatch * pass::DISPATCH_STRIDE, params]);
                let lists = if matches!(work.kind, Kind::Schedule) { &groups.schedule } else { &groups.lists };
                pass.set_bind_group(1, lists, &[]);
                match work.groups {
                    pack::Groups::Counted(count) => pass.dispatch_workgroups(count, 1, 1),
                    pack::Groups::Listed(list) => {
                        let word = u64::from(index * shader::COUNT_WORDS + 4 * list);
                        pass.dispatch_workgroups_indirect(&groups.counts, 4 * word);
                    }
                }
                dispatch += 1;
            }
        }
        drop(pass);
        self.activity.encode(encoder, &groups.counts, counts);
    }

    /// Encodes the drawing of grids as of the last encoded tick: (height, foam) of cell (i, j) goes to element
    /// `base + j * nx + i` of `pool`, a storage buffer of `vec2<f32>`. `alpha` as in [`crate::WaveGrid::draw`]. Asleep
    /// grids are drawn as zeros.
    pub fn encode_draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        pool: &wgpu::Buffer,
        draws: &[(GpuGridId, u32)],
        alpha: f32,
    ) {
        if draws.is_empty() {
            return;
        }
        let alpha = if alpha.is_nan() { 1.0 } else { alpha.clamp(0.0, 1.0) };
        self.reserve(device, encoder);
        let draws: Vec<_> = draws.iter().take(MAX_GRIDS).map(|(id, out)| self.grids[id.0].drawn(alpha, *out)).collect();
        let [x, y] = [0, 1].map(|k| draws.iter().map(|d| d.cells[k]).max().unwrap_or(0));
        let draw_group = self.buffers.upload_draws(device, queue, &self.passes, pool, &draws);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("grid draw"), ..Default::default() });
        let felt = draws.iter().any(|draw| draw.medium != shader::NO_MEDIUM);
        pass.set_pipeline(&self.passes.draw[usize::from(felt)]);
        pass.set_bind_group(0, draw_group, &[]);
        pass.dispatch_workgroups(x.div_ceil(DRAW_THREADS), y, draws.len() as u32);
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

    /// Sources of a grid dropped so far.
    pub fn dropped_sources(&self, id: GpuGridId) -> u64 {
        self.grids[id.0].dropped
    }
}

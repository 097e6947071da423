//! What the CPU knows of a grid on the GPU.

use std::sync::Arc;

use open_water_shaders::grid as shader;

use super::land::Land;
use super::water::Water;
use crate::border::Profile;
use crate::cpu::foam::FoamLaw;
use crate::dispersive::Table;
use crate::ground::Cells;
use crate::hole::Hole;
use crate::medium::{CellLaw, SharedMedium};
use crate::source::footprint::Footprint;
use crate::window::Place;
use crate::{GridDesc, Scheme, Stepping};

/// What the CPU knows of a grid on the GPU.
#[derive(Debug)]
pub(super) struct Grid {
    pub(super) desc: GridDesc,
    pub(super) stepping: Stepping,
    pub(super) place: Place,
    pub(super) law: FoamLaw,
    pub(super) moving: bool,
    /// Cells of the torus.
    pub(super) torus: [usize; 2],
    /// First `vec4` of its arrays.
    pub(super) base: u32,
    pub(super) parity: u32,
    /// Which set of its tiles' marks the next tick writes.
    pub(super) flip: u32,
    /// Ticks queued so far.
    pub(super) ticks: u64,
    /// First tick that felt the last source.
    pub(super) disturbed: u64,
    /// Tiles stepped in the last tick that the GPU has told of.
    pub(super) active: Option<u32>,
    pub(super) shift: [i64; 2],
    pub(super) clear: bool,
    /// Sources for the next tick, and the corner of the window they were placed in.
    pub(super) sources: Vec<(Footprint, [i64; 2])>,
    /// Ticks until it is stilled if nothing comes back; 0 asleep.
    pub(super) awake: u32,
    pub(super) dropped: u64,
    /// Its place is free for a grid of the same size.
    pub(super) removed: bool,
    /// What it lies in.
    pub(super) land: Option<Land>,
    /// What it has if its scheme is the dispersive one.
    pub(super) water: Option<Water>,
    /// Where finer grids are seen instead.
    pub(super) holes: Vec<Hole>,
}

impl Grid {
    /// `vec4`s of one array.
    pub(super) fn stride(&self) -> u32 {
        (self.torus[0] * self.torus[1] / 4) as u32
    }

    /// Ticks after which what a source did has left: waves need some crossings, foam seven time constants.
    pub(super) fn rest_ticks(&self) -> u32 {
        let [x, z] = std::array::from_fn(|k| self.desc.cells[k] as f32 * self.desc.cell_size[k]);
        let speed = match self.water {
            // The shortest waves that the scheme carries.
            Some(_) => 0.49 * (9.81 * self.desc.cell_size[0]).sqrt(),
            None => self.desc.wave_speed,
        };
        let crossing = (x * x + z * z).sqrt() / speed;
        // Between walls they stay longer.
        let crossings = if self.cells().is_some() { 32.0 } else { 8.0 };
        let seconds = (crossings * crossing).max(7.0 * crate::cpu::foam::DECAY);
        (seconds / self.desc.tick).min(u32::MAX as f32 / 2.0) as u32 + 1
    }

    pub(super) fn profile(&self) -> Profile {
        Profile::new(self.desc.border, self.stepping.a, self.moving)
    }

    /// Where window cell (0, 0) is stored.
    pub(super) fn torus_corner(&self) -> [u32; 2] {
        std::array::from_fn(|k| self.place.window.corner[k].rem_euclid(self.torus[k] as i64) as u32)
    }

    pub(super) fn drawn(&self, alpha: f32, out: u32) -> shader::GridDraw {
        let [x, z] = [self.place.fade_reach(0), self.place.fade_reach(1)];
        let array = |k: u32| 4 * (self.base + k * self.stride());
        let mut holes = [shader::GridHole::default(); shader::MAX_HOLES];
        for (hole, given) in holes.iter_mut().zip(&self.holes) {
            let ([low, high, rise], gain) = given.in_cells(&self.place.window);
            *hole = shader::GridHole { low, high, rise, gain, pad: 0.0 };
        }
        shader::GridDraw {
            corner: self.torus_corner(),
            cells: self.desc.cells,
            torus: self.torus.map(|n| n as u32),
            middle: [x[0] as f32, z[0] as f32],
            // What waits to be cleared is not shown.
            outer: if self.clear { [-1.0; 2] } else { [x[1] as f32, z[1] as f32] },
            width: self.place.fade_width() as f32,
            alpha,
            now: array(self.parity),
            previous: array(2),
            foam: array(3),
            out,
            medium: self.cells().map_or(shader::NO_MEDIUM, |_| 2 * self.base),
            hole_count: self.holes.len() as u32,
            pad: [0; 2],
            holes,
        }
    }

    /// The medium's cells, where it is felt at all.
    pub(super) fn cells(&self) -> Option<&Cells> {
        self.land.as_ref()?.ground.cells.as_ref()
    }

    /// Sets what it lies in.
    pub(super) fn set_medium(&mut self, medium: Option<SharedMedium>) {
        let table = (self.desc.scheme == Scheme::Dispersive).then(|| Arc::new(Table::new(self.stepping.a[0])));
        let law = CellLaw::new(&self.desc, &self.stepping, table);
        let window = &self.place.window;
        self.land = medium.map(|medium| Land::new(medium, law, window));
    }
}

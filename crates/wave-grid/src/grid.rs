//! A grid of interactive waves homed on the CPU.

use glam::{DVec2, Vec2};

use crate::border::{Axis, Profile};
use crate::cpu::foam::FoamLaw;
use crate::cpu::kernels::Coefficients;
use crate::cpu::tiles::{Mode, Tiles};
use crate::source::{Footprint, HEIGHT_LIMIT};
use crate::window::{Move, Place};
use crate::{GridDesc, GridError, Source, Stepping, Window, cpu, state::State};

/// The waves of a grid at a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GridSample {
    /// Height above the ambient water, metres, fade included.
    pub height: f32,
    /// dh/dx and dh/dz.
    pub slope: Vec2,
    /// Rate of the height over the last sub-step, m/s.
    pub vertical_velocity: f32,
}

/// Waves on a window of cells that follows a target, absorbed at its border.
///
/// `z_tt + sigma z_t = div(c^2 grad z)`, explicit in time. Cloning it is a snapshot.
#[derive(Debug, Clone)]
pub struct WaveGrid {
    pub(crate) desc: GridDesc,
    pub(crate) stepping: Stepping,
    pub(crate) place: Place,
    pub(crate) origin: DVec2,
    pub(crate) state: State,
    pub(crate) tiles: Tiles,
    coefficients: Coefficients,
    law: FoamLaw,
    profile: Profile,
    axes: [Axis; 2],
    fade: [Vec<f32>; 2],
    /// `previous` already holds the end of the last tick.
    captured: bool,
    skipping: bool,
    dropped: u64,
}

impl WaveGrid {
    /// A calm grid around the world's origin.
    ///
    /// # Errors
    /// A field out of range, or a scheme that would be unstable: see [`GridDesc::stepping`].
    pub fn new(desc: GridDesc) -> Result<Self, GridError> {
        let stepping = desc.stepping()?;
        let [nx, nz] = desc.cells.map(|n| n as usize);
        let (straight, beside) = desc.scheme.weights();
        let place = Place::new(&desc);
        let profile = Profile::new(desc.pml_width, stepping.a, false);
        let mut grid = Self {
            stepping,
            origin: DVec2::ZERO,
            state: State::new(nx, nz),
            tiles: Tiles::new([nx, nz], place.window.tile_offset()),
            coefficients: Coefficients {
                straight: (stepping.a * straight) as f32,
                beside: (stepping.a * beside) as f32,
                damping: (0.5 * f64::from(desc.damping) * stepping.dt) as f32,
            },
            law: FoamLaw::new(desc.wave_speed, desc.cell_size, desc.tick),
            profile,
            axes: [Axis::new(&profile, nx), Axis::new(&profile, nz)],
            fade: [vec![0.0; nx], vec![0.0; nz]],
            captured: true,
            skipping: true,
            dropped: 0,
            place,
            desc,
        };
        grid.update_fade();
        Ok(grid)
    }

    fn update_fade(&mut self) {
        for (axis, fade) in self.fade.iter_mut().enumerate() {
            self.place.fade(axis, fade);
        }
    }

    fn set_moving(&mut self, moving: bool) {
        let profile = Profile::new(self.desc.pml_width, self.stepping.a, moving);
        if profile != self.profile {
            self.profile = profile;
            self.axes = [Axis::new(&profile, self.state.nx), Axis::new(&profile, self.state.nz)];
        }
    }

    /// Moves the window by whole cells so that its middle stays within one cell of a world point, and the fade by the
    /// fraction. The water stands still in the world; what enters is calm. A jump past all that the window holds clears it. A target
    /// that is not finite, or farther than 10^14 cells, is ignored.
    pub fn center_on(&mut self, target: DVec2) {
        match self.place.follow(target) {
            Move::Stay => {}
            Move::Shift(shift) => {
                self.tiles.shift(shift);
                if !self.at_rest() {
                    self.set_moving(true);
                    cpu::shift::shift(&mut self.state, shift, self.profile.thickness);
                }
            }
            Move::Clear => {
                self.clear();
                self.tiles.clear(self.place.window.tile_offset());
            }
        }
        self.update_fade();
    }

    /// Whether every array is zero.
    fn at_rest(&self) -> bool {
        self.captured && self.tiles.active == 0 && self.tiles.asleep()
    }

    /// Stills the water.
    pub fn clear(&mut self) {
        self.state.clear();
        self.tiles.clear(self.place.window.tile_offset());
        self.captured = true;
        self.set_moving(false);
    }

    /// World position of the local coordinates' origin, for sources and samples. Default zero.
    pub fn set_origin(&mut self, origin: DVec2) {
        if origin.is_finite() {
            self.origin = origin;
        }
    }

    /// Adds a disturbance to be felt from the next tick on. Returns whether it was: a source that is not finite, has a
    /// negative radius, or reaches into the border layer or out of the window is dropped and counted. Heights are
    /// kept within [`HEIGHT_LIMIT`]; below it the volume is written exactly to rounding.
    pub fn add(&mut self, source: Source) -> bool {
        let rim = self.profile.thickness + 1;
        let Some(footprint) = Footprint::new(source, &self.place.window, self.origin, rim) else {
            self.dropped += 1;
            return false;
        };
        self.capture();
        self.tiles.touch(footprint.range, footprint.height, footprint.foam);
        let [range_x, range_z] = footprint.range;
        for j in range_z[0]..range_z[1] {
            for i in range_x[0]..range_x[1] {
                let weight = footprint.weight(i, j);
                let at = j * self.state.nx + i;
                let rise = weight * footprint.height;
                for z in [&mut self.state.z[at], &mut self.state.old[at]] {
                    *z = (*z + rise).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
                }
                let foam = &mut self.state.foam[at];
                *foam = (*foam + weight * footprint.foam).min(1.0);
            }
        }
        true
    }

    fn capture(&mut self) {
        if !self.captured {
            self.state.previous.copy_from_slice(&self.state.z);
            self.captured = true;
        }
    }

    /// Advances by one tick. A grid at rest returns at once.
    pub fn tick(&mut self) {
        self.capture();
        if self.skipping {
            self.tiles.schedule();
        } else {
            self.tiles.activate_all();
        }
        for tz in 0..self.tiles.count[1] {
            for tx in 0..self.tiles.count[0] {
                if self.tiles.row(tz)[tx].mode == Mode::Ending {
                    self.state.clear_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
                    self.captured = false;
                }
            }
        }
        if self.tiles.active == 0 {
            return;
        }
        for _ in 0..self.stepping.substeps {
            let thickness = self.profile.thickness;
            cpu::step::step(&mut self.state, &self.tiles, &self.axes, thickness, self.coefficients);
        }
        cpu::foam::settle(&mut self.state, &mut self.tiles, self.law);
        self.captured = false;
    }

    /// Whether quiet tiles are left out (default). Without, every cell is stepped in every tick: for measurements.
    pub fn set_tile_skipping(&mut self, on: bool) {
        self.skipping = on;
    }

    /// Answers `out[i]` at `points[i]` (local x, z) from the end of the last tick; the shorter slice decides how many.
    pub fn sample(&self, points: &[Vec2], out: &mut [GridSample]) {
        if self.at_rest() {
            out.fill(GridSample::default());
            return;
        }
        let dt = self.stepping.dt as f32;
        for (point, out) in points.iter().zip(out) {
            *out = cpu::sample::sample(&self.state, &self.place.window, &self.fade, dt, self.origin, *point);
        }
    }

    /// Writes (height in metres, foam 0 to 1) of every cell of the current window, both faded, `alpha` (0 to 1) of the
    /// way from the tick before to the last one. Cells that `out` is too short for are left out.
    pub fn draw(&self, alpha: f32, out: &mut [[f32; 2]]) {
        let alpha = if alpha.is_nan() { 1.0 } else { alpha.clamp(0.0, 1.0) };
        cpu::draw::draw(&self.state, &self.fade, alpha, out);
    }

    /// Where the window stands: world corner in cells, extent, cell size.
    pub fn window(&self) -> Window {
        self.place.window
    }

    /// The description it was made from.
    pub fn desc(&self) -> &GridDesc {
        &self.desc
    }

    /// Sub-steps, their length and the Courant number.
    pub fn stepping(&self) -> Stepping {
        self.stepping
    }

    /// Heights of all cells without fade, metres, row-major, x fastest.
    pub fn heights(&self) -> &[f32] {
        &self.state.z
    }

    /// Sets the heights now and one sub-step ago (cells as [`Self::heights`]), still foam, no memory in the border.
    /// Values that are not finite count as zero, others are kept within [`HEIGHT_LIMIT`]; the outermost ring is zero.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when a slice has not one value per cell.
    pub fn impose(&mut self, now: &[f32], before: &[f32]) -> Result<(), GridError> {
        for (field, given) in [("now", now), ("before", before)] {
            if given.len() != self.state.z.len() {
                let bound = "one value per cell";
                return Err(GridError::InvalidValue { field, value: given.len() as f64, bound });
            }
        }
        self.state.clear();
        let (nx, nz) = (self.state.nx, self.state.nz);
        for (array, given) in [(&mut self.state.z, now), (&mut self.state.old, before)] {
            for j in 1..nz - 1 {
                let row = j * nx + 1..(j + 1) * nx - 1;
                for (z, v) in array[row.clone()].iter_mut().zip(&given[row]) {
                    *z = if v.is_finite() { v.clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT) } else { 0.0 };
                }
            }
        }
        self.captured = false;
        self.capture();
        self.tiles.activate_all();
        cpu::foam::measure(&self.state, &mut self.tiles);
        Ok(())
    }

    /// Sources dropped so far, see [`Self::add`].
    pub fn dropped_sources(&self) -> u64 {
        self.dropped
    }

    /// Whether nothing moves: ticks cost nothing and there is nothing to draw.
    pub fn is_asleep(&self) -> bool {
        self.tiles.asleep()
    }

    /// Tiles stepped in the last tick.
    pub fn active_tiles(&self) -> usize {
        self.tiles.active
    }
}

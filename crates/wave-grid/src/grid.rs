//! A grid of interactive waves homed on the CPU.

use std::sync::Arc;

use fearless_simd::Level;
use glam::{DVec2, Vec2};

use crate::border::{Axis, Border, Profile};
use crate::cpu::current::Carrier;
use crate::cpu::draw::Drawing;
use crate::cpu::foam::FoamLaw;
use crate::cpu::kernels::Coefficients;
use crate::cpu::moving::MovingLayer;
use crate::cpu::tiles::Tiles;
use crate::dispersive::Fields;
use crate::drift::Drift;
use crate::feed::Feed;
use crate::ground::Ground;
use crate::hole::Holes;
use crate::spectral::Spectral;
use crate::window::{Move, Place};
use crate::{GridDesc, GridError, Scheme, Stepping, cpu, state::State};

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
/// `z_tt + sigma z_t = div(c^2 grad z)`, explicit in time, or water waves: see [`Scheme`]; c, sigma and depth as its
/// [`crate::Medium`] has them. See [`WaveGrid::snapshot`] for going back.
#[derive(Debug, Clone)]
pub struct WaveGrid {
    pub(crate) desc: GridDesc,
    pub(crate) stepping: Stepping,
    pub(crate) place: Place,
    pub(crate) origin: DVec2,
    pub(crate) state: State,
    /// What the dispersive scheme keeps besides.
    pub(crate) fields: Option<Box<Fields>>,
    /// What the spectral scheme keeps besides.
    pub(crate) spectral: Option<Box<Spectral>>,
    pub(crate) tiles: Tiles,
    pub(crate) ground: Option<Arc<Ground>>,
    pub(crate) feed: Option<Feed>,
    pub(crate) coefficients: Coefficients,
    /// The machine's vector units.
    pub(crate) level: Level,
    /// Largest |z| of each tile after a sub-step.
    pub(crate) tops: Vec<f32>,
    pub(crate) law: FoamLaw,
    pub(crate) profile: Profile,
    pub(crate) drift: Drift,
    pub(crate) layer: Option<MovingLayer>,
    pub(crate) matched: bool,
    pub(crate) axes: [Axis; 2],
    fade: [Vec<f32>; 2],
    pub(crate) holes: Holes,
    /// What is drawn as the tick before is what stands now: since the last tick a source was added or nothing moves.
    pub(crate) captured: bool,
    pub(crate) skipping: bool,
    /// The layer is that of a window that moves.
    pub(crate) moving: bool,
    pub(crate) dropped: u64,
    /// Where there is a current.
    pub(crate) carrier: Option<Carrier>,
    /// Scratch of sources.
    pub(crate) weights: [Vec<f32>; 2],
}

impl WaveGrid {
    /// A calm grid around the world's origin.
    ///
    /// # Errors
    /// A field out of range, or a scheme that would be unstable: see [`GridDesc::stepping`].
    pub fn new(desc: GridDesc) -> Result<Self, GridError> {
        let stepping = desc.stepping()?;
        let [nx, nz] = desc.cells.map(|n| n as usize);
        let place = Place::new(&desc);
        let profile = Profile::new(desc.border, stepping.a, false);
        let mut grid = Self {
            stepping,
            origin: DVec2::ZERO,
            state: State::new(nx, nz, desc.scheme),
            fields: (desc.scheme == Scheme::Dispersive).then(|| Box::new(Fields::new(&desc, &stepping))),
            spectral: (desc.scheme == Scheme::Spectral).then(|| Box::new(Spectral::new(&desc, &stepping))),
            tiles: Tiles::new([nx, nz], place.window.tile_offset()),
            ground: None,
            feed: None,
            coefficients: Coefficients::new(&desc, &stepping),
            level: Level::new(),
            tops: Vec::new(),
            law: FoamLaw::new(&desc, &stepping),
            profile,
            drift: Drift::default(),
            layer: None,
            matched: true,
            axes: [Axis::new(&profile, 0, nx), Axis::new(&profile, 1, nz)],
            fade: [vec![0.0; nx], vec![0.0; nz]],
            holes: Holes::default(),
            captured: true,
            skipping: true,
            moving: false,
            dropped: 0,
            weights: Default::default(),
            carrier: None,
            place,
            desc,
        };
        grid.update_fade();
        Ok(grid)
    }

    pub(crate) fn update_fade(&mut self) {
        for (axis, fade) in self.fade.iter_mut().enumerate() {
            self.place.fade(axis, fade);
        }
        if !self.holes.is_empty() {
            self.holes.place(&self.place.window);
        }
    }

    pub(crate) fn set_moving(&mut self, moving: bool) {
        self.moving = moving;
        if !moving {
            self.layer = None;
            self.drift = Drift::default();
        }
        let profile = Profile::new(self.desc.border, self.stepping.a, moving);
        if profile != self.profile {
            self.profile = profile;
            self.axes = [Axis::new(&profile, 0, self.state.nx), Axis::new(&profile, 1, self.state.nz)];
        }
    }

    /// Moves the window by whole cells so that its middle stays within one cell of a world point, and the fade by the
    /// fraction. The water stands still in the world; what enters is calm. A jump past all that the window holds clears it. A target
    /// that is not finite, or farther than 10^14 cells, is ignored.
    pub fn center_on(&mut self, target: DVec2) {
        let stood = self.place.window;
        match self.place.follow(target) {
            Move::Stay => {}
            Move::Shift(shift) => {
                let moved = self.tiles.shift(shift);
                if let Some(ground) = &mut self.ground {
                    Arc::make_mut(ground).shift(shift, moved, &mut self.tiles);
                }
                if !self.at_rest() {
                    self.set_moving(true);
                    cpu::shift::shift(&mut self.state, shift, self.profile.thickness);
                    if let Some(fields) = &mut self.fields {
                        fields.shift(shift);
                    }
                    if let Some(spectral) = &mut self.spectral {
                        spectral.shift(shift);
                    }
                    self.desc.border.fill_rings(&mut self.state);
                }
            }
            Move::Clear => {
                self.clear();
                self.read_ground();
            }
        }
        if self.place.window != stood {
            self.renew_feed();
        }
        self.update_fade();
    }

    /// Whether every array is zero.
    pub(crate) fn at_rest(&self) -> bool {
        self.captured && self.tiles.active == 0 && self.tiles.asleep()
    }

    /// Stills the water.
    pub fn clear(&mut self) {
        self.state.clear();
        if let Some(fields) = &mut self.fields {
            fields.clear();
        }
        if let Some(spectral) = &mut self.spectral {
            spectral.clear();
        }
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

    /// Cells on each side that no source may touch.
    pub(crate) fn source_rim(&self) -> usize {
        self.profile.thickness + 1
    }

    /// Whether quiet tiles are left out (default). Without, every cell is stepped in every tick: for measurements.
    pub fn set_tile_skipping(&mut self, on: bool) {
        self.skipping = on;
    }

    /// Whether the border layer of a window that moves over plain water is matched to its motion (default). Without, it is
    /// the gentler one that reflects more, which grids on the GPU have: for measurements.
    pub fn set_matched_motion(&mut self, on: bool) {
        self.matched = on;
    }

    /// Answers `out[i]` at `points[i]` (local x, z) from the end of the last tick; the shorter slice decides how many.
    pub fn sample(&self, points: &[Vec2], out: &mut [GridSample]) {
        if self.at_rest() {
            out.fill(GridSample::default());
            return;
        }
        let dt = self.stepping.dt as f32;
        let repeats = self.desc.border == Border::Periodic;
        for (point, out) in points.iter().zip(out) {
            let at = self.place.cell_of(*point, self.origin);
            *out = cpu::sample::sample(&self.state, &self.place.window, (&self.fade, &self.holes), dt, at, repeats);
        }
    }

    /// Writes (height in metres, foam 0 to 1) of every cell of the current window, both faded, `alpha` (0 to 1) of the
    /// way from the tick before to the last one. Cells that `out` is too short for are left out.
    pub fn draw(&self, alpha: f32, out: &mut [[f32; 2]]) {
        self.draw_from(0, alpha, out);
    }

    /// As [`Self::draw`], of the cells from number `first` on (row-major, x fastest), as many as `out` holds.
    pub fn draw_from(&self, first: usize, alpha: f32, out: &mut [[f32; 2]]) {
        let alpha = if alpha.is_nan() { 1.0 } else { alpha.clamp(0.0, 1.0) };
        let (state, tiles, before) = (&self.state, &self.tiles, self.before());
        Drawing { state, tiles, before, fade: &self.fade, holes: &self.holes, alpha }.write(first, out);
    }

    /// For each band of [`TILE`](crate::TILE) rows of the window, from row 0 on, the columns (first and end) outside of which [`Self::draw`]
    /// writes zeros, whatever `alpha`; equal where all of the band is zero.
    pub fn shown(&self, bands: &mut Vec<[u32; 2]>) {
        cpu::draw::shown(&self.tiles, self.desc.border, bands);
    }
}

//! A grid of interactive waves homed on the CPU.

use fearless_simd::Level;
use glam::{DVec2, Vec2};

use crate::border::{Axis, Profile};
use crate::cpu::current::Carrier;
use crate::cpu::foam::FoamLaw;
use crate::cpu::kernels::Coefficients;
use crate::cpu::step::Setting;
use crate::cpu::tiles::{Mode, Tiles};
use crate::feed::{Feed, Incident};
use crate::ground::{Cells, Ground, REACH};
use crate::window::{Move, Place};
use crate::{GridDesc, GridError, Stepping, cpu, state::State};

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
/// `z_tt + sigma z_t = div(c^2 grad z)`, explicit in time, c and sigma as its [`crate::Medium`] has them. Cloning it is a snapshot.
#[derive(Debug, Clone)]
pub struct WaveGrid {
    pub(crate) desc: GridDesc,
    pub(crate) stepping: Stepping,
    pub(crate) place: Place,
    pub(crate) origin: DVec2,
    pub(crate) state: State,
    pub(crate) tiles: Tiles,
    pub(crate) ground: Option<Ground>,
    pub(crate) feed: Option<Feed>,
    coefficients: Coefficients,
    /// The machine's vector units.
    pub(crate) level: Level,
    /// Largest |z| of each tile after a sub-step.
    tops: Vec<f32>,
    law: FoamLaw,
    profile: Profile,
    axes: [Axis; 2],
    fade: [Vec<f32>; 2],
    /// What is drawn as the tick before is what stands now: since the last tick a source was added or nothing moves.
    pub(crate) captured: bool,
    pub(crate) skipping: bool,
    pub(crate) dropped: u64,
    /// Where there is a current.
    carrier: Option<Carrier>,
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
        let profile = Profile::new(desc.pml_width, stepping.a, false);
        let mut grid = Self {
            stepping,
            origin: DVec2::ZERO,
            state: State::new(nx, nz),
            tiles: Tiles::new([nx, nz], place.window.tile_offset()),
            ground: None,
            feed: None,
            coefficients: Coefficients::new(&desc, &stepping),
            level: Level::new(),
            tops: Vec::new(),
            law: FoamLaw::new(&desc, &stepping),
            profile,
            axes: [Axis::new(&profile, 0, nx), Axis::new(&profile, 1, nz)],
            fade: [vec![0.0; nx], vec![0.0; nz]],
            captured: true,
            skipping: true,
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
    }

    fn set_moving(&mut self, moving: bool) {
        let profile = Profile::new(self.desc.pml_width, self.stepping.a, moving);
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
                    ground.shift(shift, moved, &mut self.tiles);
                }
                if !self.at_rest() {
                    self.set_moving(true);
                    cpu::shift::shift(&mut self.state, shift, self.profile.thickness);
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

    /// Cells on each side that no source may touch.
    pub(crate) fn source_rim(&self) -> usize {
        self.profile.thickness + 1
    }

    /// From now on what stands is drawn as the tick before.
    pub(crate) fn capture(&mut self) {
        if !self.captured {
            self.tiles.forget_kept();
            self.captured = true;
        }
    }

    /// Keeps the heights of the tiles that a source changes, as drawn for the tick before.
    fn keep_around(&mut self, [x, z]: [[usize; 2]; 2]) {
        // Walls within reach of a cubic kernel show the water beside them.
        let by = if self.cells().is_some() { REACH } else { 0 };
        let tiles = |axis: usize, [first, end]: [usize; 2]| {
            let last = (end - 1 + by).min(self.tiles.cells[axis] - 1);
            self.tiles.of(axis, first.saturating_sub(by))..=self.tiles.of(axis, last)
        };
        let (columns, rows) = (tiles(0, x), tiles(1, z));
        for tz in rows {
            for tx in columns.clone() {
                self.keep(tx, tz);
            }
        }
    }

    fn keep(&mut self, tx: usize, tz: usize) {
        let tile = &mut self.tiles.tiles[tz * self.tiles.count[0] + tx];
        if !tile.kept {
            tile.kept = true;
            self.state.keep_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
        }
    }

    /// Advances by one tick. A grid at rest returns at once.
    pub fn tick(&mut self) {
        self.advance(None);
    }

    /// Advances by one tick with waves entering through the sides of [`Self::set_feed`]. For each line (by its index in
    /// [`Self::feed_lines`]) and sub-step, `incident` writes the heights of the incident waves as the sub-step
    /// begins: at the points outside the contour and at those inside. What is not finite counts as zero.
    pub fn tick_fed(&mut self, incident: &mut Incident) {
        // Not in its place while the state is written.
        let mut feed = self.feed.take();
        self.advance(feed.as_mut().map(|feed| (feed, incident)));
        self.feed = feed;
    }

    fn advance(&mut self, mut fed: Option<(&mut Feed, &mut Incident)>) {
        self.capture();
        if let Some((feed, incident)) = &mut fed {
            feed.ask(incident, 0);
            feed.wake(&mut self.tiles, self.state.nx);
        }
        if self.skipping {
            self.tiles.schedule();
        } else {
            self.tiles.activate_all();
        }
        for tz in 0..self.tiles.count[1] {
            for tx in 0..self.tiles.count[0] {
                if self.tiles.row(tz)[tx].mode == Mode::Ending {
                    self.keep(tx, tz);
                    self.state.clear_cells(self.tiles.span(0, tx), self.tiles.span(1, tz));
                    self.captured = false;
                }
            }
        }
        if self.tiles.active == 0 {
            return;
        }
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        if self.carrier.is_none() && cells.is_some_and(Cells::drifts) {
            self.carrier = Some(Carrier::new([self.state.nx, self.state.nz], self.profile.thickness));
        }
        self.tops.resize(self.tiles.tiles.len(), 0.0);
        for substep in 0..self.stepping.substeps {
            // After a tick of one sub-step the older state is that of the tick before.
            let keep = substep == 0 && self.stepping.substeps > 1;
            let setting = Setting {
                level: self.level,
                tiles: &self.tiles,
                axes: &self.axes,
                thickness: self.profile.thickness,
                coefficients: self.coefficients,
                cells,
                keep,
            };
            cpu::step::step(&mut self.state, &mut self.tops, &setting);
            self.tiles.note(&self.tops);
            if keep {
                self.tiles.note_kept();
            }
            if let Some((feed, incident)) = &mut fed {
                if substep > 0 {
                    feed.ask(incident, substep);
                }
                feed.correct(&mut self.state.z);
            }
            if let (Some(carrier), Some(cells)) = (&mut self.carrier, cells) {
                carrier.carry([&mut self.state.z, &mut self.state.old], &self.tiles, cells);
            }
        }
        if let Some(cells) = cells {
            cpu::ghosts::fill([&mut self.state.z, &mut self.state.old], &self.tiles, cells);
        }
        if fed.is_some() {
            // What was fed is not in the tops.
            cpu::foam::measure(&self.state, &mut self.tiles);
        }
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        cpu::foam::settle(&mut self.state, &mut self.tiles, cells, self.law);
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
        let before = if self.captured { &self.state.z } else { &self.state.old };
        cpu::draw::draw(&self.state, &self.tiles, before, &self.fade, alpha, out);
    }
}

//! One grid, whichever home it has.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use ocean_spectrum::Ocean;
use wave_grid::{Border, GridSample, Hole, Medium, Source, WaveGrid, Window};

use super::{Grid, REACH, Sim};
use crate::{BodyId, Follow, GridHome};

impl Grid {
    /// The waves as drawn: calm where the window is not.
    pub(crate) fn sample(&self, points: &[Vec2], out: &mut [GridSample]) {
        match &self.sim {
            Sim::Cpu(grid) => grid.sample(points, out),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.sample(points, out),
        }
        if self.gain < 1.0 || self.repeats() {
            for (point, sample) in points.iter().zip(out) {
                let share = self.gain * self.seen(*point);
                sample.height *= share;
                sample.slope *= share;
                sample.vertical_velocity *= share;
            }
        }
    }

    /// Age (s) and standard deviation (m) of a sample at a local point; `None` where it is exact.
    #[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "all grids are here"))]
    pub(crate) fn doubt(&self, point: Vec2) -> Option<[f32; 2]> {
        match &self.sim {
            Sim::Cpu(_) => None,
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.doubt(point).map(|[age, error]| [age, self.gain * error]),
        }
    }

    /// A bound of its waves between two local corners, now and after the next tick, metres.
    pub(crate) fn largest_within(&self, low: Vec2, high: Vec2) -> f32 {
        match &self.sim {
            Sim::Cpu(grid) => self.gain * grid.largest_within(low, high),
            // Nobody knows, but waves are where the window is.
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => {
                let window = grid.window();
                let [a, b] = [low, high].map(|corner| window.cells_from_corner(corner, self.origin));
                let cells = DVec2::new(f64::from(window.cells[0]), f64::from(window.cells[1]));
                let apart = a.max(b).cmplt(DVec2::ZERO).any() || a.min(b).cmpgt(cells).any();
                if grid.is_awake() && !apart { f32::INFINITY } else { 0.0 }
            }
        }
    }

    /// Whether it stands for the whole plane.
    pub(crate) fn repeats(&self) -> bool {
        self.desc.border == Border::Periodic
    }

    /// How much of it is left at a local point by the distance from the eye, 0 to 1.
    fn seen(&self, point: Vec2) -> f32 {
        if !self.repeats() {
            return 1.0;
        }
        let t = (2.0 - 2.0 * self.middle.distance(point) / REACH).clamp(0.0, 1.0);
        if t > 0.0 { t * t * (3.0 - 2.0 * t) } else { 0.0 }
    }

    pub(crate) fn window(&self) -> Window {
        match &self.sim {
            Sim::Cpu(grid) => grid.window(),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.window(),
        }
    }

    /// What it shows.
    pub(crate) fn hole(&self) -> Hole {
        match &self.sim {
            Sim::Cpu(grid) => grid.hole(self.gain),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.hole(self.gain),
        }
    }

    /// World place of what is local from now on.
    pub(crate) fn set_origin(&mut self, origin: DVec2) {
        self.origin = origin;
        match &mut self.sim {
            Sim::Cpu(grid) => grid.set_origin(origin),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.set_origin(origin),
        }
    }

    /// Whether it lies in a coarser one.
    pub(crate) fn set_nested(&mut self, nested: bool) {
        match &mut self.sim {
            Sim::Cpu(grid) => grid.set_nested(nested),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.set_nested(nested),
        }
    }

    pub(crate) fn set_holes(&mut self, holes: &[Hole]) {
        match &mut self.sim {
            Sim::Cpu(grid) => grid.set_holes(holes),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.set_holes(holes),
        }
    }

    pub(crate) fn center_on(&mut self, target: DVec2) {
        match &mut self.sim {
            Sim::Cpu(grid) => grid.center_on(target),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.center_on(target),
        }
    }

    pub(crate) fn add(&mut self, source: Source) {
        match &mut self.sim {
            Sim::Cpu(grid) => {
                grid.add(source);
            }
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.add(source),
        }
    }

    /// Tick number `tick`, which begins at `time` seconds.
    pub(super) fn tick(&mut self, ocean: Option<&Ocean>, tick: u64, time: f64) {
        match &mut self.sim {
            Sim::Cpu(grid) => {
                if let Some(rain) = &self.desc.rain {
                    grid.add_rain(rain, tick);
                }
                match (&mut self.feeding, ocean) {
                    (Some(feeding), Some(ocean)) => feeding.tick(grid, ocean, time),
                    _ => grid.tick(),
                }
            }
            // All of these tick at once: see `RemoteGrids::tick`.
            #[cfg(feature = "gpu")]
            Sim::Gpu(_) => {}
        }
    }

    /// What its waves travel through.
    pub(crate) fn set_medium(&mut self, medium: Option<Arc<dyn Medium>>) {
        match &mut self.sim {
            Sim::Cpu(grid) => grid.set_medium(medium),
            // All of these share one: see `RemoteGrids::set_medium`.
            #[cfg(feature = "gpu")]
            Sim::Gpu(_) => {}
        }
    }

    /// The grid itself, when the ambient sea is fed into it.
    pub(crate) fn fed(&self) -> Option<&WaveGrid> {
        match &self.sim {
            Sim::Cpu(grid) if self.desc.feed.any() => Some(grid),
            _ => None,
        }
    }

    pub(crate) fn cell_count(&self) -> u32 {
        self.desc.cells[0] * self.desc.cells[1]
    }

    /// Bytes of its drawn heights in the pool.
    pub(crate) fn pool_bytes(&self) -> u64 {
        u64::from(self.cell_count()) * size_of::<[f32; 2]>() as u64
    }

    /// Whether it can fade when it is removed: what has waves and is all its own.
    pub(crate) fn fades(&self) -> bool {
        matches!(self.sim, Sim::Cpu(_)) && self.is_awake() && !self.desc.feed.any()
    }

    /// Whether it has waves.
    pub(crate) fn is_awake(&self) -> bool {
        match &self.sim {
            Sim::Cpu(grid) => !grid.is_asleep(),
            #[cfg(feature = "gpu")]
            Sim::Gpu(grid) => grid.is_awake(),
        }
    }

    /// Width of the border in which nothing may disturb it, cells.
    fn rim(&self) -> f64 {
        f64::from(self.desc.border.width()) + 4.0
    }

    /// Extent of the window without its border, metres.
    pub(crate) fn room(&self) -> DVec2 {
        let inside = self.desc.cells.map(|n| f64::from(n) - 2.0 * self.rim());
        DVec2::from(inside).max(DVec2::ONE) * Vec2::from(self.desc.cell_size).as_dvec2()
    }

    /// Whether a body that reaches so far (metres) around this place disturbs the grid inside its border layer, and
    /// `margin` cells from there. One that is too large for the grid need only be in its middle.
    pub(crate) fn covers(&self, place: Vec2, reach: f32, margin: f64) -> bool {
        let window = self.window();
        let at = window.cells_from_corner(place, self.origin);
        !self.repeats()
            && (0..2).all(|k| {
                let cells = f64::from(window.cells[k]);
                let most = 0.5 * cells - self.rim() - 2.0 - margin;
                let rim = self.rim() + margin + f64::from(reach / window.cell_size[k]).min(most).max(0.0);
                at[k] > rim && at[k] < cells - rim
            })
    }

    /// Whether it follows the body.
    pub(crate) fn follows(&self, body: BodyId) -> bool {
        self.desc.follow == Follow::Body(body)
    }

    /// Order of the grids that a body could disturb, the best first: one that stays, that follows it, that is on the CPU,
    /// the finest.
    pub(crate) fn rank(&self, body: BodyId) -> (bool, bool, bool, f32) {
        let [x, z] = self.desc.cell_size;
        (self.leaving, !self.follows(body), self.desc.home == GridHome::Gpu, x.max(z))
    }
}

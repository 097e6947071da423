//! The interactive grids: their handles, windows, homes and what they follow.
//!
//! Stepping is `wave-grid`'s; this decides around what a window stays and whose waves are whose.

use std::sync::Arc;

use floating_body::Arena;
use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::Ocean;
use wave_grid::{Border, GridSample, Hole, Medium, Source, WaveGrid, Window};

use crate::follow::Look;
use crate::land::Feeding;
use crate::{BodyId, Follow, GridDesc, GridHome, GridId, OpenWaterError};

/// Most grids that a water may hold: all of them are drawn.
pub const MAX_GRIDS: usize = open_water_shaders::surface::MAX_GRIDS;

/// Distance at which a grid that repeats has faded, metres; the fade begins at half of it.
pub(crate) const REACH: f32 = 60.0;
/// Seconds in which a grid that was removed fades.
const FADE: f32 = 1.0;

pub(crate) struct Grid {
    pub(crate) id: GridId,
    /// The coarsest of the grids that it lies in, or itself: what lies in one another holds the same waves.
    pub(crate) root: GridId,
    pub(crate) desc: GridDesc,
    pub(crate) sim: Sim,
    /// Place in the pool of drawn heights, elements.
    pub(crate) base: u32,
    /// Factor on its heights, 0 to 1: grids come and go softly.
    pub(crate) gain: f32,
    /// It was removed, and is gone once it has faded.
    pub(crate) leaving: bool,
    /// The grid that it fades into meanwhile: both hold the same waves.
    pub(crate) into: Option<GridId>,
    /// Seconds left to waves that leave a grid whose home has changed.
    pub(crate) ebb: Option<f32>,
    /// Where its middle stands from the body that it follows, metres.
    pub(crate) trail: DVec2,
    /// World place of the local origin, metres.
    pub(crate) origin: DVec2,
    /// The place it follows, with `Follow::Point`.
    pub(crate) point: Option<DVec2>,
    /// Around where it is seen, local, if it repeats.
    pub(crate) middle: Vec2,
    /// How the ambient sea comes in.
    pub(crate) feeding: Option<Feeding>,
}

/// Where a grid's state is.
pub(crate) enum Sim {
    Cpu(Box<WaveGrid>),
    #[cfg(feature = "gpu")]
    Gpu(Box<crate::gpu::grids::RemoteGrid>),
}

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
    fn tick(&mut self, ocean: Option<&Ocean>, tick: u64, time: f64) {
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

/// All grids of a water, in the order in which they were added.
#[derive(Default)]
pub(crate) struct Grids {
    pub(crate) ids: Arena<GridId, ()>,
    pub(crate) list: Vec<Grid>,
    /// A grid has holes.
    pub(crate) holed: bool,
}

impl Grids {
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Grid> {
        self.list.iter()
    }

    pub(crate) fn iter_mut(&mut self) -> std::slice::IterMut<'_, Grid> {
        self.list.iter_mut()
    }

    /// The oldest age (s) and the standard deviation (m) of the sum of all grids at a local point.
    pub(crate) fn doubt(&self, point: Vec2) -> [f32; 2] {
        let all = self.list.iter().filter_map(|grid| grid.doubt(point));
        let [age, square] = all.fold([0.0f32; 2], |[age, sum], [a, error]| [age.max(a), sum + error * error]);
        [age, square.sqrt()]
    }

    /// One that was removed is found until it has faded.
    pub(crate) fn get(&self, id: GridId) -> Result<&Grid, OpenWaterError> {
        self.list.iter().find(|grid| grid.id == id).ok_or(OpenWaterError::UnknownGrid(id))
    }

    /// One that was not removed.
    pub(crate) fn present(&self, id: GridId) -> Result<&Grid, OpenWaterError> {
        self.get(id).ok().filter(|grid| !grid.leaving).ok_or(OpenWaterError::UnknownGrid(id))
    }

    pub(crate) fn get_mut(&mut self, id: GridId) -> Option<&mut Grid> {
        self.list.iter_mut().find(|grid| grid.id == id)
    }

    /// Two grids.
    pub(crate) fn two(&mut self, first: GridId, second: GridId) -> [Option<&mut Grid>; 2] {
        let mut found = [None, None];
        for grid in &mut self.list {
            if let Some(at) = [first, second].iter().position(|id| *id == grid.id) {
                found[at] = Some(grid);
            }
        }
        found
    }

    /// Refuses one grid too many.
    pub(crate) fn check_room(&self) -> Result<(), OpenWaterError> {
        if self.list.len() >= MAX_GRIDS {
            let value = self.list.len() as f64 + 1.0;
            return Err(OpenWaterError::InvalidValue { field: "grids", value, bound: "at most 32" });
        }
        Ok(())
    }

    pub(crate) fn insert(&mut self, desc: GridDesc, sim: Sim) -> GridId {
        let id = self.ids.insert(());
        let root = desc.within.and_then(|within| self.get(within).ok()).map_or(id, |around| around.root);
        self.list.push(Grid {
            id,
            root,
            desc,
            sim,
            base: 0,
            gain: 1.0,
            leaving: false,
            into: None,
            ebb: None,
            trail: DVec2::ZERO,
            origin: DVec2::ZERO,
            point: None,
            middle: Vec2::ZERO,
            feeding: None,
        });
        self.place();
        id
    }

    /// Moves the local origin by `offset`, to `origin` in the world.
    pub(crate) fn rebase(&mut self, origin: DVec2, offset: Vec2) {
        for grid in &mut self.list {
            grid.set_origin(origin);
            grid.middle -= offset;
        }
    }

    /// Takes a grid out at once.
    pub(crate) fn take(&mut self, id: GridId) -> Result<Grid, OpenWaterError> {
        self.ids.remove(id).ok_or(OpenWaterError::UnknownGrid(id))?;
        let at = self.list.iter().position(|grid| grid.id == id).ok_or(OpenWaterError::UnknownGrid(id))?;
        let grid = self.list.remove(at);
        self.place();
        self.adopt(&grid);
        Ok(grid)
    }

    /// Lets the grids that were removed fade by `dt` seconds. Returns those that have.
    pub(crate) fn fade(&mut self, dt: f32) -> Vec<GridId> {
        let mut gone = Vec::new();
        for at in 0..self.list.len() {
            let grid = &mut self.list[at];
            if !grid.leaving || grid.ebb_on(dt) {
                continue;
            }
            if grid.ebbs() && !grid.is_awake() {
                grid.gain = 0.0;
            }
            // Never again as much as the grid it fades into has taken over.
            grid.gain = (grid.gain - dt / FADE).max(0.0);
            let (id, gain, into) = (grid.id, grid.gain, grid.into.filter(|_| !grid.ebbs()));
            if let Some(next) = into.and_then(|into| self.get_mut(into)).filter(|next| !next.leaving) {
                next.gain = 1.0 - gain;
            }
            if gain == 0.0 {
                gone.push(id);
            }
        }
        gone
    }

    /// Gives every grid its place in the pool.
    pub(crate) fn place(&mut self) {
        let mut base = 0;
        for grid in &mut self.list {
            grid.base = base;
            base += grid.cell_count();
        }
    }

    /// Cells of all grids.
    #[cfg(feature = "gpu")]
    pub(crate) fn pool_cells(&self) -> u32 {
        self.list.iter().map(Grid::cell_count).sum()
    }

    /// Moves the windows after what they follow.
    pub(crate) fn center(&mut self, look: Option<&Look>, level: f32, place_of: impl Fn(BodyId) -> Option<Vec3>) {
        for grid in &mut self.list {
            if let Some(target) = grid.target(look, level, &place_of) {
                grid.center_on(target);
            }
            let world = (-grid.origin).as_vec2();
            grid.middle = look.map_or(world, |look| Vec2::new(look.eye.x, look.eye.z));
        }
    }

    /// Runs tick number `tick` of each, which begins at `time` seconds.
    pub(crate) fn tick(&mut self, ocean: Option<&Ocean>, tick: u64, time: f64) {
        for grid in &mut self.list {
            grid.tick(ocean, tick, time);
        }
    }
}

//! The interactive grids: their handles, windows, homes and what they follow.
//!
//! Stepping is `wave-grid`'s; this decides around what a window stays and whose waves are whose.

mod grid;

use floating_body::Arena;
use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::Ocean;
use wave_grid::WaveGrid;

use crate::follow::Look;
use crate::land::Feeding;
use crate::{BodyId, GridDesc, GridId, OpenWaterError};

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

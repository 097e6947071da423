//! Grids that lie in coarser ones: fine cells where a bow wave is, coarse ones around for the wake far behind.
//!
//! All grids that lie in one another hold the same waves, as far as their windows and cells carry them: a source goes to
//! each of them. Where a finer one is seen the coarser ones are not, so that every wave is seen and felt once.

use arrayvec::ArrayVec;
use glam::{DVec2, Vec2};
use wave_grid::Hole;

use crate::grids::{Grid, Grids, MAX_GRIDS, Sim};
use crate::store::GridId;
use crate::{Follow, GridDesc, GridHome, OpenWaterError};

/// Most grids within one on the GPU.
const MOST: usize = open_water_shaders::grid::MAX_HOLES;

impl GridDesc {
    /// Extent of the window, metres.
    fn extent(&self) -> DVec2 {
        DVec2::from(self.cells.map(f64::from)) * Vec2::from(self.cell_size).as_dvec2()
    }
}

impl Grids {
    /// Whether a grid may lie in the one it names.
    pub(crate) fn check_within(&self, desc: &GridDesc) -> Result<(), OpenWaterError> {
        let Some(around) = desc.within else { return Ok(()) };
        let around = self.present(around)?;
        let coarse = &around.desc;
        let refuse = |unless: bool, why| if unless { Ok(()) } else { Err(OpenWaterError::Within(why)) };
        refuse(desc.border.width() > 0, "in another when its border absorbs")?;
        refuse(!desc.feed.any(), "in another when it is not fed")?;
        refuse(!around.repeats(), "in one that does not repeat")?;
        refuse(!coarse.feed.any(), "in one that is not fed")?;
        let finer = (0..2).all(|k| desc.cell_size[k] < coarse.cell_size[k]);
        refuse(finer, "in one of larger cells")?;
        refuse(desc.extent().cmplt(coarse.extent()).all(), "in one with a larger window")?;
        let water = |desc: &GridDesc| desc.scheme.is_wave_equation().then_some(desc.wave_speed);
        refuse(
            water(desc) == water(coarse),
            "in one whose waves are as fast: of a like scheme, or of the same wave_speed",
        )?;
        if let (Follow::Fixed(place), Follow::Fixed(middle)) = (desc.follow, coarse.follow) {
            let inside = (place - middle).abs() + 0.5 * desc.extent();
            refuse(inside.cmple(0.5 * coarse.extent()).all(), "in one whose window its own lies in")?;
        }
        let full = |grid: &Grid| grid.desc.home == GridHome::Gpu && self.inside(grid.id).count() >= MOST;
        refuse(!self.around(around.id).any(full), "in one homed on the GPU with seven others at most")
    }

    /// A grid and those that it lies in.
    fn around(&self, id: GridId) -> impl Iterator<Item = &Grid> {
        // None lies in itself: what a grid lies in was there before it.
        std::iter::successors(self.get(id).ok(), |grid| self.get(grid.desc.within?).ok())
    }

    /// The grids that lie in one.
    fn inside(&self, id: GridId) -> impl Iterator<Item = &Grid> {
        self.iter().filter(move |grid| grid.id != id && self.around(grid.id).any(|around| around.id == id))
    }

    /// The grids that take the waves of bodies at home in one.
    pub(crate) fn taking(&mut self, home: GridId) -> impl Iterator<Item = &mut Grid> {
        let root = self.get(home).map(|grid| grid.root).ok();
        self.iter_mut().filter(move |grid| !grid.ebbs() && (Some(grid.root) == root || grid.into == Some(home)))
    }

    /// What lay in a grid that is gone lies in what that one lay in.
    pub(crate) fn adopt(&mut self, gone: &Grid) {
        for grid in self.iter_mut().filter(|grid| grid.desc.within == Some(gone.id)) {
            grid.desc.within = gone.desc.within;
            grid.set_nested(gone.desc.within.is_some());
        }
        let ids: Vec<GridId> = self.iter().map(|grid| grid.id).collect();
        for id in ids {
            let root = self.around(id).last().map_or(id, |root| root.id);
            if let Some(grid) = self.get_mut(id) {
                grid.root = root;
            }
        }
    }

    /// Cuts out of every grid what finer ones show, as windows and fades stand.
    pub(crate) fn cut_holes(&mut self) {
        let any = self.iter().any(|grid| grid.desc.within.is_some());
        if !any && !self.holed {
            return;
        }
        self.holed = any;
        let ids: ArrayVec<GridId, MAX_GRIDS> = self.iter().map(|grid| grid.id).collect();
        for id in ids {
            let holes: ArrayVec<Hole, MAX_GRIDS> = self.inside(id).map(Grid::hole).collect();
            if let Some(grid) = self.get_mut(id) {
                grid.set_holes(&holes);
            }
        }
    }

    /// Lets a new grid begin with the waves of the one that it lies in.
    pub(crate) fn inherit(&mut self, id: GridId) {
        let around = self.get(id).ok().and_then(|grid| self.get(grid.desc.within?).ok());
        let Some(Sim::Cpu(waves)) = around.map(|around| &around.sim) else { return };
        if waves.is_asleep() {
            return;
        }
        let waves = waves.clone();
        if let Some(Sim::Cpu(grid)) = self.get_mut(id).map(|grid| &mut grid.sim) {
            grid.resample(&waves);
        }
    }
}

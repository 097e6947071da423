//! The grids of an [`OpenWater`]: how they are added, removed and read.

use glam::{DVec2, Vec2};
use wave_grid::WaveGrid;

use crate::OpenWaterError;
use crate::desc::{GridDesc, GridHome};
use crate::follow::Follow;
use crate::grids::Sim;
use crate::store::GridId;
use crate::water::OpenWater;

impl OpenWater {
    /// Adds an interactive grid.
    ///
    /// # Errors
    /// A value of the description is out of its range or its scheme unstable; too many grids; a GPU home without a GPU; a
    /// grid to lie in that cannot hold it.
    pub fn add_grid(&mut self, desc: GridDesc) -> Result<GridId, OpenWaterError> {
        let id = self.new_grid(desc)?;
        note!(self, Input::Grid(Box::new(self.grids.get(id)?.desc.clone())));
        Ok(id)
    }

    /// As [`Self::add_grid`], by the water itself.
    pub(crate) fn new_grid(&mut self, desc: GridDesc) -> Result<GridId, OpenWaterError> {
        desc.check_home()?;
        self.grids.check_within(&desc)?;
        self.grids.check_room()?;
        let grid = desc.wave_grid(self.clock.dt());
        let sim = match desc.home {
            GridHome::Cpu => Sim::Cpu(Box::new(self.cpu_grid(&desc, grid)?)),
            #[cfg(feature = "gpu")]
            GridHome::Gpu => {
                let gpu = self.gpu.as_mut().ok_or(OpenWaterError::NoGpu)?;
                Sim::Gpu(Box::new(gpu.add_grid(grid)?))
            }
            #[cfg(not(feature = "gpu"))]
            GridHome::Gpu => return Err(OpenWaterError::NoGpu),
        };
        let (fed, nested) = (desc.feed.any(), desc.within.is_some());
        #[cfg(feature = "gpu")]
        if let Err(error) = self.room_for(&desc) {
            if let (Some(gpu), Sim::Gpu(grid)) = (&mut self.gpu, sim) {
                gpu.remote.take_back(grid.id);
            }
            return Err(error);
        }
        let id = self.grids.insert(desc, sim);
        if let Some(grid) = self.grids.get_mut(id) {
            grid.set_origin(self.shore.origin);
        }
        if nested {
            self.nest(id);
        }
        if fed {
            self.rebuild_shore(self.shore.terrain.clone())?;
        }
        Ok(id)
    }

    /// Makes room for one more grid's drawn heights.
    #[cfg(feature = "gpu")]
    fn room_for(&mut self, desc: &GridDesc) -> Result<(), OpenWaterError> {
        let Some(gpu) = &mut self.gpu else { return Ok(()) };
        let cells = u64::from(desc.cells[0]) * u64::from(desc.cells[1]) + u64::from(self.grids.pool_cells());
        gpu.check_pool(cells)?;
        gpu.resize_pool(cells as u32)
    }

    /// Puts a new grid where it is to be, with the waves of the one that it lies in.
    fn nest(&mut self, id: GridId) {
        let (look, level) = (self.looking.as_ref(), self.shore.level);
        if let Some(grid) = self.grids.get_mut(id) {
            grid.set_nested(true);
            if let Some(target) = grid.target(look, level, |body| self.bodies.place_of(body)) {
                grid.center_on(target);
            }
        }
        self.grids.inherit(id);
        self.grids.cut_holes();
    }

    fn cpu_grid(&self, desc: &GridDesc, grid: wave_grid::GridDesc) -> Result<WaveGrid, OpenWaterError> {
        let mut grid = WaveGrid::new(grid)?;
        if let Follow::Fixed(place) = desc.follow {
            grid.center_on(place);
        }
        if desc.feed.any() {
            grid.set_feed(desc.feed);
            self.check_feed(desc, &grid)?;
        }
        grid.set_medium(self.shore.medium());
        Ok(grid)
    }

    /// Gives a grid homed on the CPU other cells while it runs: a grid of those takes its waves over and fades in within a
    /// second, as the old one fades out. Returns its handle; that of the old one is void.
    ///
    /// # Errors
    /// As [`Self::add_grid`]; there is no such grid, it is homed on the GPU, fed, or others lie in it. Then nothing was changed.
    pub fn set_grid_cells(
        &mut self,
        id: GridId,
        cells: [u32; 2],
        cell_size: [f32; 2],
    ) -> Result<GridId, OpenWaterError> {
        let old = self.grids.present(id)?;
        let nested = self.grids.iter().any(|grid| grid.desc.within == Some(id));
        if old.desc.home == GridHome::Gpu || old.desc.feed.any() || nested {
            let bound = "of a grid homed on the CPU, not fed, and without others in it: remove it and add another";
            return Err(OpenWaterError::InvalidValue { field: "cells", value: cells[0].into(), bound });
        }
        let waves = match &old.sim {
            Sim::Cpu(waves) => Some(waves.clone()).filter(|waves| !waves.is_asleep()),
            #[cfg(feature = "gpu")]
            Sim::Gpu(_) => None,
        };
        let (trail, point, middle) = (old.trail, old.point, old.middle);
        let window = old.window();
        let new = self.new_grid(GridDesc { cells, cell_size, ..old.desc.clone() })?;
        if let Some(grid) = self.grids.get_mut(new) {
            (grid.trail, grid.point, grid.middle) = (trail, point, middle);
            let extent = DVec2::from(window.cells.map(f64::from)) * Vec2::from(window.cell_size).as_dvec2();
            grid.center_on(window.world_corner() + 0.5 * extent);
            if let (Sim::Cpu(sim), Some(waves)) = (&mut grid.sim, &waves) {
                sim.resample(waves);
                grid.gain = 0.0;
            }
        }
        if let Some(grid) = self.grids.get_mut(id).filter(|_| waves.is_some()) {
            grid.into = Some(new);
        }
        self.end_grid(id)?;
        self.grids.cut_holes();
        note!(self, Input::Cells(id, cells, cell_size));
        Ok(new)
    }

    /// Removes a grid. The waves of one that is stepped on the CPU fade over a second, those of others end.
    ///
    /// # Errors
    /// There is no such grid.
    pub fn remove_grid(&mut self, id: GridId) -> Result<(), OpenWaterError> {
        self.end_grid(id)?;
        note!(self, Input::RemoveGrid(id));
        Ok(())
    }

    /// As [`Self::remove_grid`], by the water itself.
    pub(crate) fn end_grid(&mut self, id: GridId) -> Result<(), OpenWaterError> {
        self.grids.present(id)?;
        for grid in self.grids.iter_mut().filter(|grid| grid.ebbs() && grid.into == Some(id)) {
            grid.ebb = Some(0.0);
        }
        if self.grids.present(id)?.fades()
            && let Some(grid) = self.grids.get_mut(id)
        {
            grid.leaving = true;
            return Ok(());
        }
        self.drop_grid(id)
    }

    /// Removes a grid and its waves at once.
    pub(crate) fn drop_grid(&mut self, id: GridId) -> Result<(), OpenWaterError> {
        let removed = self.grids.take(id)?;
        self.grids.cut_holes();
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            if let Sim::Gpu(grid) = removed.sim {
                gpu.remote.remove(grid.id);
            }
            // Where there is no memory for a smaller pool, the old one does.
            let _ = gpu.resize_pool(self.grids.pool_cells());
        }
        if removed.desc.feed.any() {
            self.rebuild_shore(self.shore.terrain.clone())?;
        }
        Ok(())
    }

    /// The state of a CPU-homed grid after the last tick; `None` for a GPU-homed one.
    ///
    /// # Errors
    /// There is no such grid.
    pub fn grid(&self, id: GridId) -> Result<Option<&WaveGrid>, OpenWaterError> {
        Ok(match &self.grids.present(id)?.sim {
            Sim::Cpu(grid) => Some(&**grid),
            #[cfg(feature = "gpu")]
            Sim::Gpu(_) => None,
        })
    }

    /// How many grids there are.
    pub fn grid_count(&self) -> usize {
        self.grids.iter().filter(|grid| !grid.leaving).count()
    }
}

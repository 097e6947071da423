//! Back to a snapshot: all that can be refused is made first, then everything is put in place.

use std::sync::Arc;

use ocean_spectrum::Ocean;
use wave_grid::WaveGrid;

use super::WaterSnapshot;
use super::grids::GridMoment;
use crate::OpenWaterError;
use crate::grids::Sim;
use crate::water::OpenWater;

/// Where the sea comes from.
enum Sea {
    Calm,
    /// The water's own goes back.
    Own,
    New(Box<Ocean>),
}

impl OpenWater {
    /// Goes back to a moment of this water, or becomes what another one was: from there the same inputs give the same ticks, to the
    /// bit. Handles are those of the snapshot. Everything is replaced, descriptions too; ticks that were handed out and not run are
    /// void ([`Self::ticks_until`] hands out others).
    ///
    /// The land must be that of the snapshot: put it there by [`Self::set_land`] before. Grids homed on the GPU that are still there
    /// keep the waves that they have, as these are the device's; others begin calm. From bytes, dry hulls are kept for bodies whose
    /// handles there are.
    ///
    /// A snapshot of this water costs what moves, and a body or grid that was removed since is made again. From bytes all bodies, grids
    /// and modes of the sea are made anew, some ten milliseconds.
    ///
    /// # Errors
    /// The land is other; the snapshot has a grid homed on the GPU and this water no device; a snapshot from bytes does not hold together.
    /// Then nothing was changed. Or the device has no room for it: then the water is restored, but not all of it can be drawn.
    pub fn restore(&mut self, snapshot: &WaterSnapshot) -> Result<(), OpenWaterError> {
        let WaterSnapshot { tick, desc, order, fleets, moorings, wakes, looking, reports, .. } = snapshot;
        let shared = snapshot.here.is_some();
        desc.check()?;
        wakes.check(desc.tick)?;
        snapshot.grids.check()?;
        if looking.is_some_and(|look| !look.is_sane()) {
            return Err(OpenWaterError::InvalidValue { field: "snapshot: look", value: f64::NAN, bound: "finite" });
        }
        let shore = snapshot.shore.restored(&self.shore, snapshot.ocean.is_some())?;
        let sea = match (&snapshot.ocean, &self.ocean) {
            (None, _) => Sea::Calm,
            (Some(_), Some(_)) if shared => Sea::Own,
            (Some(of), _) => Sea::New(Box::new(Ocean::from_snapshot(of)?)),
        };
        let medium = shore.medium();
        #[cfg(feature = "gpu")]
        let gpu = &mut self.gpu;
        let mut make = |moment: &GridMoment, desc: wave_grid::GridDesc| -> Result<Sim, OpenWaterError> {
            let Some(waves) = &moment.waves else {
                #[cfg(feature = "gpu")]
                if let (Some(gpu), Some(place)) = (gpu.as_mut(), moment.remote()) {
                    let mut grid = gpu.add_grid(desc)?;
                    grid.center_on(place);
                    return Ok(Sim::Gpu(Box::new(grid)));
                }
                return Err(OpenWaterError::NoGpu);
            };
            let mut grid = WaveGrid::new(desc)?;
            grid.set_medium(medium.clone());
            grid.restore(waves)?;
            Ok(Sim::Cpu(Box::new(grid)))
        };
        let sources = snapshot.grids.sources(&self.grids, desc.tick, shared, &mut make)?;
        // The last that can be refused.
        self.bodies = self.bodies.restored(&snapshot.bodies)?;
        let ocean = match (sea, self.ocean.take()) {
            (Sea::Own, Some(mut own)) => {
                if let Some(of) = &snapshot.ocean {
                    own.restore(of)?;
                }
                Some(own)
            }
            (Sea::New(new), _) => Some(*new),
            (Sea::Calm | Sea::Own, _) => None,
        };
        self.ocean = ocean;
        let gone = snapshot.grids.put(sources, shore.origin, &mut self.grids)?;
        let maps = Arc::clone(&self.shore.baked);
        self.shore = shore;
        self.desc = desc.clone();
        self.clock.resume(desc.tick, desc.max_ticks_per_frame, *tick);
        self.tick = *tick;
        self.fleets.list = fleets.clone();
        (self.moorings, self.wakes, self.looking) = (moorings.clone(), wakes.clone(), *looking);
        // What frames did stays.
        let (dropped_secs, behind) = (self.reports.dropped_secs, self.reports.behind);
        self.reports = crate::Reports { dropped_secs, behind, ..*reports };
        match &snapshot.here {
            Some(here) => self.dry = here.dry.clone(),
            None => self.dry.keep(|body| self.bodies.body(body).is_ok()),
        }
        self.grids.cut_holes();
        #[cfg(feature = "gpu")]
        let drawn = self.draw_restored(gone);
        #[cfg(not(feature = "gpu"))]
        drop(gone);
        self.feed_restored(&maps)?;
        self.coming = None;
        match (snapshot.here.as_ref().and_then(|here| here.coming.as_ref()), order) {
            (Some((coming, current)), _) => {
                self.coming = Some(coming.at(if *current { self.shore.revision } else { 0 }));
            }
            (None, Some(order)) => self.order_sea(*order),
            (None, None) => {}
        }
        note!(self, Input::start(self));
        #[cfg(feature = "gpu")]
        drawn?;
        Ok(())
    }

    /// Hands the land's maps to whoever reads them, where they are not those of before.
    fn feed_restored(&mut self, before: &Arc<crate::land::Baked>) -> Result<(), OpenWaterError> {
        let baked = Arc::clone(&self.shore.baked);
        let same = Arc::ptr_eq(&baked, before);
        let fed =
            |ready: bool| self.grids.iter().any(|grid| grid.fed().is_some() && (!ready || grid.feeding.is_none()));
        let modes = self.ocean.as_ref().map_or(0, Ocean::revision);
        if fed(same && modes == self.shore.fed_revision) {
            self.feed_grids(&baked)?;
        }
        self.shore.fed_revision = modes;
        if !same && (self.shore.terrain.is_some() || self.ocean.is_some()) {
            self.show_shore(baked)?;
        }
        Ok(())
    }

    /// Brings the device up to what there is now.
    #[cfg(feature = "gpu")]
    fn draw_restored(&mut self, gone: Vec<crate::grids::Grid>) -> Result<(), OpenWaterError> {
        let Some(gpu) = &mut self.gpu else { return Ok(()) };
        for grid in gone {
            if let Sim::Gpu(grid) = grid.sim {
                gpu.remote.remove(grid.id);
            }
        }
        gpu.remote.set_medium(self.shore.medium());
        gpu.remote.set_origin(self.shore.origin);
        gpu.restore(self.ocean.as_ref(), self.grids.pool_cells())?;
        gpu.set_dry(self.dry.rasters())
    }
}

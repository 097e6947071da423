//! Land and water level of an [`OpenWater`]: what changes when they do, and questions about them.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use ocean_spectrum::{AmplitudeMap, Ocean};
use wave_grid::{Scheme, WaveGrid};

use crate::cpu::surface::WaterSample;
use crate::land::{Baked, Carrier, Feeding, Land, Terrain, bake};
use crate::water::OpenWater;
use crate::{Follow, GridDesc, GridHome, OpenWaterError};

/// The maps follow the water level when it has moved this far, metres.
const LEVEL_STEP: f32 = 0.05;
/// Largest water level in either direction, metres.
const HIGHEST: f32 = 1000.0;

impl OpenWater {
    /// Puts land under and around the water, replaces it, or takes it away; while running, too. Waves where a wall comes
    /// to stand are let go.
    ///
    /// # Errors
    /// A map is out of its range (the error names pixel, value and bound), a fed grid does not lie on the new map, or there is a
    /// fed grid and the land is taken away; then nothing was changed.
    pub fn set_land(&mut self, land: Option<Land>) -> Result<(), OpenWaterError> {
        let terrain = land.map(|land| Terrain::new(land, self.shore.level)).transpose()?;
        self.check_carriers(terrain.as_ref())?;
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.room_for_land(terrain.as_ref().map(|terrain| terrain.bed().size()))?;
        }
        self.rebuild_shore(terrain)?;
        note!(self, Input::Land(Box::new(self.land().cloned())));
        Ok(())
    }

    /// The land as it was given.
    pub fn land(&self) -> Option<&Land> {
        self.shore.terrain.as_ref().map(Terrain::land)
    }

    /// Raises or lowers the still water to `level` metres above the datum, within 1000 m: tides, floods, locks. Surfaces and bodies follow
    /// at once, the maps of the land in steps of 5 cm.
    ///
    /// # Errors
    /// The level is not finite or beyond its bound; then nothing was changed.
    pub fn set_level(&mut self, level: f32) -> Result<(), OpenWaterError> {
        if level.is_nan() || level.abs() > HIGHEST {
            let value = level.into();
            return Err(OpenWaterError::InvalidValue { field: "level", value, bound: "within 1000 m" });
        }
        self.shore.level = level;
        note!(self, Input::Level(level));
        match &self.shore.terrain {
            Some(terrain) if (terrain.level - level).abs() >= LEVEL_STEP => {
                let terrain = terrain.at_level(level);
                self.rebuild_shore(Some(terrain))
            }
            _ => Ok(()),
        }
    }

    /// Water level above the datum, metres.
    pub fn level(&self) -> f32 {
        self.shore.level
    }

    /// Whether a local point is under water after the last tick: below the surface, above the bed, and not where there is no water.
    /// False for a point that is not finite.
    pub fn is_underwater(&self, point: Vec3) -> bool {
        if !point.is_finite() {
            return false;
        }
        let at = Vec2::new(point.x, point.z);
        let mut sample = [WaterSample::default()];
        self.sample(&[at], &mut sample);
        let above_bed = self.shore.terrain.as_ref().is_none_or(|t| point.y >= t.bed().elevation(self.shore.world(at)));
        sample[0].wet && point.y < sample[0].height && above_bed
    }

    /// Whether a grid may be fed; `grid` is where it will be.
    pub(crate) fn check_feed(&self, desc: &GridDesc, grid: &WaveGrid) -> Result<(), OpenWaterError> {
        if !matches!(desc.follow, Follow::Fixed(_)) {
            return Err(OpenWaterError::Feed("when it stays in a place: `Follow::Fixed`"));
        }
        let Some(terrain) = &self.shore.terrain else {
            return Err(OpenWaterError::Feed("on land: call `OpenWater::set_land` before"));
        };
        self.carrier(grid).check(terrain)
    }

    fn carrier<'a>(&self, grid: &'a WaveGrid) -> Carrier<'a> {
        let capacity = |ocean| Carrier::capacity(ocean, grid.desc().cell_size);
        // On a calm sea there is nothing to carry, which is no error.
        Carrier { grid, cascades: self.ocean.as_ref().map_or(1, capacity) }
    }

    fn check_carriers(&self, terrain: Option<&Terrain>) -> Result<(), OpenWaterError> {
        for grid in self.grids.iter().filter_map(|grid| grid.fed()) {
            match terrain {
                Some(terrain) => self.carrier(grid).check(terrain)?,
                None => return Err(OpenWaterError::Feed("on land: remove it before the land")),
            }
        }
        Ok(())
    }

    /// Makes all maps anew, for the sea as it will be when no change runs, and hands them to whoever reads them.
    pub(crate) fn rebuild_shore(&mut self, terrain: Option<Terrain>) -> Result<(), OpenWaterError> {
        let medium = terrain.as_ref().map(Terrain::medium);
        for grid in self.grids.iter_mut() {
            grid.set_medium(medium.clone());
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.remote.set_medium(medium);
        }
        self.shore.terrain = terrain;
        let baked = Arc::new(self.bake_shore());
        let baked = self.maps_of_now(baked);
        self.feed_grids(&baked)?;
        self.show_shore(baked)
    }

    /// The maps of the land as it is.
    pub(crate) fn bake_shore(&self) -> Baked {
        let Some(terrain) = &self.shore.terrain else { return Baked::default() };
        let settled = self.ocean.as_ref().map(Ocean::settled);
        let carriers: Vec<_> = self.grids.iter().filter_map(|grid| grid.fed()).map(|grid| self.carrier(grid)).collect();
        bake(terrain, settled.as_ref(), &carriers)
    }

    /// Prepares the edges of fed grids for the sea's modes. The sea may have become one of which a grid can carry nothing:
    /// then all of it stays ambient there.
    pub(crate) fn feed_grids(&mut self, baked: &Baked) -> Result<(), OpenWaterError> {
        let (Some(terrain), Some(ocean)) = (&self.shore.terrain, &self.ocean) else { return Ok(()) };
        let fed = self.grids.iter().filter_map(|grid| grid.fed()).map(|grid| self.carrier(grid));
        let feeding =
            |c: Carrier| (c.cascades > 0).then(|| Feeding::new(c.grid, ocean, c.cascades, terrain, baked)).transpose();
        let feedings: Vec<_> = fed.map(feeding).collect::<Result<_, _>>()?;
        for (grid, feeding) in self.grids.iter_mut().filter(|grid| grid.fed().is_some()).zip(feedings) {
            grid.feeding = feeding;
        }
        self.shore.fed_revision = self.ocean.as_ref().map_or(0, Ocean::revision);
        Ok(())
    }

    /// Hands maps to whoever reads them.
    pub(crate) fn show_shore(&mut self, baked: Arc<Baked>) -> Result<(), OpenWaterError> {
        let terrain = &self.shore.terrain;
        if let Some(ocean) = &mut self.ocean {
            let map = terrain.as_ref().map(|t| {
                let bed = t.bed();
                AmplitudeMap::new(bed.corner(), bed.texel(), bed.size(), baked.factors.clone()).map(Arc::new)
            });
            ocean.set_amplitudes(map.transpose()?);
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.set_land(terrain.as_ref().map(|terrain| baked.texels(terrain.bed())).as_ref())?;
        }
        self.shore.baked = baked;
        self.shore.revision += 1;
        Ok(())
    }
}

impl GridDesc {
    /// Refuses a feed that no home can give.
    pub(crate) fn check_home(&self) -> Result<(), OpenWaterError> {
        if self.feed.any() && self.home == GridHome::Gpu {
            return Err(OpenWaterError::Feed("when it is homed on the CPU: `GridHome::Cpu`"));
        }
        if self.feed.any() && !self.scheme.is_wave_equation() {
            return Err(OpenWaterError::Feed("when it is of the wave equation: `Scheme::NinePoint` or `FivePoint`"));
        }
        if self.scheme == Scheme::Spectral && self.home == GridHome::Gpu {
            return Err(OpenWaterError::Scheme { scheme: self.scheme, needs: "a home on the CPU: `GridHome::Cpu`" });
        }
        if self.feed.any() && self.border.width() == 0 {
            return Err(OpenWaterError::Feed("when its border absorbs"));
        }
        if let Some(rain) = &self.rain {
            let invalid =
                |field, value: f32, bound| Err(OpenWaterError::InvalidValue { field, value: value.into(), bound });
            if !(0.0..=1000.0).contains(&rain.rate) {
                return invalid("rain: rate", rain.rate, "0 to 1000 mm/h");
            }
            if !(1e-4..=0.1).contains(&rain.drop_radius) {
                return invalid("rain: drop_radius", rain.drop_radius, "0.0001 to 0.1 m");
            }
            if self.home == GridHome::Gpu {
                return invalid("rain: rate", rain.rate, "given to grids homed on the CPU only");
            }
        }
        Ok(())
    }
}

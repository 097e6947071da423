//! Land and water level as the water holds them.

use std::sync::Arc;

use glam::Vec2;
use wave_grid::Medium;

use super::Terrain;

/// Land and water level.
#[derive(Default)]
pub(crate) struct Shore {
    /// Water level above the datum, metres.
    pub(crate) level: f32,
    /// The land at the level for which the maps were made.
    pub(crate) terrain: Option<Terrain>,
    /// How often the maps were made.
    pub(crate) revision: u64,
}

/// Tells one state of the shore from another.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ShoreMark {
    pub(crate) level: f32,
    revision: u64,
}

impl Shore {
    pub(crate) fn mark(&self) -> ShoreMark {
        ShoreMark { level: self.level, revision: self.revision }
    }

    /// What grids read.
    pub(crate) fn medium(&self) -> Option<Arc<dyn Medium>> {
        self.terrain.as_ref().map(Terrain::medium)
    }

    /// Whether land or no-water outlines leave a place (local x, z) without water.
    pub(crate) fn is_dry(&self, point: Vec2) -> bool {
        let Some(terrain) = &self.terrain else { return false };
        let place = point.as_dvec2();
        self.level <= terrain.bed().elevation(place) || terrain.is_kept_dry(place)
    }

    /// Whether a place (local x, z) is inside a no-water outline.
    pub(crate) fn is_kept_dry(&self, point: Vec2) -> bool {
        self.terrain.as_ref().is_some_and(|terrain| terrain.is_kept_dry(point.as_dvec2()))
    }
}

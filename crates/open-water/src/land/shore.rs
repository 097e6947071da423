//! Land and water level as the water holds them.

use std::sync::Arc;

use floating_body::Touch;
use glam::{DVec2, Vec2, Vec3};
use wave_grid::Medium;

use super::{Baked, Terrain};

/// Land and water level.
#[derive(Default)]
pub(crate) struct Shore {
    /// World place of the local origin, metres: land is given in world coordinates.
    pub(crate) origin: DVec2,
    /// Water level above the datum, metres.
    pub(crate) level: f32,
    /// The level as bodies found it in the last tick.
    pub(crate) found: f32,
    /// The land at the level for which the maps were made.
    pub(crate) terrain: Option<Terrain>,
    /// The maps as they are shown.
    pub(crate) baked: Arc<Baked>,
    /// How often they changed.
    pub(crate) revision: u64,
    /// The maps' way from one sea's to another's.
    pub(crate) turning: Option<Turning>,
    /// The order of the cascades in the maps, while they change.
    pub(crate) places: Option<Vec<[Option<usize>; 2]>>,
    /// The sea's modes ([`Ocean::revision`](ocean_spectrum::Ocean::revision)) with which grids are fed.
    pub(crate) fed_revision: u64,
}

/// Maps on their way from one sea's to another's.
#[derive(Debug, Clone)]
pub(crate) struct Turning {
    pub(crate) from: Arc<Baked>,
    pub(crate) to: Arc<Baked>,
    /// While cascades change: the maps of those that stay.
    pub(crate) after: Option<Arc<Baked>>,
    /// When it begins and how long it takes, seconds.
    pub(crate) start: f64,
    pub(crate) seconds: f64,
    /// How far they are shown, 0 to 1.
    pub(crate) shown: f32,
}

/// The maps follow a changing sea in steps of this share of the way.
const TURN: f32 = 1.0 / 32.0;

impl Turning {
    /// The share of the way to show at `time` seconds, if it differs enough from what is shown.
    pub(crate) fn next(&self, time: f64) -> Option<f32> {
        let way = (((time - self.start) / self.seconds) as f32).clamp(0.0, 1.0);
        let share = way * way * (3.0 - 2.0 * way);
        ((share - self.shown).abs() >= TURN || (share == 1.0 && self.shown < 1.0)).then_some(share)
    }
}

/// Tells one state of the shore from another.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ShoreMark {
    pub(crate) level: f32,
    pub(crate) origin: DVec2,
    revision: u64,
}

impl Shore {
    pub(crate) fn mark(&self) -> ShoreMark {
        ShoreMark { level: self.level, origin: self.origin, revision: self.revision }
    }

    /// Whether the level is what it was in the last tick.
    pub(crate) fn stands(&self) -> bool {
        self.level == self.found
    }

    /// What grids read.
    pub(crate) fn medium(&self) -> Option<Arc<dyn Medium>> {
        self.terrain.as_ref().map(Terrain::medium)
    }

    /// Whether land or no-water outlines leave a place (local x, z) without water.
    pub(crate) fn is_dry(&self, point: Vec2) -> bool {
        let Some(terrain) = &self.terrain else { return false };
        let place = self.world(point);
        self.level <= terrain.bed().elevation(place) || terrain.is_kept_dry(place)
    }

    /// Whether a place (local x, z) is inside a no-water outline.
    pub(crate) fn is_kept_dry(&self, point: Vec2) -> bool {
        self.terrain.as_ref().is_some_and(|terrain| terrain.is_kept_dry(self.world(point)))
    }

    /// World place of a local one (x, z).
    pub(crate) fn world(&self, point: Vec2) -> DVec2 {
        self.origin + point.as_dvec2()
    }

    /// What is solid at local points (y above the datum). Returns whether anything is near.
    pub(crate) fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        self.terrain.as_ref().is_some_and(|terrain| terrain.touch(self.origin, points, out))
    }
}

//! What a grid reads of the land at one water level.

use std::sync::Arc;

use glam::DVec2;
use wave_grid::{CellKind, Medium, MediumCell};

use super::polygon::Polygon;
use super::{Damping, DepthMap, Land, ObstacleKind, Shelter};
use crate::OpenWaterError;

/// Water shallower than this is land to a grid, metres: waves there would be slower than a cell per second.
pub(crate) const WET: f32 = 0.05;
/// Beyond g h/c0^2 = 3^2 the bed is not felt: 1 - c/c0 < 1e-4.
const DEEP: f32 = 3.0;
/// Entries of the table of speeds.
const SPEEDS: usize = 1024;
const GRAVITY: f32 = 9.81;

/// The land as it was given, checked.
#[derive(Debug)]
struct Parts {
    land: Land,
    walls: Vec<(Polygon, ObstacleKind)>,
    no_water: Vec<Polygon>,
    /// c/c0 over sqrt(g h/c0^2) from 0 to [`DEEP`].
    speeds: Vec<f32>,
    /// Of the land, once asked for.
    #[cfg(feature = "serde")]
    digest: std::sync::OnceLock<u64>,
}

/// The land at one water level. A copy shares the maps.
#[derive(Debug, Clone)]
pub(crate) struct Terrain {
    parts: Arc<Parts>,
    /// Above the datum, metres.
    pub(crate) level: f32,
}

/// Speed over speed in deep water of waves of one period over a depth h, by x = sqrt(g h/c0^2): the dispersion relation
/// as approximated by Fenton and McKee (1990), within 1.7 %; sqrt(g h) in shallow water.
fn speed_ratio(x: f64) -> f64 {
    libm::pow(libm::tanh(libm::pow(x, 1.5)), 2.0 / 3.0)
}

impl Terrain {
    pub(crate) fn new(land: Land, level: f32) -> Result<Self, OpenWaterError> {
        land.check()?;
        let wall = |o: &super::Obstacle| Ok((Polygon::new("obstacle outline", &o.outline)?, o.kind));
        let walls = land.obstacles.iter().map(wall).collect::<Result<_, OpenWaterError>>()?;
        let dry = |outline: &Vec<DVec2>| Polygon::new("no_water outline", outline);
        let no_water = land.no_water.iter().map(dry).collect::<Result<_, _>>()?;
        let speeds = (0..=SPEEDS).map(|i| speed_ratio(f64::from(DEEP) * i as f64 / SPEEDS as f64) as f32).collect();
        let parts = Parts {
            land,
            walls,
            no_water,
            speeds,
            #[cfg(feature = "serde")]
            digest: std::sync::OnceLock::new(),
        };
        Ok(Self { parts: Arc::new(parts), level })
    }

    /// Whether it is the same land, at whatever level.
    pub(crate) fn is_of_land(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.parts, &other.parts) || self.parts.land == other.parts.land
    }

    /// Tells this land from others.
    #[cfg(feature = "serde")]
    pub(crate) fn digest(&self) -> u64 {
        *self.parts.digest.get_or_init(|| crate::snapshot::Digest::of(&self.parts.land))
    }

    /// As grids read it.
    pub(crate) fn medium(&self) -> Arc<dyn Medium> {
        Arc::new(self.clone())
    }

    /// The same land under another water level.
    pub(crate) fn at_level(&self, level: f32) -> Self {
        Self { parts: self.parts.clone(), level }
    }

    pub(crate) fn land(&self) -> &Land {
        &self.parts.land
    }

    pub(crate) fn bed(&self) -> &DepthMap {
        &self.parts.land.bed
    }

    pub(crate) fn shelter(&self) -> &Shelter {
        &self.parts.land.shelter
    }

    /// Depth of still water at a place, metres; negative on dry land.
    pub(crate) fn depth(&self, place: DVec2) -> f32 {
        self.level - self.bed().elevation(place)
    }

    /// The outlines of the obstacles.
    pub(super) fn walls(&self) -> impl Iterator<Item = &Polygon> {
        self.parts.walls.iter().map(|(outline, _)| outline)
    }

    fn wall(&self, place: DVec2) -> Option<ObstacleKind> {
        self.parts.walls.iter().find(|(outline, _)| outline.contains(place)).map(|(_, kind)| *kind)
    }

    /// Whether a place is inside a "no water" outline.
    pub(crate) fn is_kept_dry(&self, place: DVec2) -> bool {
        self.parts.no_water.iter().any(|outline| outline.contains(place))
    }

    /// Whether waves can be at a place.
    pub(crate) fn is_wet(&self, place: DVec2) -> bool {
        self.depth(place) > WET && self.wall(place).is_none() && !self.is_kept_dry(place)
    }

    /// Distance from the nearest obstacle, metres, at most `reach`.
    #[cfg(feature = "gpu")]
    pub(crate) fn wall_distance(&self, place: DVec2, reach: f64) -> f64 {
        self.parts.walls.iter().map(|(outline, _)| outline.distance(place, reach)).fold(reach, f64::min)
    }

    /// Speed over speed in deep water `c0` over `depth` metres.
    pub(crate) fn speed_ratio(&self, depth: f32, c0: f32) -> f32 {
        let x = (GRAVITY * depth.max(0.0)).sqrt() / c0 * (SPEEDS as f32 / DEEP);
        if x >= SPEEDS as f32 {
            return 1.0;
        }
        let at = x as usize;
        let (a, b) = (self.parts.speeds[at], self.parts.speeds[at + 1]);
        a + (x - at as f32) * (b - a)
    }

    fn damping(&self, place: DVec2, depth: f32) -> f32 {
        match &self.parts.land.damping {
            Damping::Beach { surf_depth, rate } if depth < *surf_depth => {
                let shallow = 1.0 - depth / surf_depth;
                rate * shallow * shallow
            }
            Damping::Beach { .. } => 0.0,
            Damping::Given(values) => self.bed().between(place, values),
        }
    }
}

impl Medium for Terrain {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let depth = self.depth(place);
        let kind = match self.wall(place) {
            Some(ObstacleKind::Fixed) => CellKind::Fixed,
            Some(ObstacleKind::Reflecting) => CellKind::Wall,
            None if depth <= WET || self.is_kept_dry(place) => CellKind::Wall,
            None => CellKind::Open,
        };
        let speed = deep_speed * self.speed_ratio(depth, deep_speed);
        MediumCell { speed, depth, damping: self.damping(place, depth), kind, ..MediumCell::default() }
    }

    fn is_plain(&self, low: DVec2, high: DVec2, deep_speed: f32) -> bool {
        self.is_deep(low, high, DEEP * DEEP * deep_speed * deep_speed / GRAVITY)
    }

    fn is_deep(&self, low: DVec2, high: DVec2, depth: f32) -> bool {
        let mut outlines = self.parts.walls.iter().map(|(outline, _)| outline).chain(&self.parts.no_water);
        if outlines.any(|outline| outline.may_touch(low, high)) {
            return false;
        }
        let least = self.level - self.bed().highest(low, high);
        match &self.parts.land.damping {
            Damping::Beach { surf_depth, .. } => least >= depth.max(*surf_depth),
            Damping::Given(_) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A beach that rises by 1 in 10 along x from 20 m of depth, a quay and a dry dock.
    fn terrain() -> Terrain {
        let elevations = (0..64 * 8).map(|i| (i % 64) as f32 * 0.4 - 20.0).collect();
        let bed = DepthMap::new(DVec2::ZERO, 4.0, [64, 8], elevations).unwrap();
        let square = |x: f64| [[x, 4.0], [x + 8.0, 4.0], [x + 8.0, 12.0], [x, 12.0]].map(DVec2::from_array).to_vec();
        let mut land = Land::new(bed);
        land.obstacles.push(Obstacle { outline: square(40.0), kind: ObstacleKind::Reflecting });
        land.obstacles.push(Obstacle { outline: square(80.0), kind: ObstacleKind::Fixed });
        land.no_water.push(square(120.0));
        Terrain::new(land, 0.0).unwrap()
    }

    use super::super::Obstacle;

    #[test]
    fn waves_slow_down_as_the_dispersion_relation_says() {
        let terrain = terrain();
        for (c0, depth) in [(10.0f64, 20.0f64), (10.0, 8.0), (10.0, 2.0), (6.2, 5.0), (6.2, 1.0), (15.0, 12.0)] {
            let omega = 9.81 / c0;
            let k = ocean_spectrum::dispersion::wavenumber(omega, Some(depth));
            let found = f64::from(terrain.speed_ratio(depth as f32, c0 as f32)) * c0;
            assert!((found * k / omega - 1.0).abs() < 0.018, "{c0} {depth}: {found} {}", omega / k);
        }
        let shallow = terrain.speed_ratio(0.1, 10.0) * 10.0;
        assert!((shallow / (0.981f32).sqrt() - 1.0).abs() < 0.01, "{shallow}");
        assert_eq!(terrain.speed_ratio(1000.0, 10.0), 1.0);
    }

    #[test]
    fn cells_are_what_the_maps_say() {
        let terrain = terrain();
        let kind = |x: f64, z: f64| terrain.at(DVec2::new(x, z), 8.0).kind;
        assert_eq!(kind(44.0, 8.0), CellKind::Wall);
        assert_eq!(kind(84.0, 8.0), CellKind::Fixed);
        assert_eq!(kind(124.0, 8.0), CellKind::Wall);
        assert_eq!(kind(44.0, 20.0), CellKind::Open);
        assert_eq!(kind(201.0, 20.0), CellKind::Wall);
        assert!(terrain.at(DVec2::new(196.0, 20.0), 8.0).damping > 0.5);
        assert_eq!(terrain.at(DVec2::new(100.0, 20.0), 8.0).damping, 0.0);
        assert!((terrain.at(DVec2::new(50.0, 24.0), 8.0).depth - 15.0).abs() < 1e-4);
        // A tide of one metre floods ten metres of the beach.
        let flooded = terrain.at_level(1.0);
        assert_eq!(flooded.at(DVec2::new(201.0, 20.0), 8.0).kind, CellKind::Open);
        assert!((flooded.at(DVec2::new(50.0, 24.0), 8.0).depth - 16.0).abs() < 1e-4);
        assert!(!terrain.is_wet(DVec2::new(201.0, 20.0)) && flooded.is_wet(DVec2::new(201.0, 20.0)));
    }

    #[test]
    fn only_deep_open_water_is_plain() {
        let terrain = terrain();
        let plain = |low: [f64; 2], high: [f64; 2], c0| terrain.is_plain(low.into(), high.into(), c0);
        assert!(plain([-50.0, -50.0], [20.0, 50.0], 4.0));
        assert!(!plain([-50.0, -50.0], [20.0, 50.0], 8.0), "the bed is felt");
        assert!(!plain([-50.0, -50.0], [45.0, 50.0], 1.0), "an obstacle");
        assert!(!plain([90.0, 20.0], [210.0, 40.0], 1.0), "the beach");
        // The bed is 18 m deep at x = 20.
        let deep = |high: [f64; 2], depth| terrain.is_deep([-50.0, -50.0].into(), high.into(), depth);
        assert!(deep([20.0, 50.0], 17.0) && !deep([20.0, 50.0], 19.0) && !deep([45.0, 50.0], 1.0));
        assert!(terrain.at_level(2.0).is_deep([-50.0, -50.0].into(), [20.0, 50.0].into(), 19.0));
    }
}

//! Feeds a fixed grid with the ambient sea through its edges.

use glam::DVec2;
use ocean_spectrum::{EdgeDesc, EdgeFeed, Ocean};
use wave_grid::{FeedLine, Side, WaveGrid};

use super::{Baked, Terrain};
use crate::OpenWaterError;

/// The edges through which a grid is fed.
#[derive(Default)]
pub(crate) struct Feeding {
    edges: Vec<Fed>,
}

struct Fed {
    waves: EdgeFeed,
    /// World places of the points.
    places: Vec<DVec2>,
    /// Factor on the waves at each point.
    factors: Vec<f32>,
}

impl Feeding {
    /// Prepares the edges of a grid for its first `cascades`.
    pub(crate) fn new(
        grid: &WaveGrid,
        ocean: &Ocean,
        cascades: usize,
        terrain: &Terrain,
        baked: &Baked,
    ) -> Result<Self, OpenWaterError> {
        let prepare = |line: &FeedLine| {
            let along_x = matches!(line.side, Side::LowZ | Side::HighZ);
            let inward = if matches!(line.side, Side::LowX | Side::LowZ) { 1.0 } else { -1.0 };
            let desc = EdgeDesc {
                along_x,
                across: line.across,
                inward,
                first: line.first,
                step: line.step,
                count: line.count,
                wave_speed: line.speed,
                cascades,
            };
            let middle = 0.5 * (line.across[0] + line.across[1]);
            let place = |i: usize| {
                let along = line.first + line.step * i as f64;
                if along_x { DVec2::new(along, middle) } else { DVec2::new(middle, along) }
            };
            let places = (0..line.count).map(place).collect();
            Ok(Fed { waves: EdgeFeed::new(ocean, desc)?, places, factors: Vec::new() })
        };
        let edges = grid.feed_lines().iter().map(prepare).collect::<Result<_, OpenWaterError>>()?;
        let mut feeding = Self { edges };
        feeding.weigh(terrain, baked);
        Ok(feeding)
    }

    /// Takes the factors on the incoming waves from the land's maps.
    pub(crate) fn weigh(&mut self, terrain: &Terrain, baked: &Baked) {
        for Fed { places, factors, .. } in &mut self.edges {
            factors.clear();
            factors.extend(places.iter().map(|place| terrain.bed().between(*place, &baked.incoming)));
        }
    }

    /// Runs a tick of the grid that begins at `time` seconds.
    pub(crate) fn tick(&mut self, grid: &mut WaveGrid, ocean: &Ocean, time: f64) {
        let dt = grid.stepping().dt;
        let edges = &mut self.edges;
        grid.tick_fed(&mut |edge, substep, [outside, inside]| {
            let Some(fed) = edges.get_mut(edge) else { return };
            fed.waves.rows(ocean.moment_at(time + f64::from(substep) * dt), [&mut *outside, &mut *inside]);
            for row in [outside, inside] {
                row.iter_mut().zip(&fed.factors).for_each(|(height, factor)| *height *= factor);
            }
        });
    }
}

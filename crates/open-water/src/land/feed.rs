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
            let factor = |i: usize| {
                let along = line.first + line.step * i as f64;
                let place = if along_x { DVec2::new(along, middle) } else { DVec2::new(middle, along) };
                terrain.bed().between(place, &baked.incoming)
            };
            let factors = (0..line.count).map(factor).collect();
            Ok(Fed { waves: EdgeFeed::new(ocean, desc)?, factors })
        };
        let edges = grid.feed_lines().iter().map(prepare).collect::<Result<_, OpenWaterError>>()?;
        Ok(Self { edges })
    }

    /// Runs a tick of the grid that begins at `time` seconds.
    pub(crate) fn tick(&mut self, grid: &mut WaveGrid, ocean: &Ocean, time: f64) {
        let dt = grid.stepping().dt;
        let edges = &mut self.edges;
        grid.tick_fed(&mut |edge, substep, [outside, inside]| {
            let Some(fed) = edges.get_mut(edge) else { return };
            fed.waves.rows(ocean.phase_at(time + f64::from(substep) * dt), [&mut *outside, &mut *inside]);
            for row in [outside, inside] {
                row.iter_mut().zip(&fed.factors).for_each(|(height, factor)| *height *= factor);
            }
        });
    }
}

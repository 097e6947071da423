//! Turns a tick of all grids into what the passes read: parameters, tiles, sources.

use bytemuck::Zeroable;
use open_water_shaders::grid::{CLEARED, GridParams, GridSource, GridTile, SHIFTED, STOOD};

use super::Grid;
use crate::TILE;
use crate::source::Footprint;

/// A queued tick.
#[derive(Debug)]
pub(super) struct Tick {
    /// First of its tiles in the packer's list.
    pub(super) first: u32,
    /// How many.
    pub(super) tiles: u32,
    /// Tiles of each sub-step: those of the grids that have so many, which stand first.
    pub(super) substeps: Vec<u32>,
}

/// What is to be uploaded.
#[derive(Debug, Default)]
pub(super) struct Packer {
    pub(super) params: Vec<GridParams>,
    pub(super) tiles: Vec<GridTile>,
    pub(super) sources: Vec<GridSource>,
    /// (place of a tile, source) of one grid.
    placed: Vec<(u32, GridSource)>,
}

impl Packer {
    /// Forgets what was uploaded.
    pub(super) fn clear(&mut self) {
        self.params.clear();
        self.tiles.clear();
        self.sources.clear();
    }

    /// Appends one tick, and moves the grids on.
    pub(super) fn pack(&mut self, grids: &mut [Grid]) -> Tick {
        let first = self.tiles.len() as u32;
        let mut order: Vec<usize> = (0..grids.len()).filter(|g| grids[*g].awake > 0).collect();
        order.sort_by_key(|g| std::cmp::Reverse(grids[*g].stepping.substeps));
        let most = order.first().map_or(0, |g| grids[*g].stepping.substeps);
        let mut substeps = vec![0; most as usize];
        for g in order {
            let grid = &mut grids[g];
            // The last tick of a grid stills it.
            grid.awake -= 1;
            grid.clear |= grid.awake == 0;
            self.pack_grid(grid);
            for end in &mut substeps[..grid.stepping.substeps as usize] {
                *end = self.tiles.len() as u32 - first;
            }
            grid.parity = (grid.parity + grid.stepping.substeps) & 1;
            grid.shift = [0; 2];
            grid.clear = false;
            grid.moving &= grid.awake > 0;
            grid.sources.clear();
        }
        Tick { first, tiles: self.tiles.len() as u32 - first, substeps }
    }

    fn pack_grid(&mut self, grid: &Grid) {
        let profile = grid.profile();
        let (straight, beside) = grid.desc.scheme.weights();
        let moved = match grid {
            Grid { clear: true, .. } => CLEARED,
            Grid { shift: [0, 0], .. } => STOOD,
            _ => SHIFTED,
        };
        let index = self.params.len() as u32;
        self.params.push(GridParams {
            corner: grid.torus_corner(),
            cells: grid.desc.cells,
            torus: grid.torus.map(|n| n as u32),
            // A longer shift leaves nothing of the window either.
            shift: grid.shift.map(|s| s.clamp(-8192, 8192) as i32),
            base: grid.base,
            stride: grid.stride(),
            parity: grid.parity,
            substeps: grid.stepping.substeps,
            moved,
            thickness: profile.thickness as u32,
            exponent: profile.exponent as u32,
            peak: profile.peak,
            weights: [(grid.stepping.a * straight) as f32, (grid.stepping.a * beside) as f32],
            damping: (0.5 * f64::from(grid.desc.damping) * grid.stepping.dt) as f32,
            foam_scale: grid.law.scale,
            foam_onset: grid.law.onset,
            foam_growth: grid.law.growth,
            foam_keep: grid.law.keep,
            pad: 0,
        });
        self.place_sources(grid);
        let mut next = 0;
        for row in 0..grid.torus[1] / TILE {
            for column in 0..grid.torus[0] / TILE {
                let place = (column | row << 16) as u32;
                let first_source = self.sources.len() as u32;
                while let Some((_, source)) = self.placed.get(next).filter(|(at, _)| *at == place) {
                    self.sources.push(*source);
                    next += 1;
                }
                let source_count = self.sources.len() as u32 - first_source;
                self.tiles.push(GridTile { grid: index, place, first_source, source_count });
            }
        }
    }

    /// Lists the grid's sources by tile, each tile's in the order they were added.
    fn place_sources(&mut self, grid: &Grid) {
        self.placed.clear();
        let corner = grid.place.window.corner;
        for (Footprint { center, inner, outer, height, foam, range }, placed_at) in &grid.sources {
            let since: [i64; 2] = std::array::from_fn(|k| corner[k] - placed_at[k]);
            let source = GridSource {
                center: std::array::from_fn(|k| center[k] - since[k] as f32),
                inner: *inner,
                outer: *outer,
                height: *height,
                foam: *foam,
                ..GridSource::zeroed()
            };
            let tiles: [std::ops::RangeInclusive<i64>; 2] = std::array::from_fn(|k| {
                let world = |cell: usize| (cell as i64 + placed_at[k]).div_euclid(TILE as i64);
                world(range[k][0])..=world(range[k][1] - 1)
            });
            let on_torus = |k: usize, tile: i64| tile.rem_euclid((grid.torus[k] / TILE) as i64) as u32;
            for row in tiles[1].clone() {
                for column in tiles[0].clone() {
                    self.placed.push((on_torus(0, column) | on_torus(1, row) << 16, source));
                }
            }
        }
        self.placed.sort_by_key(|(place, _)| *place);
    }
}

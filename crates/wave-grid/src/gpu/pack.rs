//! Turns a tick of all grids into what the passes read: parameters, tiles, sources.

use bytemuck::Zeroable;
use open_water_shaders::grid::{CLEARED, GridParams, GridSource, GridTile, SHIFTED, STOOD, TickParams};

use super::Grid;
use crate::TILE;
use crate::source::Footprint;

/// A queued tick: workgroups along x (tiles) and z (grids) of each dispatch.
#[derive(Debug)]
pub(super) struct Tick {
    pub(super) prepare: [u32; 2],
    /// Each sub-step covers the grids that have so many, which stand first.
    pub(super) substeps: Vec<[u32; 2]>,
}

/// What is to be uploaded.
#[derive(Debug, Default)]
pub(super) struct Packer {
    /// One entry per tick.
    pub(super) params: Vec<TickParams>,
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
        let mut order: Vec<usize> = (0..grids.len()).filter(|g| grids[*g].awake > 0).collect();
        order.sort_by_key(|g| std::cmp::Reverse(grids[*g].stepping.substeps));
        let most = order.first().map_or(0, |g| grids[*g].stepping.substeps);
        let mut tick = Tick { prepare: [0; 2], substeps: vec![[0; 2]; most as usize] };
        if order.is_empty() {
            return tick;
        }
        let mut params = TickParams::default();
        for (g, params) in order.into_iter().zip(&mut params) {
            let grid = &mut grids[g];
            // The last tick of a grid stills it.
            grid.awake -= 1;
            grid.clear |= grid.awake == 0;
            *params = self.pack_grid(grid);
            let covered = tick.substeps.iter_mut().take(grid.stepping.substeps as usize);
            for [tiles, count] in covered.chain([&mut tick.prepare]) {
                *tiles = params.tile_count.max(*tiles);
                *count += 1;
            }
            grid.parity = (grid.parity + grid.stepping.substeps) & 1;
            grid.shift = [0; 2];
            grid.clear = false;
            grid.moving &= grid.awake > 0;
            grid.sources.clear();
        }
        self.params.push(params);
        tick
    }

    fn pack_grid(&mut self, grid: &Grid) -> GridParams {
        let profile = grid.profile();
        let (straight, beside) = grid.desc.scheme.weights();
        let moved = match grid {
            Grid { clear: true, .. } => CLEARED,
            Grid { shift: [0, 0], .. } => STOOD,
            _ => SHIFTED,
        };
        let first_tile = self.tiles.len() as u32;
        self.pack_tiles(grid);
        GridParams {
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
            first_tile,
            tile_count: self.tiles.len() as u32 - first_tile,
            ..GridParams::zeroed()
        }
    }

    fn pack_tiles(&mut self, grid: &Grid) {
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
                self.tiles.push(GridTile { place, first_source, source_count, pad: 0 });
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

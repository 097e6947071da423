//! Turns a tick of all grids into what the passes read: parameters, tiles, sources.

use bytemuck::Zeroable;
use open_water_shaders::grid::{CLEARED, GridParams, GridSource, GridTile, SHIFTED, STOOD, TickParams};

use super::Grid;
use crate::TILE;
use crate::source::Footprint;

/// A queued tick: tiles without cells of the layer stand first, and among them those of the grids with most sub-steps.
#[derive(Debug)]
pub(super) struct Tick {
    /// First of its tiles in the list.
    pub(super) first: u32,
    /// Tiles without and with cells of the layer.
    pub(super) tiles: [u32; 2],
    /// A grid moved.
    pub(super) moved: bool,
    pub(super) substeps: Vec<Substep>,
}

/// A sub-step covers the grids that have so many.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Substep {
    /// Tiles without and with cells of the layer.
    pub(super) tiles: [u32; 2],
    /// It is the last of some grid.
    pub(super) last: bool,
}

/// A pipeline.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Prepare { moved: bool },
    Step { layer: bool, last: bool },
}

/// What a dispatch runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Work {
    pub(super) kind: Kind,
    pub(super) tiles: u32,
}

impl Tick {
    /// The tick's dispatches in order: first tile, sub-step, work.
    pub(super) fn dispatches(&self) -> impl Iterator<Item = (u32, u32, Work)> {
        let [inner, layer] = self.tiles;
        let prepare = Work { kind: Kind::Prepare { moved: self.moved }, tiles: inner + layer };
        let steps = (0..).zip(&self.substeps).flat_map(move |(k, &Substep { tiles, last })| {
            let work = |layer: bool| Work { kind: Kind::Step { layer, last }, tiles: tiles[usize::from(layer)] };
            [(self.first, k, work(false)), (self.first + inner, k, work(true))]
        });
        std::iter::once((self.first, 0, prepare)).chain(steps).filter(|(_, _, work)| work.tiles > 0)
    }
}

/// What is to be uploaded.
#[derive(Debug, Default)]
pub(super) struct Packer {
    /// One entry per tick.
    pub(super) params: Vec<TickParams>,
    pub(super) tiles: Vec<GridTile>,
    pub(super) sources: Vec<GridSource>,
    /// ((grid, place of a tile), source).
    placed: Vec<((u32, u32), GridSource)>,
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
        let first = self.tiles.len() as u32;
        let mut tick = Tick { first, tiles: [0; 2], moved: false, substeps: vec![Substep::default(); most as usize] };
        if order.is_empty() {
            return tick;
        }
        let mut params = TickParams::default();
        self.placed.clear();
        for (slot, g) in order.iter().enumerate() {
            let grid = &mut grids[*g];
            // The last tick of a grid stills it.
            grid.awake -= 1;
            grid.clear |= grid.awake == 0;
            params[slot] = packed(grid);
            tick.moved |= params[slot].moved != STOOD;
            self.place_sources(slot as u32, grid);
        }
        self.placed.sort_by_key(|(tile, _)| *tile);
        for layer in [false, true] {
            let kind = usize::from(layer);
            for (slot, g) in order.iter().enumerate() {
                let grid = &grids[*g];
                tick.tiles[kind] += self.pack_tiles(slot as u32, grid, layer);
                let own = grid.stepping.substeps as usize;
                for (k, substep) in tick.substeps.iter_mut().take(own).enumerate() {
                    substep.tiles[kind] = tick.tiles[kind];
                    substep.last |= k + 1 == own;
                }
            }
        }
        for g in order {
            let grid = &mut grids[g];
            grid.parity = (grid.parity + grid.stepping.substeps) & 1;
            grid.shift = [0; 2];
            grid.clear = false;
            grid.moving &= grid.awake > 0;
            grid.sources.clear();
        }
        self.params.push(params);
        tick
    }

    /// Lists the tiles without or with cells of the layer. Returns how many there are.
    fn pack_tiles(&mut self, slot: u32, grid: &Grid, layer: bool) -> u32 {
        let before = self.tiles.len();
        let (corner, thickness) = (grid.torus_corner(), grid.profile().thickness);
        let inner = |k: usize, tile: usize| {
            let cell = (tile * TILE + grid.torus[k] - corner[k] as usize) % grid.torus[k];
            cell > thickness && cell + TILE + thickness < grid.desc.cells[k] as usize
        };
        for row in 0..grid.torus[1] / TILE {
            for column in 0..grid.torus[0] / TILE {
                if (inner(0, column) && inner(1, row)) != layer {
                    self.pack_tile(slot, (column | row << 8) as u32);
                }
            }
        }
        (self.tiles.len() - before) as u32
    }

    fn pack_tile(&mut self, slot: u32, place: u32) {
        let first_source = self.sources.len() as u32;
        let start = self.placed.partition_point(|(tile, _)| *tile < (slot, place));
        let own = self.placed[start..].iter().take_while(|(tile, _)| *tile == (slot, place));
        self.sources.extend(own.map(|(_, source)| *source));
        let source_count = self.sources.len() as u32 - first_source;
        self.tiles.push(GridTile { place: place | slot << 16, first_source, source_count, pad: 0 });
    }

    /// Lists the grid's sources by tile, each tile's in the order they were added.
    fn place_sources(&mut self, slot: u32, grid: &Grid) {
        let corner = grid.place.window.corner;
        for (Footprint { center, outer, height, foam, range }, placed_at) in &grid.sources {
            let since: [i64; 2] = std::array::from_fn(|k| corner[k] - placed_at[k]);
            let source = GridSource {
                center: std::array::from_fn(|k| center[k] - since[k] as f32),
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
                    self.placed.push(((slot, on_torus(0, column) | on_torus(1, row) << 8), source));
                }
            }
        }
    }
}

/// What the passes know of a grid.
fn packed(grid: &Grid) -> GridParams {
    let profile = grid.profile();
    let (straight, beside) = grid.desc.scheme.weights();
    let moved = match grid {
        Grid { clear: true, .. } => CLEARED,
        Grid { shift: [0, 0], .. } => STOOD,
        _ => SHIFTED,
    };
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
        pad: 0,
    }
}

//! Turns a tick of all grids into what the passes read: parameters, tiles, sources.

use open_water_shaders::grid::{
    CLEARED, GridCell, GridParams, GridSource, GridTile, MEDIUM_THREADS, SHIFTED, STOOD, StepShape, TickParams,
};

use super::grid::Grid;
use crate::TILE;
use crate::cpu::tiles::Class;
use crate::source::footprint::{Footprint, Shape};

/// How tiles are stepped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TileKind {
    /// They may have cells of the layer.
    pub(super) layer: bool,
    /// Their medium varies.
    pub(super) mixed: bool,
}

/// The kinds in the order of the list.
const KINDS: [TileKind; 4] = [
    TileKind { layer: false, mixed: false },
    TileKind { layer: true, mixed: false },
    TileKind { layer: false, mixed: true },
    TileKind { layer: true, mixed: true },
];

/// A queued tick: its tiles stand by kind, and among those of a kind the ones of the grids with most sub-steps first.
#[derive(Debug)]
pub(super) struct Tick {
    /// First of its tiles in the list.
    first: u32,
    /// Tiles of each kind.
    tiles: [u32; 4],
    /// First of the cells whose medium it stores, and how many.
    cells: [u32; 2],
    /// A grid moved.
    moved: bool,
    pub(super) substeps: Vec<Substep>,
}

/// A sub-step covers the grids that have so many.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Substep {
    /// Tiles of each kind.
    tiles: [u32; 4],
    /// It is the last of some grid.
    last: bool,
}

/// A pipeline.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Medium,
    Prepare { moved: bool, medium: bool },
    Step { tiles: TileKind, last: bool },
}

/// What a dispatch runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Work {
    pub(super) kind: Kind,
    /// First tile or cell of the list, how many of what a sub-step or the medium takes, sub-step.
    pub(super) first: u32,
    pub(super) count: u32,
    pub(super) substep: u32,
    pub(super) groups: u32,
}

impl Tick {
    /// The tick's dispatches in order.
    pub(super) fn dispatches(&self, shape: StepShape) -> impl Iterator<Item = Work> {
        let [first_cell, count] = self.cells;
        let groups = count.div_ceil(MEDIUM_THREADS);
        let medium = Work { kind: Kind::Medium, first: first_cell, count, substep: 0, groups };
        let prepare = Work {
            kind: Kind::Prepare { moved: self.moved, medium: self.tiles[2] + self.tiles[3] > 0 },
            first: self.first,
            count: 0,
            substep: 0,
            groups: self.tiles.iter().sum(),
        };
        let steps = (0..).zip(&self.substeps).flat_map(move |(substep, &Substep { tiles, last })| {
            let mut start = self.first;
            let works: [Work; 4] = std::array::from_fn(|k| {
                let first = start;
                start += self.tiles[k];
                let (count, groups) = (tiles[k], tiles[k].div_ceil(shape.tiles()));
                Work { kind: Kind::Step { tiles: KINDS[k], last }, first, count, substep, groups }
            });
            works
        });
        [medium, prepare].into_iter().chain(steps).filter(|work| work.groups > 0)
    }
}

/// What is to be uploaded.
#[derive(Debug, Default)]
pub(super) struct Packer {
    /// One entry per tick.
    pub(super) params: Vec<TickParams>,
    pub(super) tiles: Vec<GridTile>,
    pub(super) sources: Vec<GridSource>,
    pub(super) cells: Vec<GridCell>,
    /// ((grid, place of a tile), source).
    placed: Vec<((u32, u32), GridSource)>,
}

impl Packer {
    /// Forgets what was uploaded.
    pub(super) fn clear(&mut self) {
        self.params.clear();
        self.tiles.clear();
        self.sources.clear();
        self.cells.clear();
    }

    /// Appends one tick, and moves the grids on.
    pub(super) fn pack(&mut self, grids: &mut [Grid]) -> Tick {
        let mut order: Vec<usize> = (0..grids.len()).filter(|g| grids[*g].awake > 0).collect();
        order.sort_by_key(|g| std::cmp::Reverse(grids[*g].stepping.substeps));
        let most = order.first().map_or(0, |g| grids[*g].stepping.substeps);
        let first = self.tiles.len() as u32;
        let cells = [self.cells.len() as u32, 0];
        let substeps = vec![Substep::default(); most as usize];
        let mut tick = Tick { first, tiles: [0; 4], cells, moved: false, substeps };
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
            if let Some(land) = &mut grid.land {
                land.upload(slot as u32, grid.torus, &mut self.cells);
            }
        }
        tick.cells[1] = self.cells.len() as u32 - tick.cells[0];
        self.placed.sort_by_key(|(tile, _)| *tile);
        for (kind, of) in KINDS.into_iter().enumerate() {
            for (slot, g) in order.iter().enumerate() {
                let grid = &grids[*g];
                tick.tiles[kind] += self.pack_tiles(slot as u32, grid, of);
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

    /// Lists the tiles of a kind. Returns how many there are.
    fn pack_tiles(&mut self, slot: u32, grid: &Grid, kind: TileKind) -> u32 {
        let before = self.tiles.len();
        let land = grid.land.as_ref().filter(|land| land.ground.cells.is_some());
        if kind.mixed && land.is_none() {
            return 0;
        }
        let of = if kind.mixed { Class::Mixed } else { Class::Plain };
        let (corner, thickness) = (grid.torus_corner(), grid.profile().thickness);
        let inner = |k: usize, tile: usize| {
            let cell = (tile * TILE + grid.torus[k] - corner[k] as usize) % grid.torus[k];
            cell > thickness && cell + TILE + thickness < grid.desc.cells[k] as usize
        };
        for row in 0..grid.torus[1] / TILE {
            for column in 0..grid.torus[0] / TILE {
                let wanted = (inner(0, column) && inner(1, row)) != kind.layer;
                if wanted && land.map_or(Class::Plain, |land| land.class([column, row], grid.torus)) == of {
                    self.pack_tile(slot, (column | row << 8) as u32, kind.mixed);
                }
            }
        }
        (self.tiles.len() - before) as u32
    }

    fn pack_tile(&mut self, slot: u32, place: u32, mixed: bool) {
        let first_source = self.sources.len() as u32;
        let start = self.placed.partition_point(|(tile, _)| *tile < (slot, place));
        let own = self.placed[start..].iter().take_while(|(tile, _)| *tile == (slot, place));
        self.sources.extend(own.map(|(_, source)| *source));
        let source_count = self.sources.len() as u32 - first_source;
        self.tiles.push(GridTile { place: place | slot << 16, first_source, source_count, mixed: u32::from(mixed) });
    }

    /// Lists the grid's sources by tile, each tile's in the order they were added.
    fn place_sources(&mut self, slot: u32, grid: &Grid) {
        let corner = grid.place.window.corner;
        for (Footprint { center, shape, height, foam, range, .. }, placed_at) in &grid.sources {
            let Shape::Disc { outer, stretch } = shape else { continue };
            let since: [i64; 2] = std::array::from_fn(|k| corner[k] - placed_at[k]);
            let source = GridSource {
                center: std::array::from_fn(|k| center[k] - since[k] as f32),
                outer: *outer,
                height: *height,
                foam: *foam,
                stretch: *stretch,
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
        peak: profile.peak[0],
        weights: [(grid.stepping.a[0] * straight) as f32, (grid.stepping.a[0] * beside) as f32],
        damping: (0.5 * f64::from(grid.desc.damping) * grid.stepping.dt) as f32,
        foam_scale: grid.law.scale,
        foam_onset: grid.law.onset,
        foam_growth: grid.law.growth,
        foam_keep: grid.law.keep,
        deep: grid.law.deep,
        foam_depth: grid.law.depth,
        foam_splash: grid.law.splash,
        peak_z: profile.peak[1],
        aspect: grid.law.aspect,
    }
}

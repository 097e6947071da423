//! Turns a tick of all grids into what the passes read: parameters, tiles, sources.

use open_water_shaders::grid::{
    CLEARED, FORCED, GridCell, GridParams, GridSource, GridTile, GridWaterCell, KINDS, MEDIUM_THREADS, MIXED_TILE,
    SCHEDULE_THREADS, SHIFTED, SOLID, STOOD, TickParams, TickWater, WATER_LIST, WATER_PREPARE_LIST,
};

use bytemuck::Zeroable;

use super::GpuGridId;
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

impl TileKind {
    /// The kind of a list.
    fn of(list: usize) -> Self {
        Self { layer: list & 1 != 0, mixed: list & 2 != 0 }
    }
}

/// A queued tick.
#[derive(Debug, Default)]
pub(super) struct Tick {
    pub(super) params: TickParams,
    /// All tiles of the awake grids; their sources are counted from the tick's first.
    pub(super) tiles: Vec<GridTile>,
    pub(super) sources: Vec<GridSource>,
    /// What to store of the medium.
    pub(super) cells: Vec<GridCell>,
    /// The same of dispersive grids.
    pub(super) water_cells: Vec<GridWaterCell>,
    /// Of dispersive grids, if there are any.
    pub(super) water: Option<Box<TickWater>>,
    /// Where its tiles, cells and dispersive grids' cells begin in the upload.
    pub(super) first: [u32; 3],
    /// There are grids of the wave equation.
    waves: bool,
    /// One of them moved.
    moved: bool,
    /// A tile of theirs is mixed.
    medium: bool,
    /// A tile of a dispersive grid is mixed.
    water_medium: bool,
    pub(super) substeps: Vec<Substep>,
    /// Which grid stands at each place of its parameters, and the number of its tick.
    pub(super) grids: Vec<(GpuGridId, u64)>,
}

/// A sub-step covers the grids that have so many.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Substep {
    /// Whether a grid has tiles for each list.
    lists: [bool; KINDS as usize],
    /// It is the last of some grid.
    last: bool,
    /// There are dispersive grids, and it is the last of some of them.
    water: bool,
    water_last: bool,
}

/// A pipeline.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Medium,
    Schedule,
    Prepare { moved: bool, medium: bool },
    Step { tiles: TileKind, last: bool },
    WaterMedium,
    WaterPrepare,
    WaterStep { mixed: bool, last: bool },
}

/// How many workgroups a dispatch has.
#[derive(Debug, Clone, Copy)]
pub(super) enum Groups {
    Counted(u32),
    /// As many as the tick's schedule found for a list.
    Listed(u32),
}

/// What a dispatch runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Work {
    pub(super) kind: Kind,
    /// First tile or cell, how many tiles the tick has or cells there are, sub-step.
    pub(super) first: u32,
    pub(super) count: u32,
    pub(super) substep: u32,
    pub(super) groups: Groups,
}

impl Tick {
    /// The tick's dispatches in order.
    pub(super) fn dispatches(&self) -> impl Iterator<Item = Work> {
        let [count, cells, water_cells] =
            [self.tiles.len(), self.cells.len(), self.water_cells.len()].map(|n| n as u32);
        let [first_tile, first_cell, first_water_cell] = self.first;
        let stored = |kind, first, count: u32| {
            let groups = Groups::Counted(count.div_ceil(MEDIUM_THREADS));
            (count > 0).then_some(Work { kind, first, count, substep: 0, groups })
        };
        let medium = stored(Kind::Medium, first_cell, cells);
        let water_medium = stored(Kind::WaterMedium, first_water_cell, water_cells);
        let groups = Groups::Counted(count.div_ceil(SCHEDULE_THREADS));
        let schedule = Work { kind: Kind::Schedule, first: first_tile, count, substep: 0, groups };
        let listed =
            move |kind, list, substep| Work { kind, first: list * count, count, substep, groups: Groups::Listed(list) };
        let prepare = listed(Kind::Prepare { moved: self.moved, medium: self.medium }, KINDS, 0);
        let water_prepare = listed(Kind::WaterPrepare, WATER_PREPARE_LIST, 0);
        let mixed = self.water_medium;
        let steps = (0..).zip(&self.substeps).flat_map(move |(substep, own)| {
            let Substep { lists, last, water, water_last } = *own;
            let waves = (0..KINDS)
                .filter(move |list| lists[*list as usize])
                .map(move |list| listed(Kind::Step { tiles: TileKind::of(list as usize), last }, list, substep));
            let water = water.then(|| listed(Kind::WaterStep { mixed, last: water_last }, WATER_LIST, substep));
            waves.chain(water)
        });
        let prepared =
            [self.waves.then_some(prepare), self.water.is_some().then_some(water_prepare)].into_iter().flatten();
        medium.into_iter().chain(water_medium).chain([schedule]).chain(prepared).chain(steps)
    }
}

/// Makes ticks.
#[derive(Debug, Default)]
pub(super) struct Packer {
    /// What the tick in the making holds.
    tiles: Vec<GridTile>,
    sources: Vec<GridSource>,
    cells: Vec<GridCell>,
    water_cells: Vec<GridWaterCell>,
    /// ((grid, place of a tile), source).
    placed: Vec<((u32, u32), GridSource)>,
    /// (grid, place of a tile) with a source in it or beside it.
    forced: Vec<(u32, u32)>,
}

impl Packer {
    /// Takes the memory of ticks that are done with.
    pub(super) fn reuse(&mut self, ticks: impl Iterator<Item = Tick>) {
        for tick in ticks {
            if tick.tiles.capacity() > self.tiles.capacity() {
                self.tiles = tick.tiles;
                self.tiles.clear();
            }
        }
    }

    /// Makes one tick, and moves the grids on.
    pub(super) fn pack(&mut self, grids: &mut [Grid]) -> Tick {
        let mut order: Vec<usize> = (0..grids.len()).filter(|g| grids[*g].awake > 0).collect();
        order.sort_by_key(|g| std::cmp::Reverse(grids[*g].stepping.substeps));
        let most = order.first().map_or(0, |g| grids[*g].stepping.substeps);
        let mut tick = Tick { substeps: vec![Substep::default(); most as usize], ..Tick::default() };
        if order.is_empty() {
            return tick;
        }
        self.placed.clear();
        self.forced.clear();
        for (slot, g) in order.iter().enumerate() {
            let grid = &mut grids[*g];
            // The last tick of a grid stills it, unless the GPU's own word has ever come back.
            grid.awake -= u32::from(grid.awake > 1 || grid.active.is_none());
            grid.clear |= grid.awake == 0;
            tick.params[slot] = packed(grid);
            let (corner, width) = (grid.torus_corner(), grid.desc.border.width());
            if let Some(water) = &mut grid.water {
                let of_tick = tick.water.get_or_insert_with(|| Box::new(TickWater::zeroed()));
                of_tick[slot] = water.packed(corner, width);
                if let Some(land) = &mut grid.land {
                    land.upload_water(slot as u32, grid.torus, &mut self.water_cells);
                }
            } else {
                tick.waves = true;
                tick.moved |= tick.params[slot].moved != STOOD;
                if let Some(land) = &mut grid.land {
                    land.upload(slot as u32, grid.torus, &mut self.cells);
                }
            }
            self.place_sources(slot as u32, grid);
        }
        self.placed.sort_by_key(|(tile, _)| *tile);
        self.forced.sort_unstable();
        let mut lists = [false; KINDS as usize];
        for (slot, g) in order.iter().enumerate() {
            let grid = &grids[*g];
            let mut of_grid = [false; KINDS as usize];
            self.pack_tiles(slot as u32, grid, &mut of_grid);
            tick.grids.push((GpuGridId(*g), grid.ticks));
            let water = grid.water.is_some();
            if water {
                tick.water_medium |= of_grid[2] || of_grid[3];
            } else {
                lists.iter_mut().zip(of_grid).for_each(|(any, own)| *any |= own);
            }
            let own = grid.stepping.substeps as usize;
            for (k, substep) in tick.substeps.iter_mut().take(own).enumerate() {
                substep.lists = lists;
                substep.last |= !water && k + 1 == own;
                substep.water |= water;
                substep.water_last |= water && k + 1 == own;
            }
        }
        tick.medium = lists[2] || lists[3];
        tick.tiles = std::mem::take(&mut self.tiles);
        tick.sources = std::mem::take(&mut self.sources);
        tick.cells = std::mem::take(&mut self.cells);
        tick.water_cells = std::mem::take(&mut self.water_cells);
        for g in order {
            let grid = &mut grids[g];
            grid.parity = (grid.parity + grid.stepping.substeps) & 1;
            grid.flip ^= 1;
            grid.ticks += 1;
            grid.shift = [0; 2];
            grid.clear = false;
            grid.moving &= grid.awake > 0;
            grid.sources.clear();
        }
        tick
    }

    /// Lists a grid's tiles, and notes which lists of tiles to be stepped they are for.
    fn pack_tiles(&mut self, slot: u32, grid: &Grid, lists: &mut [bool; KINDS as usize]) {
        let land = grid.land.as_ref().filter(|land| land.ground.cells.is_some());
        let (corner, thickness) = (grid.torus_corner(), grid.profile().thickness);
        let inner = |k: usize, tile: usize| {
            let cell = (tile * TILE + grid.torus[k] - corner[k] as usize) % grid.torus[k];
            cell > thickness && cell + TILE + thickness < grid.desc.cells[k] as usize
        };
        for row in 0..grid.torus[1] / TILE {
            for column in 0..grid.torus[0] / TILE {
                let layer = !(inner(0, column) && inner(1, row));
                let class = land.map_or(Class::Plain, |land| land.class([column, row], grid.torus));
                let list = usize::from(layer) + 2 * usize::from(class == Class::Mixed);
                lists[list] |= class != Class::Solid;
                let more = match class {
                    Class::Plain => 0,
                    Class::Mixed => MIXED_TILE,
                    Class::Solid => SOLID,
                };
                let water = grid.water.as_ref().map_or(0, |water| water.flags(column, row));
                self.pack_tile(slot, (column | row << 8) as u32, list as u32 | more | water);
            }
        }
    }

    fn pack_tile(&mut self, slot: u32, place: u32, flags: u32) {
        let first_source = self.sources.len() as u32;
        let start = self.placed.partition_point(|(tile, _)| *tile < (slot, place));
        let own = self.placed[start..].iter().take_while(|(tile, _)| *tile == (slot, place));
        self.sources.extend(own.map(|(_, source)| *source));
        let source_count = self.sources.len() as u32 - first_source;
        let forced = if self.forced.binary_search(&(slot, place)).is_ok() { FORCED } else { 0 };
        self.tiles.push(GridTile { place: place | slot << 16, first_source, source_count, flags: flags | forced });
    }

    /// Lists the grid's sources by tile, each tile's in the order they were added.
    fn place_sources(&mut self, slot: u32, grid: &Grid) {
        let corner = grid.place.window.corner;
        let per_head = f64::from(grid.stepping.substeps) * grid.stepping.a[0];
        for (Footprint { center, shape, height, head, foam, range }, placed_at) in &grid.sources {
            let Shape::Disc { outer, stretch } = shape else { continue };
            let since: [i64; 2] = std::array::from_fn(|k| corner[k] - placed_at[k]);
            let source = GridSource {
                center: std::array::from_fn(|k| center[k] - since[k] as f32),
                outer: *outer,
                height: *height,
                foam: *foam,
                stretch: *stretch,
                kick: (per_head * f64::from(*head)) as f32,
                pad: 0.0,
            };
            let tiles: [std::ops::RangeInclusive<i64>; 2] = std::array::from_fn(|k| {
                let world = |cell: usize| (cell as i64 + placed_at[k]).div_euclid(TILE as i64);
                world(range[k][0])..=world(range[k][1] - 1)
            });
            let on_torus = |k: usize, tile: i64| tile.rem_euclid((grid.torus[k] / TILE) as i64) as u32;
            for row in tiles[1].start() - 1..=tiles[1].end() + 1 {
                for column in tiles[0].start() - 1..=tiles[0].end() + 1 {
                    let place = (slot, on_torus(0, column) | on_torus(1, row) << 8);
                    self.forced.push(place);
                    if tiles[0].contains(&column) && tiles[1].contains(&row) {
                        self.placed.push((place, source));
                    }
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
        flip: grid.flip,
        pad: [0; 3],
    }
}

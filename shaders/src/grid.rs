//! Passes of the grids: `grid_schedule` lists the tiles to be stepped, `grid_prepare` moves the window and adds sources,
//! `grid_step` advances one sub-step; `grid_draw` writes what is drawn, `grid_query` samples, `grid_medium` stores what the
//! water lies in where it is not plain.
//!
//! A grid's cells stand on a torus: world cell c is stored at c mod torus, so a window that shifts copies nothing. All
//! grids share three buffers, heights (z, z, previous, foam), memory (phi_x, phi_x, phi_z, phi_z) and medium (a, r; empty
//! while all grids lie in plain water). Tiles of 16 x 16 cells carry marks: what their last step found. All tiles that are
//! to be stepped stand in one list a kind; a thread steps a strip of eight columns of a tile.
//!
//! Choices are made by `override` constants and `select`, not by branches: a software adapter runs both sides of a
//! branch, skipping their loads and stores only, and its cost follows the number of these, however wide. There a thread
//! walks up all 16 rows of a tile and keeps rows in registers (5.2 ms at 512 x 512 with a row a thread, 2.5 so), on a
//! GPU it takes a row.

mod params;
mod water;

use crate::{Pass, surface::MAX_GRIDS};

use params::{DRAW_PARAMS, PARAMS, QUERY_PARAMS, SCHEDULE_PARAMS};
pub use params::{
    GridCell, GridDispatch, GridDraw, GridHole, GridParams, GridQueries, GridQuery, GridSource, GridTile, TickParams,
};
pub use water::{
    FACE_ARRAYS, FIELD_ARRAYS, FRESH_X, FRESH_Z, GridWater, GridWaterCell, NO_SLOT, SLOT_X_BIT, SLOT_X_VECTORS,
    SLOT_Z_BIT, SLOT_Z_VECTORS, TickWater, WATER, WATER_LIST, WATER_MEDIUM, WATER_PREPARE, WATER_PREPARE_LIST,
    WATER_STEP,
};

/// Cells along one side of a tile.
pub const TILE: u32 = 16;
/// Most holes that are cut out of a grid.
pub const MAX_HOLES: usize = 8;
/// Threads of a workgroup that prepares a tile.
pub const TILE_THREADS: u32 = TILE * TILE / 4;
/// Threads along x of `grid_draw`.
pub const DRAW_THREADS: u32 = 64;
/// Largest height in either direction that a source can reach, metres.
pub const HEIGHT_LIMIT: f32 = 100.0;
/// Values below this are set to zero: decaying waves must not reach denormals, which are many times slower.
pub const TINY: f32 = 1e-20;
/// Arrays of the heights buffer and of the memory buffer, per grid.
pub const ARRAYS: u32 = 4;
/// Arrays of the medium buffer, per grid.
pub const MEDIUM_ARRAYS: u32 = 2;
/// Threads of `grid_query`, a point each.
pub const QUERY_THREADS: u32 = 64;
/// Threads of `grid_medium`, a cell each.
pub const MEDIUM_THREADS: u32 = 64;
/// [`GridDraw::medium`] of a grid that lies in plain water.
pub const NO_MEDIUM: u32 = u32::MAX;

/// [`GridParams::moved`]: the window stands.
pub const STOOD: u32 = 0;
/// [`GridParams::moved`]: the window shifted.
pub const SHIFTED: u32 = 1;
/// [`GridParams::moved`]: nothing of the old window remains.
pub const CLEARED: u32 = 2;

/// Waves below this height (metres) are let go: 0.01 mm.
pub const QUIET_HEIGHT: f32 = 1e-5;
/// Foam below this is let go.
pub const QUIET_FOAM: f32 = 1e-3;

/// [`GridTile::flags`]: stepped in this tick, whatever its marks.
pub const FORCED: u32 = 64;
/// [`GridTile::flags`]: never stepped.
pub const SOLID: u32 = 128;
/// [`GridTile::flags`]: the medium is to be looked at.
pub const MIXED_TILE: u32 = 32;
/// Lists of tiles of the wave equation to be stepped, one a kind; the next list is of those to be prepared, then come
/// [`WATER_LIST`] and [`WATER_PREPARE_LIST`].
pub const KINDS: u32 = 4;
/// Lists in all.
pub const LIST_COUNT: u32 = KINDS + 4;
/// Words of a tick's counts: for each list three numbers of workgroups and one of tiles, then a grid's tiles each.
pub const COUNT_WORDS: u32 = ACTIVE_WORD + MAX_GRIDS as u32;
/// Where in a tick's counts the tiles of each grid are.
pub const ACTIVE_WORD: u32 = 4 * LIST_COUNT;
/// Threads of `grid_schedule`, a tile each.
pub const SCHEDULE_THREADS: u32 = 64;

/// How threads share the tiles in `grid_step`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepShape {
    /// `override ROWS`: rows of a tile that a thread walks.
    pub rows: u32,
    /// `override THREADS`: threads of a workgroup, a multiple of those of a tile.
    pub threads: u32,
}

impl StepShape {
    /// For adapters whose memory likes neighbours to load neighbours.
    pub const GPU: Self = Self { rows: 1, threads: 64 };
    /// For software adapters: as few loads as possible, eight threads in a vector.
    pub const SOFTWARE: Self = Self { rows: 16, threads: 8 };

    /// Tiles of a workgroup.
    pub const fn tiles(self) -> u32 {
        self.threads * self.rows / (2 * TILE)
    }
}

fn constants() -> String {
    format!(
        "const TILE: u32 = {TILE}u;\nconst TILE_THREADS: u32 = {TILE_THREADS}u;\n\
         const HEIGHT_LIMIT: f32 = {HEIGHT_LIMIT:?};\nconst TINY: f32 = {TINY:?};\n\
         const MAX_GRIDS: u32 = {MAX_GRIDS}u;\nconst MEDIUM_THREADS: u32 = {MEDIUM_THREADS}u;\n\
         const STOOD: u32 = {STOOD}u;\nconst SHIFTED: u32 = {SHIFTED}u;\nconst CLEARED: u32 = {CLEARED}u;\n\
         const QUIET_HEIGHT: f32 = {QUIET_HEIGHT:?};\nconst QUIET_FOAM: f32 = {QUIET_FOAM:?};\n\
         const BUSY: u32 = 1u;\nconst FOAMED: u32 = 2u;\nconst STEPPED: u32 = 4u;\n\
         const PREPARED: u32 = 8u;\nconst ENDING: u32 = 16u;\n\
         const FORCED: u32 = {FORCED}u;\nconst SOLID: u32 = {SOLID}u;\nconst MIXED_TILE: u32 = {MIXED_TILE}u;\n\
         const KIND_MASK: u32 = {}u;\nconst PREPARE_LIST: u32 = {KINDS}u;\nconst ACTIVE_WORD: u32 = {ACTIVE_WORD}u;\n\
         const SCHEDULE_THREADS: u32 = {SCHEDULE_THREADS}u;\n{}",
        KINDS - 1,
        water::constants()
    )
}

fn draw_constants() -> String {
    format!(
        "const DRAW_THREADS: u32 = {DRAW_THREADS}u;\nconst MAX_GRIDS: u32 = {MAX_GRIDS}u;\n\
         const MAX_HOLES: u32 = {MAX_HOLES}u;\nconst NO_MEDIUM: u32 = {NO_MEDIUM}u;\nconst QUERY_THREADS: u32 = {QUERY_THREADS}u;\n"
    )
}

const SHARED: &str = include_str!("../wgsl/shared/grid.wgsl");
const LISTS: &str = include_str!("../wgsl/shared/grid_lists.wgsl");

/// Stores the medium of listed cells, and stills those that are not open water.
pub const MEDIUM: Pass = Pass {
    name: "grid_medium",
    constants,
    parts: &[SHARED, LISTS, include_str!("../wgsl/grid_medium.wgsl")],
    entry_points: &["grid_medium"],
    params: PARAMS,
};

/// Lists the tiles to be stepped and to be prepared. `override TILES_PER_GROUP` is that of the steps' [`StepShape`].
pub const SCHEDULE: Pass = Pass {
    name: "grid_schedule",
    constants,
    parts: &[SHARED, include_str!("../wgsl/grid_schedule.wgsl")],
    entry_points: &["grid_schedule"],
    params: SCHEDULE_PARAMS,
};

/// Moves the window, keeps the last tick's heights, adds sources. `override MOVED` tells whether a grid among those covered
/// moved, `override MEDIUM` whether a tile among them is mixed.
pub const PREPARE: Pass = Pass {
    name: "grid_prepare",
    constants,
    parts: &[SHARED, LISTS, include_str!("../wgsl/grid_prepare.wgsl")],
    entry_points: &["grid_prepare"],
    params: PARAMS,
};

/// One sub-step. `override LAYER` tells whether the tiles may have cells of the layer, `override LAST` whether it may
/// be a covered grid's last, `override MIXED` whether the medium varies in them, `ROWS` and `THREADS` are those of a
/// [`StepShape`].
pub const STEP: Pass = Pass {
    name: "grid_step",
    constants,
    parts: &[
        SHARED,
        LISTS,
        include_str!("../wgsl/shared/grid_rows.wgsl"),
        include_str!("../wgsl/shared/grid_flux.wgsl"),
        include_str!("../wgsl/shared/grid_layer.wgsl"),
        include_str!("../wgsl/shared/grid_foam.wgsl"),
        include_str!("../wgsl/shared/grid_advance.wgsl"),
        include_str!("../wgsl/grid_step.wgsl"),
    ],
    entry_points: &["grid_step"],
    params: PARAMS,
};

/// Height and foam as drawn. `override MEDIUM` tells whether a grid among them has walls, `override HOLES` whether one has
/// holes.
pub const DRAW: Pass = Pass {
    name: "grid_draw",
    constants: draw_constants,
    parts: &[include_str!("../wgsl/shared/grid_ghost.wgsl"), include_str!("../wgsl/grid_draw.wgsl")],
    entry_points: &["grid_draw"],
    params: DRAW_PARAMS,
};

/// Heights, slopes and vertical velocities at points. `override MEDIUM` tells whether a grid among them has walls.
pub const QUERY: Pass = Pass {
    name: "grid_query",
    constants: draw_constants,
    parts: &[
        include_str!("../wgsl/shared/cubic.wgsl"),
        include_str!("../wgsl/shared/grid_ghost.wgsl"),
        include_str!("../wgsl/grid_query.wgsl"),
    ],
    entry_points: &["grid_query"],
    params: QUERY_PARAMS,
};

/// The passes of this area.
pub const PASSES: &[Pass] = &[MEDIUM, SCHEDULE, PREPARE, STEP, WATER_MEDIUM, WATER_PREPARE, WATER_STEP, DRAW, QUERY];

//! Passes of the grids: `grid_prepare` moves the window, remembers the last tick and adds sources, `grid_step` advances
//! one sub-step, `grid_draw` writes what is drawn; `grid_medium` stores what the water lies in where it is not plain.
//!
//! A grid's cells stand on a torus: world cell c is stored at c mod torus, so a window that shifts copies nothing. All
//! grids share three buffers, heights (z, z, previous, foam), memory (phi_x, phi_x, phi_z, phi_z) and medium (a, r; empty
//! while all grids lie in plain water). All tiles of 16 x 16
//! cells that are to be stepped stand in one list; a thread steps a strip of eight columns of a tile.
//!
//! Choices are made by `override` constants and `select`, not by branches: a software adapter runs both sides of a
//! branch, and its cost follows the number of loads and stores, however wide. There a thread walks up all 16 rows of a
//! tile and keeps rows in registers (5.2 ms at 512 x 512 with a row a thread, 2.5 so), on a GPU it takes a row.

use bytemuck::{Pod, Zeroable};

use crate::{Pass, param_layout, surface::MAX_GRIDS};

/// Cells along one side of a tile.
pub const TILE: u32 = 16;
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

/// A grid in one tick.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridParams {
    /// Where the window's cell (0, 0) is stored.
    pub corner: [u32; 2],
    /// Cells of the window.
    pub cells: [u32; 2],
    /// Cells of the torus, multiples of 16.
    pub torus: [u32; 2],
    /// Shift of this tick: cell i held before what is now at i - shift.
    pub shift: [i32; 2],
    /// First `vec4` of the grid's arrays.
    pub base: u32,
    /// `vec4`s of one array.
    pub stride: u32,
    /// Which of the two levels holds the current state as the tick begins.
    pub parity: u32,
    /// Sub-steps of a tick.
    pub substeps: u32,
    /// [`STOOD`], [`SHIFTED`] or [`CLEARED`].
    pub moved: u32,
    /// Thickness W of the border layer, cells.
    pub thickness: u32,
    /// Exponent of its profile, 3 or 4.
    pub exponent: u32,
    /// Z at its outer edge along x.
    pub peak: f32,
    /// a w0 and a w1 along x.
    pub weights: [f32; 2],
    /// sigma dt / 2.
    pub damping: f32,
    /// Foam: excess per metre of Laplacian.
    pub foam_scale: f32,
    /// Foam: where the excess begins.
    pub foam_onset: f32,
    /// Foam: growth in a tick.
    pub foam_growth: f32,
    /// Foam: factor left after a tick.
    pub foam_keep: f32,
    /// a of deep water along x.
    pub deep: f32,
    /// Foam over a bed: height at which waves of deep water's a begin to break, metres.
    pub foam_depth: f32,
    /// Foam at walls: full rate per metre of rise in a sub-step.
    pub foam_splash: f32,
    /// Z at the layer's outer edge along z.
    pub peak_z: f32,
    /// a along z over a along x.
    pub aspect: f32,
}

/// The grids of one tick, those with the most sub-steps first.
pub type TickParams = [GridParams; MAX_GRIDS];

/// A tile to be stepped in one tick: a `vec4<u32>` in WGSL, of which a step reads the first component only.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridTile {
    /// Tile on the torus, and its grid's place in [`TickParams`]: column + 2^8 row + 2^16 grid.
    pub place: u32,
    /// First of its sources.
    pub first_source: u32,
    /// How many.
    pub source_count: u32,
    /// 1 where the medium is to be looked at.
    pub mixed: u32,
}

/// What a cell lies in, as uploaded.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridCell {
    /// Cell on the torus, row-major, and its grid's place in [`TickParams`]: cell + 2^24 grid.
    pub place: u32,
    /// (c dt / h)^2 along x; at most 0 for a wall, 0 for one beside water.
    pub a: f32,
    /// 1 / (1 + sigma dt / 2); 0 for what is not open water.
    pub r: f32,
    /// Padding.
    pub pad: u32,
}

/// A source as a tile sees it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridSource {
    /// Centre, cells from the window's corner.
    pub center: [f32; 2],
    /// Where it ends along x, cells.
    pub outer: f32,
    /// Height in the middle, metres.
    pub height: f32,
    /// Foam in the middle.
    pub foam: f32,
    /// Reach along x over reach along z, in cells.
    pub stretch: f32,
}

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

/// Which dispatch this is.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridDispatch {
    /// First tile of the list.
    pub first: u32,
    /// Sub-step within the tick.
    pub substep: u32,
    /// How many there are; for `grid_medium` these are cells.
    pub count: u32,
    /// Padding.
    pub pad: u32,
}

/// A grid to be drawn.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridDraw {
    /// Where the window's cell (0, 0) is stored.
    pub corner: [u32; 2],
    /// Cells of the window.
    pub cells: [u32; 2],
    /// Cells of the torus.
    pub torus: [u32; 2],
    /// Middle of the fade, cells from the corner.
    pub middle: [f32; 2],
    /// Distance from the middle where the fade reaches zero, cells.
    pub outer: [f32; 2],
    /// Width of the fade, cells.
    pub width: f32,
    /// Between the tick before (0) and the last one (1).
    pub alpha: f32,
    /// First `f32` of the current heights.
    pub now: u32,
    /// First `f32` of the heights before.
    pub previous: u32,
    /// First `f32` of the foam.
    pub foam: u32,
    /// First element in the pool.
    pub out: u32,
    /// First `f32` of its a in the medium, or [`NO_MEDIUM`].
    pub medium: u32,
    /// Padding.
    pub pad: [u32; 3],
}

const PARAMS: &[crate::ParamLayout] = &[
    param_layout!(GridParams {
        corner,
        cells,
        torus,
        shift,
        base,
        stride,
        parity,
        substeps,
        moved,
        thickness,
        exponent,
        peak,
        weights,
        damping,
        foam_scale,
        foam_onset,
        foam_growth,
        foam_keep,
        deep,
        foam_depth,
        foam_splash,
        peak_z,
        aspect
    }),
    param_layout!(GridSource { center, outer, height, foam, stretch }),
    param_layout!(GridDispatch { first, substep, count, pad }),
    param_layout!(GridCell { place, a, r, pad }),
];

const DRAW_PARAMS: &[crate::ParamLayout] = &[param_layout!(GridDraw {
    corner,
    cells,
    torus,
    middle,
    outer,
    width,
    alpha,
    now,
    previous,
    foam,
    out,
    medium,
    pad
})];

fn constants() -> String {
    format!(
        "const TILE: u32 = {TILE}u;\nconst TILE_THREADS: u32 = {TILE_THREADS}u;\n\
         const HEIGHT_LIMIT: f32 = {HEIGHT_LIMIT:?};\nconst TINY: f32 = {TINY:?};\n\
         const MAX_GRIDS: u32 = {MAX_GRIDS}u;\nconst MEDIUM_THREADS: u32 = {MEDIUM_THREADS}u;\n\
         const SHIFTED: u32 = {SHIFTED}u;\nconst CLEARED: u32 = {CLEARED}u;\n"
    )
}

fn draw_constants() -> String {
    format!(
        "const DRAW_THREADS: u32 = {DRAW_THREADS}u;\nconst MAX_GRIDS: u32 = {MAX_GRIDS}u;\n\
         const NO_MEDIUM: u32 = {NO_MEDIUM}u;\n"
    )
}

const SHARED: &str = include_str!("../wgsl/shared/grid.wgsl");

/// Stores the medium of listed cells, and stills those that are not open water.
pub const MEDIUM: Pass = Pass {
    name: "grid_medium",
    constants,
    parts: &[SHARED, include_str!("../wgsl/grid_medium.wgsl")],
    entry_points: &["grid_medium"],
    params: PARAMS,
};

/// Moves the window, keeps the last tick's heights, adds sources. `override MOVED` tells whether a grid among those covered
/// moved, `override MEDIUM` whether a tile among them is mixed.
pub const PREPARE: Pass = Pass {
    name: "grid_prepare",
    constants,
    parts: &[SHARED, include_str!("../wgsl/grid_prepare.wgsl")],
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
        include_str!("../wgsl/shared/grid_rows.wgsl"),
        include_str!("../wgsl/shared/grid_flux.wgsl"),
        include_str!("../wgsl/shared/grid_layer.wgsl"),
        include_str!("../wgsl/shared/grid_advance.wgsl"),
        include_str!("../wgsl/grid_step.wgsl"),
    ],
    entry_points: &["grid_step"],
    params: PARAMS,
};

/// Height and foam as drawn. `override MEDIUM` tells whether a grid among them has walls.
pub const DRAW: Pass = Pass {
    name: "grid_draw",
    constants: draw_constants,
    parts: &[include_str!("../wgsl/grid_draw.wgsl")],
    entry_points: &["grid_draw"],
    params: DRAW_PARAMS,
};

/// The passes of this area.
pub const PASSES: &[Pass] = &[MEDIUM, PREPARE, STEP, DRAW];

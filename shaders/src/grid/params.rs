//! What the grid passes and the CPU hand each other.

use bytemuck::{Pod, Zeroable};

use super::MAX_HOLES;
use crate::{param_layout, surface::MAX_GRIDS};

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
    /// [`super::STOOD`], [`super::SHIFTED`] or [`super::CLEARED`].
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
    /// Which of its tiles' two sets of marks this tick writes.
    pub flip: u32,
    /// Padding.
    pub pad: [u32; 3],
}

/// The grids of one tick, those with the most sub-steps first.
pub type TickParams = [GridParams; MAX_GRIDS];

/// A tile that may be stepped in one tick: a `vec4<u32>` in WGSL.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridTile {
    /// Tile on the torus, and its grid's place in [`TickParams`]: column + 2^8 row + 2^16 grid.
    pub place: u32,
    /// First of its sources.
    pub first_source: u32,
    /// How many.
    pub source_count: u32,
    /// Which list it is for, 0 to 3, and [`super::FORCED`], [`super::SOLID`], [`super::MIXED_TILE`].
    pub flags: u32,
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
    /// What the potential of a dispersive grid falls by in the middle, metres.
    pub kick: f32,
    /// Padding.
    pub pad: f32,
}

/// Which dispatch this is.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridDispatch {
    /// First tile or cell of the list.
    pub first: u32,
    /// Sub-step within the tick.
    pub substep: u32,
    /// Tiles of the tick; for `grid_medium` cells.
    pub count: u32,
    /// First word of the dispatch's counts; for `grid_schedule` of the tick's.
    pub work: u32,
}

/// Where a finer grid is seen instead.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridHole {
    /// Where its fade reaches zero, cells from the corner.
    pub low: [f32; 2],
    /// The same on the high sides.
    pub high: [f32; 2],
    /// Cells over which it rises.
    pub rise: [f32; 2],
    /// Factor on it.
    pub gain: f32,
    /// Padding.
    pub pad: f32,
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
    /// First `f32` of its a in the medium, or [`super::NO_MEDIUM`].
    pub medium: u32,
    /// How many of the holes count.
    pub hole_count: u32,
    /// Padding.
    pub pad: [u32; 2],
    /// What finer grids show.
    pub holes: [GridHole; MAX_HOLES],
}

/// A grid to be sampled.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridQuery {
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
    /// Cells per metre.
    pub scale: [f32; 2],
    /// The local origin, cells from the corner.
    pub offset: [f32; 2],
    /// Width of the fade, cells.
    pub width: f32,
    /// Sub-steps per second.
    pub rate: f32,
    /// First `f32` of the current heights.
    pub now: u32,
    /// First `f32` of those a sub-step before.
    pub old: u32,
    /// First `f32` of its a in the medium, or [`super::NO_MEDIUM`].
    pub medium: u32,
    /// Padding.
    pub pad: u32,
}

/// What a query asks.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridQueries {
    /// Points.
    pub points: u32,
    /// Grids.
    pub grids: u32,
    /// Padding.
    pub pad: [u32; 2],
    /// The grids.
    pub list: [GridQuery; MAX_GRIDS],
}

const GRID: crate::ParamLayout = param_layout!(GridParams {
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
    aspect,
    flip,
    pad
});
const DISPATCH: crate::ParamLayout = param_layout!(GridDispatch { first, substep, count, work });

/// Of passes without lists.
pub(super) const SCHEDULE_PARAMS: &[crate::ParamLayout] = &[GRID, DISPATCH];
/// Of passes with lists.
pub(super) const PARAMS: &[crate::ParamLayout] = &[
    GRID,
    DISPATCH,
    param_layout!(GridSource { center, outer, height, foam, stretch, kick, pad }),
    param_layout!(GridCell { place, a, r, pad }),
];

pub(super) const DRAW_PARAMS: &[crate::ParamLayout] = &[
    param_layout!(GridDraw {
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
        hole_count,
        pad,
        holes
    }),
    param_layout!(GridHole { low, high, rise, gain, pad }),
];

pub(super) const QUERY_PARAMS: &[crate::ParamLayout] = &[
    param_layout!(GridQuery { corner, cells, torus, middle, outer, scale, offset, width, rate, now, old, medium, pad }),
    param_layout!(GridQueries { points, grids, pad, list }),
];

//! Passes of grids of the dispersive scheme: `grid_water_medium`, `grid_water_prepare` and `grid_water_step` do for them what
//! `grid_medium`, `grid_prepare` and `grid_step` do for those of the wave equation; all else is shared.
//!
//! Heights stand where all grids have theirs, phi and chi_1 where others have the layer's memory, chi_2 and chi_3 in a
//! buffer of fields. Behind these stands what the layer remembers, in slots, of the tiles that lie in it only: along x
//! for tiles near the west and east side, along z for those near the others.

use bytemuck::{Pod, Zeroable};

use super::params::{PARAMS, SCHEDULE_PARAMS};
use super::{KINDS, LIST_COUNT, SHARED, TILE, TILE_THREADS, constants as all_constants};
use crate::{Pass, param_layout, surface::MAX_GRIDS};

/// Fields of a cell: phi and three chi.
const FIELDS: u32 = 4;
/// Arrays of the fields buffer, per grid.
pub const FIELD_ARRAYS: u32 = 4;
/// Arrays of the faces buffer, per grid: of the faces along both axes, and m of each chi.
pub const FACE_ARRAYS: u32 = 3 * FIELDS - 1;
/// `vec4`s of a slot along x: the edges before a tile's cells and the cells, of each field, and the edges after its two halves.
pub const SLOT_X_VECTORS: u32 = 2 * FIELDS * TILE_THREADS + 2 * TILE;
/// `vec4`s of a slot along z: likewise, and the edges above the rows of every thread.
pub const SLOT_Z_VECTORS: u32 = 2 * FIELDS * TILE_THREADS + FIELDS * TILE_THREADS;
/// No slot.
pub const NO_SLOT: u32 = u32::MAX;
/// The list of tiles to be stepped that are open water of one depth; the next is of those that are not, and both are one dispatch.
pub const WATER_LIST: u32 = KINDS + 1;
/// The list of tiles to be prepared.
pub const WATER_PREPARE_LIST: u32 = LIST_COUNT - 1;
/// [`super::GridTile::flags`]: of a grid of the dispersive scheme.
pub const WATER: u32 = 256;
/// [`super::GridTile::flags`]: its slot along x has just become its own.
pub const FRESH_X: u32 = 512;
/// [`super::GridTile::flags`]: its slot along z has just become its own.
pub const FRESH_Z: u32 = 1024;
/// [`super::GridTile::flags`]: from this bit on eight bits tell the column of its slot along x; 255 is none.
pub const SLOT_X_BIT: u32 = 16;
/// [`super::GridTile::flags`]: from this bit on eight bits tell the row of its slot along z; 255 is none.
pub const SLOT_Z_BIT: u32 = 24;

/// What the passes know of a grid in one tick besides [`super::GridParams`].
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridWater {
    /// c, s_1, s_2, s_3 of plain water.
    pub shares: [f32; 4],
    /// G = g dt^2 / h, r_1, r_2, r_3.
    pub rates: [f32; 4],
    /// 1 / (1 + sigma dt / 2), m_1, m_2, m_3 of plain water.
    pub gains: [f32; 4],
    /// sigma dt of the layer at the window's west, east, south and north side.
    pub peaks: [f32; 4],
    /// First `vec4` of its chi_2 in the fields buffer.
    pub fields: u32,
    /// First `vec4` there of its layer's slots along x.
    pub slots_x: u32,
    /// First `vec4` there of its layer's slots along z.
    pub slots_z: u32,
    /// First `vec4` of its faces.
    pub faces: u32,
    /// Cells of the layer.
    pub width: u32,
    /// The layer's shift of frequencies at its inner side, times dt.
    pub alpha: f32,
    /// Sides whose outermost cells keep their fields in a sub-step: bit k, sides as of `peaks`.
    pub left: u32,
    /// Those that keep them as the window shifts.
    pub kept: u32,
}

/// At the places of [`super::TickParams`].
pub type TickWater = [GridWater; MAX_GRIDS];

/// What a cell lies in, as uploaded.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct GridWaterCell {
    /// c, s_1, s_2, s_3 of the face before it along x; 0 beside walls.
    pub along: [f32; 4],
    /// The same along z.
    pub across: [f32; 4],
    /// m of each chi.
    pub m: [f32; 3],
    /// Above zero in water, 0 in walls beside it, below in others.
    pub a: f32,
    /// 1 / (1 + sigma dt / 2); 0 for what is not open water.
    pub r: f32,
    /// As of [`super::GridCell`].
    pub place: u32,
    /// Padding.
    pub pad: [u32; 2],
}

/// What WGSL knows of all this.
pub(super) fn constants() -> String {
    format!(
        "const FIELDS: u32 = {FIELDS}u;\nconst SLOT_X_VECTORS: u32 = {SLOT_X_VECTORS}u;\n\
         const SLOT_Z_VECTORS: u32 = {SLOT_Z_VECTORS}u;\nconst NO_SLOT: u32 = {NO_SLOT}u;\n\
         const WATER_LIST: u32 = {WATER_LIST}u;\nconst WATER_PREPARE_LIST: u32 = {WATER_PREPARE_LIST}u;\n\
         const WATER: u32 = {WATER}u;\nconst FRESH_X: u32 = {FRESH_X}u;\nconst FRESH_Z: u32 = {FRESH_Z}u;\n\
         const SLOT_X_BIT: u32 = {SLOT_X_BIT}u;\nconst SLOT_Z_BIT: u32 = {SLOT_Z_BIT}u;\n\
         const SLOTS_MASK: u32 = {}u;\n",
        0xffff_ffffu32 << SLOT_X_BIT
    )
}

const WATER_SHARED: &str = include_str!("../../wgsl/shared/grid_water.wgsl");
const GRID_WATER: crate::ParamLayout =
    param_layout!(GridWater { shares, rates, gains, peaks, fields, slots_x, slots_z, faces, width, alpha, left, kept });

/// Stores the medium of listed cells, and stills those that are not open water.
pub const WATER_MEDIUM: Pass = Pass {
    name: "grid_water_medium",
    constants: all_constants,
    parts: &[SHARED, WATER_SHARED, include_str!("../../wgsl/grid_water_medium.wgsl")],
    entry_points: &["grid_water_medium"],
    params: &[
        SCHEDULE_PARAMS[0],
        SCHEDULE_PARAMS[1],
        GRID_WATER,
        param_layout!(GridWaterCell { along, across, m, a, r, place, pad }),
    ],
};

/// Moves the window, keeps the last tick's heights, adds sources. `override ROWS` is that of the steps' [`super::StepShape`].
pub const WATER_PREPARE: Pass = Pass {
    name: "grid_water_prepare",
    constants: all_constants,
    parts: &[SHARED, WATER_SHARED, include_str!("../../wgsl/grid_water_prepare.wgsl")],
    entry_points: &["grid_water_prepare"],
    params: &[SCHEDULE_PARAMS[0], SCHEDULE_PARAMS[1], GRID_WATER, PARAMS[2]],
};

/// One sub-step. `override LAST` tells whether it may be a covered grid's last, `override MIXED` whether a tile may be mixed, `ROWS`
/// and `THREADS` are those of a [`super::StepShape`].
pub const WATER_STEP: Pass = Pass {
    name: "grid_water_step",
    constants: all_constants,
    parts: &[
        SHARED,
        include_str!("../../wgsl/shared/grid_rows.wgsl"),
        include_str!("../../wgsl/shared/grid_flux.wgsl"),
        include_str!("../../wgsl/shared/grid_foam.wgsl"),
        WATER_SHARED,
        include_str!("../../wgsl/shared/grid_water_field.wgsl"),
        include_str!("../../wgsl/shared/grid_water_strip.wgsl"),
        include_str!("../../wgsl/shared/grid_water_layer.wgsl"),
        include_str!("../../wgsl/shared/grid_water_advance.wgsl"),
        include_str!("../../wgsl/shared/grid_water_row.wgsl"),
        include_str!("../../wgsl/grid_water_step.wgsl"),
    ],
    entry_points: &["grid_water_step"],
    params: &[SCHEDULE_PARAMS[0], SCHEDULE_PARAMS[1], GRID_WATER],
};

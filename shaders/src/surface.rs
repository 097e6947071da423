//! The composite surface: the bind group that the renderer and a game's own shaders read, and the WGSL that reads it.
//!
//! `surface_at` answers what the water is at a world point, exactly (cubic kernel, f32); `surface_vertex` and
//! `surface_shading` answer for a rest point from filtered half-float mips, for looks. [`wgsl`] explains all that a game's
//! shader may call.

use bytemuck::{Pod, Zeroable};

use crate::{Pass, param_layout};

/// Most cascades a sea may have.
pub const MAX_CASCADES: usize = 8;
/// Most interactive grids that are drawn at once.
pub const MAX_GRIDS: usize = 32;
/// Most hulls that are kept dry at once.
pub const MAX_DRY: usize = 16;
/// A pixel as wide as this share of a cascade's tile, or wider, shades nothing of it.
pub const SHADING_END: f32 = 0.09;
/// See [`SurfaceTable::hidden_slope`].
pub const HIDDEN_SLOPE_BIAS: u32 = 6;
/// Most rounds of Newton's method that invert the horizontal displacement, after two rough ones of
/// `rest <- point - D(rest)`.
pub const CHOP_ROUNDS: u32 = 8;
/// A step of Newton's method that need not be checked, metres: its error is some hundredth of it.
pub const CHOP_LAST_STEP: f32 = 5e-3;
/// Compression of the surface below which a Newton step gets no longer: near a fold it would be arbitrarily long.
pub const CHOP_LEAST_STEP: f32 = 0.1;
/// Compression of the surface below which slopes get no steeper.
pub const CHOP_LEAST_SLOPE: f32 = 0.05;

/// A cascade as `surface_at` sees it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceCascade {
    /// Local origin modulo the tile, metres.
    pub offset: [f32; 2],
    /// Tile size, metres.
    pub tile: f32,
    /// Texels per side.
    pub size: f32,
}

/// A grid as `surface_at` sees it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceGrid {
    /// Local position of the window's corner, metres.
    pub corner: [f32; 2],
    /// Cell size along x and z, metres.
    pub cell_size: [f32; 2],
    /// Cells along x and z.
    pub cells: [u32; 2],
    /// First element in the pool.
    pub base: u32,
    /// Factor on its heights and foam, 0 to 1: grids come and go softly.
    pub gain: f32,
    /// Of a tiled grid: local place around which it is seen, metres.
    pub middle: [f32; 2],
    /// Of a tiled grid: distance from there at which it has faded to nothing, metres; the fade begins at half of it.
    pub reach: f32,
    /// 1 for a grid that repeats with its window less the outermost ring of cells, 0 for one that ends with it.
    pub tiled: u32,
}

/// The land as the composite surface sees it: where its rasters lie, and the level of the water.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceLand {
    /// Local position of texel (0, 0), metres.
    pub corner: [f32; 2],
    /// Distance of neighbouring texels, metres.
    pub texel: f32,
    /// 1 when there is land, 0 when only `level` counts.
    pub present: u32,
    /// Texels along x and z, from 2.
    pub size: [u32; 2],
    /// Level of still water above datum, metres.
    pub level: f32,
    /// Padding.
    pub pad: f32,
}

/// A hull that is kept dry, as `surface_is_dry` sees it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SurfaceDry {
    /// Local position of the hull's origin, metres.
    pub place: [f32; 3],
    /// First element in the pool; a node has two: (lower, upper side), (distance inside the edge of the plan, 0), metres.
    pub base: u32,
    /// Row that takes a local point, less `place`, to nodes along the hull's x.
    pub x: [f32; 4],
    /// Likewise to metres along its y.
    pub y: [f32; 4],
    /// Likewise to nodes along its z.
    pub z: [f32; 4],
    /// Nodes along x and z, from 2.
    pub nodes: [u32; 2],
    /// Padding.
    pub pad: [u32; 2],
}

/// The table at binding 0 of the composite bind group.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct SurfaceTable {
    /// Number of cascades in use.
    pub cascade_count: u32,
    /// Number of grids in use.
    pub grid_count: u32,
    /// Seconds since the start, wrapped at one hour, for looks only.
    pub time: f32,
    /// Significant wave height of the sea, metres.
    pub significant_height: f32,
    /// Mean square slope hidden below a footprint of 2^(i - [`HIDDEN_SLOPE_BIAS`]) metres, entry i: that of all waves
    /// shorter than twice the footprint, those finer than any texel included.
    pub hidden_slope: [f32; 16],
    /// Cascades, longest first.
    pub cascades: [SurfaceCascade; MAX_CASCADES],
    /// Grids.
    pub grids: [SurfaceGrid; MAX_GRIDS],
    /// Land and water level.
    pub land: SurfaceLand,
    /// Lowest corner (x, z) of the rectangle around all dry hulls, local metres.
    pub dry_low: [f32; 2],
    /// Highest corner.
    pub dry_high: [f32; 2],
    /// Number of dry hulls in use.
    pub dry_count: u32,
    /// Padding.
    pub pad: [u32; 3],
    /// Dry hulls.
    pub dry: [SurfaceDry; MAX_DRY],
}

impl Default for SurfaceTable {
    fn default() -> Self {
        Zeroable::zeroed()
    }
}

/// Layouts shared with WGSL.
pub const PARAMS: &[crate::ParamLayout] = &[
    param_layout!(SurfaceCascade { offset, tile, size }),
    param_layout!(SurfaceGrid { corner, cell_size, cells, base, gain, middle, reach, tiled }),
    param_layout!(SurfaceTable {
        cascade_count,
        grid_count,
        time,
        significant_height,
        hidden_slope,
        cascades,
        grids,
        land,
        dry_low,
        dry_high,
        dry_count,
        dry
    }),
    param_layout!(SurfaceLand { corner, texel, present, size, level }),
    param_layout!(SurfaceDry { place, base, x, y, z, nodes }),
];

/// Constants that WGSL shares, and the group index of the composite bind group.
pub fn constants(group: u32) -> String {
    format!(
        "override SURFACE_LAND: bool = true;\nconst MAX_CASCADES: u32 = {MAX_CASCADES}u;\nconst MAX_GRIDS: u32 = {MAX_GRIDS}u;\nconst MAX_DRY: u32 = {MAX_DRY}u;\nconst CHOP_ROUNDS: u32 = {CHOP_ROUNDS}u;\n\
         const CHOP_LAST_STEP: f32 = {CHOP_LAST_STEP};\nconst CHOP_LEAST_STEP: f32 = {CHOP_LEAST_STEP};\nconst CHOP_LEAST_SLOPE: f32 = {CHOP_LEAST_SLOPE};\nconst HIDDEN_SLOPE_BIAS: f32 = {HIDDEN_SLOPE_BIAS}.0;\nconst SHADING_END: f32 = {SHADING_END};\n\
         @group({group}) @binding(0) var<uniform> surface_table: SurfaceTable;\n\
         @group({group}) @binding(1) var surface_displacement: texture_2d_array<f32>;\n\
         @group({group}) @binding(2) var surface_derivative: texture_2d_array<f32>;\n\
         @group({group}) @binding(3) var<storage, read> surface_grids: array<vec2<f32>>;\n\
         @group({group}) @binding(4) var looks_displacement: texture_2d_array<f32>;\n\
         @group({group}) @binding(5) var looks_derivative: texture_2d_array<f32>;\n\
         @group({group}) @binding(6) var looks_sampler: sampler;\n\
         @group({group}) @binding(7) var surface_land: texture_2d_array<f32>;\n"
    )
}

#[doc = include_str!("../docs/surface.md")]
#[doc = concat!("```wgsl\n", include_str!("../docs/plane.wgsl"), "```")]
pub fn wgsl(group: u32) -> String {
    format!("{}\n{}", constants(group), TEXT)
}

/// Layout of the composite bind group, for vertex, fragment and compute stages.
///
/// Binding 7 holds the rasters of the land, three layers read bilinearly: factors on the amplitudes of cascades 0 to 3,
/// those of 4 to 7, and (elevation of the bed above datum in metres, open water 0 to 1, nearness of walls 0 to 1, 0).
#[cfg(feature = "gpu")]
pub fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use crate::pipeline::Slot;
    let unfiltered = Slot::TextureArray { filterable: false };
    let filtered = Slot::TextureArray { filterable: true };
    let table = Slot::Uniform { size: size_of::<SurfaceTable>() };
    crate::pipeline::group_layout(
        device,
        "surface",
        wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
        &[table, unfiltered, unfiltered, Slot::Read, filtered, filtered, Slot::Sampler, unfiltered],
    )
}

/// WGSL of the composite surface without its bindings.
pub const TEXT: &str = concat!(
    include_str!("../wgsl/shared/cubic.wgsl"),
    include_str!("../wgsl/shared/cascade.wgsl"),
    include_str!("../wgsl/shared/gradient.wgsl"),
    include_str!("../wgsl/shared/surface.wgsl"),
    include_str!("../wgsl/shared/land.wgsl"),
    include_str!("../wgsl/shared/land_factors.wgsl"),
    include_str!("../wgsl/shared/sea_read.wgsl"),
    include_str!("../wgsl/shared/surface_at.wgsl"),
    include_str!("../wgsl/shared/surface_dry.wgsl"),
    include_str!("../wgsl/shared/looks_grid.wgsl"),
    include_str!("../wgsl/shared/looks_detail.wgsl"),
    include_str!("../wgsl/shared/looks_hidden.wgsl"),
    include_str!("../wgsl/shared/looks.wgsl"),
);

/// The passes of this area.
pub const PASSES: &[Pass] = &[Pass {
    name: "surface_probe",
    constants: || constants(0),
    parts: &[TEXT, include_str!("../wgsl/surface_probe.wgsl")],
    entry_points: &["surface_probe"],
    params: PARAMS,
}];

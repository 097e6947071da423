//! Passes of the view: the sea on a projected grid, the sky, lit meshes. One uniform block serves all three.

use bytemuck::{Pod, Zeroable};

use crate::{Pass, param_layout, surface};

/// Bind group of the composite surface in the pass `view_water`; group 0 is the view's own.
pub const SURFACE_GROUP: u32 = 1;
/// Filter width of the displacement over the spacing of the grid's vertices: waves shorter than about twice this
/// many spacings are left to the shading, since a grid that cannot carry them would swim.
pub const GRID_FILTER: f32 = 1.5;
/// Most that the filtered width of a pixel may fall short of its long axis on the water.
pub const PIXEL_STRETCH: f32 = 2.5;

/// Share of open water below which none is drawn.
pub const LEAST_OPEN: f32 = 0.02;
/// Depth over which the water's edge fades in, metres.
pub const SHORE_EDGE: f32 = 0.05;

/// The uniform block at group 0, binding 0 of every view pass. Fields are explained in `wgsl/shared/view.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct ViewFrame {
    /// Column-major.
    pub clip_from_world: [[f32; 4]; 4],
    /// Eye, local metres.
    pub camera: [f32; 3],
    /// 1 when depth 0 is far.
    pub reverse_z: f32,
    /// Direction through the centre of the target, not normalised.
    pub ray_center: [f32; 3],
    /// Radiance factor before the display curve.
    pub exposure: f32,
    /// What one unit of clip x adds to the direction.
    pub ray_right: [f32; 3],
    /// Extinction of the air along the sea, 1/m.
    pub haze: f32,
    /// What one unit of clip y adds to the direction.
    pub ray_up: [f32; 3],
    /// Vertical optical depth of aerosol.
    pub mie: f32,
    /// Unit vector towards the sun.
    pub sun: [f32; 3],
    /// Distance at which the sea has become the horizon, metres.
    pub far: f32,
    /// Irradiance of the sun on a surface facing it.
    pub sunlight: [f32; 3],
    /// Depth of the bed, metres; 0 for too deep to show.
    pub depth: f32,
    /// Irradiance that the air scatters.
    pub airlight: [f32; 3],
    /// Metres that one foam texture covers.
    pub foam_size: f32,
    /// Irradiance of the sky on level ground.
    pub skylight: [f32; 3],
    /// One step of the display format, 0 for none.
    pub display_step: f32,
    /// Vertical optical depth of clear air.
    pub rayleigh: [f32; 3],
    /// 0 linear, 1 display curve, 2 display curve and sRGB encoding.
    pub output_mode: u32,
    /// Diffuse reflectance of deep water.
    pub scatter: [f32; 3],
    /// Natural logarithm of the ratio between grid rows.
    pub row_step: f32,
    /// Absorption of water, 1/m.
    pub absorption: [f32; 3],
    /// Angle between grid columns, radians.
    pub column_step: f32,
    /// Reflectance of the bed.
    pub bed: [f32; 3],
    /// Row 0 is `exp(first_row * row_step)` metres from the pole.
    pub first_row: i32,
    /// Where the projector stands (x, z), local metres.
    pub pole: [f32; 2],
    /// First column of the turn.
    pub first_column: u32,
    /// Columns in a full turn.
    pub turn: u32,
    /// Columns of the grid.
    pub columns: u32,
    /// 1 when the innermost row is the pole itself.
    pub closed: u32,
    /// Wave height that the water's colour is scaled by, metres.
    pub wave_height: f32,
    /// Level of still water, metres.
    pub level: f32,
    /// How much foam shores and walls make, 1 as calibrated.
    pub surf: f32,
    /// Padding.
    pub pad: [f32; 3],
}

const FRAME: crate::ParamLayout = param_layout!(ViewFrame {
    clip_from_world,
    camera,
    reverse_z,
    ray_center,
    exposure,
    ray_right,
    haze,
    ray_up,
    mie,
    sun,
    far,
    sunlight,
    depth,
    airlight,
    foam_size,
    skylight,
    display_step,
    rayleigh,
    output_mode,
    scatter,
    row_step,
    absorption,
    column_step,
    bed,
    first_row,
    pole,
    first_column,
    turn,
    columns,
    closed,
    wave_height,
    level,
    surf
});

/// Layouts shared with WGSL.
pub const PARAMS: &[crate::ParamLayout] = &[FRAME];

const VIEW_TEXT: &str = concat!(include_str!("../wgsl/shared/view.wgsl"), include_str!("../wgsl/shared/display.wgsl"));
const SKY_TEXT: &str = include_str!("../wgsl/shared/sky.wgsl");
const LIGHT_TEXT: &str = include_str!("../wgsl/shared/water_light.wgsl");
const SHORE_TEXT: &str = include_str!("../wgsl/shared/shore.wgsl");
const FRESNEL_TEXT: &str = include_str!("../wgsl/shared/fresnel.wgsl");

fn water_constants() -> String {
    format!(
        "const GRID_FILTER: f32 = {GRID_FILTER:?};\nconst PIXEL_STRETCH: f32 = {PIXEL_STRETCH:?};\n\
             const LEAST_OPEN: f32 = {LEAST_OPEN:?};\nconst SHORE_EDGE: f32 = {SHORE_EDGE:?};\n{}",
        surface::constants(SURFACE_GROUP)
    )
}

/// The sea.
pub const WATER: Pass = Pass {
    name: "view_water",
    constants: water_constants,
    parts: &[
        surface::TEXT,
        VIEW_TEXT,
        SKY_TEXT,
        FRESNEL_TEXT,
        LIGHT_TEXT,
        SHORE_TEXT,
        include_str!("../wgsl/view_water.wgsl"),
    ],
    entry_points: &["water_vertex", "water_fragment"],
    params: &[
        FRAME,
        surface::PARAMS[0],
        surface::PARAMS[1],
        surface::PARAMS[2],
        surface::PARAMS[3],
        surface::PARAMS[4],
    ],
};

/// The sky.
pub const SKY: Pass = Pass {
    name: "view_sky",
    constants: crate::no_constants,
    parts: &[VIEW_TEXT, SKY_TEXT, include_str!("../wgsl/view_sky.wgsl")],
    entry_points: &["sky_vertex", "sky_fragment"],
    params: PARAMS,
};

/// Lit meshes.
pub const MESH: Pass = Pass {
    name: "view_mesh",
    constants: crate::no_constants,
    parts: &[VIEW_TEXT, SKY_TEXT, FRESNEL_TEXT, include_str!("../wgsl/view_mesh.wgsl")],
    entry_points: &["mesh_vertex", "mesh_fragment"],
    params: PARAMS,
};

/// The passes of this area.
pub const PASSES: &[Pass] = &[WATER, SKY, MESH];

//! Passes of the ocean: modes to fields to looks.
//!
//! A synthesis transforms all cascades and spectra at once, along x, then along z. Where workgroup memory is fast that
//! takes two dispatches, `ocean_rows` and `ocean_columns`. On a CPU adapter (lavapipe) a read from a buffer or from
//! workgroup memory costs ten times one from a texture: there each stage is a dispatch from texture to texture,
//! `ocean_first` and `ocean_stage`. `ocean_looks` and `ocean_mips` make filtered half-float copies with foam, for what
//! only looks.

use bytemuck::{Pod, Zeroable};

pub use crate::surface::MAX_CASCADES;
use crate::surface::{CHOP_LEAST_SLOPE, SurfaceCascade};
use crate::{Pass, param_layout, turns};

/// Smallest side of a cascade, cells.
pub const MIN_SIZE: u32 = 16;
/// Largest side of a cascade, cells.
pub const MAX_SIZE: u32 = 1024;
/// Points that a thread of a transform holds: its radix. A stage of radix 32 holds twice as many.
pub const FFT_POINTS: u32 = 16;
/// Points in a workgroup's memory: as many lines as that holds (16 bytes a point, 16 KiB).
pub const FFT_BLOCK: u32 = 1024;
/// Invocations of a transform's workgroup.
pub const FFT_THREADS: u32 = FFT_BLOCK / FFT_POINTS;

/// A cascade as the ocean's passes see it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct OceanCascade {
    /// Wavenumber step of the cells, rad/m.
    pub wave_step: f32,
    /// Standard deviation of the divergence of the other cascades' displacement, positive.
    pub foam_spread: f32,
    /// Mean foam that the other cascades account for, 0 to 1.
    pub foam_share: f32,
    /// Rows and columns `0..half` and `N - half + 1..N` of the cells may hold modes; at most N/2.
    pub half: u32,
    /// Where it lies.
    pub place: SurfaceCascade,
}

/// Uniform of the ocean's passes.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct OceanParams {
    /// Time as a fraction of the loop of each mode set, in 1/2^32.
    pub phase: [u32; 2],
    /// Factor on the amplitudes of each mode set.
    pub weight: [f32; 2],
    /// Number of cascades.
    pub cascade_count: u32,
    /// Factor on the horizontal displacement.
    pub choppiness: f32,
    /// Jacobian of the horizontal displacement below which water breaks.
    pub foam_threshold: f32,
    /// Factor on old foam, 0 to 1.
    pub foam_decay: f32,
    /// Cascades, longest first.
    pub cascades: [OceanCascade; MAX_CASCADES],
}

const PARAMS: &[crate::ParamLayout] = &[
    param_layout!(SurfaceCascade { offset, tile, size }),
    param_layout!(OceanCascade { wave_step, foam_spread, foam_share, half, place }),
    param_layout!(OceanParams { phase, weight, cascade_count, choppiness, foam_threshold, foam_decay, cascades }),
];

/// WGSL function whose body is `statement` once per point, `{e}` replaced by its number: a thread's points stay in
/// registers only if every index is constant.
fn unrolled(signature: &str, statement: &str) -> String {
    let body: String =
        (0..FFT_POINTS).map(|e| format!("    {};\n", statement.replace("{e}", &e.to_string()))).collect();
    format!("fn {signature} {{\n{body}}}\n")
}

fn constants() -> String {
    format!("const OCEAN_CASCADES: u32 = {MAX_CASCADES}u;\n")
}

fn fft_constants() -> String {
    [
        constants(),
        format!("const THREADS: u32 = {FFT_THREADS}u;\n"),
        turns::constants(),
        unrolled(
            "points_emit(v: ptr<function, Points>, place: Place, first: u32, step: u32)",
            "emit(place, first + {e}u * step, (*v)[{e}])",
        ),
    ]
    .concat()
}

fn points_fetch() -> String {
    unrolled(
        "points_fetch(v: ptr<function, Points>, place: Place, t: u32)",
        "if !is_empty({e}u) { (*v)[{e}] = fetch(place, t + {e}u * THREADS_PER_LINE); }",
    )
}

fn points_butterfly() -> String {
    unrolled(
        "points_butterfly(v: ptr<function, Points>, w: ptr<function, Points>, turns: u32)",
        "butterfly(v, w, {e}u, turns_cos_sin(turns + {e}u * 0x08000000u))",
    )
}

fn first_constants() -> String {
    [
        fft_constants(),
        points_butterfly(),
        unrolled(
            "points_fetch_both(v: ptr<function, Points>, u: ptr<function, Points>, place: Place, t: u32)",
            "if !is_empty({e}u) { \
                let s{e} = spectra(place, t + {e}u * THREADS_PER_LINE); \
                (*v)[{e}] = s{e}.displacement; \
                (*u)[{e}] = s{e}.derivative; \
            }",
        ),
    ]
    .concat()
}

fn stage_constants() -> String {
    [fft_constants(), points_fetch(), points_butterfly()].concat()
}

fn line_constants() -> String {
    [
        fft_constants(),
        points_fetch(),
        format!("const BLOCK: u32 = {FFT_BLOCK}u;\n"),
        unrolled(
            "points_load(v: ptr<function, Points>, line: u32, t: u32)",
            "(*v)[{e}] = line_points[line_index(line, t + {e}u * THREADS_PER_LINE)]",
        ),
        unrolled(
            "points_store(v: ptr<function, Points>, line: u32, first: u32, step: u32)",
            "line_points[line_index(line, first + {e}u * step)] = (*v)[{e}]",
        ),
    ]
    .concat()
}

const PARAMS_TEXT: &str =
    concat!(include_str!("../wgsl/shared/cascade.wgsl"), include_str!("../wgsl/shared/ocean.wgsl"));
const FFT_TEXT: &str = concat!(
    include_str!("../wgsl/shared/turns.wgsl"),
    include_str!("../wgsl/shared/ocean_place.wgsl"),
    include_str!("../wgsl/shared/fft.wgsl"),
    include_str!("../wgsl/shared/fft_last.wgsl"),
    include_str!("../wgsl/shared/fft_stage.wgsl"),
);
const MEAN_TEXT: &str = include_str!("../wgsl/shared/mean4.wgsl");
const WIDE_TEXT: &str = include_str!("../wgsl/shared/fft_wide.wgsl");
const LINE_TEXT: &str = include_str!("../wgsl/shared/fft_lines.wgsl");
const MODES_TEXT: &str = include_str!("../wgsl/shared/ocean_modes.wgsl");

/// The spectra at one time and their transforms along x.
pub const ROWS: Pass = Pass {
    name: "ocean_rows",
    constants: line_constants,
    parts: &[PARAMS_TEXT, FFT_TEXT, LINE_TEXT, MODES_TEXT, include_str!("../wgsl/ocean_rows.wgsl")],
    entry_points: &["ocean_rows"],
    params: PARAMS,
};

/// The transforms along z.
pub const COLUMNS: Pass = Pass {
    name: "ocean_columns",
    constants: line_constants,
    parts: &[PARAMS_TEXT, FFT_TEXT, LINE_TEXT, include_str!("../wgsl/ocean_columns.wgsl")],
    entry_points: &["ocean_columns"],
    params: PARAMS,
};

/// The spectra at one time and the first stage of their transforms along x.
pub const FIRST: Pass = Pass {
    name: "ocean_first",
    constants: first_constants,
    parts: &[PARAMS_TEXT, FFT_TEXT, WIDE_TEXT, MODES_TEXT, include_str!("../wgsl/ocean_first.wgsl")],
    entry_points: &["ocean_first"],
    params: PARAMS,
};

/// One more stage of the transforms along x or z.
pub const STAGE: Pass = Pass {
    name: "ocean_stage",
    constants: stage_constants,
    parts: &[PARAMS_TEXT, FFT_TEXT, WIDE_TEXT, include_str!("../wgsl/ocean_stage.wgsl")],
    entry_points: &["ocean_stage"],
    params: PARAMS,
};

/// Half-float looks with foam, mip levels 0 to 2.
pub const LOOKS: Pass = Pass {
    name: "ocean_looks",
    constants,
    parts: &[PARAMS_TEXT, MEAN_TEXT, include_str!("../wgsl/ocean_looks.wgsl")],
    entry_points: &["ocean_looks"],
    params: PARAMS,
};

/// Two more mip levels of the looks.
pub const MIPS: Pass = Pass {
    name: "ocean_mips",
    constants: crate::no_constants,
    parts: &[MEAN_TEXT, include_str!("../wgsl/ocean_mips.wgsl")],
    entry_points: &["ocean_mips"],
    params: &[],
};

const SURFACE_TEXT: &str =
    concat!(include_str!("../wgsl/shared/gradient.wgsl"), include_str!("../wgsl/shared/ocean_surface.wgsl"));

fn surface_constants(group: u32) -> String {
    format!(
        "{}const CHOP_LEAST_SLOPE: f32 = {CHOP_LEAST_SLOPE};\n\
         @group({group}) @binding(0) var<uniform> open_water_sea: OceanParams;\n\
         @group({group}) @binding(1) var open_water_displacement: texture_2d_array<f32>;\n\
         @group({group}) @binding(2) var open_water_derivative: texture_2d_array<f32>;\n\
         @group({group}) @binding(3) var open_water_sampler: sampler;\n",
        constants()
    )
}

/// WGSL with `open_water_surface`, its bind group at index `group`, for a game that has the sea alone.
pub fn surface_wgsl(group: u32) -> String {
    [&surface_constants(group), PARAMS_TEXT, SURFACE_TEXT].join("\n")
}

/// Layout of the bind group of [`surface_wgsl`], for vertex, fragment and compute stages.
#[cfg(feature = "gpu")]
pub fn surface_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use crate::pipeline::Slot;
    let looks = Slot::TextureArray { filterable: true };
    crate::pipeline::group_layout(
        device,
        "sea",
        wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
        &[Slot::Uniform { size: size_of::<OceanParams>() }, looks, looks, Slot::Sampler],
    )
}

/// Answers of `open_water_surface` for a list of points, to compare them with the CPU's.
pub const SURFACE_PROBE: Pass = Pass {
    name: "ocean_surface_probe",
    constants: || surface_constants(0),
    parts: &[PARAMS_TEXT, SURFACE_TEXT, include_str!("../wgsl/ocean_surface_probe.wgsl")],
    entry_points: &["ocean_surface_probe"],
    params: PARAMS,
};

/// The passes of this area.
pub const PASSES: &[Pass] = &[ROWS, COLUMNS, FIRST, STAGE, LOOKS, MIPS, SURFACE_PROBE];

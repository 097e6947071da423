//! What the water needs of a device.

use open_water_shaders::grid::{GridDispatch, GridDraw, GridQueries, TickParams, TickWater};
use open_water_shaders::ocean::{FFT_BLOCK, FFT_THREADS, OceanParams};
use open_water_shaders::surface::{MAX_GRIDS, SurfaceTable};

use crate::OpenWaterError;

/// Largest uniform struct of any pass, bytes.
const UNIFORM: u64 = {
    let sizes = [
        size_of::<SurfaceTable>(),
        size_of::<OceanParams>(),
        size_of::<GridDispatch>(),
        size_of::<TickParams>(),
        size_of::<TickWater>(),
        size_of::<GridQueries>(),
        MAX_GRIDS * size_of::<GridDraw>(),
    ];
    let (mut most, mut i) = (0, 0);
    while i < sizes.len() {
        most = if sizes[i] > most { sizes[i] } else { most };
        i += 1;
    }
    most as u64
};

/// Lists the limits that count, each with the least that will do.
macro_rules! needs {
    ($($limit:ident: $least:expr,)*) => {
        /// The first limit that is too low, by name, with what is there and what is needed.
        fn lacking(found: &wgpu::Limits) -> Option<(&'static str, u64, u64)> {
            $(
                let (found_here, needed) = (u64::from(found.$limit), $least as u64);
                if found_here < needed {
                    return Some((stringify!($limit), found_here, needed));
                }
            )*
            None
        }

        /// These limits, all others as of WebGL 2.
        pub(crate) fn least() -> wgpu::Limits {
            wgpu::Limits { $($limit: $least,)* ..wgpu::Limits::downlevel_webgl2_defaults() }
        }
    };
}

needs! {
    max_bind_groups: 2,
    max_bindings_per_bind_group: 8,
    // Dispatch, tick, and what dispersive grids have besides.
    max_dynamic_uniform_buffers_per_pipeline_layout: 3,
    max_uniform_buffers_per_shader_stage: 3,
    // The composite surface.
    max_sampled_textures_per_shader_stage: 5,
    max_samplers_per_shader_stage: 1,
    // Three of state and five lists.
    max_storage_buffers_per_shader_stage: 8,
    max_buffers_and_acceleration_structures_per_shader_stage: 11,
    // Levels of the sea's looks.
    max_storage_textures_per_shader_stage: 3,
    max_uniform_buffer_binding_size: UNIFORM,
    // What the heights of all grids may take.
    max_storage_buffer_binding_size: 128 << 20,
    max_buffer_size: 128 << 20,
    max_compute_workgroup_storage_size: 16 * FFT_BLOCK,
    max_compute_invocations_per_workgroup: FFT_THREADS,
    max_compute_workgroup_size_x: FFT_THREADS,
    max_compute_workgroup_size_y: 8,
    max_compute_workgroup_size_z: 1,
    // A workgroup for every tile of the largest grids.
    max_compute_workgroups_per_dimension: 32768,
}

/// Refuses a device that cannot run the water.
pub(crate) fn check(found: &wgpu::Limits) -> Result<(), OpenWaterError> {
    match lacking(found) {
        None => Ok(()),
        Some((limit, found, needed)) => Err(OpenWaterError::DeviceLimit { limit, found, needed }),
    }
}

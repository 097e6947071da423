//! The GPU side: what is drawn, and the bind group that others read.
//!
//! Everything that runs on the GPU is decided by [`FramePlan`](crate::FramePlan) and recorded by `encode.rs`.

mod encode;
pub(crate) mod grids;
mod host;
pub(crate) mod land;
mod mirror;
mod surface;

use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;

use crate::OpenWaterError;
use crate::planner::Shown;
use surface::SurfaceBinding;

pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    ocean: Option<GpuOcean>,
    surface: SurfaceBinding,
    pub(crate) remote: grids::RemoteGrids,
    shown: Shown,
    /// Cells that the pool has room for, and that it never has less.
    pool: [u32; 2],
    /// Time of the last looks, seconds: foam fades by the difference.
    looks_time: f64,
    /// Drawn heights of one grid, before they are uploaded.
    scratch: Vec<[f32; 2]>,
}

impl Gpu {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        ocean: Option<&Ocean>,
    ) -> Result<Self, OpenWaterError> {
        check_limits(&device.limits())?;
        let gpu_ocean = ocean.map(|ocean| GpuOcean::new(device, ocean)).transpose()?;
        let surface = SurfaceBinding::new(device, gpu_ocean.as_ref());
        Ok(Self {
            device: device.clone(),
            queue: queue.clone(),
            ocean: gpu_ocean,
            surface,
            remote: grids::RemoteGrids::new(device),
            shown: Shown::default(),
            pool: [0; 2],
            looks_time: 0.0,
            scratch: Vec::new(),
        })
    }

    /// The grids have other places in the pool; it grows, and shrinks when most of it is empty.
    pub(crate) fn resize_pool(&mut self, cells: u32) {
        self.shown.grids = None;
        let [room, least] = &mut self.pool;
        if cells > *room || cells.max(*least) < *room / 4 {
            *room = cells.max(*least);
            self.surface.resize_pool(&self.device, self.ocean.as_ref(), *room);
        }
    }

    /// Keeps room for grids that come and go while the water runs.
    pub(crate) fn reserve_pool(&mut self, cells: u32) {
        self.pool[1] = cells;
    }

    /// Replaces the land that the composite surface reads.
    ///
    /// # Errors
    /// The rasters are larger than the device's textures may be.
    pub(crate) fn set_land(&mut self, texels: Option<&land::LandTexels>) -> Result<(), OpenWaterError> {
        self.surface.set_land(&self.device, &self.queue, self.ocean.as_ref(), texels)
    }

    pub(crate) fn shown(&self) -> Shown {
        self.shown
    }

    pub(crate) fn surface(&self) -> &SurfaceBinding {
        &self.surface
    }
}

/// What the water needs of a device: WebGPU's default limits.
pub(crate) fn required_limits() -> wgpu::Limits {
    wgpu::Limits::default()
}

fn check_limits(found: &wgpu::Limits) -> Result<(), OpenWaterError> {
    let needed = required_limits();
    let pairs = [
        ("max_storage_buffers_per_shader_stage", found.max_storage_buffers_per_shader_stage, 6),
        ("max_sampled_textures_per_shader_stage", found.max_sampled_textures_per_shader_stage, 4),
        ("max_compute_invocations_per_workgroup", found.max_compute_invocations_per_workgroup, 256),
        (
            "max_compute_workgroup_storage_size",
            found.max_compute_workgroup_storage_size,
            needed.max_compute_workgroup_storage_size,
        ),
        ("max_bind_groups", found.max_bind_groups, 2),
        ("max_texture_dimension_2d", found.max_texture_dimension_2d, 2048),
    ];
    for (limit, found, needed) in pairs {
        if found < needed {
            return Err(OpenWaterError::DeviceLimit { limit, found: found.into(), needed: needed.into() });
        }
    }
    Ok(())
}

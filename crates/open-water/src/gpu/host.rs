//! What a host with a device calls.

use super::limits;
use crate::plan::FramePlan;
use crate::water::OpenWater;

impl OpenWater {
    /// What to ask of a device: no optional feature, WebGPU's default limits. It leaves room for the host's own passes; the
    /// water itself makes do with [`Self::least_limits`].
    pub fn required_limits() -> wgpu::Limits {
        wgpu::Limits::default()
    }

    /// The least limits of a device that runs the water. Seas of large cascades and large land need larger textures, and
    /// say so.
    pub fn least_limits() -> wgpu::Limits {
        limits::least()
    }

    /// Records the plan's work into the host's encoder. Uploads go through the queue and hold for everything that is
    /// submitted next, so encode once per submission. Does nothing without a device, nor on one that is lost
    /// ([`Self::is_device_lost`]).
    pub fn encode(&mut self, plan: &FramePlan, encoder: &mut wgpu::CommandEncoder) {
        if let Some(gpu) = &mut self.gpu
            && gpu.is_sound()
        {
            gpu.encode(plan, self.ocean.as_ref(), &mut self.grids, encoder);
        }
    }

    /// The bind group of the composite surface, for the shader text of
    /// [`open_water_shaders::surface::wgsl`]. Ask for it each frame: it changes when grids come and go. `None` without
    /// a device.
    pub fn surface_bind_group(&self) -> Option<&wgpu::BindGroup> {
        self.gpu.as_ref().map(|gpu| gpu.surface().group())
    }

    /// The layout of [`Self::surface_bind_group`], for pipelines. `None` without a device.
    pub fn surface_layout(&self) -> Option<&wgpu::BindGroupLayout> {
        self.gpu.as_ref().map(|gpu| gpu.surface().layout())
    }
}

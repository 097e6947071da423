//! What a host with a device calls.

use crate::plan::FramePlan;
use crate::water::OpenWater;

impl OpenWater {
    /// What the water needs of a device: no optional feature, WebGPU's default limits.
    pub fn required_limits() -> wgpu::Limits {
        super::required_limits()
    }

    /// Records the plan's work into the host's encoder. Uploads go through the queue and hold for everything that is
    /// submitted next, so encode once per submission. Does nothing without a device.
    pub fn encode(&mut self, plan: &FramePlan, encoder: &mut wgpu::CommandEncoder) {
        if let Some(gpu) = &mut self.gpu {
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

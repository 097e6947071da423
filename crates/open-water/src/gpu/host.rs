//! What a host with a device calls.

use super::{Encoded, limits};
use crate::plan::FramePlan;
use crate::trace::{span, warning};
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

    /// Has compiled beside what GPU-homed grids need of the device, so that the first one, added or moved there, does not
    /// take the time for it. Returns whether that is over: ask in every frame of a loading screen. A grid that comes before
    /// waits for it, and is told what was refused. Without a device there is nothing to do.
    pub fn prepare_gpu_grids(&mut self) -> bool {
        self.gpu.as_mut().is_none_or(|gpu| gpu.lost || gpu.remote.compile_beside())
    }

    /// Records the plan's work into the host's encoder, uploads included: several encoders of one submission each show
    /// their own moment, and one that is dropped leaves nothing behind (then drop those encoded after it, too). Submit them
    /// in the order in which they were encoded. Does nothing without a device, nor on one that is lost ([`Self::is_device_lost`]).
    ///
    /// While [`MAX_FRAMES`] of them are under way the GPU is too far behind, and the plan's work is left out: the picture
    /// gets older, nothing waits, and grids on the GPU make their ticks up later. See [`Reports::behind`].
    ///
    /// [`MAX_FRAMES`]: open_water_shaders::pipeline::MAX_FRAMES
    /// [`Reports::behind`]: crate::Reports::behind
    pub fn encode(&mut self, plan: &FramePlan, encoder: &mut wgpu::CommandEncoder) {
        span!("encode", tick = plan.tick, dispatches = plan.dispatches(), upload_bytes = plan.upload_bytes());
        if let Some(gpu) = &mut self.gpu
            && plan.work.contains(&crate::Work::Table)
        {
            gpu.place_dry(plan, &self.dry, &self.bodies);
        }
        if let Some(gpu) = &mut self.gpu
            && !gpu.lost
            && !gpu.encode(plan, self.ocean.as_ref(), &mut self.grids, encoder)
        {
            self.reports.behind += u64::from(!gpu.lost);
            warning!(behind = self.reports.behind, lost = gpu.lost, "the frame's GPU work was left out");
        }
    }

    /// What the last [`Self::encode`] recorded; its dispatches are those of its plan unless the plan was old or the GPU behind.
    pub fn encoded(&self) -> Encoded {
        self.gpu.as_ref().filter(|gpu| !gpu.lost).map_or_else(Encoded::default, |gpu| gpu.encoded)
    }

    /// The bind group of the composite surface, for the shader text of [`open_water_shaders::surface::wgsl`], which says what
    /// a shader of one's own may call. Ask for it each frame, after [`Self::encode`]: it changes when grids, land and dry hulls
    /// come and go. One serves all views. `None` without a device.
    pub fn surface_bind_group(&self) -> Option<&wgpu::BindGroup> {
        self.gpu.as_ref().map(|gpu| gpu.surface().group())
    }

    /// The layout of [`Self::surface_bind_group`], for pipelines. `None` without a device.
    pub fn surface_layout(&self) -> Option<&wgpu::BindGroupLayout> {
        self.gpu.as_ref().map(|gpu| gpu.surface().layout())
    }
}

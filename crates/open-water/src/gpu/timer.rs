//! How long the device took: time stamps around the water's compute pass, where the adapter has them. They come back some
//! frames later; nothing waits.

use open_water_shaders::pipeline::Readback;

use crate::plan::FramePlan;
use crate::water::OpenWater;

/// Frames whose stamps may be on their way; those of others are left out.
const SLOTS: usize = 5;
/// Begin, end, and in between.
const STAMPS: u32 = 3;

/// What the device took for a frame's water, see [`OpenWater::gpu_times`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpuTimes {
    /// The last tick of the frame: how old this is.
    pub tick: u64,
    /// How far the drawn moment lay between that tick and the one before.
    pub alpha: f32,
    /// Seconds of the compute pass; uploads before it are not in it, nor the host's own passes.
    pub pass: f32,
    /// Seconds of it that the ambient sea took; the rest is the GPU-homed grids'. `None` on a device without
    /// `TIMESTAMP_QUERY_INSIDE_PASSES`.
    pub sea: Option<f32>,
}

pub(crate) struct Timer {
    stamps: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    ring: Readback<(u64, f32)>,
    /// Seconds of a unit.
    unit: f64,
    inside: bool,
    latest: Option<GpuTimes>,
}

impl Timer {
    /// `None` on a device without time stamps.
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Self> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let stamps = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("water_times"),
            ty: wgpu::QueryType::Timestamp,
            count: STAMPS,
        });
        let size = u64::from(STAMPS) * size_of::<u64>() as u64;
        let resolved = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("water_times"),
            size,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Some(Self {
            stamps,
            resolved,
            ring: Readback::new(device, "water_times", size, SLOTS),
            unit: f64::from(queue.get_timestamp_period()) * 1e-9,
            inside: device.features().contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES),
            latest: None,
        })
    }

    /// For the description of the pass.
    pub(crate) fn around(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.stamps,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// The sea is done.
    pub(crate) fn between(&self, pass: &mut wgpu::ComputePass<'_>) {
        if self.inside {
            pass.write_timestamp(&self.stamps, 2);
        }
    }

    /// After the pass.
    pub(crate) fn finish(&mut self, encoder: &mut wgpu::CommandEncoder, plan: &FramePlan) {
        // What was not written cannot be resolved.
        let count = if self.inside { STAMPS } else { STAMPS - 1 };
        encoder.resolve_query_set(&self.stamps, 0..count, &self.resolved, 0);
        let bytes = u64::from(count) * size_of::<u64>() as u64;
        let _ = self.ring.encode(encoder, &self.resolved, 0, bytes, (plan.tick, plan.alpha));
    }

    /// Takes what has come back.
    pub(crate) fn poll(&mut self, device: &wgpu::Device) {
        let Some(reading) = self.ring.poll(device) else { return };
        let mut stamps = [0u64; STAMPS as usize];
        for (stamp, bytes) in stamps.iter_mut().zip(reading.bytes.chunks_exact(size_of::<u64>())) {
            *stamp = bytemuck::pod_read_unaligned(bytes);
        }
        let secs = |to: usize| (stamps[to].saturating_sub(stamps[0]) as f64 * self.unit) as f32;
        let (tick, alpha) = reading.stamp;
        self.latest = Some(GpuTimes { tick, alpha, pass: secs(1), sea: self.inside.then(|| secs(2)) });
    }
}

impl OpenWater {
    /// What the device took for the water of the last frame whose time stamps have come back, some frames ago. `None` before that,
    /// without a device, and on one without `wgpu::Features::TIMESTAMP_QUERY`.
    pub fn gpu_times(&self) -> Option<GpuTimes> {
        self.gpu.as_ref()?.timer.as_ref()?.latest
    }
}

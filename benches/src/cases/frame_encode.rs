//! Case `frame_encode`: what recording a frame's water costs against the same calls of wgpu by hand.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use floating_body::BodyDesc;
use open_water::{BodyStates, Consumers, Controls, Follow, GridDesc, OpenWater, OpenWaterDesc, Preset};
use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};

use super::facade::view;
use crate::evidence::{Case, CaseError, Context, Gpu, Row, allocations};
use crate::fixtures::{FRAME, boat_hull};

/// See the module.
pub(super) const ENCODE: Case = Case {
    name: "frame_encode",
    about: "encode of a sea with looks and a boat's wake, steady: allocations and time against the same wgpu calls by hand",
    plots: &[],
    run,
};

/// Copies of a frame: the sea's parameters, the table, the wake.
const COPIES: u64 = 3;

/// The calls: as many copies and dispatches with a pipeline and a bind group each, in one pass, from one buffer that is mapped
/// again. Two of each take turns: wgpu leaves out what is set already.
struct Hand {
    sets: [(wgpu::ComputePipeline, wgpu::BindGroup); 2],
    staging: wgpu::Buffer,
    /// It is mapped: who writes into it again must know.
    ready: Arc<AtomicBool>,
    target: wgpu::Buffer,
}

impl Hand {
    fn new(gpu: &Gpu, bytes: u64) -> Self {
        let device = &gpu.device;
        let buffer = |usage, mapped_at_creation| {
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size: bytes, usage, mapped_at_creation })
        };
        let staging = buffer(wgpu::BufferUsages::MAP_WRITE | wgpu::BufferUsages::COPY_SRC, true);
        let target = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST, false);
        let layout = group_layout(device, "hand", wgpu::ShaderStages::COMPUTE, &[Slot::ReadWrite]);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(
                "@group(0) @binding(0) var<storage, read_write> all: array<u32>;
                @compute @workgroup_size(1) fn main() { all[0] = 1u; }"
                    .into(),
            ),
        });
        let layouts = pipeline_layout(device, "hand", &[&layout]);
        let sets = [(); 2].map(|()| {
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&layouts),
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            });
            (pipeline, bind_group(device, "hand", &layout, &[target.as_entire_binding()]))
        });
        Self { sets, staging, ready: Arc::default(), target }
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder, bytes: &[u8], copies: u64, dispatches: u32) {
        if let Ok(mut view) = self.staging.get_mapped_range_mut(..) {
            view.slice(..bytes.len()).copy_from_slice(bytes);
        }
        let part = (bytes.len() as u64 / copies).next_multiple_of(4);
        for at in (0..bytes.len() as u64).step_by(part as usize) {
            let count = part.min(bytes.len() as u64 - at);
            encoder.copy_buffer_to_buffer(&self.staging, at, &self.target, at, count);
        }
        let of = wgpu::ComputePassDescriptor { label: Some("water"), timestamp_writes: None };
        let mut pass = encoder.begin_compute_pass(&of);
        for (pipeline, group) in self.sets.iter().cycle().take(dispatches as usize) {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(1, 1, 1);
        }
        drop(pass);
        self.staging.unmap();
        let ready = Arc::clone(&self.ready);
        encoder.map_buffer_on_submit(&self.staging, wgpu::MapMode::Write, .., move |mapped| {
            ready.store(mapped.is_ok(), Ordering::Relaxed);
        });
    }
}

/// Counts and times what `encode` does with fresh encoders, each then submitted and waited for.
fn count(gpu: &Gpu, mut encode: impl FnMut(&mut wgpu::CommandEncoder)) -> Result<(usize, f64), CaseError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let start = std::time::Instant::now();
    let asked = allocations(|| encode(&mut encoder));
    let secs = start.elapsed().as_secs_f64();
    gpu.queue.submit([encoder.finish()]);
    gpu.wait()?;
    Ok((asked, secs))
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let mut water = OpenWater::new(&gpu.device, &gpu.queue, OpenWaterDesc::default())?;
    let mut bodies = BodyStates::default();
    let boat = water.add_body(BodyDesc::boat(&boat_hull()?, 1500.0, 8.0))?;
    water.set_controls(boat, Controls { throttle: 1.0, ..Controls::default() })?;
    bodies.insert(boat, water.body(boat)?.state());
    water.add_grid(GridDesc { follow: Follow::Body(boat), ..Preset::Medium.grid() })?;
    let mut found = [Vec::new(), Vec::new()];
    let mut hand = None;
    let (mut dispatches, mut bytes) = (0, Vec::new());
    for frame in 0..context.pick(60, 400) {
        for tick in water.advance(FRAME) {
            water.tick(tick, &mut bodies)?;
        }
        let plan = water.plan(&view(), Consumers::NORMALS | Consumers::FOAM);
        let own = count(gpu, |encoder| water.encode(&plan, encoder))?;
        if frame < context.pick(20, 100) {
            continue;
        }
        let hand = hand.get_or_insert_with(|| Hand::new(gpu, 4 << 20));
        (dispatches, bytes) = (plan.dispatches(), vec![0; plan.upload_bytes() as usize]);
        let other = count(gpu, |encoder| hand.encode(encoder, &bytes, COPIES, plan.dispatches()))?;
        found[0].push(own);
        found[1].push(other);
    }
    let [own, other] = found.each_mut().map(|found| {
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut asked: Vec<usize> = found.iter().map(|found| found.0).collect();
        asked.sort_unstable();
        (asked[asked.len() / 2], found[found.len() / 2].1 * 1e6)
    });
    let round = |us: f64| (us * 10.0).round() / 10.0;
    Ok(vec![
        Row::new("frame_encode", "a sea with looks, a boat's wake")
            .param("dispatches", dispatches)
            .param("upload_KiB", bytes.len() / 1024)
            .param("allocations", own.0)
            .param("allocations_by_hand", other.0)
            .param("encode_us", round(own.1))
            .param("encode_by_hand_us", round(other.1))
            .error(
                own.0 as f64 - other.0 as f64,
                "allocations more",
                "the same calls of wgpu by hand, median of a frame",
            )
            .bound(0.0)
            .note(
                "all are wgpu's own lists of commands; by hand two pipelines, two bind groups and two buffers in all",
            ),
    ])
}

//! Case `fleet_gpu`: many boxes on force points by a plain kernel on the GPU, the tensor taken in three ways.
//!
//! A measurement of what the adapter could do; the library's bodies live on the CPU.

mod twin;

use std::hint::black_box;

use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};

use self::twin::{Piece, Settings, Twin};
use crate::evidence::{Axis, Case, CaseError, Context, Gpu, Plot, Row, measure_together};

/// See the module.
pub(super) const FLEET: Case = Case {
    name: "fleet_gpu",
    about: "boxes on eight force points over a bare height field on the GPU, by the way the tensor is taken",
    plots: &[Plot {
        file: "fleet_gpu",
        title: "A tick of floating boxes on the GPU",
        x: Axis::Param("bodies"),
        y: Axis::Time,
        label: None,
    }],
    run,
};

/// In the kernel's numbering.
const ROTATIONS: [&str; 3] = ["pre-rigid", "full tensor", "tensor inverted in world axes"];
/// Ticks in one submission.
const TICKS: u32 = 16;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for count in context.pick::<&[u32]>(&[100, 10_000], &[100, 1_000, 10_000, 100_000]) {
        for (way, name) in ROTATIONS.iter().enumerate() {
            let settings = Settings::new(*count);
            let mut twin = Twin::new(settings, way);
            let kernel = Kernel::new(gpu, &twin, way);
            let mut row = Row::new("fleet_gpu", *name)
                .param("bodies", *count)
                .param("force_points", 8)
                .param("adapter", gpu.adapter.kind.clone());
            if *count == 10_000 {
                kernel.run(gpu, 4 * TICKS)?;
                (0..4 * TICKS).for_each(|_| twin.tick());
                let error = kernel.error(gpu, &twin)?;
                row =
                    row.error(error, "m", "the same in f64 on the CPU after 64 ticks, RMS of the places").bound(1.0e-3);
            }
            let mut failed = None;
            let [ours, plain] = measure_together(
                context.effort,
                [&mut || failed = failed.take().or(kernel.run(gpu, TICKS).err()), &mut || {
                    twin.tick();
                    black_box(&twin);
                }],
            );
            if let Some(error) = failed {
                return Err(error);
            }
            let ours = ours.per(f64::from(TICKS));
            rows.push(
                row.time("a tick of all, 16 in a submission", &ours)
                    .baseline("a plain loop in f64, one thread", &plain),
            );
        }
    }
    Ok(rows)
}

struct Kernel {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    pieces: wgpu::Buffer,
    groups: u32,
}

impl Kernel {
    fn new(gpu: &Gpu, twin: &Twin, way: usize) -> Self {
        let device = &gpu.device;
        let settings = twin.settings.words();
        let slots = [Slot::Uniform { size: settings.len() }, Slot::Read, Slot::ReadWrite];
        let layout = group_layout(device, "fleet", wgpu::ShaderStages::COMPUTE, &slots);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("fleet"),
            source: wgpu::ShaderSource::Wgsl(include_str!("kernel.wgsl").into()),
        });
        let constants = [("ROTATION", way as f64)];
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("fleet"),
            layout: Some(&pipeline_layout(device, "fleet", &[&layout])),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            cache: None,
        });
        let buffer = |usage: wgpu::BufferUsages, data: &[u8]| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("fleet"),
                size: data.len() as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            gpu.queue.write_buffer(&buffer, 0, data);
            buffer
        };
        let bytes = |values: &mut dyn Iterator<Item = f64>| -> Vec<u8> {
            values.flat_map(|v| (v as f32).to_ne_bytes()).collect()
        };
        let uniform = buffer(wgpu::BufferUsages::UNIFORM, &settings);
        let field = buffer(wgpu::BufferUsages::STORAGE, &bytes(&mut twin.field.iter().copied()));
        let state = bytes(&mut twin.pieces.iter().flat_map(Piece::words));
        let pieces = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC, &state);
        let group =
            bind_group(device, "fleet", &layout, &[&uniform, &field, &pieces].map(wgpu::Buffer::as_entire_binding));
        Self { pipeline, group, pieces, groups: twin.settings.count.div_ceil(64) }
    }

    /// Submits ticks and waits.
    fn run(&self, gpu: &Gpu, ticks: u32) -> Result<(), CaseError> {
        gpu.run(|encoder| {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            for _ in 0..ticks {
                pass.dispatch_workgroups(self.groups, 1, 1);
            }
        })
    }

    /// RMS distance from the twin's places, m.
    fn error(&self, gpu: &Gpu, twin: &Twin) -> Result<f64, CaseError> {
        let state = gpu.read_buffer(&self.pieces)?;
        let square: f64 = state
            .as_chunks::<16>()
            .0
            .iter()
            .zip(&twin.pieces)
            .map(|(found, piece)| {
                let found = glam::DVec3::new(found[0].into(), found[1].into(), found[2].into());
                found.distance_squared(piece.position)
            })
            .sum();
        Ok((square / twin.pieces.len() as f64).sqrt())
    }
}

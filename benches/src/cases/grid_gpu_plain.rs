//! What a step on the GPU is measured against: a plain kernel there and a plain loop on the CPU.

use std::hint::black_box;

use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};
use wave_grid::Scheme;

use crate::{
    evidence::{CaseError, Gpu},
    fixtures,
};

/// The best of the plain kernels of the notes: a vec4 of cells and eight rows a thread, rows in registers, no border.
const PLAIN_WGSL: &str = "
@group(0) @binding(0) var<uniform> plain: vec4<u32>;
@group(0) @binding(1) var<storage, read> plain_now: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> plain_old: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let columns = plain.x / 4u;
    let rows = plain.x;
    let west = select(id.x - 1u, columns - 1u, id.x == 0u);
    let east = select(id.x + 1u, 0u, id.x + 1u == columns);
    let first = id.y * 8u;
    var s = plain_now[select(first - 1u, rows - 1u, first == 0u) * columns + id.x];
    var c = plain_now[first * columns + id.x];
    for (var k = 0u; k < 8u; k++) {
        let row = (first + k) * columns;
        let north = select(row + columns, 0u, first + k + 1u == rows);
        let n = plain_now[north + id.x];
        let w = vec4<f32>(plain_now[row + west].w, c.xyz);
        let e = vec4<f32>(c.yzw, plain_now[row + east].x);
        let sum = (w + e) + (s + n);
        plain_old[row + id.x] = 0.04 * c + 0.49 * sum - plain_old[row + id.x];
        s = c;
        c = n;
    }
}";

/// Steps on the GPU.
pub(super) struct PlainKernel {
    pipeline: wgpu::ComputePipeline,
    groups: [wgpu::BindGroup; 2],
    cells: u32,
}

impl PlainKernel {
    pub(super) fn new(gpu: &Gpu, cells: u32) -> Self {
        let device = &gpu.device;
        let slots = [Slot::Uniform { size: 16 }, Slot::Read, Slot::ReadWrite];
        let layout = group_layout(device, "plain", wgpu::ShaderStages::COMPUTE, &slots);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("plain"),
            source: wgpu::ShaderSource::Wgsl(PLAIN_WGSL.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("plain"),
            layout: Some(&pipeline_layout(device, "plain", &[&layout])),
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        let buffer = |usage: wgpu::BufferUsages, data: &[u8]| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("plain"),
                size: data.len() as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            gpu.queue.write_buffer(&buffer, 0, data);
            buffer
        };
        let heights: Vec<u8> = heights((cells * cells) as usize).iter().flat_map(|z| z.to_ne_bytes()).collect();
        let [a, b] = [0, 1].map(|_| buffer(wgpu::BufferUsages::STORAGE, &heights));
        let size = buffer(wgpu::BufferUsages::UNIFORM, &[cells.to_ne_bytes(); 4].concat());
        let group = |now: &wgpu::Buffer, old: &wgpu::Buffer| {
            bind_group(device, "plain", &layout, &[&size, now, old].map(wgpu::Buffer::as_entire_binding))
        };
        Self { pipeline, groups: [group(&a, &b), group(&b, &a)], cells }
    }

    /// Submits steps and waits.
    pub(super) fn run(&self, gpu: &Gpu, steps: u32) -> Result<(), CaseError> {
        gpu.run(|encoder| {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            for k in 0..steps {
                pass.set_bind_group(0, &self.groups[(k & 1) as usize], &[]);
                pass.dispatch_workgroups(self.cells / 4 / 64, self.cells / 8, 1);
            }
        })
    }
}

/// Small heights without a pattern.
fn heights(count: usize) -> Vec<f32> {
    let mut random = fixtures::Random::new(4);
    (0..count).map(|_| random.within(-0.01, 0.01) as f32).collect()
}

/// The scheme as a textbook writes it: uniform c, fixed rim.
pub(super) struct Plain {
    nx: usize,
    now: Vec<f32>,
    before: Vec<f32>,
    nine: bool,
}

impl Plain {
    pub(super) fn new(nx: usize, scheme: Scheme) -> Self {
        let now = heights(nx * nx);
        Self { nx, before: now.clone(), now, nine: scheme == Scheme::NinePoint }
    }

    pub(super) fn step(&mut self) {
        let nx = self.nx;
        for j in 1..nx - 1 {
            let row = |j: usize| &self.now[j * nx..(j + 1) * nx];
            let (above, here, below) = (row(j - 1), row(j), row(j + 1));
            let before = &mut self.before[j * nx..(j + 1) * nx];
            if self.nine {
                for i in 1..nx - 1 {
                    let edges = here[i - 1] + here[i + 1] + above[i] + below[i];
                    let corners = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
                    before[i] = 0.1 * here[i] + 0.4 * edges + 0.075 * corners - before[i];
                }
            } else {
                for i in 1..nx - 1 {
                    before[i] = 0.04 * here[i] + 0.49 * (here[i - 1] + here[i + 1] + above[i] + below[i]) - before[i];
                }
            }
        }
        std::mem::swap(&mut self.now, &mut self.before);
        black_box(&self.now);
    }
}

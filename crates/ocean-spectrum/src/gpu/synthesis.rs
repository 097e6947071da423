//! Modes to fields: `ocean_rows`, then `ocean_columns`.

use bytemuck::cast_slice;
use open_water_shaders::ocean::{COLUMNS, FFT_BLOCK, OceanParams, ROWS};
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};

use super::upload::{self, Shape};
use crate::Ocean;

pub(super) const DISPATCHES: u32 = 2;

#[derive(Debug)]
pub(super) struct Synthesis {
    amplitudes: wgpu::Buffer,
    turns: wgpu::Buffer,
    rows: (wgpu::ComputePipeline, wgpu::BindGroup),
    columns: (wgpu::ComputePipeline, wgpu::BindGroup),
    pub(super) fields: wgpu::Texture,
    pub(super) displacement: wgpu::TextureView,
    pub(super) derivative: wgpu::TextureView,
}

fn amplitudes(ocean: &Ocean) -> Vec<[f32; 4]> {
    ocean.modes().iter().flat_map(|modes| modes.amp.iter().copied()).collect()
}

fn turns(ocean: &Ocean) -> Vec<u32> {
    ocean.modes().iter().flat_map(|modes| modes.n.iter().copied()).collect()
}

impl Synthesis {
    pub(super) fn new(device: &wgpu::Device, shape: Shape, ocean: &Ocean, params: &wgpu::Buffer) -> Self {
        let storage = wgpu::BufferUsages::STORAGE;
        let amplitudes = upload::buffer(device, "ocean amplitudes", cast_slice(&amplitudes(ocean)), storage);
        let turns = upload::buffer(device, "ocean turns", cast_slice(&turns(ocean)), storage);
        let half_done = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("ocean half done"),
            size: shape.half_done_bytes(),
            usage: storage,
            mapped_at_creation: false,
        });
        let format = wgpu::TextureFormat::Rgba32Float;
        let (fields, [displacement, derivative]) = upload::texture(device, "ocean fields", shape, format, 1);

        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::Uniform { size: size_of::<OceanParams>() };
        let constants = [("N", f64::from(shape.size))];
        let layout = group_layout(device, ROWS.name, compute, &[uniform, Slot::Read, Slot::Read, Slot::ReadWrite]);
        let rows = (
            compute_pipeline(device, &ROWS, "ocean_rows", &[&layout], &constants),
            bind_group(
                device,
                ROWS.name,
                &layout,
                &[
                    params.as_entire_binding(),
                    amplitudes.as_entire_binding(),
                    turns.as_entire_binding(),
                    half_done.as_entire_binding(),
                ],
            ),
        );
        let layout =
            group_layout(device, COLUMNS.name, compute, &[uniform, Slot::Read, Slot::WriteTextureArray { format }]);
        let columns = (
            compute_pipeline(device, &COLUMNS, "ocean_columns", &[&layout], &constants),
            bind_group(
                device,
                COLUMNS.name,
                &layout,
                &[
                    params.as_entire_binding(),
                    half_done.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&upload::level(&fields, 0)),
                ],
            ),
        );
        Self { amplitudes, turns, rows, columns, fields, displacement, derivative }
    }

    pub(super) fn upload(&self, queue: &wgpu::Queue, ocean: &Ocean) {
        queue.write_buffer(&self.amplitudes, 0, cast_slice(&amplitudes(ocean)));
        queue.write_buffer(&self.turns, 0, cast_slice(&turns(ocean)));
    }

    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, shape: Shape) {
        let lines = FFT_BLOCK / shape.size;
        for (pipeline, group) in [&self.rows, &self.columns] {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(shape.size.div_ceil(lines), 1, shape.layers());
        }
    }
}

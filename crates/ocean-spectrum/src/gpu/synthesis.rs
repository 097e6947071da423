//! Modes to fields: one dispatch per stage, each from one texture to the next.

use open_water_shaders::Pass;
use open_water_shaders::ocean::{COLUMNS, FFT_BLOCK, FFT_POINTS, FFT_THREADS, FIRST, OceanParams, ROWS, STAGE};
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};

use super::modes::ModeTextures;
use super::upload::{self, Shape};
use crate::Ocean;

/// How the transforms run. The results are the same to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FftKernel {
    /// Whole lines in workgroup memory: 2 dispatches. For GPUs.
    Lines,
    /// A dispatch per stage from texture to texture, without workgroup memory: 4 dispatches, 6 above 256 texels. For
    /// adapters that run on the CPU, where reads from buffers and workgroup memory are slow.
    Stages,
}

impl FftKernel {
    /// The faster one for a device.
    pub fn of(device: &wgpu::Device) -> Self {
        match device.adapter_info().device_type {
            wgpu::DeviceType::Cpu => Self::Stages,
            _ => Self::Lines,
        }
    }
}

#[derive(Debug)]
struct Dispatch {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: u32,
}

#[derive(Debug)]
pub(super) struct Synthesis {
    pub(super) modes: ModeTextures,
    dispatches: Vec<Dispatch>,
    pub(super) fields: wgpu::Texture,
    pub(super) displacement: wgpu::TextureView,
    pub(super) derivative: wgpu::TextureView,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A pass after the first, with its own constants.
type Next = (&'static Pass, Vec<(&'static str, f64)>);

/// The first pass, those after it in order, and the workgroups of each for one layer.
fn plan(kernel: FftKernel, size: u32) -> (&'static Pass, Vec<Next>, u32) {
    match kernel {
        FftKernel::Lines => (&ROWS, vec![(&COLUMNS, vec![])], size.div_ceil(FFT_BLOCK / size)),
        FftKernel::Stages => {
            let done = || (0..).map(|stage| FFT_POINTS.pow(stage)).take_while(|&done| done < size);
            let stage = |done: u32, x: bool| (&STAGE, vec![("DONE", done.into()), ("ALONG_X", f64::from(u8::from(x)))]);
            let along_x = done().skip(1).map(|done| stage(done, true));
            let along_z = done().map(|done| stage(done, false));
            let threads = size * size / FFT_POINTS;
            (&FIRST, along_x.chain(along_z).collect(), threads.div_ceil(FFT_THREADS))
        }
    }
}

impl Synthesis {
    pub(super) fn new(
        device: &wgpu::Device,
        kernel: FftKernel,
        shape: Shape,
        ocean: &Ocean,
        params: &wgpu::Buffer,
    ) -> Self {
        let modes = ModeTextures::new(device, shape, ocean);
        let (fields, [displacement, derivative]) = upload::texture(device, "ocean fields", shape, FORMAT, 1);
        let (half_done, _) = upload::texture(device, "ocean half done", shape, FORMAT, 1);
        // The textures take turns so that the last stage writes the fields.
        let pair = [upload::level(&fields, 0), upload::level(&half_done, 0)];
        let [amplitudes, turns] = modes.views();

        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::Uniform { size: size_of::<OceanParams>() };
        let read = Slot::TextureArray { filterable: false };
        let write = Slot::WriteTextureArray { format: FORMAT };
        let (first, rest, workgroups) = plan(kernel, shape.size);
        let dispatch = |pass: &Pass, constants: &[(&str, f64)], inputs: &[(Slot, &wgpu::TextureView)], after: usize| {
            let mut slots = vec![uniform];
            let mut resources = vec![params.as_entire_binding()];
            for (slot, input) in inputs {
                slots.push(*slot);
                resources.push(wgpu::BindingResource::TextureView(input));
            }
            slots.push(write);
            resources.push(wgpu::BindingResource::TextureView(&pair[after % 2]));
            let layout = group_layout(device, pass.name, compute, &slots);
            let constants = [&[("N", f64::from(shape.size))], constants].concat();
            Dispatch {
                pipeline: compute_pipeline(device, pass, pass.entry_points[0], &[&layout], &constants),
                group: bind_group(device, pass.name, &layout, &resources),
                workgroups,
            }
        };
        let inputs = [(read, &amplitudes), (Slot::UintTextureArray, &turns)];
        let mut dispatches = vec![dispatch(first, &[], &inputs, rest.len())];
        // `after` dispatches come after this one.
        for (after, (pass, constants)) in (0..rest.len()).rev().zip(&rest) {
            dispatches.push(dispatch(pass, constants, &[(read, &pair[(after + 1) % 2])], after));
        }
        Self { modes, dispatches, fields, displacement, derivative }
    }

    pub(super) fn dispatches(&self) -> u32 {
        self.dispatches.len() as u32
    }

    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, shape: Shape) {
        for Dispatch { pipeline, group, workgroups } in &self.dispatches {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(*workgroups, 1, shape.layers());
        }
    }
}

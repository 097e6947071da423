//! Modes to fields: one dispatch per stage, each from one texture to the next.

use std::ops::Range;

use open_water_shaders::ocean::OceanParams;
use open_water_shaders::pipeline::{Frame, Slot, bind_group, compute_pipeline, group_layout};

use super::GpuPass;
use super::modes::ModeTextures;
use super::stages::{self, Class, Step, classes, steps};
use super::upload::{self, Shape};
use crate::{CascadeModes, Ocean};

/// How the transforms run. The results are the same to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FftKernel {
    /// Whole lines in workgroup memory: 2 dispatches for all cascades. For GPUs.
    Lines,
    /// A dispatch per stage from texture to texture, without workgroup memory: 2 for each direction (1 up to 32 texels, 3
    /// along z at 1,024); cascades that are filled differently do not share them. For adapters that run on the CPU,
    /// where reads from buffers and workgroup memory are slow, and a branch does not spare work.
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

#[derive(Debug, Clone)]
struct Dispatch {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: [u32; 2],
    info: GpuPass,
}

#[derive(Debug, Clone)]
pub(super) struct Synthesis {
    device: wgpu::Device,
    kernel: FftKernel,
    shape: Shape,
    params: wgpu::Buffer,
    /// See [`stages::half`], by cascade.
    pub(super) halves: Vec<u32>,
    modes: ModeTextures,
    /// The first stage of each class while one mode set is in use, and, once it was needed, while two are mixed.
    first: [Vec<Dispatch>; 2],
    /// The other stages of each class.
    rest: Vec<Vec<Dispatch>>,
    is_mixed: bool,
    half_done: wgpu::Texture,
    pub(super) fields: wgpu::Texture,
    pub(super) displacement: wgpu::TextureView,
    pub(super) derivative: wgpu::TextureView,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const READ: Slot = Slot::TextureArray { filterable: false };

impl Synthesis {
    pub(super) fn new(
        device: &wgpu::Device,
        kernel: FftKernel,
        shape: Shape,
        modes: &[CascadeModes],
        params: &wgpu::Buffer,
    ) -> Self {
        let (fields, [displacement, derivative]) = upload::texture(device, "ocean fields", shape, FORMAT, 1);
        let (half_done, _) = upload::texture(device, "ocean half done", shape, FORMAT, 1);
        let mut synthesis = Self {
            device: device.clone(),
            kernel,
            shape,
            params: params.clone(),
            halves: modes.iter().map(stages::half).collect(),
            modes: ModeTextures::new(device, shape, false),
            first: [const { Vec::new() }; 2],
            rest: Vec::new(),
            is_mixed: false,
            half_done,
            fields,
            displacement,
            derivative,
        };
        synthesis.make_stages();
        synthesis
    }

    /// Takes over the mode sets of a time. What two of them need is made when it is needed first.
    pub(super) fn set(&mut self, frame: &mut Frame<'_>, ocean: &Ocean, t: f64) {
        let (first, second) = ocean.mode_sets_at(t);
        self.suit(first);
        self.is_mixed = second.is_some();
        if self.is_mixed {
            self.prepare_mixed();
        }
        self.modes.set(frame, ocean, t);
    }

    /// Whether the stages are those for these modes.
    pub(super) fn suits(&self, modes: &[CascadeModes]) -> bool {
        modes.iter().map(stages::half).eq(self.halves.iter().copied())
    }

    /// Makes the stages for these modes.
    pub(super) fn suit(&mut self, modes: &[CascadeModes]) {
        if !self.suits(modes) {
            self.halves = modes.iter().map(stages::half).collect();
            self.make_stages();
        }
    }

    /// Will upload the modes anew: another may have used the textures.
    pub(super) fn forget(&mut self) {
        self.modes.forget();
    }

    /// Whether two mode sets can be mixed at once.
    pub(super) fn mixes(&self) -> bool {
        !self.first[1].is_empty()
    }

    /// Makes what two mode sets need.
    pub(super) fn prepare_mixed(&mut self) {
        if !self.modes.is_mixed() {
            self.modes = ModeTextures::new(&self.device, self.shape, true);
            self.first[0] = self.first_stages(false);
        }
        if self.first[1].is_empty() {
            self.first[1] = self.first_stages(true);
        }
    }

    fn make_stages(&mut self) {
        self.first = [self.first_stages(false), Vec::new()];
        let pair = self.pair();
        let classes = self.classes();
        let rest = classes.iter().map(|class| {
            let steps = steps(self.kernel, self.shape, class, false);
            // The textures take turns so that the last stage writes the fields.
            let afters = (0..steps.len() - 1).rev();
            steps[1..]
                .iter()
                .zip(afters)
                .map(|(step, after)| self.dispatch(step, class, &[(READ, &pair[(after + 1) % 2])], &pair[after % 2]))
                .collect()
        });
        self.rest = rest.collect();
    }

    fn first_stages(&self, mixed: bool) -> Vec<Dispatch> {
        let [amplitudes, turns] = self.modes.views();
        let inputs = [(READ, &amplitudes), (Slot::UintTextureArray, &turns)];
        let pair = self.pair();
        self.classes()
            .iter()
            .map(|class| {
                let steps = steps(self.kernel, self.shape, class, mixed);
                self.dispatch(&steps[0], class, &inputs, &pair[(steps.len() - 1) % 2])
            })
            .collect()
    }

    fn classes(&self) -> Vec<Class> {
        classes(self.kernel, self.shape.size, &self.halves)
    }

    fn pair(&self) -> [wgpu::TextureView; 2] {
        [&self.fields, &self.half_done].map(|texture| upload::level(texture, 0))
    }

    fn dispatch(
        &self,
        step: &Step,
        class: &Class,
        inputs: &[(Slot, &wgpu::TextureView)],
        output: &wgpu::TextureView,
    ) -> Dispatch {
        let Step { pass, constants, workgroups, bytes } = step;
        let mut slots = vec![Slot::Uniform { size: size_of::<OceanParams>() }];
        let mut resources = vec![self.params.as_entire_binding()];
        for (slot, input) in inputs {
            slots.push(*slot);
            resources.push(wgpu::BindingResource::TextureView(input));
        }
        slots.push(Slot::WriteTextureArray { format: FORMAT });
        resources.push(wgpu::BindingResource::TextureView(output));
        let layout = group_layout(&self.device, pass.name, wgpu::ShaderStages::COMPUTE, &slots);
        Dispatch {
            pipeline: compute_pipeline(&self.device, pass, pass.entry_points[0], &[&layout], constants),
            group: bind_group(&self.device, pass.name, &layout, &resources),
            workgroups: *workgroups,
            info: GpuPass { name: pass.name, cascades: class.cascades.clone(), bytes: *bytes },
        }
    }

    fn dispatches(&self) -> impl Iterator<Item = &Dispatch> {
        let first = &self.first[usize::from(self.is_mixed)];
        first.iter().zip(&self.rest).flat_map(|(first, rest)| std::iter::once(first).chain(rest))
    }

    pub(super) fn passes(&self) -> impl Iterator<Item = &GpuPass> {
        self.dispatches().map(|dispatch| &dispatch.info)
    }

    /// The dispatches of so many cascades, the longest first.
    pub(super) fn count(&self, cascades: u32) -> u32 {
        self.passes().filter(|pass| pass.cascades.start < cascades).count() as u32
    }

    /// Records one dispatch, or all, for so many cascades, the longest first. Returns how many were recorded.
    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, only: Option<usize>, cascades: u32) -> u32 {
        let chosen = self.dispatches().enumerate().filter(|(i, _)| only.is_none_or(|only| *i == only));
        let mut recorded = 0;
        for (_, Dispatch { pipeline, group, workgroups: [x, z], info }) in chosen {
            let Range { start, end } = info.cascades;
            let wanted = cascades.clamp(start, end) - start;
            if wanted == 0 {
                continue;
            }
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(*x, 1, z / (end - start) * wanted);
            recorded += 1;
        }
        recorded
    }
}

//! The pipelines of the passes of dispersive grids, their layouts and groups.

use open_water_shaders::grid::{self as shader, StepShape, TickWater};
use open_water_shaders::pipeline::{Slot, compute_pipeline, group_layout};

/// Pipelines, and layouts of group 1.
#[derive(Debug)]
pub(super) struct WaterPasses {
    pub(super) medium_layout: wgpu::BindGroupLayout,
    pub(super) prepare_layout: wgpu::BindGroupLayout,
    pub(super) step_layout: wgpu::BindGroupLayout,
    pub(super) medium: wgpu::ComputePipeline,
    pub(super) prepare: wgpu::ComputePipeline,
    /// Without and with the last sub-step's work, each without and with mixed tiles.
    pub(super) step: [[wgpu::ComputePipeline; 2]; 2],
}

/// Group 1 of each pass.
#[derive(Debug)]
pub(super) struct WaterGroups {
    pub(super) medium: wgpu::BindGroup,
    pub(super) prepare: wgpu::BindGroup,
    pub(super) step: wgpu::BindGroup,
}

impl WaterPasses {
    pub(super) fn new(device: &wgpu::Device, state: &wgpu::BindGroupLayout, shape: StepShape) -> Self {
        let params = Slot::DynamicUniform { size: size_of::<TickWater>() };
        let layout = |others: &[Slot]| {
            // Parameters, fields, faces.
            let slots: Vec<_> = [&[params, Slot::ReadWrite, Slot::ReadWrite], others].concat();
            group_layout(device, "grid water", wgpu::ShaderStages::COMPUTE, &slots)
        };
        let medium_layout = layout(&[Slot::Read]);
        let prepare_layout = layout(&[Slot::Read, Slot::Read]);
        let step_layout = layout(&[Slot::Read, Slot::Read, Slot::ReadWrite]);
        let [rows, threads] = [shape.rows, shape.threads].map(f64::from);
        let pipeline = |pass: &open_water_shaders::Pass, layout, constants: &[(&str, f64)]| {
            compute_pipeline(device, pass, pass.name, &[state, layout], constants)
        };
        const BOTH: [f64; 2] = [0.0, 1.0];
        let step = |last, mixed| {
            let constants = [("LAST", last), ("MIXED", mixed), ("ROWS", rows), ("THREADS", threads)];
            pipeline(&shader::WATER_STEP, &step_layout, &constants)
        };
        Self {
            medium: pipeline(&shader::WATER_MEDIUM, &medium_layout, &[]),
            prepare: pipeline(&shader::WATER_PREPARE, &prepare_layout, &[("ROWS", rows)]),
            step: BOTH.map(|last| BOTH.map(|mixed| step(last, mixed))),
            medium_layout,
            prepare_layout,
            step_layout,
        }
    }
}

//! The pipelines of the grid passes and their layouts.

use super::MAX_GRIDS;
use open_water_shaders::grid::{self as shader, GridDispatch, GridDraw, TickParams};
use open_water_shaders::pipeline::{Slot, compute_pipeline, group_layout};

/// Bytes between the dispatches' uniforms: WebGPU's alignment of dynamic offsets.
pub(super) const DISPATCH_STRIDE: u32 = 256;

/// Pipelines and layouts.
#[derive(Debug)]
pub(super) struct Passes {
    pub(super) state_layout: wgpu::BindGroupLayout,
    pub(super) draw_layout: wgpu::BindGroupLayout,
    /// For grids that stood, and for ones that may have moved.
    pub(super) prepare: [wgpu::ComputePipeline; 2],
    /// Without and with cells of the layer, each without and with the last sub-step's work.
    pub(super) step: [[wgpu::ComputePipeline; 2]; 2],
    pub(super) draw: wgpu::ComputePipeline,
}

impl Passes {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::DynamicUniform { size: size_of::<GridDispatch>() };
        let params = Slot::DynamicUniform { size: size_of::<TickParams>() };
        let state = [uniform, params, Slot::Read, Slot::Read, Slot::ReadWrite, Slot::ReadWrite];
        let draws = Slot::Uniform { size: MAX_GRIDS * size_of::<GridDraw>() };
        let state_layout = group_layout(device, "grid state", compute, &state);
        let draw_layout = group_layout(device, "grid draw", compute, &[draws, Slot::Read, Slot::ReadWrite]);
        let pipeline = |pass: &open_water_shaders::Pass, layout: &wgpu::BindGroupLayout, constants: &[(&str, f64)]| {
            compute_pipeline(device, pass, pass.name, &[layout], constants)
        };
        let step = |layer, last| pipeline(&shader::STEP, &state_layout, &[("LAYER", layer), ("LAST", last)]);
        Self {
            prepare: [0.0, 1.0].map(|moved| pipeline(&shader::PREPARE, &state_layout, &[("MOVED", moved)])),
            step: [0.0, 1.0].map(|layer| [0.0, 1.0].map(|last| step(layer, last))),
            draw: pipeline(&shader::DRAW, &draw_layout, &[]),
            state_layout,
            draw_layout,
        }
    }
}

//! The pipelines of the grid passes and their layouts.

use super::MAX_GRIDS;
use super::pack::{Kind, TileKind};
use super::water_pass::WaterPasses;
use open_water_shaders::grid::{self as shader, GridDispatch, GridDraw, StepShape, TickParams};
use open_water_shaders::pipeline::{Slot, compute_pipeline, group_layout};

/// Bytes between the dispatches' uniforms: WebGPU's alignment of dynamic offsets.
pub(super) const DISPATCH_STRIDE: u32 = 256;

/// Pipelines and layouts.
#[derive(Debug)]
pub(super) struct Passes {
    pub(super) state_layout: wgpu::BindGroupLayout,
    /// Group 1 of the schedule, and of all others.
    pub(super) schedule_layout: wgpu::BindGroupLayout,
    pub(super) lists_layout: wgpu::BindGroupLayout,
    pub(super) draw_layout: wgpu::BindGroupLayout,
    medium: wgpu::ComputePipeline,
    schedule: wgpu::ComputePipeline,
    /// For grids that stood, and for ones that may have moved; each without and with mixed tiles.
    prepare: [[wgpu::ComputePipeline; 2]; 2],
    /// Without and with cells of the layer, each without and with the last sub-step's work, each of plain tiles and of
    /// mixed ones.
    step: [[[wgpu::ComputePipeline; 2]; 2]; 2],
    /// Without and with grids that have walls, each without and with ones that have holes.
    pub(super) draw: [[wgpu::ComputePipeline; 2]; 2],
    shape: StepShape,
    /// Once there has been a dispersive grid.
    pub(super) water: Option<WaterPasses>,
}

impl Passes {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::DynamicUniform { size: size_of::<GridDispatch>() };
        let params = Slot::DynamicUniform { size: size_of::<TickParams>() };
        let (read, write) = (Slot::Read, Slot::ReadWrite);
        let state = [uniform, params, write, write, write];
        let draws = Slot::Uniform { size: MAX_GRIDS * size_of::<GridDraw>() };
        let state_layout = group_layout(device, "grid state", compute, &state);
        let lists_layout = group_layout(device, "grid lists", compute, &[read, read, read, read, write]);
        let schedule_layout = group_layout(device, "grid schedule", compute, &[read, write, write, write]);
        let draw_layout = group_layout(device, "grid draw", compute, &[draws, read, write, read]);
        let pipeline =
            |pass: &open_water_shaders::Pass, layouts: &[&wgpu::BindGroupLayout], constants: &[(&str, f64)]| {
                compute_pipeline(device, pass, pass.name, layouts, constants)
            };
        let listed = [&state_layout, &lists_layout];
        const BOTH: [f64; 2] = [0.0, 1.0];
        let prepare = |moved, medium| pipeline(&shader::PREPARE, &listed, &[("MOVED", moved), ("MEDIUM", medium)]);
        let shape = match device.adapter_info().device_type {
            wgpu::DeviceType::Cpu => StepShape::SOFTWARE,
            _ => StepShape::GPU,
        };
        let [rows, threads] = [shape.rows, shape.threads].map(f64::from);
        let step = |layer, last, mixed| {
            let kind = [("LAYER", layer), ("LAST", last), ("MIXED", mixed), ("ROWS", rows), ("THREADS", threads)];
            pipeline(&shader::STEP, &listed, &kind)
        };
        Self {
            schedule: pipeline(
                &shader::SCHEDULE,
                &[&state_layout, &schedule_layout],
                &[("TILES_PER_GROUP", f64::from(shape.tiles()))],
            ),
            medium: pipeline(&shader::MEDIUM, &listed, &[]),
            prepare: BOTH.map(|moved| BOTH.map(|medium| prepare(moved, medium))),
            step: BOTH.map(|layer| BOTH.map(|last| BOTH.map(|mixed| step(layer, last, mixed)))),
            draw: BOTH.map(|medium| {
                let draw = |holes| pipeline(&shader::DRAW, &[&draw_layout], &[("MEDIUM", medium), ("HOLES", holes)]);
                BOTH.map(draw)
            }),
            state_layout,
            draw_layout,
            schedule_layout,
            lists_layout,
            shape,
            water: None,
        }
    }

    /// Compiles what dispersive grids need, once.
    pub(super) fn need_water(&mut self, device: &wgpu::Device) {
        if self.water.is_none() {
            self.water = Some(WaterPasses::new(device, &self.state_layout, self.shape));
        }
    }

    /// The pipeline of a dispatch; `None` where what dispersive grids need has not been compiled.
    pub(super) fn of(&self, kind: Kind) -> Option<&wgpu::ComputePipeline> {
        Some(match kind {
            Kind::Medium => &self.medium,
            Kind::Schedule => &self.schedule,
            Kind::Prepare { moved, medium } => &self.prepare[usize::from(moved)][usize::from(medium)],
            Kind::Step { tiles, last } => {
                let TileKind { layer, mixed } = tiles;
                &self.step[usize::from(layer)][usize::from(last)][usize::from(mixed)]
            }
            Kind::WaterMedium => &self.water.as_ref()?.medium,
            Kind::WaterPrepare => &self.water.as_ref()?.prepare,
            Kind::WaterStep { mixed, last } => &self.water.as_ref()?.step[usize::from(last)][usize::from(mixed)],
        })
    }
}

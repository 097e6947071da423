//! The pipelines of the grid passes and their layouts. They are compiled when the first grid needs them, or beside before that.

use std::sync::{Arc, OnceLock};

use super::MAX_GRIDS;
use super::pack::{Kind, TileKind};
use super::water_pass::WaterPasses;
use open_water_shaders::grid::{self as shader, GridDispatch, GridDraw, StepShape, TickParams};
use open_water_shaders::pipeline::{Slot, compute_pipeline, group_layout, guarded};

/// Bytes between the dispatches' uniforms: WebGPU's alignment of dynamic offsets.
pub(super) const DISPATCH_STRIDE: u32 = 256;

/// Layouts that do not depend on what grids there are.
#[derive(Debug, Clone)]
pub(super) struct Layouts {
    pub(super) state: wgpu::BindGroupLayout,
    /// Group 1 of the schedule, and of all others.
    pub(super) schedule: wgpu::BindGroupLayout,
    pub(super) lists: wgpu::BindGroupLayout,
    pub(super) draw: wgpu::BindGroupLayout,
}

impl Layouts {
    fn new(device: &wgpu::Device) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::DynamicUniform { size: size_of::<GridDispatch>() };
        let params = Slot::DynamicUniform { size: size_of::<TickParams>() };
        let (read, write) = (Slot::Read, Slot::ReadWrite);
        let draws = Slot::Uniform { size: MAX_GRIDS * size_of::<GridDraw>() };
        Self {
            state: group_layout(device, "grid state", compute, &[uniform, params, write, write, write]),
            schedule: group_layout(device, "grid schedule", compute, &[read, write, write, write]),
            lists: group_layout(device, "grid lists", compute, &[read, read, read, read, write]),
            draw: group_layout(device, "grid draw", compute, &[draws, read, write, read]),
        }
    }
}

/// The pipelines that all grids need.
#[derive(Debug)]
pub(super) struct WavePasses {
    medium: wgpu::ComputePipeline,
    schedule: wgpu::ComputePipeline,
    /// For grids that stood, and for ones that may have moved; each without and with mixed tiles.
    prepare: [[wgpu::ComputePipeline; 2]; 2],
    /// Without and with cells of the layer, each without and with the last sub-step's work, each of plain tiles and of
    /// mixed ones.
    step: [[[wgpu::ComputePipeline; 2]; 2]; 2],
    /// Without and with grids that have walls, each without and with ones that have holes.
    pub(super) draw: [[wgpu::ComputePipeline; 2]; 2],
}

impl WavePasses {
    fn new(device: &wgpu::Device, layouts: &Layouts, shape: StepShape) -> Self {
        let pipeline =
            |pass: &open_water_shaders::Pass, layouts: &[&wgpu::BindGroupLayout], constants: &[(&str, f64)]| {
                compute_pipeline(device, pass, pass.name, layouts, constants)
            };
        let listed = [&layouts.state, &layouts.lists];
        const BOTH: [f64; 2] = [0.0, 1.0];
        let prepare = |moved, medium| pipeline(&shader::PREPARE, &listed, &[("MOVED", moved), ("MEDIUM", medium)]);
        let [rows, threads] = [shape.rows, shape.threads].map(f64::from);
        let step = |layer, last, mixed| {
            let kind = [("LAYER", layer), ("LAST", last), ("MIXED", mixed), ("ROWS", rows), ("THREADS", threads)];
            pipeline(&shader::STEP, &listed, &kind)
        };
        Self {
            schedule: pipeline(
                &shader::SCHEDULE,
                &[&layouts.state, &layouts.schedule],
                &[("TILES_PER_GROUP", f64::from(shape.tiles()))],
            ),
            medium: pipeline(&shader::MEDIUM, &listed, &[]),
            prepare: BOTH.map(|moved| BOTH.map(|medium| prepare(moved, medium))),
            step: BOTH.map(|layer| BOTH.map(|last| BOTH.map(|mixed| step(layer, last, mixed)))),
            draw: BOTH.map(|medium| {
                let draw = |holes| pipeline(&shader::DRAW, &[&layouts.draw], &[("MEDIUM", medium), ("HOLES", holes)]);
                BOTH.map(draw)
            }),
        }
    }
}

/// What is compiled once, by whoever comes first; `None` where it was refused.
#[derive(Debug)]
struct Late<T>(Arc<OnceLock<Option<T>>>);

impl<T> Late<T> {
    fn get(&self) -> Option<&T> {
        self.0.get()?.as_ref()
    }

    /// Makes it unless it is there; where it is being made beside, waits for that. Returns whether it is there.
    fn need(&mut self, device: &wgpu::Device, make: impl Fn() -> T) -> bool {
        if self.0.get_or_init(|| guarded(device, &make).ok()).is_some() {
            return true;
        }
        // Another grid tries anew, and whoever guards this call is told why.
        self.0 = Arc::default();
        make();
        false
    }

    /// Whether it is there, or was refused.
    fn is_over(&self) -> bool {
        self.0.get().is_some()
    }
}

/// Pipelines and layouts.
#[derive(Debug)]
pub(super) struct Passes {
    pub(super) layouts: Layouts,
    shape: StepShape,
    waves: Late<WavePasses>,
    /// What dispersive grids need besides.
    water: Late<WaterPasses>,
    /// They are made beside, or were.
    beside: bool,
}

impl Passes {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let shape = match device.adapter_info().device_type {
            wgpu::DeviceType::Cpu => StepShape::SOFTWARE,
            _ => StepShape::GPU,
        };
        Self {
            layouts: Layouts::new(device),
            shape,
            waves: Late(Arc::default()),
            water: Late(Arc::default()),
            beside: false,
        }
    }

    /// Compiles what grids need, dispersive ones if there is any `water`, once.
    pub(super) fn need(&mut self, device: &wgpu::Device, water: bool) {
        let Self { layouts, shape, .. } = self;
        let made = self.waves.need(device, || WavePasses::new(device, layouts, *shape))
            && (!water || self.water.need(device, || WaterPasses::new(device, &layouts.state, *shape)));
        self.beside &= made;
    }

    /// Does the same for all that there may be, on any thread; `None` where that was asked for already.
    pub(super) fn compiler(&mut self, device: &wgpu::Device) -> Option<impl FnOnce() + use<>> {
        if std::mem::replace(&mut self.beside, true) {
            return None;
        }
        let Self { layouts, shape, waves, water, .. } = self;
        let (device, layouts, shape) = (device.clone(), layouts.clone(), *shape);
        let (waves, water) = (Arc::clone(&waves.0), Arc::clone(&water.0));
        Some(move || {
            waves.get_or_init(|| guarded(&device, || WavePasses::new(&device, &layouts, shape)).ok());
            water.get_or_init(|| guarded(&device, || WaterPasses::new(&device, &layouts.state, shape)).ok());
        })
    }

    /// Whether all that [`Self::compiler`] compiles is there, or was refused.
    pub(super) fn is_over(&self) -> bool {
        self.waves.is_over() && self.water.is_over()
    }

    /// What dispersive grids need; `None` before it has been compiled.
    pub(super) fn water(&self) -> Option<&WaterPasses> {
        self.water.get()
    }

    /// What all need; `None` before it has been compiled.
    pub(super) fn waves(&self) -> Option<&WavePasses> {
        self.waves.get()
    }

    /// The pipeline of a dispatch; `None` where it has not been compiled.
    pub(super) fn of(&self, kind: Kind) -> Option<&wgpu::ComputePipeline> {
        let waves = self.waves.get()?;
        Some(match kind {
            Kind::Medium => &waves.medium,
            Kind::Schedule => &waves.schedule,
            Kind::Prepare { moved, medium } => &waves.prepare[usize::from(moved)][usize::from(medium)],
            Kind::Step { tiles, last } => {
                let TileKind { layer, mixed } = tiles;
                &waves.step[usize::from(layer)][usize::from(last)][usize::from(mixed)]
            }
            Kind::WaterMedium => &self.water()?.medium,
            Kind::WaterPrepare => &self.water()?.prepare,
            Kind::WaterStep { mixed, last } => &self.water()?.step[usize::from(last)][usize::from(mixed)],
        })
    }
}

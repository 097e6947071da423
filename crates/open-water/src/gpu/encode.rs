//! Turns a [`FramePlan`] into uploads and dispatches: the only place that does.

use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;

use super::Gpu;
use crate::grids::{Grids, Sim};
use crate::plan::{FramePlan, Work};

impl Gpu {
    pub(crate) fn encode(
        &mut self,
        plan: &FramePlan,
        ocean: Option<&Ocean>,
        grids: &mut Grids,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let moment = (plan.tick, plan.alpha);
        for work in &plan.work {
            match *work {
                Work::Table => {
                    self.shown.listed = grids.iter().filter(|grid| grid.is_awake()).count();
                    self.shown.shore = plan.shore;
                    let size = self.ocean.as_ref().map_or(1, GpuOcean::size);
                    self.surface.write_table(&self.queue, plan.time, ocean, grids.iter(), plan.shore.level, size);
                }
                Work::GridUpload { grid, .. } => {
                    if let Some(grid) = grids.get_mut(grid) {
                        self.upload(grid, plan.alpha);
                    }
                    self.shown.grids = Some(moment);
                }
                Work::Ocean { .. } => {
                    let looks = plan.work.contains(&Work::OceanLooks);
                    self.encode_ocean(plan, ocean, looks, encoder);
                    self.shown.ocean = Some((plan.tick, plan.alpha, looks));
                }
                // Recorded with the ocean, in the same compute pass.
                Work::OceanLooks => {}
                Work::GridSteps { .. } => self.remote.encode_steps(&self.queue, encoder),
                Work::GridDraw { .. } => {
                    self.remote.encode_draw(&self.queue, encoder, self.surface.pool(), plan, grids);
                }
            }
        }
    }

    fn upload(&mut self, grid: &mut crate::grids::Grid, alpha: f32) {
        let Sim::Cpu(waves) = &grid.sim else { return };
        self.scratch.resize(grid.cell_count() as usize, [0.0; 2]);
        waves.draw(alpha, &mut self.scratch);
        let offset = u64::from(grid.base) * size_of::<[f32; 2]>() as u64;
        self.queue.write_buffer(self.surface.pool(), offset, bytemuck::cast_slice(&self.scratch));
    }

    fn encode_ocean(
        &mut self,
        plan: &FramePlan,
        ocean: Option<&Ocean>,
        looks: bool,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let (Some(gpu), Some(ocean)) = (&mut self.ocean, ocean) else { return };
        if looks {
            gpu.encode(&self.queue, encoder, ocean, plan.time, (plan.time - self.looks_time).abs() as f32);
            self.looks_time = plan.time;
        } else {
            gpu.encode_fields(&self.queue, encoder, ocean, plan.time);
        }
    }

    /// Dispatches of the sea's fields, and of its looks.
    pub(crate) fn ocean_dispatches(&self) -> (u32, u32) {
        self.ocean.as_ref().map_or((0, 0), |ocean| (ocean.field_dispatches(), ocean.look_dispatches()))
    }
}

//! Turns a [`FramePlan`] into uploads and dispatches: the only place that does.
//!
//! Uploads first, then all dispatches in one compute pass, then what comes back.

use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;
use open_water_shaders::pipeline::{Frame, is_alive};

use super::Gpu;
use super::timer::Timer;
use crate::grids::{Grids, Sim};
use crate::plan::{FramePlan, Work};
use crate::trace::warning;

/// What the compute pass holds.
#[derive(Debug, Clone, Copy, Default)]
struct Parts {
    fields: bool,
    looks: bool,
    steps: bool,
    draw: bool,
}

impl Gpu {
    /// Returns whether the plan's work was encoded: not while the GPU is too far behind.
    pub(crate) fn encode(
        &mut self,
        plan: &FramePlan,
        ocean: Option<&Ocean>,
        grids: &mut Grids,
        encoder: &mut wgpu::CommandEncoder,
    ) -> bool {
        if let Some(timer) = &mut self.timer {
            timer.poll(&self.device);
        }
        if plan.work.is_empty() {
            return true;
        }
        // Not in its place while the frame writes.
        let Some(mut staging) = self.staging.take() else { return false };
        let encoded = staging.frame(encoder).map(|mut frame| self.encode_frame(plan, ocean, grids, &mut frame));
        if encoded.is_none() && !staging.is_full() {
            // Nothing can be written: the device is lost, or has no memory left.
            self.lost = !is_alive(&self.device);
            if self.lost {
                warning!(tick = plan.tick, "the device is lost");
            }
        }
        self.staging = Some(staging);
        encoded.is_some()
    }

    fn encode_frame(&mut self, plan: &FramePlan, ocean: Option<&Ocean>, grids: &mut Grids, frame: &mut Frame<'_>) {
        let parts = self.upload(plan, ocean, grids, frame);
        let Parts { fields, looks, steps, draw } = parts;
        if fields || steps || draw {
            let of = wgpu::ComputePassDescriptor {
                label: Some("water"),
                timestamp_writes: self.timer.as_ref().map(Timer::around),
            };
            let mut pass = frame.encoder.begin_compute_pass(&of);
            if let Some(ocean) = &self.ocean {
                if fields {
                    ocean.record_fields(&mut pass);
                }
                if looks {
                    ocean.record_looks(&mut pass);
                }
            }
            if let Some(timer) = &self.timer {
                timer.between(&mut pass);
            }
            if steps {
                self.remote.record_steps(&mut pass);
            }
            if draw {
                self.remote.record_draw(&mut pass);
            }
            drop(pass);
            if let Some(timer) = &mut self.timer {
                timer.finish(frame.encoder, plan);
            }
        }
        if steps {
            self.remote.finish_steps(frame);
        }
        self.remote.finish_copies(frame, grids);
    }

    fn upload(&mut self, plan: &FramePlan, ocean: Option<&Ocean>, grids: &mut Grids, frame: &mut Frame<'_>) -> Parts {
        let moment = (plan.tick, plan.alpha);
        let mut parts = Parts::default();
        if self.losses != frame.losses() {
            self.uploads.forget();
        }
        self.shown = self.held(frame.losses());
        let ready = ocean.is_none_or(|ocean| self.follow_sea(ocean, plan.time));
        for work in &plan.work {
            match *work {
                // Until its textures are there, the sea is shown as it was.
                Work::Table | Work::Ocean { .. } if !ready => {}
                Work::Table => {
                    self.shown.listed = grids.iter().filter(|grid| grid.is_awake()).count();
                    self.shown.shore = plan.shore;
                    self.shown.dry = plan.dry.mark(plan.tick, plan.alpha);
                    let size = self.ocean.as_ref().map_or(1, GpuOcean::size);
                    self.surface.write_table(frame, plan.time, ocean, grids.iter(), plan.shore, size);
                }
                Work::GridUpload { grid, .. } => {
                    if let Ok(grid) = grids.get(grid)
                        && let Sim::Cpu(waves) = &grid.sim
                    {
                        let place = (self.surface.pool(), grid.base);
                        self.uploads.write(frame, place, (grid.id, waves), plan.alpha);
                    }
                    self.shown.grids = Some(moment);
                }
                Work::Ocean { .. } => {
                    let (Some(gpu), Some(ocean)) = (&mut self.ocean, ocean) else { continue };
                    parts.fields = true;
                    parts.looks = plan.work.contains(&Work::OceanLooks);
                    let foam_dt = (plan.time - self.looks_time).abs() as f32;
                    gpu.set_time(frame, ocean, plan.time, if parts.looks { foam_dt } else { 0.0 });
                    if parts.looks {
                        self.looks_time = plan.time;
                    }
                    self.shown.ocean = Some((plan.tick, plan.alpha, parts.looks));
                }
                // Recorded with the ocean.
                Work::OceanLooks => {}
                Work::GridSteps { .. } => parts.steps = self.remote.upload_steps(frame),
                Work::GridDraw { .. } => {
                    let remote = grids.iter().filter(|grid| matches!(grid.sim, Sim::Gpu(_)));
                    remote.for_each(|grid| self.uploads.forget_grid(grid.id));
                    parts.draw = self.remote.upload_draw(frame, self.surface.pool(), plan, grids);
                }
            }
        }
        self.losses = frame.losses();
        frame.watch();
        parts
    }

    /// Dispatches of the sea's fields, and of its looks.
    pub(crate) fn ocean_dispatches(&self) -> (u32, u32) {
        self.ocean.as_ref().map_or((0, 0), |ocean| (ocean.field_dispatches(), ocean.look_dispatches()))
    }
}

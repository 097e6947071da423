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
use crate::planner::{Shown, ShownSea};
use crate::trace::warning;

/// What [`OpenWater::encode`](crate::OpenWater::encode) really recorded.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Encoded {
    /// Compute dispatches.
    pub dispatches: u32,
    /// Bytes uploaded, the tables of passes and of the surface included.
    pub bytes: u64,
}

/// What the compute pass holds.
#[derive(Debug, Clone, Copy, Default)]
struct Parts {
    /// Cascades to be made.
    fields: u32,
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
        self.encoded = Encoded::default();
        if plan.work.is_empty() {
            return true;
        }
        // Not in its place while the frame writes.
        let Some(mut staging) = self.staging.take() else { return false };
        let before = staging.uploaded();
        let encoded = staging.frame(encoder).map(|mut frame| self.encode_frame(plan, ocean, grids, &mut frame));
        if encoded.is_none() && !staging.is_full() {
            // Nothing can be written: the device is lost, or has no memory left.
            self.lost = !is_alive(&self.device);
            if self.lost {
                warning!(tick = plan.tick, "the device is lost");
            }
        }
        self.encoded.bytes = staging.uploaded() - before;
        self.staging = Some(staging);
        encoded.is_some()
    }

    fn encode_frame(&mut self, plan: &FramePlan, ocean: Option<&Ocean>, grids: &mut Grids, frame: &mut Frame<'_>) {
        let parts = self.upload(plan, ocean, grids, frame);
        let Parts { fields, looks, steps, draw } = parts;
        if fields > 0 || steps || draw {
            let of = wgpu::ComputePassDescriptor {
                label: Some("water"),
                timestamp_writes: self.timer.as_ref().map(Timer::around),
            };
            let mut pass = frame.encoder.begin_compute_pass(&of);
            if let Some(ocean) = &self.ocean {
                self.encoded.dispatches += ocean.record_fields(&mut pass, fields);
                if looks {
                    self.encoded.dispatches += ocean.record_looks(&mut pass, fields);
                }
            }
            if let Some(timer) = &self.timer {
                timer.between(&mut pass);
            }
            if steps {
                self.encoded.dispatches += self.remote.record_steps(&mut pass);
            }
            if draw {
                self.encoded.dispatches += self.remote.record_draw(&mut pass);
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
        if frame.losses() != self.losses {
            self.uploads.forget();
            self.shown = Shown::default();
        }
        let ready = ocean.is_none_or(|ocean| self.follow_sea(ocean, plan.time));
        for work in &plan.work {
            match *work {
                // Until its textures are there, the sea is shown as it was.
                Work::Table | Work::Ocean { .. } if !ready => {}
                Work::Table => {
                    self.shown.listed.clone_from(&plan.listed);
                    self.shown.shore = plan.shore;
                    self.shown.dry = plan.dry.mark(plan.tick, plan.alpha);
                    let size = self.ocean.as_ref().map_or(1, GpuOcean::size);
                    let listed = grids.iter().filter(|grid| plan.listed.contains(&grid.id));
                    let sea = ocean.map(|ocean| (ocean, self.cascades_of(plan)));
                    self.surface.write_table(frame, plan.time, sea, listed, plan.shore, size);
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
                Work::Ocean { cascades } => {
                    let (Some(gpu), Some(ocean)) = (&mut self.ocean, ocean) else { continue };
                    parts.fields = cascades.min(gpu.cascades());
                    parts.looks = plan.work.contains(&Work::OceanLooks);
                    let foam_dt = (plan.time - self.looks_time).abs() as f32;
                    gpu.set_time(frame, ocean, plan.time, if parts.looks { foam_dt } else { 0.0 });
                    if parts.looks {
                        self.looks_time = plan.time;
                    }
                    self.shown.ocean = Some(ShownSea {
                        time: plan.time,
                        looks: parts.looks,
                        cascades: parts.fields as usize,
                        sets: ocean.moment_at(plan.time).sets,
                    });
                }
                // Recorded with the ocean.
                Work::OceanLooks => {}
                Work::GridSteps { .. } => parts.steps = self.remote.upload_steps(frame),
                Work::GridDraw { .. } => {
                    let remote = grids.iter().filter(|grid| matches!(grid.sim, Sim::Gpu(_)));
                    remote.for_each(|grid| self.uploads.forget_grid(grid.id));
                    parts.draw = self.remote.upload_draw(frame, self.surface.pool(), plan, grids);
                    self.shown.grids = Some(moment);
                }
            }
        }
        self.losses = frame.losses();
        frame.watch();
        parts
    }

    /// Cascades that the textures hold once the plan's work is done.
    fn cascades_of(&self, plan: &FramePlan) -> usize {
        let made = plan.work.iter().find_map(|work| match work {
            Work::Ocean { cascades } => Some(*cascades as usize),
            _ => None,
        });
        made.or(self.shown.ocean.map(|shown| shown.cascades)).unwrap_or(usize::MAX)
    }

    /// Dispatches of so many cascades, the longest first.
    pub(crate) fn ocean_dispatches(&self, cascades: u32, looks: bool) -> u32 {
        let Some(ocean) = &self.ocean else { return 0 };
        ocean.field_dispatches(cascades) + if looks { ocean.look_dispatches() } else { 0 }
    }
}

//! What a frame does for the grids that are stepped on the GPU, and how old what is known of them is.

use crate::OpenWaterError;
use crate::grids::Sim;
use crate::plan::{FramePlan, Reason, SkippedWork, Work};
use crate::planner::Shown;
use crate::rules;
use crate::water::OpenWater;

impl OpenWater {
    /// How many ticks old the heights are from which samples of a grid are carried on: 0 for a CPU-homed one, `None` for a
    /// GPU-homed one of which nothing has come back since its waves began, or that has none (it samples as calm). See
    /// [`WaterSample::age`](crate::WaterSample::age).
    ///
    /// # Errors
    /// There is no such grid.
    pub fn grid_age(&self, id: crate::GridId) -> Result<Option<u64>, OpenWaterError> {
        Ok(match &self.grids.present(id)?.sim {
            Sim::Cpu(_) => Some(0),
            Sim::Gpu(remote) => remote.mirror.tick().map(|tick| self.tick.saturating_sub(tick)),
        })
    }

    /// GPU-homed grids step and come back whether anybody looks or not: else the water would depend on the view.
    pub(crate) fn plan_remote(&self, shown: &Shown, plan: &mut FramePlan) {
        let Some(gpu) = &self.gpu else { return };
        if gpu.lost {
            let lost = self.grids.iter().filter(|grid| matches!(grid.sim, Sim::Gpu(_)));
            lost.for_each(|grid| plan.skip(SkippedWork::Grid(grid.id), Reason::DeviceLost));
            return;
        }
        let pending = gpu.remote.grids.pending_dispatches() as u32;
        if pending > 0 {
            plan.run(Work::GridSteps { dispatches: pending });
            plan.dispatches += pending;
        }
        let (mut drawn, mut changed) = (0, pending > 0);
        for grid in self.grids.iter() {
            if !matches!(grid.sim, Sim::Gpu(_)) {
                continue;
            }
            if rules::asleep(self.rules, grid) {
                plan.skip(SkippedWork::Grid(grid.id), Reason::Asleep);
            } else {
                drawn += 1;
                plan.list(grid.id);
                changed |= !shown.has_grid(self.rules, grid, (plan.tick, plan.alpha));
            }
        }
        if !changed {
            let unchanged = self.grids.iter().filter(|grid| matches!(grid.sim, Sim::Gpu(_)) && grid.is_awake());
            unchanged.for_each(|grid| plan.skip(SkippedWork::Grid(grid.id), Reason::Unchanged));
            drawn = 0;
        }
        if drawn > 0 {
            plan.run(Work::GridDraw { grids: drawn });
            plan.dispatches += 1;
        }
    }
}

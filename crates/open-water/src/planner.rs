//! Decides what a frame runs: one rule after the other, each leaving its reason.

use crate::desc::{Consumers, View};
use crate::dry::DryMark;
use crate::grids::{Grid, Sim};
use crate::land::ShoreMark;
use crate::plan::{FramePlan, Reason, Skipped, SkippedWork, Work};
use crate::trace::{detail, span};
use crate::water::OpenWater;

/// What the GPU holds after the last `encode`, so that it is not made again.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Shown {
    /// Tick and alpha of the sea, with looks or without.
    pub(crate) ocean: Option<(u64, f32, bool)>,
    /// Tick and alpha of the grids.
    pub(crate) grids: Option<(u64, f32)>,
    /// Grids in the table.
    pub(crate) listed: usize,
    /// Land and level in the table.
    pub(crate) shore: ShoreMark,
    /// Dry hulls in the table.
    pub(crate) dry: DryMark,
}

/// What the planner must know of the GPU.
#[derive(Debug, Clone, Copy, Default)]
struct Facts {
    present: bool,
    lost: bool,
    shown: Shown,
    field_dispatches: u32,
    look_dispatches: u32,
}

impl Facts {
    /// Why nothing is drawn where no device is.
    fn absent(&self) -> Reason {
        if self.lost { Reason::DeviceLost } else { Reason::Headless }
    }
}

impl OpenWater {
    /// What the next `encode` will run for these views and readers, and what it will leave out and why. Views and
    /// readers decide what is drawn, never what is simulated.
    pub fn plan(&self, views: &[View], consumers: Consumers) -> FramePlan {
        span!("plan", tick = self.tick, views = views.len());
        let facts = self.facts();
        let mut plan =
            FramePlan { time: self.drawn_time(), tick: self.tick, alpha: self.clock.alpha(), ..FramePlan::default() };
        let nobody = views.is_empty() && consumers.is_empty();
        self.plan_ocean(&facts, &mut plan, nobody, consumers);
        for grid in self.grids.iter() {
            plan_grid(&facts, &mut plan, grid, nobody, || self.upload_bytes(grid));
        }
        #[cfg(feature = "gpu")]
        self.plan_remote(&mut plan);
        plan.shore = self.shore.mark();
        if facts.present && !nobody {
            plan.dry = self.dry.plan(views, |id| self.bodies.place_of(id));
        }
        let awake = self.grids.iter().filter(|grid| grid.is_awake()).count();
        if facts.present
            && !nobody
            && (!plan.work.is_empty()
                || awake != facts.shown.listed
                || plan.shore != facts.shown.shore
                || plan.dry.differs(facts.shown.dry, &plan))
        {
            plan.work.insert(0, Work::Table);
        }
        detail!(dispatches = plan.dispatches(), upload_bytes = plan.upload_bytes(), skipped = plan.skipped.len());
        plan
    }

    /// Bytes of a CPU-homed grid's upload.
    fn upload_bytes(&self, grid: &Grid) -> u64 {
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &self.gpu {
            return gpu.upload_bytes(grid);
        }
        grid.pool_bytes()
    }

    fn facts(&self) -> Facts {
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &self.gpu {
            let (field_dispatches, look_dispatches) = gpu.ocean_dispatches();
            let lost = gpu.lost;
            return Facts { present: !lost, lost, shown: gpu.shown(), field_dispatches, look_dispatches };
        }
        Facts::default()
    }

    fn plan_ocean(&self, facts: &Facts, plan: &mut FramePlan, nobody: bool, consumers: Consumers) {
        let looks = consumers.intersects(Consumers::NORMALS | Consumers::FOAM);
        let moment = |looks| Some((plan.tick, plan.alpha, looks));
        let reason = match &self.ocean {
            _ if !facts.present => facts.absent(),
            None => Reason::Calm,
            _ if nobody => Reason::NobodyLooks,
            _ if facts.shown.ocean == moment(looks) || facts.shown.ocean == moment(true) => Reason::Unchanged,
            Some(ocean) => {
                plan.work.push(Work::Ocean { cascades: ocean.modes().len() as u32 });
                plan.dispatches += facts.field_dispatches;
                if looks {
                    plan.work.push(Work::OceanLooks);
                    plan.dispatches += facts.look_dispatches;
                } else {
                    plan.skipped.push(Skipped { work: SkippedWork::OceanLooks, reason: Reason::NotAskedFor });
                }
                return;
            }
        };
        plan.skipped.push(Skipped { work: SkippedWork::Ocean, reason });
    }
}

fn plan_grid(facts: &Facts, plan: &mut FramePlan, grid: &Grid, nobody: bool, bytes: impl FnOnce() -> u64) {
    // GPU-homed grids are planned together: they share their dispatches.
    if !matches!(grid.sim, Sim::Cpu(_)) {
        return;
    }
    let reason = if !facts.present {
        facts.absent()
    } else if nobody {
        Reason::NobodyLooks
    } else if !grid.is_awake() {
        Reason::Asleep
    } else if facts.shown.grids == Some((plan.tick, plan.alpha)) {
        Reason::Unchanged
    } else {
        plan.work.push(Work::GridUpload { grid: grid.id, bytes: bytes() });
        return;
    };
    plan.skipped.push(Skipped { work: SkippedWork::Grid(grid.id), reason });
}

//! Decides what a frame runs: one rule after the other, each leaving its reason.

use arrayvec::ArrayVec;

use crate::desc::{Consumers, View};
use crate::dry::DryMark;
use crate::grids::{Grid, MAX_GRIDS, Sim};
use crate::land::ShoreMark;
use crate::plan::{FramePlan, Reason, SkippedWork, Work};
use crate::rules::{self, Rules};
use crate::store::GridId;
use crate::trace::{detail, span};
use crate::water::OpenWater;

/// What the GPU holds after the last `encode`, so that it is not made again.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Shown {
    pub(crate) ocean: Option<ShownSea>,
    /// Tick and alpha of the grids.
    pub(crate) grids: Option<(u64, f32)>,
    /// Grids in the table.
    pub(crate) listed: ArrayVec<GridId, MAX_GRIDS>,
    /// Land and level in the table.
    pub(crate) shore: ShoreMark,
    /// Dry hulls in the table.
    pub(crate) dry: DryMark,
}

/// The sea as it was made last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ShownSea {
    pub(crate) time: f64,
    /// With filtered copies and foam.
    pub(crate) looks: bool,
    /// So many of them, the longest first.
    pub(crate) cascades: usize,
    /// See [`ocean_spectrum::Moment::sets`].
    pub(crate) sets: [u64; 2],
}

/// What the planner must know of the GPU.
#[derive(Debug, Default)]
struct Facts {
    present: bool,
    lost: bool,
    shown: Shown,
}

impl Facts {
    /// Why nothing is drawn where no device is.
    fn absent(&self) -> Reason {
        if self.lost { Reason::DeviceLost } else { Reason::Headless }
    }
}

/// Who looks, as the rules see it.
struct Lookers<'a> {
    views: &'a [View],
    nobody: bool,
    looks: bool,
}

impl OpenWater {
    /// What the next `encode` will run for these views and readers, and what it will leave out and why. Views and
    /// readers decide what is drawn, never what is simulated. Allocates nothing.
    pub fn plan(&self, views: &[View], consumers: Consumers) -> FramePlan {
        span!("plan", tick = self.tick, views = views.len());
        let facts = self.facts();
        let mut plan =
            FramePlan { time: self.drawn_time(), tick: self.tick, alpha: self.clock.alpha(), ..FramePlan::default() };
        let nobody = rules::unseen(self.rules, views, consumers);
        let lookers = Lookers { views, nobody, looks: rules::looks(self.rules, consumers) };
        self.plan_ocean(&facts, &mut plan, &lookers);
        for grid in self.grids.iter() {
            self.plan_grid(&facts, &mut plan, grid, &lookers);
        }
        #[cfg(feature = "gpu")]
        self.plan_remote(&facts.shown, &mut plan);
        plan.shore = self.shore.mark();
        if facts.present && !nobody {
            self.plan_table(&facts, &mut plan, views);
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
            return Facts { present: !gpu.lost, lost: gpu.lost, shown: gpu.shown() };
        }
        Facts::default()
    }

    fn plan_ocean(&self, facts: &Facts, plan: &mut FramePlan, lookers: &Lookers<'_>) {
        let Lookers { views, nobody, looks } = *lookers;
        let ocean = match &self.ocean {
            _ if !facts.present => return plan.skip(SkippedWork::Ocean, facts.absent()),
            None => return plan.skip(SkippedWork::Ocean, Reason::Calm),
            _ if nobody => return plan.skip(SkippedWork::Ocean, Reason::NobodyLooks),
            Some(ocean) => ocean,
        };
        let pixel = rules::pixel_on_water(views, self.shore.level, ocean.significant_height());
        let cascades = rules::cascades(self.rules, ocean, plan.time, pixel, looks);
        let asked = (plan.time, pixel, looks);
        if let Some(reason) = rules::sea_stands(self.rules, ocean, asked, cascades, facts.shown.ocean) {
            return plan.skip(SkippedWork::Ocean, reason);
        }
        plan.run(Work::Ocean { cascades: cascades as u32 });
        let left_out = ocean.mode_sets_at(plan.time).0.len() - cascades;
        if left_out > 0 {
            plan.skip(SkippedWork::Cascades { count: left_out as u32 }, Reason::BelowAPixel);
        }
        if looks {
            plan.run(Work::OceanLooks);
        } else {
            plan.skip(SkippedWork::OceanLooks, Reason::NotAskedFor);
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &self.gpu {
            plan.dispatches += gpu.ocean_dispatches(cascades as u32, looks);
        }
    }

    /// GPU-homed grids are planned together: they share their dispatches.
    fn plan_grid(&self, facts: &Facts, plan: &mut FramePlan, grid: &Grid, lookers: &Lookers<'_>) {
        if !matches!(grid.sim, Sim::Cpu(_)) {
            return;
        }
        // Where a coarser grid is seen, it has a hole for this one.
        let within = grid.desc.within.is_some_and(|within| plan.listed.contains(&within));
        let reason = if !facts.present {
            facts.absent()
        } else if lookers.nobody {
            Reason::NobodyLooks
        } else if rules::asleep(self.rules, grid) {
            Reason::Asleep
        } else if !within && rules::far(self.rules, grid, lookers.views, self.shore.level) {
            Reason::BelowAPixel
        } else {
            plan.list(grid.id);
            if !facts.shown.has_grid(self.rules, grid, (plan.tick, plan.alpha)) {
                return plan.run(Work::GridUpload { grid: grid.id, bytes: self.upload_bytes(grid) });
            }
            Reason::Unchanged
        };
        plan.skip(SkippedWork::Grid(grid.id), reason);
    }

    fn plan_table(&self, facts: &Facts, plan: &mut FramePlan, views: &[View]) {
        let seen = |dry: &crate::dry::Dry, place| !rules::hull_far(self.rules, views, place, dry.size());
        let (dry, far) = self.dry.plan(views, |id| self.bodies.place_of(id), seen);
        plan.dry = dry;
        if far > 0 {
            plan.skip(SkippedWork::DryHulls { count: far as u32 }, Reason::BelowAPixel);
        }
        if !plan.work.is_empty()
            || !self.rules.contains(Rules::UNCHANGED)
            || plan.listed != facts.shown.listed
            || plan.shore != facts.shown.shore
            || plan.dry.differs(facts.shown.dry, plan)
        {
            let _ = plan.work.try_insert(0, Work::Table);
        }
    }
}

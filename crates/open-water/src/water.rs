//! [`OpenWater`]: owns the sea, the grids, the bodies and the clock, and keeps them in step.

use glam::Vec2;
use ocean_spectrum::{Ocean, Outputs};

use crate::OpenWaterError;
use crate::bodies::{Bodies, Reads};
use crate::clock::{Clock, Tick, Ticks};
use crate::cpu::surface::{Composite, WaterSample};
use crate::desc::{OpenWaterDesc, check_wind};
use crate::dry::DryHulls;
use crate::fleets::Fleets;
use crate::follow::Look;
use crate::grids::Grids;
use crate::land::Shore;
use crate::moorings::Moorings;
use crate::rules::Rules;
use crate::sea::Coming;
use crate::store::BodyStore;
use crate::trace::{span, warning};
use crate::wakes::Wakes;

/// What went out of the ordinary since the start; nothing of it is an error.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reports {
    /// Ticks run.
    pub ticks: u64,
    /// Time dropped by frames that were too long, seconds.
    pub dropped_secs: f64,
    /// Bodies that the game moved too far in one tick to have gone there: their wake starts anew.
    pub teleports: u64,
    /// Bodies that make water waves in a grid ([`Scheme::Dispersive`](crate::Scheme::Dispersive)) of which
    /// 48 cells are shorter than their hulls: such waves ring, and the longest are too slow. Larger cells help;
    /// [`OpenWater::set_wakes`] chooses them by itself. Looked at four times a second at 60 ticks.
    pub long_hulls: u32,
    /// Frames whose GPU work was left out because the GPU was too far behind.
    pub behind: u64,
}

/// The water of a game: the ambient sea, the interactive grids and the bodies, on one clock.
pub struct OpenWater {
    pub(crate) desc: OpenWaterDesc,
    pub(crate) clock: Clock,
    /// The last tick run.
    pub(crate) tick: u64,
    /// None when the sea is calm.
    pub(crate) ocean: Option<Ocean>,
    /// The next change of the sea.
    pub(crate) coming: Option<Coming>,
    pub(crate) grids: Grids,
    pub(crate) bodies: Bodies,
    pub(crate) fleets: Fleets,
    pub(crate) moorings: Moorings,
    pub(crate) reports: Reports,
    pub(crate) shore: Shore,
    /// How the game said last that it looks at the water.
    pub(crate) looking: Option<Look>,
    pub(crate) wakes: Wakes,
    pub(crate) dry: DryHulls,
    #[cfg(feature = "serde")]
    pub(crate) recorder: Option<crate::record::Recorder>,
    pub(crate) rules: Rules,
    #[cfg(feature = "gpu")]
    pub(crate) gpu: Option<crate::gpu::Gpu>,
}

impl OpenWater {
    /// A water without a GPU: for servers, tools and tests. Everything but drawing works.
    ///
    /// # Errors
    /// A value of the description is out of its range.
    pub fn headless(desc: OpenWaterDesc) -> Result<Self, OpenWaterError> {
        desc.check()?;
        let calm = desc.sea.partitions.is_empty();
        let ocean = if calm { None } else { Some(Ocean::new(desc.ocean())?) };
        Ok(Self {
            clock: Clock::new(desc.tick, desc.max_ticks_per_frame),
            tick: 0,
            ocean,
            coming: None,
            grids: Grids::default(),
            bodies: Bodies::default(),
            fleets: Fleets::default(),
            moorings: Moorings::default(),
            reports: Reports::default(),
            shore: Shore::default(),
            looking: None,
            wakes: Wakes::default(),
            dry: DryHulls::default(),
            rules: Rules::default(),
            desc,
            #[cfg(feature = "serde")]
            recorder: None,
            #[cfg(feature = "gpu")]
            gpu: None,
        })
    }

    /// A water whose surface is drawn on the host's device. Nothing is submitted here, and never will be.
    ///
    /// # Errors
    /// As [`Self::headless`], or the device has less than [`Self::required_limits`].
    #[cfg(feature = "gpu")]
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, desc: OpenWaterDesc) -> Result<Self, OpenWaterError> {
        let mut water = Self::headless(desc)?;
        water.gpu = Some(crate::gpu::Gpu::new(device, queue, water.ocean.as_ref())?);
        Ok(water)
    }

    /// The description it was made from.
    pub fn desc(&self) -> &OpenWaterDesc {
        &self.desc
    }

    /// The ticks that are due `frame_dt` seconds after the last call; run each with [`Self::tick`]. More than
    /// `max_ticks_per_frame` are dropped and reported; a time that is not positive counts as zero.
    pub fn advance(&mut self, frame_dt: f32) -> Ticks {
        let ticks = self.clock.advance(frame_dt);
        self.reports.dropped_secs += ticks.dropped_secs;
        if ticks.dropped_secs > 0.0 {
            warning!(dropped_secs = ticks.dropped_secs, "the frame was too long: time was dropped");
        }
        ticks
    }

    /// Runs one tick: bodies and fleets feel the water and move, the water feels them and moves. States are read from the
    /// store before and written after.
    ///
    /// # Errors
    /// [`OpenWaterError::TickOutOfOrder`], or a tick of another length; then nothing was changed.
    pub fn tick(&mut self, tick: Tick, store: &mut dyn BodyStore) -> Result<(), OpenWaterError> {
        let expected = self.tick + 1;
        if tick.index != expected {
            return Err(OpenWaterError::TickOutOfOrder { expected, found: tick.index });
        }
        if tick.dt != self.clock.dt() {
            let (field, value) = ("tick.dt", tick.dt.into());
            return Err(OpenWaterError::InvalidValue { field, value, bound: "as long as `advance` gave it" });
        }
        span!("tick", index = tick.index, bodies = self.bodies.len(), grids = self.grids.iter().len());
        #[cfg(feature = "serde")]
        self.note_tick(store);
        let eye = self.looking.map(|look| look.eye);
        let any = self.bodies.read(store, tick.dt, &mut self.reports);
        self.keep_wakes(tick.dt);
        self.prepare_sea();
        let water =
            Composite { ocean: self.ocean.as_ref(), grids: &self.grids, shore: &self.shore, wind: self.desc.wind };
        if any {
            self.bodies.step(tick.dt, eye, water);
        }
        self.fleets.step(tick.dt, eye, water);
        if any {
            self.bodies.disturb(&mut self.grids);
            self.bodies.write(store);
        }
        self.fleets.disturb(&mut self.grids);
        let bodies = &self.bodies;
        let start = self.tick as f64 * f64::from(tick.dt);
        self.grids.center(self.looking.as_ref(), self.shore.level, |id| bodies.place_of(id));
        self.grids.tick(self.ocean.as_ref(), tick.index, start);
        for id in self.grids.fade(tick.dt) {
            self.drop_grid(id)?;
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.tick_grids(&mut self.grids, tick.index);
        }
        self.grids.cut_holes();
        self.note_hulls();
        self.tick = tick.index;
        self.shore.found = self.shore.level;
        if let Some(ocean) = &mut self.ocean {
            ocean.set_time(tick.time());
        }
        self.follow_sea()?;
        self.reports.ticks += 1;
        Ok(())
    }

    /// Makes what bodies and fleets will read of the sea, on all threads; their tasks would wait for whichever asks first.
    fn prepare_sea(&mut self) {
        let Some(ocean) = &mut self.ocean else { return };
        if !self.rules.contains(Rules::UNREAD) {
            return ocean.prepare(Outputs::ALL);
        }
        match (self.bodies.reads(), self.fleets.smallest()) {
            (Some(Reads::Samples), _) => ocean.prepare(Outputs::ALL),
            (Some(Reads::Patches(radius)), least) => ocean.prepare_patches(least.map_or(radius, |l| l.min(radius))),
            (None, Some(radius)) => ocean.prepare_patches(radius),
            (None, None) => {}
        }
    }

    /// The water at local positions (x, z) after the last tick, at once: as many answers as the shorter slice holds.
    /// The horizontal displacement is inverted, all grids are included. Calm water for points that are not finite.
    pub fn sample(&self, points: &[Vec2], out: &mut [WaterSample]) {
        self.composite().surface_at(points, out);
    }

    pub(crate) fn composite(&self) -> Composite<'_> {
        Composite { ocean: self.ocean.as_ref(), grids: &self.grids, shore: &self.shore, wind: self.desc.wind }
    }

    /// Lets another wind blow from the next tick on; see [`OpenWaterDesc::wind`].
    ///
    /// # Errors
    /// It is not finite or faster than 100 m/s; then nothing was changed.
    pub fn set_wind(&mut self, wind: Vec2) -> Result<(), OpenWaterError> {
        check_wind(wind)?;
        self.desc.wind = wind;
        note!(self, Input::Wind(wind));
        Ok(())
    }

    /// The ambient sea; `None` when it is calm.
    pub fn ocean(&self) -> Option<&Ocean> {
        self.ocean.as_ref()
    }

    /// Seconds since the start at the end of the last tick.
    pub fn time(&self) -> f64 {
        self.tick as f64 * f64::from(self.clock.dt())
    }

    /// Seconds since the start at the drawn moment, between the last two ticks.
    pub fn drawn_time(&self) -> f64 {
        let behind = f64::from(1.0 - self.clock.alpha()) * f64::from(self.clock.dt());
        (self.time() - behind).max(0.0)
    }

    /// What went out of the ordinary since the start.
    pub fn reports(&self) -> Reports {
        self.reports
    }
}

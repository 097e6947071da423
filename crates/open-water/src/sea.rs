//! Changes of the ambient sea while the water runs: sea state, cascades, choppiness, and what of the land's maps depends
//! on it.
//!
//! A change begins a fixed time after the call. Meanwhile the new sea is made on a thread of its own, beside the ticks; the
//! tick with which it begins takes it over, and waits for it only if it is not there. So what comes of it does not depend
//! on how fast that thread is.

use std::sync::{Arc, OnceLock};

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, OceanError, SeaState};

use crate::desc::OpenWaterDesc;
use crate::land::{Baked, Turning, bake};
use crate::water::OpenWater;
use crate::{OpenWaterError, Preset};

/// Seconds from the call to the beginning of a change.
pub(crate) const LEAD: f64 = 0.5;
/// Seconds in which one quality becomes another.
const QUALITY: f32 = 2.0;

/// A change that has not begun.
#[derive(Clone)]
pub(crate) struct Coming {
    pub(crate) order: Order,
    /// The revision of the shore that it was made for.
    revision: u64,
    /// Snapshots share it.
    made: Arc<OnceLock<Result<Made, OceanError>>>,
}

/// When a change begins and how long it takes. What the sea becomes says the water's description.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Order {
    /// When it was asked for, seconds.
    asked: f64,
    /// The last tick before it.
    tick: u64,
    start: f64,
    seconds: f64,
}

impl Coming {
    /// Whether its maps are of the land at this revision.
    pub(crate) fn is_for(&self, revision: u64) -> bool {
        self.revision == revision
    }

    /// The same, whose maps are of this revision's land.
    pub(crate) fn at(&self, revision: u64) -> Self {
        Self { revision, ..self.clone() }
    }
}

/// What was made for it: the sea, and the land's maps where no fed grid is needed for them.
struct Made {
    ocean: Ocean,
    baked: Option<Arc<Baked>>,
}

/// Runs a job on a thread of its own, so that the ticks' threads are free.
pub(crate) fn beside(job: impl FnOnce() + Send + 'static) {
    static POOL: OnceLock<Option<rayon::ThreadPool>> = OnceLock::new();
    let pool =
        || rayon::ThreadPoolBuilder::new().num_threads(1).thread_name(|_| "open-water beside".into()).build().ok();
    match POOL.get_or_init(pool) {
        Some(pool) => pool.spawn(job),
        None => job(),
    }
}

impl OpenWater {
    /// Lets the sea become another one over `seconds` (see [`Ocean::change_to`]): the wind rises or turns, a swell comes in.
    /// It begins half a second after the call. Heights stay continuous. The tiles stay: choose them for the highest sea
    /// that is to come, or change them too ([`Self::set_cascades`]).
    ///
    /// Near land, the factors of depth and shelter follow in 32 steps.
    ///
    /// # Errors
    /// A value of the sea state or `seconds` is out of its range, or the water was made calm; then nothing was changed.
    pub fn change_sea(&mut self, sea: SeaState, seconds: f32) -> Result<(), OpenWaterError> {
        if self.ocean.is_none() {
            return Err(OpenWaterError::CalmSea);
        }
        self.change(OpenWaterDesc { sea, ..self.desc.clone() }, seconds)
    }

    /// Gives the sea other cascades over `seconds`, from half a second after the call on. Those whose tile and neighbours
    /// stay keep their waves, and only those come or go that the larger arrays alone hold; other tiles bring other waves,
    /// which fade in as the old ones fade out. On the way the sea costs as much as both. Heights stay continuous. Where the
    /// longest cascade then has waves of less than six cells of a fed grid, no sea comes into that grid.
    ///
    /// # Errors
    /// A cascade or `seconds` is out of its range, or the cascades are more than 8 together with those of now that are
    /// others; then nothing was changed.
    pub fn set_cascades(&mut self, cascades: Vec<CascadeDesc>, seconds: f32) -> Result<(), OpenWaterError> {
        self.change(OpenWaterDesc { cascades, ..self.desc.clone() }, seconds)
    }

    /// Sharpens crests by another factor, 0 to 1, over `seconds`, from half a second after the call on.
    ///
    /// # Errors
    /// A value is out of its range; then nothing was changed.
    pub fn set_choppiness(&mut self, choppiness: f32, seconds: f32) -> Result<(), OpenWaterError> {
        self.change(OpenWaterDesc { choppiness, ..self.desc.clone() }, seconds)
    }

    /// Gives the sea the quality of a preset within two seconds, from half a second after the call on: its cascades where
    /// those of now are a preset's, else its size for the tiles of now. Grids stay: see
    /// [`Self::set_grid_cells`].
    ///
    /// # Errors
    /// As [`Self::set_cascades`].
    pub fn set_quality(&mut self, preset: Preset) -> Result<(), OpenWaterError> {
        let own = |preset: &Preset| {
            let tiles = preset.water().cascades;
            tiles.len() == self.desc.cascades.len()
                && tiles.iter().zip(&self.desc.cascades).all(|(a, b)| a.tile == b.tile)
        };
        let mut cascades = preset.water().cascades;
        if !Preset::ALL.iter().any(own) {
            let size = cascades[0].size;
            cascades = self.desc.cascades.iter().map(|cascade| CascadeDesc { size, ..*cascade }).collect();
        }
        self.set_cascades(cascades, QUALITY)
    }

    /// Begins to make the sea of another description.
    pub(crate) fn change(&mut self, desc: OpenWaterDesc, seconds: f32) -> Result<(), OpenWaterError> {
        self.take_sea(true)?;
        let dt = f64::from(self.clock.dt());
        let tick = self.tick + (LEAD / dt).round().max(1.0) as u64;
        let (start, seconds) = (tick as f64 * dt, f64::from(seconds));
        let Some(ocean) = &self.ocean else {
            // Calm water shows none of it.
            OceanDesc { sea: OceanDesc::default().sea, ..desc.ocean() }.validate()?;
            self.desc = desc;
            note!(self, Input::Sea(Box::new(self.desc.clone()), seconds as f32));
            return Ok(());
        };
        ocean.check_change(&desc.ocean(), start, seconds)?;
        self.desc = desc;
        self.order_sea(Order { asked: self.time(), tick, start, seconds });
        note!(self, Input::Sea(Box::new(self.desc.clone()), seconds as f32));
        Ok(())
    }

    /// Has the sea of the description made.
    pub(crate) fn order_sea(&mut self, order: Order) {
        let Some(ocean) = &self.ocean else { return };
        let made = Arc::new(OnceLock::new());
        let (mut changed, of, filled) = (ocean.clone(), self.desc.ocean(), Arc::clone(&made));
        // So that the same changes are remembered, whenever it is made again.
        changed.set_time(order.asked);
        let fed = self.grids.iter().any(|grid| grid.fed().is_some());
        let terrain = self.shore.terrain.clone().filter(|_| !fed);
        beside(move || {
            let made = changed.change_to(of, order.start, order.seconds).map(|()| {
                let baked = terrain.map(|terrain| Arc::new(bake(&terrain, Some(&changed.settled()), &[])));
                Made { ocean: changed, baked }
            });
            // The only one who fills it.
            let _ = filled.set(made);
        });
        self.coming = Some(Coming { order, revision: self.shore.revision, made });
    }

    /// Takes over a change that is due, or, `now`, one that is yet to come.
    fn take_sea(&mut self, now: bool) -> Result<(), OpenWaterError> {
        let tick = self.tick;
        let Some(coming) = self.coming.take_if(|coming| now || coming.order.tick <= tick) else { return Ok(()) };
        let Some(ocean) = &mut self.ocean else { return Ok(()) };
        let Made { ocean: changed, baked } = coming.made.wait().as_ref().map_err(Clone::clone)?;
        ocean.adopt(changed);
        if self.shore.terrain.is_some() {
            let to = match baked.clone().filter(|_| coming.revision == self.shore.revision) {
                Some(baked) => baked,
                None => Arc::new(self.bake_shore()),
            };
            let from = self.shore.baked.clone();
            let Order { start, seconds, .. } = coming.order;
            let start = if self.waits_for_cascades() { f64::INFINITY } else { start };
            self.shore.turning = Some(Turning { from, to, after: None, start, seconds, shown: 0.0 });
        }
        Ok(())
    }

    /// Brings to the end of the last tick what depends on the sea.
    pub(crate) fn follow_sea(&mut self) -> Result<(), OpenWaterError> {
        self.take_sea(false)?;
        self.place_maps()?;
        let time = self.time();
        if let Some(turning) = &mut self.shore.turning
            && let Some(share) = turning.next(time)
        {
            turning.shown = share;
            let baked = Arc::new(turning.from.towards(&turning.to, share));
            if share == 1.0 && turning.after.is_none() {
                self.shore.turning = None;
            }
            self.show_maps(baked)?;
        }
        if self.ocean.as_ref().is_some_and(|ocean| ocean.revision() != self.shore.fed_revision) {
            self.feed_again()?;
        }
        Ok(())
    }

    /// Puts the land's maps in the order of the sea's cascades, when these come and go.
    fn place_maps(&mut self) -> Result<(), OpenWaterError> {
        let places = self.ocean.as_ref().and_then(Ocean::cascade_places);
        if places == self.shore.places.as_deref() {
            return Ok(());
        }
        let places = places.map(<[_]>::to_vec);
        let shown = match (&places, &mut self.shore.turning) {
            (Some(places), Some(turning)) => {
                let plain = turning.to.clone();
                let [from, to] = Baked::placed([&turning.from, &turning.to], places).map(Arc::new);
                (turning.from, turning.to, turning.after) = (from, to, Some(plain));
                (turning.start, turning.shown) = (self.tick as f64 * f64::from(self.clock.dt()), 0.0);
                Some(turning.from.clone())
            }
            (None, Some(turning)) => turning.after.take(),
            (_, None) => None,
        };
        if places.is_none() {
            self.shore.turning = None;
        }
        self.shore.places = places;
        match shown {
            Some(baked) => self.show_maps(baked),
            None => Ok(()),
        }
    }

    /// Whether other cascades are yet to come: maps for them would be out of order.
    fn waits_for_cascades(&self) -> bool {
        self.ocean.as_ref().is_some_and(|ocean| {
            let settled = ocean.settled();
            let tiles = [ocean, &settled].map(|ocean| ocean.modes().iter().map(|modes| modes.tile));
            let [now, then] = tiles;
            ocean.cascade_places().is_none() && now.ne(then)
        })
    }

    /// Maps of the sea as it will be, for the cascades of now.
    pub(crate) fn maps_of_now(&mut self, baked: Arc<Baked>) -> Arc<Baked> {
        self.shore.turning = None;
        let places = self.ocean.as_ref().and_then(Ocean::cascade_places).map(<[_]>::to_vec);
        self.shore.places = places;
        let Some(places) = &self.shore.places else { return baked };
        let now = Arc::new(Baked::placed([&*baked; 2], places)[1].clone());
        let (from, to, after) = (now.clone(), now.clone(), Some(baked));
        let start = self.tick as f64 * f64::from(self.clock.dt());
        self.shore.turning = Some(Turning { from, to, after, start, seconds: 0.0, shown: 1.0 });
        now
    }

    /// Hands maps to whoever reads them, fed grids too.
    fn show_maps(&mut self, baked: Arc<Baked>) -> Result<(), OpenWaterError> {
        if let Some(terrain) = &self.shore.terrain {
            let feedings = self.grids.iter_mut().filter_map(|grid| grid.feeding.as_mut());
            feedings.for_each(|feeding| feeding.weigh(terrain, &baked));
        }
        self.show_shore(baked)
    }

    /// Prepares the edges of fed grids for the sea's modes as they are now.
    fn feed_again(&mut self) -> Result<(), OpenWaterError> {
        let baked = Arc::clone(&self.shore.baked);
        self.feed_grids(&baked)
    }
}

//! The whole water at a moment: for rollback, for who joins late, and to go on from a file.
//!
//! A snapshot holds all that the next ticks depend on: descriptions, handles (those to come too), bodies, fleets, moorings, grids, the
//! sea with its changes, level, wind, looks and automatic wakes. In memory it shares what does not change. Not in it: land, which is
//! the game's own and only told by a digest; waves of grids homed on the GPU, which the device alone has; in bytes, dry hulls. The
//! game's own store is its own to put back.

#[cfg(feature = "serde")]
mod bytes;
#[cfg(all(test, feature = "serde"))]
mod fuzz;
mod grids;
#[cfg(feature = "serde")]
mod hash;
mod restore;
mod shore;

use floating_body::{Arena, Fleet};
use ocean_spectrum::OceanSnapshot;

use crate::bodies::BodiesMoment;
use crate::clock::Ticks;
use crate::dry::DryHulls;
use crate::moorings::Moorings;
use crate::sea::{Coming, Order};
use crate::wakes::Wakes;
use crate::water::OpenWater;
use crate::{FleetId, Look, OpenWaterDesc, Reports};
#[cfg(feature = "serde")]
pub use bytes::SnapshotError;
use grids::GridsMoment;
#[cfg(feature = "serde")]
pub(crate) use hash::Digest;
use shore::ShoreMoment;

/// An [`OpenWater`] at a moment. See [`OpenWater::snapshot`].
#[derive(Clone)]
pub struct WaterSnapshot {
    tick: u64,
    desc: OpenWaterDesc,
    ocean: Option<OceanSnapshot>,
    order: Option<Order>,
    shore: ShoreMoment,
    grids: GridsMoment,
    bodies: BodiesMoment,
    fleets: Arena<FleetId, Fleet>,
    moorings: Moorings,
    wakes: Wakes,
    looking: Option<Look>,
    reports: Reports,
    /// What bytes do not hold.
    here: Option<Here>,
}

/// What a snapshot in memory shares with the water.
#[derive(Clone)]
struct Here {
    coming: Option<(Coming, bool)>,
    dry: DryHulls,
}

impl WaterSnapshot {
    /// Number of the last tick before it.
    pub fn tick(&self) -> u64 {
        self.tick
    }
}

impl std::fmt::Debug for WaterSnapshot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WaterSnapshot")
            .field("tick", &self.tick)
            .field("bodies", &self.bodies.bodies.len())
            .field("fleets", &self.fleets.len())
            .field("grids", &self.grids.list.len())
            .finish_non_exhaustive()
    }
}

impl OpenWater {
    /// This moment, between two ticks. Costs what moves: the tiles of grids that are not calm, the pieces of fleets, some hundred
    /// bytes a body; the rest is shared. Body states of the game's own store are the game's to keep beside it.
    ///
    /// ```
    /// # use open_water::{BodyDesc, BodyState, BodyStates, Hull, OpenWater, OpenWaterDesc};
    /// # use glam::Vec3;
    /// # let mut water = OpenWater::headless(OpenWaterDesc::default())?;
    /// # let id = water.add_body(BodyDesc::from_hull(&Hull::cuboid(Vec3::ONE)?, 400.0))?;
    /// # let mut bodies = BodyStates::default();
    /// # bodies.insert(id, BodyState::at_rest(Vec3::ZERO));
    /// let before = (water.snapshot(), bodies.clone());
    /// for tick in water.ticks_until(8) {
    ///     water.tick(tick, &mut bodies)?;
    /// }
    /// let first = bodies.get(id).copied();
    /// // An input has come late: back, and once more.
    /// water.restore(&before.0)?;
    /// bodies = before.1;
    /// for tick in water.ticks_until(8) {
    ///     water.tick(tick, &mut bodies)?;
    /// }
    /// assert_eq!(bodies.get(id).copied(), first);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn snapshot(&self) -> WaterSnapshot {
        let current = |coming: &Coming| coming.is_for(self.shore.revision);
        WaterSnapshot {
            tick: self.tick,
            desc: self.desc.clone(),
            ocean: self.ocean.as_ref().map(|ocean| ocean.snapshot()),
            order: self.coming.as_ref().map(|coming| coming.order),
            shore: ShoreMoment::of(&self.shore),
            grids: GridsMoment::of(&self.grids),
            bodies: self.bodies.moment(),
            fleets: self.fleets.list.clone(),
            moorings: self.moorings.clone(),
            wakes: self.wakes.clone(),
            looking: self.looking,
            reports: self.reports,
            here: Some(Here {
                coming: self.coming.as_ref().map(|coming| (coming.clone(), current(coming))),
                dry: self.dry.clone(),
            }),
        }
    }

    /// Number of the last tick run, 0 before the first.
    pub fn last_tick(&self) -> u64 {
        self.tick
    }

    /// The ticks after the last one run up to number `tick`, whatever the time: to replay after [`Self::restore`], or to run those
    /// that a server has run. [`Self::advance`] goes on after them.
    pub fn ticks_until(&mut self, tick: u64) -> Ticks {
        self.clock.until(self.tick, tick)
    }
}

//! Stores over what a game has already: states in a slice, and several stores in one tick.
//!
//! A store over an entity-component system is the game's own: [`BodyStore`] shows one.

use floating_body::BodyState;
use slotmap::SecondaryMap;

use crate::store::{BodyId, BodyMotion, BodyStore, Wants};

/// Finds the bodies of a game that keeps handles and states in two slices, one beside the other.
///
/// ```
/// use glam::Vec3;
/// use open_water::{BodyDesc, BodySlices, BodyState, Hull, OpenWater, OpenWaterDesc};
///
/// let mut water = OpenWater::headless(OpenWaterDesc::default())?;
/// let desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0))?, 400.0);
/// // Three things, of which the second does not float.
/// let mut ids = vec![Some(water.add_body(desc.clone())?), None, Some(water.add_body(desc)?)];
/// let mut states: Vec<_> = (0..3).map(|i| BodyState::at_rest(Vec3::new(5.0 * i as f32, 9.0, 0.0))).collect();
/// let mut slices = BodySlices::default();
///
/// for _frame in 0..60 {
///     for tick in water.advance(1.0 / 60.0) {
///         water.tick(tick, &mut slices.store(&ids, &mut states))?;
///     }
/// }
/// assert!(states[0].position.y < 8.0 && states[1].position.y == 9.0);
/// // Elements may change places between ticks.
/// ids.swap_remove(0);
/// states.swap_remove(0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct BodySlices {
    places: SecondaryMap<BodyId, usize>,
}

impl BodySlices {
    /// The store for [`OpenWater::tick`](crate::OpenWater::tick): `states[i]` is the state of body `ids[i]`, or of nothing
    /// that floats. The shorter slice decides how many there are; of a body that is there twice the last element counts.
    /// Every element's place is noted anew, so between ticks they may come, go and change places; allocates only where
    /// there are more bodies than ever before.
    pub fn store<'a>(&'a mut self, ids: &[Option<BodyId>], states: &'a mut [BodyState]) -> SliceStore<'a> {
        self.places.clear();
        for (place, id) in ids.iter().enumerate().take(states.len()) {
            if let Some(id) = id {
                self.places.insert(*id, place);
            }
        }
        SliceStore { places: &self.places, states }
    }
}

/// States in a slice, for one tick: see [`BodySlices::store`].
#[derive(Debug)]
pub struct SliceStore<'a> {
    places: &'a SecondaryMap<BodyId, usize>,
    states: &'a mut [BodyState],
}

impl BodyStore for SliceStore<'_> {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.states.get(*self.places.get(id)?).copied()
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        let place = self.places.get(id).and_then(|place| self.states.get_mut(*place));
        if let (Some(place), BodyMotion::State(state)) = (place, motion) {
            *place = state;
        }
    }
}

/// Several stores in one tick: a body belongs to the first one that has a state for it.
///
/// ```
/// # use open_water::{BodyStates, OpenWater, OpenWaterDesc, Stores, Tick};
/// # let mut water = OpenWater::headless(OpenWaterDesc::default())?;
/// let (mut players, mut flotsam) = (BodyStates::default(), BodyStates::default());
/// for tick in water.advance(1.0 / 60.0) {
///     water.tick(tick, &mut Stores(&mut [&mut players, &mut flotsam]))?;
/// }
/// # Ok::<(), open_water::OpenWaterError>(())
/// ```
pub struct Stores<'a, 'b>(pub &'a mut [&'b mut dyn BodyStore]);

impl BodyStore for Stores<'_, '_> {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.0.iter().find_map(|store| store.read(id))
    }

    fn wants(&self, id: BodyId) -> Wants {
        self.0.iter().find(|store| store.read(id).is_some()).map_or(Wants::State, |store| store.wants(id))
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        if let Some(store) = self.0.iter_mut().find(|store| store.read(id).is_some()) {
            store.write(id, motion);
        }
    }
}

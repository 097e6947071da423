//! Where body states live between ticks: in the game's own store.
//!
//! The water reads every state before a tick and writes the motion after it, so a game may move, stop or remove a body
//! in between. It keeps no second truth: a body without a state is left out of the tick. A store that moves its bodies
//! itself, as a physics engine does, asks for wrenches instead of states.

use floating_body::{BodyState, Wrench};
use slotmap::{SecondaryMap, new_key_type};

new_key_type! {
    /// Handle of a body; stays invalid for ever once the body was removed.
    pub struct BodyId;
    /// Handle of a grid; stays invalid for ever once the grid was removed.
    pub struct GridId;
    /// Handle of a fleet; stays invalid for ever once the fleet was removed.
    pub struct FleetId;
    /// Handle of a mooring; stays invalid for ever once the mooring or its body was removed.
    pub struct MooringId;
}

/// What a store wants to be told of a body's tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Wants {
    /// Where the body is at the end of the tick: the water moves it.
    #[default]
    State,
    /// What the water does to it over the tick: the store moves it.
    Wrench,
}

/// What the water says of a body's tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyMotion {
    /// The state at the end of the tick.
    State(BodyState),
    /// Force (N) and torque (N m) about the centre of mass, world axes, constant over the tick, without weight: with them
    /// and gravity, a plain rigid body of the description's mass and inertia moves as the body does in the water.
    Wrench(Wrench),
}

/// The game's store of body states. [`BodyStates`] is a ready-made one, [`BodySlices`](crate::BodySlices) makes one of two
/// slices, [`Stores`](crate::Stores) takes several.
///
/// Over an entity-component system it takes a few lines. Here components stand in maps by entity:
///
/// ```
/// use std::collections::HashMap;
///
/// use glam::{Quat, Vec3};
/// use open_water::{BodyDesc, BodyId, BodyMotion, BodyState, BodyStore, Hull, OpenWater, OpenWaterDesc};
///
/// #[derive(Clone, Copy, PartialEq, Eq, Hash)]
/// struct Entity(u32);
///
/// #[derive(Default)]
/// struct World {
///     floating: HashMap<BodyId, Entity>,
///     transforms: HashMap<Entity, (Vec3, Quat)>,
///     velocities: HashMap<Entity, (Vec3, Vec3)>,
/// }
///
/// impl BodyStore for World {
///     fn read(&self, id: BodyId) -> Option<BodyState> {
///         let entity = self.floating.get(&id)?;
///         let (position, orientation) = *self.transforms.get(entity)?;
///         let (velocity, angular_velocity) = *self.velocities.get(entity)?;
///         Some(BodyState { position, orientation, velocity, angular_velocity })
///     }
///
///     fn write(&mut self, id: BodyId, motion: BodyMotion) {
///         let (Some(entity), BodyMotion::State(state)) = (self.floating.get(&id), motion) else { return };
///         self.transforms.insert(*entity, (state.position, state.orientation));
///         self.velocities.insert(*entity, (state.velocity, state.angular_velocity));
///     }
/// }
///
/// let mut water = OpenWater::headless(OpenWaterDesc::default())?;
/// let mut world = World::default();
/// let duck = Entity(7);
/// world.floating.insert(water.add_body(BodyDesc::from_hull(&Hull::sphere(0.2)?, 10.0))?, duck);
/// world.transforms.insert(duck, (Vec3::Y * 3.0, Quat::IDENTITY));
/// world.velocities.insert(duck, (Vec3::ZERO, Vec3::ZERO));
/// for tick in water.advance(1.0 / 60.0) {
///     water.tick(tick, &mut world)?;
/// }
/// assert!(world.transforms[&duck].0.y < 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait BodyStore {
    /// The body's state at the start of the tick, or `None` if it takes no part.
    fn read(&self, id: BodyId) -> Option<BodyState>;
    /// What [`Self::write`] is to be given for the body.
    fn wants(&self, _id: BodyId) -> Wants {
        Wants::State
    }
    /// The body's motion in the tick, as [`Self::wants`] asked.
    fn write(&mut self, id: BodyId, motion: BodyMotion);
}

/// A ready-made [`BodyStore`] for games without one.
#[derive(Debug, Clone, Default)]
pub struct BodyStates(SecondaryMap<BodyId, BodyState>);

impl BodyStates {
    /// Puts a body somewhere.
    pub fn insert(&mut self, id: BodyId, state: BodyState) {
        self.0.insert(id, state);
    }

    /// Takes a body out of the simulation.
    pub fn remove(&mut self, id: BodyId) -> Option<BodyState> {
        self.0.remove(id)
    }

    /// The state after the last tick.
    pub fn get(&self, id: BodyId) -> Option<&BodyState> {
        self.0.get(id)
    }

    /// For changing a state between ticks.
    pub fn get_mut(&mut self, id: BodyId) -> Option<&mut BodyState> {
        self.0.get_mut(id)
    }
}

impl BodyStore for BodyStates {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        self.0.get(id).copied()
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        if let BodyMotion::State(state) = motion {
            self.0.insert(id, state);
        }
    }
}

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

/// The game's store of body states.
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

//! Where body states live between ticks: in the game's own store.
//!
//! The water reads every state before a tick and writes the new one after it, so a game may move, stop or remove a
//! body in between. It keeps no second truth: a body without a state is left out of the tick.

use floating_body::BodyState;
use slotmap::{SecondaryMap, new_key_type};

new_key_type! {
    /// Handle of a body; stays invalid for ever once the body was removed.
    pub struct BodyId;
    /// Handle of a grid; stays invalid for ever once the grid was removed.
    pub struct GridId;
}

/// The game's store of body states.
pub trait BodyStore {
    /// The body's state at the start of the tick, or `None` if it takes no part.
    fn read(&self, id: BodyId) -> Option<BodyState>;
    /// The body's state at the end of the tick.
    fn write(&mut self, id: BodyId, state: BodyState);
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

    fn write(&mut self, id: BodyId, state: BodyState) {
        self.0.insert(id, state);
    }
}

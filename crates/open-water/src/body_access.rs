//! The bodies and moorings of an [`OpenWater`]: how they are added, removed, steered and read.

use floating_body::{Body, BodyDesc, Controls, Explanation};

use crate::OpenWaterError;
use crate::bodies::Pose;
use crate::moorings::Mooring;
use crate::store::{BodyId, MooringId};
use crate::water::OpenWater;

impl OpenWater {
    /// Adds a body. It takes part in ticks as long as the store has a state for it.
    ///
    /// # Errors
    /// A value of the description is out of its range.
    pub fn add_body(&mut self, desc: BodyDesc) -> Result<BodyId, OpenWaterError> {
        let body = Body::new(desc)?;
        note!(self, Input::Body(Box::new(body.desc().clone())));
        Ok(self.bodies.insert(body))
    }

    /// Removes a body and its moorings; a grid that followed it stays where it is.
    ///
    /// # Errors
    /// There is no such body.
    pub fn remove_body(&mut self, id: BodyId) -> Result<(), OpenWaterError> {
        self.bodies.remove(id)?;
        self.moorings.forget(id);
        self.dry.forget(id);
        note!(self, Input::RemoveBody(id));
        Ok(())
    }

    /// Makes a body fast with a line.
    ///
    /// # Errors
    /// There is no such body, or a value of the line is out of its range.
    pub fn add_mooring(&mut self, mooring: Mooring) -> Result<MooringId, OpenWaterError> {
        let id = self.moorings.add(mooring, &mut self.bodies)?;
        note!(self, Input::Mooring(mooring));
        Ok(id)
    }

    /// Casts a line off.
    ///
    /// # Errors
    /// There is no such mooring; it goes with its body.
    pub fn remove_mooring(&mut self, id: MooringId) -> Result<(), OpenWaterError> {
        self.moorings.remove(id, &mut self.bodies)?;
        note!(self, Input::RemoveMooring(id));
        Ok(())
    }

    /// Tension of a mooring's line in N, mean over the last tick; 0 while it is slack.
    ///
    /// # Errors
    /// There is no such mooring.
    pub fn mooring_tension(&self, id: MooringId) -> Result<f32, OpenWaterError> {
        self.moorings.tension(id, &self.bodies)
    }

    /// Sets a body's throttle and rudder for the ticks to come.
    ///
    /// # Errors
    /// There is no such body.
    pub fn set_controls(&mut self, id: BodyId, controls: Controls) -> Result<(), OpenWaterError> {
        self.bodies.set_controls(id, controls)?;
        note!(self, Input::Controls(id, controls));
        Ok(())
    }

    /// A body as it stands after the last tick, for reading.
    ///
    /// # Errors
    /// There is no such body.
    pub fn body(&self, id: BodyId) -> Result<&Body, OpenWaterError> {
        self.bodies.body(id)
    }

    /// What acts on a body: the cut of its hull and each force, under its controls, as the last tick left it.
    ///
    /// # Errors
    /// There is no such body.
    pub fn explain(&self, id: BodyId) -> Result<Explanation, OpenWaterError> {
        self.bodies.explain(id)
    }

    /// Where a body is drawn: between its last two states, as far as `advance` left off. `None` for a body that took
    /// no part in the last tick.
    pub fn drawn_pose(&self, id: BodyId) -> Option<Pose> {
        self.bodies.drawn(id, self.clock.alpha())
    }

    /// How many bodies there are.
    pub fn body_count(&self) -> usize {
        self.bodies.len()
    }
}

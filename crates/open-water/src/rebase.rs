//! The local origin in the world, and bodies that are put elsewhere.
//!
//! Local coordinates are f32 and lose millimetres some kilometres out; grids, land and the phases of the sea are kept in
//! world coordinates, f64. Nothing here moves what the game holds itself.

use floating_body::BodyState;
use glam::{DVec2, Vec2, Vec3};

use crate::OpenWaterError;
use crate::store::BodyId;
use crate::water::OpenWater;

/// Farthest that the origin moves at once, metres, and farthest that it gets from the world's.
const FARTHEST: [f64; 2] = [1e6, 1e9];

fn check(field: &'static str, value: DVec2, most: f64, bound: &'static str) -> Result<(), OpenWaterError> {
    match value.to_array().into_iter().find(|v| v.fract() != 0.0 || v.is_nan() || v.abs() > most) {
        Some(value) => Err(OpenWaterError::InvalidValue { field, value, bound }),
        None => Ok(()),
    }
}

impl OpenWater {
    /// World place (x, z) of the local origin, metres: what land, fixed grids and the sea's phases are measured from.
    pub fn origin(&self) -> DVec2 {
        self.shore.origin
    }

    /// Moves the local origin between ticks: what was at local (x, z) `offset` is at 0 from now on. Whole metres, so that what
    /// comes nearer to the origin keeps its place to the last bit.
    ///
    /// The water takes along all that it holds: sea, grids and wakes, land, fleets, moorings, dry hulls, the eye of
    /// [`Self::look`], bodies with the poses that are drawn between ticks. The game moves the rest by `-offset` before the next tick:
    /// the states in its stores (a body that stays behind has been teleported), its camera, and what it draws.
    ///
    /// # Errors
    /// The offset is not whole or beyond 1000 km, or the origin would be farther than 1,000,000 km from the world's; then
    /// nothing was changed.
    pub fn rebase(&mut self, offset: DVec2) -> Result<(), OpenWaterError> {
        check("rebase: offset", offset, FARTHEST[0], "whole metres, within 1000 km")?;
        let origin = self.shore.origin + offset;
        check("rebase: origin", origin, FARTHEST[1], "within 1,000,000 km")?;
        self.shore.origin = origin;
        note!(self, Input::Rebase(offset));
        if let Some(ocean) = &mut self.ocean {
            ocean.set_origin(origin);
        }
        let offset = offset.as_vec2();
        self.grids.rebase(origin, offset);
        self.bodies.rebase(offset);
        self.fleets.rebase(offset);
        self.moorings.rebase(offset);
        if let Some(look) = &mut self.looking {
            look.eye -= lifted(offset);
        }
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.remote.set_origin(origin);
        }
        Ok(())
    }

    /// Puts a body somewhere else between ticks, near or far, as a spawn does: it tells the water of no motion on the way, its
    /// wake starts anew, and it is drawn there at once. Give its store the same state. A body that is moved farther
    /// than it could have gone is taken to be teleported without this, which is reported.
    ///
    /// # Errors
    /// There is no such body, or the state is not finite or farther than 1000 km away; then nothing was changed.
    pub fn teleport(&mut self, id: BodyId, state: BodyState) -> Result<(), OpenWaterError> {
        self.bodies.teleport(id, state)?;
        note!(self, Input::Teleport(id, state));
        Ok(())
    }
}

/// An offset of local places.
pub(crate) fn lifted(offset: Vec2) -> Vec3 {
    Vec3::new(offset.x, 0.0, offset.y)
}

//! Where a body is and how it moves, and the wrench that would move it so.

use glam::{Quat, Vec3};

use super::LIMITS;

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyState {
    /// Centre of mass, local world, m.
    pub position: Vec3,
    /// From hull axes to world axes, unit.
    pub orientation: Quat,
    /// Velocity of the centre of mass, m/s.
    pub velocity: Vec3,
    /// World axes, rad/s.
    pub angular_velocity: Vec3,
}

impl BodyState {
    /// At rest and upright with the centre of mass at `position`.
    pub fn at_rest(position: Vec3) -> Self {
        Self { position, orientation: Quat::IDENTITY, velocity: Vec3::ZERO, angular_velocity: Vec3::ZERO }
    }

    pub(crate) fn is_sane(&self) -> bool {
        let far = self.position.is_finite() && self.position.abs().max_element() <= LIMITS.2;
        let q = self.orientation.to_array();
        far && self.velocity.is_finite() && self.angular_velocity.is_finite() && q.iter().all(|c| c.is_finite())
    }
}

/// A force through the centre of mass and a torque about it, world axes; weight is not in it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wrench {
    /// N.
    pub force: Vec3,
    /// N m.
    pub torque: Vec3,
}

//! Mooring lines of a body, pulled in every sub-step.

use glam::{Mat3, Vec3};

use super::{Body, LIMITS};
use crate::forces::Pose;
use crate::{BodyError, MooringLine};

/// How a body yields to an impulse: mass and inertia with what the water adds.
pub(super) struct Mobility {
    /// The axes of `whole`.
    pub(super) axes: Mat3,
    /// kg.
    pub(super) whole: Vec3,
    /// Inertia, body axes.
    pub(super) inertia: Mat3,
    /// Its inverse.
    pub(super) inverse: Mat3,
}

impl Body {
    /// Makes the body fast with these lines and no others.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] naming the field of a line that is out of its bounds; then nothing has changed.
    pub fn set_moorings(&mut self, lines: &[MooringLine]) -> Result<(), BodyError> {
        lines.iter().try_for_each(MooringLine::check)?;
        self.moorings = lines.to_vec();
        self.tensions = vec![0.0; lines.len()];
        Ok(())
    }

    /// The lines that hold it; anchors are where they have dragged to.
    pub fn moorings(&self) -> &[MooringLine] {
        &self.moorings
    }

    /// Tension of each line in N, mean over the last step.
    pub fn tensions(&self) -> &[f32] {
        &self.tensions
    }

    /// Square of the highest frequency that the lines give the dry body, rad^2/s^2.
    pub(super) fn mooring_stiffness(&self) -> f32 {
        let inertia = self.inertia.x_axis.x.min(self.inertia.y_axis.y).min(self.inertia.z_axis.z);
        let one = |line: &MooringLine| {
            let lever = (line.point - self.desc.center_of_mass).length_squared();
            line.stiffness * (1.0 / self.desc.mass + lever / inertia)
        };
        self.moorings.iter().map(one).sum()
    }

    /// Pulls with one line after the other, each feeling what those before it did: stiff lines do not add up to a kick.
    /// `share` is the sub-step's share of the tick.
    pub(super) fn pull(&mut self, dt: f32, share: f32, pose: &Pose, mobility: &Mobility) {
        let to_axes = mobility.axes.transpose();
        for (line, mean) in self.moorings.iter_mut().zip(&mut self.tensions) {
            let arm = pose.rotation * (line.point - self.desc.center_of_mass);
            let away = line.anchor - (pose.position + arm);
            let distance = away.length();
            if distance <= line.length.max(1.0e-6) {
                continue;
            }
            let along = away / distance;
            let lever = arm.cross(along);
            let pushed = mobility.axes * ((to_axes * along) / mobility.whole);
            let turned = pose.rotation * (mobility.inverse * (pose.rotation.transpose() * lever));
            let velocity = self.state.velocity + self.state.angular_velocity.cross(arm);
            let yields = along.dot(pushed) + lever.dot(turned);
            let (tension, drags) = line.tension(distance - line.length, -velocity.dot(along), yields, dt);
            self.state.velocity = (self.state.velocity + pushed * (tension * dt)).clamp_length_max(LIMITS.0);
            let turning = self.state.angular_velocity + turned * (tension * dt);
            self.state.angular_velocity = turning.clamp_length_max(LIMITS.1);
            *mean += tension * share;
            let level = Vec3::new(along.x, 0.0, along.z);
            line.anchor -= level * drags;
        }
    }
}

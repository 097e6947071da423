//! The blows that a body's bottom takes as it enters the water.

use glam::{Vec2, Vec3};

use super::moorings::Mobility;
use super::{Body, LIMITS};
use crate::forces::Pose;

impl Body {
    /// Each bottom that gets wet gives its share of momentum to the water it catches, one after the other, so that together
    /// they do not push back. After a restart they are wet as they are.
    pub(super) fn slam(&mut self, pose: &Pose, mobility: &Mobility) {
        let Some(mut slam) = self.slam.take() else { return };
        let (points, waters, own) = (&self.points, &self.waters, self.feels_own);
        let (mut velocity, mut spin) = (self.state.velocity, self.state.angular_velocity);
        let to_body = pose.rotation.transpose();
        let normal = |i: usize| Vec3::new(-waters[i].slope.x, 1.0, -waters[i].slope.y).normalize();
        let depth = |i: usize| {
            let at = pose.position + pose.rotation * (points[i].position - Vec3::Y * points[i].half.y);
            waters[i].ambient(Vec2::new(at.x, at.z)) + if own { waters[i].own } else { 0.0 } - at.y
        };
        slam.catch(
            points,
            |i| to_body * normal(i),
            depth,
            self.restart,
            |i, mass, place| {
                let (up, arm) = (normal(i), pose.rotation * place);
                let into = (velocity + spin.cross(arm) - waters[i].velocity).dot(up);
                if into < 0.0 {
                    let yields = mobility.change(up, arm, pose.rotation);
                    let blow = -mass * into / (1.0 + mass * yields.at(arm).dot(up));
                    velocity += yields.velocity * blow;
                    spin += yields.spin * blow;
                }
            },
        );
        self.state.velocity = velocity.clamp_length_max(LIMITS.0);
        self.state.angular_velocity = spin.clamp_length_max(LIMITS.1);
        self.slam = Some(slam);
    }
}

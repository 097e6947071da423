//! What can be asked of a body: its pose to draw, its floatation, what it was made from.

use glam::{Mat3, Quat, Vec2, Vec3};

use super::Body;
use crate::hull::Waterline;
use crate::rotation::matrix;
use crate::source::Column;
use crate::{BodyDesc, ForcePoint};

impl Body {
    /// Volume in m^3 that the water has been told of; the sum of all displacements changes with it.
    pub fn told_volume(&self) -> f32 {
        self.columns.iter().map(Column::told).sum()
    }

    /// Pose of the hull's frame, to draw its mesh: origin in m and orientation.
    pub fn hull_pose(&self) -> (Vec3, Quat) {
        let origin = self.state.position - matrix(self.state.orientation) * self.desc.center_of_mass;
        (origin, self.state.orientation)
    }

    /// The description it was made from.
    pub fn desc(&self) -> &BodyDesc {
        &self.desc
    }

    /// Inertia tensor about the centre of mass with which it turns, without what the water adds, hull axes, kg m^2.
    pub fn inertia(&self) -> Mat3 {
        self.inertia
    }

    /// The force points, relative to the centre of mass, hull axes.
    pub fn force_points(&self) -> &[ForcePoint] {
        &self.points
    }

    /// Height in m of the centre of mass over still water when the body floats upright.
    pub fn rest_height(&self) -> f32 {
        self.desc.center_of_mass.y - self.waterline.level
    }

    /// Upright floatation at rest.
    pub fn waterline(&self) -> &Waterline {
        &self.waterline
    }

    /// Metacentric heights (roll, pitch) in m; negative ones do not float upright.
    pub fn metacentric_heights(&self) -> Vec2 {
        self.waterline.metacentric_heights(self.desc.center_of_mass.y)
    }

    /// Spread of the principal moments over their mean, which [`Inertia::PreRigid`](crate::Inertia::PreRigid) neglects: 0 for a sphere.
    pub fn inertia_mismatch(&self) -> f32 {
        self.mismatch
    }

    /// Radius in m of a sphere about the centre of the bounding box that holds the hull.
    pub fn bounding_radius(&self) -> f32 {
        self.reach
    }

    /// Immersed volume in m^3 at the last sub-step.
    pub fn immersed_volume(&self) -> f32 {
        self.immersed
    }

    /// Squares of the highest frequencies in heave and in rotation, dry, rad^2/s^2.
    pub(crate) fn stiffness(&self) -> Vec2 {
        self.stiffness
    }

    /// How often a state that was not finite had to be replaced.
    pub fn resets(&self) -> u32 {
        self.resets
    }
}

//! Rigid bodies and colliders that fit a body of the water.

use floating_body::{Body, BodyState, Hull, HullKind};
use glam::Vec3;
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::geometry::ColliderBuilder;
use rapier3d::math::Pose;
use rapier3d::parry::mass_properties::MassProperties;

/// A dynamic rigid body with the mass, centre of mass and inertia of `body`, in `state`. Its frame is the hull's.
///
/// Give it colliders of density 0 ([`collider`] makes one).
pub fn rigid_body(body: &Body, state: &BodyState) -> RigidBodyBuilder {
    let (desc, rotation) = (body.desc(), state.orientation.normalize());
    let mass = MassProperties::with_inertia_matrix(desc.center_of_mass, desc.mass, body.inertia());
    RigidBodyBuilder::dynamic()
        .pose(Pose::from_parts(state.position - rotation * desc.center_of_mass, rotation))
        .linvel(state.velocity)
        .angvel(state.angular_velocity)
        .additional_mass_properties(mass)
}

/// A collider in the hull's shape, with density 0, in the rigid body's frame. A mesh becomes its convex hull: what shall
/// be hollow, such as a cockpit, needs colliders of its own.
pub fn collider(hull: &Hull) -> ColliderBuilder {
    let builder = match hull.kind() {
        HullKind::Sphere { radius } => ColliderBuilder::ball(radius),
        // Rapier's cylinder stands along y.
        HullKind::Cylinder { radius, length } => {
            ColliderBuilder::cylinder(0.5 * length, radius).rotation(Vec3::Z * std::f32::consts::FRAC_PI_2)
        }
        HullKind::Mesh(mesh) => ColliderBuilder::convex_hull(&mesh.vertices).unwrap_or_else(|| boxed(hull)),
        _ => boxed(hull),
    };
    builder.density(0.0)
}

/// The bounding box.
fn boxed(hull: &Hull) -> ColliderBuilder {
    let (low, high) = hull.bounds();
    let half = 0.5 * (high - low);
    ColliderBuilder::cuboid(half.x, half.y, half.z).translation(0.5 * (low + high))
}

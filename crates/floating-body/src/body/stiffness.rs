//! How fast a body could swing at most, which decides the number of sub-steps.

use glam::{Mat3, Vec2, Vec3};

use crate::{BodyDesc, ForcePoint, GRAVITY};

/// Squares of the frequencies in heave and of the fastest rotation of the dry body, rad^2/s^2: bounds for sub-steps.
/// About an axis a point resists by its lever and, as its extent turns, by how unlike its sides are.
pub(super) fn stiffness(points: &[ForcePoint], desc: &BodyDesc, tensor: Mat3) -> Vec2 {
    let (mut heave, mut turn) = (0.0, Vec3::ZERO);
    for p in points {
        let weight = desc.water_density * GRAVITY * p.volume;
        let (upright, thin) = (weight / (2.0 * p.half.y), weight / (2.0 * p.half.min_element()));
        heave += thin.min(4.0 * upright);
        let (r, h) = (p.position * p.position, p.half * p.half);
        let lever = Vec3::new(r.y + r.z, r.x + r.z, r.x + r.y);
        let uneven = Vec3::new(h.y - h.z, h.z - h.x, h.x - h.y).abs();
        turn += (lever + uneven) * upright;
    }
    let moments = Vec3::new(tensor.x_axis.x, tensor.y_axis.y, tensor.z_axis.z);
    let floor = 0.02 * moments.max_element();
    // Still water resists no yaw.
    let turn = Vec2::new(turn.x, turn.z) / Vec2::new(moments.x, moments.z).max(Vec2::splat(floor));
    Vec2::new(heave / desc.mass, turn.max_element())
}

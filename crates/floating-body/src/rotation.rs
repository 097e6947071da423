//! Rotations in plain f32, without the SIMD of `glam::Quat`, so that every machine computes the same bits.

use glam::{Mat3, Quat, Vec3};

/// The rotation matrix of a quaternion that is a unit one but for rounding, body to world. That is taken out: left in, it
/// would add up to a percent of the energy of a body that tumbles for 100,000 steps.
pub(crate) fn matrix(q: Quat) -> Mat3 {
    let (x, y, z, w) = (q.x, q.y, q.z, q.w);
    let two = 4.0 - 2.0 * (x * x + y * y + z * z + w * w);
    let (x2, y2, z2) = (x * two, y * two, z * two);
    Mat3::from_cols(
        Vec3::new(1.0 - (y * y2 + z * z2), x * y2 + w * z2, x * z2 - w * y2),
        Vec3::new(x * y2 - w * z2, 1.0 - (x * x2 + z * z2), y * z2 + w * x2),
        Vec3::new(x * z2 + w * y2, y * z2 - w * x2, 1.0 - (x * x2 + y * y2)),
    )
}

/// `q` turned by the Cayley map of `turn` (body axes, radians for small turns), normalised. This map and the implicit
/// midpoint rule of [`tumble`] together keep the angular momentum in the world exactly.
pub(crate) fn turned(q: Quat, turn: Vec3) -> Quat {
    let (x, y, z) = (0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z);
    normalized([
        q.w * x + q.x + q.y * z - q.z * y,
        q.w * y + q.y + q.z * x - q.x * z,
        q.w * z + q.z + q.x * y - q.y * x,
        q.w - q.x * x - q.y * y - q.z * z,
    ])
}

/// First `b`, then `a`, normalised.
pub(crate) fn product(a: Quat, b: Quat) -> Quat {
    normalized([
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
        a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    ])
}

/// The unit quaternion along (x, y, z, w); the identity if there is none.
pub(crate) fn normalized(c: [f32; 4]) -> Quat {
    let length = (c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3]).sqrt();
    if !(length.is_finite() && length > 1.0e-12) {
        return Quat::IDENTITY;
    }
    Quat::from_xyzw(c[0] / length, c[1] / length, c[2] / length, c[3] / length)
}

/// Torque-free rotation over `dt` in body axes by the implicit midpoint rule on Euler's equations,
/// `I (w1 - w0) = -dt m x I m` with `m = (w0 + w1)/2`, solved by Newton's method. Energy `w.Iw/2` and `|Iw|` are
/// invariants of the rule. Returns `w1` and `m`.
pub(crate) fn tumble(inertia: Mat3, w0: Vec3, dt: f32) -> (Vec3, Vec3) {
    let mut m = w0;
    // Unknown m: 2 I (m - w0) + dt m x I m = 0. Three rounds reach f32 for |w| dt up to about 1.
    for _ in 0..3 {
        let momentum = inertia * m;
        let residual = inertia * ((m - w0) * 2.0) + m.cross(momentum) * dt;
        let jacobian = inertia * 2.0 + (skew(m) * inertia - skew(momentum)) * dt;
        let step = jacobian.inverse() * residual;
        if !step.is_finite() {
            return (w0, w0);
        }
        m -= step;
    }
    (m * 2.0 - w0, m)
}

fn skew(v: Vec3) -> Mat3 {
    Mat3::from_cols(Vec3::new(0.0, v.z, -v.y), Vec3::new(-v.z, 0.0, v.x), Vec3::new(v.y, -v.x, 0.0))
}

/// Principal moments of a symmetric tensor, by Jacobi rotations (f64).
pub(crate) fn principal_moments(tensor: Mat3) -> [f32; 3] {
    let mut a = tensor.as_dmat3().to_cols_array_2d();
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (upper, lower) = (a[p], a[q]);
            a[p] = std::array::from_fn(|k| c * upper[k] - s * lower[k]);
            a[q] = std::array::from_fn(|k| s * upper[k] + c * lower[k]);
        }
    }
    [a[0][0] as f32, a[1][1] as f32, a[2][2] as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrix_and_turn_agree_with_glam() {
        let q = Quat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
        let v = Vec3::new(1.0, 2.0, 3.0);
        assert!((matrix(q) * v - q * v).length() < 1e-5);
        let small = Vec3::new(0.01, -0.02, 0.015);
        let expected = q * Quat::from_scaled_axis(small);
        assert!(turned(q, small).dot(expected).abs() > 1.0 - 1e-6);
        let p = Quat::from_euler(glam::EulerRot::ZXY, 1.3, 0.4, -0.8);
        assert!(product(p, q).abs_diff_eq(p * q, 1e-6));
    }

    #[test]
    fn principal_moments_of_a_turned_diagonal() {
        let r = Mat3::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.7, 0.2, -0.4));
        let mut found = principal_moments(r * Mat3::from_diagonal(Vec3::new(1.0, 2.0, 5.0)) * r.transpose());
        found.sort_by(f32::total_cmp);
        for (f, e) in found.iter().zip([1.0, 2.0, 5.0]) {
            assert!((f - e).abs() < 1e-5, "{found:?}");
        }
    }

    #[test]
    fn tumbling_keeps_energy_and_momentum_for_100_000_steps() {
        let inertia = Mat3::from_diagonal(Vec3::new(1.0, 3.0, 3.5));
        let (mut w, mut q) = (Vec3::new(0.02, 4.0, 0.01), Quat::IDENTITY);
        let (energy, momentum) = (w.dot(inertia * w), inertia * w);
        let mut turned_over = false;
        for _ in 0..100_000 {
            let (w1, m) = tumble(inertia, w, 1.0 / 60.0);
            (w, q) = (w1, turned(q, m / 60.0));
            turned_over |= w.y < 0.0;
        }
        assert!((w.dot(inertia * w) / energy - 1.0).abs() < 0.01);
        let now = matrix(q) * (inertia * w);
        assert!((now - momentum).length() / momentum.length() < 0.01, "{now} against {momentum}");
        assert!(!turned_over || w.is_finite());
    }
}

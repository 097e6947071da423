//! A sub-step of eight pieces: [`Body`](crate::Body)'s, on a plane of water.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::Mat3;

use super::lanes::{M3, Num, Turn, V3};
use super::template::{Pace, Template, Turning};
use super::wet::{Surface, immerse};
use crate::body::{DEEPEST, LIMITS};
use crate::{Coefficients, GRAVITY};

/// Poses and velocities, world axes.
#[derive(Clone, Copy)]
pub(super) struct Motion<S: Simd> {
    pub(super) position: V3<S>,
    pub(super) turn: Turn<S>,
    pub(super) velocity: V3<S>,
    pub(super) spin: V3<S>,
}

/// Moves the pieces on. Returns the volumes immersed at the start.
#[inline(always)]
pub(super) fn substep<S: Simd>(
    simd: S,
    template: &Template,
    coefficients: &Coefficients,
    pace: &Pace,
    surface: &Surface<S>,
    motion: &mut Motion<S>,
) -> Num<S> {
    let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
    let dt = pace.dt;
    let rotation = motion.turn.matrix();
    let wet = immerse(simd, template, surface, motion.position, &rotation);
    let share = (wet.volume * (1.0 / template.volume)).min(f32x8::splat(simd, DEEPEST));
    // The water counts as far as its wave has not faded.
    let felt = wet.moved / wet.volume.max(f32x8::splat(simd, 1.0e-30));
    let axes = if template.blunt { rotation } else { resistance_axes(simd, &rotation, surface, wet.volume) };
    let water = axes.back(surface.flow.scale(felt));
    let added = V3::all(simd, coefficients.added_mass).scale(share);
    let whole = added + V3::all(simd, glam::Vec3::splat(template.mass));
    let velocity = axes.back(motion.velocity);

    let weight = f32x8::splat(simd, template.mass * GRAVITY);
    let heaved = axes.back(V3::new(zero, surface.acceleration * felt, zero));
    let drive = axes.back(V3::new(wet.force.x, wet.force.y - weight, wet.force.z)) + added * heaved;
    let eased = V3::new(one, one, one).over(whole);
    // Nothing holds what falls.
    let (dry, whole_step) = (wet.volume.simd_le(zero), f32x8::splat(simd, dt));
    let paced = dry.select(whole_step, f32x8::splat(simd, dt / pace.held[0]));
    let pushed = velocity + (drive * eased).scale(paced) - water;
    let radiating = share * ((f32x8::splat(simd, template.points) - wet.volume) * template.sheds).max(zero).min(one);
    let linear =
        V3::all(simd, template.drag.linear).scale(share) + V3::all(simd, coefficients.damping).scale(radiating);
    let rates = drag_rates(simd, template, pushed) * V3::new(share, share.min(one), share);
    let slowed = implicit(simd, pushed, linear * eased, rates * eased, dt);
    motion.velocity = axes.times(slowed + water);

    let lateral = V3::all(simd, template.lateral);
    let more = V3::all(simd, coefficients.added_inertia).scale(share);
    let inertia = columns(simd, template.inertia, more);
    let moments = V3::new(inertia.x.x, inertia.y.y, inertia.z.z);
    let stopped = whole.z * stopped_share(simd, slowed.z, pushed.z);
    let eased = V3::new(one, one, one).over(moments);
    let lever = lateral.x * lateral.x * eased.y + lateral.y * lateral.y * eased.x;
    let sideways = whole.z * (slowed.z - pushed.z) * (1.0 / dt) / (stopped * lever + 1.0);
    let torque = wet.torque + lateral.cross(rotation.back(axes.z.scale(sideways)));
    let twist = if template.turning == Turning::Full { inertia.solve(simd, torque) } else { torque * eased };
    let paced = dry.select(whole_step, f32x8::splat(simd, dt / pace.held[1]));
    let turning = rotation.back(motion.spin) + twist.scale(paced);
    let speed = slowed.dot(slowed).sqrt();
    let drag = &template.drag;
    let spinning = V3::new(turning.x.abs(), turning.y.abs(), turning.z.abs());
    let linear = (V3::all(simd, drag.angular_linear) + V3::all(simd, drag.angular_forward).scale(speed)).scale(share)
        + V3::all(simd, coefficients.angular_damping).scale(radiating);
    let rates = (V3::all(simd, drag.angular_quadratic) * spinning).scale(share);
    let driven = implicit(simd, turning, linear * eased, rates * eased, dt).shortened(simd, LIMITS.1);
    let (turning, mean) = match template.turning {
        Turning::PreRigid => (driven, driven),
        Turning::Diagonal => tumble_diagonal(simd, moments, eased, driven, dt),
        Turning::Full => tumble(simd, &inertia, driven, dt),
    };
    motion.turn = motion.turn.turned(simd, mean.scale(f32x8::splat(simd, dt)));
    motion.spin = motion.turn.matrix().times(turning);
    motion.position = motion.position + motion.velocity.scale(f32x8::splat(simd, dt));
    wet.volume
}

/// Share of a speed that was stopped, 0 to 1.
#[inline(always)]
fn stopped_share<S: Simd>(simd: S, to: Num<S>, from: Num<S>) -> Num<S> {
    let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
    let still = from.simd_eq(zero);
    still.select(zero, (one - to / still.select(one, from)).max(zero).min(one))
}

/// See [`implicit`](crate::drag::implicit); `linear` and `rates` over the mass, 1/s.
#[inline(always)]
fn implicit<S: Simd>(simd: S, v: V3<S>, linear: V3<S>, rates: V3<S>, dt: f32) -> V3<S> {
    let one = f32x8::splat(simd, 1.0);
    let whole = linear.scale(f32x8::splat(simd, dt)) + V3::new(one, one, one);
    let root = whole * whole + rates.scale(f32x8::splat(simd, 4.0 * dt));
    (v + v).over(whole + V3::new(root.x.sqrt(), root.y.sqrt(), root.z.sqrt()))
}

/// Speed that feeds an axis' quadratic resistance.
#[inline(always)]
fn speed<S: Simd>(simd: S, all: Num<S>, own: Num<S>, cross: f32) -> Num<S> {
    let own = own * own;
    (own + (all - own).max(f32x8::splat(simd, 0.0)) * (cross * cross)).sqrt()
}

/// See [`Drag::quadratic_rates`](crate::Drag).
#[inline(always)]
fn drag_rates<S: Simd>(simd: S, template: &Template, rel: V3<S>) -> V3<S> {
    let drag = &template.drag;
    let all = rel.dot(rel);
    let speeds = if drag.cross_flow == glam::Vec3::ONE {
        let speed = all.sqrt();
        V3::new(speed, speed, speed)
    } else {
        let cross = drag.cross_flow;
        V3::new(speed(simd, all, rel.x, cross.x), speed(simd, all, rel.y, cross.y), speed(simd, all, rel.z, cross.z))
    };
    V3::all(simd, drag.quadratic) * speeds
}

/// See [`resistance_axes`](crate::forces::resistance_axes).
#[inline(always)]
fn resistance_axes<S: Simd>(simd: S, rotation: &M3<S>, surface: &Surface<S>, volume: Num<S>) -> M3<S> {
    let zero = f32x8::splat(simd, 0.0);
    let wet = volume.simd_gt(zero);
    let (sx, sz) = (wet.select(surface.slope[0], zero), wet.select(surface.slope[1], zero));
    let steep = f32x8::splat(simd, 1.0) / (sx * sx + sz * sz + 1.0).sqrt();
    let normal = V3::new(-(sx * steep), steep, -(sz * steep));
    let side = rotation.x.cross(normal);
    let length = side.dot(side).sqrt();
    let proper = length.simd_gt(f32x8::splat(simd, 1.0e-6));
    let inverse = f32x8::splat(simd, 1.0) / length.max(f32x8::splat(simd, 1.0e-6));
    let side = V3::either(proper, side.scale(inverse), rotation.z);
    let upright = rotation.y.dot(normal).simd_ge(f32x8::splat(simd, 0.7));
    M3 {
        x: V3::either(upright, normal.cross(side), rotation.x),
        y: V3::either(upright, normal, rotation.y),
        z: V3::either(upright, side, rotation.z),
    }
}

/// The tensor with what the water adds.
#[inline(always)]
fn columns<S: Simd>(simd: S, inertia: Mat3, added: V3<S>) -> M3<S> {
    let (mut x, mut y) = (V3::all(simd, inertia.x_axis), V3::all(simd, inertia.y_axis));
    let mut z = V3::all(simd, inertia.z_axis);
    x.x += added.x;
    y.y += added.y;
    z.z += added.z;
    M3 { x, y, z }
}

/// Rounds of Newton's method for the midpoint.
const ROUNDS: u32 = 2;

/// Torque-free rotation by the implicit midpoint rule, as [`tumble`](crate::rotation::tumble), about principal axes: the
/// equations share a determinant of few terms. Starts from half an explicit step.
#[inline(always)]
fn tumble_diagonal<S: Simd>(simd: S, moments: V3<S>, eased: V3<S>, w0: V3<S>, dt: f32) -> (V3<S>, V3<S>) {
    let one = f32x8::splat(simd, 1.0);
    // m - w0 = b m m' with the two others' product.
    let half = f32x8::splat(simd, 0.5 * dt);
    let b = V3::new(moments.y - moments.z, moments.z - moments.x, moments.x - moments.y) * eased.scale(half);
    let mut m = w0 + b * others(w0);
    for _ in 0..ROUNDS {
        let residual = m - w0 - b * others(m);
        // Jacobian: 1 on the diagonal, -b of the row times the third component elsewhere.
        let jacobian = M3 {
            x: V3::new(one, -(b.y * m.z), -(b.z * m.y)),
            y: V3::new(-(b.x * m.z), one, -(b.z * m.x)),
            z: V3::new(-(b.x * m.y), -(b.y * m.x), one),
        };
        m = m - jacobian.solve(simd, residual);
    }
    let w1 = m + m - w0;
    believed(simd, w0, m, w0.dot(moments * w0), w1.dot(moments * w1))
}

/// For each component the product of the other two.
#[inline(always)]
fn others<S: Simd>(m: V3<S>) -> V3<S> {
    V3::new(m.y * m.z, m.z * m.x, m.x * m.y)
}

/// The same with products of inertia.
#[inline(always)]
fn tumble<S: Simd>(simd: S, inertia: &M3<S>, w0: V3<S>, dt: f32) -> (V3<S>, V3<S>) {
    let step = f32x8::splat(simd, dt);
    let mut m = w0 - inertia.solve(simd, w0.cross(inertia.times(w0))).scale(f32x8::splat(simd, 0.5 * dt));
    for _ in 0..ROUNDS {
        let momentum = inertia.times(m);
        let away = m - w0;
        let residual = inertia.times(away + away) + m.cross(momentum).scale(step);
        // d(m x I m) along an axis e: e x I m + m x I e.
        let zero = f32x8::splat(simd, 0.0);
        let across = [
            V3::new(zero, -momentum.z, momentum.y),
            V3::new(momentum.z, zero, -momentum.x),
            V3::new(-momentum.y, momentum.x, zero),
        ];
        let jacobian = M3 {
            x: inertia.x + inertia.x + (across[0] + m.cross(inertia.x)).scale(step),
            y: inertia.y + inertia.y + (across[1] + m.cross(inertia.y)).scale(step),
            z: inertia.z + inertia.z + (across[2] + m.cross(inertia.z)).scale(step),
        };
        m = m - jacobian.solve(simd, residual);
    }
    let w1 = m + m - w0;
    believed(simd, w0, m, w0.dot(inertia.times(w0)), w1.dot(inertia.times(w1)))
}

/// The end and the middle of a step; where Newton's method found no rule that keeps the energy, the start.
#[inline(always)]
fn believed<S: Simd>(simd: S, w0: V3<S>, m: V3<S>, before: Num<S>, after: Num<S>) -> (V3<S>, V3<S>) {
    let kept = after.simd_le(before * 1.05) & after.simd_ge(f32x8::splat(simd, 0.0));
    (V3::either(kept, m + m - w0, w0), V3::either(kept, m, w0))
}

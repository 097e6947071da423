//! Force points as a quadrature: volumes, heights and extents of columns so that volume and righting moments are the
//! mesh's at the waterline and about it, heeled and trimmed.
//!
//! Least squares (Levenberg and Marquardt) against the mesh clipped at 35 planes, from columns that already fit
//! upright. A column is linear in its depth and a hull is not, so up to a percent is left.

use fearless_simd::Level;
use glam::DVec3;

use super::clip::lanes::{Plane, push};
use super::clip::panels::Panels;
use crate::ForcePoint;

/// Heel and trim at which the points are fitted, degrees.
const HEELS: [f64; 7] = [-20.0, -12.0, -5.0, 0.0, 5.0, 12.0, 20.0];
const TRIMS: [f64; 3] = [-4.0, 0.0, 4.0];
/// Shares of the displaced volume at which they are, and their weights.
const LOADS: [(f64, f64); 3] = [(0.7, 0.4), (1.0, 1.0), (1.4, 0.4)];
/// Weight of the upright waterline, and of the hull's whole volume.
const UPRIGHT: f64 = 10.0;
const WHOLE: f64 = 4.0;
/// What a relative change of a point costs.
/// Not more points are fitted, which would take seconds; so many follow a shape by themselves.
const MOST: usize = 64;
const STAY: f64 = 0.02;
/// Rounds at most, and the gain below which they end.
const ROUNDS: usize = 20;
const GAIN: f64 = 0.02;
/// Largest change of a point's volume and height (logarithm) and of its place (in half heights).
const FARTHEST: f64 = 1.2;
/// Unknowns of a point: logarithm of volume, height of centre, logarithm of half height, place and half width across.
const OF_POINT: usize = 5;

/// The hull below a plane, about the reference: wanted volume and moment (torque of unit weight), weighted.
struct Target {
    up: DVec3,
    height: f64,
    wanted: [f64; 4],
    weight: f64,
}

/// Volume, and moment times `up`, of what is wet of a point with `change`s.
fn response(p: &ForcePoint, change: &[f64], t: &Target) -> [f64; 4] {
    let half = p.half.as_dvec3();
    let tall = half.y * libm::exp(change[2]);
    let half_now = DVec3::new(half.x, tall, half.z * libm::exp(change[4]));
    let at = p.position.as_dvec3() + DVec3::new(0.0, change[1] * half.y, change[3] * half.z);
    let volume = f64::from(p.volume) * libm::exp(change[0]);
    // As `ForcePoint::immersion` of a box has it.
    let scaled = half_now * t.up;
    let extent = scaled.length().max(1.0e-9);
    let u = ((t.height - t.up.dot(at)) / extent).clamp(-1.0, 1.0);
    let share = 0.5 * (1.0 + u);
    let own = half_now * scaled / extent * (0.25 * (1.0 - u * u));
    let torque = (at * share - own).cross(t.up) * volume;
    [volume * share, torque.x, torque.y, torque.z]
}

/// Fits `points` of a mesh hull (boxes, hull frame) that displaces `volume` of its `whole` volume afloat.
pub(super) fn fit(points: &mut [ForcePoint], panels: &Panels, bounds: (DVec3, DVec3), volume: f64, whole: f64) {
    if points.len() > MOST {
        return;
    }
    let targets = targets(panels, bounds, volume.min(0.97 * whole));
    // A moment counts by its lever over this length.
    let size = bounds.1 - bounds.0;
    let lever = 0.25 * (size.x * size.z).sqrt() * volume;
    let scale = [volume, lever, lever, lever];
    let sum = |changes: &[f64]| {
        let mut rest = Vec::with_capacity(4 * targets.len() + 1);
        for t in &targets {
            let mut all = t.wanted.map(|w| -w);
            for (p, change) in points.iter().zip(changes.chunks_exact(OF_POINT)) {
                let own = response(p, change, t);
                all.iter_mut().zip(own).for_each(|(a, o)| *a += o);
            }
            rest.extend(all.iter().zip(scale).map(|(a, s)| t.weight * a / s));
        }
        let held: f64 =
            points.iter().zip(changes.chunks_exact(OF_POINT)).map(|(p, c)| f64::from(p.volume) * libm::exp(c[0])).sum();
        rest.push(WHOLE * (held - whole) / whole);
        rest
    };
    let n = points.len() * OF_POINT;
    let cost = |rest: &[f64], changes: &[f64]| {
        rest.iter().map(|r| r * r).sum::<f64>() + changes.iter().map(|c| STAY * STAY * c * c).sum::<f64>()
    };
    let mut changes = vec![0.0; n];
    let mut rest = sum(&changes);
    let (mut now, mut damping, mut idle) = (cost(&rest, &changes), 0.01, 0);
    let (mut normal, mut right) = normal(points, &changes, &targets, scale, whole, &rest);
    for _ in 0..ROUNDS {
        let mut matrix = normal.clone();
        (0..n).for_each(|i| matrix[i * n + i] += damping * normal[i * n + i]);
        let Some(step) = solve(&mut matrix, right.clone(), n) else { break };
        let moved: Vec<f64> = changes.iter().zip(&step).map(|(c, s)| (c + s).clamp(-FARTHEST, FARTHEST)).collect();
        let found = sum(&moved);
        let better = cost(&found, &moved);
        if better < now {
            idle = if better < (1.0 - GAIN) * now { 0 } else { idle + 1 };
            (changes, rest, now) = (moved, found, better);
            damping *= 0.3;
            if idle > 1 {
                break;
            }
            (normal, right) = self::normal(points, &changes, &targets, scale, whole, &rest);
        } else {
            damping *= 6.0;
        }
    }
    let all_finite = changes.iter().all(|c| c.is_finite());
    if !all_finite {
        return;
    }
    for (p, c) in points.iter_mut().zip(changes.chunks_exact(OF_POINT)) {
        p.position.y += (c[1] * f64::from(p.half.y)) as f32;
        p.volume = (f64::from(p.volume) * libm::exp(c[0])) as f32;
        p.position.z += (c[3] * f64::from(p.half.z)) as f32;
        p.half.y = (f64::from(p.half.y) * libm::exp(c[2])) as f32;
        p.half.z = (f64::from(p.half.z) * libm::exp(c[4])) as f32;
    }
    // What is missing of the whole volume goes to the tops, which leaves the bottoms' answer as it is.
    let held: f64 = points.iter().map(|p| f64::from(p.volume)).sum();
    let grown = (whole / held) as f32;
    for p in points {
        p.position.y += p.half.y * (grown - 1.0);
        p.half.y *= grown;
        p.volume *= grown;
    }
}

/// Planes and what the mesh has below them.
fn targets(panels: &Panels, (low, high): (DVec3, DVec3), volume: f64) -> Vec<Target> {
    let level = Level::new();
    let reach = (high - low).length() + low.length().max(high.length());
    let mut depths = Vec::new();
    let mut below = |up: DVec3, height: f64| {
        let plane = Plane { depth: height as f32, slope: up.as_vec3() };
        let sum = push(level, panels, &[plane], None, &mut depths);
        (f64::from(sum.lift.dot(up.as_vec3())), sum.torque.as_dvec3())
    };
    let mut targets = Vec::new();
    for heel in HEELS {
        for trim in TRIMS {
            let (h, t) = (heel.to_radians(), trim.to_radians());
            let up = DVec3::new(libm::sin(t), libm::cos(t) * libm::cos(h), libm::cos(t) * libm::sin(h));
            for (load, weight) in LOADS {
                if trim != 0.0 && load != 1.0 {
                    continue;
                }
                let wanted = load * volume;
                let (mut a, mut b) = (-reach, reach);
                for _ in 0..20 {
                    let middle = 0.5 * (a + b);
                    if below(up, middle).0 < wanted { a = middle } else { b = middle }
                }
                let height = 0.5 * (a + b);
                let (volume, torque) = below(up, height);
                let upright = if heel == 0.0 && trim == 0.0 && load == 1.0 { UPRIGHT } else { 1.0 };
                let wanted = [volume, torque.x, torque.y, torque.z];
                targets.push(Target { up, height, wanted, weight: weight * upright });
            }
        }
    }
    targets
}

/// How what is left changes with each unknown, row by row, by differences.
fn slopes(points: &[ForcePoint], changes: &[f64], targets: &[Target], scale: [f64; 4], whole: f64) -> Vec<f64> {
    const STEP: f64 = 1.0e-4;
    let n = changes.len();
    let mut slopes = vec![0.0; n * (4 * targets.len() + 1)];
    for (i, (p, change)) in points.iter().zip(changes.chunks_exact(OF_POINT)).enumerate() {
        for k in 0..OF_POINT {
            let moved =
                |by: f64| -> [f64; OF_POINT] { std::array::from_fn(|j| change[j] + if j == k { by } else { 0.0 }) };
            let (up, down, column) = (moved(STEP), moved(-STEP), OF_POINT * i + k);
            for (row, t) in targets.iter().enumerate() {
                let (a, b) = (response(p, &up, t), response(p, &down, t));
                for part in 0..4 {
                    let slope = (a[part] - b[part]) / (2.0 * STEP * scale[part]);
                    slopes[(4 * row + part) * n + column] = t.weight * slope;
                }
            }
        }
        slopes[4 * targets.len() * n + OF_POINT * i] = WHOLE * f64::from(p.volume) * libm::exp(change[0]) / whole;
    }
    slopes
}

/// Normal equations (lower half) and their right side.
fn normal(
    points: &[ForcePoint],
    changes: &[f64],
    targets: &[Target],
    scale: [f64; 4],
    whole: f64,
    rest: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let n = changes.len();
    let slopes = slopes(points, changes, targets, scale, whole);
    let (mut matrix, mut right) = (vec![0.0; n * n], vec![0.0; n]);
    for (row, r) in slopes.chunks_exact(n).zip(rest) {
        for i in 0..n {
            let s = row[i];
            if s != 0.0 {
                right[i] -= s * r;
                matrix[i * n..i * n + i + 1].iter_mut().zip(row).for_each(|(m, v)| *m += s * v);
            }
        }
    }
    for i in 0..n {
        right[i] -= STAY * STAY * changes[i];
        matrix[i * n + i] += STAY * STAY;
    }
    (matrix, right)
}

/// Solves a symmetric positive system (lower half given) by Cholesky's method.
fn solve(a: &mut [f64], mut b: Vec<f64>, n: usize) -> Option<Vec<f64>> {
    for i in 0..n {
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| a[i * n + k] * a[j * n + k]).sum();
            let rest = a[i * n + j] - dot;
            if i == j {
                if rest.is_nan() || rest <= 0.0 {
                    return None;
                }
                a[i * n + i] = rest.sqrt();
            } else {
                a[i * n + j] = rest / a[j * n + j];
            }
        }
        let dot: f64 = (0..i).map(|k| a[i * n + k] * b[k]).sum();
        b[i] = (b[i] - dot) / a[i * n + i];
    }
    for i in (0..n).rev() {
        let dot: f64 = (i + 1..n).map(|k| a[k * n + i] * b[k]).sum();
        b[i] = (b[i] - dot) / a[i * n + i];
    }
    b.iter().all(|v| v.is_finite()).then_some(b)
}

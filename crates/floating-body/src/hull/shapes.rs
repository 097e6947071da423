//! Closed shapes: cuboid, sphere, cylinder and the paper's hollow cylinder, with their force points and spans.

use glam::{DMat3, DVec2, DVec3, Vec3};

use super::solid::Solid;
use super::spans::{Span, spans_by};
use crate::point::{ForcePoint, PointShape};

/// A closed shape about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Cuboid {
        half: DVec3,
    },
    Sphere {
        radius: f64,
    },
    /// Axis along x.
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// The paper's stand-in body: mass in a tube, water outside it. Axis along x.
    HollowCylinder {
        length: f64,
        radius: f64,
        ratio: f64,
    },
}

const PI: f64 = std::f64::consts::PI;

impl Shape {
    /// Volume and unit inertia in closed form.
    pub(crate) fn solid(&self) -> Solid {
        let (half, volume, inertia) = match *self {
            Self::Cuboid { half } => {
                let q = half * half / 3.0;
                (half, 8.0 * half.x * half.y * half.z, DVec3::new(q.y + q.z, q.x + q.z, q.x + q.y))
            }
            Self::Sphere { radius } => {
                let volume = 4.0 / 3.0 * PI * radius * radius * radius;
                (DVec3::splat(radius), volume, DVec3::splat(0.4 * radius * radius))
            }
            Self::Cylinder { radius, length } => (
                DVec3::new(length / 2.0, radius, radius),
                tube_volume(radius, length),
                tube_inertia(radius, length, 0.0),
            ),
            Self::HollowCylinder { length, radius, ratio } => (
                DVec3::new(length / 2.0, radius, radius),
                tube_volume(radius, length),
                tube_inertia(radius, length, ratio),
            ),
        };
        let unit_inertia = DMat3::from_diagonal(inertia);
        Solid { volume, centroid: DVec3::ZERO, unit_inertia, low: -half, high: half }
    }

    pub(crate) fn spans(&self, solid: &Solid) -> Vec<Span> {
        let shape = *self;
        spans_by(solid.low, solid.high, solid.volume, |_, at, found| {
            let height = shape.half_height(at);
            found.push((-height, height));
        })
    }

    /// Half the vertical chord at (x, z).
    pub(crate) fn half_height(&self, at: DVec2) -> f64 {
        match *self {
            Self::Cuboid { half } => half.y,
            Self::Sphere { radius } => (radius * radius - at.length_squared()).max(0.0).sqrt(),
            Self::Cylinder { radius, .. } | Self::HollowCylinder { radius, .. } => {
                (radius * radius - at.y * at.y).max(0.0).sqrt()
            }
        }
    }

    /// About `count` force points in closed form.
    pub(crate) fn points(&self, count: u32) -> Vec<ForcePoint> {
        match *self {
            Self::Cuboid { half } => cuboid_points(half, count),
            Self::Sphere { radius } => vec![ForcePoint {
                position: Vec3::ZERO,
                half: Vec3::splat(radius as f32),
                volume: (4.0 / 3.0 * PI * radius * radius * radius) as f32,
                shape: PointShape::Ball,
            }],
            Self::Cylinder { radius, length } => {
                let n = f64::from(count.max(1));
                let half = DVec3::new(length / n / 2.0, radius, radius);
                let disc = |i: u32| {
                    let x = (f64::from(i) + 0.5) / n * length - length / 2.0;
                    point(DVec3::new(x, 0.0, 0.0), half, tube_volume(radius, length) / n, PointShape::DiscX)
                };
                (0..count.max(1)).map(disc).collect()
            }
            Self::HollowCylinder { length, radius, .. } => ring_points(length, radius, count),
        }
    }
}

fn tube_volume(radius: f64, length: f64) -> f64 {
    PI * radius * radius * length
}

/// Eqs. 9 and 10 of the paper per unit of mass, with the axis along x: (Izz, Ixx, Ixx) in its letters.
fn tube_inertia(radius: f64, length: f64, ratio: f64) -> DVec3 {
    let q = radius * radius * (1.0 + ratio * ratio);
    DVec3::new(q / 2.0, length * length / 12.0 + q / 4.0, length * length / 12.0 + q / 4.0)
}

fn point(at: DVec3, half: DVec3, volume: f64, shape: PointShape) -> ForcePoint {
    ForcePoint { position: at.as_vec3(), half: half.as_vec3(), volume: volume as f32, shape }
}

/// Boxes as near to cubes as `count` allows.
fn cuboid_points(half: DVec3, count: u32) -> Vec<ForcePoint> {
    let n = f64::from(count.max(1));
    let side = (8.0 * half.x * half.y * half.z / n).cbrt();
    let counts = (half * 2.0 / side).round().max(DVec3::ONE).min(DVec3::splat(n));
    let small = half / counts;
    let volume = 8.0 * small.x * small.y * small.z;
    let mut points = Vec::new();
    for k in 0..counts.z as u32 {
        for j in 0..counts.y as u32 {
            for i in 0..counts.x as u32 {
                let index = DVec3::new(f64::from(i), f64::from(j), f64::from(k));
                points.push(point((index * 2.0 + 1.0) * small - half, small, volume, PointShape::Box));
            }
        }
    }
    points
}

/// The paper's force contact points: symmetric on both halves of the cylinder, all equally far from its centre. Their
/// ring has the radius at which the second moments of the displaced volume are those of the cylinder.
fn ring_points(length: f64, radius: f64, count: u32) -> Vec<ForcePoint> {
    let per_side = (count / 2).max(3);
    let half = DVec3::new(length / 4.0, radius / 2.0, radius / 2.0);
    let ring = (2.0 * (radius * radius / 4.0 - half.y * half.y / 3.0)).sqrt();
    let volume = tube_volume(radius, length) / f64::from(2 * per_side);
    let mut points = Vec::new();
    for i in 0..per_side {
        let angle = (f64::from(i) + 0.5) / f64::from(per_side) * 2.0 * PI;
        for x in [-length / 4.0, length / 4.0] {
            let at = DVec3::new(x, ring * libm::cos(angle), ring * libm::sin(angle));
            points.push(point(at, half, volume, PointShape::Box));
        }
    }
    points
}

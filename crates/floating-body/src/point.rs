//! A force point: a small piece of the hull with a volume, and how much of it is under water.
//!
//! Each piece has a potential `U(s, n) = V e G(s/e)` (per unit of specific weight) of the depth `s` of its centre and
//! of the surface normal `n` in the body's frame, with `e` the half-extent along `n`. Buoyancy is its derivative by
//! `s`, the moment its derivative by `n`: still water does no net work on a body, whatever it does.

use glam::Vec3;

use crate::BodyError;
use crate::error::check_range;

/// How a piece fills its extents, which decides how fast it immerses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PointShape {
    /// A box or an upright column: immersed linearly.
    Box,
    /// A ball: immersed as a spherical cap.
    Ball,
    /// A disc of a cylinder whose axis is the body's x: a circular segment when the axis lies level, linear when it
    /// stands, blended between.
    DiscX,
}

/// One piece of a hull, in the hull's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForcePoint {
    /// Centre in m.
    pub position: Vec3,
    /// Half-extents along the hull's axes in m, each > 0. For a column, y is half its height.
    pub half: Vec3,
    /// Volume in m^3, > 0.
    pub volume: f32,
    /// How it fills its extents.
    pub shape: PointShape,
}

/// What is under water of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Immersion {
    /// Immersed share of the volume, 0 to 1.
    pub(crate) share: f32,
    /// Half-extent along the normal in m.
    pub(crate) extent: f32,
    /// First moment of the immersed volume about the centre over the whole volume, body frame, m.
    pub(crate) moment: Vec3,
}

impl ForcePoint {
    /// Refuses non-finite, zero and negative extents and volumes.
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        for v in self.position.to_array() {
            check_range("points.position", v, -1.0e4, 1.0e4, "within +-10000 m")?;
        }
        for v in self.half.to_array() {
            check_range("points.half", v, 1.0e-4, 1.0e4, "in [0.0001, 10000] m")?;
        }
        check_range("points.volume", self.volume, 1.0e-9, 1.0e9, "in [1e-9, 1e9] m^3").map(drop)
    }

    /// Square of the radius of the disc with the point's area seen from above, m^2.
    pub(crate) fn footprint(&self) -> f32 {
        let area = if self.shape == PointShape::Ball { 1.0 } else { 4.0 * std::f32::consts::FRAC_1_PI };
        area * self.half.x * self.half.z
    }

    /// The immersed part when the centre is `depth` m under the surface (negative above) with normal `n` in the body's
    /// frame (unit).
    pub(crate) fn immersion(&self, depth: f32, n: Vec3) -> Immersion {
        let scaled = self.half * n;
        let extent = scaled.length().max(1.0e-6);
        let u = depth / extent;
        if u <= -1.0 {
            return Immersion { share: 0.0, extent, moment: Vec3::ZERO };
        }
        if u >= 1.0 {
            return Immersion { share: 1.0, extent, moment: Vec3::ZERO };
        }
        let gradient = self.half * scaled / extent;
        let (share, potential, twist) = match self.shape {
            PointShape::Box => (linear(u).0, linear(u).1, Vec3::ZERO),
            PointShape::Ball => (ball(u).0, ball(u).1, Vec3::ZERO),
            PointShape::DiscX => {
                let (flat, round) = (linear(u), disc(u));
                let standing = (scaled.x / extent) * (scaled.x / extent);
                let along = Vec3::new(2.0 * self.half.x * scaled.x / extent, 0.0, 0.0);
                let twist = (along - gradient * (2.0 * standing)) * (flat.1 - round.1);
                let mix = |a: f32, b: f32| standing * a + (1.0 - standing) * b;
                (mix(flat.0, round.0), mix(flat.1, round.1), twist)
            }
        };
        Immersion { share, extent, moment: -(gradient * (potential - u * share) + twist) }
    }
}

/// Share and its integral `G` for a uniform section.
fn linear(u: f32) -> (f32, f32) {
    ((1.0 + u) * 0.5, (1.0 + u) * (1.0 + u) * 0.25)
}

/// Share of a ball below a plane `u` radii above its centre, and its integral.
fn ball(u: f32) -> (f32, f32) {
    let u2 = u * u;
    ((2.0 + 3.0 * u - u2 * u) * 0.25, (2.0 * u + 1.5 * u2 - 0.25 * u2 * u2) * 0.25 + 0.1875)
}

/// Share of a disc below a chord `u` radii above its centre, and its integral.
fn disc(u: f32) -> (f32, f32) {
    let (root, angle) = ((1.0 - u * u).max(0.0).sqrt(), libm::asinf(u));
    let inv_pi = std::f32::consts::FRAC_1_PI;
    (0.5 + (u * root + angle) * inv_pi, 0.5 * u + (u * angle + root - root * root * root / 3.0) * inv_pi)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [PointShape; 3] = [PointShape::Box, PointShape::Ball, PointShape::DiscX];

    fn point(shape: PointShape) -> ForcePoint {
        let half = if shape == PointShape::Ball { Vec3::splat(0.7) } else { Vec3::new(0.4, 0.7, 0.7) };
        ForcePoint { position: Vec3::ZERO, half, volume: 1.0, shape }
    }

    /// `V e G` by integrating the share over depth, which shares nothing with the closed integrals.
    fn potential(p: &ForcePoint, depth: f32, n: Vec3) -> f64 {
        let e = p.immersion(0.0, n).extent;
        let steps = 20_000;
        let width = f64::from(depth + e) / f64::from(steps);
        let share = |i: i32| f64::from(p.immersion(-e + ((f64::from(i) + 0.5) * width) as f32, n).share);
        (0..steps).map(share).sum::<f64>() * width
    }

    #[test]
    fn the_moment_is_the_derivative_of_the_potential_by_the_normal() {
        for shape in SHAPES {
            let p = point(shape);
            let n = Vec3::new(0.5, 0.7, -0.4).normalize();
            for depth in [-0.3, 0.05, 0.4] {
                let m = p.immersion(depth, n).moment;
                for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
                    let turn = axis.cross(n) * 0.02;
                    let (a, b) = ((n + turn).normalize(), (n - turn).normalize());
                    let slope = (potential(&p, depth, a) - potential(&p, depth, b)) / 0.04;
                    let given = -f64::from(m.dot(axis.cross(n)));
                    assert!((slope - given).abs() < 2e-3, "{shape:?} at {depth}: {slope} against {given}");
                }
            }
        }
    }

    #[test]
    fn shares_run_from_zero_to_one_and_are_half_at_the_centre() {
        for shape in SHAPES {
            let p = point(shape);
            for n in [Vec3::X, Vec3::Y, Vec3::new(0.6, 0.8, 0.0)] {
                assert_eq!(p.immersion(-2.0, n).share, 0.0);
                assert!((p.immersion(0.0, n).share - 0.5).abs() < 1e-6);
                assert_eq!(p.immersion(2.0, n).share, 1.0);
            }
        }
    }
}

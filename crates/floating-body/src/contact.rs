//! Contact of a hull with what is solid, the bed and quays, as the water tells it ([`WaterSurface::touch`]): what may be
//! set, where a hull touches, and how much it yields.
//!
//! A hull touches with a few of its points, so that a pole thinner than their distance goes unnoticed; there is no
//! contact between bodies. A physics engine has its own: contact acts in [`Body::step`](crate::Body::step) only.
//!
//! [`WaterSurface::touch`]: crate::WaterSurface::touch

use glam::{Mat3, Vec3};

use crate::error::check_range;
use crate::hull::{Hull, HullKind};
use crate::{BodyError, GRAVITY, Touch};

/// How a body meets the bed and quays.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact {
    /// How far its own weight presses it in, m, 0.0001 to 10. Less is harder.
    pub sink: f32,
    /// Coulomb's coefficient of friction, 0 to 10.
    pub friction: f32,
    /// Share of the speed of an impact with which it leaves again, 0 to 1.
    pub restitution: f32,
}

impl Default for Contact {
    /// Firm ground: a centimetre, 0.5, 0.2.
    fn default() -> Self {
        Self { sink: 0.01, friction: 0.5, restitution: 0.2 }
    }
}

impl Contact {
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        check_range("contact.sink", self.sink, 1.0e-4, 10.0, "in [0.0001, 10] m")?;
        check_range("contact.friction", self.friction, 0.0, 10.0, "in [0, 10]")?;
        check_range("contact.restitution", self.restitution, 0.0, 1.0, "in [0, 1]").map(drop)
    }

    /// The spring of one contact over a sub-step of `dt` s, at `depth` m (negative apart).
    ///
    /// Each contact is a critically damped spring of frequency `sqrt(g / sink)` on the mass it feels, integrated
    /// implicitly (Catto, "Soft constraints", GDC 2011): stable and without gain of energy for every `dt`. Apart, the
    /// speed is limited to what closes the gap and sinks in. `fastest` bounds the speed at which what is buried comes out.
    pub(crate) fn spring(&self, depth: f32, dt: f32, fastest: f32) -> Spring {
        if depth <= 0.0 {
            return Spring { bias: (self.sink - depth) / dt, mass: 1.0, ease: 0.0 };
        }
        let omega = (GRAVITY / self.sink).sqrt();
        let damped = 2.0 + dt * omega;
        let stiff = dt * omega * damped;
        Spring { bias: -(omega / damped * depth).min(fastest), mass: stiff / (1.0 + stiff), ease: 1.0 / (1.0 + stiff) }
    }
}

/// A soft constraint: the impulse is `-m mass (v + bias) - ease (impulse so far)` for a speed `v` out of the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring {
    pub(crate) bias: f32,
    pub(crate) mass: f32,
    pub(crate) ease: f32,
}

/// A place of the hull that may touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feeler {
    /// From the centre of mass, hull axes, m.
    center: Vec3,
    shape: Shape,
}

/// What is around a feeler's centre; directions are the world's in which solids are looked for.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Corner,
    /// Of a cylinder's end: only while it stands, since a rolling one is round.
    End,
    Ball {
        radius: f32,
        toward: Vec3,
    },
    /// The rim of a disc across the hull's x axis.
    Rim {
        radius: f32,
        toward: Vec3,
    },
}

/// Round shapes ask in a few directions, and are touched by what faces the one asked in.
const FACING: f32 = 0.55;
/// Cosine of the angle between a cylinder's axis and the ground's normal up to which it stands.
const STANDING: f32 = 0.5;

impl Feeler {
    /// From the centre of mass, world axes: where solids are asked for.
    pub(crate) fn asks(&self, rotation: Mat3) -> Vec3 {
        let center = rotation * self.center;
        match self.shape {
            Shape::Corner | Shape::End => center,
            Shape::Ball { radius, toward } => center + toward * radius,
            Shape::Rim { radius, toward } => center + across(toward, rotation.x_axis) * radius,
        }
    }

    /// From the centre of mass, world axes: the point deepest in a plane with this normal. `None` where another feeler
    /// is nearer to it.
    pub(crate) fn deepest(&self, rotation: Mat3, normal: Vec3) -> Option<Vec3> {
        let center = rotation * self.center;
        let (radius, asked, out) = match self.shape {
            Shape::Corner => return Some(center),
            Shape::End => return (rotation.x_axis.dot(normal).abs() > STANDING).then_some(center),
            Shape::Ball { radius, toward } => (radius, toward, normal),
            Shape::Rim { radius, toward } => {
                let axis = rotation.x_axis;
                (radius, across(toward, axis), across(normal, axis))
            }
        };
        (asked.dot(out) < -FACING).then_some(center - out * radius)
    }
}

/// The direction nearest to `v` across an axis; none along it.
fn across(v: Vec3, axis: Vec3) -> Vec3 {
    let side = v - axis * v.dot(axis);
    if side.length_squared() > 1.0e-6 { side.normalize() } else { Vec3::ZERO }
}

/// An answer made harmless.
pub(crate) fn sane(touch: Touch) -> Touch {
    let normal = touch.normal.normalize_or_zero();
    if !(touch.depth > -1.0e4 && touch.depth.is_finite() && normal.is_finite() && normal != Vec3::ZERO) {
        return Touch::NONE;
    }
    Touch { depth: touch.depth.min(1.0e4), normal }
}

const SIDES: [Vec3; 4] = [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z];

/// Where a hull touches: a box with its corners, a ball and a cylinder with their surface, a mesh with what lies farthest
/// out in 26 directions. Relative to the centre of mass.
pub(crate) fn feelers(hull: &Hull, center_of_mass: Vec3) -> Vec<Feeler> {
    let mut found: Vec<Feeler> = Vec::new();
    let mut add = |at: Vec3, shape| found.push(Feeler { center: at - center_of_mass, shape });
    match hull.kind() {
        HullKind::Cuboid { half } => {
            for signs in directions().filter(|d| d.abs() == Vec3::ONE) {
                add(half * signs, Shape::Corner);
            }
        }
        HullKind::Sphere { radius } => {
            for toward in SIDES.into_iter().chain([Vec3::NEG_Y, Vec3::Y]) {
                add(Vec3::ZERO, Shape::Ball { radius, toward });
            }
        }
        HullKind::Cylinder { radius, length } => {
            for end in [Vec3::X * (-0.5 * length), Vec3::X * (0.5 * length)] {
                for toward in SIDES.into_iter().chain([Vec3::NEG_Y]) {
                    add(end, Shape::Rim { radius, toward });
                }
                // What it stands on.
                for (y, z) in [(1.0, 0.0), (0.5, 0.75_f32.sqrt()), (-0.5, 0.75_f32.sqrt())] {
                    add(end + Vec3::new(0.0, y, z) * radius, Shape::End);
                    add(end - Vec3::new(0.0, y, z) * radius, Shape::End);
                }
            }
        }
        HullKind::Mesh(mesh) => {
            let (low, high) = hull.bounds();
            let scale = (high - low).max(Vec3::splat(1.0e-6)).recip();
            let mut corners: Vec<Vec3> = Vec::new();
            for direction in directions() {
                let far = |v: &Vec3| direction.dot(*v * scale);
                let corner = mesh.vertices.iter().copied().max_by(|a, b| far(a).total_cmp(&far(b)));
                corners.extend(corner.filter(|c| !corners.contains(c)));
            }
            corners.into_iter().for_each(|corner| add(corner, Shape::Corner));
        }
    }
    found
}

/// To the corners, edges and faces of a cube.
fn directions() -> impl Iterator<Item = Vec3> {
    let steps = [-1.0_f32, 0.0, 1.0];
    let all =
        steps.into_iter().flat_map(move |x| steps.into_iter().flat_map(move |y| steps.map(|z| Vec3::new(x, y, z))));
    all.filter(|d| *d != Vec3::ZERO)
}

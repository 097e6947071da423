//! Water friction and form drag: coefficients from the hull's dimensions, and their implicit integration.

use glam::Vec3;

use crate::hull::Waterline;

/// Resistance against the water, along and about the hull's axes. Acts in proportion to the immersed volume.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drag {
    /// Linear resistance in N s/m: surge (x), heave (y), sway (z).
    pub linear: Vec3,
    /// Quadratic resistance `rho Cd A / 2` in kg/m along each axis.
    pub quadratic: Vec3,
    /// How much of the speed across an axis feeds its quadratic resistance, 0 to 1. With 1 in sway a hull under way
    /// resists sideways motion in proportion to its speed: this is what a keel does.
    pub cross_flow: Vec3,
    /// Linear resistance to rotation in N m s: roll (x), yaw (y), pitch (z).
    pub angular_linear: Vec3,
    /// Quadratic resistance to rotation in N m s^2.
    pub angular_quadratic: Vec3,
    /// Resistance to rotation per speed through the water in N s^2.
    pub angular_forward: Vec3,
    /// Where sideways resistance attacks, hull frame, m. Aft of the centre of mass the hull keeps its course.
    pub lateral_center: Vec3,
}

/// Drag coefficients of a bluff body, from memory of Hoerner's tables: cube face, plate, sphere.
const BLUFF: f32 = 1.0;
const PLATE: f32 = 1.1;
const SPHERE: f32 = 0.47;
/// A pointed hull along its axis.
const POINTED: f32 = 0.15;
/// Share of cross flow in heave and the tilting modes of a long hull: its bottom follows the surface it runs along.
const PLANING: f32 = 0.1;

impl Drag {
    /// From the immersed areas at rest. `round` is a ball, `blunt` any closed shape.
    pub(crate) fn estimate(w: &Waterline, mass: f32, density: f32, round: bool, blunt: bool) -> Self {
        let q = 0.5 * density;
        let (length, beam, draft) = (w.extent.x, w.extent.y, w.draft);
        let plan = length * beam * if round { std::f32::consts::FRAC_PI_4 } else { 1.0 };
        let (along, across, plate) = match (round, blunt) {
            (true, _) => (SPHERE, SPHERE, SPHERE),
            (_, true) => (BLUFF, BLUFF, PLATE),
            _ => (POINTED, BLUFF, PLATE),
        };
        let cross = if blunt { 1.0 } else { PLANING };
        let cubes = |width: f32, span: f32| width * span.powi(4) / 32.0;
        let squares = |width: f32, span: f32| width * span.powi(3) / 12.0;
        let skin = if round { 0.05 } else { 1.0 };
        Self {
            linear: Vec3::new(0.02, 0.05, 0.05) * mass,
            quadratic: Vec3::new(along * w.profile.x, plate * plan, across * w.profile.y) * q,
            cross_flow: Vec3::new(1.0, cross, 1.0),
            angular_linear: Vec3::splat(0.1 * mass * (length * length + beam * beam) / 12.0),
            angular_quadratic: Vec3::new(
                cubes(length, beam),
                cubes(draft, length) + cubes(draft, beam),
                cubes(beam, length),
            ) * (q * skin),
            angular_forward: Vec3::new(
                PLANING * squares(length, beam),
                squares(draft, length),
                PLANING * squares(beam, length),
            ) * (q * skin),
            lateral_center: Vec3::new(w.lateral_center, w.center_of_buoyancy.y, w.center_of_buoyancy.z),
        }
    }

    /// Quadratic resistance over the speed it acts against (N s/m) along the axes, for the velocity `rel` through the
    /// water (hull axes).
    pub(crate) fn quadratic_rates(&self, rel: Vec3) -> Vec3 {
        let all = rel.length_squared();
        let speed = |own: f32, cross: f32| (own * own + cross * cross * (all - own * own).max(0.0)).sqrt();
        let speeds = Vec3::new(
            speed(rel.x, self.cross_flow.x),
            speed(rel.y, self.cross_flow.y),
            speed(rel.z, self.cross_flow.z),
        );
        self.quadratic * speeds
    }
}

/// One implicit step of `m v' = -(linear + quadratic |v|) v`, where `rate` is `quadratic |v|` at the start: the backward
/// Euler step in closed form, which never overshoots, however stiff, and ends at the terminal speed.
pub(crate) fn implicit(v: Vec3, linear: Vec3, rate: Vec3, mass: Vec3, dt: f32) -> Vec3 {
    let whole = Vec3::ONE + linear / mass * dt;
    let root = whole * whole + rate / mass * (4.0 * dt);
    v * 2.0 / (whole + Vec3::new(root.x.sqrt(), root.y.sqrt(), root.z.sqrt()))
}

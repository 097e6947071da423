//! The fast cut by a plane, for those who integrate bodies themselves.

use fearless_simd::Level;
use glam::{Quat, Vec2, Vec3};

use super::lanes::{Fade, Plane, push};
use super::panels::Panels;
use crate::rotation::matrix;
use crate::{Hull, SurfacePatch};

/// What water does to a hull, over its specific weight `rho g`, world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Integral of the pressure head along the inward normal, m^3.
    pub force: Vec3,
    /// Its torque about the hull's origin, m^4.
    pub torque: Vec3,
    /// Displaced volume in m^3.
    pub volume: f32,
}

/// A hull made ready to be clipped by planes, eight triangles side by side: what a body with
/// [`Quality::Clipped`](crate::Quality::Clipped) sums in each sub-step. Bits are the same on every machine.
#[derive(Clone, Debug)]
pub struct Clipper {
    level: Level,
    panels: Panels,
    triangles: usize,
}

impl Clipper {
    /// Makes a hull ready; balls and cylinders as polyhedra of the same volume.
    pub fn new(hull: &Hull) -> Self {
        let skin = hull.skin(f32::INFINITY);
        let triangles = skin.indices.len() / 3;
        Self { level: Level::new(), panels: Panels::new(&skin, Vec3::ZERO, &[]), triangles }
    }

    /// Triangles of the hull.
    pub fn triangles(&self) -> usize {
        self.triangles
    }

    /// The push on the hull with its origin at `position` (m) and `orientation` (unit) under the plane `water`, whose
    /// heights are those at (x, z) `at`; its own grid's waves count. Under a wave pressure fades as linear theory has it.
    /// Allocates nothing.
    pub fn push(&self, position: Vec3, orientation: Quat, water: &SurfacePatch, at: Vec2) -> Push {
        let rotation = matrix(orientation);
        let to_hull = rotation.transpose();
        let slope = water.gradient + water.own_gradient;
        let away = Vec2::new(position.x, position.z) - at;
        let depth = water.height + water.own + slope.dot(away) - position.y;
        let plane = Plane { depth, slope: to_hull * Vec3::new(-slope.x, 1.0, -slope.y) };
        let up = to_hull * Vec3::Y;
        let still = Plane { depth: water.level - position.y, slope: up };
        let fade = Fade { wavenumber: water.decay_wavenumber, still };
        let fade = (water.decay_wavenumber > 0.0).then_some(fade);
        let sums = push(self.level, &self.panels, &[plane], fade, &mut Vec::new());
        Push { force: rotation * sums.force, torque: rotation * sums.torque, volume: sums.lift.dot(up).max(0.0) }
    }
}

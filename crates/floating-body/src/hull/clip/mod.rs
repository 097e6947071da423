//! The hull cut by the water surface, triangle by triangle against the wave's height at their corners.
//!
//! [`Hull::clip`] is the exact cut in f64 with everything one may ask of it. What a body feels in every sub-step is
//! summed by `panels` (f32, eight triangles side by side), for balls and cylinders on a plane by `closed`.
//! Pressure is hydrostatic below the surface; how it fades under a wave is the caller's.

mod clipper;
pub(crate) mod closed;
mod exact;
pub(crate) mod lanes;
pub(crate) mod panels;
pub(crate) mod tessellate;
#[cfg(test)]
mod tests;

use glam::{DMat3, DVec3, Quat, Vec2, Vec3};

pub use self::clipper::{Clipper, Push};
use super::{Hull, Made};
use crate::TriMesh;
use crate::rotation::matrix;

/// What is under water of a hull, world frame.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Clip {
    /// Displaced volume in m^3.
    pub volume: f32,
    /// Centre of buoyancy in m; the hull's origin if it displaces nothing.
    pub center: Vec3,
    /// Closed lines in which the surface cuts the hull, m; counter-clockwise seen from above around what is hull.
    pub waterline: Vec<Vec<Vec3>>,
    /// Area that they enclose seen from above, m^2.
    pub waterplane: f32,
    /// Wetted area of the hull in m^2.
    pub wetted: f32,
    /// Hydrostatic force over the water's specific weight `rho g`, m^3: the integral of depth along the inward normal.
    pub force: Vec3,
    /// Its torque about the hull's origin over `rho g`, m^4.
    pub torque: Vec3,
}

impl Hull {
    /// The hull at `position` (of its origin, m) and `orientation` (unit) cut by the surface whose height in m at a
    /// point (x, z) is `height`, which is asked once per vertex; between vertices the surface is taken as straight.
    ///
    /// Exact for planes and polyhedra. Balls and cylinders are cut as polyhedra of the same volume (some 1,000
    /// triangles: centres within 0.5 % of their size).
    pub fn clip(&self, position: Vec3, orientation: Quat, height: impl FnMut(Vec2) -> f32) -> Clip {
        match &self.0.made {
            Made::Mesh(mesh) => cut(mesh, position, orientation, height),
            Made::Shape(shape) => cut(&tessellate::shape(shape), position, orientation, height),
        }
    }

    /// The surface that is clipped: the mesh, or one that stands for a closed shape, with edges of `longest` m at most.
    pub(crate) fn skin(&self, longest: f32) -> TriMesh {
        let mesh = match &self.0.made {
            Made::Mesh(mesh) => mesh.clone(),
            Made::Shape(shape) => tessellate::shape(shape),
        };
        tessellate::split(mesh, longest)
    }
}

/// As [`Hull::clip`], of a closed outward mesh.
pub(crate) fn cut(mesh: &TriMesh, position: Vec3, orientation: Quat, mut height: impl FnMut(Vec2) -> f32) -> Clip {
    let rotation: DMat3 = matrix(orientation).as_dmat3();
    let origin = position.as_dvec3();
    let vertices: Vec<DVec3> = mesh.vertices.iter().map(|v| rotation * v.as_dvec3()).collect();
    let depth = |v: &DVec3| {
        let at = origin + *v;
        let depth = f64::from(height(Vec2::new(at.x as f32, at.z as f32))) - at.y;
        if depth.is_finite() { depth } else { -1.0 }
    };
    let depths: Vec<f64> = vertices.iter().map(depth).collect();
    exact::clip(&mesh.indices, &vertices, &depths, origin)
}

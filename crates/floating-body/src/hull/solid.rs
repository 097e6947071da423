//! Volume, centroid and inertia of a closed surface, in f64 by signed tetrahedra.

use glam::{DMat3, DVec3};

use super::topology::Surface;
use crate::BodyError;

/// Integrals over a solid of density 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Solid {
    /// m^3.
    pub(crate) volume: f64,
    /// m.
    pub(crate) centroid: DVec3,
    /// Inertia about the centroid per unit of mass, m^2.
    pub(crate) unit_inertia: DMat3,
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Solid {
    /// Exact sums over the tetrahedra between a reference point and each triangle
    /// (Tonon 2004, "Explicit exact formulas for the 3-D tetrahedron inertia tensor").
    pub(crate) fn of(surface: &Surface) -> Result<Self, BodyError> {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for v in &surface.vertices {
            (low, high) = (low.min(*v), high.max(*v));
        }
        let reference = (low + high) * 0.5;
        let (mut volume, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
        for t in &surface.triangles {
            let [a, b, c] = t.map(|i| surface.vertices[i as usize] - reference);
            let det = a.dot(b.cross(c));
            let sum = a + b + c;
            volume += det / 6.0;
            first += sum * (det / 24.0);
            // Integral of r r^T over the tetrahedron (0, a, b, c).
            second += (outer(sum) + outer(a) + outer(b) + outer(c)) * (det / 120.0);
        }
        let extent = high - low;
        let box_volume = extent.x * extent.y * extent.z;
        if volume.is_nan() || volume < 1.0e-9 || volume < 1.0e-7 * box_volume {
            return Err(BodyError::NoVolume { volume });
        }
        let mean = first / volume;
        let covariance = second * (1.0 / volume) - outer(mean);
        let trace = covariance.x_axis.x + covariance.y_axis.y + covariance.z_axis.z;
        let unit_inertia = DMat3::from_diagonal(DVec3::splat(trace)) - covariance;
        Ok(Self { volume, centroid: reference + mean, unit_inertia, low, high })
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

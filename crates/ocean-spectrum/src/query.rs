//! The sea at given points: the horizontal displacement is inverted, then height, normal and motion are read.
//!
//! One point's answer does not depend on the others asked for with it.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::Ocean;
use crate::layers::{Layers, State};

/// Where the surface does not fold, some particle is nearer than this, metres.
const LARGEST_RESIDUAL: f32 = 1e-3;
/// Farthest position that is answered, metres: f32 cannot tell places apart long before.
const FARTHEST: f32 = 1e8;
/// Points that one task answers.
const BATCH: usize = 256;

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
    /// Whether the surface folds over itself there, so that the answer is one of several or none fits.
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

fn sample(layers: Layers<'_>, point: Vec2) -> OceanSample {
    if !is_place(point) {
        return OceanSample::default();
    }
    let found = layers.find(point);
    let State { displacement, gradient, velocity } = layers.state_found(&found);
    let slope = gradient.world_slope();
    OceanSample {
        height: displacement[1],
        normal: Vec3::new(-slope.x, 1.0, -slope.y).normalize(),
        velocity: Vec3::new(velocity[0], velocity[1], velocity[2]),
        vertical_acceleration: velocity[3],
        rest: found.rest,
        residual: found.residual,
        folded: gradient.jacobian() <= 0.0 || gradient.d[2] <= -1.0 || found.residual > LARGEST_RESIDUAL,
    }
}

/// Whether there is an answer at a position.
pub(crate) fn is_place(point: Vec2) -> bool {
    point.abs().cmple(Vec2::splat(FARTHEST)).all()
}

impl Ocean {
    /// The sea at local positions (x, z), metres, at the time set, on rayon's threads; as many answers as the shorter
    /// slice holds. Calm water where a position is not finite or farther than 10^8 m.
    pub fn sample(&self, points: &[Vec2], out: &mut [OceanSample]) {
        let layers = self.layers();
        let answer = |points: &[Vec2], out: &mut [OceanSample]| {
            for (&point, out) in points.iter().zip(out) {
                *out = sample(layers, point);
            }
        };
        if points.len() <= BATCH {
            answer(points, out);
        } else {
            points.par_chunks(BATCH).zip(out.par_chunks_mut(BATCH)).for_each(|(points, out)| answer(points, out));
        }
    }

    /// Height at a local position, metres; see [`Ocean::sample`].
    pub fn height(&self, point: Vec2) -> f32 {
        let mut out = [OceanSample::default()];
        self.sample(&[point], &mut out);
        out[0].height
    }
}

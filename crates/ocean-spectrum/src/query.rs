//! The sea at given points: the horizontal displacement is inverted, then height, normal and motion are read.
//!
//! One point's answer does not depend on the others asked for with it.

use glam::{Vec2, Vec3};
use open_water_shaders::surface::{
    CHOP_FIXED_ROUNDS, CHOP_LEAST_SLOPE, CHOP_LEAST_STEP, CHOP_NEWTON_ROUNDS, CHOP_TOLERANCE,
};
use rayon::prelude::*;

use crate::kernel::Taps;
use crate::patch::Band;
use crate::synthesis::Synthesis;
use crate::{CascadeModes, Ocean};

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

/// A cascade as a query reads it.
pub(crate) struct Layer {
    /// Local origin within the tile, metres.
    pub(crate) offset: Vec2,
    texels_per_metre: f32,
    size: usize,
    pub(crate) band: Band,
    pub(crate) fields: Synthesis,
}

impl Layer {
    pub(crate) fn new(modes: &CascadeModes, fields: Synthesis) -> Self {
        Self {
            offset: Vec2::ZERO,
            texels_per_metre: modes.size as f32 / modes.tile,
            size: modes.size as usize,
            band: Band::of(modes),
            fields,
        }
    }

    #[inline]
    pub(crate) fn taps(&self, rest: Vec2) -> Taps {
        Taps::new((rest + self.offset) * self.texels_per_metre, self.size)
    }
}

fn add(sum: &mut [f32; 4], term: [f32; 4]) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += term;
    }
}

/// Where the water at a point comes from.
pub(crate) struct Found {
    pub(crate) rest: Vec2,
    pub(crate) residual: f32,
    displacement: [f32; 4],
}

#[inline]
fn sum(layers: &[Layer], rest: Vec2, texels: impl Fn(&Synthesis) -> &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for layer in layers {
        add(&mut sum, layer.taps(rest).read(texels(&layer.fields)));
    }
    sum
}

/// Inverts the horizontal displacement: finds `rest` with `rest + D(rest) = point`.
pub(crate) fn find(layers: &[Layer], point: Vec2) -> Found {
    let mut rest = point;
    let mut best = Found { rest, residual: f32::INFINITY, displacement: [0.0; 4] };
    for round in 0..=CHOP_FIXED_ROUNDS + CHOP_NEWTON_ROUNDS {
        let displacement = sum(layers, rest, Synthesis::displacement);
        let miss = point - rest - Vec2::new(displacement[0], displacement[2]);
        let residual = miss.length();
        if residual < best.residual {
            best = Found { rest, residual, displacement };
        }
        if residual < CHOP_TOLERANCE {
            break;
        }
        rest += if round < CHOP_FIXED_ROUNDS { miss } else { newton_step(layers, rest, displacement[3], miss) };
    }
    best
}

fn newton_step(layers: &[Layer], rest: Vec2, cross: f32, miss: Vec2) -> Vec2 {
    let d = sum(layers, rest, Synthesis::derivative);
    let (a, b) = (1.0 + d[2], 1.0 + d[3]);
    // Near a fold the step would be arbitrarily long.
    let jacobian = (a * b - cross * cross).max(CHOP_LEAST_STEP);
    let step = Vec2::new(b * miss.x - cross * miss.y, a * miss.y - cross * miss.x) / jacobian;
    step.clamp_length_max(4.0 * miss.length())
}

fn sample(layers: &[Layer], point: Vec2) -> OceanSample {
    if !is_place(point) {
        return OceanSample::default();
    }
    let found = find(layers, point);
    let (mut d, mut v) = ([0.0; 4], [0.0; 4]);
    for layer in layers {
        let taps = layer.taps(found.rest);
        add(&mut d, taps.read(layer.fields.derivative()));
        add(&mut v, taps.read(layer.fields.velocity()));
    }
    let [_, height, _, cross] = found.displacement;
    let slope = world_slope(d, cross);
    let jacobian = (1.0 + d[2]) * (1.0 + d[3]) - cross * cross;
    OceanSample {
        height,
        normal: Vec3::new(-slope.x, 1.0, -slope.y).normalize(),
        velocity: Vec3::new(v[0], v[1], v[2]),
        vertical_acceleration: v[3],
        rest: found.rest,
        residual: found.residual,
        folded: jacobian <= 0.0 || d[2] <= -1.0 || found.residual > LARGEST_RESIDUAL,
    }
}

/// Whether there is an answer at a position.
pub(crate) fn is_place(point: Vec2) -> bool {
    point.abs().cmple(Vec2::splat(FARTHEST)).all()
}

/// Slope in world coordinates from `(dh/dx, dh/dz, dDx/dx, dDz/dz)` and `dDx/dz`, all by rest coordinates.
pub(crate) fn world_slope(d: [f32; 4], cross: f32) -> Vec2 {
    let (a, b) = (1.0 + d[2], 1.0 + d[3]);
    let jacobian = (a * b - cross * cross).max(CHOP_LEAST_SLOPE);
    Vec2::new(b * d[0] - cross * d[1], a * d[1] - cross * d[0]) / jacobian
}

impl Ocean {
    /// The sea at local positions (x, z), metres, at the time set, on rayon's threads; as many answers as the shorter
    /// slice holds. Calm water where a position is not finite or farther than 10^8 m.
    pub fn sample(&self, points: &[Vec2], out: &mut [OceanSample]) {
        let answer = |points: &[Vec2], out: &mut [OceanSample]| {
            for (&point, out) in points.iter().zip(out) {
                *out = sample(&self.layers, point);
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

//! The sea at given points: the horizontal displacement is inverted, then height, normal and motion are read.
//!
//! One point's answer does not depend on the others asked for with it.

#[cfg(test)]
mod agreement;
pub(crate) mod amplitude;
pub(crate) mod direct;
pub(crate) mod invert;
pub(crate) mod kernel;
pub(crate) mod largest;
pub(crate) mod layers;
pub(crate) mod patch;

use fearless_simd::{Level, Simd, dispatch, f32x8, prelude::*};
use glam::{Vec2, Vec3};
use open_water_shaders::surface::CHOP_LEAST_SLOPE;
use rayon::prelude::*;

use crate::query::invert::{Field, GROUPS, Group, Motion, Pair, invert};
use crate::query::kernel::{LANES, stored};
use crate::{Ocean, Outputs, Queries};

/// Where the surface does not fold, some particle is nearer than this, metres.
const LARGEST_RESIDUAL: f32 = 1e-3;
/// Points that one task answers.
const BATCH: usize = 512;

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
    /// Area of the surface, seen from above, for each unit of it at rest: the determinant of the gradient of world by
    /// rest positions. Below 1 at crests, not above 0 where the surface folds.
    pub jacobian: f32,
    /// How many times as long as at rest the surface is along its main axes, seen from above, least first: the
    /// eigenvalues of the gradient's symmetric part. The first is small, or negative, where crests break.
    pub stretch: [f32; 2],
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
            jacobian: 1.0,
            stretch: [1.0; 2],
        }
    }
}

impl<S: Simd> Motion<S> {
    /// Determinant of the rest-to-world gradient.
    #[inline(always)]
    fn jacobian(&self) -> f32x8<S> {
        let [_, _, xx, zz] = self.gradient;
        (xx + 1.0) * (zz + 1.0) - self.cross[0] * self.cross[1]
    }

    /// Slope in world coordinates.
    #[inline(always)]
    pub(crate) fn world_slope(&self, simd: S) -> Pair<S> {
        let [x, z, xx, zz] = self.gradient;
        let [p, q] = self.cross;
        let jacobian = self.jacobian().max(f32x8::splat(simd, CHOP_LEAST_SLOPE));
        [((zz + 1.0) * x - q * z) / jacobian, ((xx + 1.0) * z - p * x) / jacobian]
    }

    /// How far the place found misses the point: as measured, or, after a last step, by the change of the gradient
    /// along it.
    #[inline(always)]
    fn residual(&self, group: &Group<S>) -> f32x8<S> {
        let [_, _, xx, zz] = self.gradient;
        let [a, p, q, b] = group.gradient;
        let [x, z] = group.step;
        let miss_x = (xx - a) * x + (self.cross[0] - p) * z;
        let miss_z = (self.cross[1] - q) * x + (zz - b) * z;
        let left = (miss_x * miss_x + miss_z * miss_z).sqrt() * 0.5;
        let stepped = (x * x + z * z).simd_gt(x * 0.0);
        stepped.select(left, group.missed)
    }

    /// Eigenvalues of the symmetric part of the rest-to-world gradient, least first.
    #[inline(always)]
    fn stretch(&self) -> Pair<S> {
        let [_, _, xx, zz] = self.gradient;
        let (mean, half) = ((xx + zz) * 0.5 + 1.0, (xx - zz) * 0.5);
        let cross = (self.cross[0] + self.cross[1]) * 0.5;
        let radius = (half * half + cross * cross).sqrt();
        [mean - radius, mean + radius]
    }
}

/// What is made of groups that have been inverted.
pub(crate) trait Answer: Copy + Sync {
    /// One point's answer.
    type Out: Send;

    /// The arrays that it reads.
    const READS: Outputs;

    /// The rough rounds before Newton's, as [`invert`] takes them; by default those of the GPU.
    const ROUGH: &'static [bool] = &[false, true];

    /// Tells a group what concerns its points beside their places; `first` is the index of the first of them.
    #[inline(always)]
    fn prepare<S: Simd>(&self, _simd: S, _first: usize, _group: &mut Group<S>) {}

    fn store<S: Simd, F: Field>(&self, simd: S, field: &F, spot: &F::Spot<S>, group: &Group<S>, out: &mut [Self::Out]);
}

/// Answers points, as many as the shorter slice holds, on rayon's threads.
fn run<F: Field, A: Answer>(level: Level, field: &F, how: A, points: &[Vec2], out: &mut [A::Out]) {
    let count = points.len().min(out.len());
    let (points, out) = (&points[..count], &mut out[..count]);
    let batches = points.par_chunks(BATCH).zip(out.par_chunks_mut(BATCH)).enumerate();
    let batch = |i: usize, points: &[Vec2], out: &mut [A::Out]| {
        dispatch!(level, simd => answer(simd, field, how, i * BATCH, points, out));
    };
    if points.len() <= BATCH {
        batch(0, points, out);
    } else {
        batches.for_each(|(i, (points, out))| batch(i, points, out));
    }
}

/// Answers points in their order. `first` is the index of the first.
#[inline(always)]
fn answer<S: Simd, F: Field, A: Answer>(simd: S, field: &F, how: A, first: usize, points: &[Vec2], out: &mut [A::Out]) {
    let size = GROUPS * LANES;
    let empty = Group::new(simd, &[]);
    for (i, (points, out)) in points.chunks(size).zip(out.chunks_mut(size)).enumerate() {
        let count = points.len().div_ceil(LANES);
        let mut groups = [(empty, field.spot(simd, &empty)); GROUPS];
        for (g, (points, (group, spot))) in points.chunks(LANES).zip(&mut groups).enumerate() {
            *group = Group::new(simd, points);
            how.prepare(simd, first + i * size + g * LANES, group);
            *spot = field.spot(simd, group);
        }
        let groups = &mut groups[..count];
        invert(simd, field, A::ROUGH, groups);
        for ((group, spot), out) in groups.iter().zip(out.chunks_mut(LANES)) {
            how.store(simd, field, spot, group, out);
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Heights;

impl Answer for Heights {
    type Out = f32;

    const READS: Outputs = Outputs { slopes: false, motion: false };

    #[inline(always)]
    fn store<S: Simd, F: Field>(&self, _simd: S, _field: &F, _spot: &F::Spot<S>, group: &Group<S>, out: &mut [f32]) {
        let heights = group.height.to_array();
        out.copy_from_slice(&heights[..out.len()]);
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Samples;

impl Answer for Samples {
    type Out = OceanSample;

    const READS: Outputs = Outputs::ALL;

    #[inline(always)]
    fn store<S: Simd, F: Field>(
        &self,
        simd: S,
        field: &F,
        spot: &F::Spot<S>,
        group: &Group<S>,
        out: &mut [OceanSample],
    ) {
        let motion = field.motion(simd, spot, group);
        let [x, z] = motion.world_slope(simd);
        let length = (x * x + z * z + 1.0).sqrt();
        let one = f32x8::splat(simd, 1.0);
        let normal = [(-x / length).to_array(), (one / length).to_array(), (-z / length).to_array()];
        let velocity = stored(motion.velocity);
        let (jacobian, residual) = (motion.jacobian(), motion.residual(group));
        let zero = f32x8::splat(simd, 0.0);
        let folded = jacobian.simd_le(zero)
            | motion.gradient[2].simd_le(zero - one)
            | residual.simd_gt(f32x8::splat(simd, LARGEST_RESIDUAL));
        let folded = folded.to_bitmask();
        let [least, most] = motion.stretch();
        let stretch = [least.to_array(), most.to_array()];
        let rest = group.rest(group.to_rest);
        let (height, residual, jacobian) = (group.height.to_array(), residual.to_array(), jacobian.to_array());
        for (l, out) in out.iter_mut().enumerate() {
            *out = if group.lanes >> l & 1 == 0 {
                OceanSample::default()
            } else {
                OceanSample {
                    height: height[l],
                    normal: Vec3::new(normal[0][l], normal[1][l], normal[2][l]),
                    velocity: Vec3::new(velocity[0][l], velocity[1][l], velocity[2][l]),
                    vertical_acceleration: velocity[3][l],
                    rest: Vec2::new(rest[0][l], rest[1][l]),
                    residual: residual[l],
                    folded: folded >> l & 1 == 1,
                    jacobian: jacobian[l],
                    stretch: [stretch[0][l], stretch[1][l]],
                }
            };
        }
    }
}

impl Ocean {
    /// Answers as the description says, from the arrays that the answers read of so many cascades, the longest.
    pub(crate) fn answer<A: Answer>(&self, level: Level, count: usize, how: A, points: &[Vec2], out: &mut [A::Out]) {
        match self.direct() {
            Some(direct) => run(level, &direct, how, points, out),
            None => run(level, &self.layers(count, A::READS), how, points, out),
        }
    }

    /// Heights at local positions (x, z), metres, at a time, seconds: [`Ocean::set_time`] and the height of
    /// [`Ocean::sample`]. Only the displacement is synthesised for it.
    pub fn heights(&mut self, points: &[Vec2], t: f64, out: &mut [f32]) {
        self.set_time(t);
        self.make(Outputs::default());
        self.answer(Level::new(), self.layers.len(), Heights, points, out);
    }

    /// [`Ocean::sample`] at a time, seconds: [`Ocean::set_time`] first.
    pub fn samples(&mut self, points: &[Vec2], t: f64, out: &mut [OceanSample]) {
        self.set_time(t);
        self.make(Outputs::ALL);
        self.sample(points, out);
    }

    /// Makes the arrays that queries read, if they do.
    fn make(&mut self, outputs: Outputs) {
        if self.desc().queries == Queries::Arrays {
            self.prepare(outputs);
        }
    }

    /// The sea at local positions (x, z), metres, at the time set, on rayon's threads; as many answers as the shorter
    /// slice holds. Calm water where a position is not finite or farther than 10^8 m.
    pub fn sample(&self, points: &[Vec2], out: &mut [OceanSample]) {
        self.answer(Level::new(), self.layers.len(), Samples, points, out);
    }

    /// Height at a local position, metres; see [`Ocean::sample`].
    pub fn height(&self, point: Vec2) -> f32 {
        let mut out = [0.0];
        self.answer(Level::new(), self.layers.len(), Heights, &[point], &mut out);
        out[0]
    }
}

//! The way back from a world point to the rest point whose water is seen there, for eight points side by side. The twin
//! of `rest_of` in `wgsl/shared/surface_at.wgsl`.
//!
//! Two rough rounds of `rest <- point - D(rest)` get near, the first with the longest cascade alone; then Newton's method
//! until its step is so short that it need not be checked. All this reads the displacement alone, whose gradient is the
//! kernel's own.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::Vec2;
use open_water_shaders::surface::{CHOP_LAST_STEP, CHOP_LEAST_STEP, CHOP_ROUNDS};

use crate::query::kernel::{LANES, Lanes};

/// Farthest position that is answered, metres: f32 cannot tell places apart long before.
const FARTHEST: f32 = 1e8;
/// Groups whose rounds run in turns, so that the processor has something to do while one waits.
pub(crate) const GROUPS: usize = 4;

/// A pair of coordinates or of slopes, (x, z).
pub(crate) type Pair<S> = [f32x8<S>; 2];
/// The fields of a texel.
pub(crate) type Four<S> = [f32x8<S>; 4];

/// The displacement `(Dx, h, Dz, dDx/dz)` and its slopes along x and z.
#[derive(Clone, Copy)]
pub(crate) struct Reading<S: Simd> {
    pub(crate) value: Four<S>,
    pub(crate) along_x: Four<S>,
    pub(crate) along_z: Four<S>,
}

/// What there is of the rest at a place found.
pub(crate) struct Motion<S: Simd> {
    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`.
    pub(crate) gradient: Four<S>,
    /// `(dDx/dz, dDz/dx)`: equal but for what a map's slopes add.
    pub(crate) cross: Pair<S>,
    /// `(dDx/dt, dh/dt, dDz/dt, d^2h/dt^2)`.
    pub(crate) velocity: Four<S>,
}

/// Eight points and the places in the sea where they lie.
#[derive(Clone, Copy)]
pub(crate) struct Group<S: Simd> {
    /// Local positions.
    pub(crate) point: Pair<S>,
    /// Lanes that are to be answered, a bit each.
    pub(crate) lanes: u32,
    /// From the points to the rest points, metres.
    pub(crate) to_rest: Pair<S>,
    pub(crate) height: f32x8<S>,
    /// `dDx/dz` there, but for what a map's slopes add.
    pub(crate) cross: f32x8<S>,
    /// How far the place last read missed the point, metres; the last step made up for most of that.
    pub(crate) missed: f32x8<S>,
    /// The last step, 0 where none was good enough.
    pub(crate) step: Pair<S>,
    /// `(dDx/dx, dDx/dz, dDz/dx, dDz/dz)` from where it was made.
    pub(crate) gradient: Four<S>,
    /// `(dh/dx, dh/dz)` at rest, from there too.
    pub(crate) slope: Pair<S>,
    /// A step of Newton's shorter than this, metres, is the last and need not be checked.
    pub(crate) last_step: f32x8<S>,
    /// Radii of the bodies there, if they are what is asked about.
    pub(crate) radius: Option<f32x8<S>>,
}

/// A sea that can be read at rest points.
pub(crate) trait Field: Sync {
    /// What a field keeps about a group's points.
    type Spot<S: Simd>: Copy;

    fn spot<S: Simd>(&self, simd: S, group: &Group<S>) -> Self::Spot<S>;

    /// The displacement `(Dx, h, Dz, dDx/dz)` at rest points, nearly: of all cascades or of the longest alone.
    fn rough<S: Simd>(&self, simd: S, spot: &Self::Spot<S>, group: &Group<S>, at: Pair<S>, all: bool) -> Four<S>;

    /// The displacement with its slopes, of these lanes alone.
    fn reading<S: Simd>(&self, simd: S, spot: &Self::Spot<S>, group: &Group<S>, at: Pair<S>, lanes: u32) -> Reading<S>;

    /// The rest, at the places found.
    fn motion<S: Simd>(&self, simd: S, spot: &Self::Spot<S>, group: &Group<S>) -> Motion<S>;

    /// Its velocity alone: that of [`Self::motion`].
    #[inline(always)]
    fn velocity<S: Simd>(&self, simd: S, spot: &Self::Spot<S>, group: &Group<S>) -> Four<S> {
        self.motion(simd, spot, group).velocity
    }

    /// Mean wavenumber of what the group's bodies feel, weighted by variance, rad/m.
    fn decay<S: Simd>(&self, simd: S, spot: &Self::Spot<S>, group: &Group<S>) -> f32x8<S>;
}

/// Whether there is an answer at a position.
pub(crate) fn is_place(point: Vec2) -> bool {
    point.abs().cmple(Vec2::splat(FARTHEST)).all()
}

impl<S: Simd> Group<S> {
    /// At most eight points.
    #[inline(always)]
    pub(crate) fn new(simd: S, points: &[Vec2]) -> Self {
        let zero = f32x8::splat(simd, 0.0);
        let (mut x, mut z, mut lanes) = ([0.0; LANES], [0.0; LANES], 0);
        for (lane, &point) in points.iter().take(LANES).enumerate() {
            if is_place(point) {
                (x[lane], z[lane]) = (point.x, point.y);
                lanes |= 1 << lane;
            }
        }
        let point = [f32x8::load_array(simd, x), f32x8::load_array(simd, z)];
        let (pair, four) = ([zero; 2], [zero; 4]);
        Self {
            point,
            lanes,
            to_rest: pair,
            height: zero,
            cross: zero,
            missed: zero,
            step: pair,
            gradient: four,
            slope: pair,
            last_step: f32x8::splat(simd, CHOP_LAST_STEP),
            radius: None,
        }
    }

    /// Rest points, local.
    #[inline(always)]
    pub(crate) fn rest(&self, at: Pair<S>) -> [Lanes; 2] {
        [(self.point[0] + at[0]).to_array(), (self.point[1] + at[1]).to_array()]
    }
}

/// A group on its way.
#[derive(Clone, Copy)]
struct Search<S: Simd> {
    at: Pair<S>,
    /// Lanes that still search.
    lanes: u32,
}

/// Finds the rest points of groups, in turns. `rough` says of each rough round whether it is with all cascades.
#[inline(always)]
pub(crate) fn invert<S: Simd, F: Field>(simd: S, field: &F, rough: &[bool], groups: &mut [(Group<S>, F::Spot<S>)]) {
    let zero = f32x8::splat(simd, 0.0);
    let mut searches = [Search { at: [zero; 2], lanes: 0 }; GROUPS];
    for &all in rough {
        for ((group, spot), search) in groups.iter().zip(&mut searches) {
            let [x, _, z, _] = field.rough(simd, spot, group, search.at, all);
            search.at = [zero - x, zero - z];
        }
    }
    for ((group, _), search) in groups.iter_mut().zip(&mut searches) {
        search.lanes = group.lanes;
        group.missed = f32x8::splat(simd, f32::INFINITY);
    }
    for _ in 0..CHOP_ROUNDS {
        let mut left = 0;
        for ((group, spot), search) in groups.iter_mut().zip(&mut searches) {
            if search.lanes != 0 {
                search.round(simd, field, spot, group);
                left |= search.lanes;
            }
        }
        if left == 0 {
            break;
        }
    }
}

impl<S: Simd> Search<S> {
    #[inline(always)]
    fn round<F: Field>(&mut self, simd: S, field: &F, spot: &F::Spot<S>, group: &mut Group<S>) {
        let Reading { value, along_x, along_z } = field.reading(simd, spot, group, self.at, self.lanes);
        let gradient = [along_x[0], along_z[0], along_x[2], along_z[2]];
        let [x, height, z, cross] = value;
        let zero = f32x8::splat(simd, 0.0);
        let miss = [zero - self.at[0] - x, zero - self.at[1] - z];
        let missed = (miss[0] * miss[0] + miss[1] * miss[1]).sqrt();
        let (step, length) = newton_step(simd, &gradient, miss, missed);

        let searching = simd.from_bitmask_mask32x8(self.lanes.into());
        let found = searching & length.simd_lt(group.last_step);
        let better = found | (searching & missed.simd_lt(group.missed));
        // The tangent planes tell what is at the end of the last step.
        let last = [found.select(step[0], zero), found.select(step[1], zero)];
        let there = [
            self.at[0] + last[0],
            self.at[1] + last[1],
            height + (along_x[1] * last[0] + along_z[1] * last[1]),
            cross + (along_x[3] * last[0] + along_z[3] * last[1]),
        ];
        group.to_rest = [better.select(there[0], group.to_rest[0]), better.select(there[1], group.to_rest[1])];
        group.height = better.select(there[2], group.height);
        group.cross = better.select(there[3], group.cross);
        group.missed = better.select(missed, group.missed);
        group.step = [better.select(last[0], group.step[0]), better.select(last[1], group.step[1])];
        group.slope = [better.select(along_x[1], group.slope[0]), better.select(along_z[1], group.slope[1])];
        for (held, new) in group.gradient.iter_mut().zip(&gradient) {
            *held = better.select(*new, *held);
        }
        self.at = [self.at[0] + step[0], self.at[1] + step[1]];
        self.lanes &= !(found.to_bitmask() as u32);
    }
}

/// The step at rest that moves the surface by `miss`, and its length.
#[inline(always)]
fn newton_step<S: Simd>(simd: S, &[a, p, q, b]: &Four<S>, miss: Pair<S>, missed: f32x8<S>) -> (Pair<S>, f32x8<S>) {
    let (a, b) = (a + 1.0, b + 1.0);
    // Near a fold the step would be arbitrarily long.
    let jacobian = (a * b - p * q).max(f32x8::splat(simd, CHOP_LEAST_STEP));
    let x = (b * miss[0] - p * miss[1]) / jacobian;
    let z = (a * miss[1] - q * miss[0]) / jacobian;
    let (length, most) = ((x * x + z * z).sqrt(), missed * 4.0);
    let long = length.simd_gt(most);
    let one = f32x8::splat(simd, 1.0);
    let scale = long.select(most, one) / long.select(length, one);
    ([x * scale, z * scale], length.min(most))
}

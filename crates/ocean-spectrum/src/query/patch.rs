//! The water under a small body, in one answer.

use fearless_simd::{Level, Simd, f32x8, prelude::*};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::query::Answer;
use crate::query::invert::{Field, Group, Motion};
use crate::query::kernel::{LANES, stored};
use crate::{CascadeModes, Ocean, Outputs};

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
    /// Wavenumber k with which the motion fades with depth as e^(-k d), rad/m; see [`Ocean::decay_wavenumber`].
    pub decay_wavenumber: f32,
}

/// A body of radius r feels less than 2 % of waves with a wavenumber k from `k r` on as long as this, and nothing of their
/// cascade is read for it.
const FELT: f32 = 3.74;

/// The last step on the way to the rest point as a share of the body's radius, and at most, metres: over that way the
/// surface is a plane as far as the body feels, whose mean over its area is rougher by far.
const LAST_STEP: f32 = 0.2;
const LONGEST_STEP: f32 = 0.3;

/// Means over the energy of one cascade.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Band {
    pub(crate) variance: f32,
    pub(crate) wavenumber: f32,
}

impl Band {
    /// Of one cascade given twice, or the mixed terms of two.
    pub(crate) fn of(modes: &CascadeModes, other: &CascadeModes) -> Self {
        let size = modes.size as usize;
        let (mut sum, mut weighted) = (f64::MIN_POSITIVE, 0.0);
        for (cell, (amp, other)) in modes.amp.iter().zip(&other.amp).enumerate() {
            let power = f64::from(amp[0] * other[0] + amp[1] * other[1]);
            let index = |i: usize| f64::from(modes.signed(i as u32));
            let (i, j) = (index(cell % size), index(cell / size));
            sum += power;
            weighted += power * modes.step() * (i * i + j * j).sqrt();
        }
        Self { variance: (2.0 * sum) as f32, wavenumber: (weighted / sum) as f32 }
    }

    /// Of a mix: the sum of such terms with their weights.
    pub(crate) fn sum(terms: impl Iterator<Item = (f32, Self)>) -> Self {
        let (sum, weighted) = terms.fold((f32::MIN_POSITIVE, 0.0), |(sum, weighted), (weight, band)| {
            let variance = weight * band.variance;
            (sum + variance, weighted + variance * band.wavenumber)
        });
        Self { variance: sum, wavenumber: weighted / sum }
    }

    /// Share of the waves that bodies of these radii feel.
    #[inline(always)]
    pub(crate) fn share<S: Simd>(&self, simd: S, radius: f32x8<S>) -> f32x8<S> {
        let x = radius * self.wavenumber;
        x.simd_lt(f32x8::splat(simd, FELT)).select(disc_mean(simd, x), f32x8::splat(simd, 0.0))
    }

    /// Whether that is more than nothing for bodies of this radius or larger.
    fn is_felt(&self, radius: f32) -> bool {
        radius * self.wavenumber < FELT
    }
}

/// Share of waves that is left in their mean over a disc: `2 J1(x)/x` at `x = k radius`, 0 from its first zero.
#[inline(always)]
pub(crate) fn disc_mean<S: Simd>(simd: S, x: f32x8<S>) -> f32x8<S> {
    // The power series, sum of (-q)^n/(n! (n+1)!) with q = x^2/4: cut here, it errs by less than 1e-7 up to the zero.
    let mut sum = f32x8::splat(simd, 0.0);
    let q = x * x * 0.25;
    for factor in SERIES {
        sum = sum * q + factor;
    }
    x.simd_lt(f32x8::splat(simd, 3.831_706)).select(sum, f32x8::splat(simd, 0.0))
}

/// `(-1)^n/(n! (n+1)!)` from n = 11 down.
const SERIES: [f32; 12] = {
    let mut series = [1.0f32; 12];
    let (mut n, mut term) = (0, 1.0f64);
    while n < 12 {
        series[11 - n] = term as f32;
        n += 1;
        term /= -((n * (n + 1)) as f64);
    }
    series
};

#[derive(Clone, Copy)]
pub(crate) struct Patches<'a> {
    pub(crate) radii: &'a [f32],
}

impl Answer for Patches<'_> {
    type Out = OceanPatch;

    const READS: Outputs = Outputs { slopes: false, motion: true };

    // The last step is a long one: Newton's method gets there from farther away.
    const ROUGH: &'static [bool] = &[false];

    #[inline(always)]
    fn prepare<S: Simd>(&self, simd: S, first: usize, group: &mut Group<S>) {
        let mut radius = [0.0; LANES];
        for (held, &given) in radius.iter_mut().zip(self.radii.iter().skip(first)) {
            *held = given.max(0.0);
        }
        let radius = f32x8::load_array(simd, radius);
        let long = (radius * LAST_STEP).min(f32x8::splat(simd, LONGEST_STEP));
        group.last_step = group.last_step.max(long);
        group.radius = Some(radius);
    }

    #[inline(always)]
    fn store<S: Simd, F: Field>(
        &self,
        simd: S,
        field: &F,
        spot: &F::Spot<S>,
        group: &Group<S>,
        out: &mut [OceanPatch],
    ) {
        // The gradient is that of the last reading: no array of its own need be made for it.
        let [xx, xz, zx, zz] = group.gradient;
        let [x, z] = group.slope;
        let velocity = field.velocity(simd, spot, group);
        let motion = Motion { gradient: [x, z, xx, zz], cross: [xz, zx], velocity };
        let [x, z] = motion.world_slope(simd);
        let gradient = [x.to_array(), z.to_array()];
        let velocity = stored(motion.velocity);
        let (height, decay) = (group.height.to_array(), field.decay(simd, spot, group).to_array());
        for (l, out) in out.iter_mut().enumerate() {
            *out = OceanPatch { decay_wavenumber: decay[l], ..Default::default() };
            if group.lanes >> l & 1 == 1 {
                out.height = height[l];
                out.gradient = Vec2::new(gradient[0][l], gradient[1][l]);
                out.velocity = Vec3::new(velocity[0][l], velocity[1][l], velocity[2][l]);
                out.vertical_acceleration = velocity[3][l];
            }
        }
    }
}

impl Ocean {
    /// The sea under bodies of the given radii (metres) at local positions, at the time set, on rayon's threads; as many
    /// answers as the shortest slice holds. It reads displacement and motion, not the slopes
    /// ([`Ocean::prepare`]).
    ///
    /// A body does not feel waves much shorter than itself, since their rise and fall cancels over its area: each
    /// cascade counts by the mean that is left over a disc of that radius at the cascade's mean wavenumber, and not at all
    /// where that is below 2 %. With radius 0 the answer is nearly that of [`Ocean::sample`]; the gradient is that
    /// of the kernel between the heights. Calm water where the position is not finite or farther than
    /// 10^8 m; a radius that is negative or not a number counts as 0.
    pub fn patches(&self, centers: &[Vec2], radii: &[f32], out: &mut [OceanPatch]) {
        let count = radii.len().min(centers.len()).min(out.len());
        let least = radii[..count].iter().fold(f32::INFINITY, |least, radius| least.min(*radius));
        self.answer(Level::new(), self.felt(least), Patches { radii }, &centers[..count], out);
    }

    /// Makes what [`Ocean::patches`] of bodies of this radius (metres) or larger reads at the time set, as
    /// [`Ocean::prepare`] does: less than for samples, the less the larger they are.
    pub fn prepare_patches(&mut self, radius: f32) {
        let felt = self.felt(radius);
        self.layers[..felt].par_iter_mut().for_each(|layer| layer.fields.prepare(Patches::READS));
    }

    /// How many cascades, the longest, bodies of this radius or larger feel.
    pub(crate) fn felt(&self, radius: f32) -> usize {
        let radius = radius.max(0.0);
        self.layers.iter().rposition(|layer| layer.band.is_felt(radius)).map_or(1, |last| last + 1)
    }

    /// The sea under one body; see [`Ocean::patches`].
    pub fn patch(&self, center: Vec2, radius: f32) -> OceanPatch {
        let mut out = [OceanPatch::default()];
        self.patches(&[center], &[radius], &mut out);
        out[0]
    }

    /// Mean wavenumber, weighted by variance, of the waves that a body of the given radius (metres) feels, rad/m: the
    /// pressure and motion of the sea fade about as e^(-k d) with depth d under it. That of the open sea, where no map
    /// weakens it.
    pub fn decay_wavenumber(&self, radius: f32) -> f32 {
        // Where there is no place, no map counts.
        self.patch(Vec2::NAN, radius).decay_wavenumber
    }
}

//! The sum of the cascades' arrays at rest points, each scaled by a map's factor there, for eight points side by side.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::{DVec2, Vec2};
use open_water_shaders::surface::MAX_CASCADES;

use crate::modes::set::ModeSet;
use crate::query::amplitude::Placed;
use crate::query::invert::{Field, Four, Group, Motion, Pair, Reading};
use crate::query::kernel::{Factor, LANES, Lanes, Spare, Sums, Taps, Texels, fields};
use crate::query::patch::Band;
use crate::synthesis::lazy::Synthesis;

/// What an ocean holds of a cascade.
#[derive(Clone)]
pub(crate) struct Layer {
    pub(crate) band: Band,
    pub(crate) fields: Synthesis,
}

impl Layer {
    pub(crate) fn new(set: &ModeSet, c: usize, fields: Synthesis) -> Self {
        Self { band: set.bands[c], fields }
    }
}

/// A cascade as queries read it.
#[derive(Clone, Copy, Default)]
pub(crate) struct View<'a> {
    /// Local origin within the tile, metres.
    pub(crate) offset: DVec2,
    pub(crate) texels_per_metre: f64,
    pub(crate) displacement: Texels<'a>,
    /// Empty where they are not read, as is `velocity`.
    pub(crate) derivative: Texels<'a>,
    pub(crate) velocity: Texels<'a>,
    pub(crate) band: Band,
}

/// All cascades, longest first, and what scales them.
pub(crate) struct Layers<'a> {
    pub(crate) count: usize,
    pub(crate) views: [View<'a>; MAX_CASCADES],
    pub(crate) map: Option<&'a Placed>,
}

/// What the layers keep of a group's points.
#[derive(Clone, Copy)]
pub(crate) struct Spot<S: Simd> {
    /// In texels, from the middle of each array.
    base: [Pair<S>; MAX_CASCADES],
    /// What a body at each point feels of each cascade.
    share: [f32x8<S>; MAX_CASCADES],
    /// The cascades that any of the points feels: so many, the longest.
    count: usize,
}

/// Factors on the cascades at the rest points of a group.
type Weights = [Lanes; MAX_CASCADES];

/// A position along one axis in texels, within half an array of 0: in f64, so that it is as exact far from the origin.
#[inline(always)]
fn wrapped<S: Simd>(simd: S, x: f32x8<S>, offset: f64, scale: f64, size: f64) -> f32x8<S> {
    // Adding and taking away 1.5 * 2^52 rounds to whole numbers.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    let (low, high) = simd.widen_f32x8(x);
    let (low, high) = ((low + offset) * (scale / size), (high + offset) * (scale / size));
    let (low, high) = (low - ((low + WHOLE) - WHOLE), high - ((high + WHOLE) - WHOLE));
    simd.narrow_f64x4(low * size, high * size)
}

/// The lanes whose bits are set.
#[inline(always)]
fn set(lanes: u32) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |lane| lanes >> lane & 1 == 1)
}

/// The weights of cascade `c`.
#[inline(always)]
// A closure would not be compiled for the vector units.
#[allow(clippy::manual_map)]
fn of<S: Simd>(simd: S, weights: &Option<Weights>, c: usize) -> Option<f32x8<S>> {
    match weights {
        Some(weights) => Some(f32x8::load_array(simd, weights[c])),
        None => None,
    }
}

impl Layers<'_> {
    fn used<S: Simd>(&self, spot: &Spot<S>) -> &[View<'_>] {
        &self.views[..spot.count]
    }

    /// The factors of the map and of the bodies at a place, if there are any.
    #[inline(always)]
    fn weights<S: Simd>(&self, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, lanes: u32) -> Option<Weights> {
        if self.map.is_none() && group.radius.is_none() {
            return None;
        }
        let mut weights = [[1.0; LANES]; MAX_CASCADES];
        for (weights, share) in weights.iter_mut().zip(&spot.share) {
            *weights = share.to_array();
        }
        if let Some(map) = self.map {
            let [x, z] = group.rest(at);
            for lane in set(lanes) {
                let values = map.values(Vec2::new(x[lane], z[lane]));
                for (weight, value) in weights.iter_mut().zip(values) {
                    weight[lane] *= value;
                }
            }
        }
        Some(weights)
    }

    /// The slopes of the map's factors at a place, along x and z, times what the bodies feel.
    #[inline(always)]
    fn weight_slopes<S: Simd>(&self, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, lanes: u32) -> [Weights; 2] {
        let mut slopes = [[[0.0; LANES]; MAX_CASCADES]; 2];
        if let Some(map) = self.map {
            let [x, z] = group.rest(at);
            for lane in set(lanes) {
                let factors = map.slopes(Vec2::new(x[lane], z[lane]));
                for (slopes, factors) in slopes.iter_mut().zip(factors) {
                    for ((slopes, slope), share) in slopes.iter_mut().zip(factors).zip(&spot.share) {
                        slopes[lane] = slope * share[lane];
                    }
                }
            }
        }
        slopes
    }

    /// Where a group lies in the array of cascade `c`.
    #[inline(always)]
    fn place<S: Simd>(&self, spot: &Spot<S>, c: usize, at: Pair<S>) -> Pair<S> {
        let scale = self.views[c].texels_per_metre as f32;
        [spot.base[c][0] + at[0] * scale, spot.base[c][1] + at[1] * scale]
    }
}

impl Field for Layers<'_> {
    type Spot<S: Simd> = Spot<S>;

    #[inline(always)]
    fn spot<S: Simd>(&self, simd: S, group: &Group<S>) -> Spot<S> {
        let zero = f32x8::splat(simd, 0.0);
        let share = [f32x8::splat(simd, 1.0); MAX_CASCADES];
        let mut spot = Spot { base: [[zero; 2]; MAX_CASCADES], share, count: self.count };
        if let Some(radius) = group.radius {
            spot.count = 1;
            for (c, layer) in self.views[..self.count].iter().enumerate() {
                spot.share[c] = layer.band.share(simd, radius);
                if spot.share[c].simd_gt(zero).any_true() {
                    spot.count = c + 1;
                }
            }
        }
        if group.lanes == 0 {
            return spot;
        }
        for (c, layer) in self.views[..spot.count].iter().enumerate() {
            let (offset, scale) = (layer.offset, layer.texels_per_metre);
            let size = layer.displacement.size as f64;
            let [x, z] = group.point;
            spot.base[c] = [wrapped(simd, x, offset.x, scale, size), wrapped(simd, z, offset.y, scale, size)];
        }
        spot
    }

    #[inline(always)]
    fn rough<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, all: bool) -> Four<S> {
        let lanes = group.lanes;
        let weights = self.weights(spot, group, at, lanes);
        let mut spare = Spare::default();
        let mut sums = [0.0; 4 * LANES];
        let count = if all { spot.count } else { 1 };
        for (c, layer) in self.views[..count].iter().enumerate() {
            let weight = of(simd, &weights, c);
            let taps = Taps::rough(simd, self.place(spot, c, at), layer.displacement.size, weight);
            for lane in set(lanes) {
                taps.add_rough(simd, lane, &layer.displacement, &mut spare, &mut sums);
            }
        }
        fields(simd, &sums)
    }

    #[inline(always)]
    fn reading<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, lanes: u32) -> Reading<S> {
        let weights = self.weights(spot, group, at, lanes);
        let mut spare = Spare::default();
        let slopes = self.map.map(|_| self.weight_slopes(spot, group, at, lanes));
        let mut sums = [[0.0; 4 * LANES]; 3];
        for (c, layer) in self.used(spot).iter().enumerate() {
            let mut factor = None;
            if let Some(value) = of(simd, &weights, c) {
                let mut slope = [f32x8::splat(simd, 0.0); 2];
                if let Some([x, z]) = &slopes {
                    slope = [f32x8::load_array(simd, x[c]), f32x8::load_array(simd, z[c])];
                }
                factor = Some(Factor { value, slope });
            }
            let scale = layer.texels_per_metre as f32;
            let (taps, slopes) =
                Taps::with_slopes(simd, self.place(spot, c, at), layer.displacement.size, factor, scale);
            for lane in set(lanes) {
                taps.add_all(simd, &slopes, lane, &layer.displacement, &mut spare, &mut sums);
            }
        }
        let [value, along_x, along_z] = sums;
        Reading { value: fields(simd, &value), along_x: fields(simd, &along_x), along_z: fields(simd, &along_z) }
    }

    #[inline(always)]
    fn motion<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>) -> Motion<S> {
        let (at, lanes) = (group.to_rest, group.lanes);
        let weights = self.weights(spot, group, at, lanes);
        let mut spare = Spare::default();
        let mut sums = [[0.0; 4 * LANES]; 2];
        for (c, layer) in self.used(spot).iter().enumerate() {
            let weight = of(simd, &weights, c);
            let taps = Taps::new(simd, self.place(spot, c, at), layer.displacement.size, weight);
            for lane in set(lanes) {
                taps.add(simd, lane, &layer.derivative, &mut spare, &mut sums[0]);
                taps.add(simd, lane, &layer.velocity, &mut spare, &mut sums[1]);
            }
        }
        let [derivative, velocity] = sums;
        let gradient = fields(simd, &derivative);
        let mut motion = Motion { gradient, cross: [group.cross; 2], velocity: fields(simd, &velocity) };
        if self.map.is_some() {
            self.tilt(simd, spot, group, &mut motion);
        }
        motion
    }

    #[inline(always)]
    fn velocity<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>) -> Four<S> {
        let (at, lanes) = (group.to_rest, group.lanes);
        let weights = self.weights(spot, group, at, lanes);
        let mut spare = Spare::default();
        let mut sums = [0.0; 4 * LANES];
        for (c, layer) in self.used(spot).iter().enumerate() {
            let taps = Taps::new(simd, self.place(spot, c, at), layer.displacement.size, of(simd, &weights, c));
            for lane in set(lanes) {
                taps.add(simd, lane, &layer.velocity, &mut spare, &mut sums);
            }
        }
        fields(simd, &sums)
    }

    #[inline(always)]
    fn decay<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>) -> f32x8<S> {
        let weights = self.weights(spot, group, group.to_rest, group.lanes);
        let zero = f32x8::splat(simd, 0.0);
        let (mut sum, mut weighted) = (f32x8::splat(simd, f32::MIN_POSITIVE), zero);
        for (c, layer) in self.used(spot).iter().enumerate() {
            let weight = of(simd, &weights, c).unwrap_or(spot.share[c]);
            let variance = weight * weight * layer.band.variance;
            sum += variance;
            weighted += variance * layer.band.wavenumber;
        }
        // A body that averages out every wave feels at least the longest.
        let longest = f32x8::splat(simd, self.views[0].band.wavenumber);
        weighted.simd_gt(zero).select(weighted / sum, longest)
    }
}

impl Layers<'_> {
    /// What the slopes of a map's factors add to the gradient.
    fn tilt<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>, motion: &mut Motion<S>) {
        let at = group.to_rest;
        let slopes = self.weight_slopes(spot, group, at, group.lanes);
        let mut spare = Spare::default();
        let mut sums: [Sums; 2] = [[0.0; 4 * LANES]; 2];
        for (c, layer) in self.used(spot).iter().enumerate() {
            for (sums, slopes) in sums.iter_mut().zip(&slopes) {
                let slope = f32x8::load_array(simd, slopes[c]);
                let taps = Taps::new(simd, self.place(spot, c, at), layer.displacement.size, Some(slope));
                for lane in set(group.lanes) {
                    taps.add(simd, lane, &layer.displacement, &mut spare, sums);
                }
            }
        }
        let ([xx, hx, zx, _], [xz, hz, zz, _]) = (fields(simd, &sums[0]), fields(simd, &sums[1]));
        let [x, z, a, b] = motion.gradient;
        motion.gradient = [x + hx, z + hz, a + xx, b + zz];
        motion.cross = [motion.cross[0] + xz, motion.cross[1] + zx];
    }
}

//! The direct sum of the largest waves at rest points, for eight points side by side: no arrays, nothing lost between
//! texels, at the cost of every wave for every point.

use fearless_simd::{Simd, f32x8, i32x8, prelude::*, u32x8};
use glam::{DVec2, Vec2};
use open_water_shaders::surface::MAX_CASCADES;
use open_water_shaders::turns::{COS, RADIANS, SIN};

use crate::query::amplitude::Placed;
use crate::query::invert::{Field, Four, Group, Motion, Pair, Reading};
use crate::query::kernel::LANES;
use crate::query::largest::{Largest, Wave};
use crate::query::patch::disc_mean;

/// The waves of a mode set at a time.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) waves: &'a Largest,
    pub(crate) phase: u32,
    pub(crate) weight: f32,
}

/// One or two mode sets at a time.
pub(crate) struct Direct<'a> {
    pub(crate) parts: [Option<Part<'a>>; 2],
    pub(crate) choppiness: f32,
    /// Tile and the local origin within it, of each cascade, metres.
    pub(crate) tiles: [(f64, DVec2); MAX_CASCADES],
    pub(crate) count: usize,
    pub(crate) map: Option<&'a Placed>,
}

/// Where a group's points lie on each tile, in 1/2^32 of it.
#[derive(Clone, Copy)]
pub(crate) struct Spot<S: Simd> {
    base: [[u32x8<S>; 2]; MAX_CASCADES],
}

/// A wave at eight places.
struct Phase<S: Simd> {
    /// Cosine and sine times the amplitude.
    cos: f32x8<S>,
    sin: f32x8<S>,
}

/// `open_water_shaders::turns::cos_sin` of eight angles.
#[inline(always)]
fn cos_sin<S: Simd>(simd: S, turns: u32x8<S>) -> [f32x8<S>; 2] {
    let quarter = (turns + (1u32 << 29)) >> 30;
    let rest: i32x8<S> = (turns - (quarter << 30)).bitcast();
    let x = rest.to_float::<f32x8<S>>() * RADIANS;
    let x2 = x * x;
    let s = x + x * x2 * (x2 * (x2 * SIN[2] + SIN[1]) + SIN[0]);
    let c = f32x8::splat(simd, 1.0) - x2 * 0.5 + x2 * x2 * (x2 * (x2 * COS[2] + COS[1]) + COS[0]);
    let odd = (quarter & 1u32).simd_eq(u32x8::splat(simd, 1));
    let (sin, cos) = (odd.select(c, s), odd.select(s, c));
    let flip_s = (quarter & 2u32) << 30;
    let flip_c = ((quarter + 1u32) & 2u32) << 30;
    let (cos, sin) = (cos.bitcast::<u32x8<S>>() ^ flip_c, sin.bitcast::<u32x8<S>>() ^ flip_s);
    [cos.bitcast(), sin.bitcast()]
}

impl Direct<'_> {
    /// Positions on the tile of cascade `c`.
    #[inline(always)]
    fn place<S: Simd>(&self, simd: S, spot: &Spot<S>, c: usize, at: Pair<S>) -> [u32x8<S>; 2] {
        let scale = (1.0 / self.tiles[c].0) as f32;
        [turned(simd, spot.base[c][0], at[0] * scale), turned(simd, spot.base[c][1], at[1] * scale)]
    }

    /// The factors of the map and their slopes, cascade by cascade.
    fn factors<S: Simd>(&self, simd: S, group: &Group<S>, at: Pair<S>) -> Option<[[f32x8<S>; MAX_CASCADES]; 3]> {
        let map = self.map?;
        let mut lanes = [[[0.0; LANES]; MAX_CASCADES]; 3];
        let [x, z] = group.rest(at);
        for lane in 0..LANES {
            if group.lanes >> lane & 1 == 1 {
                let place = Vec2::new(x[lane], z[lane]);
                let [slope_x, slope_z] = map.slopes(place);
                for (lanes, factors) in lanes.iter_mut().zip([map.values(place), slope_x, slope_z]) {
                    for (lanes, factor) in lanes.iter_mut().zip(factors) {
                        lanes[lane] = factor;
                    }
                }
            }
        }
        let mut factors = [[f32x8::splat(simd, 0.0); MAX_CASCADES]; 3];
        for (factors, lanes) in factors.iter_mut().zip(&lanes) {
            for (factor, lanes) in factors.iter_mut().zip(lanes) {
                *factor = f32x8::load_array(simd, *lanes);
            }
        }
        Some(factors)
    }
}

/// A position moved by a part of the tile.
#[inline(always)]
fn turned<S: Simd>(simd: S, base: u32x8<S>, part: f32x8<S>) -> u32x8<S> {
    // Adding and taking away 1.5 * 2^23 rounds to whole tiles; what is left is half a tile at most.
    const WHOLE: f32 = 12_582_912.0;
    let rest = part - ((part + WHOLE) - WHOLE);
    let turns: i32x8<S> = (rest * f32x8::splat(simd, 2_147_483_648.0)).to_int();
    let turns: u32x8<S> = turns.bitcast();
    base + (turns << 1)
}

impl Wave {
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, part: &Part<'_>, place: &[u32x8<S>; 2], radius: Option<f32x8<S>>) -> Phase<S> {
        let start = self.phase.wrapping_sub(self.n.wrapping_mul(part.phase));
        let turns = place[0] * (self.i as u32) + place[1] * (self.j as u32) + start;
        let [cos, sin] = cos_sin(simd, turns);
        let amplitude = self.amplitude * part.weight;
        let amplitude = match radius {
            None => f32x8::splat(simd, amplitude),
            Some(radius) => disc_mean(simd, radius * self.length) * amplitude,
        };
        Phase { cos: cos * amplitude, sin: sin * amplitude }
    }
}

/// `sum + factor term`.
#[inline(always)]
fn add<S: Simd>(sum: &mut Four<S>, factor: Option<f32x8<S>>, term: &Four<S>) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += match factor {
            Some(factor) => *term * factor,
            None => *term,
        };
    }
}

impl Field for Direct<'_> {
    type Spot<S: Simd> = Spot<S>;

    fn spot<S: Simd>(&self, simd: S, group: &Group<S>) -> Spot<S> {
        let mut spot = Spot { base: [[u32x8::splat(simd, 0); 2]; MAX_CASCADES] };
        let (x, z) = (group.point[0].to_array(), group.point[1].to_array());
        for (base, (tile, offset)) in spot.base[..self.count].iter_mut().zip(&self.tiles) {
            let (mut turns_x, mut turns_z) = ([0; LANES], [0; LANES]);
            for lane in 0..LANES {
                let turns = |x: f32, offset: f64| {
                    let tiles = (f64::from(x) + offset) / tile;
                    ((tiles - libm::floor(tiles)) * 4_294_967_296.0) as u64 as u32
                };
                (turns_x[lane], turns_z[lane]) = (turns(x[lane], offset.x), turns(z[lane], offset.y));
            }
            *base = [u32x8::load_array(simd, turns_x), u32x8::load_array(simd, turns_z)];
        }
        spot
    }

    #[inline(always)]
    fn rough<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, all: bool) -> Four<S> {
        let zero = f32x8::splat(simd, 0.0);
        let factors = self.factors(simd, group, at);
        let mut value = [zero; 4];
        for c in 0..if all { self.count } else { 1 } {
            let place = self.place(simd, spot, c, at);
            let (mut x, mut z) = (zero, zero);
            for part in self.parts.iter().flatten() {
                for wave in part.waves.of(c) {
                    let Phase { sin, .. } = wave.at(simd, part, &place, group.radius);
                    x -= sin * wave.towards[0];
                    z -= sin * wave.towards[1];
                }
            }
            let displacement = [x * self.choppiness, zero, z * self.choppiness, zero];
            match &factors {
                Some([values, ..]) => add(&mut value, Some(values[c]), &displacement),
                None => add(&mut value, None, &displacement),
            }
        }
        value
    }

    #[inline(always)]
    fn reading<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>, at: Pair<S>, _lanes: u32) -> Reading<S> {
        let zero = f32x8::splat(simd, 0.0);
        let factors = self.factors(simd, group, at);
        let mut reading = Reading { value: [zero; 4], along_x: [zero; 4], along_z: [zero; 4] };
        for c in 0..self.count {
            let place = self.place(simd, spot, c, at);
            let (mut value, mut along_x, mut along_z) = ([zero; 4], [zero; 4], [zero; 4]);
            for part in self.parts.iter().flatten() {
                for wave in part.waves.of(c) {
                    let Phase { cos, sin } = wave.at(simd, part, &place, group.radius);
                    let ([kx, kz], [tx, tz]) = (wave.k, wave.towards);
                    let (chop_x, chop_z) = (self.choppiness * tx, self.choppiness * tz);
                    let cross = cos * (chop_x * kz);
                    let bend = sin * (chop_x * kz);
                    value = [value[0] - sin * chop_x, value[1] + cos, value[2] - sin * chop_z, value[3] - cross];
                    along_x = [
                        along_x[0] - cos * (chop_x * kx),
                        along_x[1] - sin * kx,
                        along_x[2] - cross,
                        along_x[3] + bend * kx,
                    ];
                    along_z = [
                        along_z[0] - cross,
                        along_z[1] - sin * kz,
                        along_z[2] - cos * (chop_z * kz),
                        along_z[3] + bend * kz,
                    ];
                }
            }
            match &factors {
                Some([values, slope_x, slope_z]) => {
                    add(&mut reading.value, Some(values[c]), &value);
                    add(&mut reading.along_x, Some(values[c]), &along_x);
                    add(&mut reading.along_z, Some(values[c]), &along_z);
                    add(&mut reading.along_x, Some(slope_x[c]), &value);
                    add(&mut reading.along_z, Some(slope_z[c]), &value);
                }
                None => {
                    add(&mut reading.value, None, &value);
                    add(&mut reading.along_x, None, &along_x);
                    add(&mut reading.along_z, None, &along_z);
                }
            }
        }
        reading
    }

    #[inline(always)]
    fn motion<S: Simd>(&self, simd: S, spot: &Spot<S>, group: &Group<S>) -> Motion<S> {
        let zero = f32x8::splat(simd, 0.0);
        let at = group.to_rest;
        let factors = self.factors(simd, group, at);
        let mut motion = Motion { gradient: [zero; 4], cross: [zero; 2], velocity: [zero; 4] };
        for c in 0..self.count {
            let place = self.place(simd, spot, c, at);
            let (mut value, mut gradient, mut velocity) = ([zero; 4], [zero; 4], [zero; 4]);
            for part in self.parts.iter().flatten() {
                for wave in part.waves.of(c) {
                    let Phase { cos, sin } = wave.at(simd, part, &place, group.radius);
                    let ([kx, kz], [tx, tz], omega) = (wave.k, wave.towards, wave.omega);
                    let (chop_x, chop_z) = (self.choppiness * tx, self.choppiness * tz);
                    value = [
                        value[0] - sin * chop_x,
                        value[1] + cos,
                        value[2] - sin * chop_z,
                        value[3] - cos * (chop_x * kz),
                    ];
                    gradient = [
                        gradient[0] - sin * kx,
                        gradient[1] - sin * kz,
                        gradient[2] - cos * (chop_x * kx),
                        gradient[3] - cos * (chop_z * kz),
                    ];
                    let (cos, sin) = (cos * omega, sin * omega);
                    velocity = [
                        velocity[0] + cos * chop_x,
                        velocity[1] + sin,
                        velocity[2] + cos * chop_z,
                        velocity[3] - cos * omega,
                    ];
                }
            }
            let mut factor = None;
            let mut cross = [value[3]; 2];
            if let Some([values, slope_x, slope_z]) = &factors {
                let (f, sx, sz) = (values[c], slope_x[c], slope_z[c]);
                factor = Some(f);
                cross = [cross[0] * f + value[0] * sz, cross[1] * f + value[2] * sx];
                add(&mut motion.gradient, None, &[value[1] * sx, value[1] * sz, value[0] * sx, value[2] * sz]);
            }
            add(&mut motion.gradient, factor, &gradient);
            add(&mut motion.velocity, factor, &velocity);
            motion.cross = [motion.cross[0] + cross[0], motion.cross[1] + cross[1]];
        }
        motion
    }

    fn decay<S: Simd>(&self, simd: S, _spot: &Spot<S>, group: &Group<S>) -> f32x8<S> {
        let zero = f32x8::splat(simd, 0.0);
        let factors = self.factors(simd, group, group.to_rest);
        let (mut sum, mut weighted) = (f32x8::splat(simd, f32::MIN_POSITIVE), zero);
        let mut longest = f32::INFINITY;
        for part in self.parts.iter().flatten() {
            for c in 0..self.count {
                for wave in part.waves.of(c) {
                    let mut weight = f32x8::splat(simd, wave.amplitude * part.weight);
                    if let Some(radius) = group.radius {
                        weight *= disc_mean(simd, radius * wave.length);
                    }
                    if let Some([values, ..]) = &factors {
                        // Where there is no place, no map counts.
                        let lanes = simd.from_bitmask_mask32x8(group.lanes.into());
                        weight *= lanes.select(values[c], f32x8::splat(simd, 1.0));
                    }
                    sum += weight * weight;
                    weighted += weight * weight * wave.length;
                    longest = longest.min(wave.length);
                }
            }
        }
        // A body that averages out every wave feels at least the longest.
        weighted.simd_gt(zero).select(weighted / sum, f32x8::splat(simd, longest.min(1e3)))
    }
}

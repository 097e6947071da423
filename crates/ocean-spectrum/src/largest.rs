//! The direct sum of the largest waves at rest points, for eight points side by side: no arrays, nothing lost between
//! texels, at the cost of every wave for every point.

use std::f64::consts::TAU;
use std::ops::Range;

use fearless_simd::{Simd, f32x8, i32x8, prelude::*, u32x8};
use glam::{DVec2, Vec2};
use open_water_shaders::surface::MAX_CASCADES;
use open_water_shaders::turns::{COS, RADIANS, SIN};

use crate::CascadeModes;
use crate::amplitude::Placed;
use crate::invert::{Field, Four, Group, Motion, Pair, Reading};
use crate::kernel::LANES;
use crate::patch::disc_mean;

/// How the queries of an ocean are answered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Queries {
    /// From the arrays of all cascades, read by the cubic kernel: all waves, and a point costs the same however many
    /// there are.
    #[default]
    Arrays,
    /// By direct sum of so many waves, 1 to 4,096: those of the largest variance. Exact for these, and without arrays,
    /// which suits a server that asks for few points: a point costs about as much as its waves.
    Largest(u32),
}

/// A wave `amplitude cos(k.x - omega t + phase)`.
#[derive(Debug, Clone, Copy)]
struct Wave {
    /// Periods along x and z on the tile.
    i: i32,
    j: i32,
    /// Turns a loop, and 1/2^32 turns at the start.
    n: u32,
    phase: u32,
    amplitude: f32,
    /// Wavevector, its length, rad/m, and its direction.
    k: [f32; 2],
    length: f32,
    towards: [f32; 2],
    /// rad/s.
    omega: f32,
}

/// The largest waves of a mode set, cascade by cascade.
pub(crate) struct Largest {
    waves: Vec<Wave>,
    /// Those of each cascade.
    ranges: Vec<Range<usize>>,
}

impl Largest {
    pub(crate) fn new(modes: &[CascadeModes], loop_time: f64, count: u32) -> Self {
        let power = |c: usize, cell: usize| {
            let [re, im, ..] = modes[c].amp[cell].map(f64::from);
            re * re + im * im
        };
        let mut cells: Vec<(usize, usize)> = (modes.iter().enumerate())
            .flat_map(|(c, modes)| (0..modes.amp.len()).map(move |cell| (c, cell)))
            .filter(|&(c, cell)| power(c, cell) > 0.0)
            .collect();
        // Waves of equal power are told apart by their place, so that the choice is the same everywhere.
        let larger =
            |a: &(usize, usize), b: &(usize, usize)| power(b.0, b.1).total_cmp(&power(a.0, a.1)).then(a.cmp(b));
        let count = count as usize;
        if count < cells.len() {
            cells.select_nth_unstable_by(count, larger);
            cells.truncate(count);
        }
        cells.sort_unstable();
        let waves: Vec<Wave> = cells.iter().map(|&(c, cell)| Wave::of(&modes[c], cell, loop_time)).collect();
        let below = |c: usize| cells.partition_point(|cell| cell.0 < c);
        Self { waves, ranges: (0..modes.len()).map(|c| below(c)..below(c + 1)).collect() }
    }
}

impl Wave {
    fn of(modes: &CascadeModes, cell: usize, loop_time: f64) -> Self {
        let size = modes.size as usize;
        let (i, j) = (modes.signed((cell % size) as u32), modes.signed((cell / size) as u32));
        let k = DVec2::new(f64::from(i), f64::from(j)) * modes.step();
        let [re, im, ..] = modes.amp[cell].map(f64::from);
        let turns = libm::atan2(im, re) / TAU;
        Self {
            i,
            j,
            n: modes.n[cell],
            phase: libm::round(turns * 4_294_967_296.0) as i64 as u32,
            // The cells of k and -k hold half of the wave each.
            amplitude: (2.0 * (re * re + im * im).sqrt()) as f32,
            k: k.as_vec2().to_array(),
            length: k.length() as f32,
            towards: (k / k.length()).as_vec2().to_array(),
            omega: (TAU * f64::from(modes.n[cell]) / loop_time) as f32,
        }
    }
}

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
        match radius {
            None => Phase { cos: cos * amplitude, sin: sin * amplitude },
            Some(radius) => {
                let amplitude = disc_mean(simd, radius * self.length) * amplitude;
                Phase { cos: cos * amplitude, sin: sin * amplitude }
            }
        }
    }
}

/// `sum + factor term`, and with a map's slopes.
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
                for wave in &part.waves.waves[part.waves.ranges[c].clone()] {
                    let Phase { sin, .. } = wave.at(simd, part, &place, group.radius);
                    x -= sin * wave.towards[0];
                    z -= sin * wave.towards[1];
                }
            }
            let factor = match &factors {
                Some([values, ..]) => Some(values[c]),
                None => None,
            };
            add(&mut value, factor, &[x * self.choppiness, zero, z * self.choppiness, zero]);
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
                for wave in &part.waves.waves[part.waves.ranges[c].clone()] {
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
        let mut velocity = [zero; 4];
        for c in 0..self.count {
            let place = self.place(simd, spot, c, at);
            let mut sum = [zero; 4];
            for part in self.parts.iter().flatten() {
                for wave in &part.waves.waves[part.waves.ranges[c].clone()] {
                    let Phase { cos, sin } = wave.at(simd, part, &place, group.radius);
                    let (cos, sin) = (cos * wave.omega, sin * wave.omega);
                    let (chop_x, chop_z) = (self.choppiness * wave.towards[0], self.choppiness * wave.towards[1]);
                    sum = [sum[0] + cos * chop_x, sum[1] + sin, sum[2] + cos * chop_z, sum[3] - cos * wave.omega];
                }
            }
            let factor = match &factors {
                Some([values, ..]) => Some(values[c]),
                None => None,
            };
            add(&mut velocity, factor, &sum);
        }
        let Reading { along_x, along_z, .. } = self.reading(simd, spot, group, at, group.lanes);
        Motion { gradient: [along_x[1], along_z[1], along_x[0], along_z[2]], cross: [along_z[0], along_x[2]], velocity }
    }

    fn decay<S: Simd>(&self, simd: S, _spot: &Spot<S>, group: &Group<S>) -> f32x8<S> {
        let zero = f32x8::splat(simd, 0.0);
        let factors = self.factors(simd, group, group.to_rest);
        let (mut sum, mut weighted) = (f32x8::splat(simd, f32::MIN_POSITIVE), zero);
        let mut longest = f32::INFINITY;
        for part in self.parts.iter().flatten() {
            for (c, range) in part.waves.ranges.iter().enumerate() {
                for wave in &part.waves.waves[range.clone()] {
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

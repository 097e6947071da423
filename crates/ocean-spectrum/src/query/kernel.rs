//! The cubic (Catmull-Rom) reading of periodic arrays at eight places at once: C1, exact at texels. The WGSL side reads
//! with the same weights.
//!
//! Indices and weights are computed for eight places side by side; then each place reads for itself, two texels of four
//! fields in eight lanes. So a place's arithmetic is the same whatever the vector width and whoever comes with it. No
//! fused multiply-add: it would round differently where a machine has none.

use fearless_simd::{Simd, f32x4, f32x8, i32x8, prelude::*};

/// Places in one go.
pub(crate) const LANES: usize = 8;
/// A number for each place.
pub(crate) type Lanes = [f32; LANES];

/// A periodic array of `size` squared texels of four fields.
#[derive(Clone, Copy, Default)]
pub(crate) struct Texels<'a> {
    pub(crate) size: usize,
    /// Row-major, x fastest.
    pub(crate) flat: &'a [f32],
}

/// Four fields at each of eight places, as they are stored while places are read one by one.
pub(crate) type Sums = [f32; 4 * LANES];

/// Where eight places lie in an array, and the weights of the 16 texels around each.
pub(crate) struct Taps {
    /// Where the four rows begin in the array.
    rows: [[i32; LANES]; 4],
    /// Lanes whose rows the array's edge cuts, a bit each.
    cut: u32,
    x: [Lanes; 4],
    z: [Lanes; 4],
}

/// Derivatives of the weights.
pub(crate) struct Slopes {
    x: [Lanes; 4],
    z: [Lanes; 4],
    /// What the slope of a factor along x adds, as weights along z.
    tilt: Option<[Lanes; 4]>,
}

/// A factor on the values of an array at eight places.
#[derive(Clone, Copy)]
pub(crate) struct Factor<S: Simd> {
    pub(crate) value: f32x8<S>,
    /// Its slopes along x and z, 1/m.
    pub(crate) slope: [f32x8<S>; 2],
}

/// Four rows of four texels.
type Rows<'a> = [&'a [f32; 16]; 4];
/// Room for the rows of a place whose texels are not side by side.
pub(crate) type Spare = [[f32; 16]; 4];

#[inline(always)]
fn weights<S: Simd>(t: f32x8<S>) -> [f32x8<S>; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [(t2 * 2.0 - t3 - t) * 0.5, (t3 * 3.0 - t2 * 5.0 + 2.0) * 0.5, (t2 * 4.0 - t3 * 3.0 + t) * 0.5, (t3 - t2) * 0.5]
}

#[inline(always)]
fn slopes<S: Simd>(t: f32x8<S>, scale: f32) -> [f32x8<S>; 4] {
    let (t2, scale) = (t * t, 0.5 * scale);
    [
        (t * 4.0 - t2 * 3.0 - 1.0) * scale,
        (t2 * 9.0 - t * 10.0) * scale,
        (t * 8.0 - t2 * 9.0 + 1.0) * scale,
        (t2 * 3.0 - t * 2.0) * scale,
    ]
}

/// The whole part and the rest, for numbers well within those of i32.
#[inline(always)]
fn parted<S: Simd>(x: f32x8<S>) -> (i32x8<S>, f32x8<S>) {
    let cut: i32x8<S> = x.to_int();
    let near: f32x8<S> = cut.to_float();
    let below = near.simd_gt(x);
    let whole = below.select(cut - 1, cut);
    let base = below.select(near - 1.0, near);
    (whole, x - base)
}

#[inline(always)]
pub(crate) fn stored<S: Simd>(values: [f32x8<S>; 4]) -> [Lanes; 4] {
    [values[0].to_array(), values[1].to_array(), values[2].to_array(), values[3].to_array()]
}

#[inline(always)]
fn scaled<S: Simd>(values: [f32x8<S>; 4], factor: Option<f32x8<S>>) -> [f32x8<S>; 4] {
    match factor {
        Some(factor) => [values[0] * factor, values[1] * factor, values[2] * factor, values[3] * factor],
        None => values,
    }
}

impl Taps {
    /// Taps at `at`, in texels, in an array of `size` (a power of two) squared; the weights along z times `factor`.
    #[inline(always)]
    pub(crate) fn new<S: Simd>(simd: S, at: [f32x8<S>; 2], size: usize, factor: Option<f32x8<S>>) -> Self {
        let ((column, tx), (row, tz)) = (parted(at[0]), parted(at[1]));
        Self::with_weights(simd, [column, row], size, weights(tx), scaled(weights(tz), factor))
    }

    /// Taps for [`Self::add_rough`].
    #[inline(always)]
    pub(crate) fn rough<S: Simd>(simd: S, at: [f32x8<S>; 2], size: usize, factor: Option<f32x8<S>>) -> Self {
        let ((column, tx), (row, tz)) = (parted(at[0]), parted(at[1]));
        let zero = f32x8::splat(simd, 0.0);
        let (x, z) = ([zero, -tx + 1.0, tx, zero], [zero, -tz + 1.0, tz, zero]);
        Self::with_weights(simd, [column, row], size, x, scaled(z, factor))
    }

    /// The same as [`Self::new`] with the weights' derivatives, texels being `1/scale` metres; those of the factor too.
    #[inline(always)]
    pub(crate) fn with_slopes<S: Simd>(
        simd: S,
        at: [f32x8<S>; 2],
        size: usize,
        factor: Option<Factor<S>>,
        scale: f32,
    ) -> (Self, Slopes) {
        let ((column, tx), (row, tz)) = (parted(at[0]), parted(at[1]));
        let (plain, slopes_z) = (weights(tz), slopes(tz, scale));
        let (mut z, mut along_z, mut tilt) = (plain, slopes_z, None);
        if let Some(Factor { value, slope }) = factor {
            z = scaled(plain, Some(value));
            along_z = scaled(slopes_z, Some(value));
            for (along, weight) in along_z.iter_mut().zip(&plain) {
                *along += *weight * slope[1];
            }
            tilt = Some(stored(scaled(plain, Some(slope[0]))));
        }
        let taps = Self::with_weights(simd, [column, row], size, weights(tx), z);
        (taps, Slopes { x: stored(slopes(tx, scale)), z: stored(along_z), tilt })
    }

    #[inline(always)]
    fn with_weights<S: Simd>(
        simd: S,
        [column, row]: [i32x8<S>; 2],
        size: usize,
        x: [f32x8<S>; 4],
        z: [f32x8<S>; 4],
    ) -> Self {
        // Negative numbers wrap rightly, as two's complement ends on a multiple of the size.
        let mask = i32x8::splat(simd, size as i32 - 1);
        let first = (column - 1) & mask;
        let cut = first.simd_gt(i32x8::splat(simd, size as i32 - 4)).to_bitmask() as u32;
        let mut rows = [[0; LANES]; 4];
        for (r, rows) in rows.iter_mut().enumerate() {
            let texel = ((row + (r as i32 - 1)) & mask) * size as i32 + first;
            *rows = (texel * 4).to_array();
        }
        Self { rows, cut, x: stored(x), z: stored(z) }
    }

    /// The rows around a place.
    #[inline(always)]
    fn rows<'a>(&self, lane: usize, array: &Texels<'a>, spare: &'a mut Spare) -> Rows<'a> {
        if self.cut >> lane & 1 == 0 {
            let (flat, [a, b, c, d]) = (array.flat, &self.rows);
            [chunk(flat, a[lane]), chunk(flat, b[lane]), chunk(flat, c[lane]), chunk(flat, d[lane])]
        } else {
            self.gather(lane, array, spare);
            let [a, b, c, d] = spare;
            [a, b, c, d]
        }
    }

    /// Copies rows that go on at the other side of the array.
    #[cold]
    #[inline(never)]
    fn gather(&self, lane: usize, array: &Texels<'_>, spare: &mut Spare) {
        let mask = array.size - 1;
        for (spare, rows) in spare.iter_mut().zip(&self.rows) {
            for (c, spare) in spare.chunks_exact_mut(4).enumerate() {
                let first = rows[lane] as usize / 4;
                let at = 4 * ((first & !mask) | ((first + c) & mask));
                spare.copy_from_slice(&array.flat[at..at + 4]);
            }
        }
    }

    /// Adds what the array holds at the place of a lane.
    #[inline(always)]
    pub(crate) fn add<S: Simd>(&self, simd: S, lane: usize, array: &Texels<'_>, spare: &mut Spare, sums: &mut Sums) {
        let rows = self.rows(lane, array, spare);
        let lines = lines(simd, rows, pairs(simd, &self.x, lane));
        let sum = sum(&lines, &self.z, lane);
        add_to(simd, sums, lane, sum);
    }

    /// Adds a rough answer: bilinear between the four texels around.
    #[inline(always)]
    pub(crate) fn add_rough<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        array: &Texels<'_>,
        spare: &mut Spare,
        sums: &mut Sums,
    ) {
        let [_, low, high, _] = self.rows(lane, array, spare);
        let [_, a, b, _] = &self.x;
        let x = simd.combine_f32x4(f32x4::splat(simd, a[lane]), f32x4::splat(simd, b[lane]));
        let (low, high) = (f32x8::from_slice(simd, &low[4..12]), f32x8::from_slice(simd, &high[4..12]));
        let sum = (low * self.z[1][lane] + high * self.z[2][lane]) * x;
        add_to(simd, sums, lane, sum);
    }

    /// The same with its slopes along x and z.
    #[inline(always)]
    pub(crate) fn add_all<S: Simd>(
        &self,
        simd: S,
        slopes: &Slopes,
        lane: usize,
        array: &Texels<'_>,
        spare: &mut Spare,
        sums: &mut [Sums; 3],
    ) {
        let rows = self.rows(lane, array, spare);
        let level = lines(simd, rows, pairs(simd, &self.x, lane));
        let steep = lines(simd, rows, pairs(simd, &slopes.x, lane));
        let mut along_x = sum(&steep, &self.z, lane);
        if let Some(tilt) = &slopes.tilt {
            along_x += sum(&level, tilt, lane);
        }
        let (sum, along_z) = (sum(&level, &self.z, lane), sum(&level, &slopes.z, lane));
        add_to(simd, &mut sums[0], lane, sum);
        add_to(simd, &mut sums[1], lane, along_x);
        add_to(simd, &mut sums[2], lane, along_z);
    }
}

/// Four texels.
#[inline(always)]
fn chunk(flat: &[f32], at: i32) -> &[f32; 16] {
    let at = at as u32 as usize;
    let (chunks, _) = flat[at..at + 16].as_chunks();
    &chunks[0]
}

/// Weights of the texels of a row, two texels in eight lanes.
#[inline(always)]
fn pairs<S: Simd>(simd: S, weights: &[Lanes; 4], lane: usize) -> [f32x8<S>; 2] {
    let [a, b, c, d] = weights;
    [
        simd.combine_f32x4(f32x4::splat(simd, a[lane]), f32x4::splat(simd, b[lane])),
        simd.combine_f32x4(f32x4::splat(simd, c[lane]), f32x4::splat(simd, d[lane])),
    ]
}

/// A row's sum, the even texels in the lower half and the odd ones in the upper.
#[inline(always)]
fn line<S: Simd>(simd: S, row: &[f32; 16], weights: [f32x8<S>; 2]) -> f32x8<S> {
    f32x8::from_slice(simd, &row[..8]) * weights[0] + f32x8::from_slice(simd, &row[8..]) * weights[1]
}

#[inline(always)]
fn lines<S: Simd>(simd: S, [a, b, c, d]: Rows<'_>, weights: [f32x8<S>; 2]) -> [f32x8<S>; 4] {
    [line(simd, a, weights), line(simd, b, weights), line(simd, c, weights), line(simd, d, weights)]
}

#[inline(always)]
fn sum<S: Simd>([a, b, c, d]: &[f32x8<S>; 4], [p, q, r, s]: &[Lanes; 4], lane: usize) -> f32x8<S> {
    *a * p[lane] + *b * q[lane] + *c * r[lane] + *d * s[lane]
}

#[inline(always)]
fn add_to<S: Simd>(simd: S, sums: &mut Sums, lane: usize, sum: f32x8<S>) {
    let (even, odd) = simd.split_f32x8(sum);
    let at = &mut sums[4 * lane..4 * lane + 4];
    (f32x4::from_slice(simd, at) + (even + odd)).store_slice(at);
}

/// The four fields, each at the eight places.
#[inline(always)]
pub(crate) fn fields<S: Simd>(simd: S, sums: &Sums) -> [f32x8<S>; 4] {
    let (low, high) = sums.split_at(16);
    let low = simd.load_four_interleaved_f32x4(low.first_chunk().unwrap_or(&[0.0; 16]));
    let high = simd.load_four_interleaved_f32x4(high.first_chunk().unwrap_or(&[0.0; 16]));
    [
        simd.combine_f32x4(low[0], high[0]),
        simd.combine_f32x4(low[1], high[1]),
        simd.combine_f32x4(low[2], high[2]),
        simd.combine_f32x4(low[3], high[3]),
    ]
}

//! Values side by side in the machine's vectors: whatever the width, each lane does the same operations in the same
//! order, without fused multiply-add, so that the bits are the same on every machine.

use std::ops::{Deref, DerefMut};

use fearless_simd::{Simd, prelude::*};
use open_water_shaders::turns::{COS, RADIANS, SIN};

/// Most lanes of a machine.
pub(crate) const MOST_LANES: usize = 16;

/// One complex value of each lane. In memory: all real parts, then all imaginary parts.
#[derive(Clone, Copy)]
pub(crate) struct Complex<S: Simd> {
    pub(crate) re: S::f32s,
    pub(crate) im: S::f32s,
}

impl<S: Simd> Complex<S> {
    /// Floats of one.
    pub(crate) const FLOATS: usize = 2 * S::f32s::LEN;

    #[inline(always)]
    pub(crate) fn load(simd: S, from: &[f32]) -> Self {
        let (re, im) = from.split_at(S::f32s::LEN);
        Self { re: S::f32s::from_slice(simd, re), im: S::f32s::from_slice(simd, im) }
    }

    #[inline(always)]
    pub(crate) fn store(self, to: &mut [f32]) {
        let (re, im) = to.split_at_mut(S::f32s::LEN);
        self.re.store_slice(re);
        self.im.store_slice(im);
    }

    #[inline(always)]
    pub(crate) fn add(self, b: Self) -> Self {
        Self { re: self.re + b.re, im: self.im + b.im }
    }

    #[inline(always)]
    pub(crate) fn sub(self, b: Self) -> Self {
        Self { re: self.re - b.re, im: self.im - b.im }
    }

    /// Times i.
    #[inline(always)]
    pub(crate) fn turned(self) -> Self {
        Self { re: -self.im, im: self.re }
    }

    /// `self + i b`.
    #[inline(always)]
    pub(crate) fn add_turned(self, b: Self) -> Self {
        Self { re: self.re - b.im, im: self.im + b.re }
    }

    /// `self - i b`.
    #[inline(always)]
    pub(crate) fn sub_turned(self, b: Self) -> Self {
        Self { re: self.re + b.im, im: self.im - b.re }
    }

    #[inline(always)]
    pub(crate) fn times(self, re: S::f32s, im: S::f32s) -> Self {
        Self { re: self.re * re - self.im * im, im: self.re * im + self.im * re }
    }

    #[inline(always)]
    pub(crate) fn scaled(self, by: S::f32s) -> Self {
        Self { re: self.re * by, im: self.im * by }
    }
}

/// Lane `l` of value `i` goes to lane `i` of value `l`, for as many values as lanes.
#[inline(always)]
pub(crate) fn transpose<S: Simd>(simd: S, values: &mut [S::f32s; MOST_LANES]) {
    #[cfg(target_arch = "x86_64")]
    if let (fearless_simd::Level::Avx2(avx2), 8) = (simd.level(), S::f32s::LEN) {
        let mut eight = [fearless_simd::f32x8::splat(avx2, 0.0); 8];
        for (to, from) in eight.iter_mut().zip(values.iter()) {
            *to = fearless_simd::f32x8::from_slice(avx2, from.as_slice());
        }
        let eight = transpose_avx2(avx2, eight);
        for (to, from) in values.iter_mut().zip(&eight) {
            *to = S::f32s::from_slice(simd, from.as_slice());
        }
        return;
    }
    let half = S::f32s::LEN / 2;
    // Each round turns the bits of (value, lane) by one.
    for _ in 0..S::f32s::LEN.trailing_zeros() {
        let before = *values;
        for i in 0..half {
            (values[2 * i], values[2 * i + 1]) = before[i].interleave(before[i + half]);
        }
    }
}

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    // In half as many steps as by interleaving whole vectors.
    #[inline(always)]
    fn transpose_avx2(
        avx2: Avx2,
        v: [fearless_simd::f32x8<fearless_simd::x86::Avx2>; 8],
    ) -> [fearless_simd::f32x8<fearless_simd::x86::Avx2>; 8] {
        use std::arch::x86_64::*;
        let [a, b, c, d, e, f, g, h]: [__m256; 8] =
            [v[0].into(), v[1].into(), v[2].into(), v[3].into(), v[4].into(), v[5].into(), v[6].into(), v[7].into()];
        let (p, q) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (r, s) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        let (t, u) = (_mm256_unpacklo_ps(e, f), _mm256_unpackhi_ps(e, f));
        let (w, x) = (_mm256_unpacklo_ps(g, h), _mm256_unpackhi_ps(g, h));
        let low = [
            _mm256_shuffle_ps::<0x44>(p, r),
            _mm256_shuffle_ps::<0xee>(p, r),
            _mm256_shuffle_ps::<0x44>(q, s),
            _mm256_shuffle_ps::<0xee>(q, s),
        ];
        let high = [
            _mm256_shuffle_ps::<0x44>(t, w),
            _mm256_shuffle_ps::<0xee>(t, w),
            _mm256_shuffle_ps::<0x44>(u, x),
            _mm256_shuffle_ps::<0xee>(u, x),
        ];
        [
            _mm256_permute2f128_ps::<0x20>(low[0], high[0]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x20>(low[1], high[1]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x20>(low[2], high[2]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x20>(low[3], high[3]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x31>(low[0], high[0]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x31>(low[1], high[1]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x31>(low[2], high[2]).simd_into(avx2),
            _mm256_permute2f128_ps::<0x31>(low[3], high[3]).simd_into(avx2),
        ]
    }
);

/// [`open_water_shaders::turns::cos_sin`] of every lane, to the bit.
#[inline(always)]
pub(crate) fn cos_sin<S: Simd>(simd: S, turns: S::u32s) -> Complex<S> {
    let quarter = (turns + u32s(simd, 1 << 29)) >> 30;
    let rest: S::i32s = (turns - (quarter << 30)).bitcast();
    let x = rest.to_float::<S::f32s>() * f32s(simd, RADIANS);
    let x2 = x * x;
    let s = f32s(simd, SIN[0]) + x2 * (f32s(simd, SIN[1]) + x2 * f32s(simd, SIN[2]));
    let s = x + x * x2 * s;
    let c = f32s(simd, COS[0]) + x2 * (f32s(simd, COS[1]) + x2 * f32s(simd, COS[2]));
    let c = f32s(simd, 1.0) - f32s(simd, 0.5) * x2 + x2 * x2 * c;
    let odd = (quarter & u32s(simd, 1)).simd_eq(u32s(simd, 1));
    let flip_s = (quarter & u32s(simd, 2)) << 30;
    let flip_c = ((quarter + u32s(simd, 1)) & u32s(simd, 2)) << 30;
    Complex { re: flipped::<S>(odd.select(s, c), flip_c), im: flipped::<S>(odd.select(c, s), flip_s) }
}

/// Exclusive or on the bits.
#[inline(always)]
fn flipped<S: Simd>(x: S::f32s, sign: S::u32s) -> S::f32s {
    let bits: S::u32s = x.bitcast();
    (bits ^ sign).bitcast()
}

/// The same number in every lane.
#[inline(always)]
pub(crate) fn f32s<S: Simd>(simd: S, x: f32) -> S::f32s {
    S::f32s::splat(simd, x)
}

#[inline(always)]
fn u32s<S: Simd>(simd: S, x: u32) -> S::u32s {
    S::u32s::splat(simd, x)
}

/// An array that starts on a cache line, so that no vector lies across two.
#[derive(Debug, Default)]
pub(crate) struct Aligned<T> {
    all: Vec<T>,
    start: usize,
    len: usize,
}

impl<T: Copy + Default> Aligned<T> {
    pub(crate) fn new(len: usize) -> Self {
        let all = vec![T::default(); len + 64 / size_of::<T>()];
        let start = all.as_ptr().align_offset(64).min(all.len() - len);
        Self { all, start, len }
    }
}

impl<T: Copy + Default> Clone for Aligned<T> {
    fn clone(&self) -> Self {
        let mut new = Self::new(self.len);
        new.copy_from_slice(self);
        new
    }
}

impl<T> Deref for Aligned<T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        &self.all[self.start..self.start + self.len]
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.all[self.start..self.start + self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::levels;
    use fearless_simd::dispatch;

    #[test]
    fn cos_sin_is_that_of_one_value() {
        #[inline(always)]
        fn check<S: Simd>(simd: S) {
            for i in 0..100_000u32 {
                let turns: [u32; MOST_LANES] = std::array::from_fn(|l| (i * 16 + l as u32).wrapping_mul(2_654_435_761));
                let made = cos_sin(simd, S::u32s::from_slice(simd, &turns[..S::u32s::LEN]));
                for (l, &turns) in turns[..S::u32s::LEN].iter().enumerate() {
                    let [cos, sin] = open_water_shaders::turns::cos_sin(turns).map(f32::to_bits);
                    assert_eq!([made.re[l].to_bits(), made.im[l].to_bits()], [cos, sin]);
                }
            }
        }
        for level in levels::all() {
            dispatch!(level, simd => check(simd));
        }
    }

    #[test]
    fn transposing_exchanges_values_and_lanes() {
        #[inline(always)]
        fn check<S: Simd>(simd: S) {
            let n = S::f32s::LEN;
            let mut values = std::array::from_fn(|i| S::f32s::from_fn(simd, |l| (100 * i + l) as f32));
            transpose(simd, &mut values);
            for (i, value) in values[..n].iter().enumerate() {
                for l in 0..n {
                    assert_eq!(value[l], (100 * l + i) as f32);
                }
            }
        }
        for level in levels::all() {
            dispatch!(level, simd => check(simd));
        }
    }
}

//! Inverse complex FFT of several signals at once, one per lane.
//!
//! Decimation in frequency with radix 4 in place, and a last pass (radix 4, or 2 where the size asks for it) that writes
//! the results in order (Van Loan 1992, 1.6 and 2.4). The same operations on any machine: see [`crate::synthesis::lanes`].

use std::f64::consts::TAU;
use std::slice::ChunksExactMut;

use fearless_simd::{Simd, prelude::*};

use crate::synthesis::lanes::Complex;

/// Real and imaginary parts of w, w^2 and w^3 of a butterfly.
type Twiddles = [f32; 6];

/// A transform of one size, a power of two from 16.
pub(crate) struct Fft {
    size: usize,
    /// Of each pass in place.
    passes: Vec<Vec<Twiddles>>,
    /// Where the first result of each butterfly of the last pass goes, in the order of results: the butterfly.
    order: Vec<u32>,
}

/// Which of a signal's values are not zero: the first `half`, and the last `half - 1`.
#[derive(Clone, Copy)]
pub(crate) struct Band {
    pub(crate) half: usize,
}

impl Band {
    /// The values that are zero and must be written as such before a transform.
    pub(crate) fn gap(self, size: usize) -> std::ops::Range<usize> {
        if self.is_narrow(size) { 0..0 } else { self.half..size - (self.half - 1) }
    }

    /// Whether the inner half is zero.
    fn is_narrow(self, size: usize) -> bool {
        self.half <= size / 4
    }
}

impl Fft {
    pub(crate) fn new(size: usize) -> Self {
        let mut passes = Vec::new();
        let mut n = size;
        while n > 4 {
            let power = |p: usize| {
                let (sin, cos) = libm::sincos(TAU * (p % n) as f64 / n as f64);
                [cos as f32, sin as f32]
            };
            let twiddles = |p| {
                let ([a, b], [c, d], [e, f]) = (power(p), power(2 * p), power(3 * p));
                [a, b, c, d, e, f]
            };
            passes.push((0..n / 4).map(twiddles).collect());
            n /= 4;
        }
        // The digits of a butterfly's place, in base 4, are those of its result in reverse.
        let digits = passes.len() as u32;
        let reversed = |place: u32| (0..digits).fold(0, |r, digit| r << 2 | (place >> (2 * digit) & 3));
        Self { size, order: (0..1 << (2 * digits)).map(reversed).collect(), passes }
    }

    /// Transforms `line`, which is spoilt, into `out`. Values outside the band need only be set where
    /// [`Band::gap`] says so.
    #[inline(always)]
    pub(crate) fn run<S: Simd>(&self, simd: S, line: &mut [f32], band: Band, out: &mut [f32]) {
        let mut floats = self.size * Complex::<S>::FLOATS;
        for (pass, twiddles) in self.passes.iter().enumerate() {
            if pass == 0 && band.is_narrow(self.size) {
                narrow_pass(simd, line, twiddles, band.half);
            } else {
                for block in line.chunks_exact_mut(floats) {
                    pass_in_place(simd, block, twiddles);
                }
            }
            floats /= 4;
        }
        if floats == 4 * Complex::<S>::FLOATS {
            last_pass_4(simd, line, &self.order, out);
        } else {
            last_pass_2(simd, line, &self.order, out);
        }
    }
}

/// The four results before the twiddles.
#[inline(always)]
fn butterfly<S: Simd>(x: [Complex<S>; 4]) -> [Complex<S>; 4] {
    let (sum, difference) = (x[0].add(x[2]), x[0].sub(x[2]));
    let (other, turned) = (x[1].add(x[3]), x[1].sub(x[3]));
    [sum.add(other), difference.add_turned(turned), sum.sub(other), difference.sub_turned(turned)]
}

#[inline(always)]
fn twiddled<S: Simd>(simd: S, y: [Complex<S>; 4], w: &Twiddles) -> [Complex<S>; 4] {
    [
        y[0],
        y[1].times(S::f32s::splat(simd, w[0]), S::f32s::splat(simd, w[1])),
        y[2].times(S::f32s::splat(simd, w[2]), S::f32s::splat(simd, w[3])),
        y[3].times(S::f32s::splat(simd, w[4]), S::f32s::splat(simd, w[5])),
    ]
}

/// The four quarters, value by value.
#[inline(always)]
fn quarters<S: Simd>(x: &mut [f32]) -> [ChunksExactMut<'_, f32>; 4] {
    let floats = Complex::<S>::FLOATS;
    let (low, high) = x.split_at_mut(x.len() / 2);
    let ((a, b), (c, d)) = (low.split_at_mut(low.len() / 2), high.split_at_mut(high.len() / 2));
    [a.chunks_exact_mut(floats), b.chunks_exact_mut(floats), c.chunks_exact_mut(floats), d.chunks_exact_mut(floats)]
}

#[inline(always)]
fn pass_in_place<S: Simd>(simd: S, block: &mut [f32], twiddles: &[Twiddles]) {
    let [a, b, c, d] = quarters::<S>(block);
    for (((a, b), (c, d)), w) in a.zip(b).zip(c.zip(d)).zip(twiddles) {
        let x = [Complex::load(simd, a), Complex::load(simd, b), Complex::load(simd, c), Complex::load(simd, d)];
        let y = twiddled(simd, butterfly::<S>(x), w);
        y[0].store(a);
        y[1].store(b);
        y[2].store(c);
        y[3].store(d);
    }
}

/// The first pass where only values of the first and the last quarter are not zero.
#[inline(always)]
fn narrow_pass<S: Simd>(simd: S, line: &mut [f32], twiddles: &[Twiddles], half: usize) {
    let first_of_last = twiddles.len() + 1 - half;
    let [a, b, c, d] = quarters::<S>(line);
    for (p, (((a, b), (c, d)), w)) in a.zip(b).zip(c.zip(d)).zip(twiddles).enumerate() {
        let y = if p < half && p >= first_of_last {
            let (x, z) = (Complex::<S>::load(simd, a), Complex::load(simd, d));
            [x.add(z), x.sub_turned(z), x.sub(z), x.add_turned(z)]
        } else if p < half {
            [Complex::<S>::load(simd, a); 4]
        } else if p >= first_of_last {
            let z = Complex::<S>::load(simd, d);
            let (re, im) = (-z.re, -z.im);
            [z, Complex { re: z.im, im: re }, Complex { re, im }, Complex { re: im, im: z.re }]
        } else {
            let zero = S::f32s::splat(simd, 0.0);
            [Complex { re: zero, im: zero }; 4]
        };
        let y = twiddled(simd, y, w);
        y[0].store(a);
        y[1].store(b);
        y[2].store(c);
        y[3].store(d);
    }
}

#[inline(always)]
fn last_pass_4<S: Simd>(simd: S, line: &[f32], order: &[u32], out: &mut [f32]) {
    let floats = Complex::<S>::FLOATS;
    let [a, b, c, d] = quarters::<S>(out);
    for (((a, b), (c, d)), &place) in a.zip(b).zip(c.zip(d)).zip(order) {
        let block = &line[place as usize * 4 * floats..][..4 * floats];
        let (low, high) = block.split_at(2 * floats);
        let ((p, q), (r, s)) = (low.split_at(floats), high.split_at(floats));
        let x = [Complex::load(simd, p), Complex::load(simd, q), Complex::load(simd, r), Complex::load(simd, s)];
        let y = butterfly::<S>(x);
        y[0].store(a);
        y[1].store(b);
        y[2].store(c);
        y[3].store(d);
    }
}

#[inline(always)]
fn last_pass_2<S: Simd>(simd: S, line: &[f32], order: &[u32], out: &mut [f32]) {
    let floats = Complex::<S>::FLOATS;
    let (low, high) = out.split_at_mut(out.len() / 2);
    for ((a, b), &place) in low.chunks_exact_mut(floats).zip(high.chunks_exact_mut(floats)).zip(order) {
        let block = &line[place as usize * 2 * floats..][..2 * floats];
        let (x, y) = (Complex::<S>::load(simd, &block[..floats]), Complex::load(simd, &block[floats..]));
        x.add(y).store(a);
        x.sub(y).store(b);
    }
}

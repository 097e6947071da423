//! Inverse complex FFT of several signals at once, one per lane: the loops vectorise on any machine, and the bits are
//! the same on all of them (twiddles from libm, no fused multiply-add, no choice of code at run time).
//!
//! Stockham's self-sorting passes of radix 4, and one of radix 2 where the size asks for it (Van Loan 1992, 1.7).

use std::f64::consts::TAU;

/// Signals transformed together.
pub(crate) const LANES: usize = 4;

/// One value of each lane.
pub(crate) type Lanes = [f32; LANES];

/// One complex value of each lane.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Complex {
    pub(crate) re: Lanes,
    pub(crate) im: Lanes,
}

/// A transform of one size, a power of two from 4.
pub(crate) struct Fft {
    size: usize,
    /// Per pass of radix 4, the twiddles w, w^2, w^3 of each butterfly.
    twiddles: Vec<Vec<[[f32; 2]; 3]>>,
}

#[inline(always)]
fn each(f: impl Fn(usize) -> f32) -> Lanes {
    std::array::from_fn(f)
}

impl Complex {
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { re: each(|l| self.re[l] + b.re[l]), im: each(|l| self.im[l] + b.im[l]) }
    }

    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { re: each(|l| self.re[l] - b.re[l]), im: each(|l| self.im[l] - b.im[l]) }
    }

    /// Times i.
    #[inline(always)]
    fn turned(self) -> Self {
        Self { re: each(|l| -self.im[l]), im: self.re }
    }

    #[inline(always)]
    fn times(self, [re, im]: [f32; 2]) -> Self {
        Self { re: each(|l| self.re[l] * re - self.im[l] * im), im: each(|l| self.re[l] * im + self.im[l] * re) }
    }
}

impl Fft {
    pub(crate) fn new(size: usize) -> Self {
        let mut twiddles = Vec::new();
        let mut n = size;
        while n >= 4 {
            let power = |p: usize| {
                let (sin, cos) = libm::sincos(TAU * (p % n) as f64 / n as f64);
                [cos as f32, sin as f32]
            };
            twiddles.push((0..n / 4).map(|p| [power(p), power(2 * p), power(3 * p)]).collect());
            n /= 4;
        }
        Self { size, twiddles }
    }

    /// Transforms `a`, with `b` as scratch, both of the plan's size; the result is in the one returned.
    pub(crate) fn run<'a>(&self, mut a: &'a mut [Complex], mut b: &'a mut [Complex]) -> &'a mut [Complex] {
        let mut stride = 1;
        for twiddles in &self.twiddles {
            if stride == 1 {
                first_pass(a, b, twiddles);
            } else {
                pass(a, b, twiddles, stride);
            }
            (a, b) = (b, a);
            stride *= 4;
        }
        if stride < self.size {
            let (low, high) = a.split_at(stride);
            let (sum, difference) = b.split_at_mut(stride);
            for (((x, y), sum), difference) in low.iter().zip(high).zip(sum).zip(difference) {
                *sum = x.add(*y);
                *difference = x.sub(*y);
            }
            a = b;
        }
        a
    }
}

#[inline(always)]
fn butterfly(x: [Complex; 4], w: &[[f32; 2]; 3]) -> [Complex; 4] {
    let (sum, difference) = (x[0].add(x[2]), x[0].sub(x[2]));
    let (other, turned) = (x[1].add(x[3]), x[1].sub(x[3]).turned());
    [sum.add(other), difference.add(turned).times(w[0]), sum.sub(other).times(w[1]), difference.sub(turned).times(w[2])]
}

fn quarters(x: &[Complex]) -> [&[Complex]; 4] {
    let (low, high) = x.split_at(x.len() / 2);
    let ((a, b), (c, d)) = (low.split_at(low.len() / 2), high.split_at(high.len() / 2));
    [a, b, c, d]
}

/// The pass of stride 1: each butterfly has its own twiddles.
fn first_pass(x: &[Complex], y: &mut [Complex], twiddles: &[[[f32; 2]; 3]]) {
    let [a, b, c, d] = quarters(x);
    let inputs = a.iter().zip(b).zip(c.iter().zip(d));
    for ((((a, b), (c, d)), w), y) in inputs.zip(twiddles).zip(y.chunks_exact_mut(4)) {
        y.copy_from_slice(&butterfly([*a, *b, *c, *d], w));
    }
}

/// A later pass: `stride` butterflies share their twiddles.
fn pass(x: &[Complex], y: &mut [Complex], twiddles: &[[[f32; 2]; 3]], stride: usize) {
    let [a, b, c, d] = quarters(x).map(|quarter| quarter.chunks_exact(stride));
    let inputs = a.zip(b).zip(c.zip(d));
    for ((((a, b), (c, d)), w), y) in inputs.zip(twiddles).zip(y.chunks_exact_mut(4 * stride)) {
        let (low, high) = y.split_at_mut(2 * stride);
        let ((p, q), (r, s)) = (low.split_at_mut(stride), high.split_at_mut(stride));
        let outputs = p.iter_mut().zip(q).zip(r.iter_mut().zip(s));
        let inputs = a.iter().zip(b).zip(c.iter().zip(d));
        for (((p, q), (r, s)), ((a, b), (c, d))) in outputs.zip(inputs) {
            [*p, *q, *r, *s] = butterfly([*a, *b, *c, *d], w);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_sum_it_stands_for() {
        for size in [4, 8, 16, 32, 64, 128, 256, 512, 1024] {
            let value = |i: usize, lane: usize| ((i * 7919 + lane * 104_729 + 13) % 1009) as f32 / 1009.0 - 0.5;
            let input: Vec<_> = (0..size)
                .map(|i| Complex { re: each(|lane| value(i, lane)), im: each(|lane| value(i + size, lane)) })
                .collect();
            let (mut a, mut b) = (input.clone(), vec![Complex { re: [f32::NAN; LANES], im: [f32::NAN; LANES] }; size]);
            let output = Fft::new(size).run(&mut a, &mut b);
            let (mut off, mut all) = (0.0, 0.0);
            for (x, output) in output.iter().enumerate() {
                for lane in 0..LANES {
                    let (mut re, mut im) = (0.0, 0.0);
                    for (i, input) in input.iter().enumerate() {
                        let (sin, cos) = (TAU * (i * x % size) as f64 / size as f64).sin_cos();
                        let (p, q) = (f64::from(input.re[lane]), f64::from(input.im[lane]));
                        re += p * cos - q * sin;
                        im += p * sin + q * cos;
                    }
                    off += (f64::from(output.re[lane]) - re).powi(2) + (f64::from(output.im[lane]) - im).powi(2);
                    all += re * re + im * im;
                }
            }
            assert!((off / all).sqrt() < 3e-7, "{size}: {:e}", (off / all).sqrt());
        }
    }
}

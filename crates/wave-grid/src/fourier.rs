//! Fourier transforms whose bits are the same on every machine, for what is done once and then: where waves are taken over. Lengths of
//! any prime factors, f64.

use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Lines of a task.
const LOT: usize = 16;

/// A transform of one length.
struct Line {
    /// e^(-2 pi i k / n).
    twiddles: Vec<Complex64>,
    factors: Vec<usize>,
}

impl Line {
    fn new(n: usize) -> Self {
        let turn = |k: usize| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / n as f64);
            Complex64::new(cos, -sin)
        };
        let (mut factors, mut left) = (Vec::new(), n);
        for p in [4].into_iter().chain(2..) {
            while left.is_multiple_of(p) && left > 1 {
                factors.push(p);
                left /= p;
            }
            if left <= 1 {
                break;
            }
        }
        Self { twiddles: (0..n).map(turn).collect(), factors }
    }

    /// `out[k] = sum over j of from[j stride] e^(-2 pi i j k / n)`.
    fn run(
        &self,
        from: &[Complex64],
        out: &mut [Complex64],
        stride: usize,
        factors: &[usize],
        terms: &mut [Complex64],
    ) {
        let Some((&p, others)) = factors.split_first() else {
            out[0] = from[0];
            return;
        };
        let part = out.len() / p;
        for (q, out) in out.chunks_exact_mut(part).enumerate() {
            self.run(&from[q * stride..], out, stride * p, others, terms);
        }
        for k in 0..part {
            for q in 0..p {
                terms[q] = out[q * part + k] * self.twiddles[q * k * stride];
            }
            if p == 2 {
                (out[k], out[part + k]) = (terms[0] + terms[1], terms[0] - terms[1]);
            } else if p == 4 {
                let [a, b] = [terms[0] + terms[2], terms[0] - terms[2]];
                let (c, d) = (terms[1] + terms[3], terms[1] - terms[3]);
                let d = Complex64::new(d.im, -d.re);
                (out[k], out[part + k], out[2 * part + k], out[3 * part + k]) = (a + c, b + d, a - c, b - d);
            } else {
                for r in 0..p {
                    let n = self.twiddles.len();
                    let sum = (0..p).map(|q| terms[q] * self.twiddles[q * r % p * (n / p)]);
                    out[r * part + k] = sum.fold(Complex64::default(), |sum, term| sum + term);
                }
            }
        }
    }
}

/// Transforms of fields of one size, row-major, x fastest.
pub(crate) struct Fourier {
    size: [usize; 2],
    lines: [Line; 2],
}

impl Fourier {
    pub(crate) fn new(size: [usize; 2]) -> Self {
        Self { size, lines: size.map(Line::new) }
    }

    /// The spectrum of `field`, column by column: wavenumber (i, j) at `i * size[1] + j`.
    pub(crate) fn forth(&self, field: &[Complex64]) -> Vec<Complex64> {
        let rows = Self::pass(&self.lines[0], field);
        Self::pass(&self.lines[1], &turned(&rows, self.size[0]))
    }

    /// The field of a spectrum, times the number of its cells.
    pub(crate) fn back(&self, spectrum: &[Complex64]) -> Vec<Complex64> {
        let conjugate: Vec<Complex64> = spectrum.iter().map(|z| z.conj()).collect();
        let columns = Self::pass(&self.lines[1], &conjugate);
        let mut field = Self::pass(&self.lines[0], &turned(&columns, self.size[1]));
        field.iter_mut().for_each(|z| *z = z.conj());
        field
    }

    /// Transforms all lines.
    fn pass(line: &Line, from: &[Complex64]) -> Vec<Complex64> {
        let n = line.twiddles.len();
        let most = line.factors.iter().copied().max().unwrap_or(1);
        let mut done = vec![Complex64::default(); from.len()];
        done.par_chunks_mut(LOT * n).zip(from.par_chunks(LOT * n)).for_each(|(done, from)| {
            let mut terms = vec![Complex64::default(); most];
            for (done, from) in done.chunks_exact_mut(n).zip(from.chunks_exact(n)) {
                line.run(from, done, 1, &line.factors, &mut terms);
            }
        });
        done
    }
}

/// Rows of `n` as columns.
fn turned(from: &[Complex64], n: usize) -> Vec<Complex64> {
    let count = from.len() / n;
    let mut turned = vec![Complex64::default(); from.len()];
    turned.par_chunks_mut(LOT * count).enumerate().for_each(|(lot, turned)| {
        for (j, row) in from.chunks_exact(n).enumerate() {
            for (column, z) in turned.chunks_exact_mut(count).zip(&row[lot * LOT..]) {
                column[j] = *z;
            }
        }
    });
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_sums_of_waves_and_come_back() {
        let [n, m] = [30, 14];
        let value = |at: usize| Complex64::new(((at * 7919 + 13) % 101) as f64, ((at * 104_729 + 5) % 97) as f64);
        let field: Vec<Complex64> = (0..n * m).map(value).collect();
        let fourier = Fourier::new([n, m]);
        let spectrum = fourier.forth(&field);
        for (i, j) in [(0, 0), (1, 0), (0, 3), (15, 7), (29, 13), (11, 5)] {
            let wave = |at: usize| {
                let turns = (at % n * i) as f64 / n as f64 + (at / n * j) as f64 / m as f64;
                field[at] * Complex64::cis(-std::f64::consts::TAU * turns)
            };
            let sum: Complex64 = (0..n * m).map(wave).sum();
            assert!((spectrum[i * m + j] - sum).norm() < 1e-8, "{i} {j}");
        }
        let again = fourier.back(&spectrum);
        assert!(field.iter().zip(again).all(|(a, b)| (a * (n * m) as f64 - b).norm() < 1e-8));
    }
}

//! Fits the weights of a texture's kernels to a mode's radiation damping.
//!
//! A source `q(x) dz` on water that obeys `omega^2 = g k` radiates the power of a damping
//! `B = rho omega k <|q^|^2> / 2` (mean over directions), and by reciprocity (Haskind) waves push with `rho g q^`. So
//! `q^ = sqrt(2 B / (rho omega k))` gives both. What such a source adds to the mass follows from B by the relation of
//! Kramers and Kronig; what is left of the added mass stays with the body.

use std::f64::consts::TAU;

use super::kernel::{Element, spread, transforms};

/// Range of frequencies, in units of the body's own, that is fitted.
const BAND: (f64, f64) = (0.3, 2.0);
/// Width of the weight around the body's own frequency, and its least.
const AROUND: (f64, f64) = (0.45, 0.1);
/// Tikhonov's term, over the mean diagonal.
const RIDGE: f64 = 1.0e-5;
/// Wavenumbers tabulated, from and to in units of the body's own.
const STEPS: usize = 160;
const SPAN: (f64, f64) = (0.005, 20.0);
/// Kernels have nothing left at `exp(-14)`.
const GONE: f64 = 14.0;

const GRAVITY: f64 = 9.81;

/// Transforms of the kernels at the wavenumbers of a fit, shared by the modes of a body.
pub(crate) struct Basis {
    depths: Vec<f64>,
    ks: Vec<f64>,
    /// A row a wavenumber.
    rows: Vec<Vec<f64>>,
}

/// A mode to be fitted.
pub(crate) struct Target<'a> {
    pub(crate) elements: &'a [Element],
    /// Its own frequency, rad/s.
    pub(crate) natural: f64,
    /// Added mass there.
    pub(crate) added: f64,
    /// `sqrt(2 B / (rho omega k))` at a frequency.
    pub(crate) excitation: &'a dyn Fn(f64) -> f64,
}

/// What was found.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    pub(crate) weights: Vec<f64>,
    /// Added mass that stays with the body.
    pub(crate) left: f64,
}

impl Basis {
    /// For bodies whose lowest and highest own wavenumbers are these.
    pub(crate) fn new(depths: Vec<f64>, reach: f64, own: (f64, f64)) -> Self {
        let (from, to) = (SPAN.0 * own.0, SPAN.1 * own.1);
        let step = libm::log(to / from) / (STEPS - 1) as f64;
        let mut ks = vec![0.0];
        ks.extend((0..STEPS).map(|i| from * libm::exp(step * i as f64)));
        let shallowest = depths.iter().copied().fold(f64::INFINITY, f64::min);
        let mut rows = Vec::new();
        for k in &ks {
            let mut row = vec![0.0; depths.len()];
            if k * shallowest < GONE {
                transforms(*k, &depths, reach, &mut row);
            }
            rows.push(row);
        }
        Self { depths, ks, rows }
    }

    pub(crate) fn depths(&self) -> &[f64] {
        &self.depths
    }

    /// Weighted least squares, and the mass that is left over.
    pub(crate) fn fit(&self, target: &Target, density: f64) -> Option<Fitted> {
        let n = self.depths.len();
        let (mut normal, mut right) = (vec![vec![0.0; n]; n], vec![0.0; n]);
        let shapes: Vec<f64> = self.ks.iter().map(|k| spread(target.elements, *k).sqrt()).collect();
        for ((k, row), shape) in self.ks.iter().zip(&self.rows).zip(&shapes) {
            let omega = (GRAVITY * k).sqrt();
            let ratio = omega / target.natural;
            if !(BAND.0..=BAND.1).contains(&ratio) {
                continue;
            }
            let off = (ratio - 1.0) / AROUND.0;
            // B errs by omega k q dq; wavenumbers stand evenly in their logarithm.
            let weight = (libm::exp(-off * off) + AROUND.1) * ratio * ratio * ratio * ratio.sqrt();
            let wanted = (target.excitation)(omega);
            let own = row.iter().map(|h| weight * shape * h);
            for ((sums, right), a) in normal.iter_mut().zip(&mut right).zip(own.clone()) {
                for (sum, b) in sums.iter_mut().zip(own.clone()) {
                    *sum += a * b;
                }
                *right += a * weight * wanted;
            }
        }
        let mean = (0..n).map(|i| normal[i][i]).sum::<f64>() / n as f64;
        for (i, row) in normal.iter_mut().enumerate() {
            row[i] += RIDGE * mean;
        }
        let weights = solved(normal, right)?;
        let power: Vec<f64> = self
            .rows
            .iter()
            .zip(&shapes)
            .map(|(row, shape)| {
                let sum: f64 = row.iter().zip(&weights).map(|(h, w)| h * w).sum();
                sum * sum * shape * shape
            })
            .collect();
        let carried = self.carried(&power, target.natural) * density;
        let left = target.added - carried;
        if left.is_finite() { Some(Fitted { weights, left }) } else { None }
    }

    /// Added mass over the density of a source with this `<|q^|^2>`: `1/(2 pi) P int k f / (k - k0) dk`.
    fn carried(&self, power: &[f64], omega: f64) -> f64 {
        let k0 = omega * omega / GRAVITY;
        let f = |k: f64| k * lerp(&self.ks, power, k);
        // Around the pole in pairs, of which the singular parts cancel.
        let pairs = 800;
        let h = k0 / f64::from(pairs);
        let mut sum: f64 = (0..pairs)
            .map(|i| {
                let x = (f64::from(i) + 0.5) * h;
                (f(k0 + x) - f(k0 - x)) / x * h
            })
            .sum();
        let top = self.ks[self.ks.len() - 1];
        let rest = 4000;
        let h = (top - 2.0 * k0).max(0.0) / f64::from(rest);
        sum += (0..rest)
            .map(|i| {
                let k = 2.0 * k0 + (f64::from(i) + 0.5) * h;
                f(k) / (k - k0) * h
            })
            .sum::<f64>();
        sum / TAU
    }
}

fn lerp(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let next = xs.partition_point(|v| *v <= x);
    if next == 0 || next == xs.len() {
        return ys[next.saturating_sub(1)];
    }
    let share = (x - xs[next - 1]) / (xs[next] - xs[next - 1]);
    ys[next - 1] + share * (ys[next] - ys[next - 1])
}

/// Gauss with pivots.
fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for p in 0..n {
        let pivot = (p..n).max_by(|x, y| a[*x][p].abs().total_cmp(&a[*y][p].abs()))?;
        a.swap(p, pivot);
        b.swap(p, pivot);
        let (upper, lower) = a.split_at_mut(p + 1);
        let top = &upper[p];
        if top[p] == 0.0 {
            return None;
        }
        for (i, row) in lower.iter_mut().enumerate() {
            let factor = row[p] / top[p];
            for (v, t) in row.iter_mut().zip(top).skip(p) {
                *v -= factor * t;
            }
            b[p + 1 + i] -= factor * b[p];
        }
    }
    for p in (0..n).rev() {
        let known: f64 = a[p].iter().zip(&b).skip(p + 1).map(|(a, b)| a * b).sum();
        b[p] = (b[p] - known) / a[p][p];
    }
    if b.iter().all(|v| v.is_finite()) { Some(b) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mass that q^ = exp(-k) carries, over the density: `P int k e^-2k/(k - k0) dk = 1/2 - k0 e^(-2 k0) Ei(2 k0)`.
    fn carried(k0: f64, ei: f64) -> f64 {
        (0.5 - k0 * libm::exp(-2.0 * k0) * ei) / TAU
    }

    #[test]
    fn a_damping_made_of_kernels_is_found_again_with_its_mass() {
        // Far below, both kernels look alike over the fitted band and the ridge decides: no place to ask for weights.
        let elements = [Element { at: [0.0; 2], weight: 1.0 }];
        let basis = Basis::new(vec![1.0, 4.0], 1.0e3, (0.25, 0.25));
        let target = Target {
            elements: &elements,
            natural: (GRAVITY * 0.25).sqrt(),
            added: 100.0,
            excitation: &|omega| libm::exp(-omega * omega / GRAVITY),
        };
        let fitted = basis.fit(&target, 1000.0).unwrap();
        assert!((fitted.weights[0] - 1.0).abs() < 1e-3 && fitted.weights[1].abs() < 1e-3, "{:?}", fitted.weights);
        let carried = 1000.0 * carried(0.25, 0.454_220);
        assert!((fitted.left - (100.0 - carried)).abs() < 2e-3 * carried, "{} {carried}", fitted.left);
    }

    #[test]
    fn the_carried_mass_is_its_closed_form_far_below_and_in_the_band() {
        let basis = Basis::new(vec![1.0], 100.0, (0.01, 2.0));
        let power: Vec<f64> = basis.ks.iter().map(|k| libm::exp(-2.0 * k)).collect();
        for (k0, ei) in [(0.01, -3.314_707), (0.25, 0.454_220), (1.0, 4.954_234)] {
            let (found, expected) = (basis.carried(&power, (GRAVITY * k0).sqrt()), carried(k0, ei));
            assert!((found - expected).abs() < 3e-3 * expected.abs(), "k0 {k0}: {found} against {expected}");
        }
    }
}

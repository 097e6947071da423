//! Constants of the foam.
//!
//! Water breaks where the Jacobian of the horizontal displacement falls below a threshold, and leaves foam that fades.
//! The Jacobian that counts is that of the sum of all cascades, but a texel knows only its own: it holds the chance that
//! the sum breaks given its own derivatives, less the share of the mean that the other cascades' texels bring. That is
//! the best approximation of the sum's foam by a sum over cascades (the first-order terms of its analysis of variance).

use crate::{CascadeModes, Moment, Ocean};

/// Seconds in which foam fades to 1/e.
pub const FOAM_SECONDS: f32 = 4.0;
/// Jacobian below which water breaks: the coverage of a wind sea then grows from 1 % at 10 m/s to some 10 % at 20 m/s.
pub const FOAM_THRESHOLD: f32 = 0.6;
/// Least standard deviation over which an edge of foam is soft.
const SOFTNESS: f64 = 0.03;

/// Factor on old foam after `dt` seconds.
pub(super) fn decay(dt: f32) -> f32 {
    let dt = if dt.is_finite() { dt.max(0.0) } else { 0.0 };
    libm::expf(-dt / FOAM_SECONDS)
}

/// Variance of the divergence of the horizontal displacement at choppiness 1, of each cascade: that of the first mode
/// set, that of the second, and the mixed term, so that of a mix follows from its weights.
#[derive(Debug, Clone, Default)]
pub(super) struct Divergence {
    sets: [u64; 2],
    terms: Vec<[f64; 3]>,
}

/// Sum over the modes of two sets of `k^2` times the product of their amplitudes.
fn product(a: &CascadeModes, b: &CascadeModes) -> f64 {
    let size = a.size as usize;
    let cells = a.amp.iter().zip(&a.n).zip(b.amp.iter().zip(&b.n)).enumerate();
    // Waves of different frequency do not know each other.
    let sum: f64 = cells
        .filter(|(_, ((_, n), (_, m)))| n == m)
        .map(|(cell, ((p, _), (q, _)))| {
            let [i, j] = [cell % size, cell / size].map(|x| f64::from(a.signed(x as u32)));
            (i * i + j * j) * (f64::from(p[0]) * f64::from(q[0]) + f64::from(p[1]) * f64::from(q[1]))
        })
        .sum();
    2.0 * a.step().powi(2) * sum
}

impl Divergence {
    /// Takes over the mode sets of a time, if they are others.
    pub(super) fn set(&mut self, ocean: &Ocean, t: f64) {
        let sets = ocean.moment_at(t).sets;
        if sets == self.sets {
            return;
        }
        self.sets = sets;
        let (first, second) = ocean.mode_sets_at(t);
        let one = first.iter().map(|modes| product(modes, modes));
        self.terms = match second {
            None => one.map(|one| [one, 0.0, 0.0]).collect(),
            Some(second) => {
                let pairs = first.iter().zip(second);
                one.zip(pairs).map(|(one, (a, b))| [one, product(b, b), product(a, b)]).collect()
            }
        };
    }

    /// What the shader knows of each cascade: spread and share.
    pub(super) fn cascades(&self, moment: &Moment) -> impl Iterator<Item = (f32, f32)> {
        let [a, b] = moment.weight.map(f64::from);
        let chop = f64::from(moment.choppiness);
        let variance = move |[one, two, mixed]: &[f64; 3]| {
            chop * chop * (a * a * one + b * b * two + 2.0 * a * b * mixed).max(0.0)
        };
        let total: f64 = self.terms.iter().map(variance).sum();
        let spread = |variance: f64| (variance.max(0.0) + SOFTNESS * SOFTNESS).sqrt();
        // Logistic in place of the normal distribution, as in the shader.
        let mean = 1.0 / (1.0 + libm::exp(1.702 * (1.0 - f64::from(FOAM_THRESHOLD)) / spread(total)));
        let others = 1.0 - 1.0 / self.terms.len().max(1) as f64;
        self.terms.iter().map(move |terms| (spread(total - variance(terms)) as f32, (mean * others) as f32))
    }
}

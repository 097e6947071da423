//! Tails: what replaces a spectrum's own decay well above its peak.

use crate::sea::partition::Tail;
use crate::{GRAVITY, dispersion};

/// Where the tail of Donelan begins and where it gets steeper, over the peak.
const DONELAN: [f64; 2] = [1.5, 3.5];
/// Slowest wave and its wavenumber as Elfouhaily et al. have them, m/s and rad/m.
const SLOWEST: f64 = 0.23;
const SLOWEST_K: f64 = 370.0;
/// Wavenumbers between which the tail of Elfouhaily takes over: from this over the peak's (where their own long waves end)
/// to this, rad/m, or over twice as far if that is more.
const ELFOUHAILY_FROM: f64 = 10.0;
const ELFOUHAILY_TO: f64 = 90.0;

/// A tail with its constants.
pub(crate) enum Prepared {
    OfSpectrum,
    /// From `start`, at wavenumber `k`, as `omega^-4`, from `bend` as `omega^-5`.
    Donelan {
        start: f64,
        k: f64,
        bend: f64,
    },
    /// Blends over the logarithm of the wavenumber.
    Elfouhaily {
        alpha: f64,
        from: f64,
        to: f64,
    },
}

impl Prepared {
    /// For a spectrum over `depth` metres with its peak at `peak` (rad/s) that is measured up to `known` (rad/s; 0 if none
    /// of it is).
    pub(crate) fn new(tail: Tail, peak: f64, known: f64, depth: Option<f64>) -> Self {
        match tail {
            Tail::OfSpectrum => Self::OfSpectrum,
            Tail::Donelan => {
                let start = (DONELAN[0] * peak).max(known);
                let k = dispersion::wavenumber(start, depth);
                Self::Donelan { start, k, bend: (DONELAN[1] * peak).max(start) }
            }
            Tail::Elfouhaily { wind_speed } => {
                let k = |omega: f64| omega * omega / GRAVITY;
                let from = (ELFOUHAILY_FROM * k(peak)).max(k(known));
                let to = ELFOUHAILY_TO.max(2.0 * from);
                Self::Elfouhaily { alpha: short_alpha(wind_speed.into()), from, to }
            }
        }
    }

    /// Density over frequency with the tail, at frequency `omega` and its wavenumber `k`; `spectrum` gives it without.
    pub(crate) fn apply(&self, omega: f64, k: f64, depth: Option<f64>, spectrum: impl Fn(f64, f64) -> f64) -> f64 {
        match *self {
            Self::OfSpectrum => spectrum(omega, k),
            Self::Donelan { start, .. } if omega <= start => spectrum(omega, k),
            Self::Donelan { start, k, bend } => {
                let ratio = start / omega;
                let fourth = ratio * ratio * ratio * ratio;
                spectrum(start, k) * fourth * (bend / omega).min(1.0)
            }
            Self::Elfouhaily { from, .. } if k <= from => spectrum(omega, k),
            Self::Elfouhaily { alpha, from, to } => {
                let x = (libm::log(k / from) / libm::log(to / from)).min(1.0);
                let share = x * x * (3.0 - 2.0 * x);
                let rest = if share < 1.0 { (1.0 - share) * spectrum(omega, k) } else { 0.0 };
                rest + share * short_curvature(alpha, k) / (k * k * k * dispersion::group_velocity(k, depth))
            }
        }
    }
}

/// Equilibrium parameter of the short waves by wind speed at 10 m (Elfouhaily et al. 1997, eq. 44), with the drag
/// coefficient `(.8 + .065 U) 10^-3` (Wu 1982). 0 where their logarithm is negative.
fn short_alpha(wind: f64) -> f64 {
    let friction_velocity = wind * (1e-3 * (0.8 + 0.065 * wind)).sqrt();
    let ln = libm::log(friction_velocity / SLOWEST);
    (0.01 * (1.0 + if ln > 0.0 { 3.0 * ln } else { ln })).max(0.0)
}

/// Curvature spectrum `k^3 S(k)` of the short waves, without dimension (their eqs. 40, 41; the peak's factors are 1 here).
fn short_curvature(alpha: f64, k: f64) -> f64 {
    let off = k / SLOWEST_K - 1.0;
    0.5 * alpha * SLOWEST / (dispersion::frequency(k, None) / k) * libm::exp(-0.25 * off * off)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_waves_saturate_as_published() {
        // By hand at U = 10 m/s: u* = 10 sqrt(.00145) = .3808 m/s, alpha_m = .01 (1 + 3 ln(.3808/.23)) = .02513, and at
        // the slowest wave (whose speed they round to .23) half of it.
        assert!((short_alpha(10.0) / 0.02513 - 1.0).abs() < 1e-3);
        assert!((short_curvature(short_alpha(10.0), 370.0) / (0.5 * 0.02513) - 1.0).abs() < 0.01);
        // Below u* = c_m/e nothing is left.
        assert_eq!(short_alpha(1.0), 0.0);
        assert!(short_alpha(5.0) > 0.0 && short_alpha(5.0) < 0.01);
    }
}

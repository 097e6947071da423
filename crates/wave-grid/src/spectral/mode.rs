//! What a step does to one wavenumber.
//!
//! `eta_t = T phi`, `phi_t = -g eta - sigma phi`, `T = k tanh(k h)`: linear waves over an even bed (Lamb, Hydrodynamics, 1932, art. 228),
//! solved exactly over any time. The 2 x 2 matrix of a step is written as three shears and a factor: shears keep areas however they are rounded, so
//! no wave gains or loses energy by the rounding of its own coefficients.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::desc::GRAVITY;

/// Water, and the time of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    /// Depth h, metres; may be infinite.
    pub(crate) depth: f64,
    /// sigma, 1/s.
    pub(crate) damping: f64,
    /// Seconds.
    pub(crate) dt: f64,
    /// Metres of head for which the potential is kept: P = phi / sqrt(g D). Both fields are then about as large in waves of
    /// some cells, and neither drowns in the other's rounding.
    pub(crate) cell: f64,
}

/// `e += first p; p -= second e; e += third p`, both times `gain`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Mode {
    pub(crate) first: f32,
    pub(crate) second: f32,
    pub(crate) third: f32,
    pub(crate) gain: f32,
}

impl Law {
    /// T, 1/m, of a wavenumber in 1/m.
    pub(super) fn t(&self, k: f64) -> f64 {
        if self.depth.is_finite() { k * libm::tanh(k * self.depth) } else { k }
    }

    /// sqrt(g D): phi over P.
    pub(crate) fn unit(&self) -> f64 {
        libm::sqrt(GRAVITY * self.cell)
    }

    /// a, b, c, d of `eta' = a eta + b P, P' = -c eta + d P` with a d + b c = 1, and the factor of both.
    fn matrix(&self, k: f64) -> ([f64; 4], f64) {
        let (t, half) = (self.t(k), 0.5 * self.damping);
        let square = GRAVITY * t - half * half;
        let w = libm::sqrt(square.abs());
        let (c, s) = if w * self.dt < 1e-9 {
            (1.0, self.dt)
        } else if square > 0.0 {
            (libm::cos(w * self.dt), libm::sin(w * self.dt) / w)
        } else {
            (libm::cosh(w * self.dt), libm::sinh(w * self.dt) / w)
        };
        let unit = self.unit();
        ([c + half * s, s * t * unit, s * GRAVITY / unit, c - half * s], libm::exp(-half * self.dt))
    }

    /// A step of a wavenumber in 1/m, times `scale`.
    pub(crate) fn mode(&self, k: f64, scale: f64) -> Mode {
        let ([mut a, _, mut c, mut d], mut gain) = self.matrix(k);
        // Beyond a quarter of a turn the shears are those of the turn less half of one.
        let w = libm::sqrt((GRAVITY * self.t(k) - 0.25 * self.damping * self.damping).max(0.0));
        if (w * self.dt + FRAC_PI_2).rem_euclid(2.0 * PI) >= PI {
            [a, c, d] = [-a, -c, -d];
            gain = -gain;
        }
        let shear = |x: f64| if c.abs() > 1e-12 { ((1.0 - x) / c) as f32 } else { 0.0 };
        Mode { first: shear(d), second: c as f32, third: shear(a), gain: (gain * scale) as f32 }
    }

    /// The potential P of waves that were `before` a step ago and are `now`: P = now times the first + before times the second.
    /// Waves that turn by nearly half a turn a step, and the mean, which have none to be found, get none.
    pub(crate) fn potential(&self, k: f64) -> [f64; 2] {
        let ([_, b, _, d], gain) = self.matrix(k);
        // The inverse has -b and d; over the time of a step waves of the least wavenumbers turn by little, but P counts.
        let least = 0.1 * self.dt * self.t(k) * self.unit();
        if b.abs() <= least || b == 0.0 { [0.0; 2] } else { [d / b, -1.0 / (b * gain)] }
    }
}

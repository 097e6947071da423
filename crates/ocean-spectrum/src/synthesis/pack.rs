//! Which field goes into which half of which complex transform.
//!
//! A complex inverse transform of `A + iB` with Hermitian A and B gives the real fields a and b in its real and
//! imaginary parts. Rounding is relative to the larger of the two, so a field of other units (a derivative, an
//! acceleration) is scaled by a power of two to about its partner's size, and back afterwards.

use std::f64::consts::TAU;

use fearless_simd::Simd;

use crate::synthesis::held::{Cell, State};
use crate::synthesis::lanes::{Complex, f32s};
use crate::{CascadeModes, OceanDesc};

/// The packing of one array of four fields.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pack {
    /// `Dx + i h`, `Dz + i scale dDx/dz`.
    Displacement { scale: f32 },
    /// `dh/dx + i dh/dz`, `dDx/dx + i dDz/dz`.
    Derivative,
    /// `dDx/dt + i dh/dt`, `dDz/dt + i scale d^2h/dt^2`.
    Velocity { scale: f32 },
}

impl Pack {
    pub(crate) fn all(modes: &CascadeModes, desc: &OceanDesc) -> [Self; 3] {
        // Means over the cascade's energy.
        let size = modes.size as usize;
        let (mut variance, mut k2, mut omega2) = (f64::MIN_POSITIVE, 0.0, 0.0);
        for (cell, (amp, &n)) in modes.amp.iter().zip(&modes.n).enumerate() {
            let power = f64::from(amp[0] * amp[0] + amp[1] * amp[1]);
            let k = |index: usize| f64::from(modes.signed(index as u32)) * modes.step();
            let (kx, kz) = (k(cell % size), k(cell / size));
            let omega = TAU * f64::from(n) / desc.loop_time;
            variance += power;
            k2 += power * (kx * kx + kz * kz);
            omega2 += power * omega * omega;
        }
        [
            Self::Displacement { scale: power_of_two((variance / k2).sqrt()) },
            Self::Derivative,
            Self::Velocity { scale: power_of_two((variance / omega2).sqrt()) },
        ]
    }

    /// Factor on the fourth field after the transform.
    pub(crate) fn unscale(self) -> f32 {
        match self {
            Self::Displacement { scale } | Self::Velocity { scale } => 1.0 / scale,
            Self::Derivative => 1.0,
        }
    }

    /// The inputs of both transforms. With `e = i k/|k|` per axis: `D = chop e h`, `grad h = i k h`.
    #[inline(always)]
    pub(crate) fn pair<S: Simd>(self, simd: S, chop: S::f32s, cell: &Cell<S>, now: &State<S>) -> [Complex<S>; 2] {
        let (kx, kz, unit) = (cell.kx, cell.kz, chop * cell.inverse_k);
        let one = f32s(simd, 1.0);
        match self {
            Self::Displacement { scale } => {
                let h = now.height.turned();
                let q = unit * kz * (one - f32s(simd, scale) * kx);
                [h.scaled(one + unit * kx), h.scaled(q)]
            }
            Self::Derivative => {
                // (i kx - kz) h and -(kx^2 + i kz^2) chop/k h
                let h = now.height;
                let first = h.turned().scaled(kx).sub(h.scaled(kz));
                let (p, q) = (unit * kx * kx, unit * kz * kz);
                [first, Complex { re: q * h.im - p * h.re, im: -(p * h.im) - q * h.re }]
            }
            Self::Velocity { scale } => {
                let v = now.velocity.turned();
                let a = now.acceleration.turned().scaled(f32s(simd, scale));
                [v.scaled(one + unit * kx), v.scaled(unit * kz).add(a)]
            }
        }
    }
}

fn power_of_two(x: f64) -> f32 {
    if x.is_finite() { libm::exp2(libm::round(libm::log2(x)).clamp(-30.0, 30.0)) as f32 } else { 1.0 }
}

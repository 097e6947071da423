//! Which field goes into which half of which complex transform.
//!
//! A complex inverse transform of `A + iB` with Hermitian A and B gives the real fields a and b in its real and
//! imaginary parts. Rounding is relative to the larger of the two, so a field of other units (a derivative, an
//! acceleration) is scaled by a power of two to about its partner's size, and back afterwards.

use std::f64::consts::TAU;
use std::ops::Range;

use crate::fft::{Complex, LANES};
use crate::held::Block;
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

    /// Fills a block of rows of both transforms, except the columns of `gap`, which hold no modes. With `e = i k/|k|`
    /// per axis: `D = chop e h`, `grad h = i k h`.
    pub(crate) fn fill(
        self,
        chop: f32,
        block: &Block,
        gap: &Range<usize>,
        first: &mut [Complex],
        second: &mut [Complex],
    ) {
        let (low, high) = (0..gap.start, gap.end..first.len());
        let columns = low.chain(high);
        let cells = block.kx.iter().zip(block.cells).zip(block.now);
        for (column, ((&kx, cell), now)) in columns.zip(cells) {
            let (first, second) = (&mut first[column], &mut second[column]);
            let ([h_re, h_im], [v_re, v_im], [a_re, a_im]) = (&now.h, &now.v, &now.a);
            match self {
                Self::Displacement { scale } => {
                    for l in 0..LANES {
                        let unit = chop * cell.inverse_k[l];
                        let p = 1.0 + unit * kx;
                        let q = unit * block.kz[l] * (1.0 - scale * kx);
                        // i times real times h
                        (first.re[l], first.im[l]) = (-p * h_im[l], p * h_re[l]);
                        (second.re[l], second.im[l]) = (-q * h_im[l], q * h_re[l]);
                    }
                }
                Self::Derivative => {
                    for l in 0..LANES {
                        let kz = block.kz[l];
                        // (i kx - kz) h and -(kx^2 + i kz^2) chop/k h
                        first.re[l] = -kx * h_im[l] - kz * h_re[l];
                        first.im[l] = kx * h_re[l] - kz * h_im[l];
                        let unit = chop * cell.inverse_k[l];
                        let (p, q) = (unit * kx * kx, unit * kz * kz);
                        second.re[l] = q * h_im[l] - p * h_re[l];
                        second.im[l] = -p * h_im[l] - q * h_re[l];
                    }
                }
                Self::Velocity { scale } => {
                    for l in 0..LANES {
                        let unit = chop * cell.inverse_k[l];
                        let p = 1.0 + unit * kx;
                        let q = unit * block.kz[l];
                        (first.re[l], first.im[l]) = (-p * v_im[l], p * v_re[l]);
                        second.re[l] = -scale * a_im[l] - q * v_im[l];
                        second.im[l] = q * v_re[l] + scale * a_re[l];
                    }
                }
            }
        }
    }
}

fn power_of_two(x: f64) -> f32 {
    if x.is_finite() { libm::exp2(libm::round(libm::log2(x)).clamp(-30.0, 30.0)) as f32 } else { 1.0 }
}

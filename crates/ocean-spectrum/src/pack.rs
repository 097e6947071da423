//! Which field goes into which half of which complex transform.
//!
//! A complex inverse transform of `A + iB` with Hermitian A and B gives the real fields a and b in its real and
//! imaginary parts. Rounding is relative to the larger of the two, so a field of other units (a derivative, an
//! acceleration) is scaled by a power of two to about its partner's size, and back afterwards.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex32;

use crate::{CascadeModes, OceanDesc};

/// A row of the propagated modes.
pub(crate) struct Row<'a> {
    pub(crate) kz: f32,
    pub(crate) kx: &'a [f32],
    pub(crate) inverse_k: &'a [f32],
    pub(crate) omega: &'a [f32],
    /// Height, real and imaginary part.
    pub(crate) h: [&'a [f32]; 2],
    /// Its rate.
    pub(crate) v: [&'a [f32]; 2],
}

/// The packing of one array of four fields.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pack {
    /// `Dx + i h`, `Dz + i scale dDx/dz`.
    Displacement { chop: f32, scale: f32 },
    /// `dh/dx + i dh/dz`, `dDx/dx + i dDz/dz`.
    Derivative { chop: f32 },
    /// `dDx/dt + i dh/dt`, `dDz/dt + i scale d^2h/dt^2`.
    Velocity { chop: f32, scale: f32 },
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
        let chop = desc.choppiness;
        [
            Self::Displacement { chop, scale: power_of_two((variance / k2).sqrt()) },
            Self::Derivative { chop },
            Self::Velocity { chop, scale: power_of_two((variance / omega2).sqrt()) },
        ]
    }

    /// Factor on the fourth field after the transform.
    pub(crate) fn unscale(self) -> f32 {
        match self {
            Self::Displacement { scale, .. } | Self::Velocity { scale, .. } => 1.0 / scale,
            Self::Derivative { .. } => 1.0,
        }
    }

    /// Fills a row of both transforms. With `e = i k/|k|` per axis: `D = chop e h`, `grad h = i k h`.
    pub(crate) fn fill(self, row: &Row, first: &mut [Complex32], second: &mut [Complex32]) {
        let width = row.kx.len();
        let (kx, inverse_k, omega) = (row.kx, &row.inverse_k[..width], &row.omega[..width]);
        let ([h_re, h_im], [v_re, v_im]) = (row.h, row.v);
        let (h_re, h_im, v_re, v_im) = (&h_re[..width], &h_im[..width], &v_re[..width], &v_im[..width]);
        let (first, second) = (&mut first[..width], &mut second[..width]);
        let kz = row.kz;
        match self {
            Self::Displacement { chop, scale } => {
                for i in 0..width {
                    let unit = chop * inverse_k[i];
                    let p = 1.0 + unit * kx[i];
                    let q = unit * kz * (1.0 - scale * kx[i]);
                    // i times real times h
                    first[i] = Complex32::new(-p * h_im[i], p * h_re[i]);
                    second[i] = Complex32::new(-q * h_im[i], q * h_re[i]);
                }
            }
            Self::Derivative { chop } => {
                for i in 0..width {
                    // (i kx - kz) h and -(kx^2 + i kz^2) chop/k h
                    first[i] = Complex32::new(-kx[i] * h_im[i] - kz * h_re[i], kx[i] * h_re[i] - kz * h_im[i]);
                    let unit = chop * inverse_k[i];
                    let (p, q) = (unit * kx[i] * kx[i], unit * kz * kz);
                    second[i] = Complex32::new(q * h_im[i] - p * h_re[i], -p * h_im[i] - q * h_re[i]);
                }
            }
            Self::Velocity { chop, scale } => {
                for i in 0..width {
                    let unit = chop * inverse_k[i];
                    let p = 1.0 + unit * kx[i];
                    let (q, r) = (unit * kz, scale * omega[i] * omega[i]);
                    first[i] = Complex32::new(-p * v_im[i], p * v_re[i]);
                    second[i] = Complex32::new(r * h_im[i] - q * v_im[i], q * v_re[i] - r * h_re[i]);
                }
            }
        }
    }
}

fn power_of_two(x: f64) -> f32 {
    if x.is_finite() { libm::exp2(libm::round(libm::log2(x)).clamp(-30.0, 30.0)) as f32 } else { 1.0 }
}

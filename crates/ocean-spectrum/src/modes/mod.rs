//! From the spectrum to the modes of each cascade: bands, amplitudes, phases, quantised frequencies.
//!
//! Everything here depends on the sea, the seed, the tiles and the loop time, not on the FFT sizes: a smaller FFT holds
//! a subset of the same modes.

pub(crate) mod change;
pub(crate) mod join;
pub(crate) mod moment;
pub(crate) mod random;
pub(crate) mod recipe;
pub(crate) mod set;
pub(crate) mod tiles;

use std::f64::consts::TAU;

use rayon::prelude::*;

use crate::sea::spectrum::WaveSpectrum;
use crate::{CascadeDesc, dispersion};

/// Waves of a shorter cascade start where this many of them fit its tile: enough to resolve their directions and not to
/// show the tile, while the longer cascade, at a ratio of 6.7 and a size of 256, still has 6.3 texels per wavelength
/// there, where the cubic kernel loses at most 2 % of them (6 % at 4.7).
pub(crate) const BAND_START: f64 = 6.0;

/// How the amplitude of a mode follows from the variance of its cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Amplitudes {
    /// Each wave is as high as the mean of its kind, only its phase is random: every seed has the wave height described.
    #[default]
    Unit,
    /// Height and phase are random (complex normal), as in a real sea: the wave height of a seed differs from the one
    /// described, by 6 to 16 % on tiles of 3 to 1.5 peak wavelengths; only the mean square over seeds is right.
    Gaussian,
}

/// The modes of one cascade, in FFT order: cell `(i, j)` at `j * size + i` has the wavevector `2 pi/tile (i', j')` with
/// `i' = i` below `size/2`, else `i - size`. Mean (0, 0) and Nyquist rows and columns (`size/2`) are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct CascadeModes {
    /// Cells per side, a power of two.
    pub size: u32,
    /// Side of the tile, metres.
    pub tile: f32,
    /// Half-open band of wavenumbers `[from, to)`, rad/m. Bands of a sea's cascades touch and do not overlap; the
    /// first starts at 0, the last ends at infinity. A cell that a bound cuts holds the variance of its part inside.
    pub band: [f64; 2],
    /// `(re h0(k), im h0(k), re conj h0(-k), im conj h0(-k))`, metres: `h(k, t) = h0(k) e^(-i omega t) + conj(h0(-k))
    /// e^(i omega t)`, and the height is the sum of `h(k, t) e^(i k.x)` over all cells.
    pub amp: Vec<[f32; 4]>,
    /// Turns per loop: `omega = 2 pi n / loop_time`.
    pub n: Vec<u32>,
}

impl CascadeModes {
    /// Wavenumber step of the cells, rad/m.
    pub fn step(&self) -> f64 {
        TAU / f64::from(self.tile)
    }

    /// Signed integer wavevector component of an FFT index.
    pub fn signed(&self, index: u32) -> i32 {
        signed(index, self.size)
    }

    /// Variance of the height over the tile and all times, m^2.
    pub fn variance(&self) -> f64 {
        let square = |x: f32| f64::from(x) * f64::from(x);
        2.0 * self.amp.iter().map(|a| square(a[0]) + square(a[1])).sum::<f64>()
    }
}

pub(crate) fn signed(index: u32, size: u32) -> i32 {
    if index < size / 2 { index as i32 } else { index as i32 - size as i32 }
}

/// Bands of the cascades, longest first. The first starts at 0: it takes all waves that its tile holds. The last has no
/// end but that of its array, so that the amplitudes of the cells that two sizes hold are equal.
pub(crate) fn bands(cascades: &[CascadeDesc]) -> Vec<[f64; 2]> {
    let start = |c: &CascadeDesc| BAND_START * TAU / f64::from(c.tile);
    (0..cascades.len())
        .map(|c| {
            let from = if c == 0 { 0.0 } else { start(&cascades[c]) };
            [from, cascades.get(c + 1).map_or(f64::INFINITY, start)]
        })
        .collect()
}

/// Makes the modes of cascade `index`.
pub(crate) fn build(
    spectrum: &WaveSpectrum,
    desc: CascadeDesc,
    band: [f64; 2],
    index: usize,
    seed: u64,
    loop_time: f64,
    amplitudes: Amplitudes,
) -> CascadeModes {
    let size = desc.size as usize;
    let step = TAU / f64::from(desc.tile);
    let mut h0 = vec![[0.0f32; 2]; size * size];
    let mut n = vec![0u32; size * size];
    h0.par_chunks_mut(size).zip(n.par_chunks_mut(size)).enumerate().for_each(|(row, (h0, n))| {
        let j = signed(row as u32, desc.size);
        for (column, (h0, n)) in h0.iter_mut().zip(n).enumerate() {
            let i = signed(column as u32, desc.size);
            let nyquist = row == size / 2 || column == size / 2;
            if nyquist || (i, j) == (0, 0) || !may_hold(i, j, step, band) {
                continue;
            }
            // Each of h0(k) and conj(h0(-k)) carries half of a wave's amplitude: its variance is 2 |h0|^2.
            let (phase, chance) = random::mode(seed, index, i, j);
            let mut modulus = (0.5 * cell_variance(spectrum, i, j, step, band)).sqrt();
            if amplitudes == Amplitudes::Gaussian {
                // The square of a complex normal number is distributed exponentially.
                modulus *= (-libm::log((f64::from(chance) + 0.5) / 4_294_967_296.0)).sqrt();
            }
            let turns = f64::from(phase) / 4_294_967_296.0;
            let (sin, cos) = libm::sincos(TAU * turns);
            *h0 = [(modulus * cos) as f32, (modulus * sin) as f32];
            let k = step * f64::from(i * i + j * j).sqrt();
            *n = turns_per_loop(dispersion::frequency(k, spectrum.depth()), loop_time);
        }
    });
    let amp = (0..size * size)
        .map(|cell| {
            let mirror = ((size - cell / size) % size) * size + (size - cell % size) % size;
            [h0[cell][0], h0[cell][1], h0[mirror][0], -h0[mirror][1]]
        })
        .collect();
    CascadeModes { size: desc.size, tile: desc.tile, band, amp, n }
}

/// Nearest whole number of turns, at least 1.
fn turns_per_loop(omega: f64, loop_time: f64) -> u32 {
    libm::round(omega * loop_time / TAU).max(1.0) as u32
}

/// Whether the cell's square can touch the band.
fn may_hold(i: i32, j: i32, step: f64, band: [f64; 2]) -> bool {
    let k = step * f64::from(i * i + j * j).sqrt();
    let half_diagonal = 0.708 * step;
    k + half_diagonal >= band[0] && k - half_diagonal < band[1]
}

/// Variance of the part of a cell inside the band: the mean over sub-cells, many where the cell is wide against its
/// wavenumber.
fn cell_variance(spectrum: &WaveSpectrum, i: i32, j: i32, step: f64, band: [f64; 2]) -> f64 {
    let sub = match i.abs().max(j.abs()) {
        0..=8 => 16,
        9..=64 => 4,
        _ => 2,
    };
    let mut sum = 0.0;
    for b in 0..sub {
        let kz = step * (f64::from(j) + (f64::from(b) + 0.5) / f64::from(sub) - 0.5);
        for a in 0..sub {
            let kx = step * (f64::from(i) + (f64::from(a) + 0.5) / f64::from(sub) - 0.5);
            let k = (kx * kx + kz * kz).sqrt();
            if band[0] <= k && k < band[1] {
                sum += spectrum.wavenumber_density(kx, kz);
            }
        }
    }
    sum * step * step / f64::from(sub * sub)
}

//! What the sea loses over shallow water, cascade by cascade, and where its energy goes.

use std::f64::consts::{PI, TAU};

use crate::{CascadeFactors, CascadeModes, Ocean, dispersion};

/// Largest significant wave height over depth: waves break above.
pub const BREAKING_HEIGHT: f64 = 0.78;
/// Bins of frequency that the modes of a cascade are gathered in.
const BINS: usize = 96;
/// Steps in wavenumber, and sub-steps in a sector of direction, of [`Ocean::directional_energy`].
const STEPS: u32 = 96;
const SUB_STEPS: u32 = 8;

/// Variance of a cascade by frequency.
pub(crate) struct Frequencies(Vec<Bin>);

#[derive(Clone, Copy, Default)]
struct Bin {
    /// Mean frequency, weighted by variance, rad/s.
    omega: f64,
    variance: f64,
}

impl Frequencies {
    /// Of one cascade given twice, or the mixed terms of two with equal frequencies.
    pub(crate) fn of(modes: &CascadeModes, other: &CascadeModes, loop_time: f64) -> Self {
        let held = modes.n.iter().filter(|&&n| n != 0);
        let (low, high) = held.fold((u32::MAX, 1), |(low, high), &n| (low.min(n), high.max(n)));
        let scale = BINS as f64 / libm::log(f64::from(high) / f64::from(low.min(high)) + 1e-9).max(1e-9);
        let mut bins = vec![Bin::default(); BINS];
        // Consecutive modes often share their frequency; the logarithm is dear.
        let mut last = (0, 0);
        for ((a, b), &n) in modes.amp.iter().zip(&other.amp).zip(&modes.n).filter(|(_, n)| **n != 0) {
            if last.0 != n {
                let bin = libm::log(f64::from(n) / f64::from(low)) * scale;
                last = (n, (bin as usize).min(BINS - 1));
            }
            let power = 2.0 * (f64::from(a[0]) * f64::from(b[0]) + f64::from(a[1]) * f64::from(b[1]));
            bins[last.1].variance += power;
            bins[last.1].omega += power * TAU * f64::from(n) / loop_time;
        }
        bins.retain(|bin| bin.variance > 0.0);
        for bin in &mut bins {
            bin.omega /= bin.variance;
        }
        Self(bins)
    }

    /// `(variance, variance times weight(omega))`.
    fn weighted(&self, weight: impl Fn(f64) -> f64) -> (f64, f64) {
        self.0
            .iter()
            .fold((0.0, 0.0), |(sum, weighted), bin| (sum + bin.variance, weighted + bin.variance * weight(bin.omega)))
    }
}

/// Share of the variance of deep water that is left at angular frequency `omega` (rad/s) over `depth` metres (`None`:
/// deep): `tanh^2(kh) / (1 + 2kh/sinh 2kh)` (Kitaigorodskii et al. 1975), which makes a JONSWAP spectrum TMA (Bouws et
/// al. 1985).
pub fn depth_share(omega: f64, depth: Option<f64>) -> f64 {
    let Some(h) = depth else { return 1.0 };
    share_at(dispersion::wavenumber(omega, depth) * h)
}

/// The same by wavenumber times depth.
pub(crate) fn share_at(kh: f64) -> f64 {
    // Deep enough that nothing is left to lose in an f64.
    if kh > 20.0 {
        return 1.0;
    }
    let t = libm::tanh(kh);
    t * t / (1.0 + 2.0 * kh / libm::sinh(2.0 * kh))
}

impl Ocean {
    /// Factors on the amplitude of each cascade over water of another depth, metres: the root of TMA there over TMA at
    /// the sea's own depth, from the variance of the cascade's modes; then all are lessened alike until the significant
    /// height is at most [`BREAKING_HEIGHT`] of the depth. 0 for a depth that is not above 0, at most 4; 1 for cascades
    /// the sea does not have.
    ///
    /// The factors of a place depend on nothing but its depth, so tabulate: this is some thousand transcendental
    /// functions.
    pub fn depth_factors(&self, depth: f32) -> CascadeFactors {
        let mut factors = [1.0f32; 8];
        let cascades = self.modes().len();
        if depth.is_nan() || depth <= 0.0 {
            factors[..cascades].fill(0.0);
            return factors;
        }
        // Below a millimetre k h is not worth computing: everything breaks.
        let here = (depth < 20e3).then_some(f64::from(depth).max(1e-3));
        let mut left = 0.0;
        for (c, factor) in factors[..cascades].iter_mut().enumerate() {
            let (mut variance, mut kept) = (0.0, 0.0);
            for (weight, frequencies, sea) in self.frequencies(c) {
                let (all, left) =
                    frequencies.weighted(|omega| depth_share(omega, here) / depth_share(omega, sea).max(1e-12));
                variance += weight * all;
                kept += weight * left;
            }
            if variance > 0.0 {
                *factor = (kept / variance).sqrt().min(4.0) as f32;
                left += f64::from(*factor) * f64::from(*factor) * variance;
            }
        }
        let height = 4.0 * left.sqrt();
        let most = BREAKING_HEIGHT * f64::from(depth);
        if height > most {
            for factor in &mut factors[..cascades] {
                *factor *= (most / height) as f32;
            }
        }
        factors
    }

    /// Share of a cascade's variance that travels towards each of `sectors` equal sectors, the centre of sector `i` at
    /// `2 pi i/sectors` radians (towards `(cos, sin)` in (x, z)); from the spectrum within the cascade's band. Sums to 1;
    /// all alike for a cascade without waves, or that the sea does not have.
    pub fn directional_energy(&self, cascade: usize, sectors: usize) -> Vec<f32> {
        let mut energy = vec![0.0; sectors];
        if let Some(modes) = self.modes().get(cascade) {
            let low = modes.band[0].max(0.5 * modes.step());
            let high = modes.band[1].min(PI * f64::from(modes.size) / f64::from(modes.tile));
            let ratio = libm::log(high / low).max(0.0) / f64::from(STEPS);
            for step in 0..STEPS {
                let k = low * libm::exp(ratio * (f64::from(step) + 0.5));
                for (i, energy) in energy.iter_mut().enumerate() {
                    for sub in 0..SUB_STEPS {
                        let within = (f64::from(sub) + 0.5) / f64::from(SUB_STEPS) - 0.5;
                        let (sin, cos) = libm::sincos(TAU * (i as f64 + within) / sectors as f64);
                        *energy += k * k * self.wavenumber_density(k * cos, k * sin);
                    }
                }
            }
        }
        let sum: f64 = energy.iter().sum();
        let share = |energy: &f64| if sum > 0.0 { energy / sum } else { 1.0 / sectors as f64 };
        energy.iter().map(|energy| share(energy) as f32).collect()
    }
}

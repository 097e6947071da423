//! What the cases hold the library against, written from the textbook: closed forms and direct sums in f64.

use std::f64::consts::{PI, TAU};

use ocean_spectrum::CascadeModes;

pub mod decay;
pub mod diffraction;
pub mod wedge;

/// Gravity, m/s^2.
pub const G: f64 = 9.81;

/// The fields of a surface at a rest position, in the order of `CascadeFields`: displacement, derivative, velocity.
pub type Fields = [f64; 12];

/// Plane waves `a cos(k.x - omega t + phase)`, summed one by one.
pub struct Waves {
    waves: Vec<Wave>,
    choppiness: f64,
}

struct Wave {
    kx: f64,
    kz: f64,
    omega: f64,
    amplitude: f64,
    phase: f64,
}

impl Waves {
    /// The waves that the modes stand for.
    pub fn of(modes: &[CascadeModes], choppiness: f32, loop_time: f64) -> Self {
        let mut waves = Vec::new();
        for cascade in modes {
            let size = cascade.size as usize;
            let signed = |i: usize| if i < size / 2 { i as f64 } else { i as f64 - size as f64 };
            let step = TAU / f64::from(cascade.tile);
            for (cell, (amp, n)) in cascade.amp.iter().zip(&cascade.n).enumerate() {
                let (re, im) = (f64::from(amp[0]), f64::from(amp[1]));
                if (re, im) == (0.0, 0.0) {
                    continue;
                }
                waves.push(Wave {
                    kx: step * signed(cell % size),
                    kz: step * signed(cell / size),
                    omega: TAU * f64::from(*n) / loop_time,
                    // The cells of k and -k hold half of the wave each.
                    amplitude: 2.0 * re.hypot(im),
                    phase: im.atan2(re),
                });
            }
        }
        Self { waves, choppiness: f64::from(choppiness) }
    }

    /// The sum at a rest position (m) and a time (s).
    pub fn at(&self, x: f64, z: f64, t: f64) -> Fields {
        let mut sum = [0.0; 12];
        for wave in &self.waves {
            let Wave { kx, kz, omega, amplitude, phase } = *wave;
            let (sin, cos) = (kx * x + kz * z - omega * t + phase).sin_cos();
            let k = kx.hypot(kz);
            let (dx, dz) = (self.choppiness * kx / k, self.choppiness * kz / k);
            let (s, c) = (amplitude * sin, amplitude * cos);
            let terms = [
                -dx * s,
                c,
                -dz * s,
                -dx * kz * c,
                -kx * s,
                -kz * s,
                -dx * kx * c,
                -dz * kz * c,
                dx * omega * c,
                omega * s,
                dz * omega * c,
                -omega * omega * c,
            ];
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        sum
    }

    /// Height over a world point: the horizontal displacement taken back by repeated substitution with halving steps.
    pub fn height_over(&self, x: f64, z: f64, t: f64) -> f64 {
        let (mut rest_x, mut rest_z) = (x, z);
        let mut fields = self.at(rest_x, rest_z, t);
        for _ in 0..30 {
            let (miss_x, miss_z) = (rest_x + fields[0] - x, rest_z + fields[2] - z);
            if miss_x.hypot(miss_z) < 1e-9 {
                break;
            }
            // Newton's step with the Jacobian of rest + D(rest).
            let (a, b, d) = (1.0 + fields[6], fields[3], 1.0 + fields[7]);
            let determinant = (a * d - b * b).max(0.05);
            rest_x -= (d * miss_x - b * miss_z) / determinant;
            rest_z -= (a * miss_z - b * miss_x) / determinant;
            fields = self.at(rest_x, rest_z, t);
        }
        fields[1]
    }
}

/// A JONSWAP sea by wind speed at 10 m (m/s) and fetch (m), gamma 3.3 (Hasselmann et al. 1973).
pub struct Jonswap {
    alpha: f64,
    /// Angular frequency of the peak, rad/s.
    pub peak: f64,
}

impl Jonswap {
    /// The spectrum of that wind and fetch.
    pub fn new(wind: f64, fetch: f64) -> Self {
        Self { alpha: 0.076 * (wind * wind / (fetch * G)).powf(0.22), peak: 22.0 * (G * G / (wind * fetch)).cbrt() }
    }

    /// Variance density over angular frequency, m^2 s.
    pub fn density(&self, omega: f64) -> f64 {
        let sigma: f64 = if omega <= self.peak { 0.07 } else { 0.09 };
        let r = (-(omega / self.peak - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
        self.alpha * G * G * omega.powi(-5) * (-1.25 * (self.peak / omega).powi(4)).exp() * 3.3f64.powf(r)
    }

    /// Variance of the height, m^2, by the midpoint rule to 100 times the peak and the tail's integral beyond.
    pub fn variance(&self) -> f64 {
        let (steps, end) = (200_000, 100.0 * self.peak);
        let step = end / f64::from(steps);
        let body: f64 = (0..steps).map(|i| self.density((f64::from(i) + 0.5) * step)).sum::<f64>() * step;
        body + self.alpha * G * G / (4.0 * end.powi(4))
    }

    /// Length of the waves at the peak in deep water, m.
    pub fn peak_wavelength(&self) -> f64 {
        TAU * G / (self.peak * self.peak)
    }
}

/// Draft of a floating sphere that displaces `volume`: the cap of height d has `pi d^2 (3 r - d)/3`.
pub fn sphere_draft(radius: f64, volume: f64) -> f64 {
    bisect(0.0, 2.0 * radius, |d| PI * d * d * (3.0 * radius - d) / 3.0 - volume)
}

/// Draft of a lying cylinder whose cross-section displaces `area`: a circular segment.
pub fn cylinder_draft(radius: f64, area: f64) -> f64 {
    bisect(0.0, 2.0 * radius, |d| {
        let half = (1.0 - d / radius).acos();
        radius * radius * (half - half.sin() * half.cos()) - area
    })
}

/// Root of a rising function.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jonswap_agrees_with_published_figures() {
        for (wind, fetch, peak, height) in [(10.0, 100e3, 1.008, 2.139), (20.0, 300e3, 0.555, 7.288)] {
            let sea = Jonswap::new(wind, fetch);
            assert!((sea.peak - peak).abs() < 1e-3, "{}", sea.peak);
            assert!((4.0 * sea.variance().sqrt() / height - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn half_immersed_round_bodies() {
        assert!((sphere_draft(2.0, 16.0 / 3.0 * PI) - 2.0).abs() < 1e-9);
        assert!((cylinder_draft(2.0, TAU) - 2.0).abs() < 1e-9);
    }
}

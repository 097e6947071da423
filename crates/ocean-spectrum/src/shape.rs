//! One partition prepared for evaluation: constants computed once, then density over frequency and direction.

use std::f64::consts::{PI, TAU};

use crate::dispersion;
use crate::sea::{Partition, Spectrum, Spreading, TableRow};
use crate::{GRAVITY, Notice};

/// A partition with its constants.
pub(crate) struct Shape {
    density: Density,
    towards: [f64; 2],
    spread: Spread,
}

enum Density {
    /// `scale omega^-5 exp(-5/4 (peak/omega)^4) gamma^r`; Pierson-Moskowitz and both forms of JONSWAP.
    Peaked { scale: f64, peak: f64, ln_gamma: f64 },
    /// `variance (2/L^2) exp(-1/(kL)^2)/k^3` over k.
    Phillips { variance: f64, length: f64, depth: Option<f64> },
    /// Rows with omega ascending.
    Table(Vec<Row>),
}

struct Row {
    omega: f64,
    density: f64,
    towards: [f64; 2],
    spread: Spread,
}

#[derive(Clone, Copy)]
enum Spread {
    Cos2s { s: f64, ln_norm: f64 },
    BothWays,
}

impl Spread {
    fn cos2s(s: f64) -> Self {
        // Q = 2^(2s-1) Gamma(s+1)^2 / (pi Gamma(2s+1)), in logarithms so that large s does not overflow.
        let ln2 = std::f64::consts::LN_2;
        let ln_norm = (2.0 * s - 1.0) * ln2 + 2.0 * libm::lgamma(s + 1.0) - libm::lgamma(2.0 * s + 1.0) - libm::log(PI);
        Self::Cos2s { s, ln_norm }
    }

    fn of(spreading: Spreading) -> Self {
        match spreading {
            Spreading::Cos2s { s } => Self::cos2s(s.into()),
            Spreading::BothWays => Self::BothWays,
        }
    }

    /// Density per radian at the angle whose cosine is `c`.
    fn at(self, c: f64) -> f64 {
        match self {
            // cos^2(theta/2) = (1 + cos theta)/2, kept off 0 for the logarithm.
            Self::Cos2s { s, ln_norm } => libm::exp(ln_norm + s * libm::log((0.5 * (1.0 + c)).max(1e-300))),
            Self::BothWays => c * c / PI,
        }
    }
}

impl Shape {
    pub(crate) fn new(partition: &Partition, depth: Option<f64>, notices: &mut Vec<Notice>) -> Self {
        let density = match &partition.spectrum {
            &Spectrum::Phillips { wind_speed, significant_height } => {
                let u = f64::from(wind_speed);
                let hs = f64::from(significant_height);
                Density::Phillips { variance: hs * hs / 16.0, length: u * u / GRAVITY, depth }
            }
            &Spectrum::PiersonMoskowitz { wind_speed } => {
                // exp(-.74 (g/(U omega))^4) has its peak at (.74 * 4/5)^(1/4) g/U.
                let peak = libm::pow(0.74 * 0.8, 0.25) * GRAVITY / f64::from(wind_speed);
                Density::Peaked { scale: 0.0081 * GRAVITY * GRAVITY, peak, ln_gamma: 0.0 }
            }
            &Spectrum::JonswapFetch { wind_speed, fetch } => fetch_limited(wind_speed.into(), fetch.into(), notices),
            &Spectrum::Jonswap { significant_height, peak_period, gamma } => {
                let hs = f64::from(significant_height);
                let peak = TAU / f64::from(peak_period);
                let ln_gamma = libm::log(gamma.into());
                let unit = Density::Peaked { scale: 1.0, peak, ln_gamma };
                let scale = hs * hs / 16.0 / unit.variance_around(peak);
                Density::Peaked { scale, peak, ln_gamma }
            }
            Spectrum::Table(rows) => Density::Table(rows.iter().map(row).collect()),
        };
        Self { density, towards: unit(partition.direction), spread: Spread::of(partition.spreading) }
    }

    /// Variance density over angular frequency, m^2 s/rad.
    pub(crate) fn density(&self, omega: f64) -> f64 {
        self.density.at(omega)
    }

    /// Variance density over angular frequency and direction, m^2 s/rad^2, towards the unit vector `(x, z)`.
    pub(crate) fn directional(&self, omega: f64, x: f64, z: f64) -> f64 {
        let toward = |t: &[f64; 2]| (t[0] * x + t[1] * z).clamp(-1.0, 1.0);
        if let Density::Table(rows) = &self.density {
            let (i, t) = locate(rows, omega);
            let Some(a) = rows.get(i) else { return 0.0 };
            let b = &rows[(i + 1).min(rows.len() - 1)];
            // The mean of two spreadings has integral 1 too; one with mean parameters would not be the measured one.
            let spread = (1.0 - t) * a.spread.at(toward(&a.towards)) + t * b.spread.at(toward(&b.towards));
            return self.density.at(omega) * spread;
        }
        self.density.at(omega) * self.spread.at(toward(&self.towards))
    }
}

impl Density {
    fn at(&self, omega: f64) -> f64 {
        match self {
            &Self::Peaked { scale, peak, ln_gamma } => {
                let ratio = peak / omega;
                let r4 = ratio * ratio * ratio * ratio;
                let w2 = omega * omega;
                let sigma = if omega <= peak { 0.07 } else { 0.09 };
                let off = (omega - peak) / (sigma * peak);
                let enhanced = if ln_gamma > 0.0 { ln_gamma * libm::exp(-0.5 * off * off) } else { 0.0 };
                scale / (w2 * w2 * omega) * libm::exp(enhanced - 1.25 * r4)
            }
            &Self::Phillips { variance, length, depth } => {
                let k = dispersion::wavenumber(omega, depth);
                let kl = k * length;
                let over_k = variance * 2.0 / (length * length) * libm::exp(-1.0 / (kl * kl)) / (k * k * k);
                over_k / dispersion::group_velocity(k, depth)
            }
            Self::Table(rows) => {
                let (i, t) = locate(rows, omega);
                let Some(a) = rows.get(i) else { return 0.0 };
                match rows.get(i + 1) {
                    Some(b) => (1.0 - t) * a.density + t * b.density,
                    None => a.density * libm::pow(a.omega / omega, 5.0),
                }
            }
        }
    }

    /// Integral of a peaked density by the trapezium rule, fine against its peak width, with the omega^-5 tail
    /// (where the exponential is within 1e-7 of 1) added in closed form.
    fn variance_around(&self, peak: f64) -> f64 {
        let n = 60_000;
        let (low, high) = (0.3 * peak, 60.0 * peak);
        let step = (high - low) / f64::from(n);
        let sum: f64 = (1..n).map(|i| self.at(low + step * f64::from(i))).sum();
        let ends = 0.5 * (self.at(low) + self.at(high));
        (sum + ends) * step + self.at(high) * high / 4.0
    }
}

fn fetch_limited(u: f64, fetch: f64, notices: &mut Vec<Notice>) -> Density {
    let limit = 1.7e4 * u * u / GRAVITY;
    if fetch > limit {
        notices.push(Notice::FetchClamped { given: fetch, used: limit });
    }
    let fetch = fetch.min(limit);
    let alpha = 0.076 * libm::pow(u * u / (fetch * GRAVITY), 0.22);
    let peak = 22.0 * libm::cbrt(GRAVITY * GRAVITY / (u * fetch));
    Density::Peaked { scale: alpha * GRAVITY * GRAVITY, peak, ln_gamma: libm::log(3.3) }
}

fn unit(angle: f32) -> [f64; 2] {
    let (z, x) = libm::sincos(angle.into());
    [x, z]
}

fn row(row: &TableRow) -> Row {
    Row {
        omega: TAU * f64::from(row.frequency),
        density: f64::from(row.density) / TAU,
        towards: unit(row.direction),
        spread: Spread::cos2s(row.s.into()),
    }
}

/// Index of the row at or below `omega` and the fraction towards the next; `usize::MAX` below the first.
fn locate(rows: &[Row], omega: f64) -> (usize, f64) {
    let after = rows.partition_point(|row| row.omega <= omega);
    let i = after.wrapping_sub(1);
    match (rows.get(i), rows.get(after)) {
        (Some(a), Some(b)) => (i, (omega - a.omega) / (b.omega - a.omega)),
        _ => (i, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreading_integrates_to_one() {
        for spread in [0.0, 0.5, 1.0, 6.0, 25.0, 100.0, 1000.0].map(Spread::cos2s).into_iter().chain([Spread::BothWays])
        {
            let n = 20_000;
            let sum: f64 = (0..n).map(|i| spread.at((TAU * f64::from(i) / f64::from(n)).cos())).sum();
            let integral = sum * TAU / f64::from(n);
            assert!((integral - 1.0).abs() < 1e-8, "{integral}");
        }
    }

    #[test]
    fn spreading_has_its_circular_deviation() {
        // Mean of cos(theta) under cos^2s is s/(s+1).
        let n = 20_000;
        let angles = (0..n).map(|i| TAU * f64::from(i) / f64::from(n));
        let spread = Spread::cos2s(6.0);
        let mean: f64 = angles.map(|a| spread.at(a.cos()) * a.cos()).sum::<f64>() * TAU / f64::from(n);
        assert!((mean - 6.0 / 7.0).abs() < 1e-9);
    }
}

//! One partition prepared for evaluation: constants computed once, then density over frequency and direction.

use std::f64::consts::TAU;

use crate::sea::partition::{Partition, Spectrum, TableRow};
use crate::sea::plane::Plane;
use crate::sea::shoal::share_at;
use crate::sea::spreading::{Cos2s, Spread};
use crate::sea::tail::Prepared;
use crate::{GRAVITY, Notice, dispersion};

/// A partition with its constants.
pub(crate) struct Shape {
    density: Density,
    tail: Prepared,
    /// Depth of the sea, metres, and whether it takes its share.
    depth: Option<f64>,
    limited: bool,
    towards: [f64; 2],
    spread: Spread,
}

enum Density {
    /// `scale omega^-5 exp(-5/4 (peak/omega)^4) gamma^r`; Pierson-Moskowitz and both forms of JONSWAP.
    Peaked {
        scale: f64,
        peak: f64,
        ln_gamma: f64,
    },
    /// `variance (2/L^2) exp(-1/(kL)^2)/k^3` over k.
    Phillips {
        variance: f64,
        length: f64,
        depth: Option<f64>,
    },
    /// Rows with omega ascending.
    Table(Vec<Row>),
    Plane(Plane),
}

struct Row {
    omega: f64,
    density: f64,
    towards: [f64; 2],
    spread: Cos2s,
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
                let scale =
                    hs * hs / 16.0 / unit.variance_around(peak, &Prepared::new(partition.tail, peak, 0.0, depth));
                Density::Peaked { scale, peak, ln_gamma }
            }
            Spectrum::Table(rows) => Density::Table(rows.iter().map(row).collect()),
            Spectrum::Directional(table) => Density::Plane(Plane::new(table)),
        };
        let (peak, known) = density.peak();
        Self {
            tail: Prepared::new(partition.tail, peak, known, depth),
            depth,
            limited: partition.depth_limited,
            towards: unit(partition.direction),
            spread: Spread::of(partition.spreading, partition.elongation, peak),
            density,
        }
    }

    /// Variance density over angular frequency, m^2 s/rad, at a frequency (rad/s) and its wavenumber (rad/m).
    pub(crate) fn density(&self, omega: f64, k: f64) -> f64 {
        let open = self.tail.apply(omega, k, self.depth, |omega, k| self.density.at(omega, k));
        match self.depth {
            Some(depth) if self.limited => open * share_at(k * depth),
            _ => open,
        }
    }

    /// Variance density over angular frequency and direction, m^2 s/rad^2, towards the unit vector `(x, z)`.
    pub(crate) fn directional(&self, omega: f64, k: f64, x: f64, z: f64) -> f64 {
        let toward = |t: &[f64; 2]| (t[0] * x + t[1] * z).clamp(-1.0, 1.0);
        let spread = match &self.density {
            Density::Table(rows) => {
                let (i, t) = locate(rows, omega);
                let Some(a) = rows.get(i) else { return 0.0 };
                let b = &rows[(i + 1).min(rows.len() - 1)];
                // The mean of two spreadings has integral 1 too; one with mean parameters would not be the measured one.
                (1.0 - t) * a.spread.at(toward(&a.towards)) + t * b.spread.at(toward(&b.towards))
            }
            Density::Plane(plane) => plane.spread(omega, x, z),
            _ => self.spread.at(omega, toward(&self.towards)),
        };
        self.density(omega, k) * spread
    }
}

impl Density {
    fn at(&self, omega: f64, k: f64) -> f64 {
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
            Self::Plane(plane) => plane.density(omega),
        }
    }

    /// Frequency of the peak over deep water, and up to which the density is measured (0: not at all), rad/s.
    fn peak(&self) -> (f64, f64) {
        match self {
            &Self::Peaked { peak, .. } => (peak, 0.0),
            // omega^-5 exp(-(g/(U omega))^4) has its peak at (4/5)^(1/4) g/U, and g/U = sqrt(g/L).
            &Self::Phillips { length, .. } => (libm::pow(0.8, 0.25) * (GRAVITY / length).sqrt(), 0.0),
            Self::Table(rows) => {
                let highest = |best: (f64, f64), row: &Row| {
                    if row.density > best.1 { (row.omega, row.density) } else { best }
                };
                (rows.iter().fold((1.0, 0.0), highest).0, rows.last().map_or(0.0, |row| row.omega))
            }
            Self::Plane(plane) => (plane.peak(), plane.last()),
        }
    }

    /// Integral of a peaked density by the trapezium rule, fine against its peak width, with the omega^-5 tail
    /// (where the exponential is within 1e-7 of 1) added in closed form. A tail that does not scale with the density
    /// holds too little to count.
    fn variance_around(&self, peak: f64, tail: &Prepared) -> f64 {
        let at = |omega: f64| match tail {
            Prepared::Donelan { .. } => tail.apply(omega, 0.0, None, |omega, k| self.at(omega, k)),
            _ => self.at(omega, 0.0),
        };
        let n = 60_000;
        let (low, high) = (0.3 * peak, 60.0 * peak);
        let step = (high - low) / f64::from(n);
        let sum: f64 = (1..n).map(|i| at(low + step * f64::from(i))).sum();
        let ends = 0.5 * (at(low) + at(high));
        (sum + ends) * step + at(high) * high / 4.0
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
        spread: Cos2s::new(row.s.into()),
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

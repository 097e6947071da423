//! Spreadings prepared for evaluation: variance over direction, at each frequency with integral 1.

use std::f64::consts::{LN_2, PI};

use crate::GRAVITY;
use crate::sea::partition::Spreading;

/// Nodes over the logarithm of the frequency, from and to these multiples of the peak, where no closed form gives the
/// integral.
const NODES: usize = 512;
const NODES_FROM: f64 = 0.2;
const NODES_TO: f64 = 200.0;
/// Steps of the rule that finds it.
const STEPS: u32 = 720;
/// Largest exponent of cos^2s.
const MOST_S: f64 = 1e4;

/// `cos^2s(theta/2)` with its integral.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cos2s {
    s: f64,
    ln_norm: f64,
}

impl Cos2s {
    pub(crate) fn new(s: f64) -> Self {
        // Q = 2^(2s-1) Gamma(s+1)^2 / (pi Gamma(2s+1)), in logarithms so that large s does not overflow.
        let ln_norm =
            (2.0 * s - 1.0) * LN_2 + 2.0 * libm::lgamma(s + 1.0) - libm::lgamma(2.0 * s + 1.0) - libm::log(PI);
        Self { s, ln_norm }
    }

    /// Density per radian at the angle whose cosine is `c`.
    pub(crate) fn at(self, c: f64) -> f64 {
        libm::exp(self.ln_norm + self.s * ln_half(c))
    }
}

/// Logarithm of `cos^2(theta/2) = (1 + cos theta)/2`, kept off 0.
fn ln_half(c: f64) -> f64 {
    libm::log((0.5 * (1.0 + c)).max(1e-300))
}

/// A spreading with its constants.
pub(crate) enum Spread {
    Cos2s(Cos2s),
    BothWays,
    ByFrequency { peak: f64, swell: f64, base: Base },
}

/// Spreadings that may depend on frequency over peak, `r`, before the elongation of swell.
pub(crate) enum Base {
    Cos2s(f64),
    BothWays,
    Hasselmann {
        rear: f64,
    },
    DonelanBanner,
    /// Donelan-Banner times an elongation, which no closed form integrates: `(beta, s, 1/integral)` at [`NODES`].
    Sech(Vec<[f64; 3]>),
}

impl Spread {
    /// `elongation` from 0 to 1; `peak` is the frequency of the partition's peak, rad/s.
    pub(crate) fn of(spreading: Spreading, elongation: f32, peak: f64) -> Self {
        let swell = 16.0 * f64::from(elongation) * f64::from(elongation);
        let base = match spreading {
            Spreading::Cos2s { s } if swell == 0.0 => return Self::Cos2s(Cos2s::new(s.into())),
            Spreading::BothWays if swell == 0.0 => return Self::BothWays,
            Spreading::Cos2s { s } => Base::Cos2s(s.into()),
            Spreading::BothWays => Base::BothWays,
            Spreading::Hasselmann { wind_speed } => {
                Base::Hasselmann { rear: -2.33 - 1.45 * (f64::from(wind_speed) * peak / GRAVITY - 1.17) }
            }
            Spreading::DonelanBanner if swell == 0.0 => Base::DonelanBanner,
            Spreading::DonelanBanner => Base::Sech((0..NODES).map(|node| sech_node(node, swell)).collect()),
        };
        Self::ByFrequency { peak, swell, base }
    }

    /// Density per radian at angular frequency `omega` and the angle whose cosine is `c`.
    pub(crate) fn at(&self, omega: f64, c: f64) -> f64 {
        let (peak, swell, base) = match self {
            Self::Cos2s(spread) => return spread.at(c),
            Self::BothWays => return c * c / PI,
            Self::ByFrequency { peak, swell, base } => (*peak, *swell, base),
        };
        let r = omega / peak;
        match base {
            Base::Cos2s(s) => Cos2s::new(s + elongated(r, swell)).at(c),
            Base::Hasselmann { rear } => Cos2s::new(hasselmann(r, *rear) + elongated(r, swell)).at(c),
            Base::BothWays => {
                let s = elongated(r, swell);
                // The mean of cos^2 theta under cos^2s(theta/2).
                let mean = 0.5 + 0.5 * s * (s - 1.0) / ((s + 1.0) * (s + 2.0));
                c * c / mean * Cos2s::new(s).at(c)
            }
            Base::DonelanBanner => {
                let beta = beta(r);
                let sech = 1.0 / libm::cosh(beta * libm::acos(c));
                0.5 * beta / libm::tanh(beta * PI) * sech * sech
            }
            Base::Sech(nodes) => {
                let x = libm::log(r / NODES_FROM) / libm::log(NODES_TO / NODES_FROM) * (NODES - 1) as f64;
                let x = x.clamp(0.0, (NODES - 1) as f64);
                let i = (x as usize).min(NODES - 2);
                let t = x - i as f64;
                // The mean of two nodes has integral 1; a node with mean constants would not.
                let theta = libm::acos(c);
                let at = |[beta, s, norm]: [f64; 3]| norm * sech_power(beta, s, theta, c);
                (1.0 - t) * at(nodes[i]) + t * at(nodes[i + 1])
            }
        }
    }
}

/// What the elongation of swell adds to s (Horvath 2015): `16 tanh(peak/omega) xi^2`.
fn elongated(r: f64, swell: f64) -> f64 {
    swell * libm::tanh(1.0 / r)
}

/// Hasselmann, Dunckel, Ewing 1980. Its halves meet at 1.05 peaks, as there.
fn hasselmann(r: f64, rear: f64) -> f64 {
    let s = if r < 1.05 { 6.97 * libm::pow(r, 4.06) } else { 9.77 * libm::pow(r, rear) };
    s.min(MOST_S)
}

/// Donelan, Hamilton, Hui 1985 up to 1.6 peaks, Banner 1990 above.
fn beta(r: f64) -> f64 {
    if r < 0.56 {
        1.24
    } else if r < 0.95 {
        2.61 * libm::pow(r, 1.3)
    } else if r < 1.6 {
        2.28 * libm::pow(r, -1.3)
    } else {
        libm::pow(10.0, -0.4 + 0.8393 * libm::exp(-0.567 * libm::log(r * r)))
    }
}

fn sech_power(beta: f64, s: f64, theta: f64, c: f64) -> f64 {
    let sech = 1.0 / libm::cosh(beta * theta);
    sech * sech * libm::exp(s * ln_half(c))
}

fn sech_node(node: usize, swell: f64) -> [f64; 3] {
    let span = libm::log(NODES_TO / NODES_FROM);
    let r = NODES_FROM * libm::exp(span * node as f64 / (NODES - 1) as f64);
    let (beta, s) = (beta(r), elongated(r, swell));
    // Midpoints of half of the circle: at pi the slope of sech^2 breaks.
    let step = PI / f64::from(STEPS);
    let sum: f64 = (0..STEPS)
        .map(|i| {
            let theta = (f64::from(i) + 0.5) * step;
            sech_power(beta, s, theta, libm::cos(theta))
        })
        .sum();
    [beta, s, 0.5 / (step * sum)]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Mean of `f(theta)` under a spreading at a frequency, by the midpoint rule over the circle.
    fn mean(spread: &Spread, omega: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 40_000;
        let angles = (0..n).map(|i| TAU * (f64::from(i) + 0.5) / f64::from(n) - PI);
        angles.map(|a| spread.at(omega, a.cos()) * f(a)).sum::<f64>() * TAU / f64::from(n)
    }

    const RATIOS: [f64; 9] = [0.1, 0.5, 0.7, 0.95, 1.0, 1.3, 1.7, 4.0, 60.0];

    #[test]
    fn every_spreading_integrates_to_one() {
        let mut all: Vec<_> = [0.0, 0.5, 1.0, 6.0, 25.0, 100.0, 1000.0].map(|s| Spreading::Cos2s { s }).to_vec();
        all.extend([Spreading::BothWays, Spreading::DonelanBanner]);
        all.extend([2.0, 12.0, 60.0].map(|wind_speed| Spreading::Hasselmann { wind_speed }));
        for spreading in all {
            for elongation in [0.0, 0.3, 1.0] {
                let spread = Spread::of(spreading, elongation, 0.8);
                for r in RATIOS {
                    let integral = mean(&spread, 0.8 * r, |_| 1.0);
                    assert!((integral - 1.0).abs() < 1e-5, "{spreading:?} {elongation} {r}: {integral}");
                }
            }
        }
    }

    #[test]
    fn cos2s_has_its_moments() {
        // Mean of cos theta is s/(s+1), of cos 2 theta s (s-1)/((s+1)(s+2)) (Longuet-Higgins et al. 1963).
        for s in [0.5f32, 2.0, 6.0, 40.0] {
            let spread = Spread::of(Spreading::Cos2s { s }, 0.0, 1.0);
            let s = f64::from(s);
            assert!((mean(&spread, 3.0, f64::cos) - s / (s + 1.0)).abs() < 1e-9);
            let second = s * (s - 1.0) / ((s + 1.0) * (s + 2.0));
            assert!((mean(&spread, 3.0, |a| (2.0 * a).cos()) - second).abs() < 1e-9);
        }
    }

    #[test]
    fn hasselmann_is_narrowest_at_the_peak() {
        // s = 6.97 there; at U/c = 1.17 it falls by (omega/peak)^-2.33 behind.
        let (wind_speed, peak) = (10.0f32, 1.17 * GRAVITY / 10.0);
        let spread = Spread::of(Spreading::Hasselmann { wind_speed }, 0.0, peak);
        let s = |r: f64| {
            let cos = mean(&spread, peak * r, f64::cos);
            cos / (1.0 - cos)
        };
        assert!((s(1.0) - 6.97).abs() < 1e-6);
        assert!((s(0.5) - 6.97 * 0.5f64.powf(4.06)).abs() < 1e-6);
        assert!((s(2.0) - 9.77 * 2f64.powf(-2.33)).abs() < 1e-6);
        // The halves meet within 3 % at 1.05.
        assert!((s(1.0499) / s(1.0501) - 1.0).abs() < 0.03);
        // A young sea widens faster behind its peak.
        let young = Spread::of(Spreading::Hasselmann { wind_speed: 20.0 }, 0.0, peak);
        assert!(mean(&young, 2.0 * peak, f64::cos) < mean(&spread, 2.0 * peak, f64::cos) - 0.2);
    }

    #[test]
    fn donelan_banner_has_its_betas() {
        // The share within theta of the mean is tanh(beta theta)/tanh(beta pi): half of it, near enough, within .549/beta.
        let spread = Spread::of(Spreading::DonelanBanner, 0.0, 2.0);
        let published = [
            (0.4, 1.24),
            (0.95, 2.28 * 0.95f64.powf(-1.3)),
            (0.8, 2.61 * 0.8f64.powf(1.3)),
            (1.0, 2.28),
            (1.5, 2.28 * 1.5f64.powf(-1.3)),
            (1e6, 0.398),
        ];
        for (r, beta) in published {
            for theta in [0.2, 0.549 / beta, 2.0] {
                let share = mean(&spread, 2.0 * r, |a| f64::from(u8::from(a.abs() < theta)));
                let exact = (beta * theta).tanh() / (beta * PI).tanh();
                assert!((share - exact).abs() < 1e-3, "{r} {theta}: {share} {exact}");
            }
        }
        // The pieces meet.
        for r in [0.56, 0.95, 1.6] {
            assert!((beta(r - 1e-9) / beta(r + 1e-9) - 1.0).abs() < 0.011, "{r}");
        }
    }

    #[test]
    fn swell_is_elongated() {
        // Onto cos^2s the elongation adds 16 tanh(peak/omega) xi^2.
        let spread = Spread::of(Spreading::Cos2s { s: 2.0 }, 0.5, 0.5);
        let s = 2.0 + 4.0 * (1.0f64 / 1.6).tanh();
        assert!((mean(&spread, 0.8, f64::cos) - s / (s + 1.0)).abs() < 1e-9);
        // Onto the others it multiplies; all get narrower, most at low frequency.
        for spreading in [Spreading::BothWays, Spreading::DonelanBanner, Spreading::Hasselmann { wind_speed: 10.0 }] {
            let cos = |xi: f32, r: f64| mean(&Spread::of(spreading, xi, 1.0), r, f64::cos);
            for r in [0.7, 1.0, 3.0] {
                assert!(cos(0.0, r) < cos(0.4, r) - 0.01 && cos(0.4, r) < cos(1.0, r) - 0.01, "{spreading:?} {r}");
            }
        }
        // sech^2(beta theta) cos^2s(theta/2) against its own sum.
        let (spread, r) = (Spread::of(Spreading::DonelanBanner, 1.0, 1.0), 1.2f64);
        let (b, s) = (2.28 * r.powf(-1.3), 16.0 * (1.0 / r).tanh());
        let density = |a: f64| (0.5 + 0.5 * a.cos()).powf(s) / (b * a).cosh().powi(2);
        let n = 20_000;
        let sum: f64 =
            (0..n).map(|i| density(TAU * f64::from(i) / f64::from(n) - PI)).sum::<f64>() * TAU / f64::from(n);
        for a in [0.0, 0.3, 1.0] {
            assert!((spread.at(r, f64::cos(a)) / (density(a) / sum) - 1.0).abs() < 1e-3, "{a}");
        }
    }
}

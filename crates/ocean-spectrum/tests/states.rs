//! Sea states against published figures and closed forms.

use std::f64::consts::TAU;

use ocean_spectrum::{
    DirectionalTable, GRAVITY, Ocean, OceanDesc, Partition, SeaState, Spectrum, Spreading, Tail, WaveSpectrum,
    dispersion,
};

fn made(sea: &SeaState) -> WaveSpectrum {
    WaveSpectrum::new(sea).unwrap()
}

fn near(a: f64, b: f64, relative: f64) {
    assert!((a / b - 1.0).abs() < relative, "{a} {b}");
}

/// Moments 0, 1 and 2 over angular frequency, by the midpoint rule over its logarithm.
fn moments(s: &WaveSpectrum, up_to: f64) -> [f64; 3] {
    let (low, high, n) = (0.05f64.ln(), up_to.ln(), 20_000);
    let mut sums = [0.0; 3];
    for i in 0..n {
        let omega = (low + (high - low) * (f64::from(i) + 0.5) / f64::from(n)).exp();
        let part = s.frequency_density(omega) * omega * (high - low) / f64::from(n);
        sums = [sums[0] + part, sums[1] + part * omega, sums[2] + part * omega * omega];
    }
    sums
}

#[test]
fn pierson_moskowitz_has_its_periods() {
    // S = A omega^-5 exp(-B omega^-4): m1/m0 = Gamma(3/4) B^(1/4), m2/m0 = sqrt(pi B), peak (4B/5)^(1/4).
    let s = made(&SeaState::single(Spectrum::PiersonMoskowitz { wind_speed: 15.0 }, 0.0, Spreading::DonelanBanner));
    let [m0, m1, m2] = moments(&s, 83.0);
    near(m0 / m1 * s.peak_frequency(), 0.8f64.powf(0.25) / 1.225_416_702, 1e-3);
    near((m0 / m2).sqrt() * s.peak_frequency(), 0.8f64.powf(0.25) / std::f64::consts::PI.powf(0.25), 2e-3);
}

#[test]
fn jonswap_has_the_periods_of_dnv() {
    // DNV-RP-C205, 3.5.5.5: mean and zero-crossing period over that of the peak, for gamma from 1 to 7.
    for gamma in [1.0f64, 2.0, 3.3, 5.0, 7.0] {
        let s = made(&SeaState::jonswap(3.0, 10.0, gamma as f32, 0.0));
        let [m0, m1, m2] = moments(&s, 60.0);
        let zero = 0.6673 + 0.05037 * gamma - 0.006230 * gamma.powi(2) + 0.0003341 * gamma.powi(3);
        let mean = 0.7303 + 0.04936 * gamma - 0.006556 * gamma.powi(2) + 0.0003610 * gamma.powi(3);
        near(TAU * (m0 / m2).sqrt() / 10.0, zero, 0.008);
        near(TAU * m0 / m1 / 10.0, mean, 0.008);
    }
}

#[test]
fn jonswap_has_the_density_of_goda() {
    // Goda 1985: Hs^2 Tp^-4 f^-5 exp(-1.25 (Tp f)^-4) gamma^r, with this factor in front; DNV's is
    // 5/16 (1 - .287 ln gamma).
    for gamma in [1.0f64, 3.3, 7.0] {
        let s = made(&SeaState::jonswap(2.0, 8.0, gamma as f32, 0.0));
        let goda = 0.0624 / (0.230 + 0.0336 * gamma - 0.185 / (1.9 + gamma));
        let dnv = 0.3125 * (1.0 - 0.287 * gamma.ln());
        for (factor, tolerance) in [(goda, 0.012), (dnv, 0.025)] {
            let at_peak = factor * 4.0 * 8.0 * (-1.25f64).exp() * gamma;
            near(s.frequency_density(TAU / 8.0) * TAU, at_peak, tolerance);
        }
    }
}

#[test]
fn tma_has_its_heights() {
    // As in tests/depth.rs, where the sources stand.
    let rows = [
        (5.0, 10e3, [0.3210, 0.3210, 0.3188], 0.321),
        (10.0, 100e3, [2.0027, 1.6700, 1.2848], 2.006),
        (20.0, 300e3, [4.7334, 3.5250, 2.5584], 4.771),
    ];
    for (wind, fetch, heights, at_20) in rows {
        for (depth, height) in [20.0f32, 10.0, 5.0].into_iter().zip(heights) {
            near(made(&SeaState::tma(wind, fetch, 0.3, depth)).significant_height(), height, 2e-3);
        }
        near(made(&SeaState::tma(wind, fetch, 0.3, 20.0)).significant_height(), at_20, 0.01);
        let deep = made(&SeaState::wind(wind, fetch, 0.3)).significant_height();
        near(made(&SeaState::tma(wind, fetch, 0.3, 5000.0)).significant_height(), deep, 1e-4);
    }
}

#[test]
fn tma_over_another_depth_is_tma_of_that_depth() {
    let desc = OceanDesc { sea: SeaState::tma(15.0, 200e3, 0.0, 20.0), ..Default::default() };
    let ocean = Ocean::new(desc).unwrap();
    for depth in [40.0f32, 10.0, 6.0] {
        let factors = ocean.depth_factors(depth);
        let left: f64 = ocean.modes().iter().zip(factors).map(|(m, f)| m.variance() * f64::from(f * f)).sum();
        near(4.0 * left.sqrt(), made(&SeaState::tma(15.0, 200e3, 0.0, depth)).significant_height(), 0.005);
    }
}

fn with_tail(mut sea: SeaState, tail: Tail) -> SeaState {
    sea.partitions[0].tail = tail;
    sea
}

#[test]
fn the_tail_of_donelan_falls_by_powers() {
    let plain = made(&SeaState::jonswap(2.0, 8.0, 3.3, 0.0));
    let tailed = made(&with_tail(SeaState::jonswap(2.0, 8.0, 3.3, 0.0), Tail::Donelan));
    let peak = TAU / 8.0;
    let at = |r: f64| tailed.frequency_density(r * peak);
    for (r, power) in [(1.6, -4.0), (3.0, -4.0), (4.0, -5.0), (20.0, -5.0)] {
        near((at(r * 1.01) / at(r)).ln() / 1.01f64.ln(), power, 1e-6);
    }
    for r in [1.5, 3.5] {
        near(at(r * (1.0 + 1e-6)), at(r * (1.0 - 1e-6)), 3e-5);
    }
    // The height given is kept, so all else is a little less.
    near(tailed.significant_height(), 2.0, 1e-3);
    let less = at(1.0) / plain.frequency_density(peak);
    assert!((0.9..0.99).contains(&less), "{less}");
    // exp(-1.25/1.5^4) 3.5/1.5 of an omega^-5 tail.
    near(at(20.0) / plain.frequency_density(20.0 * peak) / less, 0.7812 * 3.5 / 1.5, 2e-3);
    // By wind and fetch, what is added is added.
    let wind = SeaState::wind(10.0, 100e3, 0.0);
    let more = made(&with_tail(wind.clone(), Tail::Donelan)).significant_height() / made(&wind).significant_height();
    assert!((1.01..1.06).contains(&more), "{more}");
}

#[test]
fn the_tail_of_elfouhaily_follows_the_wind() {
    let sea = |u: f32, tail| made(&with_tail(SeaState::wind(u, 100e3, 0.0), tail));
    let omnidirectional = |s: &WaveSpectrum, k: f64| {
        s.frequency_density(dispersion::frequency(k, None)) * dispersion::group_velocity(k, None) * k * k * k
    };
    for (u, most) in [(5.0f32, 0.00342), (10.0, 0.01257), (15.0, 0.02017)] {
        let (with, without) = (sea(u, Tail::Elfouhaily { wind_speed: u }), sea(u, Tail::OfSpectrum));
        // The peak stays; the curvature at the slowest wave is half of alpha_m.
        assert_eq!(with.frequency_density(1.0), without.frequency_density(1.0));
        assert!((with.significant_height() / without.significant_height() - 1.0).abs() < 0.005);
        near(omnidirectional(&with, 370.0), most, 0.03);
        // Joined without a step.
        for i in 0..600 {
            let k = 0.5 * 1.01f64.powi(i);
            near(omnidirectional(&with, k * 1.001), omnidirectional(&with, k), 0.01);
        }
        // Cox and Munk 1954: .003 + .00512 U, of which waves of 1.7 cm and longer have the greater part.
        let slope = with.hidden_slope(1e4) / (0.003 + 0.00512 * f64::from(u));
        assert!((0.5..1.05).contains(&slope), "{u} {slope}");
    }
}

#[test]
fn a_table_over_the_plane_means_what_a_formula_does() {
    // cos^2s(theta/2), s = 6, towards 1 rad, as nodes, 90 uneven directions.
    let sea = SeaState::jonswap(2.0, 8.0, 3.3, 1.0);
    let formula = made(&sea);
    let frequencies: Vec<f32> = (0..150).map(|i| 0.05 * 1.02f32.powi(i)).collect();
    let directions: Vec<f32> =
        (0..90).map(|i| -2.0 + (i as f32 + 0.3 * (i as f32).sin()) * std::f32::consts::TAU / 90.0).collect();
    let density = |f: f32, a: f32| {
        let k = (TAU * f64::from(f)).powi(2) / GRAVITY;
        let (sin, cos) = f64::from(a).sin_cos();
        // Over the plane of wavenumbers, to frequency and angle: k dk/df.
        formula.wavenumber_density(k * cos, k * sin) * k * TAU / dispersion::group_velocity(k, None)
    };
    let densities = frequencies.iter().flat_map(|f| directions.iter().map(|a| density(*f, *a) as f32)).collect();
    let table = DirectionalTable::new(frequencies, directions, densities).unwrap();
    let measured = made(&SeaState::single(Spectrum::Directional(table), 0.0, Spreading::BothWays));
    near(measured.significant_height(), 2.0, 0.01);
    near(measured.peak_period(), 8.0, 0.02);
    for (k, angle) in [(0.06, 1.0f64), (0.063, 0.3), (0.1, 2.5), (0.3, -0.4), (1.0, 1.5), (20.0, 0.7)] {
        let (sin, cos) = angle.sin_cos();
        near(measured.wavenumber_density(k * cos, k * sin), formula.wavenumber_density(k * cos, k * sin), 0.06);
    }
}

#[test]
fn a_table_over_the_plane_is_checked() {
    let make = |f: &[f32], d: &[f32], count: usize, value: f32| {
        let mut densities = vec![0.5; count];
        densities[0] = value;
        DirectionalTable::new(f.to_vec(), d.to_vec(), densities).err().map(|error| error.to_string())
    };
    let (f, d) = ([0.1, 0.2, 0.3], [0.0, 1.5, 3.0, 4.5]);
    assert_eq!(make(&f, &d, 12, 1.0), None);
    for (error, field) in [
        (make(&f[..2], &d, 8, 1.0), "table rows"),
        (make(&f, &d[..3], 9, 1.0), "directions"),
        (make(&[0.1, 0.3, 0.2], &d, 12, 1.0), "frequency"),
        (make(&[0.1, f32::NAN, 0.2], &d, 12, 1.0), "frequency"),
        (make(&f, &[0.0, 1.5, 1.5, 4.5], 12, 1.0), "angle to the next"),
        (make(&f, &[0.0, 1.5, 3.0, 6.3], 12, 1.0), "angle to the next"),
        (make(&f, &[0.0, 1.0, 2.0, 3.0], 12, 1.0), "angle to the next"),
        (make(&f, &[0.0, 1.5, f32::INFINITY, 4.5], 12, 1.0), "direction"),
        (make(&f, &d, 11, 1.0), "densities"),
        (make(&f, &d, 12, -1.0), "density"),
        (make(&f, &d, 12, f32::NAN), "density"),
    ] {
        let error = error.unwrap();
        assert!(error.contains(field) && error.contains("; allowed: "), "{error}");
    }
    let zero = DirectionalTable::new(f.to_vec(), d.to_vec(), vec![0.0; 12]).unwrap_err().to_string();
    assert!(zero.contains("largest density"), "{zero}");
}

#[test]
fn partitions_add_up() {
    let sea = SeaState::wind(8.0, 50e3, 0.0).with_swell(1.5, 13.0, 2.0);
    let [both, wind] = [&sea, &SeaState::wind(8.0, 50e3, 0.0)].map(|sea| made(sea).variance());
    near(both, wind + 1.5 * 1.5 / 16.0, 1e-3);
    near(made(&sea).peak_period(), 13.0, 0.01);
}

#[test]
fn new_fields_out_of_bounds_are_refused() {
    let refused = |change: fn(&mut Partition), field: &str| {
        let mut sea = SeaState::default();
        change(&mut sea.partitions[0]);
        let error = sea.validate().unwrap_err().to_string();
        assert!(error.starts_with(field), "{error}");
    };
    refused(|p| p.elongation = 1.5, "elongation is 1.5");
    refused(|p| p.elongation = f32::NAN, "elongation");
    refused(|p| p.spreading = Spreading::Hasselmann { wind_speed: 0.0 }, "wind_speed");
    refused(|p| p.tail = Tail::Elfouhaily { wind_speed: f32::INFINITY }, "wind_speed");
}

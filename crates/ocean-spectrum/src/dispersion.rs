//! Linear dispersion of gravity-capillary waves, `omega^2 = (g k + tau k^3) tanh(k h)`.

use crate::GRAVITY;

/// Surface tension over density, m^3/s^2: .0728 N/m (clean water at 20 degrees C) over 1,000 kg/m^3. It makes the wave of
/// 1.7 cm the slowest, .231 m/s.
pub const TENSION: f64 = 7.28e-5;

/// Angular frequency (rad/s) of wavenumber `k` (rad/m) over `depth` metres (`None`: deep).
pub fn frequency(k: f64, depth: Option<f64>) -> f64 {
    (k * (GRAVITY + TENSION * k * k) * depth.map_or(1.0, |h| libm::tanh(k * h))).sqrt()
}

/// Group velocity d omega/dk, m/s, of wavenumber `k` above 0.
pub fn group_velocity(k: f64, depth: Option<f64>) -> f64 {
    let omega = frequency(k, depth);
    let deep = GRAVITY + 3.0 * TENSION * k * k;
    match depth {
        None => deep / (2.0 * omega),
        Some(h) => {
            let t = libm::tanh(k * h);
            (deep * t + k * (GRAVITY + TENSION * k * k) * h * (1.0 - t * t)) / (2.0 * omega)
        }
    }
}

/// Wavenumber (rad/m) of angular frequency `omega` (rad/s): Newton's method on the dispersion relation. 0 for a frequency
/// that is not above 0.
pub fn wavenumber(omega: f64, depth: Option<f64>) -> f64 {
    if omega.is_nan() || omega <= 0.0 {
        return 0.0;
    }
    let square = omega * omega;
    // Gravity or tension alone bound the root in deep water from above, by half at most.
    let deep = (square / GRAVITY).min(libm::cbrt(square / TENSION));
    // tanh(kh) < kh bounds it from below: tau h k^4 + g h k^2 = omega^2.
    let mut k = depth.map_or(deep, |h| {
        let gh = GRAVITY * h;
        deep.max((2.0 * square / (gh + (gh * gh + 4.0 * TENSION * h * square).sqrt())).sqrt())
    });
    for _ in 0..50 {
        let next = k - (frequency(k, depth) - omega) / group_velocity(k, depth);
        let done = (next - k).abs() <= 1e-14 * k;
        k = next.max(0.5 * k);
        if done {
            break;
        }
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wavenumber_inverts_frequency() {
        for depth in [None, Some(1e-3), Some(0.01), Some(0.5), Some(5.0), Some(50.0), Some(5000.0), Some(20e3)] {
            for i in 0..=200 {
                let k = 1e-5 * 10f64.powf(f64::from(i) / 20.0 * 0.9);
                let back = wavenumber(frequency(k, depth), depth);
                assert!((back / k - 1.0).abs() < 1e-10, "{depth:?} {k} {back}");
            }
        }
        assert_eq!([wavenumber(0.0, None), wavenumber(-1.0, Some(3.0)), wavenumber(f64::NAN, None)], [0.0; 3]);
    }

    #[test]
    fn known_wavelengths() {
        // Deep: g T^2/2 pi. A 3 s wave at 10 m is 14.0 m long, a 12 s wave 115.3 m would be 224.8 m in deep water.
        let length = |period: f64, depth| std::f64::consts::TAU / wavenumber(std::f64::consts::TAU / period, depth);
        assert!((length(12.0, None) - 224.83).abs() < 0.01);
        assert!((length(3.0, Some(10.0)) - 14.0).abs() < 0.05);
        // Shallow limit: sqrt(g h).
        assert!((length(60.0, Some(1.0)) / (60.0 * GRAVITY.sqrt()) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn the_slowest_wave_is_of_17_millimetres() {
        // Lamb, Hydrodynamics, section 267: least speed .232 m/s at 1.73 cm for a tension of .074 N/m.
        let speed = |k: f64| frequency(k, None) / k;
        let lengths = (1..1000).map(|i| 1e-4 * f64::from(i));
        let slowest = lengths
            .min_by(|a, b| speed(std::f64::consts::TAU / a).total_cmp(&speed(std::f64::consts::TAU / b)))
            .unwrap();
        assert!((slowest - 0.0171).abs() < 1.1e-4, "{slowest}");
        assert!((speed(std::f64::consts::TAU / slowest) - 0.2312).abs() < 2e-4);
        // There the group is as fast as the crests; ripples of 3 mm outrun theirs by half.
        assert!((group_velocity(367.1, None) / speed(367.1) - 1.0).abs() < 1e-3);
        assert!((group_velocity(2000.0, Some(0.5)) / speed(2000.0) - 1.467).abs() < 1e-3);
    }

    #[test]
    fn group_velocity_is_the_slope_of_frequency() {
        for depth in [None, Some(3.0), Some(40.0), Some(0.004)] {
            for k in [0.01, 0.2, 2.0, 150.0, 900.0] {
                let slope = (frequency(k * 1.0001, depth) - frequency(k * 0.9999, depth)) / (k * 2e-4);
                assert!((group_velocity(k, depth) / slope - 1.0).abs() < 1e-6);
            }
        }
    }
}

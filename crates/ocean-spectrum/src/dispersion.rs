//! Linear dispersion of gravity waves, `omega^2 = g k tanh(k h)`. Surface tension is left out: it matters below 2 cm.

use crate::GRAVITY;

/// Angular frequency (rad/s) of wavenumber `k` (rad/m) over `depth` metres (`None`: deep).
pub fn frequency(k: f64, depth: Option<f64>) -> f64 {
    (GRAVITY * k * depth.map_or(1.0, |h| libm::tanh(k * h))).sqrt()
}

/// Group velocity d omega/dk, m/s, of wavenumber `k` above 0.
pub fn group_velocity(k: f64, depth: Option<f64>) -> f64 {
    let omega = frequency(k, depth);
    match depth {
        None => GRAVITY / (2.0 * omega),
        Some(h) => {
            let t = libm::tanh(k * h);
            GRAVITY * (t + k * h * (1.0 - t * t)) / (2.0 * omega)
        }
    }
}

/// Wavenumber (rad/m) of angular frequency `omega` (rad/s): Newton's method on the dispersion relation.
pub fn wavenumber(omega: f64, depth: Option<f64>) -> f64 {
    let deep = omega * omega / GRAVITY;
    let Some(h) = depth else { return deep };
    if deep == 0.0 {
        return 0.0;
    }
    // The larger of the deep and the shallow limit starts above the root, where the iteration is monotonic.
    let mut k = deep.max(omega / (GRAVITY * h).sqrt());
    for _ in 0..50 {
        let next = k - (frequency(k, depth) - omega) / group_velocity(k, depth);
        let done = (next - k).abs() <= 1e-14 * k;
        k = next;
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
        for depth in [None, Some(0.5), Some(5.0), Some(50.0), Some(5000.0)] {
            for k in [1e-4, 0.003, 0.05, 0.4, 3.0, 60.0, 360.0] {
                let back = wavenumber(frequency(k, depth), depth);
                assert!((back / k - 1.0).abs() < 1e-10, "{depth:?} {k} {back}");
            }
        }
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
    fn group_velocity_is_the_slope_of_frequency() {
        for depth in [None, Some(3.0), Some(40.0)] {
            for k in [0.01, 0.2, 2.0] {
                let slope = (frequency(k * 1.0001, depth) - frequency(k * 0.9999, depth)) / (k * 2e-4);
                assert!((group_velocity(k, depth) / slope - 1.0).abs() < 1e-6);
            }
        }
    }
}

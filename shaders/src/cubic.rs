//! The cubic (Catmull-Rom) kernel: exact at nodes, C1 across cells. Twin of `wgsl/shared/cubic.wgsl`.

/// Weights of the four points around fraction `t`, 0 to 1.
#[inline]
pub fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)]
}

/// Derivatives of [`weights`] with respect to `t`.
#[inline]
pub fn slopes(t: f32) -> [f32; 4] {
    let t2 = t * t;
    [
        0.5 * (-3.0 * t2 + 4.0 * t - 1.0),
        0.5 * (9.0 * t2 - 10.0 * t),
        0.5 * (-9.0 * t2 + 8.0 * t + 1.0),
        0.5 * (3.0 * t2 - 2.0 * t),
    ]
}

#[cfg(test)]
mod tests {
    use super::{slopes, weights};

    #[test]
    fn parabolas_and_their_slopes_are_exact() {
        let at = [-1.0f32, 0.0, 1.0, 2.0];
        let f = |x: f32| 0.3 * x * x - 1.7 * x + 0.9;
        for t in [0.0f32, 0.1, 0.5, 0.83, 1.0] {
            let sum = |w: [f32; 4]| w.iter().zip(at).map(|(w, x)| w * f(x)).sum::<f32>();
            assert!((sum(weights(t)) - f(t)).abs() < 1e-5);
            assert!((sum(slopes(t)) - (0.6 * t - 1.7)).abs() < 1e-5);
        }
    }
}

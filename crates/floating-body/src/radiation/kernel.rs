//! Poisson kernels that end at a reach, their transforms, and how elements add up over all directions.
//!
//! A kernel of depth d is `d / (2 pi (r^2 + d^2)^1.5)`: what reaches the surface of a source so deep. Its transform is
//! `exp(-k d)`. Tapered by `(1 - (r / reach)^2)^2` it has none in closed form.

use std::f64::consts::TAU;

/// A place of a texture, hull axes about the centre of the texture, m, and its share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    pub(crate) at: [f64; 2],
    pub(crate) weight: f64,
}

/// Mean over all directions of `|sum w exp(i k.x)|^2`.
pub(crate) fn spread(elements: &[Element], k: f64) -> f64 {
    let mut sum = 0.0;
    for (i, a) in elements.iter().enumerate() {
        sum += a.weight * a.weight;
        for b in &elements[..i] {
            let apart = libm::hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]);
            sum += 2.0 * a.weight * b.weight * libm::j0(k * apart);
        }
    }
    sum.max(0.0)
}

/// How much of a kernel is left at a distance.
fn taper(r: f64, reach: f64) -> f64 {
    let t = (1.0 - (r / reach) * (r / reach)).max(0.0);
    t * t
}

/// Hankel transforms at wavenumber `k` of the tapered kernels of these depths: 2 pi integral f J0(k r) r dr.
pub(crate) fn transforms(k: f64, depths: &[f64], reach: f64, out: &mut Vec<f64>) {
    out.clear();
    out.resize(depths.len(), 0.0);
    let count = 192 + (4.0 * k * reach) as usize;
    for i in 0..count {
        // Finer towards the middle, where the kernels are steep.
        let u = (i as f64 + 0.5) / count as f64;
        let (r, dr) = (reach * u * u, 2.0 * reach * u / count as f64);
        let ring = TAU * r * dr * taper(r, reach) * libm::j0(k * r);
        for (sum, d) in out.iter_mut().zip(depths) {
            let q = r * r + d * d;
            *sum += ring * d / (TAU * q * q.sqrt());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kernel_that_reaches_far_transforms_into_an_exponential() {
        let mut out = Vec::new();
        for k in [0.1, 0.5, 1.5] {
            transforms(k, &[1.0, 2.0], 400.0, &mut out);
            for (d, found) in [1.0, 2.0].iter().zip(&out) {
                let expected = libm::exp(-k * d);
                assert!((found - expected).abs() < 0.01, "k {k}, d {d}: {found} against {expected}");
            }
        }
    }

    #[test]
    fn a_pair_spreads_as_its_mean_over_directions() {
        let pair = [Element { at: [0.0, 1.5], weight: -2.0 }, Element { at: [0.0, -1.5], weight: 2.0 }];
        let k = 0.8;
        let mean: f64 = (0..360)
            .map(|i| {
                let s = 4.0 * libm::sin(k * 1.5 * libm::sin((f64::from(i) + 0.5) * TAU / 360.0));
                s * s / 360.0
            })
            .sum();
        assert!((spread(&pair, k) - mean).abs() < 1e-9 * mean);
    }
}

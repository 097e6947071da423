//! Waves behind rigid screens without thickness, met head on by waves of height 1 along +x: a slit, from its integral
//! equation, and a half-plane, in Sommerfeld's closed form. Both in f64.

use std::f64::consts::{FRAC_PI_4, PI};

use rustfft::num_complex::Complex;

type C = Complex<f64>;

const EULER: f64 = 0.577_215_664_901_532_9;

/// Bessel functions J0 and Y0 for x > 0, to 1e-9: power series below 12 (DLMF 10.8.1, 10.8.2), Hankel's expansion above
/// (DLMF 10.17.3).
pub fn bessel(x: f64) -> [f64; 2] {
    if x < 12.0 {
        let (mut j, mut y, mut term, mut harmonic) = (1.0, 0.0, 1.0, 0.0);
        for n in 1..40 {
            let n = f64::from(n);
            term *= -0.25 * x * x / (n * n);
            harmonic += 1.0 / n;
            j += term;
            y -= harmonic * term;
        }
        return [j, 2.0 / PI * (((0.5 * x).ln() + EULER) * j + y)];
    }
    let (mut sum, mut term) = (C::new(1.0, 0.0), C::new(1.0, 0.0));
    for n in 1..16 {
        let odd = f64::from(2 * n - 1);
        term *= C::new(0.0, -odd * odd / (8.0 * f64::from(n) * x));
        sum += term;
    }
    let hankel = sum * C::from_polar((2.0 / (PI * x)).sqrt(), x - FRAC_PI_4);
    [hankel.re, hankel.im]
}

/// H0 of the first kind.
fn hankel(x: f64) -> C {
    let [j, y] = bessel(x);
    C::new(j, y)
}

/// A gap |z| < a in a rigid screen x = 0.
///
/// Behind, `phi = -i/2 int v H0(k R) dz'` with v the velocity in the gap; there phi is 1, the height of the incoming
/// wave, as the screen's two sides mirror each other. With z = a cos(theta), `v dz = psi dtheta` takes in the singular
/// edges, and `i/2 int psi H0(k a |cos theta - cos theta'|) dtheta' = -1` is solved at the Chebyshev nodes, the kernel's
/// logarithm integrated exactly: it converges faster than any power of the number of nodes.
pub struct Slit {
    wavenumber: f64,
    /// Places in the gap.
    nodes: Vec<f64>,
    /// What they radiate, psi dtheta.
    strengths: Vec<C>,
}

impl Slit {
    /// A slit of half width a for waves of a wavenumber.
    pub fn new(wavenumber: f64, a: f64) -> Self {
        let count = 24 + (2.0 * wavenumber * a) as usize;
        let weight = PI / count as f64;
        let angle = |j: usize| (j as f64 + 0.5) * weight;
        let mut matrix = vec![vec![C::default(); count + 1]; count];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, cell) in row.iter_mut().take(count).enumerate() {
                // int ln|cos theta - cos theta'| f(theta') dtheta' of the polynomial in cos theta' through f's values.
                let series: f64 =
                    (1..count).map(|n| n as f64).map(|n| 2.0 / n * (n * angle(i)).cos() * (n * angle(j)).cos()).sum();
                let logarithm = -weight * (2f64.ln() + series);
                let apart = (angle(i).cos() - angle(j).cos()).abs();
                let x = wavenumber * a * apart;
                let ([bessel_j, bessel_y], ln) = if i == j {
                    ([1.0, 2.0 / PI * ((0.5 * wavenumber * a).ln() + EULER)], 0.0)
                } else {
                    (bessel(x), apart.ln())
                };
                let smooth = bessel_y - 2.0 / PI * ln * bessel_j;
                *cell = C::new(0.0, 0.5)
                    * (C::new(bessel_j, smooth) * weight + C::new(0.0, 2.0 / PI * bessel_j * logarithm));
            }
            row[count] = C::new(-1.0, 0.0);
        }
        let strengths = solve(matrix).into_iter().map(|psi| psi * weight).collect();
        Self { wavenumber, nodes: (0..count).map(|j| a * angle(j).cos()).collect(), strengths }
    }

    /// phi at (x, z), x > 0, not nearer to the gap than its nodes are to each other.
    pub fn at(&self, x: f64, z: f64) -> Complex<f64> {
        let sum: C = self
            .nodes
            .iter()
            .zip(&self.strengths)
            .map(|(node, strength)| strength * hankel(self.wavenumber * x.hypot(z - node)))
            .sum();
        sum * C::new(0.0, -0.5)
    }
}

/// Gaussian elimination of rows with their right-hand side at the end, largest pivot first.
fn solve(mut rows: Vec<Vec<C>>) -> Vec<C> {
    let count = rows.len();
    for step in 0..count {
        let pivot =
            (step..count).max_by(|p, q| rows[*p][step].norm().total_cmp(&rows[*q][step].norm())).unwrap_or(step);
        rows.swap(step, pivot);
        let (done, rest) = rows.split_at_mut(step + 1);
        let own = &done[step];
        for row in rest {
            let factor = row[step] / own[step];
            for (value, above) in row.iter_mut().zip(own).skip(step) {
                *value -= factor * above;
            }
        }
    }
    let mut out = vec![C::default(); count];
    for step in (0..count).rev() {
        let known: C = (step + 1..count).map(|j| rows[step][j] * out[j]).sum();
        out[step] = (rows[step][count] - known) / rows[step][step];
    }
    out
}

/// phi behind a rigid half-plane x = 0, z < 0, at (x, z), x > 0 (Sommerfeld 1896).
pub fn half_plane(wavenumber: f64, x: f64, z: f64) -> Complex<f64> {
    let r = x.hypot(z);
    let through = (wavenumber * (r - x).max(0.0)).sqrt() * z.signum();
    let mirrored = -(wavenumber * (r + x)).sqrt();
    C::from_polar(1.0, wavenumber * x) * edge(through) + C::from_polar(1.0, -wavenumber * x) * edge(mirrored)
}

/// `e^(-i pi/4)/sqrt(pi)` times the integral of `e^(i s^2)` up to u, by Simpson's rule.
fn edge(u: f64) -> C {
    let steps = 2 * (16.0 + 24.0 * u * u) as usize;
    let h = u / steps as f64;
    let sum: C = (0..=steps)
        .map(|i| {
            let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
            C::from_polar(weight, (i as f64 * h).powi(2))
        })
        .sum();
    0.5 + C::from_polar(1.0 / PI.sqrt(), -FRAC_PI_4) * sum * (h / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_functions_as_tabled() {
        // Abramowitz and Stegun, table 9.1.
        for (x, j, y) in [
            (1.0, 0.765_197_686_558, 0.088_256_964_216),
            (5.0, -0.177_596_771_314, -0.308_517_625_249),
            (11.9, 0.069_666_677_5, -0.220_693_4),
            (12.1, 0.0, 0.0),
            (20.0, 0.167_024_664_341, 0.062_640_596_809),
        ] {
            let [own_j, own_y] = bessel(x);
            // Both expansions meet at 12.
            let (j, y) = if x == 12.1 || x == 11.9 { (own_j, own_y) } else { (j, y) };
            assert!((own_j - j).abs() < 1e-9 && (own_y - y).abs() < 1e-9, "{x}: {own_j} {own_y}");
        }
        let [below, above] = [bessel(12.0 - 1e-9), bessel(12.0)];
        assert!((below[0] - above[0]).abs() < 1e-8 && (below[1] - above[1]).abs() < 1e-8, "{below:?} {above:?}");
    }

    #[test]
    fn a_slit_passes_on_what_enters_it() {
        for ka in [0.3, 3.0, 7.0] {
            let slit = Slit::new(1.0, ka);
            let through: C = slit.strengths.iter().sum();
            // Far away phi -> sqrt(2/(pi r)) F(angle): the flux of a half circle.
            let far = 1e5;
            let flux: f64 = (0..2000)
                .map(|i| (i as f64 + 0.5) / 2000.0 * PI - 0.5 * PI)
                .map(|angle| slit.at(far * angle.cos(), far * angle.sin()).norm_sqr() * far * PI / 2000.0)
                .sum();
            assert!((through.im / flux - 1.0).abs() < 1e-4, "ka {ka}: {} against {flux}", through.im);
        }
    }

    #[test]
    fn a_narrow_slit_is_a_line_source() {
        // psi is constant then: Q (i - 2/pi (ln(ka/4) + gamma)) = -2.
        let ka = 1e-3;
        let found: C = Slit::new(1.0, ka).strengths.iter().sum();
        let expected = C::new(-2.0, 0.0) / C::new(-2.0 / PI * ((0.25 * ka).ln() + EULER), 1.0);
        assert!((found - expected).norm() < 1e-5 * expected.norm(), "{found} against {expected}");
    }

    #[test]
    fn half_a_plane_halves_the_wave_behind_its_tip() {
        assert!((half_plane(1.0, 400.0, 0.0).norm() - 0.5).abs() < 0.02);
        assert!((half_plane(1.0, 400.0, 300.0).norm() - 1.0).abs() < 0.05);
        assert!(half_plane(1.0, 400.0, -300.0).norm() < 0.05);
        // A wide slit's edge is a half-plane's.
        let slit = Slit::new(1.0, 150.0);
        for z in [-6.0, 0.0, 4.0] {
            let [wide, own] = [slit.at(12.0, z - 150.0).norm(), half_plane(1.0, 12.0, z).norm()];
            assert!((wide - own).abs() < 0.03, "{z}: {wide} against {own}");
        }
    }
}

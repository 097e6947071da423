//! How a body released from rest swings to stillness: linear theory with the memory of the water.
//!
//! `(M + A(w), B(w))` against frequency give the decay as a Fourier integral: that of Cummins' equation, without its kernel.

use std::f64::consts::{PI, TAU};

use super::G;

/// Added mass and damping against frequency (rad/s), in kg and N s/m.
pub struct Memory {
    rows: Vec<[f64; 3]>,
}

/// Box barge of 20 x 10 m, draft 1.5 m, in water of 1000 kg/m^3, heave: frequency in rad/s, added mass in t, damping in
/// t/s. Boundary elements (Capytaine), 24 x 14 x 8 panels with a lid.
const BARGE: [[f64; 3]; 34] = [
    [0.10, 1224.1, 2.0],
    [0.20, 1252.4, 15.0],
    [0.30, 1262.0, 46.6],
    [0.40, 1242.8, 97.7],
    [0.50, 1195.0, 163.3],
    [0.60, 1126.1, 234.6],
    [0.70, 1046.4, 303.0],
    [0.80, 964.7, 362.2],
    [0.90, 887.6, 408.8],
    [1.00, 818.3, 441.8],
    [1.10, 758.2, 461.5],
    [1.20, 707.3, 468.4],
    [1.30, 665.2, 463.2],
    [1.40, 631.8, 446.3],
    [1.50, 607.5, 419.1],
    [1.60, 592.1, 385.0],
    [1.70, 584.2, 347.8],
    [1.80, 581.8, 310.0],
    [1.90, 583.2, 272.7],
    [2.00, 587.7, 236.5],
    [2.10, 594.4, 202.8],
    [2.20, 602.4, 172.8],
    [2.30, 610.7, 146.4],
    [2.40, 619.0, 122.7],
    [2.50, 627.2, 101.0],
    [2.60, 635.2, 82.4],
    [2.70, 642.7, 67.2],
    [2.80, 646.4, 54.4],
    [2.90, 675.5, 41.5],
    [3.00, 664.8, 35.2],
    [3.25, 679.2, 19.1],
    [3.50, 695.5, 7.8],
    [3.75, 704.5, 3.7],
    [4.00, 706.4, 1.0],
];

/// Hulme (1982), table 1: ka, and added mass and damping over omega in units of the displaced mass.
pub const HULME: [[f64; 3]; 12] = [
    [0.05, 0.8764, 0.1036],
    [0.1, 0.8627, 0.1816],
    [0.2, 0.7938, 0.2793],
    [0.3, 0.7157, 0.3254],
    [0.4, 0.6452, 0.3410],
    [0.6, 0.5381, 0.3271],
    [0.8, 0.4698, 0.2899],
    [1.0, 0.4284, 0.2484],
    [1.2, 0.4047, 0.2096],
    [2.0, 0.3884, 0.1031],
    [3.0, 0.4111, 0.0452],
    [4.0, 0.4322, 0.0219],
];

impl Memory {
    /// The barge.
    pub fn barge() -> Self {
        let mut rows = vec![[0.0, 1e3 * BARGE[0][1], 0.0]];
        rows.extend(BARGE.map(|[w, a, b]| [w, 1e3 * a, 1e3 * b]));
        Self { rows }
    }

    /// A hemisphere of `radius` m that floats to its middle.
    pub fn hemisphere(radius: f64) -> Self {
        let mass = 2.0 / 3.0 * PI * 1000.0 * radius.powi(3);
        let mut rows = vec![[0.0, 0.831 * mass, 0.0]];
        rows.extend(HULME.map(|[ka, a, b]| {
            let omega = (G * ka / radius).sqrt();
            [omega, a * mass, b * mass * omega]
        }));
        let last = rows[rows.len() - 1][2];
        rows.extend([[3.5, 0.455, 0.4], [4.5, 0.475, 0.1], [6.0, 0.485, 0.0]].map(|[w, a, b]| [w, a * mass, b * last]));
        Self { rows }
    }

    /// All rows but that at rest: frequency, added mass, damping.
    pub fn rows(&self) -> &[[f64; 3]] {
        &self.rows[1..]
    }

    fn at(&self, omega: f64) -> [f64; 2] {
        let next = self.rows.partition_point(|row| row[0] <= omega).clamp(1, self.rows.len() - 1);
        let (low, high) = (self.rows[next - 1], self.rows[next]);
        let share = ((omega - low[0]) / (high[0] - low[0])).clamp(0.0, 1.0);
        [1, 2].map(|k| low[k] + share * (high[k] - low[k]))
    }

    /// Share of the release that is left at each time (s) of a body of `mass` kg that the water brings back with
    /// `stiffness` N/m.
    pub fn decay(&self, mass: f64, stiffness: f64, times: &[f64]) -> Vec<f64> {
        const STEPS: u32 = 6000;
        let first = 1e-3;
        let width = (self.rows[self.rows.len() - 1][0] - first) / f64::from(STEPS - 1);
        let mut left = vec![0.0; times.len()];
        for i in 0..STEPS {
            let omega = first + width * f64::from(i);
            let [added, damping] = self.at(omega);
            let whole = mass + added;
            // (i w (M + A) + B) / (C - w^2 (M + A) + i w B), its real part.
            let (re, im) = (stiffness - omega * omega * whole, omega * damping);
            let real = (damping * re + omega * whole * im) / (re * re + im * im);
            let end = if i == 0 || i == STEPS - 1 { 0.5 } else { 1.0 };
            for (left, time) in left.iter_mut().zip(times) {
                *left += 4.0 / TAU * end * width * real * (omega * time).cos();
            }
        }
        left
    }
}

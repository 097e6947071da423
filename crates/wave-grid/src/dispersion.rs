//! The waves that the discrete scheme carries in one direction.

use std::f64::consts::{PI, TAU};

use crate::{GridDesc, Stepping};

/// Least cells per wave that are asked of a grid.
const FEWEST_CELLS: f64 = 6.0;

/// Plane waves of one heading.
pub(crate) struct Direction {
    dt: f64,
    /// (c dt / h)^2 along x and z.
    a: [f64; 2],
    /// Four times the weight of the jumps beside a face.
    beside: f64,
    /// Cells along x and z, times the heading's cosine and sine, metres.
    cell: [f64; 2],
    /// Wavenumber of the shortest waves asked for, 1/m.
    most: f64,
}

impl Direction {
    /// Waves towards `heading` (radians from x towards z) in water of `speed`.
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping, speed: f64, heading: f64) -> Self {
        let (sin, cos) = libm::sincos(heading);
        let [hx, hz] = desc.cell_size.map(f64::from);
        let a = [hx, hz].map(|h| {
            let courant = speed * stepping.dt / h;
            courant * courant
        });
        let beside = 4.0 * desc.scheme.weights().1;
        Self { dt: stepping.dt, a, beside, cell: [cos * hx, sin * hz], most: TAU / (FEWEST_CELLS * hx.max(hz)) }
    }

    /// sin^2(omega dt / 2) of a wavenumber: ax sx^2 (1 - 4 w1 sz^2) + az sz^2 (1 - 4 w1 sx^2), s = sin(k h / 2).
    fn rate(&self, k: f64) -> f64 {
        let [sx, sz] = self.cell.map(|h| {
            let s = libm::sin(0.5 * k * h);
            s * s
        });
        self.a[0] * sx * (1.0 - self.beside * sz) + self.a[1] * sz * (1.0 - self.beside * sx)
    }

    /// The wavenumber of a period (seconds), 1/m, if a wave has at least 6 cells.
    pub(crate) fn number(&self, period: f64) -> Option<f64> {
        let half_turn = PI * self.dt / period;
        if !(period > 0.0 && half_turn < 0.5 * PI) {
            return None;
        }
        let sin = libm::sin(half_turn);
        let wanted = sin * sin;
        let (mut low, mut high) = (0.0, self.most);
        if !(wanted > 0.0 && self.rate(high) >= wanted * (1.0 - 1e-6)) {
            return None;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.rate(middle) < wanted { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    }

    /// Amplitude of the waves to either side of a line across this direction, along which a wave's period brings a flow
    /// of amplitude one, m^2/s; 1 / (2 c) for long waves.
    pub(crate) fn response(&self, k: f64) -> f64 {
        let step = 1e-3 * k;
        let slope = (self.rate(k + step) - self.rate(k - step)) / (2.0 * step);
        0.5 * self.dt * self.rate(k).sqrt() / slope
    }
}

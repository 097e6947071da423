//! A plane wave in the coupled discrete system.

/// What ties a field's mass to its stiffness: no eigenvalue of a screened field exceeds it. The scheme is stable below 4.
pub const TIED: f64 = 3.6;

/// A discrete Laplacian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Laplacian {
    /// Four neighbours.
    FivePoint,
    /// Eight neighbours, isotropic to fourth order.
    NinePoint,
}

impl Laplacian {
    /// Minus its symbol at wavenumber `k` (radians a cell) towards `angle` (from an axis), and the derivative by `k`.
    pub fn symbol(self, k: f64, angle: f64) -> [f64; 2] {
        let along = |c: f64| ((0.5 * k * c).sin().powi(2), 0.5 * c * (k * c).sin());
        let ((x, dx), (y, dy)) = (along(angle.cos()), along(angle.sin()));
        let both = match self {
            Laplacian::FivePoint => 0.0,
            Laplacian::NinePoint => 8.0 / 3.0,
        };
        [4.0 * (x + y) - both * x * y, 4.0 * (dx + dy) - both * (dx * y + x * dy)]
    }

    /// The largest value of the symbol.
    pub fn most(self) -> f64 {
        match self {
            Laplacian::FivePoint => 8.0,
            Laplacian::NinePoint => 16.0 / 3.0,
        }
    }
}

/// Coefficients at one depth, lengths in cells.
#[derive(Debug, Clone)]
pub struct Coefficients {
    /// Of the potential's own Laplacian.
    pub c: f64,
    /// Of the fields' Laplacians.
    pub s: Vec<f64>,
    /// Of the exchange between potential and fields.
    pub r: Vec<f64>,
}

/// A wave of the lowest branch, the water's.
#[derive(Debug, Clone, Copy)]
pub struct Wave {
    /// Radians a step.
    pub frequency: f64,
    /// Group speed, cells a step.
    pub group: f64,
    /// Share of the wave's energy that is in height and potential, not in the motion of the fields.
    pub share: f64,
}

impl Coefficients {
    /// The wave of wavenumber `k` towards `angle`. With x = 4 sin^2(w/2) and L minus the Laplacian's symbol,
    /// x = G [ c L + sum r_i y_i / (r_i + y_i) ], y_i = s_i L - mu_i x, below the first pole.
    pub fn wave(&self, g: f64, k: f64, angle: f64, laplacian: Laplacian) -> Wave {
        let [l, slope_l] = laplacian.symbol(k, angle);
        let fields = || self.s.iter().zip(&self.r).map(|(&s, &r)| (s, r, (laplacian.most() * s + 2.0 * r) / TIED));
        // The right side, and minus its derivative by x over G.
        let right = |x: f64| {
            fields().fold((self.c * l, 0.0), |(sum, slope), (s, r, mu)| {
                let y = s * l - mu * x;
                (sum + r * y / (r + y), slope + r * r * mu / (r + y).powi(2))
            })
        };
        // Newton's method, within an interval that halves when it leaves.
        let (mut low, mut high) = (0.0, fields().map(|(s, r, mu)| (r + s * l) / mu).fold(4.0, f64::min));
        let mut x = 0.0;
        for _ in 0..100 {
            let (sum, slope) = right(x);
            let excess = g * sum - x;
            if excess > 0.0 {
                low = x
            } else {
                high = x
            }
            let newton = x + excess / (1.0 + g * slope);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let done = (next - x).abs() <= 1e-15 * next;
            x = next;
            if done {
                break;
            }
        }
        let inertia = 1.0 + g * right(x).1;
        let rise = fields().fold(self.c, |sum, (s, r, mu)| sum + s * (r / (r + s * l - mu * x)).powi(2));
        let frequency = 2.0 * (0.5 * x.sqrt()).asin();
        Wave { frequency, group: g * rise / inertia * slope_l / (2.0 * frequency.sin()), share: 1.0 / inertia }
    }
}

/// Frequency (radians a step) and group speed (cells a step) by linear theory, w^2 = G k tanh(k h), `depth` in cells.
pub fn exact(g: f64, k: f64, depth: f64) -> (f64, f64) {
    let tanh = (k * depth).tanh();
    let frequency = (g * k * tanh).sqrt();
    let bed = if k * depth < 20.0 { k * depth * (1.0 - tanh * tanh) } else { 0.0 };
    (frequency, 0.5 * g * (tanh + bed) / frequency)
}

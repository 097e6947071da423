//! The numbers of a layer that moves: see [`crate::cpu::moving`].

/// zeta h/c at the outer edge of a layer that moves.
pub(crate) const PEAK: f64 = 1.5;
/// Speed over c from which that holds; below it the layer is stronger.
pub(crate) const SLOW: f64 = 0.1;
/// ln R of a layer that stands still.
pub(crate) const STILL: f64 = 26.0;

/// How a window moves, as its layer sees it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Motion {
    /// Velocity over the speed of waves.
    pub(crate) beta: [f64; 2],
    /// How far the layer stands ahead of the cells, -1 to 1 cells.
    pub(crate) lean: [f64; 2],
}

/// Coefficients of one axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull {
    /// Cells per sub-step.
    pub(crate) v: f32,
    /// g1.
    pub(crate) gamma: f32,
    /// k1.
    pub(crate) kappa: f32,
    pub(crate) beta: f32,
    /// (c dt/h)^2.
    pub(crate) a: f32,
}

/// What both axes share, and each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Boost {
    pub(crate) gamma: f32,
    pub(crate) axes: [Pull; 2],
}

impl Boost {
    pub(crate) fn new(beta: [f64; 2], a: [f64; 2]) -> Self {
        let gamma = |b: f64| 1.0 / (1.0 - b).sqrt();
        let all = gamma(beta[0] * beta[0] + beta[1] * beta[1]);
        let axes = [0, 1].map(|k| {
            let (own, v) = (gamma(beta[k] * beta[k]), beta[k] * a[k].sqrt());
            Pull { v: v as f32, gamma: own as f32, kappa: (own * v / all) as f32, beta: beta[k] as f32, a: a[k] as f32 }
        });
        Self { gamma: all as f32, axes }
    }
}

/// Z at nodes and on the edges before them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    pub(crate) node: Vec<f32>,
    pub(crate) edge: Vec<f32>,
}

impl Table {
    pub(crate) fn fill(&mut self, n: usize, width: f64, peak: f64, lean: f64) {
        let at = |x: f64| {
            let d = (width + lean - x).max(x - (n as f64 - 1.0 - width + lean)).clamp(0.0, width) / width;
            (peak * d * d * d) as f32
        };
        self.node.clear();
        self.edge.clear();
        self.node.extend((0..n).map(|i| at(i as f64)));
        self.edge.extend((0..n).map(|i| at(i as f64 - 0.5)));
    }
}

/// What N phi has beyond d/dx chi / g1. `zeta` at the node, `edges` on both sides of it; four times the mean chi, V z_x and z; the heights before, here, after.
#[inline(always)]
pub(crate) fn own(b: &Pull, zeta: f32, edges: [f32; 2], [chi, drift, z]: [f32; 3], heights: [f32; 3]) -> f32 {
    let k = b.kappa;
    let memory = k / b.a * zeta * (k * zeta * z - 0.25 * chi);
    let slope = if b.v == 0.0 { 0.0 } else { k / (b.gamma * b.v) * zeta * drift };
    let [low, high] = [edges[0] * (0.5 * (heights[0] + heights[1])), edges[1] * (0.5 * (heights[1] + heights[2]))];
    memory - slope - k * b.gamma * ((high - low) - b.beta * b.beta * (edges[1] - edges[0]) * z)
}

/// Weights of the five values around one for a cubic that reads `v` before it, |v| <= 1.
pub(crate) fn taps(v: f32) -> [f32; 5] {
    let t = v.abs();
    let (a, b) = ((t - 1.0) * (t - 2.0), t * (t + 1.0));
    let mut w = [0.0, -t * a / 6.0, 0.5 * (t + 1.0) * a, -0.5 * b * (t - 2.0), b * (t - 1.0) / 6.0];
    if v >= 0.0 {
        w.reverse();
    }
    w
}

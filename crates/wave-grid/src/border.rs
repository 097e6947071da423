//! The absorbing border: a perfectly matched layer after Grote & Sim (2010), bilinear in time.
//!
//! Z(d) = s0 (d/W)^m at distance d into the layer, W = w + 1, s0 = lnR (m + 1) sqrt(a) / (2 W), a that of the axis: Z
//! is zeta dt. The
//! outermost ring of cells is zero (Dirichlet). A layer that moves over the water is not perfectly matched; there a
//! gentler profile stays bounded and reflects less.

/// Strength of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Profile {
    /// Z at the outer edge, along x and z.
    pub(crate) peak: [f32; 2],
    /// Layer thickness W in cells, the zero ring included.
    pub(crate) thickness: usize,
    /// Exponent m, 3 or 4.
    pub(crate) exponent: i32,
}

impl Profile {
    /// The layer of a window that stands still, or of one that moves.
    pub(crate) fn new(pml_width: u32, a: [f64; 2], moving: bool) -> Self {
        let (exponent, ln_r) = match (moving, pml_width) {
            (true, _) => (3, 8.0),
            (false, 0..=8) => (3, 20.0),
            (false, 9..=15) => (3, 26.0),
            (false, _) => (4, 26.0),
        };
        let thickness = pml_width as usize + 1;
        let peak = a.map(|a| (ln_r * f64::from(exponent + 1) * a.sqrt() / (2.0 * thickness as f64)) as f32);
        Self { peak, thickness, exponent }
    }

    /// Z along an axis at position `x` (node i at x = i, the edge before it at i - 1/2) of an axis of `n` cells.
    fn at(&self, axis: usize, x: f32, n: usize) -> f32 {
        let w = self.thickness as f32;
        let d = ((w - x).max(x - (n as f32 - 1.0 - w)) / w).clamp(0.0, 1.0);
        let cubed = d * d * d;
        self.peak[axis] * if self.exponent == 4 { cubed * d } else { cubed }
    }
}

/// One axis of the layer: node values, and values on the edge before each node (one more than there are cells).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    /// Z at nodes.
    pub(crate) node: Vec<f32>,
    /// R = 1/(1 + Z/2) at nodes.
    pub(crate) node_gain: Vec<f32>,
    /// Z at edges.
    pub(crate) edge: Vec<f32>,
    /// R = 1/(1 + Z/2) at edges.
    pub(crate) gain: Vec<f32>,
    /// A = (1 - Z/2)/(1 + Z/2) at edges.
    pub(crate) keep: Vec<f32>,
}

impl Axis {
    /// The tables of an axis of `n` cells.
    pub(crate) fn new(profile: &Profile, axis: usize, n: usize) -> Self {
        let node: Vec<f32> = (0..=n).map(|i| profile.at(axis, i as f32, n)).collect();
        let edge: Vec<f32> = (0..=n).map(|i| profile.at(axis, i as f32 - 0.5, n)).collect();
        let gain = edge.iter().map(|e| 1.0 / (1.0 + 0.5 * e)).collect();
        let keep = edge.iter().map(|e| (1.0 - 0.5 * e) / (1.0 + 0.5 * e)).collect();
        let node_gain = node.iter().map(|z| 1.0 / (1.0 + 0.5 * z)).collect();
        Self { node, node_gain, edge, gain, keep }
    }
}

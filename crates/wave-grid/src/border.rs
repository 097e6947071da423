//! What is at the edge of a window. The default absorbs: a perfectly matched layer after Grote & Sim (2010), bilinear in time.
//!
//! Z(d) = s0 (d/W)^m at distance d into the layer, W = w + 1, s0 = lnR (m + 1) sqrt(a) / (2 W), a that of the axis: Z
//! is zeta dt. The
//! outermost ring of cells is zero (Dirichlet). A layer that moves over the water is not perfectly matched; there a
//! gentler profile stays bounded and reflects less.

use crate::cpu::tiles::Tiles;
use crate::state::State;

/// What is at the edge of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Border {
    /// A perfectly matched layer: what leaves is gone.
    Absorbing {
        /// Cells on each side: 4 to 20, up to 48 where waves disperse. 12 by default; 8 is cheaper, 16 better.
        width: u32,
    },
    /// Damping that grows towards the edge, for comparison: it reflects more than a thousand times as much as the layer.
    Sponge {
        /// Cells on each side: 4 to 20, up to 48 where waves disperse.
        width: u32,
    },
    /// Walls inside the outermost ring of cells: a basin. Nothing fades at its edge, and it takes no feed.
    Reflecting,
    /// The window less its outermost ring of cells repeats over the whole plane: detail such as rain. It stays where it is,
    /// everything given or asked for in world coordinates is taken modulo its period, and nothing fades. It takes no
    /// medium and no feed.
    Periodic,
}

impl Default for Border {
    fn default() -> Self {
        Self::Absorbing { width: 12 }
    }
}

impl Border {
    /// Cells on each side where waves are absorbed.
    pub const fn width(self) -> u32 {
        match self {
            Self::Absorbing { width } | Self::Sponge { width } => width,
            Self::Reflecting | Self::Periodic => 0,
        }
    }

    /// Where a cell of the outermost ring has its height from, along an axis of `n` cells.
    pub(crate) fn source(self, i: usize, n: usize) -> usize {
        match self {
            Self::Reflecting => i.clamp(1, n - 2),
            Self::Periodic if i == 0 => n - 2,
            Self::Periodic if i == n - 1 => 1,
            _ => i,
        }
    }

    /// Whether the outermost ring goes on as what is inside. The others' ring is zero.
    pub(crate) fn has_ring(self) -> bool {
        matches!(self, Self::Reflecting | Self::Periodic)
    }

    /// Fills the outermost ring of an array of cells.
    pub(crate) fn fill_ring(self, array: &mut [f32], [nx, nz]: [usize; 2]) {
        if !self.has_ring() {
            return;
        }
        for j in 1..nz - 1 {
            for i in [0, nx - 1] {
                array[j * nx + i] = array[j * nx + self.source(i, nx)];
            }
        }
        for j in [0, nz - 1] {
            let from = self.source(j, nz) * nx;
            array.copy_within(from..from + nx, j * nx);
        }
    }

    /// The same of all that is sampled and drawn.
    pub(crate) fn fill_rings(self, state: &mut State) {
        let size = [state.nx, state.nz];
        for array in [&mut state.z, &mut state.old, &mut state.foam] {
            self.fill_ring(array, size);
        }
    }

    /// Decides which tiles are stepped: of what repeats, all or none.
    pub(crate) fn schedule(self, tiles: &mut Tiles) {
        if self == Self::Periodic && !tiles.asleep() { tiles.activate_all() } else { tiles.schedule() }
    }
}

/// ln R of a sponge: more reflects at its inner side, less at the window's edge.
const SPONGE: f64 = 6.0;

/// Strength of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Profile {
    /// Z at the outer edge, along x and z.
    pub(crate) peak: [f32; 2],
    /// Layer thickness W in cells, the zero ring included.
    pub(crate) thickness: usize,
    /// Exponent m, 3 or 4.
    pub(crate) exponent: i32,
    /// Damping alone, without the memory that matches it.
    pub(crate) sponge: bool,
}

impl Profile {
    /// The layer of a window that stands still, or of one that moves.
    pub(crate) fn new(border: Border, a: [f64; 2], moving: bool) -> Self {
        let (exponent, ln_r) = match (border, moving) {
            (Border::Reflecting | Border::Periodic, _) => (3, 0.0),
            (Border::Sponge { .. }, _) => (3, SPONGE),
            (_, true) => (3, 8.0),
            (Border::Absorbing { width: 0..=8 }, false) => (3, 20.0),
            (Border::Absorbing { width: 9..=15 }, false) => (3, 26.0),
            (_, false) => (4, 26.0),
        };
        let thickness = border.width() as usize + 1;
        let peak = a.map(|a| (ln_r * f64::from(exponent + 1) * a.sqrt() / (2.0 * thickness as f64)) as f32);
        Self { peak, thickness, exponent, sponge: matches!(border, Border::Sponge { .. }) }
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
        let gain = edge.iter().map(|e| if profile.sponge { 0.0 } else { 1.0 / (1.0 + 0.5 * e) }).collect();
        let keep = edge.iter().map(|e| (1.0 - 0.5 * e) / (1.0 + 0.5 * e)).collect();
        let node_gain = node.iter().map(|z| 1.0 / (1.0 + 0.5 * z)).collect();
        Self { node, node_gain, edge, gain, keep }
    }
}

//! The dispersion of water waves by local fields: long waves outrun short ones, over a bed, between walls, without solving
//! for anything.
//!
//! The potential P = phi dt/h drives the height z through an operator that is |k| tanh(k d) on waves of 6 to 128 cells. It is
//! approximated by a Laplacian and [`FIELDS`] screened ones: a field X that obeys (r - s lap) X = r P passes what is longer
//! than its length sqrt(s/r) cells. Here no X is solved for: each is a field that swings about that, faster than any wave:
//!
//! ```text
//! a  = L_c(P) - sum_i r_i (P - X_i)          L_w(u): sum over the four faces of w (u of the neighbour - u)
//! z' = z - a
//! P' = (2 R - 1) P - R G z'                  G = g dt^2 / h, R = 1 / (1 + sigma dt / 2)
//! X' = 2 X - X_old + m (L_s(X) + r (P - X))  m = 3.6 / (2 sum over the faces of s + 2 r)
//! ```
//!
//! All weights are symmetric, so there is an energy; faces beside walls have none, so walls are exact mirrors. c and s
//! follow the depth at each face. Coefficients are fitted through the lowest eigenvalue of the whole discrete system,
//! so that the errors of space and time are part of the fit: see [`Table`].

pub(crate) mod bed;
pub(crate) mod fields;
mod fitted;
pub(crate) mod layer;
pub(crate) mod start;
mod table;

pub(crate) use bed::Bed;
pub(crate) use fields::Fields;
pub(crate) use layer::{Layer, Memory, Sides};
pub use table::{DEEP, FIELDS, MOST_G, Shares, Table};

use crate::{GridDesc, Stepping};

/// Of the largest stable m: what is left keeps the screened fields bounded at any depth.
const MASS: f64 = 3.6;

/// Coefficients of open water of one depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    pub(crate) c: f32,
    pub(crate) r: [f32; FIELDS],
    pub(crate) s: [f32; FIELDS],
    pub(crate) m: [f32; FIELDS],
    /// G = g dt^2 / h.
    pub(crate) g: f32,
    /// R = 1 / (1 + sigma dt / 2).
    pub(crate) damp: f32,
}

impl Law {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping, table: &Table) -> Self {
        let Shares { c, s } = table.at(desc.depth / desc.cell_size[0]);
        let r = table.r();
        let m = std::array::from_fn(|i| mobility(4.0 * s[i], r[i]));
        let damp = (1.0 / (1.0 + 0.5 * f64::from(desc.damping) * stepping.dt)) as f32;
        Self { c, r, s, m, g: stepping.a[0] as f32, damp }
    }
}

/// m of a cell whose faces have so much s in all.
pub(crate) fn mobility(s: f32, r: f32) -> f32 {
    (MASS / (2.0 * (f64::from(s) + f64::from(r)))) as f32
}

//! The coefficients of the scheme, and the inner loop of the border layer.
//!
//! Inner loops are inlined where the machine's vector units are known (see [`crate::cpu::step`]). Each cell does the same
//! operations in the same order on any of them, without fused multiply-add, so that the bits are the same.

use fearless_simd::Simd;
use open_water_shaders::grid::TINY;

use crate::cpu::lanes::{At, Lanes, Vector};
use crate::cpu::plain::PlainLaw;
use crate::{GridDesc, Stepping};

/// Coefficients of the scheme, dt folded in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coefficients {
    /// a w0 along x and z: a face's own jump.
    pub(crate) straight: [f32; 2],
    /// a w1 along x and z: the two jumps beside it.
    pub(crate) beside: [f32; 2],
    /// s = sigma dt / 2.
    pub(crate) damping: f32,
    /// Where c is uniform.
    pub(crate) plain: PlainLaw,
}

impl Coefficients {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping) -> Self {
        let (straight, beside) = desc.scheme.weights();
        Self {
            straight: stepping.a.map(|a| (a * straight) as f32),
            beside: stepping.a.map(|a| (a * beside) as f32),
            damping: (0.5 * f64::from(desc.damping) * stepping.dt) as f32,
            plain: PlainLaw::new(desc, stepping),
        }
    }
}

/// Zero instead of what would become a denormal.
#[inline(always)]
pub(crate) fn flush(x: f32) -> f32 {
    if x.abs() < TINY { 0.0 } else { x }
}

/// Notes the size of `x`. A NaN is not noted.
#[inline(always)]
pub(crate) fn note(most: &mut f32, x: f32) {
    let size = x.abs();
    *most = if size > *most { size } else { *most };
}

/// What a row of the border layer reads. Rows have n + 2 cells, edge data along x n + 1.
pub(crate) struct LayerRow<'a> {
    pub(crate) below: &'a [f32],
    pub(crate) row: &'a [f32],
    pub(crate) above: &'a [f32],
    /// phi on the x-edges of this row.
    pub(crate) phi_x: &'a [f32],
    /// phi on the z-edges below and above this row, n each.
    pub(crate) phi_z: [&'a [f32]; 2],
    /// Z and R at the nodes along x, n.
    pub(crate) node: &'a [f32],
    pub(crate) node_gain: &'a [f32],
    /// Z, R and A at the edges along x, n + 1.
    pub(crate) edge: &'a [f32],
    pub(crate) gain: &'a [f32],
    pub(crate) keep: &'a [f32],
    /// (Z, R) at this row.
    pub(crate) node_z: [f32; 2],
    /// (Z, R, A) at the z-edges below and above.
    pub(crate) edge_z: [[f32; 3]; 2],
}

/// Border layer: phi is advanced on the four edges of each cell, its own two are stored (`phi_x`, `phi_z`), and the largest
/// |z| of each column in `most`, n each.
///
/// z+ = z + R R/(1+s) [ (1-s)(1 - Zi/2)(1 - Zj/2)(z - z_old) - Zi Zj z + div(a grad z) + div(phibar) ], at s = 0
/// R R [ 2(1 - Zi Zj/4) z + div(a grad z) + div(phibar) ] - A A z_old arranged for small changes.
#[inline(always)]
pub(crate) fn layer_row<S: Simd>(
    simd: S,
    [old, phi_x, phi_z]: [&mut [f32]; 3],
    most: &mut [f32],
    r: &LayerRow,
    k: &Coefficients,
) {
    let n = old.len();
    let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
    let mut i = 0;
    while i < vectors {
        layer_cells(At::<Vector<S>> { make: simd, i }, [old, phi_x, phi_z], most, r, k);
        i += Vector::<S>::LEN;
    }
    for i in vectors..n {
        layer_cells(At::<f32> { make: (), i }, [old, phi_x, phi_z], most, r, k);
    }
}

#[inline(always)]
fn layer_cells<L: Lanes>(
    at: At<L>,
    [old, phi_x, phi_z]: [&mut [f32]; 3],
    most: &mut [f32],
    r: &LayerRow,
    k: &Coefficients,
) {
    let (straight_x, straight_z) = (at.all(k.straight[0]), at.all(k.straight[1]));
    let (beside_x, beside_z) = (at.all(k.beside[0]), at.all(k.beside[1]));
    let (sw, s, se) = (at.get(r.below, 0), at.get(r.below, 1), at.get(r.below, 2));
    let (w, z, e) = (at.get(r.row, 0), at.get(r.row, 1), at.get(r.row, 2));
    let (nw, n, ne) = (at.get(r.above, 0), at.get(r.above, 1), at.get(r.above, 2));
    let flux_w = straight_x * (z - w) + beside_x * ((n - nw) + (s - sw));
    let flux_e = straight_x * (e - z) + beside_x * ((ne - n) + (se - s));
    let flux_s = straight_z * (z - s) + beside_z * ((e - se) + (w - sw));
    let flux_n = straight_z * (n - z) + beside_z * ((ne - e) + (nw - w));
    let scale = at.all(r.node_z[1] / (1.0 + k.damping));
    let rate = at.all((1.0 - k.damping) * (1.0 - 0.5 * r.node_z[0]));
    let before = at.get(old, 0);
    let (layer, [phi_w, phi_s]) = layer(at, r, [flux_w, flux_e, flux_s, flux_n]);
    let plain = (flux_e - flux_w) + (flux_n - flux_s);
    let node = at.get(r.node, 0);
    let still = rate * (at.all(1.0) - at.all(0.5) * node) * (z - before) - node * at.all(r.node_z[0]) * z;
    let next = (z + scale * at.get(r.node_gain, 0) * (still + (plain + at.all(0.5) * layer))).flushed();
    next.store(old, at.i);
    next.note(most, at.i);
    phi_w.flushed().store(phi_x, at.i);
    phi_s.flushed().store(phi_z, at.i);
}

/// Twice div(phibar), and phi on the west and south edges, from the fluxes through the west, east, south and north edges.
#[inline(always)]
pub(crate) fn layer<L: Lanes>(at: At<L>, r: &LayerRow, [west, east, south, north]: [L; 4]) -> (L, [L; 2]) {
    let (w, e) = (at.get(r.phi_x, 0), at.get(r.phi_x, 1));
    let (s, n) = (at.get(r.phi_z[0], 0), at.get(r.phi_z[1], 0));
    let (phi_w, phi_e) = (along(at, r, 0, w, west), along(at, r, 1, e, east));
    let (phi_s, phi_n) = (across(at, r, 0, s, south), across(at, r, 1, n, north));
    (((phi_e + e) - (phi_w + w)) + ((phi_n + n) - (phi_s + s)), [phi_w, phi_s])
}

/// phi on the edge before (0) or after (1) the cells along x.
#[inline(always)]
fn along<L: Lanes>(at: At<L>, r: &LayerRow, edge: usize, phi: L, flux: L) -> L {
    at.get(r.keep, edge) * phi + at.get(r.gain, edge) * (at.all(r.node_z[0]) - at.get(r.edge, edge)) * flux
}

/// phi on the edge before (0) or after (1) the row.
#[inline(always)]
fn across<L: Lanes>(at: At<L>, r: &LayerRow, edge: usize, phi: L, flux: L) -> L {
    let [e, gain, keep] = r.edge_z[edge];
    at.all(keep) * phi + at.all(gain) * (at.get(r.node, 0) - at.all(e)) * flux
}

/// phi on an edge between a last cell and the zero ring: `before` are the heights of that cell and of its neighbours
/// along the ring, `weights` those of their jumps.
pub(crate) fn rim_phi(phi: f32, before: [f32; 3], edge: [f32; 3], across: f32, weights: [f32; 3]) -> f32 {
    let flux = -weights[1] * before[1] - (weights[0] * before[0] + weights[2] * before[2]);
    flush(edge[2] * phi + edge[1] * (across - edge[0]) * flux)
}

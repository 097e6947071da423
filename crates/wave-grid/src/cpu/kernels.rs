//! The coefficients of the scheme, and the inner loop of the border layer.
//!
//! Inner loops are inlined where the machine's vector units are known (see [`crate::cpu::step`]). Each cell does the same
//! operations in the same order on any of them, without fused multiply-add, so that the bits are the same.

use open_water_shaders::grid::TINY;

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
pub(crate) fn layer_row(
    old: &mut [f32],
    phi_x: &mut [f32],
    phi_z: &mut [f32],
    most: &mut [f32],
    r: &LayerRow,
    k: &Coefficients,
) {
    let n = old.len();
    let (phi_x, phi_z, most) = (&mut phi_x[..n], &mut phi_z[..n], &mut most[..n]);
    let (west, centre, east) = (&r.row[..n], &r.row[1..n + 1], &r.row[2..n + 2]);
    let (south_west, south, south_east) = (&r.below[..n], &r.below[1..n + 1], &r.below[2..n + 2]);
    let (north_west, north, north_east) = (&r.above[..n], &r.above[1..n + 1], &r.above[2..n + 2]);
    let (px0, px1) = (&r.phi_x[..n], &r.phi_x[1..n + 1]);
    let (pz0, pz1) = (&r.phi_z[0][..n], &r.phi_z[1][..n]);
    let (node, node_gain) = (&r.node[..n], &r.node_gain[..n]);
    let (edge0, edge1) = (&r.edge[..n], &r.edge[1..n + 1]);
    let (gain0, gain1) = (&r.gain[..n], &r.gain[1..n + 1]);
    let (keep0, keep1) = (&r.keep[..n], &r.keep[1..n + 1]);
    let [zj, gain_z] = r.node_z;
    let scale = gain_z / (1.0 + k.damping);
    let rate = (1.0 - k.damping) * (1.0 - 0.5 * zj);
    let [[e_s, r_s, a_s], [e_n, r_n, a_n]] = r.edge_z;
    let ([straight_x, straight_z], [beside_x, beside_z]) = (k.straight, k.beside);
    for i in 0..n {
        let z = centre[i];
        let (w, e, s, t) = (west[i], east[i], south[i], north[i]);
        let (sw, se, nw, ne) = (south_west[i], south_east[i], north_west[i], north_east[i]);
        let flux_w = straight_x * (z - w) + beside_x * ((t - nw) + (s - sw));
        let flux_e = straight_x * (e - z) + beside_x * ((ne - t) + (se - s));
        let flux_s = straight_z * (z - s) + beside_z * ((e - se) + (w - sw));
        let flux_n = straight_z * (t - z) + beside_z * ((ne - e) + (nw - w));
        let phi_w = keep0[i] * px0[i] + gain0[i] * (zj - edge0[i]) * flux_w;
        let phi_e = keep1[i] * px1[i] + gain1[i] * (zj - edge1[i]) * flux_e;
        let phi_s = a_s * pz0[i] + r_s * (node[i] - e_s) * flux_s;
        let phi_n = a_n * pz1[i] + r_n * (node[i] - e_n) * flux_n;
        let plain = (flux_e - flux_w) + (flux_n - flux_s);
        let layer = ((phi_e + px1[i]) - (phi_w + px0[i])) + ((phi_n + pz1[i]) - (phi_s + pz0[i]));
        let still = rate * (1.0 - 0.5 * node[i]) * (z - old[i]) - node[i] * zj * z;
        let next = flush(z + scale * node_gain[i] * (still + (plain + 0.5 * layer)));
        old[i] = next;
        note(&mut most[i], next);
        phi_x[i] = flush(phi_w);
        phi_z[i] = flush(phi_s);
    }
}

/// phi on an edge between a last cell and the zero ring: `before` are the heights of that cell and of its neighbours
/// along the ring, `weights` those of their jumps.
pub(crate) fn rim_phi(phi: f32, before: [f32; 3], edge: [f32; 3], across: f32, weights: [f32; 3]) -> f32 {
    let flux = -weights[1] * before[1] - (weights[0] * before[0] + weights[2] * before[2]);
    flush(edge[2] * phi + edge[1] * (across - edge[0]) * flux)
}

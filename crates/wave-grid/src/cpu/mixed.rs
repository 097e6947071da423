//! The inner loops of tiles whose medium varies: every face has its own coefficient, every cell its own damping.
//!
//! Flux through the face (i-1/2, j): W D + w1 sum of min(A, A') D' over the two faces beside it, D the jump across a
//! face, W = w0 A or more beside a wall. The weights are symmetric, so the scheme has an energy; with the mean instead of `min` it blows up at walls.
//! A cell with r = 0 keeps z+ = z_old: held water stays zero, and walls are filled in at the end of the tick.

use crate::cpu::kernels::{LayerRow, flush, note};

/// What a row of n cells reads of the medium.
pub(crate) struct GroundRow<'a> {
    /// Faces before the cells along x, of the rows below, here and above: n + 1 each.
    pub(crate) faces_x: [&'a [f32]; 3],
    /// Faces below and above the row, n + 2 each: from one cell before to one after.
    pub(crate) faces_z: [&'a [f32]; 2],
    /// Weighted for their own jumps: faces before the cells along x of this row, n + 1, and those below and above it, n.
    pub(crate) own_x: &'a [f32],
    pub(crate) own_z: [&'a [f32]; 2],
    /// r of the cells, n.
    pub(crate) r: &'a [f32],
    /// Weight of the jumps beside a face.
    pub(crate) beside: f32,
}

/// The lesser, in one instruction: no number here is NaN.
#[inline(always)]
pub(crate) fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Fluxes through the west, east, south and north faces of cell `i`. `z` are the rows below, here and above, n + 2 each.
#[inline(always)]
fn fluxes(z: [&[f32]; 3], g: &GroundRow, i: usize) -> [f32; 4] {
    let [below, row, above] = z;
    let w1 = g.beside;
    let (c, w, e, s, n) = (row[i + 1], row[i], row[i + 2], below[i + 1], above[i + 1]);
    let (sw, se, nw, ne) = (below[i], below[i + 2], above[i], above[i + 2]);
    let [fx_s, fx, fx_n] = g.faces_x;
    let [fz_s, fz_n] = g.faces_z;
    let (a_w, a_e, a_s, a_n) = (fx[i], fx[i + 1], fz_s[i + 1], fz_n[i + 1]);
    let x = |a: f32, i: usize, north: f32, south: f32| w1 * (lesser(a, fx_n[i]) * north + lesser(a, fx_s[i]) * south);
    let z = |a: f32, f: &[f32], east: f32, west: f32| w1 * (lesser(a, f[i + 2]) * east + lesser(a, f[i]) * west);
    [
        g.own_x[i] * (c - w) + x(a_w, i, n - nw, s - sw),
        g.own_x[i + 1] * (e - c) + x(a_e, i + 1, ne - n, se - s),
        g.own_z[0][i] * (c - s) + z(a_s, fz_s, e - se, w - sw),
        g.own_z[1][i] * (n - c) + z(a_n, fz_n, ne - e, nw - w),
    ]
}

impl GroundRow<'_> {
    /// With lengths that the compiler sees.
    #[inline(always)]
    fn of(&self, n: usize) -> GroundRow<'_> {
        GroundRow {
            faces_x: self.faces_x.map(|f| &f[..n + 1]),
            faces_z: self.faces_z.map(|f| &f[..n + 2]),
            own_x: &self.own_x[..n + 1],
            own_z: self.own_z.map(|f| &f[..n]),
            r: &self.r[..n],
            beside: self.beside,
        }
    }
}

/// Away from the layer: z+ = z + (2r - 1)(z - z_old) + r div F.
#[inline(always)]
pub(crate) fn mixed_row(old: &mut [f32], most: &mut [f32], z: [&[f32]; 3], g: &GroundRow) {
    let n = old.len();
    let most = &mut most[..n];
    let z = z.map(|row| &row[..n + 2]);
    let g = g.of(n);
    for i in 0..n {
        let [west, east, south, north] = fluxes(z, &g, i);
        let c = z[1][i + 1];
        let r = g.r[i];
        let next = flush(c + ((2.0 * r - 1.0) * (c - old[i]) + r * ((east - west) + (north - south))));
        old[i] = next;
        note(&mut most[i], next);
    }
}

/// In the layer: as [`crate::cpu::kernels::layer_row`] with these fluxes.
#[inline(always)]
pub(crate) fn mixed_layer_row(
    old: &mut [f32],
    phi_x: &mut [f32],
    phi_z: &mut [f32],
    most: &mut [f32],
    l: &LayerRow,
    g: &GroundRow,
) {
    let n = old.len();
    let (phi_x, phi_z, most) = (&mut phi_x[..n], &mut phi_z[..n], &mut most[..n]);
    let z = [l.below, l.row, l.above].map(|row| &row[..n + 2]);
    let g = g.of(n);
    let (px0, px1) = (&l.phi_x[..n], &l.phi_x[1..n + 1]);
    let (pz0, pz1) = (&l.phi_z[0][..n], &l.phi_z[1][..n]);
    let (node, node_gain) = (&l.node[..n], &l.node_gain[..n]);
    let (edge0, edge1) = (&l.edge[..n], &l.edge[1..n + 1]);
    let (gain0, gain1) = (&l.gain[..n], &l.gain[1..n + 1]);
    let (keep0, keep1) = (&l.keep[..n], &l.keep[1..n + 1]);
    let [zj, gain_z] = l.node_z;
    let [[e_s, r_s, a_s], [e_n, r_n, a_n]] = l.edge_z;
    for i in 0..n {
        let [west, east, south, north] = fluxes(z, &g, i);
        let phi_w = keep0[i] * px0[i] + gain0[i] * (zj - edge0[i]) * west;
        let phi_e = keep1[i] * px1[i] + gain1[i] * (zj - edge1[i]) * east;
        let phi_s = a_s * pz0[i] + r_s * (node[i] - e_s) * south;
        let phi_n = a_n * pz1[i] + r_n * (node[i] - e_n) * north;
        let plain = (east - west) + (north - south);
        let layer = ((phi_e + px1[i]) - (phi_w + px0[i])) + ((phi_n + pz1[i]) - (phi_s + pz0[i]));
        let c = z[1][i + 1];
        let r = g.r[i];
        let rate = (2.0 * r - 1.0) * (1.0 - 0.5 * zj) * (1.0 - 0.5 * node[i]);
        let change = rate * (c - old[i]) + r * ((plain + 0.5 * layer) - node[i] * zj * c);
        let next = flush(c + gain_z * node_gain[i] * change);
        old[i] = next;
        note(&mut most[i], next);
        phi_x[i] = flush(phi_w);
        phi_z[i] = flush(phi_s);
    }
}

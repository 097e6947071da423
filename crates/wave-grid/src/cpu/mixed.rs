//! The inner loops of tiles whose medium varies: every face has its own coefficient, every cell its own damping.
//!
//! Flux through the face (i-1/2, j): W D + w1 sum of min(A, A') D' over the two faces beside it, D the jump across a
//! face, W = w0 A or more beside a wall. The weights are symmetric, so the scheme has an energy; with the mean instead of `min` it blows up at walls.
//! A cell with r = 0 keeps z+ = z_old: held water stays zero, and walls are filled in at the end of the tick.

use fearless_simd::Simd;

use crate::cpu::kernels::{LayerRow, layer};
use crate::cpu::lanes::{At, Lanes, Vector};

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

/// Fluxes through the west, east, south and north faces. `z` are the rows below, here and above, n + 2 each.
#[inline(always)]
fn fluxes<L: Lanes>(at: At<L>, z: [&[f32]; 3], g: &GroundRow) -> [L; 4] {
    let [below, row, above] = z;
    let (c, w, e) = (at.get(row, 1), at.get(row, 0), at.get(row, 2));
    let (s, sw, se) = (at.get(below, 1), at.get(below, 0), at.get(below, 2));
    let (n, nw, ne) = (at.get(above, 1), at.get(above, 0), at.get(above, 2));
    let [fz_s, fz_n] = g.faces_z;
    [
        at.get(g.own_x, 0) * (c - w) + beside_x(at, g, 0, n - nw, s - sw),
        at.get(g.own_x, 1) * (e - c) + beside_x(at, g, 1, ne - n, se - s),
        at.get(g.own_z[0], 0) * (c - s) + beside_z(at, g, fz_s, e - se, w - sw),
        at.get(g.own_z[1], 0) * (n - c) + beside_z(at, g, fz_n, ne - e, nw - w),
    ]
}

/// Of the jumps north and south of the one across a face along x.
#[inline(always)]
fn beside_x<L: Lanes>(at: At<L>, g: &GroundRow, face: usize, north: L, south: L) -> L {
    let [below, here, above] = g.faces_x;
    let here = at.get(here, face);
    at.all(g.beside) * (here.lesser(at.get(above, face)) * north + here.lesser(at.get(below, face)) * south)
}

/// Of the jumps east and west of the one across a face along z.
#[inline(always)]
fn beside_z<L: Lanes>(at: At<L>, g: &GroundRow, faces: &[f32], east: L, west: L) -> L {
    let here = at.get(faces, 1);
    at.all(g.beside) * (here.lesser(at.get(faces, 2)) * east + here.lesser(at.get(faces, 0)) * west)
}

/// Away from the layer: z+ = z + (2r - 1)(z - z_old) + r div F.
#[inline(always)]
pub(crate) fn mixed_row<S: Simd>(simd: S, old: &mut [f32], most: &mut [f32], z: [&[f32]; 3], g: &GroundRow) {
    let n = old.len();
    let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
    let mut i = 0;
    while i < vectors {
        mixed_cells(At::<Vector<S>> { make: simd, i }, old, most, z, g);
        i += Vector::<S>::LEN;
    }
    for i in vectors..n {
        mixed_cells(At::<f32> { make: (), i }, old, most, z, g);
    }
}

#[inline(always)]
fn mixed_cells<L: Lanes>(at: At<L>, old: &mut [f32], most: &mut [f32], z: [&[f32]; 3], g: &GroundRow) {
    let [west, east, south, north] = fluxes(at, z, g);
    let (c, before, r) = (at.get(z[1], 1), at.get(old, 0), at.get(g.r, 0));
    let keep = at.all(2.0) * r - at.all(1.0);
    let next = (c + (keep * (c - before) + r * ((east - west) + (north - south)))).flushed();
    next.store(old, at.i);
    next.note(most, at.i);
}

/// In the layer: as [`crate::cpu::kernels::layer_row`] with these fluxes.
#[inline(always)]
pub(crate) fn mixed_layer_row<S: Simd>(
    simd: S,
    [old, phi_x, phi_z]: [&mut [f32]; 3],
    most: &mut [f32],
    l: &LayerRow,
    g: &GroundRow,
) {
    let n = old.len();
    let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
    let mut i = 0;
    while i < vectors {
        mixed_layer_cells(At::<Vector<S>> { make: simd, i }, [old, phi_x, phi_z], most, l, g);
        i += Vector::<S>::LEN;
    }
    for i in vectors..n {
        mixed_layer_cells(At::<f32> { make: (), i }, [old, phi_x, phi_z], most, l, g);
    }
}

#[inline(always)]
fn mixed_layer_cells<L: Lanes>(
    at: At<L>,
    [old, phi_x, phi_z]: [&mut [f32]; 3],
    most: &mut [f32],
    l: &LayerRow,
    g: &GroundRow,
) {
    let flux = fluxes(at, [l.below, l.row, l.above], g);
    let (layer, [phi_w, phi_s]) = layer(at, l, flux);
    let [west, east, south, north] = flux;
    let plain = (east - west) + (north - south);
    let (c, r, node) = (at.get(l.row, 1), at.get(g.r, 0), at.get(l.node, 0));
    let keep = at.all(2.0) * r - at.all(1.0);
    let rate = keep * at.all(1.0 - 0.5 * l.node_z[0]) * (at.all(1.0) - at.all(0.5) * node);
    let before = at.get(old, 0);
    let change = rate * (c - before) + r * ((plain + at.all(0.5) * layer) - node * at.all(l.node_z[0]) * c);
    let next = (c + at.all(l.node_z[1]) * at.get(l.node_gain, 0) * change).flushed();
    next.store(old, at.i);
    next.note(most, at.i);
    phi_w.flushed().store(phi_x, at.i);
    phi_s.flushed().store(phi_z, at.i);
}

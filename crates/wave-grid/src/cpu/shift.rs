//! Moves the state under a window that moved by whole cells.
//!
//! z, z_old and phi move together (phi kept fixed to the window is unstable); what enters is zero; phi that left the
//! layer is zeroed, because there it would never decay.

use std::ops::Range;

use crate::state::State;

/// Cell i takes what cell i + shift held. `thickness` is W of the layer.
pub(crate) fn shift(state: &mut State, shift: [i64; 2], thickness: usize) {
    let (nx, nz) = (state.nx, state.nz);
    for array in state.arrays() {
        array.shift(shift);
    }
    for array in [&mut state.z, &mut state.old, &mut state.foam] {
        array[..nx].fill(0.0);
        array[(nz - 1) * nx..].fill(0.0);
        for row in array.chunks_exact_mut(nx) {
            row[0] = 0.0;
            row[nx - 1] = 0.0;
        }
    }
    if state.phi[0].is_empty() {
        return;
    }
    let w = thickness;
    let State { phi: [x, z], phi_next: [next_x, next_z], .. } = state;
    // No step writes phi where no edge of an open cell is: left there, it would come back with the opposite shift.
    for phi in [&mut *x, &mut *next_x, &mut *z, &mut *next_z] {
        phi[..nx].fill(0.0);
        phi.iter_mut().step_by(nx).for_each(|phi| *phi = 0.0);
    }
    for phi_x in [&mut *x, &mut *next_x] {
        phi_x[(nz - 1) * nx..].fill(0.0);
    }
    for phi_z in [&mut *z, &mut *next_z] {
        phi_z.iter_mut().skip(nx - 1).step_by(nx).for_each(|phi| *phi = 0.0);
    }
    // Elsewhere inside it is zero already.
    let [left_x, left_z] = shift.map(|s| s.unsigned_abs() as usize);
    for phi in [x, next_x] {
        clear_frame(phi, nx, [w + 1..nx - w, w..nz - w], [left_x, left_z]);
    }
    for phi in [z, next_z] {
        clear_frame(phi, nx, [w..nx - w, w + 1..nz - w], [left_x, left_z]);
    }
}

/// Zeroes the cells of a rectangle that are within `depth` of its sides.
fn clear_frame(array: &mut [f32], nx: usize, [x, z]: [Range<usize>; 2], depth: [usize; 2]) {
    let [deep_x, deep_z] = [depth[0].min(x.len()), depth[1].min(z.len())];
    for j in z.clone() {
        let row = &mut array[j * nx..(j + 1) * nx];
        if j < z.start + deep_z || j >= z.end - deep_z {
            row[x.clone()].fill(0.0);
        } else {
            row[x.start..x.start + deep_x].fill(0.0);
            row[x.end - deep_x..x.end].fill(0.0);
        }
    }
}

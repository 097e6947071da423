//! Moves the state under a window that moved by whole cells.
//!
//! z, z_old and phi move together (phi kept fixed to the window is unstable); what enters is zero; phi that left the
//! layer is zeroed, because there it would never decay.

use crate::state::State;

/// Cell i takes what cell i + shift held. `thickness` is W of the layer.
pub(crate) fn shift(state: &mut State, shift: [i64; 2], thickness: usize) {
    let (nx, nz) = (state.nx, state.nz);
    for array in state.arrays() {
        shift_array(array, nx, nz, shift);
    }
    for array in [&mut state.z, &mut state.old, &mut state.foam] {
        array[..nx].fill(0.0);
        array[(nz - 1) * nx..].fill(0.0);
        for row in array.chunks_exact_mut(nx) {
            row[0] = 0.0;
            row[nx - 1] = 0.0;
        }
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
    for j in w..nz - w {
        let row = j * nx..(j + 1) * nx;
        for phi_x in [&mut *x, &mut *next_x] {
            phi_x[row.clone()][w + 1..nx - w].fill(0.0);
        }
        if j > w {
            for phi_z in [&mut *z, &mut *next_z] {
                phi_z[row.clone()][w..nx - w].fill(0.0);
            }
        }
    }
}

/// Moves one array; what enters is zero.
pub(crate) fn shift_array(array: &mut [f32], nx: usize, nz: usize, shift: [i64; 2]) {
    let offset = shift[1] * nx as i64 + shift[0];
    let distance = offset.unsigned_abs() as usize;
    let len = array.len();
    if distance >= len {
        array.fill(0.0);
        return;
    }
    if offset > 0 {
        array.copy_within(distance.., 0);
    } else {
        array.copy_within(..len - distance, distance);
    }
    let (sx, sz) = ((shift[0].unsigned_abs() as usize).min(nx), (shift[1].unsigned_abs() as usize).min(nz));
    if shift[1] > 0 {
        array[(nz - sz) * nx..].fill(0.0);
    } else {
        array[..sz * nx].fill(0.0);
    }
    let entering = if shift[0] > 0 { nx - sx..nx } else { 0..sx };
    for row in array.chunks_exact_mut(nx) {
        row[entering.clone()].fill(0.0);
    }
}

//! What is uploaded: height between two ticks with the fade, and foam.

use crate::state::State;

/// Writes (height, foam) of every cell, both faded.
pub(crate) fn draw(state: &State, fade: &[Vec<f32>; 2], alpha: f32, out: &mut [[f32; 2]]) {
    let nx = state.nx;
    for (j, out) in out.chunks_exact_mut(nx).enumerate().take(state.nz) {
        let row = j * nx..(j + 1) * nx;
        let (z, previous, foam) = (&state.z[row.clone()], &state.previous[row.clone()], &state.foam[row]);
        let fade_z = fade[1][j];
        let fade_x = &fade[0][..nx];
        for i in 0..nx {
            let f = fade_z * fade_x[i];
            out[i] = [f * (previous[i] + alpha * (z[i] - previous[i])), f * foam[i]];
        }
    }
}

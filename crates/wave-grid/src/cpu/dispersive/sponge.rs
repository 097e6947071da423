//! The sponge, for comparison with the layer: every field fades towards the window's edge.

use crate::dispersive::Fields;
use crate::state::State;

/// sigma at the window's edge over sqrt(g / h): 2 / s where cells are 0.5 m.
const STRENGTH: f32 = 0.45;

/// Fades all fields of a border of `width` cells by a sub-step.
pub(crate) fn damp(state: &mut State, fields: &mut Fields, width: usize) {
    let (nx, nz) = (state.nx, state.nz);
    let peak = STRENGTH * fields.law.g.sqrt();
    let factor: Vec<f32> = (0..width)
        .map(|i| {
            let depth = (width - i) as f32 / width as f32;
            libm::expf(-peak * depth * depth * depth)
        })
        .collect();
    let of = |i: usize, n: usize| factor.get(i.min(n - 1 - i)).copied().unwrap_or(1.0);
    let State { z, old, .. } = state;
    let arrays = fields.kept_mut().into_iter().chain([z, old]);
    for array in arrays {
        for (j, row) in array.chunks_exact_mut(nx).enumerate() {
            let across = of(j, nz);
            if across < 1.0 {
                row.iter_mut().for_each(|v| *v *= across);
            }
            for i in (0..width).chain(nx - width..nx) {
                row[i] *= of(i, nx);
            }
        }
    }
}

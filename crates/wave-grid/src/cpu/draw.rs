//! What is uploaded: height between two ticks with the fade, and foam.

use crate::cpu::tiles::Tiles;
use crate::state::State;

/// Writes (height, foam) of every cell, both faded. Tiles that have not kept their heights of the tick before had those of
/// `before`.
pub(crate) fn draw(
    state: &State,
    tiles: &Tiles,
    before: &[f32],
    fade: &[Vec<f32>; 2],
    alpha: f32,
    out: &mut [[f32; 2]],
) {
    let nx = state.nx;
    for (j, out) in out.chunks_exact_mut(nx).enumerate().take(state.nz) {
        let fade_z = fade[1][j];
        let tz = tiles.of(1, j);
        let mut tx = 0;
        while tx < tiles.count[0] {
            let row = tiles.row(tz);
            let end = tx + row[tx..].iter().take_while(|tile| tile.kept == row[tx].kept).count();
            let x = tiles.span(0, tx).start..tiles.span(0, end - 1).end;
            let at = j * nx + x.start..j * nx + x.end;
            let previous = if row[tx].kept { &state.previous[at.clone()] } else { &before[at.clone()] };
            let (z, foam, fade_x) = (&state.z[at.clone()], &state.foam[at], &fade[0][x.clone()]);
            for ((((out, fade_x), previous), z), foam) in out[x].iter_mut().zip(fade_x).zip(previous).zip(z).zip(foam) {
                let f = fade_z * fade_x;
                *out = [f * (previous + alpha * (z - previous)), f * foam];
            }
            tx = end;
        }
    }
}

//! Heights of wall cells beside water, for what reads between cells: the mean of the water next to them, so that a cubic
//! kernel at a wall sees the water go on evenly. No face of a wall lets them act back.

use crate::cpu::tiles::{Class, Mode, Tiles};
use crate::ground::{Cells, REACH};
use crate::medium::NEAR_WALL;

/// Weight of a diagonal neighbour, one straight beside being 1: it counts where nothing is straight beside.
const DIAGONAL: f32 = 1.0 / 64.0;

/// Fills the near walls of the active tiles in each of `heights`.
pub(crate) fn fill<const N: usize>(mut heights: [&mut [f32]; N], tiles: &Tiles, cells: &Cells) {
    for tz in 0..tiles.count[1] {
        for tx in 0..tiles.count[0] {
            let tile = tiles.row(tz)[tx];
            if tile.walls && tile.class == Class::Mixed && tile.mode == Mode::Active {
                for j in tiles.span(1, tz) {
                    for i in tiles.span(0, tx) {
                        if cells.a[j * cells.nx + i] == NEAR_WALL {
                            fill_cell(&mut heights, cells, i, j);
                        }
                    }
                }
            }
        }
    }
}

/// Fills all near walls in each of `heights`.
#[cfg(feature = "gpu")]
pub(crate) fn fill_all<const N: usize>(mut heights: [&mut [f32]; N], cells: &Cells) {
    for at in (0..cells.a.len()).filter(|at| cells.a[*at] == NEAR_WALL) {
        fill_cell(&mut heights, cells, at % cells.nx, at / cells.nx);
    }
}

fn fill_cell<const N: usize>(heights: &mut [&mut [f32]; N], cells: &Cells, i: usize, j: usize) {
    let (nx, nz) = (cells.nx, cells.nz);
    let mut sums = [0.0f32; N];
    // The ring of eight around the cell, then the ring of sixteen.
    for reach in 1..=REACH {
        let mut total = 0.0f32;
        for y in j.saturating_sub(reach)..(j + reach + 1).min(nz) {
            let dy = y.abs_diff(j);
            // Only the ends of the rows between the first and the last.
            let step = if dy == reach { 1 } else { 2 * reach };
            for x in (i as isize - reach as isize..=(i + reach) as isize).step_by(step) {
                let Ok(x) = usize::try_from(x) else { continue };
                let at = y * nx + x;
                if x >= nx || cells.a[at] <= 0.0 {
                    continue;
                }
                let weight = if dy == 0 || x == i { 1.0 } else { DIAGONAL };
                total += weight;
                for (sum, heights) in sums.iter_mut().zip(&*heights) {
                    *sum += weight * heights[at];
                }
            }
        }
        if total > 0.0 {
            for (sum, heights) in sums.iter().zip(heights) {
                heights[j * nx + i] = sum / total;
            }
            return;
        }
    }
}

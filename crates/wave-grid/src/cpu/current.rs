//! Carries waves with a current: after every sub-step z and z_old move by U dt, which for an even current is all there is
//! to it.
//!
//! Fluxes through faces, along x, then along z, so that no water is made. A flux takes what a quartic through the sums of the
//! four cells around a face says lies within U dt of it: fourth order, and at 12 cells a wave 0.2 % slower than the
//! current and damped by 0.03 % for each wavelength that the wave travels at U = c / 4 (second order: 4.3 and 0.5 %;
//! third: 0.1 and 1.5 %). Nothing is carried through walls, nor where the current fades towards the border layer, whose
//! memory stands still.

use std::ops::Range;

use crate::cpu::kernels::flush;
use crate::cpu::tiles::{Mode, Tiles};
use crate::desc::TILE;
use crate::ground::Cells;
use crate::source::HEIGHT_LIMIT;

/// Cells inside the border layer over which a current fades.
const FADE: f32 = 24.0;
/// Most cells that a current towards a wall moves in a sub-step beside it, and how much more with each cell away: waves
/// grow where one that runs into walls piles them up faster than they spread.
pub(crate) const AT_WALLS: f32 = 0.1;
/// Cells before and after a face that a flux reads.
const REACH: usize = 2;

/// What a grid with a current needs besides its medium.
#[derive(Debug, Clone)]
pub(crate) struct Carrier {
    /// Share of the current left at each cell along x and along z.
    fade: [Vec<f32>; 2],
    scratch: [Vec<f32>; 2],
}

impl Carrier {
    /// For `cells` cells along each axis, within a layer of `thickness`.
    pub(crate) fn new(cells: [usize; 2], thickness: usize) -> Self {
        let fade = cells.map(|n| {
            let share = |i: usize| {
                let inside = i.min(n - 1 - i) as f32 - thickness as f32;
                let t = (inside / FADE).clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t)
            };
            (0..n).map(share).collect()
        });
        let zero = || vec![0.0; cells[0] * cells[1]];
        Self { fade, scratch: [zero(), zero()] }
    }

    /// Moves both heights on by a sub-step.
    pub(crate) fn carry(&mut self, heights: [&mut [f32]; 2], tiles: &Tiles, cells: &Cells) {
        let [z, old] = heights;
        let [first, second] = &mut self.scratch;
        let sweep = Sweep { tiles, cells, fade: &self.fade };
        rayon::join(|| sweep.run(z, first), || sweep.run(old, second));
    }
}

struct Sweep<'a> {
    tiles: &'a Tiles,
    cells: &'a Cells,
    fade: &'a [Vec<f32>; 2],
}

/// Most faces of a run.
const LANES: usize = TILE + 1;

/// A run of faces: index of the first of the two cells before and the two after each, and of the inner two how much of the
/// current is left (`share` for all of them).
struct Faces<'a> {
    axis: usize,
    at: [usize; 4],
    fade: [&'a [f32]; 2],
    share: [f32; 2],
    /// Not all cells around the tile are open.
    shut: bool,
}

impl<'a> Sweep<'a> {
    fn run(&self, z: &mut [f32], scratch: &mut [f32]) {
        for (x, rows, shut) in self.blocks() {
            // With the rows that the sweep along z reads.
            for j in rows.start - REACH..rows.end + REACH {
                self.row(z, scratch, j, x.clone(), shut);
            }
        }
        for (x, rows, shut) in self.blocks() {
            self.column(z, scratch, x, rows, shut);
        }
    }

    /// Cells of the tiles that have a current, and whether there are walls around.
    fn blocks(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>, bool)> + 'a {
        let Self { tiles, cells, .. } = *self;
        let within = |span: Range<usize>, n: usize| span.start.max(REACH)..span.end.min(n - REACH);
        let all = (0..tiles.count[1]).flat_map(|tz| (0..tiles.count[0]).map(move |tx| [tx, tz]));
        all.filter_map(move |[tx, tz]| {
            let tile = tiles.row(tz)[tx];
            let (x, z) = (within(tiles.span(0, tx), cells.nx), within(tiles.span(1, tz), cells.nz));
            let carried = tile.carried && tile.mode == Mode::Active && !x.is_empty() && !z.is_empty();
            carried.then_some((x, z, tile.shut))
        })
    }

    fn row(&self, z: &[f32], out: &mut [f32], j: usize, x: Range<usize>, shut: bool) {
        let (n, at) = (x.len(), j * self.cells.nx + x.start);
        let [before, after] = [x.start - 1, x.start].map(|i| &self.fade[0][i..i + n + 1]);
        let share = [self.fade[1][j]; 2];
        let mut flux = [0.0; LANES];
        let faces = Faces { axis: 0, at: [at - 2, at - 1, at, at + 1], fade: [before, after], share, shut };
        self.fluxes(&mut flux[..n + 1], z, &faces);
        let (out, z, low, high) = (&mut out[at..at + n], &z[at..at + n], &flux[..n], &flux[1..n + 1]);
        for i in 0..n {
            out[i] = z[i] - (high[i] - low[i]);
        }
    }

    fn column(&self, out: &mut [f32], z: &[f32], x: Range<usize>, rows: Range<usize>, shut: bool) {
        let (n, nx) = (x.len(), self.cells.nx);
        let fade = &self.fade[0][x.clone()];
        let mut flux = [[0.0; LANES]; 2];
        let below_row = |flux: &mut [f32], j: usize| {
            let at = j * nx + x.start;
            let share = [self.fade[1][j - 1], self.fade[1][j]];
            let at = [at - 2 * nx, at - nx, at, at + nx];
            self.fluxes(flux, z, &Faces { axis: 1, at, fade: [fade; 2], share, shut });
        };
        below_row(&mut flux[0][..n], rows.start);
        for j in rows {
            let [below, above] = &mut flux;
            below_row(&mut above[..n], j + 1);
            let at = j * nx + x.start;
            let (out, z, low, high) = (&mut out[at..at + n], &z[at..at + n], &below[..n], &above[..n]);
            for i in 0..n {
                // Where a strong current meets walls waves grow.
                out[i] = flush((z[i] - (high[i] - low[i])).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT));
            }
            flux.swap(0, 1);
        }
    }

    /// What flows through each face within a sub-step, in units of a cell's height.
    fn fluxes(&self, out: &mut [f32], z: &[f32], faces: &Faces) {
        let n = out.len();
        let &Faces { axis, at, fade, share, shut } = faces;
        let drift = &self.cells.drift[axis];
        let z = at.map(|at| &z[at..at + n]);
        let mut v = [0.0; LANES];
        let v = &mut v[..n];
        drifts(v, [at[1], at[2]].map(|at| &drift[at..at + n]), fade, share);
        if !shut {
            return quartic(out, v, z);
        }
        let Cells { a, r, .. } = self.cells;
        let (mut before, mut after) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..n {
            let open = at.map(|at| a[at + i] > 0.0 && r[at + i] > 0.0);
            // At a wall the water goes on evenly, and no current piles it up.
            before[i] = z[usize::from(!open[0])][i];
            after[i] = z[3 - usize::from(!open[3])][i];
            if !(open[1] && open[2]) {
                v[i] = 0.0;
            } else if !(open[0] && open[3]) {
                v[i] = v[i].clamp(-AT_WALLS, AT_WALLS);
            }
        }
        quartic(out, v, [&before[..n], z[1], z[2], &after[..n]]);
    }
}

/// The current at faces: the mean of the cells' beside them.
#[inline(never)]
fn drifts(v: &mut [f32], drift: [&[f32]; 2], fade: [&[f32]; 2], share: [f32; 2]) {
    let n = v.len();
    let ([u1, u2], [f1, f2]) = (drift.map(|u| &u[..n]), fade.map(|f| &f[..n]));
    for i in 0..n {
        v[i] = 0.5 * (u1[i] * f1[i] * share[0] + u2[i] * f2[i] * share[1]);
    }
}

/// The flux of a current `v` through faces with two cells before and two after.
#[inline(never)]
fn quartic(out: &mut [f32], v: &[f32], z: [&[f32]; 4]) {
    let n = out.len();
    let (v, [z0, z1, z2, z3]) = (&v[..n], z.map(|z| &z[..n]));
    for i in 0..n {
        let (v, sum, jump) = (v[i], z1[i] + z2[i], z2[i] - z1[i]);
        let (outer_sum, outer_jump) = (z0[i] + z3[i], z3[i] - z0[i]);
        let c1 = (7.0 * sum - outer_sum) * (1.0 / 12.0);
        let c2 = (15.0 * jump - outer_jump) * (1.0 / 24.0);
        let c3 = (outer_sum - sum) * (1.0 / 12.0);
        let c4 = (outer_jump - 3.0 * jump) * (1.0 / 24.0);
        out[i] = v * (c1 - v * (c2 - v * (c3 - v * c4)));
    }
}

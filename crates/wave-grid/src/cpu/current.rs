//! Carries waves with a current: after every sub-step z and z_old move by U dt, which for an even current is all there is
//! to it.
//!
//! Fluxes through faces, along x, then along z, so that no water is made. A flux takes what a quartic through the sums of the
//! four cells around a face says lies within U dt of it: fourth order, and at 12 cells a wave 0.2 % slower than the
//! current and damped by 0.03 % for each wavelength that the wave travels at U = c / 4 (second order: 4.3 and 0.5 %;
//! third: 0.1 and 1.5 %). Nothing is carried through walls, nor where the current fades towards the border layer, whose
//! memory stands still.

use crate::cpu::kernels::flush;
use crate::cpu::tiles::{Mode, Tiles};
use crate::desc::TILE;
use crate::ground::Cells;

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

/// What a run of at most 17 faces reads: of the two cells before each and the two after it the heights, whether they
/// are open, and of the inner two the current.
struct Faces<'a> {
    z: [&'a [f32]; 4],
    a: [&'a [f32]; 4],
    r: [&'a [f32]; 4],
    drift: [&'a [f32]; 2],
    fade: [&'a [f32]; 2],
    /// Of all faces, before and after.
    share: [f32; 2],
}

impl Sweep<'_> {
    fn run(&self, z: &mut [f32], scratch: &mut [f32]) {
        let Sweep { tiles, cells, .. } = *self;
        let (nx, nz) = (cells.nx, cells.nz);
        let carried = || {
            let all = (0..tiles.count[1]).flat_map(|tz| (0..tiles.count[0]).map(move |tx| [tx, tz]));
            all.filter(|[tx, tz]| {
                let tile = tiles.row(*tz)[*tx];
                tile.carried && tile.mode == Mode::Active
            })
        };
        let spans = |[tx, tz]: [usize; 2]| {
            let (x, z) = (tiles.span(0, tx), tiles.span(1, tz));
            (x.start.max(REACH)..x.end.min(nx - REACH), z.start.max(REACH)..z.end.min(nz - REACH))
        };
        let mut flux = [[0.0f32; TILE + 1]; 2];
        for tile in carried() {
            let (x, z_span) = spans(tile);
            if x.is_empty() || z_span.is_empty() {
                continue;
            }
            // With the rows that the sweep along z reads.
            for j in z_span.start - REACH..z_span.end + REACH {
                let n = x.len();
                self.fluxes(&mut flux[0][..n + 1], &self.along_x(z, j, x.start, n + 1));
                let row = j * nx + x.start..j * nx + x.end;
                let (out, z, flux) = (&mut scratch[row.clone()], &z[row], &flux[0]);
                for i in 0..n {
                    out[i] = z[i] - (flux[i + 1] - flux[i]);
                }
            }
        }
        for tile in carried() {
            let (x, z_span) = spans(tile);
            if x.is_empty() || z_span.is_empty() {
                continue;
            }
            let n = x.len();
            let [below, above] = &mut flux;
            self.fluxes(&mut below[..n], &self.along_z(scratch, z_span.start, x.start, n));
            for j in z_span {
                self.fluxes(&mut above[..n], &self.along_z(scratch, j + 1, x.start, n));
                let row = j * nx + x.start..j * nx + x.end;
                let (out, z) = (&mut z[row.clone()], &scratch[row]);
                for i in 0..n {
                    out[i] = flush(z[i] - (above[i] - below[i]));
                }
                std::mem::swap(below, above);
            }
        }
    }

    /// Faces `i..i + n` of row `j` along x.
    fn along_x<'b>(&'b self, z: &'b [f32], j: usize, i: usize, n: usize) -> Faces<'b> {
        let cells = self.cells;
        let at = j * cells.nx + i;
        let around = [0, 1, 2, 3].map(|k| at + k - 2..at + k - 2 + n);
        let fade = self.fade[1][j];
        Faces {
            z: around.clone().map(|at| &z[at]),
            a: around.clone().map(|at| &cells.a[at]),
            r: around.clone().map(|at| &cells.r[at]),
            drift: [1, 2].map(|k: usize| &cells.drift[0][around[k].clone()]),
            fade: [&self.fade[0][i - 1..i - 1 + n], &self.fade[0][i..i + n]],
            share: [fade; 2],
        }
    }

    /// Faces below row `j` of columns `i..i + n`.
    fn along_z<'b>(&'b self, z: &'b [f32], j: usize, i: usize, n: usize) -> Faces<'b> {
        let cells = self.cells;
        let around = [0, 1, 2, 3].map(|k| {
            let at = (j + k - 2) * cells.nx + i;
            at..at + n
        });
        let fade = &self.fade[0][i..i + n];
        Faces {
            z: around.clone().map(|at| &z[at]),
            a: around.clone().map(|at| &cells.a[at]),
            r: around.clone().map(|at| &cells.r[at]),
            drift: [1, 2].map(|k: usize| &cells.drift[1][around[k].clone()]),
            fade: [fade; 2],
            share: [self.fade[1][j - 1], self.fade[1][j]],
        }
    }

    /// What flows through each face within a sub-step, in units of a cell's height.
    fn fluxes(&self, out: &mut [f32], f: &Faces) {
        let n = out.len().min(TILE + 1);
        let out = &mut out[..n];
        let [z0, z1, z2, z3] = f.z.map(|z| &z[..n]);
        let [a0, a1, a2, a3] = f.a.map(|a| &a[..n]);
        let [r0, r1, r2, r3] = f.r.map(|r| &r[..n]);
        let ([u1, u2], [f1, f2]) = (f.drift.map(|u| &u[..n]), f.fade.map(|f| &f[..n]));
        for i in 0..n {
            // Whether water moves in a cell: a > 0 and r > 0.
            let open = |a: &[f32], r: &[f32]| if a[i] < r[i] { a[i] } else { r[i] } > 0.0;
            let v = 0.5 * (u1[i] * f1[i] * f.share[0] + u2[i] * f2[i] * f.share[1]);
            let v = if open(a1, r1) && open(a2, r2) { v } else { 0.0 };
            let (low, high) = (z1[i], z2[i]);
            // At a wall the water goes on evenly, and no current piles it up.
            let (wet_before, wet_after) = (open(a0, r0), open(a3, r3));
            let v = if wet_before && wet_after { v } else { v.clamp(-AT_WALLS, AT_WALLS) };
            let before = if wet_before { z0[i] } else { low };
            let after = if wet_after { z3[i] } else { high };
            let (sum, jump) = (low + high, high - low);
            let (outer_sum, outer_jump) = (before + after, after - before);
            let c1 = (7.0 * sum - outer_sum) * (1.0 / 12.0);
            let c2 = (15.0 * jump - outer_jump) * (1.0 / 24.0);
            let c3 = (outer_sum - sum) * (1.0 / 12.0);
            let c4 = (outer_jump - 3.0 * jump) * (1.0 / 24.0);
            out[i] = v * (c1 - v * (c2 - v * (c3 - v * c4)));
        }
    }
}

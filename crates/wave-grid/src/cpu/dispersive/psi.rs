//! The layer's psi on all faces of the frame.

use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};

use crate::cpu::lanes::{At, Lanes, Vector};
use crate::cpu::tiles::{Mode, Tiles};
use crate::dispersive::layer::{Axis, MEMORIES};
use crate::dispersive::{Fields, Memory};

/// Brings psi up to date beside the tiles that are stepped.
pub(crate) fn advance(fields: &mut Fields, tiles: &Tiles, level: Level) {
    let Fields { potential, screened: [a, b, c], layer, .. } = fields;
    let Some(layer) = layer else { return };
    let waves: [&[f32]; MEMORIES] = [potential, a, b, c];
    let Memory { cells: [nx, nz], reach, span, psi: [along, across], .. } = &mut layer.memory;
    let frame = Frame { nx: *nx, nz: *nz, reach: *reach, span: *span, tiles, axes: &layer.axes };
    rayon::join(
        || along.iter_mut().zip(waves).for_each(|(psi, u)| dispatch!(level, simd => frame.along(simd, psi, u))),
        || across.iter_mut().zip(waves).for_each(|(psi, u)| dispatch!(level, simd => frame.across(simd, psi, u))),
    );
}

struct Frame<'a> {
    nx: usize,
    nz: usize,
    reach: usize,
    span: usize,
    tiles: &'a Tiles,
    axes: &'a [Axis; 2],
}

impl Frame<'_> {
    /// Whether any tile that covers these cells is stepped.
    fn busy(&self, x: Range<usize>, z: Range<usize>) -> bool {
        let columns = self.tiles.of(0, x.start)..=self.tiles.of(0, x.end - 1);
        (self.tiles.of(1, z.start)..=self.tiles.of(1, z.end - 1))
            .any(|tz| self.tiles.row(tz)[columns.clone()].iter().any(|tile| tile.mode == Mode::Active))
    }

    /// Faces along x.
    #[inline(always)]
    fn along<S: Simd>(&self, simd: S, psi: &mut [f32], u: &[f32]) {
        let (nx, reach, span) = (self.nx, self.reach, self.span);
        let [b, c] = &self.axes[0].edge;
        for tz in 0..self.tiles.count[1] {
            let rows = self.tiles.span(1, tz);
            if rows.is_empty() {
                continue;
            }
            // The first face, its entry, and how many.
            for (first, entry, count) in [(1, 1, reach), (nx - reach, span, reach)] {
                if !self.busy(first - 1..(first + count).min(nx), rows.clone()) {
                    continue;
                }
                for j in rows.start.max(1)..rows.end.min(self.nz - 1) {
                    let at = j * 2 * span + entry;
                    let (u, from) = (&u[j * nx..(j + 1) * nx], first..first + count);
                    let jumps = [&u[first - 1..first - 1 + count], &u[from.clone()]];
                    row(simd, &mut psi[at..at + count], jumps, Along::Faces([&b[from.clone()], &c[from]]));
                }
            }
        }
    }

    /// Faces along z.
    #[inline(always)]
    fn across<S: Simd>(&self, simd: S, psi: &mut [f32], u: &[f32]) {
        let (nx, nz, reach, span) = (self.nx, self.nz, self.reach, self.span);
        let [b, c] = &self.axes[1].edge;
        for (first, entry) in [(1, 1), (nz - reach, span)] {
            for tx in 0..self.tiles.count[0] {
                let columns = self.tiles.span(0, tx);
                if columns.is_empty() || !self.busy(columns.clone(), first - 1..first + reach) {
                    continue;
                }
                let x = columns.start.max(1)..columns.end.min(nx - 1);
                for k in 0..reach {
                    let (j, at) = (first + k, (entry + k) * nx);
                    let jumps = [j - 1, j].map(|j| &u[j * nx + x.start..j * nx + x.end]);
                    row(simd, &mut psi[at + x.start..at + x.end], jumps, Along::Row([b[j], c[j]]));
                }
            }
        }
    }
}

/// b and c of the faces of a row.
#[derive(Clone, Copy)]
enum Along<'a> {
    Faces([&'a [f32]; 2]),
    Row([f32; 2]),
}

#[inline(always)]
fn row<S: Simd>(simd: S, psi: &mut [f32], jumps: [&[f32]; 2], factors: Along) {
    let n = psi.len();
    let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
    let mut i = 0;
    while i < vectors {
        face(At::<Vector<S>> { make: simd, i }, psi, jumps, factors);
        i += Vector::<S>::LEN;
    }
    for i in vectors..n {
        face(At::<f32> { make: (), i }, psi, jumps, factors);
    }
}

#[inline(always)]
fn face<L: Lanes>(at: At<L>, psi: &mut [f32], [before, after]: [&[f32]; 2], factors: Along) {
    let [b, c] = match factors {
        Along::Faces([b, c]) => [at.get(b, 0), at.get(c, 0)],
        Along::Row([b, c]) => [at.all(b), at.all(c)],
    };
    let next = b * at.get(psi, 0) + c * (at.get(after, 0) - at.get(before, 0));
    next.flushed().store(psi, at.i);
}

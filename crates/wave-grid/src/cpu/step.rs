//! One sub-step of a grid: every active tile, the interior and the border layer with their own inner loops, inlined here for
//! each of the vector units that a machine may have.

use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};

use crate::border::Axis;
use crate::cpu::band::Band;
use crate::cpu::boost::Motion;
use crate::cpu::kernels::{Coefficients, LayerRow, layer_row, rim_phi};
use crate::cpu::lanes::Lanes;
use crate::cpu::mixed::{GroundRow, mixed_layer_row, mixed_row};
use crate::cpu::moving::{MovingLayer, Surroundings};
use crate::cpu::plain::Block;
use crate::cpu::tiles::{Class, Mode, Tile, Tiles};
use crate::desc::MOST_CELLS;
use crate::ground::Cells;
use crate::state::State;

/// Active tiles below this are stepped on one thread: waking others costs more than it saves.
const PARALLEL_TILES: usize = 384;
/// Pieces that each thread gets, for those that start late to take fewer.
const PIECES: usize = 2;
/// The strips of the layer on both sides are rounded up to whole vectors; where Z is zero, the layer is the interior.
const STRIP: usize = 8;

/// Cells along x at both sides that the layer takes.
pub(crate) fn strip(thickness: usize) -> usize {
    thickness.next_multiple_of(STRIP)
}

/// Which tiles keep their heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keep {
    Nothing,
    /// Those with a current.
    Carried,
    All,
}

/// What a sub-step takes besides the state.
pub(crate) struct Setting<'a> {
    pub(crate) level: Level,
    pub(crate) tiles: &'a Tiles,
    pub(crate) axes: &'a [Axis; 2],
    pub(crate) thickness: usize,
    pub(crate) coefficients: Coefficients,
    /// (c dt/h)^2 along x and z.
    pub(crate) a: [f64; 2],
    /// The medium where it varies.
    pub(crate) cells: Option<&'a Cells>,
    /// Active tiles whose heights are copied to `previous` if they have not kept them yet.
    pub(crate) keep: Keep,
    /// The layer is made by [`MovingLayer`].
    pub(crate) moves: bool,
}

impl Setting<'_> {
    /// What the layer of a moving window needs to know.
    pub(crate) fn surroundings(&self) -> Surroundings<'_> {
        let Self { level, tiles, thickness, a, .. } = *self;
        Surroundings { level, tiles, thickness, strip: strip(thickness), a, coefficients: &self.coefficients }
    }
}

/// What all rows read.
struct Shared<'a> {
    nx: usize,
    nz: usize,
    z: &'a [f32],
    phi: [&'a [f32]; 2],
    by: &'a Setting<'a>,
}

/// Advances the state by one sub-step. `tops` takes the largest |z| of each active tile.
pub(crate) fn step(
    state: &mut State,
    tops: &mut [f32],
    setting: &Setting,
    moving: Option<(&mut MovingLayer, &Motion)>,
) {
    let State { nx, nz, z, old, previous, phi, phi_next: [next_x, next_z], .. } = state;
    let shared = Shared { nx: *nx, nz: *nz, z, phi: [&phi[0], &phi[1]], by: setting };
    let band = Band { nx: *nx, first: 0, first_tile: 0, old, previous, phi_x: next_x, phi_z: next_z, tops };
    let tiles = setting.tiles;
    let pieces = if tiles.active >= PARALLEL_TILES { PIECES * rayon::current_num_threads() } else { 1 };
    walk(band, 0..tiles.count[1], pieces, &shared);
    if let Some((layer, motion)) = moving {
        layer.step(state, tops, motion, &setting.surroundings());
    }
    std::mem::swap(&mut state.z, &mut state.old);
    std::mem::swap(&mut state.phi, &mut state.phi_next);
}

/// Halves the rows of tiles over rayon's threads. Rows do not depend on each other, so neither do the bits.
fn walk(band: Band, rows: Range<usize>, pieces: usize, s: &Shared) {
    if pieces > 1 && rows.len() > 1 {
        let middle = rows.start + rows.len() / 2;
        let (low, high) = band.split(middle, s.by.tiles);
        let half = pieces.div_ceil(2);
        rayon::join(|| walk(low, rows.start..middle, half, s), || walk(high, middle..rows.end, half, s));
        return;
    }
    dispatch!(s.by.level, simd => step_band(simd, band, rows, s));
}

/// Whether two tiles take the same inner loop.
pub(crate) fn alike(a: &Tile, b: &Tile) -> bool {
    a.mode == b.mode && a.class == b.class && a.faint() == b.faint()
}

#[inline(always)]
fn step_band<S: Simd>(simd: S, mut band: Band, rows: Range<usize>, s: &Shared) {
    let mut most = [0.0f32; MOST_CELLS];
    let most = &mut most[..s.nx];
    let all = s.by.tiles;
    for tz in rows {
        let tiles = all.row(tz);
        let mut tx = 0;
        while tx < tiles.len() {
            let first = &tiles[tx];
            if first.mode != Mode::Active {
                tx += 1;
                continue;
            }
            let end = tx + tiles[tx..].iter().take_while(|t| alike(t, first)).count();
            let cells = all.span(0, tx).start..all.span(0, end - 1).end;
            if s.by.keep != Keep::Nothing {
                for (tx, tile) in (tx..end).zip(&tiles[tx..]) {
                    if !tile.kept && (s.by.keep == Keep::All || tile.carried) {
                        band.keep([tx, tz], s.z, all);
                    }
                }
            }
            most[cells.clone()].fill(0.0);
            let ground = s.by.cells.filter(|_| first.class != Class::Plain);
            let run = Run { x: cells, rows: all.span(1, tz), ground, faint: first.faint() };
            run.step(simd, &mut band, most, s);
            for tile in tx..end {
                *band.top(tz, tile, all) = most[all.span(0, tile)].iter().fold(0.0, |m, v| if *v > m { *v } else { m });
            }
            tx = end;
        }
    }
}

/// Neighbouring tiles of a row that are alike.
struct Run<'a> {
    /// Their cells.
    x: Range<usize>,
    rows: Range<usize>,
    ground: Option<&'a Cells>,
    /// They may hold values that are small enough to become denormals.
    faint: bool,
}

impl Run<'_> {
    #[inline(always)]
    fn step<S: Simd>(&self, simd: S, band: &mut Band, most: &mut [f32], s: &Shared) {
        let (nx, nz, w) = (s.nx, s.nz, s.by.thickness);
        if self.x.is_empty() {
            return;
        }
        let (start, end) = (self.x.start.max(1), self.x.end.min(nx - 1));
        let strip = strip(w);
        // Where neither end of a row lies in the layer.
        let inner = start.max(1 + strip)..end.min(nx - 1 - strip);
        for j in self.rows.clone() {
            if j == 0 {
                continue;
            }
            if s.by.moves {
                continue;
            }
            if j == nz - 1 {
                self.last_row(start..end, band, s);
                continue;
            }
            if j <= w || j >= nz - 1 - w || inner.is_empty() {
                self.layer(simd, j, start..end, band, most, s);
            } else {
                self.layer(simd, j, start..inner.start, band, most, s);
                self.layer(simd, j, inner.end..end, band, most, s);
                if let Some(cells) = self.ground {
                    let z = [j - 1, j, j + 1].map(|row| &s.z[row * nx + inner.start - 1..row * nx + inner.end + 1]);
                    let old = &mut band.old_row(j)[inner.clone()];
                    mixed_row(simd, old, &mut most[inner.clone()], z, &ground_row(cells, j, inner.clone()));
                }
            }
            if self.x.end == nx {
                self.last_column(j, band, s);
            }
        }
        let rows = self.rows.start.max(w + 1)..self.rows.end.min(nz - 1 - w);
        if self.ground.is_none() && !rows.is_empty() && !inner.is_empty() {
            let block = Block { nx, z: s.z, first: rows.start, rows: rows.len(), x: inner };
            block.step(simd, band.old_from(rows.start), most, &s.by.coefficients.plain, self.faint);
        }
    }

    /// Cells `x` of row `j`, in the layer.
    #[inline(always)]
    fn layer<S: Simd>(&self, simd: S, j: usize, x: Range<usize>, band: &mut Band, most: &mut [f32], s: &Shared) {
        if x.is_empty() {
            return;
        }
        let nx = s.nx;
        let (from, to) = (x.start, x.end);
        let around = |row: usize| &s.z[row * nx + from - 1..row * nx + to + 1];
        let [along, across] = s.by.axes;
        let row = LayerRow {
            below: around(j - 1),
            row: around(j),
            above: around(j + 1),
            phi_x: &s.phi[0][j * nx + from..j * nx + to + 1],
            phi_z: [&s.phi[1][j * nx + from..j * nx + to], &s.phi[1][(j + 1) * nx + from..(j + 1) * nx + to]],
            node: &along.node[from..to],
            node_gain: &along.node_gain[from..to],
            edge: &along.edge[from..to + 1],
            gain: &along.gain[from..to + 1],
            keep: &along.keep[from..to + 1],
            node_z: [across.node[j], across.node_gain[j]],
            edge_z: [j, j + 1].map(|j| [across.edge[j], across.gain[j], across.keep[j]]),
        };
        let out = band.rows(j).map(|row| &mut row[x.clone()]);
        let most = &mut most[x.clone()];
        match self.ground {
            Some(cells) => mixed_layer_row(simd, out, most, &row, &ground_row(cells, j, x)),
            None => layer_row(simd, out, most, &row, &s.by.coefficients),
        }
    }

    /// phi on the edges between the last row and the zero ring.
    fn last_row(&self, x: Range<usize>, band: &mut Band, s: &Shared) {
        let (j, nx) = (s.nz - 1, s.nx);
        let [along, across] = s.by.axes;
        let edge = [across.edge[j], across.gain[j], across.keep[j]];
        let [_, _, phi_z] = band.rows(j);
        for i in x {
            let at = (j - 1) * nx + i;
            let before = [s.z[at - 1], s.z[at], s.z[at + 1]];
            let weights = self.rim_weights(1, j * nx + i, 1, s);
            phi_z[i] = rim_phi(s.phi[1][j * nx + i], before, edge, along.node[i], weights);
        }
    }

    /// phi on the edge between the last cell of row `j` and the zero ring.
    fn last_column(&self, j: usize, band: &mut Band, s: &Shared) {
        let nx = s.nx;
        let [along, across] = s.by.axes;
        let (i, at) = (nx - 1, j * nx + nx - 2);
        let before = [s.z[at - nx], s.z[at], s.z[at + nx]];
        let edge = [along.edge[i], along.gain[i], along.keep[i]];
        let weights = self.rim_weights(0, j * nx + i, nx, s);
        let [_, phi_x, _] = band.rows(j);
        phi_x[i] = rim_phi(s.phi[0][j * nx + i], before, edge, across.node[j], weights);
    }

    /// Weights of the jumps across face `at` of an axis and across the two beside it, `step` cells away.
    fn rim_weights(&self, axis: usize, at: usize, step: usize, s: &Shared) -> [f32; 3] {
        let k = &s.by.coefficients;
        let Some(cells) = self.ground else { return [k.beside[axis], k.straight[axis], k.beside[axis]] };
        let faces = &cells.faces[axis];
        let here = faces[at];
        let beside = |at: usize| cells.weights[1] * here.lesser(faces[at]);
        [beside(at - step), cells.own[axis][at], beside(at + step)]
    }
}

#[inline(always)]
fn ground_row(cells: &Cells, j: usize, run: Range<usize>) -> GroundRow<'_> {
    let nx = cells.nx;
    let [x, z] = &cells.faces;
    let row = |j: usize| j * nx + run.start..j * nx + run.end;
    let along = |j: usize| &x[j * nx + run.start..j * nx + run.end + 1];
    let across = |j: usize| &z[j * nx + run.start - 1..j * nx + run.end + 1];
    GroundRow {
        faces_x: [along(j - 1), along(j), along(j + 1)],
        faces_z: [across(j), across(j + 1)],
        own_x: &cells.own[0][j * nx + run.start..j * nx + run.end + 1],
        own_z: [&cells.own[1][row(j)], &cells.own[1][row(j + 1)]],
        r: &cells.r[row(j)],
        beside: cells.weights[1],
    }
}

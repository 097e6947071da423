//! One sub-step of a grid: every active tile, the interior and the border layer with their own inner loops.

use std::ops::Range;

use crate::border::Axis;
use crate::cpu::kernels::{Coefficients, LayerRow, interior_row, layer_row, rim_phi};
use crate::cpu::mixed::{GroundRow, lesser, mixed_layer_row, mixed_row};
use crate::cpu::tiles::{Class, Mode, Tiles};
use crate::ground::Cells;
use crate::state::State;

/// Active tiles below this are stepped on one thread: waking others costs more than it saves.
const PARALLEL_TILES: usize = 384;
/// Rows of tiles that a thread takes at once.
const GRAIN: usize = 4;

/// What all rows read.
struct Shared<'a> {
    nx: usize,
    nz: usize,
    thickness: usize,
    z: &'a [f32],
    phi: [&'a [f32]; 2],
    axes: [&'a Axis; 2],
    tiles: &'a Tiles,
    coefficients: Coefficients,
    /// The medium where it varies.
    cells: Option<&'a Cells>,
}

/// Rows `first..` of what is written.
struct Band<'a> {
    first: usize,
    old: &'a mut [f32],
    phi_x: &'a mut [f32],
    phi_z: &'a mut [f32],
}

impl<'a> Band<'a> {
    fn split(self, row: usize, nx: usize) -> (Band<'a>, Band<'a>) {
        let at = (row - self.first) * nx;
        let (old, old1) = self.old.split_at_mut(at);
        let (phi_x, phi_x1) = self.phi_x.split_at_mut(at);
        let (phi_z, phi_z1) = self.phi_z.split_at_mut(at);
        let low = Band { first: self.first, old, phi_x, phi_z };
        (low, Band { first: row, old: old1, phi_x: phi_x1, phi_z: phi_z1 })
    }
}

/// What a sub-step takes besides the state.
pub(crate) struct Setting<'a> {
    pub(crate) tiles: &'a Tiles,
    pub(crate) axes: &'a [Axis; 2],
    pub(crate) thickness: usize,
    pub(crate) coefficients: Coefficients,
    pub(crate) cells: Option<&'a Cells>,
}

/// Advances the state by one sub-step.
pub(crate) fn step(state: &mut State, setting: &Setting) {
    let &Setting { tiles, axes, thickness, coefficients, cells } = setting;
    let State { nx, nz, z, old, phi, phi_next: [next_x, next_z], .. } = state;
    let shared = Shared {
        nx: *nx,
        nz: *nz,
        thickness,
        z,
        phi: [&phi[0], &phi[1]],
        axes: [&axes[0], &axes[1]],
        tiles,
        coefficients,
        cells,
    };
    let band = Band { first: 0, old, phi_x: next_x, phi_z: next_z };
    let grain = if tiles.active >= PARALLEL_TILES { GRAIN } else { usize::MAX };
    walk(band, 0..tiles.count[1], grain, &shared);
    std::mem::swap(&mut state.z, &mut state.old);
    std::mem::swap(&mut state.phi, &mut state.phi_next);
}

/// Halves the rows of tiles over rayon's threads. Rows do not depend on each other, so neither do the bits.
fn walk(band: Band, rows: Range<usize>, grain: usize, shared: &Shared) {
    if rows.len() > grain {
        let middle = rows.start + rows.len() / 2;
        let (low, high) = band.split(shared.tiles.span(1, middle).start, shared.nx);
        rayon::join(|| walk(low, rows.start..middle, grain, shared), || walk(high, middle..rows.end, grain, shared));
        return;
    }
    let Band { first, old, phi_x, phi_z } = band;
    for tz in rows {
        let tiles = shared.tiles.row(tz);
        let mut tx = 0;
        while tx < tiles.len() {
            let class = tiles[tx].class;
            let run = tiles[tx..].iter().take_while(|t| t.mode == Mode::Active && t.class == class).count();
            if run > 0 {
                let ground = shared.cells.filter(|_| class != Class::Plain);
                let cells = shared.tiles.span(0, tx).start..shared.tiles.span(0, tx + run - 1).end;
                for j in shared.tiles.span(1, tz) {
                    let at = (j - first) * shared.nx;
                    let row = at..at + shared.nx;
                    let (old, phi_x, phi_z) = (&mut old[row.clone()], &mut phi_x[row.clone()], &mut phi_z[row]);
                    let band = Band { first: j, old, phi_x, phi_z };
                    step_run(cells.clone(), band, ground, shared);
                }
            }
            tx += run.max(1);
        }
    }
}

/// Steps cells `run` of the band's one row.
fn step_run(run: Range<usize>, band: Band, ground: Option<&Cells>, s: &Shared) {
    let Band { first: j, old, phi_x, phi_z } = band;
    let (nx, nz, w) = (s.nx, s.nz, s.thickness);
    if j == 0 || run.is_empty() {
        return;
    }
    let (start, end) = (run.start.max(1), run.end.min(nx - 1));
    if j == nz - 1 {
        let z = s.axes[1];
        let edge = [z.edge[j], z.gain[j], z.keep[j]];
        for (i, phi) in phi_z.iter_mut().enumerate().take(end).skip(start) {
            let at = (j - 1) * nx + i;
            let before = [s.z[at - 1], s.z[at], s.z[at + 1]];
            let weights = rim_weights(1, j * nx + i, 1, ground, s);
            *phi = rim_phi(s.phi[1][j * nx + i], before, edge, s.axes[0].node[i], weights);
        }
        return;
    }
    let mut layer = |from: usize, to: usize, old: &mut [f32]| {
        if from < to {
            let row = Band { first: j, old, phi_x: &mut *phi_x, phi_z: &mut *phi_z };
            layer_run(from..to, row, ground, s);
        }
    };
    if j <= w || j >= nz - 1 - w {
        layer(start, end, old);
    } else {
        // The strips are rounded up to whole vectors; where Z is zero, the layer is the interior.
        let strip = w.next_multiple_of(4);
        let (left, right) = (1 + strip, nx - 1 - strip);
        layer(start, end.min(left), old);
        layer(start.max(right), end, old);
        let (from, to) = (start.max(left), end.min(right));
        if from < to {
            let around = |row: usize| &s.z[row * nx + from - 1..row * nx + to + 1];
            let (old, rows) = (&mut old[from..to], [around(j - 1), around(j), around(j + 1)]);
            match ground {
                Some(cells) => mixed_row(old, rows, &ground_row(cells, j, from..to)),
                None => interior_row(old, rows[0], rows[1], rows[2], s.coefficients),
            }
        }
    }
    if run.end == nx {
        let x = s.axes[0];
        let (i, at) = (nx - 1, j * nx + nx - 2);
        let before = [s.z[at - nx], s.z[at], s.z[at + nx]];
        let edge = [x.edge[i], x.gain[i], x.keep[i]];
        let weights = rim_weights(0, j * nx + i, nx, ground, s);
        phi_x[i] = rim_phi(s.phi[0][j * nx + i], before, edge, s.axes[1].node[j], weights);
    }
}

/// Weights of the jumps across face `at` of an axis and across the two beside it, `step` cells away.
fn rim_weights(axis: usize, at: usize, step: usize, ground: Option<&Cells>, s: &Shared) -> [f32; 3] {
    let k = s.coefficients;
    let Some(cells) = ground else { return [k.beside[axis], k.straight[axis], k.beside[axis]] };
    let faces = &cells.faces[axis];
    let here = faces[at];
    let beside = |at: usize| cells.weights[1] * lesser(here, faces[at]);
    [beside(at - step), cells.own[axis][at], beside(at + step)]
}

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

fn layer_run(run: Range<usize>, band: Band, ground: Option<&Cells>, s: &Shared) {
    let Band { first: j, old, phi_x, phi_z } = band;
    let nx = s.nx;
    let (from, to) = (run.start, run.end);
    let around = |row: usize| &s.z[row * nx + from - 1..row * nx + to + 1];
    let (x, z) = (s.axes[0], s.axes[1]);
    let row = LayerRow {
        below: around(j - 1),
        row: around(j),
        above: around(j + 1),
        phi_x: &s.phi[0][j * nx + from..j * nx + to + 1],
        phi_z: [&s.phi[1][j * nx + from..j * nx + to], &s.phi[1][(j + 1) * nx + from..(j + 1) * nx + to]],
        node: &x.node[from..to],
        node_gain: &x.node_gain[from..to],
        edge: &x.edge[from..to + 1],
        gain: &x.gain[from..to + 1],
        keep: &x.keep[from..to + 1],
        node_z: [z.node[j], z.node_gain[j]],
        edge_z: [[z.edge[j], z.gain[j], z.keep[j]], [z.edge[j + 1], z.gain[j + 1], z.keep[j + 1]]],
    };
    let (old, phi_x, phi_z) = (&mut old[from..to], &mut phi_x[from..to], &mut phi_z[from..to]);
    match ground {
        Some(cells) => mixed_layer_row(old, phi_x, phi_z, &row, &ground_row(cells, j, run)),
        None => layer_row(old, phi_x, phi_z, &row, s.coefficients),
    }
}

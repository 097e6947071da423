//! Walks over the tiles.

use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};

use super::band::{Band, Frame};
use super::general::{BedRow, Factors, General, LayerRow};
use super::plain::{Around, Input, Output, plain_row};
use super::{psi, sponge};
use crate::Border;
use crate::cpu::step::{Keep, alike};
use crate::cpu::tiles::{Class, Mode, Tiles};
use crate::desc::MOST_CELLS;
use crate::dispersive::fields::calm_edges;
use crate::dispersive::layer::{Axis, MEMORIES};
use crate::dispersive::{Bed, FIELDS, Fields, Law};
use crate::ground::Cells;
use crate::state::State;

/// Active tiles below this are stepped on one thread.
const PARALLEL_TILES: usize = 96;
/// Pieces that each thread gets, for those that start late to take fewer.
const PIECES: usize = 2;

/// What a sub-step takes besides the state.
pub(crate) struct Setting<'a> {
    pub(crate) level: Level,
    pub(crate) tiles: &'a Tiles,
    pub(crate) border: Border,
    /// The medium where it varies.
    pub(crate) cells: Option<&'a Cells>,
    /// Active tiles whose heights are copied to `previous` if they have not kept them yet.
    pub(crate) keep: Keep,
}

/// What all rows read.
struct Shared<'a> {
    nx: usize,
    nz: usize,
    z: &'a [f32],
    potential: &'a [f32],
    screened: [&'a [f32]; FIELDS],
    frame: Option<Frame<'a>>,
    axes: Option<&'a [Axis; 2]>,
    law: &'a Law,
    by: &'a Setting<'a>,
}

/// Advances the state by one sub-step. `tops` takes the largest |z| of each active tile.
pub(crate) fn step(state: &mut State, fields: &mut Fields, tops: &mut [f32], setting: &Setting) {
    let size = [state.nx, state.nz];
    setting.border.fill_ring(&mut fields.potential, size);
    fields.screened.iter_mut().for_each(|field| setting.border.fill_ring(field, size));
    psi::advance(fields, setting.tiles, setting.level);
    let Fields { potential, potential_next, screened, older, law, layer, .. } = &mut *fields;
    let State { nx, nz, z, old, previous, .. } = &mut *state;
    let (axes, memory) = match layer {
        Some(layer) => (Some(&layer.axes), Some(layer.memory.split())),
        None => (None, None),
    };
    let (frame, zeta) = match memory {
        Some((frame, zeta)) => (Some(frame), zeta),
        None => (None, [(); 2].map(|()| [(); MEMORIES].map(|()| &mut [][..]))),
    };
    let shared = Shared {
        nx: *nx,
        nz: *nz,
        z,
        potential,
        screened: std::array::from_fn(|k| &screened[k][..]),
        frame,
        axes,
        law,
        by: setting,
    };
    let older = older.each_mut().map(|field| &mut field[..]);
    let band = Band { first: 0, first_tile: 0, z: old, previous, potential: potential_next, older, zeta, tops };
    let tiles = setting.tiles;
    let pieces = if tiles.active >= PARALLEL_TILES { PIECES * rayon::current_num_threads() } else { 1 };
    walk(band, 0..tiles.count[1], pieces, &shared);
    if let Some(layer) = &fields.layer {
        let off = layer.sides.off();
        leave(&fields.potential, &mut fields.potential_next, size, off);
        for (now, next) in fields.screened.iter().zip(&mut fields.older) {
            leave(now, next, size, off);
        }
    }
    std::mem::swap(&mut state.z, &mut state.old);
    std::mem::swap(&mut fields.potential, &mut fields.potential_next);
    std::mem::swap(&mut fields.screened, &mut fields.older);
    if let Border::Sponge { width } = setting.border {
        sponge::damp(state, fields, width as usize);
    }
}

/// The outermost cells of the sides where the layer is off stay as they are, the others are zero.
fn leave(now: &[f32], next: &mut [f32], [nx, nz]: [usize; 2], off: [[bool; 2]; 2]) {
    let [along, across] = off;
    for (column, _) in [0, nx - 1].into_iter().zip(along).filter(|(_, off)| *off) {
        for at in (column..nx * nz).step_by(nx) {
            next[at] = now[at];
        }
    }
    for (row, _) in [0..nx, (nz - 1) * nx..nz * nx].into_iter().zip(across).filter(|(_, off)| *off) {
        next[row.clone()].copy_from_slice(&now[row]);
    }
    calm_edges(next, [nx, nz], off);
}

/// Halves the rows of tiles over rayon's threads. Rows do not depend on each other, so neither do the bits.
fn walk(band: Band, rows: Range<usize>, pieces: usize, s: &Shared) {
    if pieces > 1 && rows.len() > 1 {
        let middle = rows.start + rows.len() / 2;
        let (low, high) = band.split(middle, s.by.tiles, s.frame.as_ref());
        let half = pieces.div_ceil(2);
        rayon::join(|| walk(low, rows.start..middle, half, s), || walk(high, middle..rows.end, half, s));
        return;
    }
    dispatch!(s.by.level, simd => step_band(simd, band, rows, s));
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
            let x = all.span(0, tx).start..all.span(0, end - 1).end;
            if s.by.keep != Keep::Nothing {
                for (tx, tile) in (tx..end).zip(&tiles[tx..]) {
                    if !tile.kept && (s.by.keep == Keep::All || tile.carried) {
                        keep(&mut band, s, all.span(0, tx), all.span(1, tz));
                    }
                }
            }
            most[x.clone()].fill(0.0);
            let bed =
                s.by.cells.filter(|_| first.class != Class::Plain).and_then(|cells| Some((cells, cells.bed.as_ref()?)));
            for j in all.span(1, tz).filter(|j| (1..s.nz - 1).contains(j)) {
                step_row(simd, &mut band, most, s, j, x.start.max(1)..x.end.min(s.nx - 1), bed, first.faint());
            }
            for tile in tx..end {
                let top = most[all.span(0, tile)].iter().fold(0.0, |m, v| if *v > m { *v } else { m });
                band.tops[(tz - band.first_tile) * all.count[0] + tile] = top;
            }
            tx = end;
        }
    }
}

fn keep(band: &mut Band, s: &Shared, x: Range<usize>, z: Range<usize>) {
    for j in z {
        let at = (j - band.first) * s.nx;
        band.previous[at + x.start..at + x.end].copy_from_slice(&s.z[j * s.nx + x.start..j * s.nx + x.end]);
    }
}

/// A row of a run of tiles: what lies in the layer, and what does not.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
fn step_row<S: Simd>(
    simd: S,
    band: &mut Band,
    most: &mut [f32],
    s: &Shared,
    j: usize,
    x: Range<usize>,
    bed: Option<(&Cells, &Bed)>,
    faint: bool,
) {
    let (low, high) = match &s.frame {
        Some(frame) => (frame.reach, s.nx - frame.reach),
        None => (0, s.nx),
    };
    let across = s.frame.as_ref().is_some_and(|frame| j < frame.reach || j >= s.nz - frame.reach);
    for (part, along) in
        [(x.start..x.end.min(low), true), (x.start.max(low)..x.end.min(high), false), (x.start.max(high)..x.end, true)]
    {
        if part.is_empty() {
            continue;
        }
        let input = Input {
            potential: surround(s.potential, s.nx, j, &part),
            screened: [0, 1, 2].map(|k| surround(s.screened[k], s.nx, j, &part)),
            z: &s.z[j * s.nx + part.start..j * s.nx + part.end],
        };
        let row = (j - band.first) * s.nx;
        let own = row + part.start..row + part.end;
        let [a, b, c] = &mut band.older;
        let mut out = Output {
            z: &mut band.z[own.clone()],
            potential: &mut band.potential[own.clone()],
            older: [&mut a[own.clone()], &mut b[own.clone()], &mut c[own]],
            most: &mut most[part.clone()],
        };
        if !along && !across && bed.is_none() {
            if faint {
                plain_row::<S, true>(simd, &input, &mut out, s.law);
            } else {
                plain_row::<S, false>(simd, &input, &mut out, s.law);
            }
            continue;
        }
        let [zeta_x, zeta_z] = &mut band.zeta;
        let mut general = General { bed: bed.map(|bed| bed_row(bed, s.nx, j, &part)), along: None, across: None };
        if let (Some(frame), Some([axis_x, axis_z])) = (&s.frame, s.axes) {
            if along {
                let slot = if part.start >= high { frame.span + part.start - high } else { part.start };
                let (at, own) = (j * 2 * frame.span + slot, (j - band.first) * 2 * frame.span + slot);
                let n = part.len();
                general.along = Some(LayerRow {
                    before: frame.psi[0].map(|psi| &psi[at..at + n]),
                    after: frame.psi[0].map(|psi| &psi[at + 1..at + 1 + n]),
                    zeta: zeta_x.each_mut().map(|zeta| &mut zeta[own..own + n]),
                    factors: Factors::Cells(axis_x.node.each_ref().map(|factors| &factors[part.clone()])),
                });
            }
            if across {
                let entry = |j: usize| frame.rows_below(j) * s.nx;
                let (at, next, first) = (entry(j), entry(j) + s.nx, entry(band.first));
                let part = &part;
                general.across = Some(LayerRow {
                    before: frame.psi[1].map(|psi| &psi[at + part.start..at + part.end]),
                    after: frame.psi[1].map(|psi| &psi[next + part.start..next + part.end]),
                    zeta: zeta_z.each_mut().map(|zeta| &mut zeta[at - first + part.start..at - first + part.end]),
                    factors: Factors::Row([axis_z.node[0][j], axis_z.node[1][j]]),
                });
            }
        }
        general.row(simd, &input, &mut out, s.law);
    }
}

#[inline(always)]
fn surround<'a>(u: &'a [f32], nx: usize, j: usize, x: &Range<usize>) -> Around<'a> {
    let row = |j: usize| &u[j * nx + x.start - 1..j * nx + x.end + 1];
    Around { below: row(j - 1), row: row(j), above: row(j + 1) }
}

#[inline(always)]
fn bed_row<'a>((cells, bed): (&'a Cells, &'a Bed), nx: usize, j: usize, x: &Range<usize>) -> BedRow<'a> {
    let row = |j: usize| j * nx + x.start..j * nx + x.end;
    let [along, across] = &bed.faces;
    BedRow {
        along: std::array::from_fn(|k| &along[k][j * nx + x.start..j * nx + x.end + 1]),
        below: std::array::from_fn(|k| &across[k][row(j)]),
        above: std::array::from_fn(|k| &across[k][row(j + 1)]),
        m: std::array::from_fn(|k| &bed.m[k][row(j)]),
        damp: &cells.r[row(j)],
    }
}

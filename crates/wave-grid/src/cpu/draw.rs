//! What is uploaded: height between two ticks with the fade, and foam; and where there is any.

use crate::border::Border;
use crate::cpu::tiles::{Class, Mode, Tile, Tiles};
use crate::desc::TILE;
use crate::hole::Holes;
use crate::state::State;

/// What is drawn of a grid.
pub(crate) struct Drawing<'a> {
    pub(crate) state: &'a State,
    pub(crate) tiles: &'a Tiles,
    /// Heights of the tick before, of tiles that have not kept theirs.
    pub(crate) before: &'a [f32],
    pub(crate) fade: &'a [Vec<f32>; 2],
    pub(crate) holes: &'a Holes,
    pub(crate) alpha: f32,
}

impl Drawing<'_> {
    /// Writes (height, foam), both faded, of the cells from number `first` on.
    pub(crate) fn write(&self, first: usize, out: &mut [[f32; 2]]) {
        let nx = self.state.nx;
        let cells = (nx * self.state.nz).saturating_sub(first).min(out.len());
        let (mut at, mut out) = (first, &mut out[..cells]);
        while !out.is_empty() {
            let (j, x) = (at / nx, at % nx);
            let (row, rest) = out.split_at_mut((nx - x).min(out.len()));
            at += row.len();
            self.write_row(j, x, row);
            out = rest;
        }
    }

    /// Cells of row `j` from column `first` on.
    fn write_row(&self, j: usize, first: usize, out: &mut [[f32; 2]]) {
        let Self { state, tiles, before, fade, holes, alpha } = *self;
        let (nx, end) = (state.nx, first + out.len());
        let fade_z = fade[1][j];
        let row = tiles.row(tiles.of(1, j));
        let (mut tx, mut start) = (tiles.of(0, first), first);
        while start < end {
            let last = tx + row[tx..].iter().take_while(|tile| tile.kept == row[tx].kept).count();
            let x = start..tiles.span(0, last - 1).end.min(end);
            let at = j * nx + x.start..j * nx + x.end;
            let previous = if row[tx].kept { &state.previous[at.clone()] } else { &before[at.clone()] };
            let (z, foam, fade_x) = (&state.z[at.clone()], &state.foam[at], &fade[0][x.clone()]);
            let out = &mut out[x.start - first..x.end - first];
            for ((((out, fade_x), previous), z), foam) in out.iter_mut().zip(fade_x).zip(previous).zip(z).zip(foam) {
                let f = fade_z * fade_x;
                *out = [f * (previous + alpha * (z - previous)), f * foam];
            }
            (tx, start) = (last, x.end);
        }
        holes.cut(j, first, out);
    }
}

/// Where a tile may draw something.
fn shows(tile: &Tile) -> bool {
    let holds = tile.height > 0.0 || tile.top > 0.0 || tile.foam > 0.0;
    tile.class != Class::Solid && (tile.mode != Mode::Quiet || tile.kept || holds)
}

/// For each band of [`TILE`] rows of the window, the columns outside of which all that is drawn is zero.
pub(crate) fn shown(tiles: &Tiles, border: Border, bands: &mut Vec<[u32; 2]>) {
    let [nx, nz] = tiles.cells;
    bands.clear();
    bands.resize(nz.div_ceil(TILE), [0; 2]);
    // The outermost cells may have theirs from the tile beside.
    let more = usize::from(border.has_ring());
    for tz in 0..tiles.count[1] {
        let (row, rows) = (tiles.row(tz), tiles.span(1, tz));
        let (Some(first), Some(last)) = (row.iter().position(shows), row.iter().rposition(shows)) else { continue };
        let columns = tiles.span(0, first).start.saturating_sub(more)..(tiles.span(0, last).end + more).min(nx);
        if rows.is_empty() || columns.is_empty() {
            continue;
        }
        for [from, to] in &mut bands[rows.start.saturating_sub(more) / TILE..=(rows.end - 1 + more).min(nz - 1) / TILE]
        {
            let empty = from == to;
            *from = if empty { columns.start as u32 } else { (*from).min(columns.start as u32) };
            *to = (*to).max(columns.end as u32);
        }
    }
}

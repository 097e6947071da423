//! What one thread of a sub-step writes: some rows of every array.

use crate::cpu::tiles::Tiles;
use crate::dispersive::layer::MEMORIES;
use crate::dispersive::{FIELDS, Memory};

/// Rows `first..` of what is written, those of the tiles `first_tile..`.
pub(crate) struct Band<'a> {
    pub(crate) first: usize,
    pub(crate) first_tile: usize,
    /// The new heights.
    pub(crate) z: &'a mut [f32],
    pub(crate) previous: &'a mut [f32],
    pub(crate) potential: &'a mut [f32],
    pub(crate) older: [&'a mut [f32]; FIELDS],
    /// zeta along x: a row of entries each; along z: from its first row that has entries on.
    pub(crate) zeta: [[&'a mut [f32]; MEMORIES]; 2],
    pub(crate) tops: &'a mut [f32],
}

/// What the layer's entries stand in.
#[derive(Clone, Copy)]
pub(crate) struct Frame<'a> {
    pub(crate) span: usize,
    pub(crate) psi: [[&'a [f32]; MEMORIES]; 2],
    pub(crate) cells: [usize; 2],
    pub(crate) reach: usize,
}

impl Frame<'_> {
    /// How many rows below `row` have entries along z.
    pub(crate) fn rows_below(&self, row: usize) -> usize {
        row.min(self.span) + row.saturating_sub(self.cells[1] - self.reach)
    }
}

impl Memory {
    /// What is read and what is written of it in a sub-step.
    pub(crate) fn split(&mut self) -> (Frame<'_>, [[&mut [f32]; MEMORIES]; 2]) {
        let Self { cells, reach, span, psi, zeta } = self;
        let frame = Frame {
            span: *span,
            psi: [0, 1].map(|axis| std::array::from_fn(|k| &psi[axis][k][..])),
            cells: *cells,
            reach: *reach,
        };
        (frame, zeta.each_mut().map(|fields| fields.each_mut().map(|field| &mut field[..])))
    }
}

fn split_all<const N: usize>(arrays: [&mut [f32]; N], at: usize) -> [[&mut [f32]; N]; 2] {
    let mut high: [&mut [f32]; N] = std::array::from_fn(|_| &mut [][..]);
    let mut k = 0;
    let low = arrays.map(|array| {
        let at = at.min(array.len());
        let (low, rest) = array.split_at_mut(at);
        high[k] = rest;
        k += 1;
        low
    });
    [low, high]
}

impl<'a> Band<'a> {
    /// The rows before and from those of tiles `tile`.
    pub(crate) fn split(self, tile: usize, tiles: &Tiles, frame: Option<&Frame>) -> (Band<'a>, Band<'a>) {
        let nx = tiles.cells[0];
        let row = tiles.span(1, tile).start;
        let at = (row - self.first) * nx;
        let [[z, previous, potential], [z1, previous1, potential1]] =
            split_all([self.z, self.previous, self.potential], at);
        let [older, older1] = split_all(self.older, at);
        let (tops, tops1) = self.tops.split_at_mut((tile - self.first_tile) * tiles.count[0]);
        let at = frame.map_or([0; 2], |frame| {
            let rows = frame.rows_below(row) - frame.rows_below(self.first);
            [(row - self.first) * 2 * frame.span, rows * nx]
        });
        let [along, across] = self.zeta;
        let [[along, along1], [across, across1]] = [split_all(along, at[0]), split_all(across, at[1])];
        let (first, first_tile) = (self.first, self.first_tile);
        let low = Band { first, first_tile, z, previous, potential, older, zeta: [along, across], tops };
        let high = Band {
            first: row,
            first_tile: tile,
            z: z1,
            previous: previous1,
            potential: potential1,
            older: older1,
            zeta: [along1, across1],
            tops: tops1,
        };
        (low, high)
    }
}

//! What one thread of a sub-step writes: some rows of every array.

use crate::cpu::tiles::Tiles;

/// Rows `first..` of what is written, those of the tiles `first_tile..`.
pub(crate) struct Band<'a> {
    pub(crate) nx: usize,
    pub(crate) first: usize,
    pub(crate) first_tile: usize,
    pub(crate) old: &'a mut [f32],
    pub(crate) previous: &'a mut [f32],
    pub(crate) phi_x: &'a mut [f32],
    pub(crate) phi_z: &'a mut [f32],
    /// Largest |z| of each tile.
    pub(crate) tops: &'a mut [f32],
}

impl<'a> Band<'a> {
    /// The rows before and from those of tiles `tile`.
    pub(crate) fn split(self, tile: usize, tiles: &Tiles) -> (Band<'a>, Band<'a>) {
        let row = tiles.span(1, tile).start;
        let at = (row - self.first) * self.nx;
        let (old, old1) = self.old.split_at_mut(at);
        let (previous, previous1) = self.previous.split_at_mut(at);
        let (phi_x, phi_x1) = self.phi_x.split_at_mut(at);
        let (phi_z, phi_z1) = self.phi_z.split_at_mut(at);
        let (tops, tops1) = self.tops.split_at_mut((tile - self.first_tile) * tiles.count[0]);
        let low = Band { old, previous, phi_x, phi_z, tops, ..self };
        let high = Band {
            nx: low.nx,
            first: row,
            first_tile: tile,
            old: old1,
            previous: previous1,
            phi_x: phi_x1,
            phi_z: phi_z1,
            tops: tops1,
        };
        (low, high)
    }

    /// Row `j` of old, phi_x and phi_z.
    #[inline(always)]
    pub(crate) fn rows(&mut self, j: usize) -> [&mut [f32]; 3] {
        let at = (j - self.first) * self.nx;
        let row = at..at + self.nx;
        [&mut self.old[row.clone()], &mut self.phi_x[row.clone()], &mut self.phi_z[row]]
    }

    /// Row `j` of old.
    #[inline(always)]
    pub(crate) fn old_row(&mut self, j: usize) -> &mut [f32] {
        let [old, _, _] = self.rows(j);
        old
    }

    /// Old from row `j` on.
    #[inline(always)]
    pub(crate) fn old_from(&mut self, j: usize) -> &mut [f32] {
        &mut self.old[(j - self.first) * self.nx..]
    }

    /// The largest |z| of a tile.
    pub(crate) fn top(&mut self, tz: usize, tx: usize, tiles: &Tiles) -> &mut f32 {
        &mut self.tops[(tz - self.first_tile) * tiles.count[0] + tx]
    }

    /// Copies the heights of a tile.
    pub(crate) fn keep(&mut self, [tx, tz]: [usize; 2], z: &[f32], tiles: &Tiles) {
        let x = tiles.span(0, tx);
        for j in tiles.span(1, tz) {
            let at = (j - self.first) * self.nx;
            let row = &z[j * self.nx..(j + 1) * self.nx];
            self.previous[at + x.start..at + x.end].copy_from_slice(&row[x.clone()]);
        }
    }
}

//! The scheme's coefficients where the medium varies.

use std::ops::Range;
use std::sync::Arc;

use super::{FIELDS, Shares, Table, mobility};
use crate::cells::widened;
use crate::field::Field;

/// Depth and coefficients of a window's cells and faces, row-major, x fastest.
#[derive(Debug, Clone)]
pub(crate) struct Bed {
    table: Arc<Table>,
    /// Depth in cells, 0 in walls.
    pub(crate) depth: Field,
    /// c and then s of the faces before each cell along x and along z; 0 beside walls.
    pub(crate) faces: [[Field; 1 + FIELDS]; 2],
    /// m of each cell; 0 in walls and held water.
    pub(crate) m: [Field; FIELDS],
}

impl Bed {
    /// Of water of one depth (cells) everywhere.
    pub(crate) fn new(table: Arc<Table>, nx: usize, nz: usize, depth: f32) -> Self {
        let all = |value, stagger: usize| Field::new(nx, nz, value, stagger % 4);
        let Shares { c, s } = table.at(depth);
        let (of, r) = ([c, s[0], s[1], s[2]], table.r());
        Self {
            depth: all(depth, 0),
            faces: [0, 1].map(|axis| std::array::from_fn(|k| all(of[k], axis + k))),
            m: std::array::from_fn(|k| all(mobility(4.0 * s[k], r[k]), k)),
            table,
        }
    }

    /// Every array, to be moved with the window.
    pub(crate) fn arrays(&mut self) -> impl Iterator<Item = &mut Field> {
        let Self { table: _, depth, faces, m } = self;
        std::iter::once(depth).chain(faces.iter_mut().flatten()).chain(m)
    }

    /// Brings up to date what follows from the depths of a rectangle of cells. `open` tells which cells are water that moves,
    /// `wet` which are not walls.
    pub(crate) fn follow(
        &mut self,
        x: &Range<usize>,
        z: &Range<usize>,
        wet: impl Fn(usize) -> bool,
        open: impl Fn(usize) -> bool,
    ) {
        let nx = self.depth.width();
        let nz = self.depth.len() / nx;
        let r = self.table.r();
        for j in widened(z, 1, nz) {
            for i in widened(x, 1, nx) {
                let at = j * nx + i;
                for (axis, index, step) in [(0, i, 1), (1, j, nx)] {
                    let mut of = [0.0; 1 + FIELDS];
                    if index > 0 && wet(at) && wet(at - step) {
                        let shares = self.table.at(0.5 * (self.depth[at] + self.depth[at - step]));
                        of = [shares.c, shares.s[0], shares.s[1], shares.s[2]];
                    }
                    for (face, of) in self.faces[axis].iter_mut().zip(of) {
                        face[at] = of;
                    }
                }
            }
        }
        // The faces after a cell belong to the next one. One beside a wall or beyond the window weighs on the cell as the
        // cell's own water: so a wall is a mirror in time as well.
        for j in widened(z, 2, nz) {
            for i in widened(x, 2, nx) {
                let at = j * nx + i;
                let own = self.table.at(self.depth[at]).s;
                let sides = [
                    (0, at, i > 0 && wet(at - 1)),
                    (0, at + 1, i + 1 < nx && wet(at + 1)),
                    (1, at, j > 0 && wet(at - nx)),
                    (1, at + nx, j + 1 < nz && wet(at + nx)),
                ];
                for ((k, m), r) in self.m.iter_mut().enumerate().zip(r) {
                    let [west, east, south, north] =
                        sides.map(|(axis, face, wet)| if wet { self.faces[axis][k + 1][face] } else { own[k] });
                    m[at] = if open(at) { mobility((west + east) + (south + north), r) } else { 0.0 };
                }
            }
        }
    }
}

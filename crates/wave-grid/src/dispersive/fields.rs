//! What the dispersive scheme keeps besides heights.

use std::ops::Range;
use std::sync::Arc;

use super::{FIELDS, Law, Layer, Table};
use crate::cells::Cells;
use crate::field::Field;
use crate::{Border, GridDesc, Stepping};

/// Fields of a window, row-major, x fastest, metres.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fields {
    pub(crate) potential: Field,
    /// Where the next potential is written.
    pub(crate) potential_next: Field,
    pub(crate) screened: [Field; FIELDS],
    /// A sub-step ago; overwritten in place by the next.
    pub(crate) older: [Field; FIELDS],
    pub(crate) table: Arc<Table>,
    /// Of open water of the grid's own depth.
    pub(crate) law: Law,
    /// The border layer, if it absorbs.
    pub(crate) layer: Option<Layer>,
}

impl Fields {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping) -> Self {
        let [nx, nz] = desc.cells.map(|n| n as usize);
        let table = Arc::new(Table::new(stepping.a[0]));
        let zero = |stagger| Field::new(nx, nz, 0.0, stagger);
        Self {
            potential: zero(2),
            potential_next: zero(3),
            screened: [zero(0), zero(1), zero(2)],
            older: [zero(3), zero(0), zero(1)],
            law: Law::new(desc, stepping, &table),
            table,
            layer: match desc.border {
                Border::Absorbing { width } => Some(Layer::new([nx, nz], width as usize, stepping.a[0])),
                Border::Sponge { .. } | Border::Reflecting | Border::Periodic => None,
            },
        }
    }

    /// Every array that a moment is made of.
    pub(crate) fn kept(&self) -> [&Field; 1 + 2 * FIELDS] {
        let ([a, b, c], [d, e, f]) = (&self.screened, &self.older);
        [&self.potential, a, b, c, d, e, f]
    }

    /// The same to be written.
    pub(crate) fn kept_mut(&mut self) -> [&mut Field; 1 + 2 * FIELDS] {
        let ([a, b, c], [d, e, f]) = (&mut self.screened, &mut self.older);
        [&mut self.potential, a, b, c, d, e, f]
    }

    fn all(&mut self) -> [&mut Field; 2 + 2 * FIELDS] {
        let ([a, b, c], [d, e, f]) = (&mut self.screened, &mut self.older);
        [&mut self.potential, &mut self.potential_next, a, b, c, d, e, f]
    }

    pub(crate) fn clear(&mut self) {
        self.all().into_iter().for_each(|field| field.fill(0.0));
        if let Some(layer) = &mut self.layer {
            layer.memory.clear();
        }
    }

    /// Zeroes a rectangle of cells.
    pub(crate) fn clear_cells(&mut self, x: Range<usize>, z: Range<usize>) {
        if let Some(layer) = &mut self.layer {
            layer.memory.clear_cells(&x, &z);
        }
        let nx = self.potential.width();
        for j in z {
            for field in self.all() {
                field[j * nx + x.start..j * nx + x.end].fill(0.0);
            }
        }
    }

    /// Cell i takes what cell i + shift held; what enters is calm, and so are the outermost cells but at the sides where the
    /// layer is off.
    pub(crate) fn shift(&mut self, shift: [i64; 2]) {
        let off = self.layer.as_ref().map_or([[false; 2]; 2], |layer| layer.sides.off());
        for field in self.all() {
            field.shift(shift);
            let size = [field.width(), field.len() / field.width()];
            calm_edges(field, size, off);
        }
        if let Some(layer) = &mut self.layer {
            layer.memory.shift(shift);
        }
    }

    /// Zeroes the outermost ring of cells.
    pub(crate) fn clear_rim(&mut self) {
        for field in self.all() {
            let (nx, len) = (field.width(), field.len());
            field[..nx].fill(0.0);
            field[len - nx..].fill(0.0);
            for row in field.chunks_exact_mut(nx) {
                row[0] = 0.0;
                row[nx - 1] = 0.0;
            }
        }
    }

    /// Nothing stands in walls and held water.
    pub(crate) fn dry_walls(&mut self, cells: &Cells) {
        for field in self.all() {
            for (at, value) in field.iter_mut().enumerate() {
                *value = if cells.is_open(at) { *value } else { 0.0 };
            }
        }
    }
}

/// Zeroes the outermost cells of the sides where the layer is not off.
pub(crate) fn calm_edges(field: &mut [f32], [nx, nz]: [usize; 2], [along, across]: [[bool; 2]; 2]) {
    for (row, _) in [0..nx, (nz - 1) * nx..nz * nx].into_iter().zip(across).filter(|(_, off)| !off) {
        field[row].fill(0.0);
    }
    for (column, _) in [0, nx - 1].into_iter().zip(along).filter(|(_, off)| !off) {
        field[column..].iter_mut().step_by(nx).for_each(|value| *value = 0.0);
    }
}

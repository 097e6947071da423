//! The arrays of a grid, row-major, x fastest.

use crate::Scheme;
use crate::field::Field;
use crate::ground::Cells;

/// Fields of a window of `nx * nz` cells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct State {
    pub(crate) nx: usize,
    pub(crate) nz: usize,
    /// Height now, metres.
    pub(crate) z: Field,
    /// Height one sub-step ago; overwritten in place by the next one.
    pub(crate) old: Field,
    /// Height at the end of the tick before, for drawing between ticks; only where a tile has kept it.
    pub(crate) previous: Field,
    /// Foam, 0 to 1.
    pub(crate) foam: Field,
    /// phi on the edges before each cell along x and z, half a sub-step ago; zero outside the layer. Empty, as the next,
    /// where the layer is not the wave equation's.
    pub(crate) phi: [Field; 2],
    /// Where the next phi is written.
    pub(crate) phi_next: [Field; 2],
}

impl State {
    pub(crate) fn new(nx: usize, nz: usize, scheme: Scheme) -> Self {
        let zero = |stagger| Field::new(nx, nz, 0.0, stagger);
        let phi = |stagger| if scheme.is_wave_equation() { zero(stagger) } else { Field::default() };
        Self {
            nx,
            nz,
            z: zero(0),
            old: zero(1),
            previous: zero(2),
            foam: zero(3),
            phi: [phi(2), phi(3)],
            phi_next: [phi(2), phi(3)],
        }
    }

    /// Every array that moves with the water.
    pub(crate) fn arrays(&mut self) -> [&mut Field; 8] {
        let Self { nx: _, nz: _, z, old, previous, foam, phi: [x, y], phi_next: [next_x, next_y] } = self;
        [z, old, previous, foam, x, y, next_x, next_y]
    }

    pub(crate) fn clear(&mut self) {
        for array in self.arrays() {
            array.fill(0.0);
        }
    }

    /// Zeroes a rectangle of cells, except in `previous`.
    pub(crate) fn clear_cells(&mut self, x: std::ops::Range<usize>, z: std::ops::Range<usize>) {
        let nx = self.nx;
        let Self { nx: _, nz: _, z: height, old, previous: _, foam, phi: [a, b], phi_next: [c, d] } = self;
        for j in z {
            let arrays = [&mut *height, &mut *old, &mut *foam, &mut *a, &mut *b, &mut *c, &mut *d];
            for array in arrays.into_iter().filter(|array| !array.is_empty()) {
                array[j * nx + x.start..j * nx + x.end].fill(0.0);
            }
        }
    }

    /// Copies the heights of a rectangle of cells to `previous`.
    pub(crate) fn keep_cells(&mut self, x: std::ops::Range<usize>, z: std::ops::Range<usize>) {
        for j in z {
            let row = j * self.nx + x.start..j * self.nx + x.end;
            self.previous[row.clone()].copy_from_slice(&self.z[row]);
        }
    }

    /// Zeroes walls, held water, and the memory of faces that nothing flows through.
    pub(crate) fn dry_walls(&mut self, cells: &Cells) {
        let Self { nx: _, nz: _, z, old, previous, foam, phi, phi_next } = self;
        for at in 0..cells.a.len() {
            if !cells.is_open(at) {
                for array in [&mut *z, &mut *old, &mut *previous, &mut *foam] {
                    array[at] = 0.0;
                }
            }
        }
        for (k, faces) in cells.faces.iter().enumerate() {
            for phi in [&mut phi[k], &mut phi_next[k]] {
                for (phi, face) in phi.iter_mut().zip(faces.iter()) {
                    *phi = if *face == 0.0 { 0.0 } else { *phi };
                }
            }
        }
    }
}

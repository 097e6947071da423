//! The coefficients of a window's cells and faces, and what follows from which of them are walls.
//!
//! The coefficient of a face is the mean of its two cells', zero beside a wall. Where a wall runs across the end of a face,
//! no jump lies beyond; its weight goes to the face's own jump, so that a straight wall is an exact mirror. This is done for
//! whole walls only (both cells beyond): around single pillars it would raise the largest eigenvalue above that of
//! open water, by up to 12 %, and with it the bound of the step.

use std::ops::Range;

use glam::Vec2;

use crate::cpu::current::AT_WALLS;
use crate::cpu::tiles::{Class, Tiles};
use crate::dispersive::Bed;
use crate::field::Field;
use crate::medium::{DEEP_WALL, MOST_DRIFT, NEAR_WALL};

/// Cells around a wall cell in which water makes it a near one: as far as a cubic kernel reads.
pub(crate) const REACH: usize = 2;

/// Coefficients of a window's cells, row-major, x fastest.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    pub(crate) nx: usize,
    pub(crate) nz: usize,
    /// (c dt / h)^2 along x.
    pub(crate) a: Field,
    /// a along z over a along x.
    pub(crate) aspect: f32,
    pub(crate) r: Field,
    /// On the faces before each cell along x and z.
    pub(crate) faces: [Field; 2],
    /// Likewise, weighted for the face's own jump.
    pub(crate) own: [Field; 2],
    /// Weight of a face's own jump and of the two beside it.
    pub(crate) weights: [f32; 2],
    /// Cells that the current along x and z moves in a sub-step; empty while there is none.
    pub(crate) drift: [Field; 2],
    /// What the dispersive scheme takes instead of `a`.
    pub(crate) bed: Option<Bed>,
}

/// `range` widened on both sides within `0..n`.
pub(crate) fn widened(range: &Range<usize>, by: usize, n: usize) -> Range<usize> {
    range.start.saturating_sub(by)..(range.end + by).min(n)
}

impl Cells {
    /// Brings up to date what follows from the cells of a rectangle.
    pub(crate) fn follow(&mut self, tiles: &mut Tiles, x: &Range<usize>, z: &Range<usize>) {
        self.find_near_walls(x, z);
        self.average_faces(x, z);
        if let Some(bed) = &mut self.bed {
            let (a, r) = (&self.a, &self.r);
            bed.follow(x, z, |at| a[at] > 0.0, |at| a[at] > 0.0 && r[at] > 0.0);
        }
        self.find_solid_tiles(tiles, x, z);
    }

    /// Whether a cell is water that moves.
    pub(crate) fn is_open(&self, at: usize) -> bool {
        self.a[at] > 0.0 && self.r[at] > 0.0
    }

    pub(crate) fn set_drift(&mut self, at: usize, drift: Vec2) {
        if !self.drifts() {
            if drift == Vec2::ZERO {
                return;
            }
            self.drift = [0, 1].map(|_| Field::new(self.nx, self.nz, 0.0, 0));
        }
        (self.drift[0][at], self.drift[1][at]) = drift.into();
    }

    /// Whether there is any current.
    pub(crate) fn drifts(&self) -> bool {
        !self.drift[0].is_empty()
    }

    /// Tells the walls beside water from those that nothing sees.
    fn find_near_walls(&mut self, x: &Range<usize>, z: &Range<usize>) {
        for j in widened(z, REACH, self.nz) {
            for i in widened(x, REACH, self.nx) {
                let at = j * self.nx + i;
                if self.a[at] > 0.0 {
                    continue;
                }
                let columns = widened(&(i..i + 1), REACH, self.nx);
                let near = widened(&(j..j + 1), REACH, self.nz)
                    .any(|j| self.a[j * self.nx..][columns.clone()].iter().any(|a| *a > 0.0));
                self.a[at] = if near { NEAR_WALL } else { DEEP_WALL };
            }
        }
    }

    /// Lets no current run into walls faster than waves spread.
    pub(crate) fn calm_at_walls(&mut self, x: &Range<usize>, z: &Range<usize>) {
        if !self.drifts() {
            return;
        }
        let reach = (MOST_DRIFT / AT_WALLS) as usize - 1;
        for j in widened(z, reach, self.nz) {
            for i in widened(x, reach, self.nx) {
                let at = j * self.nx + i;
                // Deep walls are farther from water than near ones.
                if self.a[at] != NEAR_WALL && (self.a[at] <= 0.0 || self.r[at] > 0.0) {
                    continue;
                }
                for row in widened(&(j..j + 1), reach, self.nz) {
                    for column in widened(&(i..i + 1), reach, self.nx) {
                        let most = AT_WALLS * row.abs_diff(j).max(column.abs_diff(i)) as f32;
                        for drift in &mut self.drift {
                            let drift = &mut drift[row * self.nx + column];
                            *drift = drift.clamp(-most, most);
                        }
                    }
                }
            }
        }
    }

    fn average_faces(&mut self, x: &Range<usize>, z: &Range<usize>) {
        let nx = self.nx;
        let a = &self.a;
        // Both cells across the end of a face; there is no wall outside the window.
        let walls = |here: usize, before: usize, step: isize, inside: bool| {
            let dry = |at: usize| at.checked_add_signed(step).and_then(|at| a.get(at)).is_some_and(|a| *a <= 0.0);
            if inside && dry(here) && dry(before) { 1.0 } else { 0.0 }
        };
        let [straight, beside] = self.weights;
        for j in widened(z, 1, self.nz) {
            for i in widened(x, 1, nx) {
                let at = j * nx + i;
                let row = nx as isize;
                for (axis, index, step, half, ends) in [
                    (0, i, 1, 0.5, [(-row, j > 0), (row, j + 1 < self.nz)]),
                    (1, j, nx, 0.5 * self.aspect, [(-1, i > 0), (1, i + 1 < nx)]),
                ] {
                    let (mut face, mut own) = (0.0, 0.0);
                    if index > 0 && a[at] > 0.0 && a[at - step] > 0.0 {
                        face = half * (a[at] + a[at - step]);
                        let ended: f32 =
                            ends.map(|(step_end, inside)| walls(at, at - step, step_end, inside)).iter().sum();
                        own = face * (straight + beside * ended);
                    }
                    self.faces[axis][at] = face;
                    self.own[axis][at] = own;
                }
            }
        }
    }

    /// Marks the tiles that hold deep wall only, which are never stepped, and those with walls beside water.
    fn find_solid_tiles(&self, tiles: &mut Tiles, x: &Range<usize>, z: &Range<usize>) {
        let (x, z) = (widened(x, REACH, self.nx), widened(z, REACH, self.nz));
        for tz in tiles.of(1, z.start)..=tiles.of(1, z.end - 1) {
            for tx in tiles.of(0, x.start)..=tiles.of(0, x.end - 1) {
                let (columns, rows) = (tiles.span(0, tx), tiles.span(1, tz));
                let tile = &mut tiles.tiles[tz * tiles.count[0] + tx];
                if tile.class != Class::Plain {
                    let mut cells = rows.clone().flat_map(|j| &self.a[j * self.nx..][columns.clone()]);
                    let solid = cells.clone().all(|a| *a == DEEP_WALL);
                    tile.class = if solid { Class::Solid } else { Class::Mixed };
                    tile.walls = cells.any(|a| *a == NEAR_WALL);
                    // Also around the tile: it shares faces with those cells.
                    let (columns, rows) = (widened(&columns, REACH, self.nx), widened(&rows, REACH, self.nz));
                    let (a, r) = (&self.a, &self.r);
                    let mut around = rows.clone().flat_map(|j| columns.clone().map(move |i| j * self.nx + i));
                    tile.shut = around.any(|at| !(a[at] > 0.0 && r[at] > 0.0));
                    let mut currents = self.drift.iter().filter(|u| !u.is_empty());
                    tile.carried = currents
                        .any(|u| rows.clone().any(|j| u[j * self.nx..][columns.clone()].iter().any(|u| *u != 0.0)));
                }
            }
        }
    }

    /// div(a grad z) of a cell away from the outermost ring, in f64.
    pub(crate) fn divergence(&self, z: &[f32], at: usize) -> f64 {
        self.divergence_of(|at| f64::from(z[at]), at)
    }

    /// The same of a field by the index of the cell.
    pub(crate) fn divergence_of(&self, z: impl Fn(usize) -> f64, at: usize) -> f64 {
        let flux = |axis: usize, at: usize| {
            let (before, beside) = if axis == 0 { (1, self.nx) } else { (self.nx, 1) };
            let faces = &self.faces[axis];
            let jump = |at: usize| z(at) - z(at - before);
            let side = |other: usize| f64::from(faces[at].min(faces[other])) * jump(other);
            let sides = side(at - beside) + side(at + beside);
            f64::from(self.own[axis][at]) * jump(at) + f64::from(self.weights[1]) * sides
        };
        flux(0, at + 1) - flux(0, at) + flux(1, at + self.nx) - flux(1, at)
    }
}

//! The medium of a window's cells. It stays with the world: a shift moves it and reads only what enters. Tiles whose cells and
//! neighbours are all plain never look here.

use std::ops::Range;

use glam::DVec2;

pub(crate) use crate::cells::{Cells, REACH};
use crate::cpu::tiles::{Class, Tiles};
use crate::desc::TILE;
use crate::dispersive::Bed;
use crate::field::Field;
use crate::hulls::Held;
use crate::medium::{CellLaw, Coefficient, SharedMedium};

/// What a grid knows of the medium.
#[derive(Debug, Clone)]
pub(crate) struct Ground {
    pub(crate) medium: SharedMedium,
    pub(crate) law: CellLaw,
    pub(crate) corner: [i64; 2],
    /// None while every tile is plain.
    pub(crate) cells: Option<Cells>,
    /// Cells that hulls stand in.
    pub(crate) held: Held,
}

impl Ground {
    /// Reads the medium of all tiles and cells of a window.
    pub(crate) fn new(medium: SharedMedium, law: CellLaw, corner: [i64; 2], tiles: &mut Tiles) -> Self {
        let mut ground = Self { medium, law, corner, cells: None, held: Held::default() };
        for tz in 0..tiles.count[1] {
            for tx in 0..tiles.count[0] {
                ground.classify(tiles, tx, tz);
            }
        }
        ground.allocate(tiles);
        let [nx, nz] = tiles.cells;
        ground.read(tiles, 0..nx, 0..nz);
        ground
    }

    /// Follows a window that moved: cell i takes what cell i + shift held, the rest is read. `tiles` have moved by
    /// `moved` tiles already.
    pub(crate) fn shift(&mut self, shift: [i64; 2], moved: [i64; 2], tiles: &mut Tiles) {
        let [nx, nz] = tiles.cells;
        for (corner, by) in self.corner.iter_mut().zip(shift) {
            *corner += by;
        }
        let [count_x, count_z] = tiles.count.map(|n| n as i64);
        for tz in 0..count_z {
            for tx in 0..count_x {
                if !((0..count_x).contains(&(tx + moved[0])) && (0..count_z).contains(&(tz + moved[1]))) {
                    self.classify(tiles, tx as usize, tz as usize);
                }
            }
        }
        if let Some(cells) = &mut self.cells {
            if tiles.all_plain() {
                self.cells = None;
                return;
            }
            let Cells { a, r, faces: [x, z], own: [own_x, own_z], drift: [drift_x, drift_z], bed, .. } = cells;
            let bed = bed.iter_mut().flat_map(Bed::arrays);
            for array in [a, r, x, z, own_x, own_z, drift_x, drift_z].into_iter().chain(bed) {
                if !array.is_empty() {
                    array.shift(shift);
                }
            }
        } else if self.allocate(tiles) {
            self.read(tiles, 0..nx, 0..nz);
            return;
        }
        let entering = |k: usize, n: usize| {
            let s = (shift[k].unsigned_abs() as usize).min(n);
            if shift[k] > 0 { n - s..n } else { 0..s }
        };
        let (x, z) = (entering(0, nx), entering(1, nz));
        if !x.is_empty() {
            self.read(tiles, x, 0..nz);
        }
        if !z.is_empty() {
            self.read(tiles, 0..nx, z);
        }
    }

    /// Whether a tile and the ring of cells around it are plain.
    pub(crate) fn classify(&self, tiles: &mut Tiles, tx: usize, tz: usize) {
        let corner = |k: usize, tile: usize| self.corner[k] - tiles.offset[k] as i64 + (tile * TILE) as i64;
        let first = [corner(0, tx), corner(1, tz)];
        let place = |cells: i64| DVec2::new((first[0] + cells) as f64, (first[1] + cells) as f64) * self.law.cell_size;
        let (low, high) = (place(-1), place(TILE as i64 + 1));
        let plain = self.law.is_plain(&*self.medium.0, low, high);
        let tile = &mut tiles.tiles[tz * tiles.count[0] + tx];
        tile.class = if plain { Class::Plain } else { Class::Mixed };
        (tile.walls, tile.carried, tile.shut) = (false, false, false);
    }

    /// Makes plain cells when a tile needs them. Returns whether there are cells.
    pub(crate) fn allocate(&mut self, tiles: &Tiles) -> bool {
        if tiles.all_plain() {
            return false;
        }
        let [nx, nz] = tiles.cells;
        let Coefficient { a, r, depth, .. } = self.law.plain();
        let bed = self.law.table.as_ref().map(|table| Bed::new(table.clone(), nx, nz, depth));
        let all = |v: f32| Field::new(nx, nz, v, 0);
        let (weights, aspect) = (self.law.weights, self.law.aspect);
        let faces = [a, a * aspect];
        let own = faces.map(|face| all(face * weights[0]));
        self.cells = Some(Cells {
            nx,
            nz,
            a: all(a),
            aspect,
            r: all(r),
            faces: faces.map(all),
            own,
            weights,
            drift: Default::default(),
            bed,
        });
        true
    }

    /// Reads a rectangle of cells, and what follows from it.
    pub(crate) fn read(&mut self, tiles: &mut Tiles, x: Range<usize>, z: Range<usize>) {
        let Some(cells) = &mut self.cells else { return };
        let Coefficient { a, r, depth, .. } = self.law.plain();
        for tz in tiles.of(1, z.start)..=tiles.of(1, z.end - 1) {
            for tx in tiles.of(0, x.start)..=tiles.of(0, x.end - 1) {
                let plain = tiles.row(tz)[tx].class == Class::Plain;
                let (span_x, span_z) = (tiles.span(0, tx), tiles.span(1, tz));
                let across = span_x.start.max(x.start)..span_x.end.min(x.end);
                for j in span_z.start.max(z.start)..span_z.end.min(z.end) {
                    let row = j * cells.nx + across.start..j * cells.nx + across.end;
                    if plain {
                        cells.a[row.clone()].fill(a);
                        cells.r[row.clone()].fill(r);
                        cells.drift.iter_mut().filter(|u| !u.is_empty()).for_each(|u| u[row.clone()].fill(0.0));
                        if let Some(bed) = &mut cells.bed {
                            bed.depth[row.clone()].fill(depth);
                        }
                        continue;
                    }
                    for (i, at) in across.clone().zip(row) {
                        let world = [self.corner[0] + i as i64, self.corner[1] + j as i64];
                        let cell = self.law.cell(&*self.medium.0, world);
                        (cells.a[at], cells.r[at]) = (cell.a, cell.r);
                        cells.set_drift(at, cell.drift);
                        if let Some(bed) = &mut cells.bed {
                            bed.depth[at] = cell.depth;
                        }
                    }
                }
            }
        }
        cells.follow(tiles, &x, &z);
        cells.calm_at_walls(&x, &z);
    }
}

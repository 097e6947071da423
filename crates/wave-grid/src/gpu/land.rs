//! The medium of a grid on the GPU: read here by the code of the CPU grid, uploaded cell by cell as it enters the window.

use std::ops::Range;

use open_water_shaders::grid::{GridCell, GridWaterCell};

use crate::cpu::tiles::{Class, Tiles};
use crate::desc::TILE;
use crate::ground::{Cells, Ground, REACH};
use crate::medium::{CellLaw, SharedMedium};
use crate::window::Window;

/// Rectangles kept of a grid that moves asleep, before all of it counts as new.
const MOST_STALE: usize = 16;

/// A grid's medium, and which of its cells the GPU has not heard of.
#[derive(Debug)]
pub(super) struct Land {
    pub(super) ground: Ground,
    tiles: Tiles,
    /// World cell (0, 0) of the window.
    corner: [i64; 2],
    /// Rectangles of world cells to be uploaded, per axis.
    stale: Vec<[Range<i64>; 2]>,
}

impl Land {
    pub(super) fn new(medium: SharedMedium, law: CellLaw, window: &Window) -> Self {
        let mut tiles = Tiles::new(window.cells.map(|n| n as usize), window.tile_offset());
        let ground = Ground::new(medium, law, window.corner, &mut tiles);
        let mut land = Self { ground, tiles, corner: window.corner, stale: Vec::new() };
        land.forget();
        land
    }

    /// Everything is to be uploaded.
    fn forget(&mut self) {
        self.stale.clear();
        self.stale.push(std::array::from_fn(|k| self.corner[k]..self.corner[k] + self.tiles.cells[k] as i64));
    }

    /// Follows the window.
    pub(super) fn shift(&mut self, shift: [i64; 2]) {
        let had = self.ground.cells.is_some();
        let moved = self.tiles.shift(shift);
        self.ground.shift(shift, moved, &mut self.tiles);
        for (corner, by) in self.corner.iter_mut().zip(shift) {
            *corner += by;
        }
        if !had {
            self.forget();
            return;
        }
        for k in 0..2 {
            let mut entered: [Range<i64>; 2] =
                std::array::from_fn(|k| self.corner[k]..self.corner[k] + self.tiles.cells[k] as i64);
            // Walls near what entered may have changed with it.
            let reach = REACH as i64;
            match shift[k] {
                0 => continue,
                1.. => entered[k].start = entered[k].end - shift[k] - reach,
                _ => entered[k].end = entered[k].start - shift[k] + reach,
            }
            self.stale.push(entered);
        }
        if self.stale.len() > MOST_STALE {
            self.forget();
        }
    }

    /// Appends what the GPU has not heard of, for the grid at `slot` of the tick.
    pub(super) fn upload(&mut self, slot: u32, torus: [usize; 2], list: &mut Vec<GridCell>) {
        self.each_stale(slot, torus, |cells, at, place| {
            list.push(GridCell { place, a: cells.a[at], r: cells.r[at], pad: 0 });
        });
    }

    /// The same of a dispersive grid.
    pub(super) fn upload_water(&mut self, slot: u32, torus: [usize; 2], list: &mut Vec<GridWaterCell>) {
        self.each_stale(slot, torus, |cells, at, place| {
            let ([along, across], m) = match &cells.bed {
                Some(bed) => (
                    bed.faces.each_ref().map(|faces| faces.each_ref().map(|face| face[at])),
                    bed.m.each_ref().map(|m| m[at]),
                ),
                None => Default::default(),
            };
            list.push(GridWaterCell { along, across, m, a: cells.a[at], r: cells.r[at], place, pad: [0; 2] });
        });
    }

    /// Calls `of` with every cell that the GPU has not heard of, and with what [`GridCell::place`] is for it.
    fn each_stale(&mut self, slot: u32, torus: [usize; 2], mut of: impl FnMut(&Cells, usize, u32)) {
        let Some(cells) = &self.ground.cells else { return };
        for [x, z] in self.stale.drain(..) {
            let within = |range: &Range<i64>, k: usize| {
                let last = self.corner[k] + self.tiles.cells[k] as i64;
                range.start.max(self.corner[k])..range.end.min(last)
            };
            for world_z in within(&z, 1) {
                let row = (world_z - self.corner[1]) as usize * cells.nx;
                let place_z = world_z.rem_euclid(torus[1] as i64) as usize * torus[0];
                for world_x in within(&x, 0) {
                    let at = row + (world_x - self.corner[0]) as usize;
                    let place = place_z + world_x.rem_euclid(torus[0] as i64) as usize;
                    of(cells, at, place as u32 | slot << 24);
                }
            }
        }
    }

    /// What the medium makes of the tile at a place on the torus, in tiles: two tiles of the world can share it.
    pub(super) fn class(&self, place: [usize; 2], torus: [usize; 2]) -> Class {
        let around = torus.map(|n| n / TILE);
        let first: [usize; 2] = std::array::from_fn(|k| {
            (place[k] as i64 - self.corner[k].div_euclid(TILE as i64)).rem_euclid(around[k] as i64) as usize
        });
        let mut found = None;
        for tz in (first[1]..self.tiles.count[1]).step_by(around[1]) {
            for tx in (first[0]..self.tiles.count[0]).step_by(around[0]) {
                if self.tiles.span(0, tx).is_empty() || self.tiles.span(1, tz).is_empty() {
                    continue;
                }
                let class = self.tiles.row(tz)[tx].class;
                found = Some(match found {
                    None => class,
                    Some(other) if other == class => class,
                    Some(_) => Class::Mixed,
                });
            }
        }
        found.unwrap_or_default()
    }
}

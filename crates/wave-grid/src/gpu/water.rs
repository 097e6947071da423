//! What a grid of the dispersive scheme has on the GPU besides what all have.

use open_water_shaders::grid::{
    FACE_ARRAYS, FIELD_ARRAYS, FRESH_X, FRESH_Z, GridWater, SLOT_X_BIT, SLOT_X_VECTORS, SLOT_Z_BIT, SLOT_Z_VECTORS,
    WATER,
};

use crate::dispersive::layer::{SHIFT, STRENGTH, Sides};
use crate::dispersive::{Law, Table};
use crate::drift::Drift;
use crate::window::Place;
use crate::{GridDesc, Scheme, Stepping, TILE};

/// No slot, in a tile's flags.
const NONE: u8 = u8::MAX;

/// Which tiles of an axis lie in the layer, and where these keep what it remembers.
#[derive(Debug)]
struct Slots {
    /// Slot of each tile of the torus along the axis.
    of: Vec<u8>,
    /// Those that came to theirs with the last call of [`Self::follow`].
    fresh: Vec<bool>,
    cells: usize,
    width: usize,
}

impl Slots {
    fn new(tiles: usize, cells: usize, width: usize) -> Self {
        Self { of: vec![NONE; tiles], fresh: vec![false; tiles], cells, width }
    }

    /// Whether a tile of the torus has cells of the layer, the window's first cell being stored at `corner`.
    fn lies_in_layer(&self, tile: usize, corner: usize) -> bool {
        let torus = self.of.len() * TILE;
        (0..TILE).any(|i| {
            let cell = (tile * TILE + i + torus - corner) % torus;
            cell < self.width || (self.cells - self.width..self.cells).contains(&cell)
        })
    }

    /// Most slots that any place of the window needs.
    fn most(&self) -> usize {
        let tiles = 0..self.of.len();
        (0..TILE)
            .map(|corner| tiles.clone().filter(|tile| self.lies_in_layer(*tile, corner)).count())
            .max()
            .unwrap_or(0)
    }

    /// Gives slots to the tiles that lie in the layer now and takes them from the others.
    fn follow(&mut self, corner: usize) {
        let inside: Vec<bool> = (0..self.of.len()).map(|tile| self.lies_in_layer(tile, corner)).collect();
        let mut taken = [false; NONE as usize];
        for (slot, inside) in self.of.iter_mut().zip(&inside) {
            if !inside {
                *slot = NONE;
            } else if let Some(taken) = taken.get_mut(usize::from(*slot)) {
                *taken = true;
            }
        }
        let mut free = (0..NONE).filter(|slot| !taken[usize::from(*slot)]);
        for ((slot, fresh), inside) in self.of.iter_mut().zip(&mut self.fresh).zip(inside) {
            *fresh = inside && *slot == NONE;
            if *fresh {
                *slot = free.next().unwrap_or(NONE);
            }
        }
    }
}

/// First `vec4`s of what a grid has in the buffers of fields and faces.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Bases {
    pub(super) fields: u32,
    pub(super) faces: u32,
}

/// See the module.
#[derive(Debug)]
pub(super) struct Water {
    law: Law,
    pub(super) bases: Bases,
    columns: Slots,
    rows: Slots,
    /// Slots along x and z.
    slots: [u32; 2],
    drift: Drift,
    sides: Sides,
    g: f64,
    /// A tick over sqrt(h / g).
    time: f64,
    /// `vec4`s of one array.
    stride: u32,
}

impl Water {
    /// `None` for grids of the wave equation.
    pub(super) fn new(desc: &GridDesc, stepping: &Stepping, torus: [usize; 2], bases: Bases) -> Option<Self> {
        if desc.scheme != Scheme::Dispersive {
            return None;
        }
        let slots = |k: usize| Slots::new(torus[k] / TILE, desc.cells[k] as usize, desc.border.width() as usize);
        let (columns, rows) = (slots(0), slots(1));
        Some(Self {
            law: Law::new(desc, stepping, &Table::new(stepping.a[0])),
            bases,
            slots: [columns.most() as u32, rows.most() as u32],
            columns,
            rows,
            drift: Drift::default(),
            sides: Sides::default(),
            g: stepping.a[0],
            time: stepping.root_time(),
            stride: (torus[0] * torus[1] / 4) as u32,
        })
    }

    /// Where the next grid may begin.
    pub(super) fn end(&self) -> Bases {
        let [_, z] = self.first_slots();
        Bases {
            fields: z + self.slots[1] * self.columns.of.len() as u32 * SLOT_Z_VECTORS,
            faces: self.bases.faces + FACE_ARRAYS * self.stride,
        }
    }

    /// Bytes in the buffers of fields and, where its medium is felt, of faces.
    pub(super) fn bytes(&self, felt: bool) -> u64 {
        let (first, end) = (self.bases, self.end());
        16 * u64::from(end.fields - first.fields + if felt { end.faces - first.faces } else { 0 })
    }

    fn first_slots(&self) -> [u32; 2] {
        let x = self.bases.fields + FIELD_ARRAYS * self.stride;
        [x, x + self.slots[0] * self.rows.of.len() as u32 * SLOT_X_VECTORS]
    }

    /// Once a tick: where the window stands now.
    pub(super) fn note(&mut self, place: &Place, stepping: &Stepping) {
        self.drift.note(place, stepping);
    }

    /// Nothing of the old window remains.
    pub(super) fn clear(&mut self) {
        self.drift = Drift::default();
    }

    /// What the passes know of it in a tick; its tiles have their slots then.
    pub(super) fn packed(&mut self, corner: [u32; 2], width: u32) -> GridWater {
        self.columns.follow(corner[0] as usize);
        self.rows.follow(corner[1] as usize);
        let [slots_x, slots_z] = self.first_slots();
        let Law { c, r, s, m, g, damp } = self.law;
        // The CPU's window shifts before its sides follow.
        let before = self.sides.off();
        self.sides.move_with(self.drift.beta(), self.time);
        let off = self.sides.off();
        let bits =
            |off: [[bool; 2]; 2]| off.as_flattened().iter().rev().fold(0, |bits, off| 2 * bits + u32::from(*off));
        let [x, z] = self.sides.open;
        let peak = |open: f64| (STRENGTH * self.g.sqrt() * open) as f32;
        GridWater {
            shares: [c, s[0], s[1], s[2]],
            rates: [g, r[0], r[1], r[2]],
            gains: [damp, m[0], m[1], m[2]],
            peaks: [x[0], x[1], z[0], z[1]].map(peak),
            fields: self.bases.fields,
            slots_x,
            slots_z,
            faces: self.bases.faces,
            width,
            alpha: (SHIFT * self.g.sqrt()) as f32,
            left: bits(off),
            kept: bits(before),
        }
    }

    /// The flags of a tile.
    pub(super) fn flags(&self, column: usize, row: usize) -> u32 {
        let slots = u32::from(self.columns.of[column]) << SLOT_X_BIT | u32::from(self.rows.of[row]) << SLOT_Z_BIT;
        let fresh = |axis: &Slots, tile: usize, flag: u32| if axis.fresh[tile] { flag } else { 0 };
        WATER | slots | fresh(&self.columns, column, FRESH_X) | fresh(&self.rows, row, FRESH_Z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_tile_in_the_layer_has_a_slot_of_its_own(
            cells in 48usize..400,
            width in 4usize..=20,
            walk in prop::collection::vec(-40i64..40, 1..60),
        ) {
            let tiles = cells.div_ceil(TILE);
            let mut slots = Slots::new(tiles, cells, width);
            let most = slots.most();
            let mut corner = 0i64;
            for by in walk {
                let before = slots.of.clone();
                corner = (corner + by).rem_euclid((tiles * TILE) as i64);
                slots.follow(corner as usize);
                let mut seen = vec![false; most];
                for tile in 0..tiles {
                    prop_assert_eq!(slots.of[tile] != NONE, slots.lies_in_layer(tile, corner as usize));
                    if slots.of[tile] != NONE {
                        prop_assert!(!std::mem::replace(&mut seen[usize::from(slots.of[tile])], true));
                        prop_assert!(slots.fresh[tile] || slots.of[tile] == before[tile]);
                    }
                }
            }
        }
    }
}

//! What a grid held at a moment, to go back to: for rollback.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec2;

use crate::cpu::tiles::{Mode, Tile, Tiles};
use crate::dispersive::{Layer, Sides};
use crate::drift::Drift;
use crate::ground::Ground;
use crate::window::Place;
use crate::{Edges, GridDesc, GridError, WaveGrid};

/// A moment of a [`WaveGrid`]: its place, its medium and the cells of those tiles that are not calm. It shares the medium's
/// cells with the grid, which copies them if its window moves over them while a snapshot lives.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridSnapshot {
    desc: GridDesc,
    place: Place,
    origin: DVec2,
    tiles: Tiles,
    /// The medium's cells, unless it was read from bytes: then they are read again from the grid's own.
    #[cfg_attr(feature = "serde", serde(skip))]
    ground: Option<Arc<Ground>>,
    /// There were such.
    grounded: bool,
    feed: Option<Edges>,
    moving: bool,
    drift: Drift,
    captured: bool,
    dropped: u64,
    /// Share of its strength that each side of the dispersive scheme's border layer has.
    layer: Option<Sides>,
    /// Of each tile that is held: z, z_old, foam; then what it kept to be drawn; then phi along x and z; then what the
    /// dispersive or the spectral scheme keeps. At the end the memory of the dispersive scheme's border layer.
    #[cfg_attr(feature = "serde", serde(with = "crate::values::floats"))]
    cells: Vec<f32>,
}

/// Whether a tile may hold anything but zeros.
fn held(tile: &Tile) -> bool {
    tile.mode == Mode::Active || tile.kept || tile.height > 0.0 || tile.foam > 0.0
}

impl WaveGrid {
    /// This moment. Takes time and memory for tiles that are not calm only, and for the border layer of water waves.
    pub fn snapshot(&self) -> GridSnapshot {
        let mut snapshot = self.outline();
        snapshot.cells.reserve_exact(self.numbers_of(&self.tiles));
        self.for_numbers(&mut |numbers| snapshot.cells.extend_from_slice(numbers));
        snapshot
    }

    /// This moment but for the numbers that [`Self::for_numbers`] tells: both together are all that later ticks depend on, to
    /// be hashed say.
    pub fn outline(&self) -> GridSnapshot {
        GridSnapshot {
            desc: self.desc,
            place: self.place,
            origin: self.origin,
            tiles: self.tiles.clone(),
            ground: self.ground.clone(),
            grounded: self.ground.is_some(),
            feed: self.feed.as_ref().map(|feed| feed.edges),
            moving: self.moving,
            drift: self.drift,
            captured: self.captured,
            dropped: self.dropped,
            layer: self.border_layer().map(|layer| layer.sides),
            cells: Vec::new(),
        }
    }

    /// Calls `f` with the numbers of all cells that are not calm, piece by piece in a fixed order.
    pub fn for_numbers(&self, f: &mut dyn FnMut(&[f32])) {
        self.for_held(|grid, tile, rows| {
            let state = &grid.state;
            let [phi_x, phi_z] = &state.phi;
            let arrays = [&state.z, &state.old, &state.foam, &state.previous, phi_x, phi_z];
            let potential = grid.spectral.iter().map(|spectral| spectral.potential());
            let kept = grid.fields.iter().flat_map(|fields| fields.kept()).chain(potential).map(|field| (field, true));
            for (array, wanted) in arrays.into_iter().zip(grid.parts(tile)).chain(kept) {
                if wanted {
                    rows.clone().for_each(|row| f(&array[row]));
                }
            }
        });
        self.border_layer().into_iter().flat_map(|layer| layer.memory.numbers()).for_each(f);
    }

    fn border_layer(&self) -> Option<&Layer> {
        self.fields.as_ref().and_then(|fields| fields.layer.as_ref())
    }

    /// Goes back to a moment of this grid, or of another of the same description. Ticks from there give the same bits as
    /// they did.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when the snapshot is of a grid of another description, or does not hold together; then nothing
    /// is changed.
    pub fn restore(&mut self, snapshot: &GridSnapshot) -> Result<(), GridError> {
        if snapshot.desc != self.desc {
            let count = |desc: &GridDesc| f64::from(desc.cells[0]) * f64::from(desc.cells[1]);
            let bound = "of a grid of the same description";
            return Err(GridError::InvalidValue { field: "snapshot: cells", value: count(&snapshot.desc), bound });
        }
        self.check(snapshot)?;
        for tz in 0..self.tiles.count[1] {
            for tx in 0..self.tiles.count[0] {
                if held(&self.tiles.row(tz)[tx]) {
                    let (x, z) = (self.tiles.span(0, tx), self.tiles.span(1, tz));
                    self.state.clear_cells(x.clone(), z.clone());
                    if let Some(fields) = &mut self.fields {
                        fields.clear_cells(x, z);
                    }
                    if let Some(spectral) = &mut self.spectral {
                        spectral.clear();
                    }
                }
            }
        }
        let GridSnapshot { place, origin, tiles, ground, feed, moving, drift, captured, dropped, .. } = snapshot;
        (self.place, self.origin) = (*place, *origin);
        (self.captured, self.dropped) = (*captured, *dropped);
        self.tiles.restore(tiles);
        match (ground, snapshot.grounded) {
            (None, true) => self.read_ground(),
            (ground, _) => self.ground.clone_from(ground),
        }
        self.set_moving(*moving);
        self.drift = *drift;
        self.update_fade();
        self.feed = feed.map(|edges| self.new_feed(edges));
        let mut left = &snapshot.cells[..];
        let mut places = Vec::new();
        self.for_held(|grid, tile, rows| places.push((grid.parts(tile), rows.collect::<Vec<_>>())));
        for (parts, rows) in places {
            let state = &mut self.state;
            let [phi_x, phi_z] = &mut state.phi;
            let arrays = [&mut state.z, &mut state.old, &mut state.foam, &mut state.previous, phi_x, phi_z];
            let potential = self.spectral.iter_mut().map(|spectral| spectral.potential_mut());
            let kept = self.fields.iter_mut().flat_map(|fields| fields.kept_mut()).chain(potential);
            let kept = kept.map(|field| (field, true));
            for (array, wanted) in arrays.into_iter().zip(parts).chain(kept) {
                for row in rows.iter().filter(|_| wanted) {
                    let (cells, rest) = left.split_at(row.len());
                    array[row.clone()].copy_from_slice(cells);
                    left = rest;
                }
            }
        }
        if let Some(layer) = self.fields.as_mut().and_then(|fields| fields.layer.as_mut()) {
            layer.restore(snapshot.layer.unwrap_or_default(), left);
        }
        Ok(())
    }

    /// Refuses what was not made by a grid of this description.
    fn check(&self, snapshot: &GridSnapshot) -> Result<(), GridError> {
        let GridSnapshot { place, origin, tiles, ground, grounded, layer, .. } = snapshot;
        let known = ground.is_some() || !grounded || self.ground.is_some();
        let sane = place.is_one_of(&self.place) && origin.is_finite() && snapshot.drift.is_finite();
        let layered = layer.is_some() == self.border_layer().is_some() && layer.is_none_or(|sides| sides.is_sane());
        let tiled = tiles.is_one_of(&self.tiles, place.window.tile_offset());
        let whole = known && sane && layered && tiled && self.numbers_of(tiles) == snapshot.cells.len();
        if whole {
            return Ok(());
        }
        let (field, bound) = ("snapshot: numbers", "as a grid of this description, with as much of a medium, has them");
        Err(GridError::InvalidValue { field, value: snapshot.cells.len() as f64, bound })
    }

    /// How many [`Self::for_numbers`] tells when the tiles are these.
    fn numbers_of(&self, tiles: &Tiles) -> usize {
        let besides =
            self.fields.iter().map(|fields| fields.kept().len()).sum::<usize>() + usize::from(self.spectral.is_some());
        let cells = each_held(tiles, |tile, x, z| {
            let parts = self.parts_of(tiles, tile).into_iter().filter(|part| *part).count();
            x.len() * z.len() * (parts + besides)
        });
        cells + self.border_layer().map_or(0, |layer| layer.memory.numbers().map(<[f32]>::len).sum())
    }

    /// Calls `f` with each tile that is held and the places of its rows.
    fn for_held(&self, mut f: impl FnMut(&Self, [usize; 2], Rows)) {
        each_held(&self.tiles, |tile, x, z| {
            f(self, tile, Rows { nx: self.state.nx, x, z });
            0
        });
    }

    /// Which of z, z_old, foam, what is kept, phi along x and z a tile has.
    fn parts(&self, tile: [usize; 2]) -> [bool; 6] {
        self.parts_of(&self.tiles, tile)
    }

    fn parts_of(&self, tiles: &Tiles, [tx, tz]: [usize; 2]) -> [bool; 6] {
        let rim = self.profile.thickness + 1;
        let layered = [(0, tx), (1, tz)].into_iter().any(|(axis, tile)| {
            let span = tiles.span(axis, tile);
            span.start < rim || span.end + rim > tiles.cells[axis]
        });
        let layered = layered && self.desc.scheme.is_wave_equation();
        [true, true, true, tiles.row(tz)[tx].kept, layered, layered]
    }
}

/// Calls `f` with each tile that is held and its cells along x and z; the sum of what it returns.
fn each_held(tiles: &Tiles, mut f: impl FnMut([usize; 2], Range<usize>, Range<usize>) -> usize) -> usize {
    let mut sum = 0;
    for tz in 0..tiles.count[1] {
        for tx in 0..tiles.count[0] {
            let (x, z) = (tiles.span(0, tx), tiles.span(1, tz));
            if held(&tiles.row(tz)[tx]) && !x.is_empty() && !z.is_empty() {
                sum += f([tx, tz], x, z);
            }
        }
    }
    sum
}

/// The places of a tile's rows in an array.
#[derive(Debug, Clone)]
struct Rows {
    nx: usize,
    x: Range<usize>,
    z: Range<usize>,
}

impl Iterator for Rows {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Self::Item> {
        self.z.next().map(|j| j * self.nx + self.x.start..j * self.nx + self.x.end)
    }
}

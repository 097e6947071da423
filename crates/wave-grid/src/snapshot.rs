//! What a grid held at a moment, to go back to: for rollback.

use std::sync::Arc;

use glam::DVec2;

use crate::cpu::tiles::{Mode, Tile, Tiles};
use crate::dispersive::Layer;
use crate::drift::Drift;
use crate::ground::Ground;
use crate::window::Place;
use crate::{Edges, GridDesc, GridError, WaveGrid};

/// A moment of a [`WaveGrid`]: its place, its medium and the cells of those tiles that are not calm. It shares the medium's
/// cells with the grid, which copies them if its window moves over them while a snapshot lives.
#[derive(Debug, Clone)]
pub struct GridSnapshot {
    desc: GridDesc,
    place: Place,
    origin: DVec2,
    tiles: Tiles,
    ground: Option<Arc<Ground>>,
    feed: Option<Edges>,
    moving: bool,
    drift: Drift,
    captured: bool,
    dropped: u64,
    /// The dispersive scheme's border layer.
    layer: Option<Layer>,
    /// Of each tile that is held: z, z_old, foam; then what it kept to be drawn; then phi along x and z; then what the
    /// dispersive or the spectral scheme keeps.
    cells: Vec<f32>,
}

/// Whether a tile may hold anything but zeros.
fn held(tile: &Tile) -> bool {
    tile.mode == Mode::Active || tile.kept || tile.height > 0.0 || tile.foam > 0.0
}

impl WaveGrid {
    /// This moment. Takes time and memory for tiles that are not calm only.
    pub fn snapshot(&self) -> GridSnapshot {
        let mut cells = Vec::new();
        self.for_held(|grid, tile, rows| {
            let state = &grid.state;
            let [phi_x, phi_z] = &state.phi;
            let arrays = [&state.z, &state.old, &state.foam, &state.previous, phi_x, phi_z];
            let potential = grid.spectral.iter().map(|spectral| spectral.potential());
            let kept = grid.fields.iter().flat_map(|fields| fields.kept()).chain(potential).map(|field| (field, true));
            for (array, wanted) in arrays.into_iter().zip(grid.parts(tile)).chain(kept) {
                if wanted {
                    rows.clone().for_each(|row| cells.extend_from_slice(&array[row]));
                }
            }
        });
        GridSnapshot {
            desc: self.desc,
            place: self.place,
            origin: self.origin,
            tiles: self.tiles.clone(),
            ground: self.ground.clone(),
            feed: self.feed.as_ref().map(|feed| feed.edges),
            moving: self.moving,
            drift: self.drift,
            captured: self.captured,
            dropped: self.dropped,
            layer: self.fields.as_ref().and_then(|fields| fields.layer.clone()),
            cells,
        }
    }

    /// Goes back to a moment of this grid, or of another of the same description. Ticks from there give the same bits as
    /// they did.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when the snapshot is of a grid of another description; then nothing is changed.
    pub fn restore(&mut self, snapshot: &GridSnapshot) -> Result<(), GridError> {
        if snapshot.desc != self.desc {
            let count = |desc: &GridDesc| f64::from(desc.cells[0]) * f64::from(desc.cells[1]);
            let bound = "of a grid of the same description";
            return Err(GridError::InvalidValue { field: "snapshot: cells", value: count(&snapshot.desc), bound });
        }
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
        self.tiles.clone_from(tiles);
        self.ground.clone_from(ground);
        self.set_moving(*moving);
        self.drift = *drift;
        self.update_fade();
        if let Some(fields) = &mut self.fields {
            fields.layer.clone_from(&snapshot.layer);
        }
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
        Ok(())
    }

    /// Calls `f` with each tile that is held and the places of its rows.
    fn for_held(&self, mut f: impl FnMut(&Self, [usize; 2], Rows)) {
        for tz in 0..self.tiles.count[1] {
            for tx in 0..self.tiles.count[0] {
                let (x, z) = (self.tiles.span(0, tx), self.tiles.span(1, tz));
                if held(&self.tiles.row(tz)[tx]) && !x.is_empty() {
                    f(self, [tx, tz], Rows { nx: self.state.nx, x, z });
                }
            }
        }
    }

    /// Which of z, z_old, foam, what is kept, phi along x and z a tile has.
    fn parts(&self, [tx, tz]: [usize; 2]) -> [bool; 6] {
        let rim = self.profile.thickness + 1;
        let layered = [(0, tx), (1, tz)].into_iter().any(|(axis, tile)| {
            let span = self.tiles.span(axis, tile);
            span.start < rim || span.end + rim > self.tiles.cells[axis]
        });
        let layered = layered && self.desc.scheme.is_wave_equation();
        [true, true, true, self.tiles.row(tz)[tx].kept, layered, layered]
    }
}

/// The places of a tile's rows in an array.
#[derive(Debug, Clone)]
struct Rows {
    nx: usize,
    x: std::ops::Range<usize>,
    z: std::ops::Range<usize>,
}

impl Iterator for Rows {
    type Item = std::ops::Range<usize>;

    fn next(&mut self) -> Option<Self::Item> {
        self.z.next().map(|j| j * self.nx + self.x.start..j * self.nx + self.x.end)
    }
}

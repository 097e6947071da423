//! Hulls cut at the waterline, as walls that move.
//!
//! The cells under a hull become walls, those it leaves get back what the medium says and keep the heights that walls
//! beside water have for what reads between cells: the mean of the water next to them. Only the cells that
//! change and their neighbours are looked at.

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, Vec2};

use crate::cpu::tiles::{Class, Tiles};
use crate::desc::TILE;
use crate::feed::contour;
use crate::ground::{Ground, REACH};
use crate::medium::{DEEP_WALL, Medium, MediumCell, SharedMedium};
use crate::state::State;
use crate::{GridDesc, WaveGrid, Window};

/// Where a hull cuts the surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HullOutline {
    /// Corners of a convex polygon in order, local (x, z), metres. Of one that is not convex each row of cells is
    /// covered from end to end; what has fewer than three corners or is not finite is no hull.
    pub points: Vec<Vec2>,
}

/// A cell under a hull: its world place, and a and r of the medium there.
#[derive(Debug, Clone, Copy)]
struct Under {
    cell: [i64; 2],
    a: f32,
    r: f32,
}

/// The cells under hulls.
#[derive(Debug, Clone, Default)]
pub(crate) struct Held {
    /// Row by row.
    cells: Vec<Under>,
    /// World places, in tiles, of the tiles that feel them.
    tiles: Vec<[i64; 2]>,
}

/// The medium of a grid that was given none.
struct OpenWater;

impl Medium for OpenWater {
    fn at(&self, _: DVec2, _: f32) -> MediumCell {
        MediumCell::default()
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        true
    }
}

impl WaveGrid {
    /// Sets the hulls that stand in the water from now on, as walls that reflect; to be told anew in every tick that they
    /// or the window move in. A cell belongs to a hull when its centre lies in the outline; hulls narrower than a cell may
    /// have none, nor do parts in the border layer. The grid forgets hulls with [`Self::set_medium`].
    ///
    /// Water is not pushed away by the walls: tell what a hull displaces as a [`crate::Source`]. In the cells of a hull
    /// that moves through waves the water is lost, and made anew behind it.
    pub fn set_hulls(&mut self, hulls: &[HullOutline]) {
        let under = self.cells_under(hulls);
        if under.is_empty() && self.ground.as_ref().is_none_or(|ground| ground.held.cells.is_empty()) {
            return;
        }
        let corner = self.place.window.corner;
        if self.ground.is_none() {
            let law = self.cell_law();
            let ground = Ground::new(SharedMedium(Arc::new(OpenWater)), law, corner, &mut self.tiles);
            self.ground = Some(Arc::new(ground));
        }
        self.capture();
        for cells in under.chunk_by(|a, b| a[1] == b[1]) {
            let [first, last] = [cells[0], cells[cells.len() - 1]];
            let [x, z] = [0, 1].map(|k| [(first[k] - corner[k]) as usize, (last[k] - corner[k]) as usize + 1]);
            self.keep_around([x, z]);
        }
        let Some(ground) = &mut self.ground else { return };
        Arc::make_mut(ground).hold(under, &mut self.tiles, &mut self.state);
    }

    /// World cells whose centres lie within outlines, row by row, each once.
    fn cells_under(&self, hulls: &[HullOutline]) -> Vec<[i64; 2]> {
        let window = &self.place.window;
        let inside = interior(&self.desc);
        let mut cells = Vec::new();
        for hull in hulls {
            cover(hull, window, self.origin, &inside, &mut cells);
        }
        cells.sort_unstable_by_key(|[x, z]| (*z, *x));
        cells.dedup();
        cells
    }
}

/// Cells that hulls may stand in, per axis: clear of the layer and of what feeds read.
fn interior(desc: &GridDesc) -> [Range<usize>; 2] {
    let rim = contour(desc.border.width()) + REACH;
    desc.cells.map(|n| rim..n as usize - rim)
}

/// Appends the cells whose centres lie in an outline.
fn cover(hull: &HullOutline, window: &Window, origin: DVec2, inside: &[Range<usize>; 2], cells: &mut Vec<[i64; 2]>) {
    let points: Vec<DVec2> = hull.points.iter().map(|point| window.cells_from_corner(*point, origin)).collect();
    if points.len() < 3 || !points.iter().all(|point| point.is_finite()) {
        return;
    }
    let ends = |low: f64, high: f64, axis: usize| {
        // Centres at i + 1/2.
        let first = (low - 0.5).ceil().max(inside[axis].start as f64) as usize;
        let past = (high - 0.5).floor().min(inside[axis].end as f64 - 1.0) + 1.0;
        first..past.max(0.0) as usize
    };
    let low = points.iter().fold(f64::INFINITY, |low, point| low.min(point.y));
    let high = points.iter().fold(f64::NEG_INFINITY, |high, point| high.max(point.y));
    for j in ends(low, high, 1) {
        let z = j as f64 + 0.5;
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, a) in points.iter().enumerate() {
            let b = points[(k + 1) % points.len()];
            if (a.y <= z) != (b.y <= z) {
                let x = a.x + (z - a.y) * (b.x - a.x) / (b.y - a.y);
                (from, to) = (from.min(x), to.max(x));
            }
        }
        if from <= to {
            cells.extend(ends(from, to, 0).map(|i| [window.corner[0] + i as i64, window.corner[1] + j as i64]));
        }
    }
}

/// Tiles of the world within reach of a cell.
fn tiles_near(cell: [i64; 2]) -> impl Iterator<Item = [i64; 2]> {
    let reach = REACH as i64;
    let range = cell.map(|c| (c - reach).div_euclid(TILE as i64)..=(c + reach).div_euclid(TILE as i64));
    let [x, z] = range;
    z.flat_map(move |z| x.clone().map(move |x| [x, z]))
}

/// Tiles within reach of a row-major list of cells.
fn tiles_of(cells: impl Iterator<Item = [i64; 2]>) -> Vec<[i64; 2]> {
    let mut tiles: Vec<[i64; 2]> = Vec::new();
    for cell in cells {
        for tile in tiles_near(cell) {
            // The last few are nearly always the right ones.
            if !tiles.iter().rev().any(|known| *known == tile) {
                tiles.push(tile);
            }
        }
    }
    tiles
}

impl Ground {
    /// Window index of a world cell.
    fn index(&self, cell: [i64; 2], tiles: &Tiles) -> Option<usize> {
        let [nx, nz] = tiles.cells.map(|n| n as i64);
        let (i, j) = (cell[0] - self.corner[0], cell[1] - self.corner[1]);
        if (0..nx).contains(&i) && (0..nz).contains(&j) { Some((j * nx + i) as usize) } else { None }
    }

    /// Index of a world tile, and the cells of the window that it covers.
    fn tile(&self, tile: [i64; 2], tiles: &Tiles) -> Option<([usize; 2], [Range<usize>; 2])> {
        let mut at = [0; 2];
        for k in 0..2 {
            let first = (self.corner[k] - tiles.offset[k] as i64).div_euclid(TILE as i64);
            at[k] = usize::try_from(tile[k] - first).ok().filter(|at| *at < tiles.count[k])?;
        }
        let spans = [tiles.span(0, at[0]), tiles.span(1, at[1])];
        if spans.iter().any(Range::is_empty) { None } else { Some((at, spans)) }
    }

    /// Makes walls of these world cells (row by row, each once) and of no others.
    fn hold(&mut self, under: Vec<[i64; 2]>, tiles: &mut Tiles, state: &mut State) {
        let felt = tiles_of(under.iter().copied());
        for tile in &felt {
            if let Some(([tx, tz], _)) = self.tile(*tile, tiles) {
                let tile = &mut tiles.tiles[tz * tiles.count[0] + tx];
                if tile.class == Class::Plain {
                    tile.class = Class::Mixed;
                }
            }
        }
        if self.cells.is_none() {
            self.held = Held::default();
            if self.allocate(tiles) {
                let [nx, nz] = tiles.cells;
                self.read(tiles, 0..nx, 0..nz);
            }
        }
        let before = std::mem::take(&mut self.held);
        let changed = self.exchange(&before.cells, &under, tiles, state);
        for tile in before.tiles.iter().filter(|tile| !felt.contains(tile)) {
            if let Some(([tx, tz], _)) = self.tile(*tile, tiles) {
                self.classify(tiles, tx, tz);
            }
        }
        // What follows from the cells that changed, a tile at a time.
        let (mut low, mut high) = ([i64::MAX; 2], [i64::MIN; 2]);
        for cell in &changed {
            for k in 0..2 {
                low[k] = low[k].min(cell[k] - self.corner[k]);
                high[k] = high[k].max(cell[k] - self.corner[k] + 1);
            }
        }
        for tile in tiles_of(changed.into_iter()) {
            if let (Some((_, spans)), Some(cells)) = (self.tile(tile, tiles), &mut self.cells) {
                let [x, z] = [0, 1].map(|k| {
                    let (low, high) = (low[k].max(0) as usize, high[k].max(0) as usize);
                    spans[k].start.max(low)..spans[k].end.min(high)
                });
                if !(x.is_empty() || z.is_empty()) {
                    cells.follow(tiles, &x, &z);
                }
            }
        }
        self.held.tiles = felt;
        // What lies deep in a hull has no heights, whatever the hull did before.
        for Under { cell, .. } in &self.held.cells {
            if let (Some(at), Some(cells)) = (self.index(*cell, tiles), &self.cells)
                && cells.a[at] == DEEP_WALL
            {
                (state.z[at], state.old[at]) = (0.0, 0.0);
            }
        }
    }

    /// Gives cells back and takes others. Returns those that changed.
    fn exchange(&mut self, before: &[Under], under: &[[i64; 2]], tiles: &Tiles, state: &mut State) -> Vec<[i64; 2]> {
        let order = |[x, z]: [i64; 2]| (z, x);
        let (mut old, mut new) = (before.iter().peekable(), under.iter().peekable());
        let mut changed = Vec::new();
        loop {
            let (was, is) = (old.peek().map(|u| order(u.cell)), new.peek().map(|cell| order(**cell)));
            let stays = was == is;
            if was.is_none() && is.is_none() {
                return changed;
            }
            let leaves = is.is_none() || was.is_some_and(|was| is.is_some_and(|is| was < is));
            if stays {
                self.held.cells.extend(old.next());
                new.next();
            } else if leaves {
                let Some(Under { cell, a, r }) = old.next().copied() else { continue };
                if let (Some(at), Some(cells)) = (self.index(cell, tiles), &mut self.cells) {
                    (cells.a[at], cells.r[at]) = (a, r);
                    changed.push(cell);
                }
            } else {
                let Some(cell) = new.next().copied() else { continue };
                if let (Some(at), Some(cells)) = (self.index(cell, tiles), &mut self.cells) {
                    self.held.cells.push(Under { cell, a: cells.a[at], r: cells.r[at] });
                    (cells.a[at], cells.r[at]) = (DEEP_WALL, 0.0);
                    for array in [&mut state.z, &mut state.old, &mut state.foam] {
                        array[at] = 0.0;
                    }
                    changed.push(cell);
                }
            }
        }
    }
}

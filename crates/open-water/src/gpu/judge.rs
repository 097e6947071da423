//! How far the heights that were carried on turned out to be off: measured when the copy of that tick has come, tile by
//! tile, and expected again of the same water.

use wave_grid::Window;

/// Cells along the side of a tile.
const TILE: i64 = 8;
/// Cells between those that are looked at, which are others from tick to tick.
const EVERY: i64 = 4;
/// Ticks that are remembered until their copies come.
const REMEMBERED: usize = 32;
/// Share of a new measurement.
const SHARE: f32 = 0.2;

/// Heights that were expected after a tick.
#[derive(Debug, Default)]
struct Forecast {
    tick: Option<u64>,
    corner: [i64; 2],
    /// See [`super::carry::Carry::growth`].
    growth: f32,
    heights: Vec<f32>,
}

/// What is known of a tile: mean squares, m^2.
#[derive(Debug, Clone, Copy, Default)]
struct Found {
    /// World place of the tile, in tiles.
    at: [i64; 2],
    /// Of the error over its growth; none measured yet.
    error: Option<f32>,
    height: f32,
}

/// See the module.
#[derive(Debug)]
pub(super) struct Judge {
    forecasts: Vec<Forecast>,
    next: usize,
    /// Tiles along x and z; each world tile has the place of its index modulo these.
    count: [i64; 2],
    tiles: Vec<Found>,
    /// Sums of squares of errors and heights, and their number, of each tile.
    sums: Vec<[f32; 3]>,
}

/// World cells from `corner` on that are looked at after a tick, along an axis of `cells`, from the corner.
fn looked_at(tick: u64, axis: u64, corner: i64, cells: u32) -> impl Iterator<Item = usize> + Clone {
    // At random, whatever the ticks between two copies.
    let turn = (tick.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (40 + 8 * axis)) as i64;
    let first = (turn - corner).rem_euclid(EVERY) as usize;
    (first..cells as usize).step_by(EVERY as usize)
}

impl Judge {
    pub(super) fn new(cells: [u32; 2]) -> Self {
        let count = cells.map(|n| i64::from(n.div_ceil(TILE as u32)) + 1);
        Self {
            forecasts: (0..REMEMBERED).map(|_| Forecast::default()).collect(),
            next: 0,
            tiles: vec![Found::default(); (count[0] * count[1]) as usize],
            sums: Vec::new(),
            count,
        }
    }

    /// Nothing is known any more.
    pub(super) fn forget(&mut self) {
        self.forecasts.iter_mut().for_each(|forecast| forecast.tick = None);
        self.tiles.fill(Found::default());
    }

    /// Notes what is expected of the cells of a window after a tick: `height` tells it by a cell's index.
    pub(super) fn expect(&mut self, tick: u64, window: &Window, growth: f32, height: impl Fn(usize) -> f32) {
        let forecast = &mut self.forecasts[self.next];
        self.next = (self.next + 1) % REMEMBERED;
        (forecast.tick, forecast.corner, forecast.growth) = (Some(tick), window.corner, growth);
        forecast.heights.clear();
        let columns = looked_at(tick, 0, window.corner[0], window.cells[0]);
        for j in looked_at(tick, 1, window.corner[1], window.cells[1]) {
            let row = j * window.cells[0] as usize;
            forecast.heights.extend(columns.clone().map(|i| height(row + i)));
        }
    }

    /// Measures what was expected of a tick against how it was: `heights` of the cells of a window.
    pub(super) fn measure(&mut self, tick: u64, window: &Window, heights: &[f32]) {
        let [nx, nz] = window.cells.map(i64::from);
        let forecast = self.forecasts.iter().find(|forecast| forecast.tick == Some(tick));
        let corner = forecast.map_or(window.corner, |forecast| forecast.corner);
        let growth = forecast.map_or(0.0, |forecast| forecast.growth);
        let mut expected = forecast.iter().flat_map(|forecast| &forecast.heights);
        let count = self.count;
        self.sums.clear();
        self.sums.resize(self.tiles.len(), [0.0; 3]);
        let columns = looked_at(tick, 0, corner[0], window.cells[0]);
        for j in looked_at(tick, 1, corner[1], window.cells[1]) {
            for i in columns.clone() {
                let expected = expected.next().copied();
                let world = [corner[0] + i as i64, corner[1] + j as i64];
                let [x, z] = [world[0] - window.corner[0], world[1] - window.corner[1]];
                if (0..nx).contains(&x) && (0..nz).contains(&z) {
                    let height = heights[(z * nx + x) as usize];
                    let off = expected.map_or(0.0, |expected| height - expected);
                    let sum = &mut self.sums[place(count, world.map(tile_of))];
                    *sum = [sum[0] + off * off, sum[1] + height * height, sum[2] + 1.0];
                }
            }
        }
        let first = window.corner.map(tile_of);
        for z in first[1]..=tile_of(window.corner[1] + nz - 1) {
            for x in first[0]..=tile_of(window.corner[0] + nx - 1) {
                let at = place(count, [x, z]);
                let ([error, height, number], tile) = (self.sums[at], &mut self.tiles[at]);
                if tile.at != [x, z] {
                    *tile = Found { at: [x, z], ..Found::default() };
                }
                if number > 0.0 {
                    tile.height = height / number;
                    if growth > 0.0 {
                        let error = error / (number * growth * growth);
                        tile.error = Some(tile.error.map_or(error, |before| before + SHARE * (error - before)));
                    }
                }
            }
        }
    }

    /// Standard deviation to be expected at a world cell, metres.
    pub(super) fn error(&self, cell: [i64; 2], growth: f32) -> f32 {
        if growth <= 0.0 {
            return 0.0;
        }
        let middle = cell.map(tile_of);
        // Waves come over from the tiles around.
        let (mut error, mut height, mut measured, mut seen) = (0.0, 0.0, 0.0f32, 0.0f32);
        for k in 0..9 {
            let by = [k % 3 - 1, k / 3 - 1];
            let at = [middle[0].saturating_add(by[0]), middle[1].saturating_add(by[1])];
            let tile = &self.tiles[place(self.count, at)];
            let weight = if by[0] == 0 { 2.0 } else { 1.0 } * if by[1] == 0 { 2.0 } else { 1.0 };
            if tile.at == at {
                height += weight * tile.height;
                seen += weight;
                if let Some(of_tile) = tile.error {
                    error += weight * of_tile;
                    measured += weight;
                }
            }
        }
        // No more than two heights that have nothing to do with each other.
        let most = (2.0 * height / seen.max(1.0)).sqrt();
        if measured > 0.0 { ((error / measured).sqrt() * growth).min(most) } else { most }
    }
}

/// Where a world tile has its place.
fn place(count: [i64; 2], tile: [i64; 2]) -> usize {
    (tile[1].rem_euclid(count[1]) * count[0] + tile[0].rem_euclid(count[0])) as usize
}

fn tile_of(cell: i64) -> i64 {
    cell.div_euclid(TILE)
}

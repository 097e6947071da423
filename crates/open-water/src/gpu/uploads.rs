//! Which part of a CPU-homed grid's drawn heights goes to the pool: what holds something, and what held something when it was
//! last uploaded. The rest of its place in the pool is zero already.
//!
//! Bands of 16 rows stand on the window, as the pool does: where the window shifts, waves leave one column and come to
//! another, and both are written.

use open_water_shaders::pipeline::Frame;
use slotmap::SecondaryMap;
use wave_grid::{TILE, WaveGrid};

use crate::store::GridId;

/// Cells whose upload takes as long as a copy of its own, by `frame_upload` of the evidence: where fewer are left out of a
/// row, it goes up whole, in one copy with those beside it.
const COPY: u32 = 1900;
const CELL: u64 = size_of::<[f32; 2]>() as u64;

/// A grid's bands: columns, first and end.
#[derive(Debug, Clone, Default)]
struct Bands {
    /// What holds something after the last tick.
    now: Vec<[u32; 2]>,
    /// What the pool holds of it; unknown while empty.
    held: Vec<[u32; 2]>,
}

/// Of all grids.
#[derive(Debug, Default)]
pub(crate) struct Uploads {
    grids: SecondaryMap<GridId, Bands>,
    /// Heights on their way.
    cells: Vec<[f32; 2]>,
    parts: Vec<[usize; 2]>,
}

impl Bands {
    /// Columns of each band that go up.
    fn columns(&self, nx: u32) -> impl Iterator<Item = [u32; 2]> {
        let known = self.held.len() == self.now.len();
        self.now.iter().enumerate().map(move |(band, now)| {
            let held = if known { self.held[band] } else { [0, nx] };
            let both = match (now[0] < now[1], held[0] < held[1]) {
                (true, true) => [now[0].min(held[0]), now[1].max(held[1])],
                (true, false) => *now,
                (false, _) => held,
            };
            if both[0] < both[1] && both[1] - both[0] + COPY > nx { [0, nx] } else { both }
        })
    }

    /// Bytes that go up.
    fn bytes(&self, [nx, nz]: [u32; 2]) -> u64 {
        let rows = |band: usize| (nz - (band * TILE) as u32).min(TILE as u32);
        let cells = |(band, [from, to]): (usize, [u32; 2])| u64::from(to - from) * u64::from(rows(band));
        CELL * self.columns(nx).enumerate().map(cells).sum::<u64>()
    }

    /// Stretches of cells that go up: number of the first, and how many.
    fn parts(&self, [nx, nz]: [u32; 2], parts: &mut Vec<[usize; 2]>) {
        parts.clear();
        for (band, [from, to]) in self.columns(nx).enumerate().filter(|(_, [from, to])| from < to) {
            for row in band * TILE..((band + 1) * TILE).min(nz as usize) {
                let first = row * nx as usize + from as usize;
                match parts.last_mut() {
                    Some([start, count]) if *start + *count == first => *count += (to - from) as usize,
                    _ => parts.push([first, (to - from) as usize]),
                }
            }
        }
    }
}

impl Uploads {
    /// Notes where a grid holds something after a tick.
    pub(crate) fn note(&mut self, id: GridId, waves: &WaveGrid) {
        if let Some(bands) = self.grids.entry(id) {
            waves.shown(&mut bands.or_default().now);
        }
    }

    /// Nothing is known of the pool any more, nor which grids there are: with a snapshot, older handles come back.
    pub(crate) fn forget(&mut self) {
        self.grids.clear();
    }

    /// The device itself draws a grid.
    pub(crate) fn forget_grid(&mut self, id: GridId) {
        self.grids.remove(id);
    }

    /// Bytes that go up of a grid as the last tick left it.
    pub(crate) fn bytes(&self, id: GridId, cells: [u32; 2]) -> u64 {
        let whole = CELL * u64::from(cells[0]) * u64::from(cells[1]);
        self.grids.get(id).map_or(whole, |bands| bands.bytes(cells))
    }

    /// Uploads what has changed of a grid, whose first cell is element `base` of the pool.
    pub(crate) fn write(
        &mut self,
        frame: &mut Frame<'_>,
        (pool, base): (&wgpu::Buffer, u32),
        (id, waves): (GridId, &WaveGrid),
        alpha: f32,
    ) {
        // Something may have fallen in since the tick.
        self.note(id, waves);
        let Some(bands) = self.grids.get_mut(id) else { return };
        bands.parts(waves.desc().cells, &mut self.parts);
        if self.parts.is_empty() {
            return;
        }
        self.cells.resize(self.parts.iter().map(|[_, count]| count).sum(), [0.0; 2]);
        let Some(room) = frame.room(CELL * self.cells.len() as u64) else { return bands.held.clear() };
        let mut at = 0;
        for [first, count] in &self.parts {
            let cells = &mut self.cells[at..at + count];
            waves.draw_from(*first, alpha, cells);
            let [from, bytes] = [at as u64 * CELL, *count as u64 * CELL];
            frame.copy(room, [from, bytes], pool, (u64::from(base) + *first as u64) * CELL);
            at += count;
        }
        frame.fill(room, 0, bytemuck::cast_slice(&self.cells));
        bands.held.clone_from(&bands.now);
    }
}

//! Takes over the waves of a grid of other cells: for a level of detail that follows the distance.
//!
//! A separable cubic kernel (Catmull-Rom), as wide as the wider of the two cells. Between sizes of whole ratio, whose cells
//! stand on the same world multiples, it gives every cell of the source the same weight in all, so the volume is kept.

use std::ops::Range;

use crate::WaveGrid;
use crate::cpu::{foam::measure, ghosts, tiles::Mode};
use crate::state::State;

/// For one axis: of each new cell the first old cell that it reads, and their weights.
struct Taps(Vec<(usize, Vec<f32>)>);

/// The kernel at a distance in cells.
fn kernel(x: f64) -> f64 {
    let d = x.abs();
    if d < 1.0 {
        (1.5 * d - 2.5) * d * d + 1.0
    } else if d < 2.0 {
        ((-0.5 * d + 2.5) * d - 4.0) * d + 2.0
    } else {
        0.0
    }
}

impl Taps {
    fn new(to: &WaveGrid, from: &WaveGrid, axis: usize) -> Self {
        let (new, old) = (to.window(), from.window());
        let [h, k] = [new.cell_size[axis], old.cell_size[axis]].map(f64::from);
        let wide = (h / k).max(1.0);
        let taps = (0..new.cells[axis]).map(|i| {
            // The new cell's centre, in old cells from the first one's centre.
            let world = new.corner[axis] as f64 + f64::from(i) + 0.5;
            let at = world * (h / k) - old.corner[axis] as f64 - 0.5;
            let reach = |x: f64| x.clamp(0.0, f64::from(old.cells[axis])) as usize;
            let (first, end) = (reach((at - 2.0 * wide).floor() + 1.0), reach((at + 2.0 * wide).ceil()));
            let weight = |n: i64| kernel((n as f64 - at) / wide);
            // Of all cells that the kernel covers, also those beyond the old window, whose water is calm.
            let (low, high) = ((at - 2.0 * wide).floor() as i64, (at + 2.0 * wide).ceil() as i64);
            let all: f64 = (low..=high).map(weight).sum();
            (first, (first..end).map(|n| (weight(n as i64) / all) as f32).collect())
        });
        Self(taps.collect())
    }
}

/// Reads a field of the old grid, which is zero outside `rows`, at all cells of the new one.
fn read(field: &[f32], width: usize, rows: &Range<usize>, [x, z]: &[Taps; 2], across: &mut Vec<f32>, out: &mut [f32]) {
    across.clear();
    for row in field[rows.start * width..rows.end * width].chunks_exact(width) {
        across.extend(x.0.iter().map(|(first, weights)| {
            row[*first..].iter().zip(weights).fold(0.0, |sum, (value, weight)| sum + weight * value)
        }));
    }
    let n = x.0.len();
    for ((first, weights), out) in z.0.iter().zip(out.chunks_exact_mut(n)) {
        out.fill(0.0);
        let skipped = rows.start.saturating_sub(*first);
        let lines = across.chunks_exact(n).skip(first.saturating_sub(rows.start));
        for (row, weight) in lines.zip(weights.iter().skip(skipped)) {
            for (out, value) in out.iter_mut().zip(row) {
                *out += weight * value;
            }
        }
    }
}

/// The rows of a grid that hold anything.
fn rows(grid: &WaveGrid) -> Range<usize> {
    let tiles = &grid.tiles;
    let holds = |tz: &usize| tiles.row(*tz).iter().any(|t| t.mode != Mode::Quiet || t.height > 0.0 || t.foam > 0.0);
    let mut held = (0..tiles.count[1]).filter(holds).map(|tz| tiles.span(1, tz));
    let Some(first) = held.next() else { return 0..0 };
    first.start..held.next_back().unwrap_or(first).end
}

impl WaveGrid {
    /// Takes over the waves and the foam of `from`, another grid over the same water: its cells, sub-steps and scheme may
    /// differ, and it is read where this window stands. What `from` does not hold is calm; the memory of the
    /// border layer begins anew. Waves shorter than this grid's cells can carry are left behind.
    ///
    /// Between cell sizes of a whole ratio the volume within both windows is kept to rounding.
    pub fn resample(&mut self, from: &WaveGrid) {
        self.clear();
        if from.is_asleep() {
            return;
        }
        let taps = [0, 1].map(|axis| Taps::new(self, from, axis));
        let width = from.state.nx;
        let rows = rows(from);
        let before = self.older(from);
        let drawn = from.drawn_before();
        let mut across = Vec::new();
        let potential = if self.desc.scheme.is_wave_equation() { None } else { from.velocity_potential() };
        let mut phi = vec![0.0; self.state.z.len()];
        if let Some(potential) = &potential {
            read(potential, width, &rows, &taps, &mut across, &mut phi);
        }
        for (field, out) in [
            (&from.state.z[..], &mut self.state.z),
            (&before, &mut self.state.old),
            (&drawn, &mut self.state.previous),
            (&from.state.foam, &mut self.state.foam),
        ] {
            read(field, width, &rows, &taps, &mut across, out);
        }
        let (nx, nz) = (self.state.nx, self.state.nz);
        for array in [&mut self.state.z, &mut self.state.old, &mut self.state.foam] {
            array[..nx].fill(0.0);
            array[(nz - 1) * nx..].fill(0.0);
            array.chunks_exact_mut(nx).for_each(|row| (row[0], row[nx - 1]) = (0.0, 0.0));
        }
        self.state.foam.iter_mut().for_each(|foam| *foam = foam.clamp(0.0, 1.0));
        self.captured = from.captured;
        match potential {
            Some(_) => self.start_from_potential(&mut phi),
            None => self.start_from_heights(),
        }
        self.dry_walls();
        self.tiles.activate_all();
        measure(&self.state, &mut self.tiles, true);
        self.tiles.note_foam(&self.state.foam);
        self.tiles.note_kept(true);
        if let Some(cells) = self.ground.as_ref().and_then(|ground| ground.cells.as_ref()) {
            let State { z, old, previous, .. } = &mut self.state;
            ghosts::fill([z, old, previous], &self.tiles, cells);
        }
    }

    /// The heights of `from` one of this grid's sub-steps ago: from its own two states and the acceleration between them.
    fn older(&self, from: &WaveGrid) -> Vec<f32> {
        let (z, old) = (&from.state.z, &from.state.old);
        let share = self.stepping.dt / from.stepping.dt;
        if share == 1.0 {
            return old.to_vec();
        }
        // z(t - s) = z - s v + s^2 w/2 with z - old = dt v - dt^2 w/2 and dt^2 w = div(a grad z).
        let bend = (0.5 * (share * share - share)) as f32;
        let share = share as f32;
        let [ax, az] = from.stepping.a.map(|a| a as f32);
        let nx = from.state.nx;
        let inside = |at: usize| {
            let (i, j) = (at % nx, at / nx);
            i > 0 && j > 0 && i + 1 < nx && j + 1 < from.state.nz
        };
        let (cells, waves) = (from.cells(), from.desc.scheme.is_wave_equation());
        (0..z.len())
            .map(|at| {
                let falling = if !inside(at) || !waves {
                    0.0
                } else if let Some(cells) = cells {
                    if cells.is_open(at) { cells.divergence(z, at) as f32 } else { 0.0 }
                } else {
                    ax * (z[at - 1] + z[at + 1] - 2.0 * z[at]) + az * (z[at - nx] + z[at + nx] - 2.0 * z[at])
                };
                z[at] - share * (z[at] - old[at]) + bend * falling
            })
            .collect()
    }
}

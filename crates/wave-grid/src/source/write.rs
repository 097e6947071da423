//! Writes sources into the state of a grid on the CPU.

use super::footprint::{Footprint, Site};
use super::{HEIGHT_LIMIT, Rain, Source};
use crate::{Border, WaveGrid, Window};

impl WaveGrid {
    /// Adds a disturbance to be felt from the next tick on. Returns whether it was: a source that is not finite, has a
    /// negative radius, reaches into the border layer or out of the window, or has less than an eighth of its weight over
    /// open water is dropped and counted. It is written into open water only, all of it. Heights are
    /// kept within [`HEIGHT_LIMIT`]; below it the volume is written exactly to rounding.
    pub fn add(&mut self, source: Source) -> bool {
        let added = self.put(source);
        self.dropped += u64::from(!added);
        added
    }

    /// Lets the rain of a tick fall: every drop whose footprint is clear of the border layer and walls. `tick` counts
    /// ticks of this grid's [`crate::GridDesc::tick`]. Returns how many fell.
    pub fn add_rain(&mut self, rain: &Rain, tick: u64) -> usize {
        let mut window = self.place.window;
        if self.desc.border == Border::Periodic {
            // Its ring is not its own.
            window = Window { corner: window.corner.map(|c| c + 1), cells: window.cells.map(|n| n - 2), ..window };
        }
        let drops = rain.drops(&window, self.origin, tick, self.desc.tick);
        drops.filter(|drop| self.put(*drop)).count()
    }

    fn put(&mut self, source: Source) -> bool {
        if self.desc.border == Border::Periodic {
            return self.put_tiled(source);
        }
        let mut weights = std::mem::take(&mut self.weights);
        let [first, second] = &mut weights;
        let rim = self.source_rim();
        let site = Site { window: &self.place.window, origin: self.origin, rim, cells: self.cells() };
        let placed = site.place(source, [first, second]);
        if let Some(parts) = placed {
            self.capture();
            for (part, weights) in parts.iter().zip(&weights) {
                if let Some(footprint) = part {
                    self.keep_around(footprint.range);
                    self.tiles.touch(footprint.range, footprint.height, footprint.foam);
                    self.write(footprint, weights);
                }
            }
        }
        self.weights = weights;
        placed.is_some()
    }

    fn write(&mut self, footprint: &Footprint, weights: &[f32]) {
        let nx = self.state.nx;
        let [columns, rows] = footprint.range.map(|[low, high]| low..high);
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        if footprint.height != 0.0 || footprint.foam > 0.0 {
            for (j, row) in rows.zip(weights.chunks_exact(columns.len())) {
                for (i, weight) in columns.clone().zip(row) {
                    let at = j * nx + i;
                    if cells.is_some_and(|cells| !cells.is_open(at)) {
                        continue;
                    }
                    let rise = weight * footprint.height;
                    for z in [&mut self.state.z[at], &mut self.state.old[at]] {
                        *z = (*z + rise).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
                    }
                    let foam = &mut self.state.foam[at];
                    *foam = (*foam + weight * footprint.foam).min(1.0);
                }
            }
        }
        if footprint.head != 0.0 {
            self.press(footprint, weights);
        }
    }

    /// The impulse of a tick's pressure: z_old falls by substeps times a lap(p / (rho g)), in flux form, and by what
    /// damping takes of it in the sub-step that follows.
    fn press(&mut self, footprint: &Footprint, weights: &[f32]) {
        if self.fields.is_some() {
            self.press_potential(footprint, weights);
            return;
        }
        if self.spectral.is_some() {
            self.press_spectrum(footprint, weights);
            return;
        }
        let nx = self.state.nx;
        let [[x0, x1], [z0, z1]] = footprint.range;
        let width = x1 - x0;
        let head = |i: usize, j: usize| {
            let inside = (x0..x1).contains(&i) && (z0..z1).contains(&j);
            if inside { f64::from(weights[(j - z0) * width + i - x0]) * f64::from(footprint.head) } else { 0.0 }
        };
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        let substeps = f64::from(self.stepping.substeps);
        let plain = 1.0 / (1.0 + 0.5 * f64::from(self.desc.damping) * self.stepping.dt);
        // r of a cell is 1 / (1 + s), the step keeps 1 - s of a kick.
        let made_up = |r: f64| (r / (2.0 * r - 1.0).max(0.25)).max(1.0);
        let mut most = 0.0f32;
        for j in z0 - 1..z1 + 1 {
            for i in x0 - 1..x1 + 1 {
                let at = j * nx + i;
                let flow = match cells {
                    Some(cells) if !cells.is_open(at) => continue,
                    Some(cells) => {
                        made_up(f64::from(cells.r[at])) * cells.divergence_of(|at| head(at % nx, at / nx), at)
                    }
                    None => made_up(plain) * self.plain_divergence(|di, dj| head(i + di - 1, j + dj - 1)),
                };
                let kick = (substeps * flow) as f32;
                most = most.max(kick.abs());
                let old = &mut self.state.old[at];
                *old = (*old - kick).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
            }
        }
        self.tiles.touch([[x0 - 1, x1 + 1], [z0 - 1, z1 + 1]], most, 0.0);
    }

    /// The same where waves disperse: the potential falls by G p / (rho g) in every sub-step of the tick.
    fn press_potential(&mut self, footprint: &Footprint, weights: &[f32]) {
        let nx = self.state.nx;
        let [columns, rows] = footprint.range.map(|[low, high]| low..high);
        let kick = (f64::from(self.stepping.substeps) * self.stepping.a[0] * f64::from(footprint.head)) as f32;
        let cells = self.ground.as_ref().and_then(|ground| ground.cells.as_ref());
        let Some(fields) = &mut self.fields else { return };
        for (j, row) in rows.zip(weights.chunks_exact(columns.len())) {
            for (i, weight) in columns.clone().zip(row) {
                let at = j * nx + i;
                if cells.is_none_or(|cells| cells.is_open(at)) {
                    fields.potential[at] = (fields.potential[at] - weight * kick).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
                }
            }
        }
        self.tiles.touch(footprint.range, kick.abs(), 0.0);
    }

    /// The same in the spectral scheme.
    fn press_spectrum(&mut self, footprint: &Footprint, weights: &[f32]) {
        let Some(spectral) = &mut self.spectral else { return };
        let [columns, rows] = footprint.range.map(|[low, high]| low..high);
        let mut most = 0.0f32;
        for (j, row) in rows.zip(weights.chunks_exact(columns.len())) {
            for (i, weight) in columns.clone().zip(row) {
                most = most.max(spectral.press(j * self.state.nx + i, weight * footprint.head));
            }
        }
        self.tiles.touch(footprint.range, most, 0.0);
    }

    /// a lap of a field around a cell of plain water; `field(1, 1)` is the cell's own value.
    fn plain_divergence(&self, field: impl Fn(usize, usize) -> f64) -> f64 {
        let (straight, beside) = self.desc.scheme.weights();
        let [ax, az] = self.stepping.a;
        let row = |j: usize| (field(0, j) - field(1, j)) + (field(2, j) - field(1, j));
        let column = |i: usize| (field(i, 0) - field(i, 1)) + (field(i, 2) - field(i, 1));
        ax * (straight * row(1) + beside * (row(0) + row(2)))
            + az * (straight * column(1) + beside * (column(0) + column(2)))
    }
}

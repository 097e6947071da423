//! Writes sources into a grid that repeats: what reaches over an edge goes on at the opposite one.

use glam::Vec2;

use super::footprint::{Footprint, Site};
use super::{HEIGHT_LIMIT, Source};
use crate::{WaveGrid, Window};

impl Source {
    /// The same disturbance elsewhere.
    fn moved(mut self, by: Vec2) -> Self {
        match &mut self {
            Self::Displacement { center, .. }
            | Self::Box { center, .. }
            | Self::Pressure { center, .. }
            | Self::Drop { center, .. }
            | Self::Turbulence { center, .. } => *center += by,
            Self::Paddle { from, to, .. } => {
                *from += by;
                *to += by;
            }
        }
        self
    }

    /// A place of it.
    fn place(&self) -> Vec2 {
        match *self {
            Self::Displacement { center, .. }
            | Self::Box { center, .. }
            | Self::Pressure { center, .. }
            | Self::Drop { center, .. }
            | Self::Turbulence { center, .. } => center,
            Self::Paddle { from, .. } => from,
        }
    }
}

impl WaveGrid {
    /// As `put`, in a grid that repeats. It takes no pressure.
    pub(super) fn put_tiled(&mut self, source: Source) -> bool {
        let place = source.place();
        if !place.is_finite() || matches!(source, Source::Pressure { .. }) {
            return false;
        }
        let mut weights = std::mem::take(&mut self.weights);
        let [first, second] = &mut weights;
        let window = self.place.window;
        let to = (self.place.cell_of(place, self.origin) - window.cells_from_corner(place, self.origin)) * window.h();
        let source = source.moved(Vec2::new(to.x as f32, to.y as f32));
        // Three by three of it, this one in the middle.
        let period = window.cells.map(|n| n - 2);
        let corner = [0, 1].map(|k| window.corner[k] - i64::from(period[k]));
        let around = Window { corner, cells: period.map(|n| 3 * n), ..window };
        let placed = Site { window: &around, origin: self.origin, rim: 0, cells: None }.place(source, [first, second]);
        if let Some(parts) = placed {
            self.capture();
            let all = window.cells.map(|n| [0, n as usize]);
            self.keep_around(all);
            for (part, weights) in parts.iter().zip(&weights) {
                if let Some(footprint) = part {
                    self.tiles.touch(all, footprint.height, footprint.foam);
                    self.write_tiled(footprint, weights, period.map(|n| n as usize));
                }
            }
        }
        self.weights = weights;
        placed.is_some()
    }

    fn write_tiled(&mut self, footprint: &Footprint, weights: &[f32], period: [usize; 2]) {
        let nx = self.state.nx;
        let [columns, rows] = footprint.range.map(|[low, high]| low..high);
        let wrapped = |i: usize, k: usize| 1 + (i + period[k] - 1) % period[k];
        for (j, row) in rows.zip(weights.chunks_exact(columns.len())) {
            for (i, weight) in columns.clone().zip(row) {
                let at = wrapped(j, 1) * nx + wrapped(i, 0);
                for z in [&mut self.state.z[at], &mut self.state.old[at]] {
                    *z = (*z + weight * footprint.height).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
                }
                let foam = &mut self.state.foam[at];
                *foam = (*foam + weight * footprint.foam).min(1.0);
            }
        }
    }
}

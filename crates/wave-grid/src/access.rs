//! What can be asked of a grid and set on it besides stepping.

use glam::Vec2;

use crate::source::HEIGHT_LIMIT;
use crate::{Border, GridDesc, GridError, Stepping, WaveGrid, Window, cpu};

impl WaveGrid {
    /// Where the window stands: world corner in cells, extent, cell size.
    pub fn window(&self) -> Window {
        self.place.window
    }

    /// A bound of the heights between two local corners and of what can get there in the next tick, metres, without fade;
    /// 0 outside the window. It is that of whole tiles of 16 cells.
    pub fn largest_within(&self, low: Vec2, high: Vec2) -> f32 {
        if self.at_rest() {
            return 0.0;
        }
        if self.desc.border == Border::Periodic {
            return self.tiles.tiles.iter().fold(0.0, |most, tile| tile.height.max(most));
        }
        let window = &self.place.window;
        let [a, b] = [low, high].map(|corner| window.cells_from_corner(corner, self.origin));
        let reach = f64::from(self.stepping.substeps) + 2.0;
        let (first, last) = (a.min(b) - reach, a.max(b) + reach);
        let range = |axis: usize, first: f64, last: f64| {
            let n = window.cells[axis] as usize;
            let (from, to) = (first.max(0.0) as usize, last.min(n as f64 - 1.0));
            (first < n as f64 && to >= 0.0).then(|| self.tiles.of(axis, from)..=self.tiles.of(axis, to as usize))
        };
        let (Some(columns), Some(rows)) = (range(0, first.x, last.x), range(1, first.y, last.y)) else { return 0.0 };
        rows.flat_map(|row| &self.tiles.row(row)[columns.clone()]).fold(0.0, |most, tile| tile.height.max(most))
    }

    /// The description it was made from.
    pub fn desc(&self) -> &GridDesc {
        &self.desc
    }

    /// Sub-steps, their length and the Courant number.
    pub fn stepping(&self) -> Stepping {
        self.stepping
    }

    /// Heights of all cells without fade, metres, row-major, x fastest.
    pub fn heights(&self) -> &[f32] {
        &self.state.z
    }

    /// Sets the heights now and one sub-step ago (cells as [`Self::heights`]), still foam, no memory in the border.
    /// Values that are not finite count as zero, others are kept within [`HEIGHT_LIMIT`]; the outermost ring is zero,
    /// and so is what a medium makes no open water. Of water waves, what else the scheme keeps is found for open water of one
    /// depth, the mean; near a border that absorbs for less and less of the heights.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] when a slice has not one value per cell.
    pub fn impose(&mut self, now: &[f32], before: &[f32]) -> Result<(), GridError> {
        for (field, given) in [("now", now), ("before", before)] {
            if given.len() != self.state.z.len() {
                let bound = "one value per cell";
                return Err(GridError::InvalidValue { field, value: given.len() as f64, bound });
            }
        }
        self.state.clear();
        if let Some(fields) = &mut self.fields {
            fields.clear();
        }
        if let Some(spectral) = &mut self.spectral {
            spectral.clear();
        }
        let (nx, nz) = (self.state.nx, self.state.nz);
        for (array, given) in [(&mut self.state.z, now), (&mut self.state.old, before)] {
            for j in 1..nz - 1 {
                let row = j * nx + 1..(j + 1) * nx - 1;
                for (z, v) in array[row.clone()].iter_mut().zip(&given[row]) {
                    *z = if v.is_finite() { v.clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT) } else { 0.0 };
                }
            }
        }
        self.start_from_heights();
        self.dry_walls();
        self.captured = false;
        self.capture();
        self.tiles.activate_all();
        cpu::foam::measure(&self.state, &mut self.tiles, true);
        Ok(())
    }

    /// Sources dropped so far, see [`Self::add`].
    pub fn dropped_sources(&self) -> u64 {
        self.dropped
    }

    /// Whether nothing moves: ticks cost nothing and there is nothing to draw.
    pub fn is_asleep(&self) -> bool {
        self.tiles.asleep()
    }

    /// Tiles stepped in the last tick.
    pub fn active_tiles(&self) -> usize {
        self.tiles.active
    }
}

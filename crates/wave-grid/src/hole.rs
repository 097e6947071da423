//! Where a finer grid is seen instead of a coarser one that holds the same waves.

use glam::DVec2;

use crate::window::Place;
use crate::{Border, WaveGrid, Window};

/// What a grid shows, to be cut out of coarser ones: its fade at every place. See [`WaveGrid::set_holes`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// World places where the fade reaches zero, metres.
    low: DVec2,
    high: DVec2,
    /// Metres over which it rises.
    rise: DVec2,
    /// Factor on it, 0 to 1.
    gain: f32,
}

impl Hole {
    /// `gain` (0 to 1) is the factor on the heights with which the grid at this place is shown.
    pub(crate) fn new(place: &Place, gain: f32) -> Self {
        let (h, corner) = (place.window.h(), place.window.world_corner());
        let [x, z] = [0, 1].map(|axis| place.fade_reach(axis));
        let end = |way: f64| corner + DVec2::new(x[0] + way * x[1], z[0] + way * z[1]) * h;
        Self { low: end(-1.0), high: end(1.0), rise: place.fade_width() * h, gain: 0.0 }.with_gain(gain)
    }

    /// The same with another factor, 0 to 1.
    pub fn with_gain(self, gain: f32) -> Self {
        Self { gain: if gain > 0.0 { gain.min(1.0) } else { 0.0 }, ..self }
    }

    /// The fade at a world place along one axis (0 along x, 1 along z), metres: the product of both axes' and of
    /// [`Self::gain`] is what is shown of a height.
    pub fn fade(&self, axis: usize, place: f64) -> f32 {
        let t = ((place - self.low[axis]).min(self.high[axis] - place) / self.rise[axis]).clamp(0.0, 1.0);
        (t * t * (3.0 - 2.0 * t)) as f32
    }

    /// Factor on the heights, 0 to 1.
    pub fn gain(&self) -> f32 {
        self.gain
    }

    /// Low ends, high ends and rise in cells of a window from its corner, and the factor.
    #[cfg(feature = "gpu")]
    pub(crate) fn in_cells(&self, window: &Window) -> ([[f32; 2]; 3], f32) {
        let (corner, h) = (window.world_corner(), window.h());
        let cells = [(self.low - corner) / h, (self.high - corner) / h, self.rise / h];
        (cells.map(|v| v.as_vec2().to_array()), self.gain)
    }

    /// Fade along one axis at the centres of a window's cells.
    fn along(&self, window: &Window, axis: usize, out: &mut Vec<f32>) {
        let (h, first) = (window.h()[axis], window.corner[axis] as f64 + 0.5);
        out.clear();
        out.extend((0..window.cells[axis]).map(|i| self.fade(axis, (first + f64::from(i)) * h)));
    }
}

/// A hole at the cells of a window: the product of both axes' factors.
#[derive(Debug, Clone, Default)]
struct Cut {
    x: Vec<f32>,
    z: Vec<f32>,
}

/// The holes in a grid.
#[derive(Debug, Clone, Default)]
pub(crate) struct Holes {
    holes: Vec<Hole>,
    cuts: Vec<Cut>,
}

impl Holes {
    pub(crate) fn is_empty(&self) -> bool {
        self.holes.is_empty()
    }

    /// Works out what is cut of the cells of a window.
    pub(crate) fn place(&mut self, window: &Window) {
        self.cuts.resize_with(self.holes.len(), Cut::default);
        for (hole, Cut { x, z }) in self.holes.iter().zip(&mut self.cuts) {
            hole.along(window, 0, x);
            hole.along(window, 1, z);
            x.iter_mut().for_each(|x| *x *= hole.gain);
        }
    }

    /// What is left of four cells of a row from column `first` on.
    pub(crate) fn left(&self, row: usize, first: usize) -> [f32; 4] {
        let mut left = [1.0f32; 4];
        for Cut { x, z } in &self.cuts {
            for (left, x) in left.iter_mut().zip(&x[first..first + 4]) {
                *left -= z[row] * x;
            }
        }
        left.map(|left| left.max(0.0))
    }

    /// Cuts them out of what is drawn of row `row` from column `first` on.
    pub(crate) fn cut(&self, row: usize, first: usize, drawn: &mut [[f32; 2]]) {
        if !self.cuts.iter().any(|cut| cut.z[row] > 0.0) {
            return;
        }
        for (i, cell) in (first..).zip(drawn) {
            let left = self.cuts.iter().fold(1.0, |left, Cut { x, z }| left - z[row] * x[i]);
            *cell = cell.map(|value| value * left.max(0.0));
        }
    }
}

impl WaveGrid {
    /// What this grid shows when its heights are shown times `gain`, 0 to 1: to be cut out of a coarser one around it.
    pub fn hole(&self, gain: f32) -> Hole {
        Hole::new(&self.place, gain)
    }

    /// Sets where finer grids that hold the same waves are seen instead of this one: there [`Self::draw`] and
    /// [`Self::sample`] give the heights times one less the sum of their fades. What is stepped does not change. Set them
    /// anew when a window has moved. A grid that repeats takes none.
    pub fn set_holes(&mut self, holes: &[Hole]) {
        self.holes.holes.clear();
        if self.desc.border != Border::Periodic {
            self.holes.holes.extend_from_slice(holes);
        }
        self.holes.place(&self.place.window);
    }

    /// Sets whether it lies in a coarser grid that is seen where this one ends (default not): then its fade ends where its
    /// border layer begins, so that nothing is seen of what the layer takes.
    pub fn set_nested(&mut self, nested: bool) {
        self.place.nested = nested;
        self.update_fade();
    }
}

//! What disturbs a grid: discs of displaced volume and of foam, at least three cells in radius.
//!
//! No border absorbs waves of one or two cells, so a source falls off from its middle with a C1 kernel (a flat top sheds
//! short waves as it moves), and its discrete sum is normalised: the volume written is the volume asked for, wherever the
//! disc stands between cells.

use glam::{DVec2, Vec2};

use crate::Window;
use crate::ground::Cells;

pub use open_water_shaders::grid::HEIGHT_LIMIT;

/// Least radius that counts, and what is added to it for the kernel's fall, cells.
const SOFT: f64 = 1.5;

/// Least share of a source's weight that must lie over open water: what it holds is all written there.
const LEAST_OPEN: f64 = 0.125;

/// A disturbance of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Source {
    /// Water pushed up (positive) or let down (negative), written into this and the last state: no kick in velocity.
    Displacement {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Volume, cubic metres, signed.
        volume: f32,
    },
    /// Foam stirred up, as behind a propeller.
    Turbulence {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Foam added in the middle, 0 to 1.
        foam: f32,
    },
}

/// A source in units of a window's cells, checked and normalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Footprint {
    /// Centre, cells from the corner.
    pub(crate) center: [f32; 2],
    /// Where it ends along x, cells.
    pub(crate) outer: f32,
    /// Reach along x over reach along z, in cells.
    pub(crate) stretch: f32,
    /// Height in the middle, metres.
    pub(crate) height: f32,
    /// Foam in the middle.
    pub(crate) foam: f32,
    /// First cell and one past the last, per axis.
    pub(crate) range: [[usize; 2]; 2],
}

impl Footprint {
    /// `None` when a number is not finite, the radius is negative or a cell of the footprint lies in the border layer
    /// (`rim` cells on each side) or outside; and when walls or held water take more than seven eighths of it.
    pub(crate) fn new(
        source: Source,
        window: &Window,
        origin: DVec2,
        rim: usize,
        cells: Option<&Cells>,
    ) -> Option<Self> {
        let (center, radius, volume, foam) = match source {
            Source::Displacement { center, radius, volume } => (center, radius, volume, 0.0),
            Source::Turbulence { center, radius, foam } => (center, radius, 0.0, foam),
        };
        if !(center.is_finite() && radius.is_finite() && radius >= 0.0 && volume.is_finite() && foam.is_finite()) {
            return None;
        }
        let h = window.cell_size.map(f64::from);
        let at = window.cells_from_corner(center, origin);
        let outer = h.map(|h| (f64::from(radius) / h).max(SOFT) + SOFT);
        let mut range = [[0; 2]; 2];
        for (k, r) in range.iter_mut().enumerate() {
            let (low, high) = (at[k] - outer[k], at[k] + outer[k]);
            if low < rim as f64 || high > (window.cells[k] as usize - rim) as f64 {
                return None;
            }
            *r = [low.floor() as usize, high.ceil() as usize];
        }
        let mut footprint = Self {
            center: [at.x as f32, at.y as f32],
            outer: outer[0] as f32,
            stretch: (outer[0] / outer[1]) as f32,
            height: 0.0,
            foam: foam.clamp(0.0, 1.0),
            range,
        };
        if volume != 0.0 || cells.is_some() {
            let (mut sum, mut total) = (0.0f64, 0.0f64);
            for j in range[1][0]..range[1][1] {
                for i in range[0][0]..range[0][1] {
                    let weight = f64::from(footprint.weight(i, j));
                    total += weight;
                    if cells.is_none_or(|cells| cells.is_open(j * cells.nx + i)) {
                        sum += weight;
                    }
                }
            }
            if sum < LEAST_OPEN * total {
                return None;
            }
            let height = f64::from(volume) / (h[0] * h[1] * sum);
            footprint.height = height.clamp(-f64::from(HEIGHT_LIMIT), f64::from(HEIGHT_LIMIT)) as f32;
        }
        Some(footprint)
    }

    /// Weight of cell (i, j): a smoothstep from 1 in the middle to 0 at the end.
    pub(crate) fn weight(&self, i: usize, j: usize) -> f32 {
        let dx = i as f32 + 0.5 - self.center[0];
        let dz = self.stretch * (j as f32 + 0.5 - self.center[1]);
        let t = ((self.outer - (dx * dx + dz * dz).sqrt()) / self.outer).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

//! Sources as a grid sees them: shapes in units of its cells, checked and normalised.

use glam::{DVec2, Vec2};

use super::{DENSITY, GRAVITY, HEIGHT_LIMIT, Source};
use crate::Window;
use crate::ground::Cells;

/// Least radius that counts, and what is added to it for the kernel's fall, cells.
pub(crate) const SOFT: f64 = 1.5;

/// Least share of a source's weight that must lie over open water: what it holds is all written there.
const LEAST_OPEN: f64 = 0.125;

/// How a footprint's weight falls off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// A smoothstep from 1 in the middle to 0 at `outer`.
    Disc {
        /// Where it ends along x, cells.
        outer: f32,
        /// That over where it ends along z, cells.
        stretch: f32,
    },
    /// The product of two smoothsteps across the edges.
    Box {
        /// Cell size along x and z, metres.
        cell: [f32; 2],
        /// Cosine and sine of the heading.
        along: [f32; 2],
        /// Half length and width to the middle of the edges, metres.
        half: [f32; 2],
        /// Half the width of the edges, metres.
        soft: f32,
    },
}

/// A footprint: what is added to a cell is its weight times the numbers here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Footprint {
    /// Centre, cells from the corner.
    pub(crate) center: [f32; 2],
    pub(crate) shape: Shape,
    /// Height in the middle, metres.
    pub(crate) height: f32,
    /// Pressure over rho g in the middle, metres.
    pub(crate) head: f32,
    /// Foam in the middle.
    pub(crate) foam: f32,
    /// First cell and one past the last, per axis.
    pub(crate) range: [[usize; 2]; 2],
}

/// What a footprint is placed in.
pub(crate) struct Site<'a> {
    pub(crate) window: &'a Window,
    pub(crate) origin: DVec2,
    /// Cells of the border layer on each side, where nothing may be written.
    pub(crate) rim: usize,
    pub(crate) cells: Option<&'a Cells>,
}

impl Site<'_> {
    fn cell(&self) -> [f64; 2] {
        self.window.cell_size.map(f64::from)
    }

    /// The footprints of a source, and the weights of each in `weights` (row by row of its range). `None` when a number is
    /// not finite, a size is negative, a cell of the footprint lies in the border layer or outside, or walls or held
    /// water take more than seven eighths of it.
    pub(crate) fn place(&self, source: Source, weights: [&mut Vec<f32>; 2]) -> Option<[Option<Footprint>; 2]> {
        let [first, second] = weights;
        let disc = |center: Vec2, radius: f32, wider: f64| {
            let finite = center.is_finite() && radius.is_finite() && radius >= 0.0;
            let outer = self.cell().map(|h| wider * ((f64::from(radius) / h).max(SOFT) + SOFT));
            let shape = Shape::Disc { outer: outer[0] as f32, stretch: (outer[0] / outer[1]) as f32 };
            if finite { self.empty(center, shape, outer) } else { None }
        };
        match source {
            Source::Displacement { center, radius, volume } => {
                let footprint = disc(center, radius, 1.0)?;
                Some([Some(self.fill(footprint, volume, first)?), None])
            }
            Source::Box { center, half, heading, volume } => {
                let fits = center.is_finite() && half.is_finite() && half.min_element() >= 0.0 && heading.is_finite();
                let footprint = if fits { self.rectangle(center, half, heading)? } else { return None };
                Some([Some(self.fill(footprint, volume, first)?), None])
            }
            Source::Paddle { from, to, flow } => {
                let line = to - from;
                let heading = libm::atan2(f64::from(line.y), f64::from(line.x));
                // Even all along, the ends fall off beyond.
                let soft = SOFT * self.cell()[0].max(self.cell()[1]);
                let half = Vec2::new(0.5 * line.length() + soft as f32, 0.0);
                let fits = from.is_finite() && half.is_finite() && flow.is_finite();
                let center = from + 0.5 * line;
                let mut footprint = if fits { self.rectangle(center, half, heading as f32)? } else { return None };
                footprint.weigh(first);
                // Across it the smoothsteps have half their width.
                let height = f64::from(flow) / (2.0 * soft);
                footprint.height = height.clamp(-f64::from(HEIGHT_LIMIT), f64::from(HEIGHT_LIMIT)) as f32;
                Some([Some(footprint), None])
            }
            Source::Pressure { center, radius, pressure } => {
                let mut footprint = self.fill(disc(center, radius, 1.0)?, 0.0, first)?;
                // What it does reaches one cell farther.
                let reaches = (0..2).any(|k| {
                    let [low, high] = footprint.range[k];
                    low < self.rim + 1 || high + self.rim + 1 > self.window.cells[k] as usize
                });
                footprint.head = (pressure / (DENSITY * GRAVITY)).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
                if reaches || !pressure.is_finite() { None } else { Some([Some(footprint), None]) }
            }
            Source::Drop { center, radius, volume } => {
                let crater = self.fill(disc(center, radius, 1.0)?, -volume, first)?;
                let rim = self.fill(disc(center, radius, 2.0)?, volume, second)?;
                Some([Some(crater), Some(rim)])
            }
            Source::Turbulence { center, radius, foam } => {
                let mut footprint = self.fill(disc(center, radius, 1.0)?, 0.0, first)?;
                footprint.foam = foam.clamp(0.0, 1.0);
                if foam.is_finite() { Some([Some(footprint), None]) } else { None }
            }
        }
    }

    fn rectangle(&self, center: Vec2, half: Vec2, heading: f32) -> Option<Footprint> {
        let cell = self.cell();
        let soft = SOFT * cell[0].max(cell[1]);
        let (sin, cos) = libm::sincos(f64::from(heading));
        let half = [half.x, half.y].map(|half| f64::from(half).max(soft));
        let [length, width] = half.map(|half| half + soft);
        let reach =
            [(cos.abs() * length + sin.abs() * width) / cell[0], (sin.abs() * length + cos.abs() * width) / cell[1]];
        let shape = Shape::Box {
            cell: cell.map(|h| h as f32),
            along: [cos as f32, sin as f32],
            half: half.map(|half| half as f32),
            soft: soft as f32,
        };
        self.empty(center, shape, reach)
    }

    /// A footprint that reaches so many cells from its centre, if that is within the border layer.
    fn empty(&self, center: Vec2, shape: Shape, reach: [f64; 2]) -> Option<Footprint> {
        let at = self.window.cells_from_corner(center, self.origin);
        let mut range = [[0; 2]; 2];
        for (k, r) in range.iter_mut().enumerate() {
            let (low, high) = (at[k] - reach[k], at[k] + reach[k]);
            if !(low >= self.rim as f64 && high <= (self.window.cells[k] as usize - self.rim) as f64) {
                return None;
            }
            *r = [low.floor() as usize, high.ceil() as usize];
        }
        Some(Footprint { center: [at.x as f32, at.y as f32], shape, height: 0.0, head: 0.0, foam: 0.0, range })
    }

    /// Weighs its cells, and gives it a volume.
    fn fill(&self, mut footprint: Footprint, volume: f32, weights: &mut Vec<f32>) -> Option<Footprint> {
        if !volume.is_finite() {
            return None;
        }
        footprint.weigh(weights);
        if volume != 0.0 || self.cells.is_some() {
            let (mut sum, mut total) = (0.0f64, 0.0f64);
            let [columns, rows] = footprint.range.map(|[low, high]| low..high);
            for (j, row) in rows.zip(weights.chunks_exact(columns.len())) {
                for (i, weight) in columns.clone().zip(row) {
                    total += f64::from(*weight);
                    if self.cells.is_none_or(|cells| cells.is_open(j * cells.nx + i)) {
                        sum += f64::from(*weight);
                    }
                }
            }
            if sum < LEAST_OPEN * total {
                return None;
            }
            let [hx, hz] = self.cell();
            let height = f64::from(volume) / (hx * hz * sum);
            footprint.height = height.clamp(-f64::from(HEIGHT_LIMIT), f64::from(HEIGHT_LIMIT)) as f32;
        }
        Some(footprint)
    }
}

fn smoothstep(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Footprint {
    /// Weights of its cells, row by row.
    fn weigh(&self, weights: &mut Vec<f32>) {
        weights.clear();
        let [columns, rows] = self.range.map(|[low, high]| low..high);
        for j in rows {
            let dz = j as f32 + 0.5 - self.center[1];
            match self.shape {
                Shape::Disc { outer, stretch } => {
                    let dz = dz * stretch;
                    weights.extend(columns.clone().map(|i| {
                        let dx = i as f32 + 0.5 - self.center[0];
                        smoothstep((outer - (dx * dx + dz * dz).sqrt()) / outer)
                    }));
                }
                Shape::Box { cell, along: [cos, sin], half, soft } => {
                    let dz = dz * cell[1];
                    let share = 1.0 / (2.0 * soft);
                    let edge = |from_middle: f32, half: f32| smoothstep((half + soft - from_middle.abs()) * share);
                    weights.extend(columns.clone().map(|i| {
                        let dx = (i as f32 + 0.5 - self.center[0]) * cell[0];
                        edge(dx * cos + dz * sin, half[0]) * edge(dz * cos - dx * sin, half[1])
                    }));
                }
            }
        }
    }
}

//! The largest waves of a mode set, for queries that sum them one by one.

use std::f64::consts::TAU;
use std::ops::Range;

use glam::DVec2;

use crate::CascadeModes;

/// How the queries of an ocean are answered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Queries {
    /// From the arrays of all cascades, read by the cubic kernel: all waves, and a point costs the same however many
    /// there are.
    #[default]
    Arrays,
    /// By direct sum of so many waves, 1 to 4,096: those of the largest variance. Exact for these, and without arrays,
    /// which suits a server that asks for few points: a point costs about as much as its waves.
    Largest(u32),
}

/// A wave `amplitude cos(k.x - omega t + phase)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wave {
    /// Periods along x and z on the tile.
    pub(crate) i: i32,
    pub(crate) j: i32,
    /// Turns a loop, and 1/2^32 turns at the start.
    pub(crate) n: u32,
    pub(crate) phase: u32,
    pub(crate) amplitude: f32,
    /// Wavevector, its length, rad/m, and its direction.
    pub(crate) k: [f32; 2],
    pub(crate) length: f32,
    pub(crate) towards: [f32; 2],
    /// rad/s.
    pub(crate) omega: f32,
}

/// The largest waves of a mode set, cascade by cascade.
pub(crate) struct Largest {
    waves: Vec<Wave>,
    /// Those of each cascade.
    ranges: Vec<Range<usize>>,
}

impl Largest {
    pub(crate) fn new(modes: &[CascadeModes], loop_time: f64, count: u32) -> Self {
        let power = |c: usize, cell: usize| {
            let [re, im, ..] = modes[c].amp[cell].map(f64::from);
            re * re + im * im
        };
        let mut cells: Vec<(usize, usize)> = (modes.iter().enumerate())
            .flat_map(|(c, modes)| (0..modes.amp.len()).map(move |cell| (c, cell)))
            .filter(|&(c, cell)| power(c, cell) > 0.0)
            .collect();
        // Waves of equal power are told apart by their place, so that the choice is the same everywhere.
        let larger =
            |a: &(usize, usize), b: &(usize, usize)| power(b.0, b.1).total_cmp(&power(a.0, a.1)).then(a.cmp(b));
        let count = count as usize;
        if count < cells.len() {
            cells.select_nth_unstable_by(count, larger);
            cells.truncate(count);
        }
        cells.sort_unstable();
        let waves: Vec<Wave> = cells.iter().map(|&(c, cell)| Wave::of(&modes[c], cell, loop_time)).collect();
        let below = |c: usize| cells.partition_point(|cell| cell.0 < c);
        Self { waves, ranges: (0..modes.len()).map(|c| below(c)..below(c + 1)).collect() }
    }

    /// Those of a cascade.
    pub(crate) fn of(&self, c: usize) -> &[Wave] {
        &self.waves[self.ranges[c].clone()]
    }
}

impl Wave {
    fn of(modes: &CascadeModes, cell: usize, loop_time: f64) -> Self {
        let size = modes.size as usize;
        let (i, j) = (modes.signed((cell % size) as u32), modes.signed((cell / size) as u32));
        let k = DVec2::new(f64::from(i), f64::from(j)) * modes.step();
        let [re, im, ..] = modes.amp[cell].map(f64::from);
        let turns = libm::atan2(im, re) / TAU;
        Self {
            i,
            j,
            n: modes.n[cell],
            phase: libm::round(turns * 4_294_967_296.0) as i64 as u32,
            // The cells of k and -k hold half of the wave each.
            amplitude: (2.0 * (re * re + im * im).sqrt()) as f32,
            k: k.as_vec2().to_array(),
            length: k.length() as f32,
            towards: (k / k.length()).as_vec2().to_array(),
            omega: (TAU * f64::from(modes.n[cell]) / loop_time) as f32,
        }
    }
}

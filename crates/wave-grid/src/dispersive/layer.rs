//! The absorbing layer of the dispersive scheme: a convolutional perfectly matched layer (Roden & Gedney 2000) on the Laplacian of
//! every field, its memory in the frame only.
//!
//! In the layer a jump across a face is taken with psi' = b psi + c (jump) added to it, and the difference of two
//! fluxes with zeta' = b zeta + c (difference); b = exp(-(sigma + alpha)), c = (b - 1) sigma / (sigma + alpha),
//! sigma = s0 d^3 and alpha = a0 (1 - d) at depth d (0 to 1) into the layer, per sub-step.
//!
//! A window that outruns its waves has them cross its rear side forwards, where the layer would make them grow. So a side
//! is switched off as the window moves away from it. Its outermost cells, zero elsewhere, then keep what the window leaves
//! there: of a wake that is steady seen from the window, the right values.

use std::ops::Range;

use super::FIELDS;

/// sigma at the outer edge over sqrt(g / h): 48 / s where cells are 0.5 m.
pub(crate) const STRENGTH: f64 = 10.84;
/// alpha where the layer begins, likewise: 1 / s.
pub(crate) const SHIFT: f64 = 0.226;
/// Speeds of the window away from a side, over sqrt(g h), where that begins to be switched off and where it is off: 1 and 2 m/s where
/// cells are 0.5 m.
const OFF: [f64; 2] = [0.45, 0.9];
/// How fast a side comes back, times sqrt(h / g): in 8 s where cells are 0.5 m. What is within the layer by then would be reflected
/// (-33 dB of a boat that stops, at once, and -47 so).
const RETURN: f64 = 0.027;
/// Fields that the layer has a memory for: the potential and the screened ones.
pub(crate) const MEMORIES: usize = FIELDS + 1;

/// Factors (b, c) along an axis: at nodes, and on the edge before each node.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) node: [Vec<f32>; 2],
    pub(crate) edge: [Vec<f32>; 2],
}

/// Layer and memory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layer {
    pub(crate) axes: [Axis; 2],
    pub(crate) memory: Memory,
    cells: [usize; 2],
    width: usize,
    g: f64,
    pub(crate) sides: Sides,
}

impl Layer {
    pub(crate) fn new(cells: [usize; 2], width: usize, g: f64) -> Self {
        let sides = Sides::default();
        let mut axes = [0, 1].map(|k| Axis::new(cells[k]));
        axes.iter_mut().zip(sides.open).for_each(|(axis, open)| axis.set(width, g, open));
        Self { axes, memory: Memory::new(cells, width), cells, width, g, sides }
    }

    /// The window moves with `velocity`, in cells per sub-step over sqrt(G), for `time`, in sub-steps times sqrt(G).
    pub(crate) fn move_with(&mut self, velocity: [f64; 2], time: f64) {
        let changed = self.sides.move_with(velocity, time);
        for k in (0..2).filter(|k| changed[*k]) {
            self.axes[k].set(self.width, self.g, self.sides.open[k]);
        }
    }

    /// Goes back to these sides, with what [`Memory::numbers`] told.
    pub(crate) fn restore(&mut self, sides: Sides, mut numbers: &[f32]) {
        for k in (0..2).filter(|k| sides.open[*k] != self.sides.open[*k]) {
            self.axes[k].set(self.width, self.g, sides.open[k]);
        }
        self.sides = sides;
        for (_, array) in self.memory.arrays() {
            let (own, rest) = numbers.split_at(array.len());
            array.copy_from_slice(own);
            numbers = rest;
        }
    }
}

/// Share of its strength that each side has, low and high along x and along z.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Sides {
    pub(crate) open: [[f64; 2]; 2],
}

impl Default for Sides {
    fn default() -> Self {
        Self { open: [[1.0; 2]; 2] }
    }
}

impl Sides {
    /// As [`Layer::move_with`]; which axes have changed.
    pub(crate) fn move_with(&mut self, velocity: [f64; 2], time: f64) -> [bool; 2] {
        std::array::from_fn(|k| {
            let strength = |away: f64| ((OFF[1] - away) / (OFF[1] - OFF[0])).clamp(0.0, 1.0);
            // Away from the low side is towards high coordinates.
            let wanted = [strength(velocity[k]), strength(-velocity[k])];
            let open = std::array::from_fn(|side| wanted[side].min(self.open[k][side] + RETURN * time));
            let changed = open != self.open[k];
            if changed {
                self.open[k] = open;
            }
            changed
        })
    }

    pub(crate) fn is_sane(&self) -> bool {
        self.open.as_flattened().iter().all(|open| (0.0..=1.0).contains(open))
    }

    /// Which are off.
    pub(crate) fn off(&self) -> [[bool; 2]; 2] {
        self.open.map(|sides| sides.map(|open| open == 0.0))
    }
}

impl Axis {
    /// An axis of `n` cells, without a layer yet.
    fn new(n: usize) -> Self {
        let zeros = || [0, 1].map(|_| vec![0.0; n + 1]);
        Self { node: zeros(), edge: zeros() }
    }

    /// Takes the factors of sides that are so open. The outermost cells are zero and take no part.
    fn set(&mut self, width: usize, g: f64, [low, high]: [f64; 2]) {
        let (w, last) = (width as f64, self.node[0].len() as f64 - 2.0);
        let factors = |x: f64| {
            let (from_low, from_high) = ((w - 0.5 - x) / w, (x - (last - w + 0.5)) / w);
            let (depth, open) = if from_low > from_high { (from_low, low) } else { (from_high, high) };
            if depth <= 0.0 || open <= 0.0 {
                return [0.0; 2];
            }
            let depth = depth.min(1.0);
            let sigma = STRENGTH * g.sqrt() * open * depth * depth * depth;
            let alpha = SHIFT * g.sqrt() * (1.0 - depth);
            let b = libm::exp(-(sigma + alpha));
            [b, sigma / (sigma + alpha) * (b - 1.0)]
        };
        for (table, at) in [(&mut self.node, 0.0), (&mut self.edge, -0.5)] {
            let [b, c] = table;
            for (i, (b, c)) in b.iter_mut().zip(c).enumerate() {
                [*b, *c] = factors(i as f64 + at).map(|factor| factor as f32);
            }
        }
    }
}

/// Where cell `i` of an axis has its entry in [`Memory`], if it is near a side.
#[inline(always)]
fn slot(cells: usize, reach: usize, span: usize, i: usize) -> Option<usize> {
    let high = cells - reach;
    match i {
        i if i <= reach => Some(i),
        i if i >= high => Some(span + i - high),
        _ => None,
    }
}

/// psi and zeta of both axes, of the cells within reach of the window's edges.
///
/// Along x each row has the `2 * span` entries of [`slot`]; along z as many rows have an entry per column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Memory {
    pub(crate) cells: [usize; 2],
    /// Cells from a side that the layer's loops take: whole vectors behind the outermost cell.
    pub(crate) reach: usize,
    /// Entries at each side.
    pub(crate) span: usize,
    /// Per axis and field.
    pub(crate) psi: [[Vec<f32>; MEMORIES]; 2],
    pub(crate) zeta: [[Vec<f32>; MEMORIES]; 2],
}

impl Memory {
    fn new(cells: [usize; 2], width: usize) -> Self {
        let reach = 1 + width.next_multiple_of(8);
        let span = reach + 1;
        let zero = |axis: usize| std::array::from_fn(|_| vec![0.0; 2 * span * cells[1 - axis]]);
        Self { cells, reach, span, psi: [zero(0), zero(1)], zeta: [zero(0), zero(1)] }
    }

    fn arrays(&mut self) -> impl Iterator<Item = (usize, &mut Vec<f32>)> {
        let Self { psi, zeta, .. } = self;
        psi.iter_mut()
            .zip(zeta)
            .enumerate()
            .flat_map(|(axis, (psi, zeta))| psi.iter_mut().chain(zeta).map(move |array| (axis, array)))
    }

    /// All that it holds.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &[f32]> {
        let Self { psi, zeta, .. } = self;
        psi.iter().zip(zeta).flat_map(|(psi, zeta)| psi.iter().chain(zeta).map(Vec::as_slice))
    }

    pub(crate) fn clear(&mut self) {
        self.arrays().for_each(|(_, array)| array.fill(0.0));
    }

    /// Zeroes what belongs to a rectangle of cells.
    pub(crate) fn clear_cells(&mut self, x: &Range<usize>, z: &Range<usize>) {
        let (cells, reach, span) = (self.cells, self.reach, self.span);
        let slots =
            |axis: usize, range: &Range<usize>| range.clone().filter_map(move |i| slot(cells[axis], reach, span, i));
        let (nx, row) = (cells[0], 2 * span);
        for (axis, array) in self.arrays() {
            if axis == 0 {
                for j in z.clone() {
                    slots(0, x).for_each(|k| array[j * row + k] = 0.0);
                }
            } else {
                slots(1, z).for_each(|k| array[k * nx + x.start..k * nx + x.end].fill(0.0));
            }
        }
    }

    /// Moves with the fields; what enters is calm.
    pub(crate) fn shift(&mut self, [x, z]: [i64; 2]) {
        let ([nx, nz], span) = (self.cells, self.span);
        for (axis, array) in self.arrays() {
            let (across, width) = if axis == 0 { (nz, 2 * span) } else { (2 * span, nx) };
            // Along the short side each half moves on its own.
            let halves: [[Range<usize>; 2]; 2] = if axis == 0 {
                [[0..span, 0..across], [span..2 * span, 0..across]]
            } else {
                [[0..nx, 0..span], [0..nx, span..2 * span]]
            };
            for [columns, rows] in halves {
                shift_block(array, width, &columns, &rows, [x, z]);
            }
            // Nothing is written at the window's outermost cells: left there, it would come back.
            if axis == 0 {
                array[..width].fill(0.0);
                array[(nz - 1) * width..].fill(0.0);
                array.chunks_exact_mut(width).for_each(|row| row[0] = 0.0);
            } else {
                array[..nx].fill(0.0);
                for row in array.chunks_exact_mut(width) {
                    (row[0], row[nx - 1]) = (0.0, 0.0);
                }
            }
        }
        // Nor in zeta behind the layer's loops and at the last cell, and in either after it.
        let Self { psi, zeta, .. } = self;
        let zeroed = [(psi, &[2 * span - 1][..]), (zeta, &[span - 1, 2 * span - 2, 2 * span - 1])];
        for ([along, across], entries) in zeroed {
            for entry in entries {
                along.iter_mut().flat_map(|array| array.chunks_exact_mut(2 * span)).for_each(|row| row[*entry] = 0.0);
                across.iter_mut().for_each(|array| array[entry * nx..(entry + 1) * nx].fill(0.0));
            }
        }
    }

    /// All that a moment is made of.
    pub(crate) fn values(&self) -> impl Iterator<Item = &f32> {
        self.psi.iter().flatten().chain(self.zeta.iter().flatten()).flatten()
    }
}

/// Entry (i, j) of a block takes what (i + x, j + z) held, if that is within it.
fn shift_block(array: &mut [f32], width: usize, columns: &Range<usize>, rows: &Range<usize>, [x, z]: [i64; 2]) {
    let n = columns.len();
    let by = x.unsigned_abs() as usize;
    let move_row = |array: &mut [f32], to: usize, from: usize| {
        let (to, from) = (to * width + columns.start, from * width + columns.start);
        if by >= n {
            array[to..to + n].fill(0.0);
        } else if x >= 0 {
            array.copy_within(from + by..from + n, to);
            array[to + n - by..to + n].fill(0.0);
        } else {
            array.copy_within(from..from + n - by, to + by);
            array[to..to + by].fill(0.0);
        }
    };
    let count = rows.len();
    for step in 0..count {
        // The order in which nothing is overwritten before it is read.
        let j = if z >= 0 { step } else { count - 1 - step };
        let from = j as i64 + z;
        if (0..count as i64).contains(&from) {
            move_row(array, rows.start + j, rows.start + from as usize);
        } else {
            let to = (rows.start + j) * width + columns.start;
            array[to..to + n].fill(0.0);
        }
    }
}

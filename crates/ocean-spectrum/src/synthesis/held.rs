//! The modes of a cascade as synthesis reads them: without empty rows and columns, columns side by side in lanes.

use std::f32::consts::TAU;

use fearless_simd::{Simd, prelude::*};

use crate::CascadeModes;
use crate::synthesis::fft::Band;
use crate::synthesis::lanes::{Aligned, Complex, cos_sin, f32s};

/// Floats that a lane of a cell has.
const PARTS: usize = 6;

/// Modes in blocks of as many columns as there are lanes; a block's cells lie row by row. The last block is padded
/// with modes of amplitude 0.
pub(crate) struct Held {
    pub(crate) size: usize,
    pub(crate) lanes: usize,
    /// FFT indices of the columns held, and of the rows: `0..half` and `size - (half - 1)..size`.
    pub(crate) indices: Vec<usize>,
    pub(crate) half: usize,
    /// Wavenumber of each column, rad/m, padded to whole blocks.
    kx: Aligned<f32>,
    /// Wavenumber of each row, rad/m.
    kz: Vec<f32>,
    /// Of each cell: amplitudes (4), 1/k and omega, each of all lanes.
    cells: Aligned<f32>,
    n: Aligned<u32>,
}

/// A block of columns.
#[derive(Clone, Copy)]
pub(crate) struct Block<'a> {
    kx: &'a [f32],
    kz: &'a [f32],
    cells: &'a [f32],
    n: &'a [u32],
}

/// The constants of a cell.
#[derive(Clone, Copy)]
pub(crate) struct Cell<S: Simd> {
    amp: [S::f32s; 4],
    n: S::u32s,
    pub(crate) kx: S::f32s,
    pub(crate) kz: S::f32s,
    pub(crate) inverse_k: S::f32s,
    omega: S::f32s,
}

/// A cell at a time.
#[derive(Clone, Copy)]
pub(crate) struct State<S: Simd> {
    pub(crate) height: Complex<S>,
    /// Its rate.
    pub(crate) velocity: Complex<S>,
    /// The rate of that.
    pub(crate) acceleration: Complex<S>,
}

impl Held {
    pub(crate) fn new(modes: &CascadeModes, loop_time: f64, lanes: usize) -> Self {
        let size = modes.size as usize;
        // By the band alone, so that all seas on these cascades hold the same cells. A mode at +k comes with one at
        // -k, so one half-width serves both directions and both axes.
        let half = size / 2;
        let half = half.min((modes.band[1] / modes.step() + 0.71).min(size as f64) as usize + 1);
        let indices: Vec<usize> = (0..half).chain(size - (half - 1)..size).collect();
        let wavenumber = |index: usize| f64::from(modes.signed(index as u32)) * modes.step();
        let (width, blocks) = (indices.len(), indices.len().div_ceil(lanes));
        let mut held = Self {
            size,
            lanes,
            half,
            kx: Aligned::new(blocks * lanes),
            kz: indices.iter().map(|&row| wavenumber(row) as f32).collect(),
            cells: Aligned::new(blocks * width * PARTS * lanes),
            n: Aligned::new(blocks * width * lanes),
            indices,
        };
        for (c, &column) in held.indices.iter().enumerate() {
            held.kx[c] = wavenumber(column) as f32;
            for (r, &row) in held.indices.iter().enumerate() {
                let at = row * size + column;
                let k = (wavenumber(row).powi(2) + wavenumber(column).powi(2)).sqrt();
                let inverse_k = if k > 0.0 { (1.0 / k) as f32 } else { 0.0 };
                let omega = (f64::from(modes.n[at]) / loop_time) as f32 * TAU;
                let cell = c / lanes * width + r;
                let [a, b, c4, d] = modes.amp[at];
                for (part, value) in [a, b, c4, d, inverse_k, omega].into_iter().enumerate() {
                    held.cells[(cell * PARTS + part) * lanes + c % lanes] = value;
                }
                held.n[cell * lanes + c % lanes] = modes.n[at];
            }
        }
        held
    }

    pub(crate) fn band(&self) -> Band {
        Band { half: self.half }
    }

    pub(crate) fn blocks(&self) -> usize {
        self.kx.len() / self.lanes
    }

    pub(crate) fn block(&self, index: usize) -> Block<'_> {
        let (lanes, cells) = (self.lanes, self.kz.len() * self.lanes);
        Block {
            kx: &self.kx[index * lanes..][..lanes],
            kz: &self.kz,
            cells: &self.cells[index * cells * PARTS..][..cells * PARTS],
            n: &self.n[index * cells..][..cells],
        }
    }
}

impl Block<'_> {
    /// The cell of the row held as number `row`.
    #[inline(always)]
    pub(crate) fn cell<S: Simd>(self, simd: S, row: usize) -> Cell<S> {
        let lanes = S::f32s::LEN;
        let parts = &self.cells[row * PARTS * lanes..][..PARTS * lanes];
        Cell {
            amp: [part(simd, parts, 0), part(simd, parts, 1), part(simd, parts, 2), part(simd, parts, 3)],
            n: S::u32s::from_slice(simd, &self.n[row * lanes..][..lanes]),
            kx: S::f32s::from_slice(simd, self.kx),
            kz: f32s(simd, self.kz[row]),
            inverse_k: part(simd, parts, 4),
            omega: part(simd, parts, 5),
        }
    }
}

#[inline(always)]
fn part<S: Simd>(simd: S, parts: &[f32], index: usize) -> S::f32s {
    S::f32s::from_slice(simd, &parts[index * S::f32s::LEN..][..S::f32s::LEN])
}

impl<S: Simd> Cell<S> {
    /// The cell at a phase of the loop. What is not read of it costs nothing.
    #[inline(always)]
    pub(crate) fn at(&self, simd: S, phase: u32) -> State<S> {
        let [a, b, c, d] = self.amp;
        let Complex { re: cos, im: sin } = cos_sin(simd, self.n * S::u32s::splat(simd, phase));
        // h0(k) e^(-i omega t) and conj(h0(-k)) e^(i omega t)
        let there = Complex { re: a * cos + b * sin, im: b * cos - a * sin };
        let back = Complex { re: c * cos - d * sin, im: d * cos + c * sin };
        let height = there.add(back);
        // -i omega (there - back)
        let difference = Complex::<S> { re: there.im - back.im, im: back.re - there.re };
        let negative = -(self.omega * self.omega);
        State { height, velocity: difference.scaled(self.omega), acceleration: height.scaled(negative) }
    }
}

impl<S: Simd> State<S> {
    #[inline(always)]
    pub(crate) fn sum(self, other: Self, [a, b]: [S::f32s; 2]) -> Self {
        Self {
            height: self.height.scaled(a).add(other.height.scaled(b)),
            velocity: self.velocity.scaled(a).add(other.velocity.scaled(b)),
            acceleration: self.acceleration.scaled(a).add(other.acceleration.scaled(b)),
        }
    }
}

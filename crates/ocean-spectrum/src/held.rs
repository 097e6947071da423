//! The modes of a cascade as synthesis reads them: without empty rows and columns, rows side by side in lanes.

use std::f32::consts::TAU;

use rayon::prelude::*;

use crate::fft::{LANES, Lanes};
use open_water_shaders::turns;

use crate::CascadeModes;

/// Modes in blocks of [`LANES`] rows: value `[lane]` of cell `block * width + column`. The last block is padded with
/// modes of amplitude 0.
pub(crate) struct Held {
    pub(crate) size: usize,
    /// FFT indices of the rows held, and of the columns: `0..half` and `size - (half - 1)..size`.
    pub(crate) rows: Vec<usize>,
    pub(crate) half: usize,
    /// Wavenumber of each column, rad/m.
    kx: Vec<f32>,
    /// Wavenumber of the rows of each block, rad/m.
    kz: Vec<Lanes>,
    cells: Vec<Cell>,
}

/// The constants of a cell.
#[derive(Clone, Copy, Default)]
pub(crate) struct Cell {
    amp: [Lanes; 4],
    n: [u32; LANES],
    pub(crate) inverse_k: Lanes,
    pub(crate) omega: Lanes,
}

/// A cell at the time propagated to.
#[derive(Clone, Copy, Default)]
pub(crate) struct State {
    /// Height, real and imaginary part.
    pub(crate) h: [Lanes; 2],
    /// Its rate.
    pub(crate) v: [Lanes; 2],
    /// The rate of that.
    pub(crate) a: [Lanes; 2],
}

/// One block of rows, for packing.
pub(crate) struct Block<'a> {
    pub(crate) kz: Lanes,
    pub(crate) kx: &'a [f32],
    pub(crate) cells: &'a [Cell],
    pub(crate) now: &'a [State],
}

impl Held {
    pub(crate) fn new(modes: &CascadeModes, loop_time: f64) -> Self {
        let size = modes.size as usize;
        // A mode at +k comes with one at -k, so one half-width serves both directions and both axes.
        let half = (0..size * size)
            .filter(|&cell| modes.n[cell] != 0)
            .map(|cell| modes.signed((cell % size) as u32).max(modes.signed((cell / size) as u32)))
            .max()
            .map_or(1, |i| i.max(0) as usize + 1);
        let rows: Vec<usize> = (0..half).chain(size - (half - 1)..size).collect();
        let wavenumber = |index: usize| f64::from(modes.signed(index as u32)) * modes.step();
        let blocks = rows.len().div_ceil(LANES);
        let width = rows.len();
        let mut cells = vec![Cell::default(); blocks * width];
        let mut kz = vec![[0.0; LANES]; blocks];
        for (r, &row) in rows.iter().enumerate() {
            let (block, lane) = (r / LANES, r % LANES);
            kz[block][lane] = wavenumber(row) as f32;
            for (c, &column) in rows.iter().enumerate() {
                let at = row * size + column;
                let cell = &mut cells[block * width + c];
                for (part, amp) in cell.amp.iter_mut().zip(modes.amp[at]) {
                    part[lane] = amp;
                }
                cell.n[lane] = modes.n[at];
                cell.omega[lane] = (f64::from(modes.n[at]) / loop_time) as f32 * TAU;
                let k = (wavenumber(row).powi(2) + wavenumber(column).powi(2)).sqrt();
                cell.inverse_k[lane] = if k > 0.0 { (1.0 / k) as f32 } else { 0.0 };
            }
        }
        let kx = rows.iter().map(|&column| wavenumber(column) as f32).collect();
        Self { size, rows, half, kx, kz, cells }
    }

    /// Room for the states of all modes.
    pub(crate) fn states(&self) -> Vec<State> {
        vec![State::default(); self.cells.len()]
    }

    /// Brings every mode to a phase of the loop.
    pub(crate) fn propagate(&self, now: &mut [State], phase: u32) {
        now.par_iter_mut().zip(&self.cells).with_min_len(2048).for_each(|(now, cell)| *now = cell.at(phase));
    }

    /// The sum of two sets of modes, each at its own phase.
    pub(crate) fn propagate_both(&self, other: &Self, now: &mut [State], phase: [u32; 2], weight: [f32; 2]) {
        let cells = now.par_iter_mut().zip(&self.cells).zip(&other.cells).with_min_len(2048);
        cells.for_each(|((now, a), b)| *now = State::sum(&a.at(phase[0]), &b.at(phase[1]), weight));
    }

    pub(crate) fn blocks<'a>(&'a self, now: &'a [State]) -> impl Iterator<Item = Block<'a>> {
        let width = self.kx.len();
        let blocks = self.kz.iter().zip(self.cells.chunks_exact(width)).zip(now.chunks_exact(width));
        blocks.map(|((&kz, cells), now)| Block { kz, kx: &self.kx, cells, now })
    }
}

impl Cell {
    #[inline(always)]
    fn at(&self, phase: u32) -> State {
        let [a, b, c, d] = &self.amp;
        let mut now = State::default();
        for l in 0..LANES {
            let [cos, sin] = turns::cos_sin(self.n[l].wrapping_mul(phase));
            // h0(k) e^(-i omega t) and conj(h0(-k)) e^(i omega t)
            let (p_re, p_im) = (a[l] * cos + b[l] * sin, b[l] * cos - a[l] * sin);
            let (m_re, m_im) = (c[l] * cos - d[l] * sin, d[l] * cos + c[l] * sin);
            now.h[0][l] = p_re + m_re;
            now.h[1][l] = p_im + m_im;
            let omega = self.omega[l];
            now.v[0][l] = omega * (p_im - m_im);
            now.v[1][l] = omega * (m_re - p_re);
            now.a[0][l] = -omega * omega * now.h[0][l];
            now.a[1][l] = -omega * omega * now.h[1][l];
        }
        now
    }
}

impl State {
    #[inline(always)]
    fn sum(a: &Self, b: &Self, weight: [f32; 2]) -> Self {
        let mix = |a: &[Lanes; 2], b: &[Lanes; 2]| {
            [0, 1].map(|part| std::array::from_fn(|l| weight[0] * a[part][l] + weight[1] * b[part][l]))
        };
        Self { h: mix(&a.h, &b.h), v: mix(&a.v, &b.v), a: mix(&a.a, &b.a) }
    }
}

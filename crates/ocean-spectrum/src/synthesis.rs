//! From modes to arrays: propagation, packing of two real fields into one complex transform, and the FFT.
//!
//! Only the rows and columns that hold modes are propagated and transformed along x; a band-limited cascade has few.

use std::f32::consts::TAU;
use std::sync::Arc;

use rayon::prelude::*;
use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner, FftPlannerScalar};

use crate::pack::{Pack, Row};
use crate::{CascadeModes, OceanDesc, Repro, turns};

/// Columns transformed together: their elements share cache lines.
const COLUMNS: usize = 8;

/// The arrays of one cascade and what makes them.
pub(crate) struct Synthesis {
    modes: Held,
    outputs: [Output; 3],
}

/// The modes without the empty rows and columns, one array per component so that loops vectorise.
struct Held {
    size: usize,
    /// FFT indices of the rows held.
    rows: Vec<usize>,
    /// Columns `0..half` and `size - (half - 1)..size` are held.
    half: usize,
    /// Wavenumbers of the columns held and of the rows held, rad/m.
    kx: Vec<f32>,
    kz: Vec<f32>,
    amp: [Vec<f32>; 4],
    n: Vec<u32>,
    inverse_k: Vec<f32>,
    omega: Vec<f32>,
    /// Height and its rate, real and imaginary parts.
    now: [Vec<f32>; 4],
}

/// One array of four fields: two complex transforms.
struct Output {
    pack: Pack,
    rows: Vec<Complex32>,
    columns: [Vec<Complex32>; 2],
    scratch: Vec<Complex32>,
    fft: Arc<dyn Fft<f32>>,
    texels: Vec<[f32; 4]>,
}

impl Synthesis {
    pub(crate) fn all(modes: &[CascadeModes], desc: &OceanDesc) -> Vec<Self> {
        let mut scalar = FftPlannerScalar::new();
        let mut native = FftPlanner::new();
        let mut plan = |size: usize| match desc.repro {
            Repro::Exact => scalar.plan_fft_inverse(size),
            Repro::Fast => native.plan_fft_inverse(size),
        };
        modes.iter().map(|m| Self::new(m, desc, plan(m.size as usize))).collect()
    }

    fn new(modes: &CascadeModes, desc: &OceanDesc, fft: Arc<dyn Fft<f32>>) -> Self {
        let held = Held::new(modes, desc.loop_time);
        let outputs = Pack::all(modes, desc).map(|pack| Output::new(pack, &held, fft.clone()));
        Self { modes: held, outputs }
    }

    /// Computes all arrays at a phase of the loop. Every value is computed by one thread in one order, so the bits do
    /// not depend on the number of threads.
    pub(crate) fn run(&mut self, phase: u32) {
        self.modes.propagate(phase);
        let held = &self.modes;
        self.outputs.par_iter_mut().for_each(|output| output.run(held));
    }

    pub(crate) fn displacement(&self) -> &[[f32; 4]] {
        &self.outputs[0].texels
    }

    pub(crate) fn derivative(&self) -> &[[f32; 4]] {
        &self.outputs[1].texels
    }

    pub(crate) fn velocity(&self) -> &[[f32; 4]] {
        &self.outputs[2].texels
    }
}

impl Held {
    fn new(modes: &CascadeModes, loop_time: f64) -> Self {
        let size = modes.size as usize;
        // A mode at +k comes with one at -k, so one half-width serves both directions and both axes.
        let half = (0..size * size)
            .filter(|&cell| modes.n[cell] != 0)
            .map(|cell| modes.signed((cell % size) as u32).max(modes.signed((cell / size) as u32)))
            .max()
            .map_or(1, |i| i.max(0) as usize + 1);
        let indices: Vec<usize> = (0..half).chain(size - (half - 1)..size).collect();
        let wavenumber = |&index: &usize| (f64::from(modes.signed(index as u32)) * modes.step()) as f32;
        let k: Vec<f32> = indices.iter().map(wavenumber).collect();
        let cells: Vec<usize> = indices.iter().flat_map(|row| indices.iter().map(move |c| row * size + c)).collect();
        let width = indices.len();
        let inverse_k = (0..cells.len())
            .map(|at| {
                let (kx, kz) = (f64::from(k[at % width]), f64::from(k[at / width]));
                let k = (kx * kx + kz * kz).sqrt();
                if k > 0.0 { (1.0 / k) as f32 } else { 0.0 }
            })
            .collect();
        let omega = |&cell: &usize| (f64::from(modes.n[cell]) / loop_time) as f32 * TAU;
        Self {
            size,
            rows: indices,
            half,
            kx: k.clone(),
            kz: k,
            amp: [0, 1, 2, 3].map(|part| cells.iter().map(|&cell| modes.amp[cell][part]).collect()),
            n: cells.iter().map(|&cell| modes.n[cell]).collect(),
            inverse_k,
            omega: cells.iter().map(omega).collect(),
            now: [(); 4].map(|()| vec![0.0; cells.len()]),
        }
    }

    fn propagate(&mut self, phase: u32) {
        let width = self.kx.len();
        let [a, b, c, d] = &self.amp;
        let [h_re, h_im, v_re, v_im] = &mut self.now;
        let state = (h_re.par_chunks_mut(width), h_im.par_chunks_mut(width));
        let rate = (v_re.par_chunks_mut(width), v_im.par_chunks_mut(width));
        let rows = state.0.zip(state.1).zip(rate.0.zip(rate.1)).enumerate().with_min_len(32);
        rows.for_each(|(row, ((h_re, h_im), (v_re, v_im)))| {
            let held = row * width..(row + 1) * width;
            let (a, b, c, d) = (&a[held.clone()], &b[held.clone()], &c[held.clone()], &d[held.clone()]);
            let (n, omega) = (&self.n[held.clone()], &self.omega[held]);
            for i in 0..width {
                let (sin, cos) = turns::sincos(n[i].wrapping_mul(phase));
                // h0(k) e^(-i omega t) and conj(h0(-k)) e^(i omega t)
                let (p_re, p_im) = (a[i] * cos + b[i] * sin, b[i] * cos - a[i] * sin);
                let (m_re, m_im) = (c[i] * cos - d[i] * sin, d[i] * cos + c[i] * sin);
                h_re[i] = p_re + m_re;
                h_im[i] = p_im + m_im;
                v_re[i] = omega[i] * (p_im - m_im);
                v_im[i] = omega[i] * (m_re - p_re);
            }
        });
    }

    fn row(&self, row: usize) -> Row<'_> {
        let width = self.kx.len();
        let held = row * width..(row + 1) * width;
        let [h_re, h_im, v_re, v_im] = &self.now;
        Row {
            kz: self.kz[row],
            kx: &self.kx,
            inverse_k: &self.inverse_k[held.clone()],
            omega: &self.omega[held.clone()],
            h: [&h_re[held.clone()], &h_im[held.clone()]],
            v: [&v_re[held.clone()], &v_im[held]],
        }
    }
}

impl Output {
    fn new(pack: Pack, held: &Held, fft: Arc<dyn Fft<f32>>) -> Self {
        let size = held.size;
        let zero = Complex32::new(0.0, 0.0);
        Self {
            pack,
            rows: vec![zero; 2 * held.rows.len() * size],
            columns: [(); 2].map(|()| vec![zero; COLUMNS * size]),
            scratch: vec![zero; fft.get_inplace_scratch_len()],
            fft,
            texels: vec![[0.0; 4]; size * size],
        }
    }

    fn run(&mut self, held: &Held) {
        let size = held.size;
        let plane = held.rows.len() * size;
        let (first, second) = self.rows.split_at_mut(plane);
        for (row, (first, second)) in first.chunks_exact_mut(size).zip(second.chunks_exact_mut(size)).enumerate() {
            // The row as packed has no gap; the columns of negative wavenumbers move to its end.
            let width = held.kx.len();
            self.pack.fill(&held.row(row), &mut first[..width], &mut second[..width]);
            for line in [first, second] {
                let zero = Complex32::new(0.0, 0.0);
                line[width..].fill(zero);
                let (low, high) = (held.half, size - (held.half - 1));
                line.copy_within(low..width, high);
                line[low..high].fill(zero);
                self.fft.process_with_scratch(line, &mut self.scratch);
            }
        }
        let unscale = self.pack.unscale();
        for x in (0..size).step_by(COLUMNS) {
            for (plane, columns) in self.rows.chunks_exact(plane).zip(&mut self.columns) {
                columns.fill(Complex32::new(0.0, 0.0));
                for (line, &z) in plane.chunks_exact(size).zip(&held.rows) {
                    for (c, value) in line[x..x + COLUMNS].iter().enumerate() {
                        columns[c * size + z] = *value;
                    }
                }
                self.fft.process_with_scratch(columns, &mut self.scratch);
            }
            let [first, second] = &self.columns;
            for (z, line) in self.texels.chunks_exact_mut(size).enumerate() {
                for (c, texel) in line[x..x + COLUMNS].iter_mut().enumerate() {
                    let (p, q) = (first[c * size + z], second[c * size + z]);
                    *texel = [p.re, p.im, q.re, q.im * unscale];
                }
            }
        }
    }
}

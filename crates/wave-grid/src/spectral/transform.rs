//! Two real fields to their spectra and back, one complex transform each way: `Z = F(eta + i P)` is split by
//! `eta(-k) = conj eta(k)`, every wavenumber is stepped, and the inverse brings both fields.
//!
//! Rows are transformed as they are packed. Then columns, each with its mirror image, are gathered a few at a time, transformed,
//! stepped and transformed back while they are in the cache, and left in their own order; rows are gathered
//! from there and transformed back. What is read and written is contiguous by whole cache lines, and every array of a
//! task is its own: any number of threads gives the same bits.

use std::fmt;
use std::sync::Arc;

use rayon::prelude::*;
use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};

use super::mode::{Law, Mode};
use super::wavenumber;

/// Columns, and as many mirrored ones, or rows of a task.
const LOT: usize = 16;
/// Lengths are padded by this: powers of two between rows would fall on the same few lines of the cache.
const PAD: usize = 8;
/// Cells from which threads pay.
const PARALLEL: usize = 96 * 96;

/// Transforms of one length, forth and back.
#[derive(Clone)]
struct Plan {
    length: usize,
    ways: [Arc<dyn Fft<f32>>; 2],
}

impl fmt::Debug for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Plan").field("length", &self.length).finish()
    }
}

impl Plan {
    fn new(planner: &mut FftPlanner<f32>, length: usize) -> Self {
        Self { length, ways: [planner.plan_fft_forward(length), planner.plan_fft_inverse(length)] }
    }

    fn run(&self, way: usize, line: &mut [Complex32], scratch: &mut Vec<Complex32>) {
        let fft = &self.ways[way];
        if scratch.len() < fft.get_inplace_scratch_len() {
            scratch.resize(fft.get_inplace_scratch_len(), Complex32::default());
        }
        fft.process_with_scratch(line, scratch);
    }
}

/// What a thread keeps from task to task.
#[derive(Default)]
struct Bench {
    rows: Vec<Complex32>,
    scratch: Vec<Complex32>,
}

/// Where a transform's fields lie within larger arrays, and what they are multiplied with when they return.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    /// Cells of a row of the arrays.
    pub(crate) width: usize,
    /// First column and row.
    pub(crate) first: usize,
    /// Factors along x and z.
    pub(crate) mask: [Vec<f32>; 2],
}

/// Steps `eta` and `P` of `size[0] * size[1]` cells that repeat.
#[derive(Debug, Clone)]
pub(crate) struct Propagator {
    size: [usize; 2],
    plans: [Plan; 2],
    /// Column by column, up to half the size along both axes.
    modes: Vec<Mode>,
    /// Columns of `columns`: those that are their own mirror images, then lots with their mirror images.
    order: Vec<usize>,
    /// Rows after the first transforms.
    rows: Vec<Complex32>,
    columns: Vec<Complex32>,
    /// What the transforms multiply by, undone: the part that is not in `modes`.
    scale: f32,
}

/// A float that, times each of two others close to one, is nearly as precisely one of two numbers: a factor rounded once would
/// take or give up to 1e-7 of all energy in each step.
fn split(numbers: [f64; 2]) -> (f32, [f32; 2]) {
    let candidate = |i: u32| {
        let scale = (numbers[0] * (1.0 - f64::from(f32::EPSILON) * f64::from(i))) as f32;
        (scale, numbers.map(|number| (number / f64::from(scale)) as f32))
    };
    let miss = |(scale, near): (f32, [f32; 2])| {
        let miss = [0, 1].map(|k| (f64::from(scale) * f64::from(near[k]) / numbers[k] - 1.0).abs());
        miss[0].max(miss[1])
    };
    (0..20_000).map(candidate).min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or_default()
}

impl Propagator {
    /// Calm water of cells of `h` metres.
    pub(crate) fn new(size: [usize; 2], h: [f64; 2], law: Law) -> Self {
        let [n, m] = size;
        let mut new = Self::still(size);
        // What has no twiddle factors, the mean, keeps its volume.
        let exact = 0.5 / (n * m) as f64;
        let (scale, [near, mean]) = split([exact / new.gain(), exact]);
        new.scale = scale;
        let mode = |i: usize, j: usize| law.mode(wavenumber(size, h, [i, j]), f64::from(near));
        let all = (0..=n / 2).flat_map(|i| (0..=m / 2).map(move |j| (i, j)));
        new.modes = all.map(|(i, j)| mode(i, j)).collect();
        new.modes[0] = law.mode(0.0, f64::from(mean));
        new
    }

    /// Transforms forth and back and does nothing else, but for the factor of two that splitting the fields leaves.
    fn still(size: [usize; 2]) -> Self {
        let [n, m] = size;
        let mut planner = FftPlanner::new();
        let plans = size.map(|length| Plan::new(&mut planner, length));
        let mut order = vec![0];
        if n.is_multiple_of(2) {
            order.push(n / 2);
        }
        let pairs: Vec<usize> = (1..n.div_ceil(2)).collect();
        for lot in pairs.chunks(LOT) {
            order.extend(lot);
            order.extend(lot.iter().map(|i| n - i));
        }
        Self {
            size,
            plans,
            modes: vec![Mode { gain: 1.0, ..Mode::default() }; (n / 2 + 1) * (m / 2 + 1)],
            order,
            rows: vec![Complex32::default(); n * m],
            columns: vec![Complex32::default(); n * (m + PAD)],
            scale: (0.5 / (n * m) as f64) as f32,
        }
    }

    /// What transforms forth and back leave of one: their twiddle factors, rounded, are not quite of modulus one, which would cost
    /// some 1e-7 of all energy in each step. Measured on noise.
    fn gain(&mut self) -> f64 {
        let [n, m] = self.size;
        let patch = Patch { width: n, first: 0, mask: self.size.map(|length| vec![1.0; length]) };
        let mut seed = 1u32;
        let mut noise = || {
            seed = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        let given: Vec<f32> = (0..n * m).map(|_| noise()).collect();
        let mut p: Vec<f32> = (0..n * m).map(|_| noise()).collect();
        let energy = |field: &[f32]| field.iter().map(|v| f64::from(*v) * f64::from(*v)).sum::<f64>();
        let before = energy(&given) + energy(&p);
        let mut next = vec![0.0; n * m];
        self.step(&patch, &given, &mut next, &mut p);
        let exact = 2.0 * (n * m) as f64 * f64::from(self.scale);
        ((energy(&next) + energy(&p)) / before).sqrt() / exact
    }

    /// One step: `next` takes the heights after those in `now`, `p` is stepped in its place.
    pub(crate) fn step(&mut self, patch: &Patch, now: &[f32], next: &mut [f32], p: &mut [f32]) {
        let threads = self.size[0] * self.size[1] >= PARALLEL;
        self.spread_rows(patch, now, p, threads);
        self.turn_columns(threads);
        self.gather_rows(patch, next, p, threads);
    }

    fn spread_rows(&mut self, patch: &Patch, now: &[f32], p: &[f32], threads: bool) {
        let (n, plan, width) = (self.size[0], &self.plans[0], patch.width);
        let first = |lot: usize| (lot * LOT + patch.first) * width + patch.first;
        let task = |bench: &mut Bench, (lot, rows): (usize, &mut [Complex32])| {
            let given = now[first(lot)..].chunks(width).zip(p[first(lot)..].chunks(width));
            for (row, (now, p)) in rows.chunks_exact_mut(n).zip(given) {
                for (z, (now, p)) in row.iter_mut().zip(now.iter().zip(p)) {
                    *z = Complex32::new(*now, *p);
                }
                plan.run(0, row, &mut bench.scratch);
            }
        };
        if threads {
            self.rows.par_chunks_mut(LOT * n).enumerate().for_each_init(Bench::default, task);
        } else {
            let mut bench = Bench::default();
            self.rows.chunks_mut(LOT * n).enumerate().for_each(|lot| task(&mut bench, lot));
        }
    }

    fn turn_columns(&mut self, threads: bool) {
        let Self { size: [n, m], plans: [_, plan], modes, order, rows, columns, .. } = self;
        let (n, m, pitch) = (*n, *m, *m + PAD);
        let of = |i: usize| &modes[i * (m / 2 + 1)..][..m / 2 + 1];
        let transform = |way: usize, columns: &mut [Complex32], bench: &mut Bench| {
            columns.chunks_exact_mut(pitch).for_each(|column| plan.run(way, &mut column[..m], &mut bench.scratch));
        };
        let alone = 2 - n % 2;
        let (own, lots) = columns.split_at_mut(alone * pitch);
        let mut bench = Bench::default();
        for (column, &i) in own.chunks_exact_mut(pitch).zip(&*order) {
            for (z, row) in column.iter_mut().zip(rows.chunks_exact(n)) {
                *z = row[i];
            }
        }
        transform(0, own, &mut bench);
        for (column, &i) in own.chunks_exact_mut(pitch).zip(&*order) {
            turn_alone(&mut column[..m], of(i));
        }
        transform(1, own, &mut bench);
        let task = |bench: &mut Bench, (lot, columns): (usize, &mut [Complex32])| {
            let count = columns.len() / (2 * pitch);
            // The first column of the lot, and the last of its mirror images.
            let (low, high) = (1 + lot * LOT, n - lot * LOT - count);
            for (j, row) in rows.chunks_exact(n).enumerate() {
                let there = row[low..low + count].iter().chain(row[high..high + count].iter().rev());
                for (column, z) in columns.chunks_exact_mut(pitch).zip(there) {
                    column[j] = *z;
                }
            }
            transform(0, columns, bench);
            let (some, mirrored) = columns.split_at_mut(count * pitch);
            for (k, (a, b)) in some.chunks_exact_mut(pitch).zip(mirrored.chunks_exact_mut(pitch)).enumerate() {
                turn_pair(&mut a[..m], &mut b[..m], of(low + k));
            }
            transform(1, columns, bench);
        };
        if threads {
            lots.par_chunks_mut(2 * LOT * pitch).enumerate().for_each_init(Bench::default, task);
        } else {
            lots.chunks_mut(2 * LOT * pitch).enumerate().for_each(|lot| task(&mut bench, lot));
        }
    }

    fn gather_rows(&mut self, patch: &Patch, next: &mut [f32], p: &mut [f32], threads: bool) {
        let Self { size: [n, m], plans: [plan, _], order, columns, scale, .. } = self;
        let (n, m, pitch, width) = (*n, *m, *m + PAD, patch.width);
        let task = |bench: &mut Bench, (lot, (next, p)): (usize, (&mut [f32], &mut [f32]))| {
            let first = lot * LOT;
            let count = LOT.min(m - first);
            bench.rows.resize(LOT * (n + PAD), Complex32::default());
            for (column, &i) in columns.chunks_exact(pitch).zip(&*order) {
                for (row, z) in bench.rows.chunks_exact_mut(n + PAD).zip(&column[first..first + count]) {
                    row[i] = *z;
                }
            }
            let out = next.chunks_mut(width).zip(p.chunks_mut(width)).zip(&patch.mask[1][first..]);
            for (row, ((next, p), across)) in bench.rows.chunks_exact_mut(n + PAD).take(count).zip(out) {
                plan.run(1, &mut row[..n], &mut bench.scratch);
                let factor = *scale * across;
                let out = next[patch.first..].iter_mut().zip(&mut p[patch.first..]).zip(&patch.mask[0]);
                for (z, ((next, p), along)) in row[..n].iter().zip(out) {
                    let factor = factor * along;
                    (*next, *p) = (factor * z.re, factor * z.im);
                }
            }
        };
        let all = patch.first * width..(patch.first + m) * width;
        let (next, p) = (&mut next[all.clone()], &mut p[all]);
        if threads {
            let lots = next.par_chunks_mut(LOT * width).zip(p.par_chunks_mut(LOT * width));
            lots.enumerate().for_each_init(Bench::default, task);
        } else {
            let mut bench = Bench::default();
            let lots = next.chunks_mut(LOT * width).zip(p.chunks_mut(LOT * width));
            lots.enumerate().for_each(|lot| task(&mut bench, lot));
        }
    }
}

/// Steps a wavenumber, given Z of it and of its mirror image.
#[inline(always)]
fn turn(z: Complex32, mirrored: Complex32, mode: &Mode) -> [Complex32; 2] {
    // Twice eta and twice P.
    let mut e = [z.re + mirrored.re, z.im - mirrored.im];
    let mut p = [z.im + mirrored.im, mirrored.re - z.re];
    for k in 0..2 {
        e[k] += mode.first * p[k];
        p[k] -= mode.second * e[k];
        e[k] = mode.gain * (e[k] + mode.third * p[k]);
        p[k] *= mode.gain;
    }
    [Complex32::new(e[0] - p[1], e[1] + p[0]), Complex32::new(e[0] + p[1], p[0] - e[1])]
}

fn turn_pair(a: &mut [Complex32], b: &mut [Complex32], modes: &[Mode]) {
    let m = a.len();
    [a[0], b[0]] = turn(a[0], b[0], &modes[0]);
    for (j, mode) in modes.iter().enumerate().skip(1) {
        [a[j], b[m - j]] = turn(a[j], b[m - j], mode);
        if 2 * j < m {
            [a[m - j], b[j]] = turn(a[m - j], b[j], mode);
        }
    }
}

/// The same of a column that is its own mirror image.
fn turn_alone(a: &mut [Complex32], modes: &[Mode]) {
    let m = a.len();
    for (j, mode) in modes.iter().enumerate() {
        let mirrored = (m - j) % m;
        [a[j], a[mirrored]] = turn(a[j], a[mirrored], mode);
    }
}

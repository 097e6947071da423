//! From modes to arrays: pack two real fields into one complex transform, transform columns, then rows.
//!
//! Only the columns that hold modes are transformed along z; a band-limited cascade has few. What lies between the two
//! directions is kept in blocks of as many columns as there are lanes.

#[cfg(test)]
mod bits;
pub(crate) mod fft;
pub(crate) mod held;
pub(crate) mod lanes;
pub(crate) mod lazy;
pub(crate) mod levels;
pub(crate) mod pack;
pub(crate) mod pool;

use fearless_simd::{Simd, dispatch, prelude::*};
use rayon::prelude::*;

use crate::Moment;
use crate::modes::set::ModeSet;
use crate::synthesis::fft::Fft;
use crate::synthesis::held::Held;
use crate::synthesis::lanes::{Complex, MOST_LANES, f32s, transpose};
use crate::synthesis::pack::Pack;
use crate::synthesis::pool::Pools;

/// What an array of four fields is made from: two complex transforms.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    held: &'a Held,
    /// The second of two mode sets that are mixed.
    other: Option<&'a Held>,
    level: fearless_simd::Level,
    fft: &'a Fft,
    pack: Pack,
    moment: Moment,
}

impl<'a> Job<'a> {
    /// Array `which` of cascade `c`.
    pub(crate) fn new(
        (first, second): (&'a ModeSet, Option<&'a ModeSet>),
        c: usize,
        which: usize,
        moment: Moment,
    ) -> Self {
        Self {
            held: &first.held[c],
            other: second.map(|set| &set.held[c]),
            level: first.level,
            fft: &first.ffts[c],
            pack: first.packs[c][which],
            moment,
        }
    }

    /// Floats of work memory: for the half done transforms, and for a thread's lines.
    pub(crate) fn needs(self) -> [usize; 2] {
        [self.half_floats(), 3 * self.line_floats()]
    }

    /// Makes the array on rayon's threads. Every value is computed by one thread in one order: the bits are those of
    /// [`Self::run_alone`], on any number of threads.
    pub(crate) fn run(self, pools: &Pools, texels: &mut [[f32; 4]]) {
        let mut half = pools.halves.take(self.half_floats());
        let blocks = half.par_chunks_exact_mut(self.block_floats()).take(self.held.blocks()).enumerate();
        blocks.for_each(|(block, out)| self.columns(pools, block, out));
        let rows = self.held.lanes * self.held.size;
        let bands = texels.par_chunks_exact_mut(rows).enumerate().with_min_len(2);
        bands.for_each(|(band, out)| self.rows(pools, &half, band, out));
        pools.halves.give(half);
    }

    /// The same on the calling thread.
    pub(crate) fn run_alone(self, pools: &Pools, texels: &mut [[f32; 4]]) {
        let mut half = pools.halves.take(self.half_floats());
        let blocks = half.chunks_exact_mut(self.block_floats()).take(self.held.blocks()).enumerate();
        blocks.for_each(|(block, out)| self.columns(pools, block, out));
        let rows = self.held.lanes * self.held.size;
        texels.chunks_exact_mut(rows).enumerate().for_each(|(band, out)| self.rows(pools, &half, band, out));
        pools.halves.give(half);
    }

    /// Floats of a line of complex values, one in each lane.
    fn line_floats(self) -> usize {
        2 * self.held.size * self.held.lanes
    }

    /// Floats of a block of columns of both transforms.
    fn block_floats(self) -> usize {
        2 * self.line_floats()
    }

    fn half_floats(self) -> usize {
        self.held.blocks() * self.block_floats()
    }

    /// Packs a block of columns and transforms it along z.
    fn columns(self, pools: &Pools, block: usize, out: &mut [f32]) {
        let mut scratch = pools.lines.take(3 * self.line_floats());
        dispatch!(self.level, simd => columns(simd, self, block, &mut scratch, out));
        pools.lines.give(scratch);
    }

    /// Transforms as many rows as there are lanes along x, into texels.
    fn rows(self, pools: &Pools, half: &[f32], band: usize, out: &mut [[f32; 4]]) {
        let mut scratch = pools.lines.take(3 * self.line_floats());
        dispatch!(self.level, simd => rows(simd, self, half, band, &mut scratch, out.as_flattened_mut()));
        pools.lines.give(scratch);
    }
}

#[inline(always)]
fn columns<S: Simd>(simd: S, job: Job<'_>, block: usize, scratch: &mut [f32], out: &mut [f32]) {
    let floats = Complex::<S>::FLOATS;
    let line = job.line_floats();
    let (first, rest) = scratch.split_at_mut(line);
    let second = &mut rest[..line];
    // The kind of array is known within each of these, so that what it does not need is not computed.
    match job.pack {
        Pack::Displacement { scale } => fill(simd, job, Pack::Displacement { scale }, block, first, second),
        Pack::Derivative => fill(simd, job, Pack::Derivative, block, first, second),
        Pack::Velocity { scale } => fill(simd, job, Pack::Velocity { scale }, block, first, second),
    }
    let band = job.held.band();
    let gap = band.gap(job.held.size);
    for (line, out) in [first, second].into_iter().zip(out.chunks_exact_mut(line)) {
        line[gap.start * floats..gap.end * floats].fill(0.0);
        job.fft.run(simd, line, band, out);
    }
}

/// Brings the modes of a block of columns to their time, packed.
#[inline(always)]
fn fill<S: Simd>(simd: S, job: Job<'_>, pack: Pack, block: usize, first: &mut [f32], second: &mut [f32]) {
    let floats = Complex::<S>::FLOATS;
    let chop = f32s(simd, job.moment.choppiness);
    let cells = job.held.block(block);
    let [phase, other_phase] = job.moment.phase;
    let weight = [f32s(simd, job.moment.weight[0]), f32s(simd, job.moment.weight[1])];
    for (row, &z) in job.held.indices.iter().enumerate() {
        let cell = cells.cell(simd, row);
        let mut now = cell.at(simd, phase);
        if let Some(other) = job.other {
            now = now.sum(other.block(block).cell(simd, row).at(simd, other_phase), weight);
        }
        let [p, q] = pack.pair(simd, chop, &cell, &now);
        p.store(&mut first[z * floats..][..floats]);
        q.store(&mut second[z * floats..][..floats]);
    }
}

#[inline(always)]
fn rows<S: Simd>(simd: S, job: Job<'_>, half: &[f32], band: usize, scratch: &mut [f32], texels: &mut [f32]) {
    let (lanes, floats) = (S::f32s::LEN, Complex::<S>::FLOATS);
    let (size, line_floats) = (job.held.size, job.line_floats());
    let (line, rest) = scratch.split_at_mut(line_floats);
    let (first, rest) = rest.split_at_mut(line_floats);
    let second = &mut rest[..line_floats];
    let narrow = job.held.band();
    let gap = narrow.gap(size);
    for (t, out) in [&mut *first, &mut *second].into_iter().enumerate() {
        line[gap.start * floats..gap.end * floats].fill(0.0);
        let blocks = half.chunks_exact(job.block_floats()).zip(job.held.indices.chunks(lanes));
        for (block, indices) in blocks {
            let tile = &block[t * line_floats + band * lanes * floats..][..lanes * floats];
            let mut re = [f32s(simd, 0.0); MOST_LANES];
            let mut im = re;
            for i in 0..lanes {
                let value = Complex::<S>::load(simd, &tile[i * floats..][..floats]);
                (re[i], im[i]) = (value.re, value.im);
            }
            transpose(simd, &mut re);
            transpose(simd, &mut im);
            for (i, &x) in indices.iter().enumerate() {
                Complex::<S> { re: re[i], im: im[i] }.store(&mut line[x * floats..][..floats]);
            }
        }
        job.fft.run(simd, line, narrow, out);
    }
    let unscale = f32s(simd, job.pack.unscale());
    // A quarter as many texels as lanes fill a vector.
    let step = lanes / 4;
    let pairs = first.chunks_exact(step * floats).zip(second.chunks_exact(step * floats));
    for (x, (p, q)) in pairs.enumerate() {
        let mut values = [unscale; MOST_LANES];
        for (i, values) in values[..lanes].chunks_exact_mut(4).enumerate() {
            let p = Complex::<S>::load(simd, &p[i * floats..][..floats]);
            let q = Complex::<S>::load(simd, &q[i * floats..][..floats]);
            values.copy_from_slice(&[p.re, p.im, q.re, q.im * unscale]);
        }
        transpose(simd, &mut values);
        for (z, value) in values[..lanes].iter().enumerate() {
            value.store_slice(&mut texels[4 * size * z + lanes * x..][..lanes]);
        }
    }
}

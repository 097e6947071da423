//! From modes to arrays: pack two real fields into one complex transform, transform rows, then columns.
//!
//! Only the rows that hold modes are transformed along x; a band-limited cascade has few.

use std::sync::Arc;

use glam::Mat4;
use rayon::prelude::*;

use crate::Moment;
use crate::fft::{Complex, Fft, LANES, Lanes};
use crate::held::{Held, State};
use crate::pack::Pack;
use crate::set::ModeSet;

/// The arrays of one cascade and what makes them.
#[derive(Clone)]
pub(crate) struct Synthesis {
    now: Vec<State>,
    fft: Arc<Fft>,
    outputs: [Output; 3],
}

/// One array of four fields: two complex transforms.
#[derive(Clone)]
struct Output {
    /// Per transform, the rows after their own transform: `[lane of row]` at `block * size + x`.
    rows: [Vec<Complex>; 2],
    /// Input and scratch of each transform in work.
    work: [[Vec<Complex>; 2]; 2],
    texels: Vec<[f32; 4]>,
}

impl Synthesis {
    pub(crate) fn new(held: &Held) -> Self {
        let outputs = std::array::from_fn(|_| Output::new(held));
        Self { fft: Arc::new(Fft::new(held.size)), now: held.states(), outputs }
    }

    /// Computes all arrays of cascade `c` of one or two mode sets. Every value is computed by one thread in one order,
    /// so the bits do not depend on the number of threads.
    pub(crate) fn run(&mut self, c: usize, first: &ModeSet, second: Option<&ModeSet>, moment: Moment) {
        let held = &first.held[c];
        match second {
            None => held.propagate(&mut self.now, moment.phase[0]),
            Some(second) => {
                held.propagate_both(&second.held[c], &mut self.now, moment.phase, moment.weight);
            }
        }
        let (now, fft) = (&self.now, &*self.fft);
        let packs = first.packs[c];
        self.outputs.par_iter_mut().zip(packs).for_each(|(output, pack)| {
            output.rows(held, now, fft, pack, moment.choppiness);
            output.columns(held, fft, pack);
        });
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

impl Output {
    fn new(held: &Held) -> Self {
        let size = held.size;
        let line = || vec![Complex::default(); size];
        Self {
            rows: [(); 2].map(|()| vec![Complex::default(); held.rows.len().div_ceil(LANES) * size]),
            work: [(); 2].map(|()| [line(), line()]),
            texels: vec![[0.0; 4]; size * size],
        }
    }

    fn rows(&mut self, held: &Held, now: &[State], fft: &Fft, pack: Pack, chop: f32) {
        let size = held.size;
        let gap = held.half..size - (held.half - 1);
        let [[a, a_scratch], [b, b_scratch]] = &mut self.work;
        let [first, second] = &mut self.rows;
        let out = first.chunks_exact_mut(size).zip(second.chunks_exact_mut(size));
        for (block, (first, second)) in held.blocks(now).zip(out) {
            pack.fill(chop, &block, &gap, a, b);
            a[gap.clone()].fill(Complex::default());
            b[gap.clone()].fill(Complex::default());
            first.copy_from_slice(fft.run(a, a_scratch));
            second.copy_from_slice(fft.run(b, b_scratch));
        }
    }

    fn columns(&mut self, held: &Held, fft: &Fft, pack: Pack) {
        let size = held.size;
        let gap = held.half..size - (held.half - 1);
        let unscale = pack.unscale();
        for x in (0..size).step_by(LANES) {
            for (rows, [line, _]) in self.rows.iter().zip(&mut self.work) {
                line[gap.clone()].fill(Complex::default());
                for (rows, at) in rows.chunks_exact(size).zip(held.rows.chunks(LANES)) {
                    let tile = &rows[x..x + LANES];
                    let re = transposed(std::array::from_fn(|l| tile[l].re));
                    let im = transposed(std::array::from_fn(|l| tile[l].im));
                    for ((&z, re), im) in at.iter().zip(re).zip(im) {
                        line[z] = Complex { re, im };
                    }
                }
            }
            let [[a, a_scratch], [b, b_scratch]] = &mut self.work;
            let (first, second) = (fft.run(a, a_scratch), fft.run(b, b_scratch));
            let lines = self.texels.chunks_exact_mut(size);
            for ((texels, p), q) in lines.zip(first.iter()).zip(second.iter()) {
                let unscaled = q.im.map(|im| im * unscale);
                texels[x..x + LANES].copy_from_slice(&transposed([p.re, p.im, q.re, unscaled]));
            }
        }
    }
}

/// Four values of four lanes, exchanged; through glam because its transpose is made of shuffles.
fn transposed(values: [Lanes; LANES]) -> [Lanes; LANES] {
    Mat4::from_cols_array_2d(&values).transpose().to_cols_array_2d()
}

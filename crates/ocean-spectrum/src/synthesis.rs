//! From modes to arrays: pack two real fields into one complex transform, transform rows, then columns.
//!
//! Only the rows that hold modes are transformed along x; a band-limited cascade has few.

use glam::Mat4;
use rayon::prelude::*;

use crate::fft::{Complex, Fft, LANES, Lanes};
use crate::held::Held;
use crate::pack::Pack;
use crate::{CascadeModes, OceanDesc};

/// The arrays of one cascade and what makes them.
pub(crate) struct Synthesis {
    held: Held,
    fft: Fft,
    outputs: [Output; 3],
}

/// One array of four fields: two complex transforms.
struct Output {
    pack: Pack,
    /// Per transform, the rows after their own transform: `[lane of row]` at `block * size + x`.
    rows: [Vec<Complex>; 2],
    /// Input and scratch of each transform in work.
    work: [[Vec<Complex>; 2]; 2],
    texels: Vec<[f32; 4]>,
}

impl Synthesis {
    pub(crate) fn new(modes: &CascadeModes, desc: &OceanDesc) -> Self {
        let held = Held::new(modes, desc.loop_time);
        let outputs = Pack::all(modes, desc).map(|pack| Output::new(pack, &held));
        Self { fft: Fft::new(held.size), held, outputs }
    }

    /// Computes all arrays at a phase of the loop. Every value is computed by one thread in one order, so the bits do
    /// not depend on the number of threads.
    pub(crate) fn run(&mut self, phase: u32) {
        self.held.propagate(phase);
        let (held, fft) = (&self.held, &self.fft);
        self.outputs.par_iter_mut().for_each(|output| output.run(held, fft));
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
    fn new(pack: Pack, held: &Held) -> Self {
        let size = held.size;
        let line = || vec![Complex::default(); size];
        Self {
            pack,
            rows: [(); 2].map(|()| vec![Complex::default(); held.rows.len().div_ceil(LANES) * size]),
            work: [(); 2].map(|()| [line(), line()]),
            texels: vec![[0.0; 4]; size * size],
        }
    }

    fn run(&mut self, held: &Held, fft: &Fft) {
        self.rows(held, fft);
        self.columns(held, fft);
    }

    fn rows(&mut self, held: &Held, fft: &Fft) {
        let size = held.size;
        let gap = held.half..size - (held.half - 1);
        let [[a, a_scratch], [b, b_scratch]] = &mut self.work;
        let [first, second] = &mut self.rows;
        let out = first.chunks_exact_mut(size).zip(second.chunks_exact_mut(size));
        for (block, (first, second)) in held.blocks().zip(out) {
            self.pack.fill(&block, &gap, a, b);
            a[gap.clone()].fill(Complex::default());
            b[gap.clone()].fill(Complex::default());
            first.copy_from_slice(fft.run(a, a_scratch));
            second.copy_from_slice(fft.run(b, b_scratch));
        }
    }

    fn columns(&mut self, held: &Held, fft: &Fft) {
        let size = held.size;
        let gap = held.half..size - (held.half - 1);
        let unscale = self.pack.unscale();
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

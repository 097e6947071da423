//! Case `fft_cpu`: the cascades' fields against a direct sum.

use std::{hint::black_box, sync::Arc, time::Instant};

use ocean_spectrum::{Ocean, Outputs};
use rayon::prelude::*;
use rustfft::{Fft, FftPlanner, num_complex::Complex32};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Effort, Plot, Row, measure_together},
    fixtures::{self, Random},
    truth::{Fields, Waves},
};

/// See the module.
pub(super) const CPU: Case = Case {
    name: "fft_cpu",
    about: "fields of the CPU synthesis against a direct sum in f64; plain rustfft beside it",
    plots: &[Plot {
        file: "fft_cpu",
        title: "Synthesis of three cascades on the CPU",
        x: Axis::Param("size"),
        y: Axis::Time,
        label: None,
    }],
    run: cpu,
};

/// Texels that are compared in each cascade.
const TEXELS: usize = 64;
/// Names of the fields in the order of [`Fields`].
pub(super) const NAMES: [&str; 12] =
    ["Dx", "h", "Dz", "dDx/dz", "dh/dx", "dh/dz", "dDx/dx", "dDz/dz", "dDx/dt", "dh/dt", "dDz/dt", "d2h/dt2"];

fn cpu(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for &size in context.pick(&[128, 256][..], &[64, 128, 256, 512, 1024]) {
        let desc = fixtures::ocean(size);
        let mut ocean = Ocean::new(desc.clone())?;
        let mut worst = (0.0f64, "");
        for c in 0..desc.cascades.len() {
            let errors = errors(&mut ocean, c);
            for (error, name) in errors.into_iter().zip(NAMES) {
                if error > worst.0 || error.is_nan() {
                    worst = (error, name);
                }
            }
        }
        rows.push(
            Row::new("fft_cpu", "own FFT, equal bits everywhere")
                .param("size", size)
                .param("cascades", desc.cascades.len())
                .param("worst_field", worst.1)
                .error(worst.0, "relative RMS", "direct sum in f64")
                .bound(1e-6),
        );
        for (threads, bound) in [(1, 0.82), (2, 1.47)] {
            rows.push(speed(context.effort, size, &mut ocean, threads, bound)?);
        }
    }
    Ok(rows)
}

/// Time of the synthesis against the same transforms by rustfft.
fn speed(effort: Effort, size: u32, ocean: &mut Ocean, threads: usize, bound: f64) -> Result<Row, CaseError> {
    let cascades = ocean.modes().len();
    let mut plain = Plain::new(size as usize, 6 * cascades);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let (mut time, mut least) = (0.0, [f64::INFINITY; 2]);
    let [ours, theirs] = pool.install(|| {
        let [mine, other] = &mut least;
        measure_together(
            effort,
            [
                &mut || {
                    time += 1.0 / 60.0;
                    let start = Instant::now();
                    ocean.set_time(black_box(time));
                    ocean.prepare(Outputs::ALL);
                    *mine = mine.min(start.elapsed().as_secs_f64());
                },
                &mut || {
                    let start = Instant::now();
                    plain.run();
                    *other = other.min(start.elapsed().as_secs_f64());
                },
            ],
        )
    });
    let row = Row::new("fft_cpu", if threads == 1 { "one thread" } else { "two threads" })
        .param("size", size)
        .param("cascades", cascades)
        .param("least_us", (least[0] * 1e6).round())
        .error(least[0] / least[1], "of rustfft's time", "as many complex transforms by rustfft; least of all repeats")
        .time("twelve fields of every cascade at a new time", &ours)
        .baseline("rustfft: rows, columns to rows 16 at a time, rows; nothing else", &theirs);
    // The default cascades, for which FFTW's time is recorded.
    if size != 256 {
        return Ok(row);
    }
    Ok(row.bound(bound).note(
        "bound: 0.7 of FFTW, which took 1.17 (1 thread) and 2.1 (2 threads) times as long as rustfft where both were \
         measured (Zen 5)",
    ))
}

/// A time that is a dyadic part of the loop, so that its phase is exact.
pub(super) fn exact_time(ocean: &Ocean) -> f64 {
    ocean.desc().loop_time * 0.314_453_125
}

/// Relative RMS error of each field of a cascade.
fn errors(ocean: &mut Ocean, c: usize) -> Fields {
    let time = exact_time(ocean);
    ocean.set_time(time);
    let fields = ocean.fields(c);
    compare(ocean, c, |texel| {
        let made = [fields.displacement[texel], fields.derivative[texel], fields.velocity[texel]];
        std::array::from_fn(|i| f64::from(made[i / 4][i % 4]))
    })
}

/// Relative RMS error of each field over some texels of a cascade at [`exact_time`].
pub(super) fn compare(ocean: &Ocean, c: usize, made: impl Fn(usize) -> Fields + Sync) -> Fields {
    let modes = &ocean.modes()[c];
    let waves = Waves::of(&ocean.modes()[c..=c], ocean.desc().choppiness, ocean.desc().loop_time);
    let (size, time) = (modes.size as usize, exact_time(ocean));
    let mut random = Random::new(11);
    let texels: Vec<usize> = (0..TEXELS).map(|_| random.within(0.0, (size * size) as f64) as usize).collect();
    let sums: Vec<[Fields; 2]> = texels
        .par_iter()
        .map(|&texel| {
            let step = f64::from(modes.tile) / size as f64;
            let truth = waves.at((texel % size) as f64 * step, (texel / size) as f64 * step, time);
            let made = made(texel);
            [std::array::from_fn(|i| (made[i] - truth[i]).powi(2)), truth.map(|value| value * value)]
        })
        .collect();
    std::array::from_fn(|i| {
        let sum = |which: usize| sums.iter().map(|sums| sums[which][i]).sum::<f64>();
        (sum(0) / sum(1)).sqrt()
    })
}

/// The transforms alone, as one writes them with rustfft.
pub(super) struct Plain {
    fft: Arc<dyn Fft<f32>>,
    size: usize,
    arrays: Vec<[Vec<Complex32>; 4]>,
}

impl Plain {
    pub(super) fn new(size: usize, count: usize) -> Self {
        let fft = FftPlanner::new().plan_fft_inverse(size);
        let mut random = Random::new(5);
        let mut number = || random.within(-1.0, 1.0) as f32;
        let arrays = (0..count)
            .map(|_| {
                let data = (0..size * size).map(|_| Complex32::new(number(), number())).collect();
                let zeros = || vec![Complex32::default(); size * size];
                let scratch = fft.get_inplace_scratch_len().max(fft.get_immutable_scratch_len());
                [data, zeros(), zeros(), vec![Complex32::default(); scratch]]
            })
            .collect();
        Self { fft, size, arrays }
    }

    pub(super) fn run(&mut self) {
        let (fft, size) = (&self.fft, self.size);
        self.arrays.par_iter_mut().for_each(|[data, half, out, scratch]| {
            fft.process_immutable_with_scratch(data, half, scratch);
            // Columns become rows, 16 at a time to stay in the cache, in tiles of 8 x 8 that do not compete for a set.
            for (block, out) in out.chunks_exact_mut(16 * size).enumerate() {
                for (part, out) in out.chunks_exact_mut(8 * size).enumerate() {
                    let first = block * 16 + part * 8;
                    for (tile, rows) in half.chunks_exact(8 * size).enumerate() {
                        let mut values = [[Complex32::default(); 8]; 8];
                        for (values, row) in values.iter_mut().zip(rows.chunks_exact(size)) {
                            values.copy_from_slice(&row[first..first + 8]);
                        }
                        for (i, out) in out.chunks_exact_mut(size).enumerate() {
                            let column: [Complex32; 8] = std::array::from_fn(|j| values[j][i]);
                            out[tile * 8..][..8].copy_from_slice(&column);
                        }
                    }
                }
                fft.process_with_scratch(out, scratch);
            }
            black_box(out);
        });
    }
}

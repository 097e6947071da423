//! Cases `fft_gpu_speed` (the GPU's synthesis against recorded peers) and `gpu_passes` (what each dispatch moves).

use std::sync::Arc;

use ocean_spectrum::gpu::GpuOcean;
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc};
use rayon::prelude::*;
use rustfft::{Fft, FftPlanner, num_complex::Complex32};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Effort, Gpu, Plot, Row, Timing, fastest, measure_together},
    fixtures,
};

/// See the module.
pub(super) const SPEED: Case = Case {
    name: "fft_gpu_speed",
    about: "four packed spectra of a cascade on the GPU, against one transform by rustfft on two threads",
    plots: &[],
    run: speed,
};

/// See the module.
pub(super) const PASSES: Case = Case {
    name: "gpu_passes",
    about: "bytes and microseconds of every dispatch of the sea",
    plots: &[Plot {
        file: "gpu_passes",
        title: "Dispatches of the default sea: time against bytes read and written",
        x: Axis::Param("kib"),
        y: Axis::Time,
        label: Some("dispatch"),
    }],
    run: passes,
};

/// Sizes, and there the times of one transform by VkFFT and of four by GodotOceanWaves, in those of one by rustfft, as
/// recorded on lavapipe of Mesa 22.3 with 2 threads (Zen 5): rustfft took .08 and .70 ms, VkFFT 1.1 to 1.3 and 4.3 to
/// 4.6, GodotOceanWaves 6 to 13 times a plain kernel's 1.7 to 2.3 and 8.4 to 12.6 for four. Middles of the ranges.
const PEERS: [(u32, f64, f64); 2] = [(256, 1.2 / 0.08, 9.5 * 2.0 / 0.08), (512, 4.45 / 0.70, 9.5 * 10.5 / 0.70)];

/// A sea whose one cascade holds modes in every row.
fn full(size: u32) -> OceanDesc {
    OceanDesc { cascades: vec![CascadeDesc::new(size, 72.4)], ..fixtures::ocean(size) }
}

fn speed(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let effort = context.effort;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    let mut rows = Vec::new();
    for (size, vkfft, godot) in PEERS {
        let mut plain = Plain::new(size as usize);
        let seas = [
            (fixtures::ocean(size), "whole synthesis, mean of the default cascades"),
            (full(size), "whole synthesis, modes in every row"),
        ];
        for (desc, variant) in seas {
            let ocean = Ocean::new(desc)?;
            let count = ocean.modes().len() as f64;
            let mut gpu_ocean = GpuOcean::new(&gpu.device, &ocean)?;
            let passes = gpu_ocean.field_passes().len();
            // The two dispatches along z, of one cascade: rows without modes aside, those along x cost the same.
            let transforms = (count == 1.0).then_some(passes.saturating_sub(2)..passes);
            let [whole, alone, theirs] =
                pool.install(|| compare(effort, gpu, &mut gpu_ocean, &ocean, transforms.clone(), &mut plain));
            let row = |variant: &str, timing: &Timing| {
                let ratio = timing.median_ns / theirs.median_ns;
                Row::new("fft_gpu_speed", variant)
                    .param("size", size)
                    .param("adapter", gpu.adapter.kind.clone())
                    .param("times_vkffts_speed", (4.0 * vkfft / ratio * 100.0).round() / 100.0)
                    .param("times_godots_speed", (godot / ratio * 100.0).round() / 100.0)
                    .error(ratio, "of rustfft's time", "one complex transform by rustfft, 2 threads")
                    .time("four packed spectra of one cascade: encode, submit, wait; fastest", timing)
                    .baseline(
                        "one complex transform by rustfft: rows, then a gather of 16 columns at a time, 2 threads; fastest",
                        &theirs,
                    )
            };
            // No bound: others' work on the machine has been seen to take three times as long.
            rows.push(row(variant, &whole.per(count)));
            if transforms.is_some() {
                rows.push(
                    row("transforms alone, modes in every row", &alone.per(0.5)).note("twice the dispatches along z"),
                );
            }
        }
    }
    Ok(rows)
}

/// Times of the whole synthesis, of some dispatches, and of rustfft.
fn compare(
    effort: Effort,
    gpu: &Gpu,
    gpu_ocean: &mut GpuOcean,
    ocean: &Ocean,
    some: Option<std::ops::Range<usize>>,
    plain: &mut Plain,
) -> [Timing; 3] {
    let mut time = 0.0;
    let mut made = GpuOcean::new(&gpu.device, ocean).ok();
    if let Some(made) = &mut made {
        let _ = gpu.frame(|frame| made.set_time(frame, ocean, 0.0, 0.0));
    }
    fastest(
        effort,
        [
            &mut || {
                time += 1.0 / 60.0;
                let _ = gpu.frame(|frame| gpu_ocean.encode_fields(frame, ocean, time));
            },
            &mut || {
                let (Some(some), Some(made)) = (&some, &made) else { return };
                let _ = gpu.run(|encoder| {
                    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                    some.clone().for_each(|i| made.record_one(&mut pass, i));
                });
            },
            &mut || plain.run(),
        ],
    )
}

fn passes(context: &Context) -> Result<Vec<Row>, CaseError> {
    /// Times that a dispatch is repeated in a submission, so that what submitting costs can be taken off.
    const REPEATS: usize = 9;
    let gpu = context.gpu()?;
    let effort = Effort { budget: context.effort.budget / 4, ..context.effort };
    let mut rows = Vec::new();
    for &size in context.pick(&[256][..], &[256, 512]) {
        let ocean = Ocean::new(fixtures::ocean(size))?;
        let mut gpu_ocean = GpuOcean::new(&gpu.device, &ocean)?;
        gpu.frame(|frame| gpu_ocean.encode(frame, &ocean, 0.0, 0.1))?;
        let passes = [gpu_ocean.field_passes(), gpu_ocean.look_passes()].concat();
        for (i, pass) in passes.iter().enumerate() {
            let run = |repeats: usize| {
                let _ = gpu.run(|encoder| {
                    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                    (0..repeats).for_each(|_| gpu_ocean.record_one(&mut pass, i));
                });
            };
            let [once, often] = measure_together(effort, [&mut || run(1), &mut || run(REPEATS)]);
            let one = (REPEATS - 1) as f64;
            let timing = Timing { median_ns: (often.median_ns - once.median_ns).max(1.0) / one, ..often.per(one) };
            rows.push(
                Row::new("gpu_passes", format!("{} of cascades {:?}", pass.name, pass.cascades))
                    .param("dispatch", i)
                    .param("size", size)
                    .param("kib", pass.bytes / 1024)
                    .param("gb_per_s", (pass.bytes as f64 / timing.median_ns * 100.0).round() / 100.0)
                    .time("one dispatch: nine in a submission less one in a submission", &timing),
            );
        }
    }
    Ok(rows)
}

/// One transform by rustfft, its rows and then its columns spread over the threads.
struct Plain {
    fft: Arc<dyn Fft<f32>>,
    size: usize,
    data: Vec<Complex32>,
    out: Vec<Complex32>,
}

impl Plain {
    fn new(size: usize) -> Self {
        let fft = FftPlanner::new().plan_fft_inverse(size);
        let mut random = fixtures::Random::new(5);
        let mut number = || random.within(-1.0, 1.0) as f32;
        let data = (0..size * size).map(|_| Complex32::new(number(), number())).collect();
        Self { fft, size, data, out: vec![Complex32::default(); size * size] }
    }

    fn run(&mut self) {
        let (fft, size) = (&self.fft, self.size);
        let blocks = size / rayon::current_num_threads().min(size);
        self.data.par_chunks_mut(blocks * size).for_each(|rows| {
            fft.process(rows);
            // Keeps the numbers from growing over the repeats.
            rows.iter_mut().for_each(|value| *value *= 1.0 / size as f32);
        });
        let data = &self.data;
        self.out.par_chunks_mut(16 * size).enumerate().for_each(|(block, out)| {
            for (j, row) in data.chunks_exact(size).enumerate() {
                for (i, value) in row[16 * block..][..16].iter().enumerate() {
                    out[i * size + j] = *value;
                }
            }
            fft.process(out);
        });
    }
}

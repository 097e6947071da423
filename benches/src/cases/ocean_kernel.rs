//! Cases `interpolation` (how heights between texels are read) and `largest` (the sum of the largest waves).

use std::hint::black_box;

use glam::{DVec2, Vec2};
use ocean_spectrum::{Ocean, OceanDesc, OceanSample, Queries};
use open_water_shaders::cubic;
use rayon::prelude::*;

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure_together},
    fixtures::{self, Random},
    truth::Waves,
};

/// See the module.
pub(super) const INTERPOLATION: Case = Case {
    name: "interpolation",
    about: "heights between texels by several kernels, at rest points",
    plots: &[Plot {
        file: "interpolation",
        title: "Kernels that read the arrays: time against error",
        x: Axis::Time,
        y: Axis::Error,
        label: None,
    }],
    run: interpolation,
};

/// See the module.
pub(super) const LARGEST: Case = Case {
    name: "largest",
    about: "samples by direct sum of the largest waves, on one core",
    plots: &[Plot {
        file: "largest",
        title: "Sum of the largest waves: time against error",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("waves"),
    }],
    run: largest,
};

/// Weights of up to six texels around fraction `t`, the first at `1 - taps/2`.
type Weights = fn(f32) -> [f32; 6];

/// A kernel: taps, weights, and whether it wants the coefficients of the cubic B-spline instead of values.
struct Kernel {
    name: &'static str,
    taps: usize,
    weights: Weights,
    spline: bool,
}

const KERNELS: [Kernel; 4] = [
    Kernel { name: "bilinear", taps: 2, weights: |t| [1.0 - t, t, 0.0, 0.0, 0.0, 0.0], spline: false },
    Kernel { name: "Catmull-Rom", taps: 4, weights: |t| four(cubic::weights(t)), spline: false },
    Kernel { name: "cubic B-spline, prefiltered", taps: 4, weights: |t| four(b_spline(t)), spline: true },
    Kernel { name: "quintic Lagrange", taps: 6, weights: quintic, spline: false },
];

fn four([a, b, c, d]: [f32; 4]) -> [f32; 6] {
    [a, b, c, d, 0.0, 0.0]
}

fn b_spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let middle = |t: f32| (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0;
    [s * s * s / 6.0, middle(t), middle(s), t * t * t / 6.0]
}

fn quintic(t: f32) -> [f32; 6] {
    let node = |i: usize| i as f32 - 2.0;
    std::array::from_fn(|i| (0..6).filter(|&j| j != i).map(|j| (t - node(j)) / (node(i) - node(j))).product())
}

/// A map of heights, one for each cascade.
struct Heights {
    size: usize,
    texels_per_metre: f32,
    texels: Vec<f32>,
}

impl Heights {
    fn of(ocean: &Ocean, spline: bool) -> Vec<Self> {
        let cascade = |c| {
            let fields = ocean.fields(c);
            let size = fields.size as usize;
            let mut texels: Vec<f64> = fields.displacement.iter().map(|texel| f64::from(texel[1])).collect();
            if spline {
                texels.chunks_exact_mut(size).for_each(prefilter);
                for x in 0..size {
                    let mut column: Vec<f64> = (0..size).map(|z| texels[z * size + x]).collect();
                    prefilter(&mut column);
                    (0..size).for_each(|z| texels[z * size + x] = column[z]);
                }
            }
            let texels = texels.into_iter().map(|height| height as f32).collect();
            Self { size, texels_per_metre: fields.size as f32 / fields.tile, texels }
        };
        (0..ocean.modes().len()).map(cascade).collect()
    }

    #[inline]
    fn read(&self, point: Vec2, kernel: &Kernel) -> f32 {
        let at = point * self.texels_per_metre;
        let (base, mask) = (at.floor(), self.size - 1);
        let (wx, wz) = ((kernel.weights)(at.x - base.x), (kernel.weights)(at.y - base.y));
        let first = |base: f32| (base as i32 + 1 - kernel.taps as i32 / 2) as usize;
        let (i, j) = (first(base.x), first(base.y));
        let mut sum = 0.0;
        for (dz, wz) in wz[..kernel.taps].iter().enumerate() {
            let row = (j.wrapping_add(dz) & mask) * self.size;
            let mut line = 0.0;
            for (dx, wx) in wx[..kernel.taps].iter().enumerate() {
                line += wx * self.texels[row + (i.wrapping_add(dx) & mask)];
            }
            sum += wz * line;
        }
        sum
    }
}

/// Coefficients of the periodic cubic B-spline through the values (Unser, Aldroubi and Eden 1993).
fn prefilter(line: &mut [f64]) {
    let (n, pole) = (line.len(), 3.0f64.sqrt() - 2.0);
    let mut causal = 0.0;
    for i in 0..n {
        causal += line[(n - i) % n] * pole.powi(i as i32);
    }
    causal /= 1.0 - pole.powi(n as i32);
    let mut forwards = vec![causal];
    for value in &line[1..] {
        causal = value + pole * causal;
        forwards.push(causal);
    }
    let mut back = 0.0;
    for i in 0..n {
        back += forwards[(n - 1 + i) % n] * pole.powi(i as i32);
    }
    back /= 1.0 - pole.powi(n as i32);
    line[n - 1] = -6.0 * pole * back;
    let mut last = -pole * back;
    for i in (0..n - 1).rev() {
        last = pole * (last - forwards[i]);
        line[i] = 6.0 * last;
    }
}

fn scattered(count: usize) -> Vec<Vec2> {
    let mut random = Random::new(3);
    let mut within = || random.within(-500.0, 500.0) as f32;
    (0..count).map(|_| Vec2::new(within(), within())).collect()
}

fn interpolation(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut ocean = Ocean::new(fixtures::ocean(256))?;
    let time = ocean.desc().loop_time * 0.125;
    ocean.set_time(time);
    let waves = Waves::of(ocean.modes(), ocean.desc().choppiness, ocean.desc().loop_time);
    let points = scattered(10_000);
    let checked = &points[..context.pick(100, 1000)];
    let truth: Vec<f64> =
        checked.par_iter().map(|point| waves.at(f64::from(point.x), f64::from(point.y), time)[1]).collect();
    let hs = f64::from(ocean.significant_height());
    let [values, spline] = [false, true].map(|spline| Heights::of(&ocean, spline));
    let source = |kernel: &Kernel| if kernel.spline { &spline } else { &values };
    let read = |kernel: &Kernel, point: Vec2| source(kernel).iter().map(|map| map.read(point, kernel)).sum::<f32>();
    let mut out = [(); 4].map(|()| vec![0.0f32; points.len()]);
    let [a, b, c, d] = &mut out;
    let fill = |kernel: &Kernel, out: &mut [f32]| {
        for (out, point) in out.iter_mut().zip(black_box(&points)) {
            *out = read(kernel, *point);
        }
    };
    let timings = measure_together(
        context.effort,
        [&mut || fill(&KERNELS[0], a), &mut || fill(&KERNELS[1], b), &mut || fill(&KERNELS[2], c), &mut || {
            fill(&KERNELS[3], d)
        }],
    );
    let row = |(kernel, timing): (&Kernel, &_)| {
        let square = checked.iter().zip(&truth).map(|(p, truth)| (f64::from(read(kernel, *p)) - truth).powi(2));
        let error = 100.0 * (square.sum::<f64>() / checked.len() as f64).sqrt() / hs;
        Row::new("interpolation", kernel.name)
            .param("kernel", kernel.name)
            .param("texels", kernel.taps * kernel.taps)
            .error(error, "% of Hs", "direct sum in f64 at the same rest points; RMS")
            .time("10,000 heights, plain code", timing)
    };
    Ok(KERNELS.iter().zip(&timings).map(row).collect())
}

fn largest(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut arrays = Ocean::new(fixtures::ocean(256))?;
    let time = arrays.desc().loop_time * 0.125;
    arrays.set_time(time);
    let waves = Waves::of(arrays.modes(), arrays.desc().choppiness, arrays.desc().loop_time);
    let points = scattered(1000);
    let checked = context.pick(48, 400);
    let truth: Vec<f64> = points[..checked]
        .par_iter()
        .map(|point| {
            let DVec2 { x, y } = point.as_dvec2();
            waves.height_over(x, y, time)
        })
        .collect();
    let hs = f64::from(arrays.significant_height());
    let effort = context.effort;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut rows = Vec::new();
    for &count in context.pick(&[16, 64, 256, 1024][..], &[16, 32, 64, 128, 256, 512, 1024, 2048, 4096]) {
        let mut ocean = Ocean::new(OceanDesc { queries: Queries::Largest(count), ..fixtures::ocean(256) })?;
        ocean.set_time(time);
        let [mut ours, mut theirs] = [(); 2].map(|()| vec![OceanSample::default(); points.len()]);
        let [direct, read] = pool.install(|| {
            measure_together(
                effort,
                [&mut || ocean.sample(black_box(&points), &mut ours), &mut || {
                    arrays.sample(black_box(&points), &mut theirs)
                }],
            )
        });
        let square: f64 = truth.iter().zip(&ours).map(|(truth, a)| (f64::from(a.height) - truth).powi(2)).sum();
        rows.push(
            Row::new("largest", "direct sum")
                .param("waves", count)
                .param("checked", checked)
                .error(100.0 * (square / checked as f64).sqrt() / hs, "% of Hs", "direct sum of all waves in f64; RMS")
                .time("1,000 samples", &direct)
                .baseline("the same from the arrays", &read),
        );
    }
    Ok(rows)
}

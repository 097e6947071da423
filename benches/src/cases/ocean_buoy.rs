//! Cases `tp` and `moments`: what buoys in the made sea measure, by heights and slopes over one loop of time.

use std::f64::consts::TAU;

use glam::Vec2;
use ocean_spectrum::{
    CascadeDesc, Ocean, OceanDesc, OceanSample, Partition, SeaState, Spreading, WaveSpectrum, dispersion,
};
use rayon::prelude::*;
use rustfft::{FftPlanner, num_complex::Complex64};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const TP: Case = Case {
    name: "tp",
    about: "period of the peak as buoys measure it against the spectrum's, over 24 seeds",
    plots: &[Plot {
        file: "tp",
        title: "Error of the peak period over 24 seeds by the size of the tile",
        x: Axis::Param("tile_over_peak_wavelength"),
        y: Axis::Error,
        label: None,
    }],
    run: tp,
};

/// See the module.
pub(super) const MOMENTS: Case = Case {
    name: "moments",
    about: "variance, mean periods, mean direction and directional spread as buoys measure them against the input",
    plots: &[],
    run: moments,
};

const SEEDS: u64 = 24;
/// Length of a record, s: one loop, so that every wave has a whole number of periods and no window is needed.
const RECORD: f64 = 512.0;
/// Lines of the spectrum that are joined before the directions of a band are formed.
const JOINED: usize = 8;

/// Cross spectra of a buoy array, summed over the buoys: one entry per line, `TAU/RECORD` apart.
struct Measured {
    /// Variance of the height in a line, m^2.
    height: Vec<f64>,
    /// Variance of the slopes.
    slope: Vec<f64>,
    /// Height against slope, a quarter period apart: towards x and z.
    towards: Vec<[f64; 2]>,
}

/// Records `buoys` buoys, up to the frequency `highest` (rad/s).
fn measure(ocean: &mut Ocean, buoys: usize, highest: f64) -> Measured {
    let mut random = Random::new(3);
    let mut place = || random.within(-3000.0, 3000.0) as f32;
    let points: Vec<Vec2> = (0..buoys).map(|_| Vec2::new(place(), place())).collect();
    // What is held above the highest frequency must not fold back below it.
    let fastest = ocean.modes().iter().flat_map(|modes| &modes.n).max().map_or(0.0, |n| f64::from(*n));
    let lines = (highest * RECORD / TAU) as usize;
    let times = fastest as usize + lines + 2;
    let mut series = vec![vec![Complex64::default(); times]; 3 * buoys];
    let mut answers = vec![OceanSample::default(); buoys];
    for i in 0..times {
        ocean.set_time(RECORD * i as f64 / times as f64);
        ocean.sample(&points, &mut answers);
        for (series, answer) in series.chunks_exact_mut(3).zip(&answers) {
            let slope = [-answer.normal.x / answer.normal.y, -answer.normal.z / answer.normal.y];
            for (series, value) in series.iter_mut().zip([answer.height, slope[0], slope[1]]) {
                series[i] = Complex64::new(f64::from(value) / times as f64, 0.0);
            }
        }
    }
    let fft = FftPlanner::new().plan_fft_forward(times);
    series.par_iter_mut().for_each(|series| fft.process(series));
    let sum = |f: &dyn Fn(&[Vec<Complex64>], usize) -> f64| -> Vec<f64> {
        let over_buoys = |line: usize| series.chunks_exact(3).map(|buoy| f(buoy, line)).sum::<f64>();
        (1..=lines).map(|line| 2.0 * over_buoys(line) / buoys as f64).collect()
    };
    // h = A exp(-i omega t) has the slope i k h: a quarter period apart.
    let quad = |which: usize| sum(&|buoy, line| -(buoy[0][line].conj() * buoy[which][line]).im);
    Measured {
        height: sum(&|buoy, line| buoy[0][line].norm_sqr()),
        slope: sum(&|buoy, line| buoy[1][line].norm_sqr() + buoy[2][line].norm_sqr()),
        towards: quad(1).into_iter().zip(quad(2)).map(|(x, z)| [x, z]).collect(),
    }
}

fn line_frequency(index: usize) -> f64 {
    TAU * (index + 1) as f64 / RECORD
}

/// Estimates the frequency of a spectrum's peak (rad/s) from its lines.
type Estimator = fn(&[f64]) -> f64;

/// What a record of a few minutes can say of the peak differs by how it is asked; all are asked of the input alike.
const ESTIMATORS: [(&str, Estimator); 3] = [
    ("centroid weighted around itself (a Gaussian of 25 %)", centroid),
    ("centroid of what exceeds .8 of the highest (Delft)", delft),
    ("centroid of the fourth power (Young 1995)", young),
];

fn tp(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let spectrum = WaveSpectrum::new(&fixtures::ocean(64).sea)?;
    let highest = 2.5 * spectrum.peak_frequency();
    let lines = (highest * RECORD / TAU) as usize;
    let input: Vec<f64> = (0..lines).map(|i| spectrum.frequency_density(line_frequency(i))).collect();
    for ratio in context.pick(&[1.5, 3.0, 6.0][..], &[1.5, 3.0, 6.0, 12.0]) {
        let cascades = vec![CascadeDesc::new(64, (ratio * TAU / spectrum.peak_wavenumber()) as f32)];
        let records = (0..SEEDS).map(|seed| {
            let cascades = cascades.clone();
            let desc = OceanDesc { cascades, seed, loop_time: RECORD, choppiness: 0.0, ..fixtures::ocean(64) };
            Ok(measure(&mut Ocean::new(desc)?, context.pick(24, 96), highest).height)
        });
        let records = records.collect::<Result<Vec<_>, CaseError>>()?;
        for (name, estimator) in ESTIMATORS {
            let errors = records.iter().map(|record| 100.0 * (estimator(&input) / estimator(record) - 1.0));
            let (worst, squares) = errors.fold((0.0f64, 0.0), |(worst, sum), e| (worst.max(e.abs()), sum + e * e));
            let row = Row::new("tp", name)
                .param("tile_over_peak_wavelength", *ratio)
                .param("seeds", SEEDS)
                .param("worst_seed_percent", (worst * 1e3).round() / 1e3)
                .error((squares / SEEDS as f64).sqrt(), "%", "the same estimate from the description; RMS over seeds");
            rows.push(if name == ESTIMATORS[0].0 { row.bound(3.0) } else { row });
        }
    }
    Ok(rows)
}

/// Centroid, of the lines by frequency, of `part(value)`.
fn mean_frequency<'a>(values: impl Iterator<Item = (usize, &'a f64)>, part: impl Fn(f64, f64) -> f64) -> f64 {
    let (sum, moment) = values.fold((0.0, 0.0), |(sum, moment), (i, value)| {
        let omega = line_frequency(i);
        let part = part(*value, omega);
        (sum + part, moment + part * omega)
    });
    moment / sum
}

fn centroid(values: &[f64]) -> f64 {
    let mut at = mean_frequency(values.iter().enumerate(), |value, _| value);
    for _ in 0..200 {
        let weight = |omega: f64| (-0.5 * ((omega / at - 1.0) / 0.25).powi(2)).exp();
        at = mean_frequency(values.iter().enumerate(), |value, omega| value * weight(omega));
    }
    at
}

fn delft(values: &[f64]) -> f64 {
    let smoothed = smooth(values, 12);
    let least = 0.8 * smoothed.iter().copied().fold(0.0, f64::max);
    mean_frequency(smoothed.iter().enumerate().filter(|(_, value)| **value > least), |value, _| value)
}

fn young(values: &[f64]) -> f64 {
    mean_frequency(smooth(values, 8).iter().enumerate(), |value, _| value.powi(4))
}

/// Running mean over `half` lines on either side.
fn smooth(values: &[f64], half: usize) -> Vec<f64> {
    (0..values.len())
        .map(|i| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(values.len()));
            values[from..to].iter().sum::<f64>() / (to - from) as f64
        })
        .collect()
}

fn moments(context: &Context) -> Result<Vec<Row>, CaseError> {
    let wind = |spreading| {
        let mut sea = SeaState::wind(10.0, 100e3, 0.6);
        sea.partitions[0].spreading = spreading;
        sea
    };
    let mut crossing = SeaState::wind(9.0, 60e3, 2.2);
    crossing.partitions.push(Partition { elongation: 0.6, ..Partition::swell(1.6, 11.0, 0.4) });
    let mut shallow = SeaState::tma(16.0, 200e3, -1.0, 12.0);
    shallow.partitions[0].spreading = Spreading::Hasselmann { wind_speed: 16.0 };
    let seas = [
        ("wind sea, cos^2s, s = 6", wind(Spreading::Cos2s { s: 6.0 })),
        ("wind sea, Donelan-Banner", wind(Spreading::DonelanBanner)),
        ("swell across a wind sea", crossing),
        ("TMA over 12 m, Hasselmann", shallow),
    ];
    let mut rows = Vec::new();
    for (name, sea) in seas {
        let desc = OceanDesc { loop_time: RECORD, choppiness: 0.0, seed: 4, ..OceanDesc::for_sea(sea, 128) };
        let spectrum = WaveSpectrum::new(&desc.sea)?;
        let highest = 3.0 * spectrum.peak_frequency();
        let k = dispersion::wavenumber(highest, spectrum.depth());
        // The cascades that hold waves of these frequencies.
        let held = Ocean::new(desc.clone())?.modes().iter().filter(|modes| modes.band[0] < k).count();
        let cascades = desc.cascades[..held].to_vec();
        let mut ocean = Ocean::new(OceanDesc { cascades, ..desc })?;
        let measured = measure(&mut ocean, context.pick(600, 2000), highest);
        let (made, input) = (figures(&measured), described(&spectrum, measured.height.len()));
        for (i, what) in ["variance", "Tm01", "Tm02", "spread"].into_iter().enumerate() {
            rows.push(
                Row::new("moments", name)
                    .param("of", what)
                    .param("input", (1e4 * input[i]).round() / 1e4)
                    .error(
                        100.0 * (made[i] / input[i] - 1.0).abs(),
                        "%",
                        "integral of the description, up to 3 peak frequencies",
                    )
                    .bound(3.0),
            );
        }
        let turned = (made[4] - input[4] + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        rows.push(
            Row::new("moments", name)
                .param("of", "mean direction")
                .param("input", (1e4 * input[4]).round() / 1e4)
                .error(turned.to_degrees().abs(), "degrees", "integral of the description, up to 3 peak frequencies")
                .bound(3.0),
        );
    }
    Ok(rows)
}

/// Variance, Tm01, Tm02, directional spread, mean direction, from the first Fourier coefficients of bands of lines
/// (Longuet-Higgins et al. 1963; spread after Kuik et al. 1988).
fn figures(measured: &Measured) -> [f64; 5] {
    let mut sums = [0.0; 5];
    let bands = measured.height.chunks(JOINED).zip(measured.slope.chunks(JOINED)).zip(measured.towards.chunks(JOINED));
    for (band, ((height, slope), towards)) in bands.enumerate() {
        let (energy, slopes): (f64, f64) = (height.iter().sum(), slope.iter().sum());
        let scale = energy / (energy * slopes).sqrt().max(1e-30);
        for (i, value) in height.iter().enumerate() {
            let omega = line_frequency(band * JOINED + i);
            sums[0] += value;
            sums[1] += value * omega;
            sums[2] += value * omega * omega;
        }
        sums[3] += scale * towards.iter().map(|t| t[0]).sum::<f64>();
        sums[4] += scale * towards.iter().map(|t| t[1]).sum::<f64>();
    }
    finish(sums)
}

fn finish([m0, m1, m2, x, z]: [f64; 5]) -> [f64; 5] {
    let first = x.hypot(z) / m0;
    [m0, TAU * m0 / m1, TAU * (m0 / m2).sqrt(), (2.0 * (1.0 - first)).sqrt(), z.atan2(x)]
}

/// The same of the description, by the midpoint rule over frequency (up to and with line `lines`) and direction.
fn described(spectrum: &WaveSpectrum, lines: usize) -> [f64; 5] {
    let (steps, sectors) = (1500, 256);
    let highest = line_frequency(lines - 1) + 0.5 * TAU / RECORD;
    let step = highest / f64::from(steps);
    let parts = (0..steps).into_par_iter().map(|i| {
        let omega = (f64::from(i) + 0.5) * step;
        let k = dispersion::wavenumber(omega, spectrum.depth());
        let area = k * step / dispersion::group_velocity(k, spectrum.depth()) * TAU / f64::from(sectors);
        let mut sums = [0.0; 5];
        for j in 0..sectors {
            let (sin, cos) = (TAU * f64::from(j) / f64::from(sectors)).sin_cos();
            let part = spectrum.wavenumber_density(k * cos, k * sin) * area;
            for (sum, factor) in sums.iter_mut().zip([1.0, omega, omega * omega, cos, sin]) {
                *sum += part * factor;
            }
        }
        sums
    });
    finish(parts.reduce(|| [0.0; 5], |a, b| std::array::from_fn(|i| a[i] + b[i])))
}

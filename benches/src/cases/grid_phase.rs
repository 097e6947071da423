//! Case `phase_9pt`: the speed of plane waves on a grid against that of the wave equation, by scheme and resolution, and
//! what a given error costs; a fourth-order scheme and the wave equation's own error in real water beside it.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::hint::black_box;

use wave_grid::{GridDesc, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, Timing, measure_together},
    fixtures,
};

/// See the module.
pub(super) const PHASE: Case = Case {
    name: "phase_9pt",
    about: "phase velocity of plane waves on the grid against c, worst over direction, and its range",
    plots: &[Plot {
        file: "phase_9pt",
        title: "Phase error against run time (beside the points: cells per wavelength)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("cells_per_wavelength"),
    }],
    run,
};

/// Cells per wavelength.
const POINTS: [f64; 9] = [4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 24.0, 32.0];
/// Cells along a side of what is measured, and of what is timed.
const SIDE: usize = 128;
const TIMED: usize = 256;
/// Steps over which a frequency is measured: nothing of the edges reaches the middle meanwhile.
const STEPS: usize = 40;
/// Of the 13-point scheme, just below its bound of 1/2.
const FOURTH_ORDER_A: f64 = 0.49;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let mut curves = Vec::new();
    let descs = [fixtures::grid(), fixtures::paper_grid()];
    let cell_ns = cell_step_ns(context, descs)?;
    for ((variant, desc), cell_ns) in ["9-point", "5-point"].into_iter().zip(descs).zip(cell_ns) {
        let mut grid = one_substep(desc, SIDE)?;
        let a = grid.stepping().a[0];
        let mut curve = Curve { a, cell_ns, errors: Vec::new() };
        for points in POINTS {
            let found = of_grid(&mut grid, points)?;
            curve.errors.push((points, found.worst));
            rows.push(curve.row(variant, points, &found, "scaled from ticks of 256^2, all threads"));
        }
        curves.push((variant, curve));
    }
    // No library code: the library's 9-point tick times the ratio of two plain loops.
    let cell_ns = curves[0].1.cell_ns.per(1.0 / fourth_order_over_nine(context));
    let mut curve = Curve { a: FOURTH_ORDER_A, cell_ns, errors: Vec::new() };
    for points in POINTS {
        let found = of_fourth_order(points);
        curve.errors.push((points, found.worst));
        rows.push(curve.row("13-point", points, &found, "9-point's times the ratio of plain loops on one thread"));
    }
    let [nine, five] = [&curves[0].1, &curves[1].1];
    for percent in [1.0, 0.3, 0.1] {
        for (variant, own) in [("9-point", nine), ("5-point", five)] {
            if let (Some(points), Some(other)) = (own.points_for(percent), curve.points_for(percent)) {
                rows.push(
                    Row::new("phase_9pt", format!("{variant} for {percent} %"))
                        .param("cells_per_wavelength", (points * 10.0).round() / 10.0)
                        .param("cells_per_wavelength_13_point", (other * 10.0).round() / 10.0)
                        .time(PERIOD, &own.period_ns(points))
                        .baseline("13-point for the same error", &curve.period_ns(other)),
                );
            }
        }
    }
    rows.extend(presets()?);
    rows.extend(model());
    Ok(rows)
}

const PERIOD: &str = "one wave period over 100 square wavelengths";

/// A scheme's errors by resolution.
struct Curve {
    a: f64,
    cell_ns: Timing,
    errors: Vec<(f64, f64)>,
}

impl Curve {
    fn period_ns(&self, points: f64) -> Timing {
        self.cell_ns.per(self.a.sqrt() / (100.0 * points.powi(3)))
    }

    fn row(&self, variant: &str, points: f64, found: &Found, timed: &str) -> Row {
        Row::new("phase_9pt", variant)
            .param("cells_per_wavelength", points)
            .param("a", (self.a * 1e4).round() / 1e4)
            .param("anisotropy_percent", (found.range * 1e4).round() / 1e4)
            .error(found.worst, "%", "speed c of the wave equation")
            .time(&format!("{PERIOD}, {timed}"), &self.period_ns(points))
    }

    /// The resolution that has an error, between the measured ones by powers.
    fn points_for(&self, percent: f64) -> Option<f64> {
        self.errors.windows(2).find_map(|two| {
            let [(p, e), (q, f)] = [two[0], two[1]];
            (f <= percent && percent <= e).then(|| p * (q / p).powf((e / percent).ln() / (e / f).ln()))
        })
    }
}

/// Worst error of the phase velocity over direction and the errors' range, percent.
struct Found {
    worst: f64,
    range: f64,
}

/// A standing plane wave obeys `z(n+1) + z(n-1) = 2 cos(Omega) z(n)` at every cell that the edges cannot reach yet,
/// whatever the scheme; Omega follows by least squares over the heights in the middle, which `heights` gives for a wave.
fn over_directions(
    a: f64,
    points: f64,
    mut heights: impl FnMut(&[f64]) -> Result<Vec<f64>, CaseError>,
) -> Result<Found, CaseError> {
    const DIRECTIONS: usize = 12;
    let k = TAU / points;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for direction in 0..=DIRECTIONS {
        let (sin, cos) = (FRAC_PI_4 * direction as f64 / DIRECTIONS as f64).sin_cos();
        let from_middle = |n: usize| n as f64 - (SIDE / 2) as f64;
        let wave: Vec<f64> = (0..SIDE * SIDE)
            .map(|at| (k * (cos * from_middle(at % SIDE) + sin * from_middle(at / SIDE))).cos())
            .collect();
        let (mut both, mut square) = (0.0, 0.0);
        for three in heights(&wave)?.windows(3) {
            both += three[1] * (three[0] + three[2]);
            square += three[1] * three[1];
        }
        let error = 100.0 * ((0.5 * both / square).acos() / (a.sqrt() * k) - 1.0);
        least = least.min(error);
        most = most.max(error);
    }
    Ok(Found { worst: least.abs().max(most.abs()), range: most - least })
}

const MIDDLE: usize = SIDE / 2 * (SIDE + 1);

fn of_grid(grid: &mut WaveGrid, points: f64) -> Result<Found, CaseError> {
    over_directions(grid.stepping().a[0], points, |wave| {
        let wave: Vec<f32> = wave.iter().map(|z| *z as f32).collect();
        grid.impose(&wave, &wave)?;
        let mut series = vec![1.0, 1.0];
        for _ in 0..STEPS {
            grid.tick();
            series.push(f64::from(grid.heights()[MIDDLE]));
        }
        Ok(series)
    })
}

/// A grid whose tick is one sub-step of that description.
fn one_substep(desc: GridDesc, side: usize) -> Result<WaveGrid, CaseError> {
    let tick = desc.stepping()?.dt as f32;
    Ok(WaveGrid::new(GridDesc { cells: [side as u32; 2], tick, substeps: Some(1), ..desc })?)
}

/// Time of a step of one cell, on all threads.
fn cell_step_ns(context: &Context, descs: [GridDesc; 2]) -> Result<[Timing; 2], CaseError> {
    let mut grids = [one_substep(descs[0], TIMED)?, one_substep(descs[1], TIMED)?];
    grids.iter_mut().for_each(|grid| grid.set_tile_skipping(false));
    let [one, other] = &mut grids;
    let timings = measure_together(context.effort, [&mut || one.tick(), &mut || other.tick()]);
    Ok(timings.map(|timing| timing.per((TIMED * TIMED) as f64)))
}

/// The bounds, at the `a` of the scenes' grids, and what the crate's default description has.
fn presets() -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let mut grid = one_substep(fixtures::grid(), SIDE)?;
    let a = grid.stepping().a[0];
    let found = of_grid(&mut grid, 8.0)?;
    let row = |what: &str| {
        Row::new("phase_9pt", format!("9-point, {what}"))
            .param("a", (a * 1e4).round() / 1e4)
            .param("cells_per_wavelength", 8.0)
    };
    rows.push(row("bound").error(found.worst, "%", "speed c of the wave equation").bound(0.85));
    rows.push(row("anisotropy").error(found.range, "%", "itself over direction, greatest less least").bound(0.05));
    let mut grid = one_substep(GridDesc::default(), SIDE)?;
    let found = of_grid(&mut grid, 8.0)?;
    rows.push(
        Row::new("phase_9pt", "9-point, GridDesc::default()")
            .param("a", (grid.stepping().a[0] * 1e4).round() / 1e4)
            .param("cells_per_wavelength", 8.0)
            .error(found.worst, "%", "speed c of the wave equation"),
    );
    Ok(rows)
}

/// By how much one speed for all waves misses those of water: what any scheme's error is to be held against.
fn model() -> Vec<Row> {
    let row =
        |variant: &str, percent: f64| Row::new("phase_9pt", variant).error(percent, "%", "omega^2 = g k tanh(k h)");
    // Phase speeds grow as the root of the wavelength; c fits the middle of an octave.
    let deep = 100.0 * (2f64.powf(0.25) - 1.0);
    let shallow = |kh: f64| 100.0 * ((kh / kh.tanh()).sqrt() - 1.0);
    vec![
        row("model, deep water, an octave", deep)
            .note("the wave equation itself, at the ends of one octave of wavelengths"),
        row("model, shallow, 20 depths a wave", shallow(TAU / 20.0)).note("the wave equation itself with c^2 = g h"),
    ]
}

/// The 13-point modified-equation scheme, fourth order in space and time: `z+ = 2 z - z- + a L4 z + a^2/12 L L z` with L
/// the 5-point Laplacian and L4 the cross of 9 points; in one pass, with the weights of centre, (1, 0), (1, 1) and (2, 0).
///
/// `L4 + a/12 L L` is the isotropic 9-point Laplacian less `(1 - a)/12 L L`. So it would be a correction to the library's
/// scheme that could fade out, `-1/12 L m (1 - a) L z` with `m` from 1 to 0, towards walls and borders, at a <= 1/2.
fn fourth_order_weights(a: f64) -> [f64; 4] {
    let b = a * a / 12.0;
    [2.0 - 5.0 * a + 20.0 * b, 4.0 / 3.0 * a - 8.0 * b, 2.0 * b, -a / 12.0 + b]
}

fn of_fourth_order(points: f64) -> Found {
    let weights = fourth_order_weights(FOURTH_ORDER_A);
    let heights = |wave: &[f64]| {
        let (mut now, mut before) = (wave.to_vec(), wave.to_vec());
        let mut series = vec![1.0, 1.0];
        for _ in 0..STEPS {
            thirteen(SIDE, &mut now, &mut before, weights);
            series.push(now[MIDDLE]);
        }
        Ok(series)
    };
    over_directions(FOURTH_ORDER_A, points, heights).unwrap_or(Found { worst: f64::NAN, range: f64::NAN })
}

/// Time of a step of the 13-point loop over that of the 9-point one written alike, f32, one thread.
fn fourth_order_over_nine(context: &Context) -> f64 {
    let weights = fourth_order_weights(FOURTH_ORDER_A).map(|w| w as f32);
    let calm = || vec![0.0f32; TIMED * TIMED];
    let [mut a, mut b, mut c, mut d] = [calm(), calm(), calm(), calm()];
    let [thirteen, nine] = measure_together(
        context.effort,
        [&mut || thirteen(TIMED, &mut a, &mut b, weights), &mut || nine(TIMED, &mut c, &mut d, [0.1, 0.4, 0.1])],
    );
    thirteen.median_ns / nine.median_ns
}

trait Number: Copy + std::ops::Add<Output = Self> + std::ops::Sub<Output = Self> + std::ops::Mul<Output = Self> {}
impl Number for f32 {}
impl Number for f64 {}

fn thirteen<T: Number>(side: usize, now: &mut Vec<T>, before: &mut Vec<T>, [middle, edge, corner, far]: [T; 4]) {
    for j in 2..side - 2 {
        let row = |j: usize| &now[j * side..(j + 1) * side];
        let [top, above, here, below, bottom] = [row(j - 2), row(j - 1), row(j), row(j + 1), row(j + 2)];
        let out = &mut before[j * side..(j + 1) * side];
        for i in 2..side - 2 {
            let edges = here[i - 1] + here[i + 1] + above[i] + below[i];
            let corners = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
            let far_ones = here[i - 2] + here[i + 2] + top[i] + bottom[i];
            out[i] = middle * here[i] + edge * edges + corner * corners + far * far_ones - out[i];
        }
    }
    std::mem::swap(now, before);
    black_box(now);
}

fn nine<T: Number>(side: usize, now: &mut Vec<T>, before: &mut Vec<T>, [middle, edge, corner]: [T; 3]) {
    for j in 2..side - 2 {
        let row = |j: usize| &now[j * side..(j + 1) * side];
        let [above, here, below] = [row(j - 1), row(j), row(j + 1)];
        let out = &mut before[j * side..(j + 1) * side];
        for i in 2..side - 2 {
            let edges = here[i - 1] + here[i + 1] + above[i] + below[i];
            let corners = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
            out[i] = middle * here[i] + edge * edges + corner * corners - out[i];
        }
    }
    std::mem::swap(now, before);
    black_box(now);
}

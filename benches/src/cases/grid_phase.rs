//! Case `phase_9pt`: the speed of plane waves on a grid against that of the wave equation.

use std::f64::consts::{FRAC_PI_4, TAU};

use wave_grid::{GridDesc, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, Timing, measure},
    fixtures,
};

/// See the module.
pub(super) const PHASE: Case = Case {
    name: "phase_9pt",
    about: "phase velocity of plane waves on the grid against c, worst over direction",
    plots: &[Plot {
        file: "phase_9pt",
        title: "Phase error against cost (beside the points: cells per wavelength)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("cells_per_wavelength"),
    }],
    run,
};

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let nine = GridDesc { cells: [256; 2], ..fixtures::grid() };
    let five = GridDesc { cells: [256; 2], ..fixtures::paper_grid() };
    let mut rows = Vec::new();
    for (variant, desc) in [("9-point", nine), ("5-point", five)] {
        let cell_step_ns = cell_step_ns(context, desc)?;
        for points in [6.0, 8.0, 10.0, 16.0, 32.0] {
            let (worst, anisotropy, a) = phase_error(desc, points)?;
            // One period of a wave over 100 square wavelengths.
            let steps = points / a.sqrt();
            let timing = cell_step_ns.per(1.0 / (100.0 * points * points * steps));
            let mut row = Row::new("phase_9pt", variant)
                .param("cells_per_wavelength", points)
                .param("a", (a * 1e4).round() / 1e4)
                .param("anisotropy_percent", (anisotropy * 1e4).round() / 1e4)
                .error(worst, "%", "speed c of the wave equation")
                .time("one wave period over 100 square wavelengths, scaled from ticks of 256^2", &timing);
            if variant == "9-point" && points == 8.0 {
                row = row.bound(0.85);
            }
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Largest error of the phase velocity over direction and its range, percent, and the `a` of the grid.
///
/// A standing plane wave obeys `z(n+1) + z(n-1) = 2 cos(Omega) z(n)` at every cell that its border cannot reach
/// yet, whatever the scheme; Omega follows by least squares over some steps at the middle of the window.
fn phase_error(desc: GridDesc, cells_per_wavelength: f64) -> Result<(f64, f64, f64), CaseError> {
    const STEPS: usize = 40;
    const DIRECTIONS: usize = 12;
    let mut grid = WaveGrid::new(desc)?;
    let stepping = grid.stepping();
    if stepping.substeps != 1 {
        return Err("the grid's tick must be one sub-step here".into());
    }
    let [nx, nz] = desc.cells.map(|n| n as usize);
    let (middle_x, middle_z) = (nx / 2, nz / 2);
    let k = TAU / cells_per_wavelength;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for direction in 0..=DIRECTIONS {
        let (sin, cos) = (FRAC_PI_4 * direction as f64 / DIRECTIONS as f64).sin_cos();
        let wave: Vec<f32> = (0..nx * nz)
            .map(|at| {
                let (x, z) = ((at % nx) as f64 - middle_x as f64, (at / nx) as f64 - middle_z as f64);
                (k * (cos * x + sin * z)).cos() as f32
            })
            .collect();
        grid.impose(&wave, &wave)?;
        let mut series = vec![1.0, 1.0];
        for _ in 0..STEPS {
            grid.tick();
            series.push(f64::from(grid.heights()[middle_z * nx + middle_x]));
        }
        let (mut both, mut square) = (0.0, 0.0);
        for three in series.windows(3) {
            both += three[1] * (three[0] + three[2]);
            square += three[1] * three[1];
        }
        let omega = (0.5 * both / square).acos();
        let error = 100.0 * (omega / (stepping.a[0].sqrt() * k) - 1.0);
        least = least.min(error);
        most = most.max(error);
    }
    Ok((least.abs().max(most.abs()), most - least, stepping.a[0]))
}

/// Time of a step of one cell, on all threads.
fn cell_step_ns(context: &Context, desc: GridDesc) -> Result<Timing, CaseError> {
    let mut grid = WaveGrid::new(desc)?;
    grid.set_tile_skipping(false);
    let cells = f64::from(desc.cells[0] * desc.cells[1]);
    Ok(measure(context.effort, || grid.tick()).per(cells))
}

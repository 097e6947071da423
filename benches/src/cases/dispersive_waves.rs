//! Case `dispersion_waves`: plane waves that run on a grid of the dispersive scheme, against linear theory.

use std::f64::consts::{PI, SQRT_2, TAU};

use wave_grid::{Border, GridDesc, Scheme, WaveGrid};

use crate::evidence::{Case, CaseError, Context, Row};

/// See the module.
pub(super) const WAVES: Case = Case {
    name: "dispersion_waves",
    about: "frequency of standing plane waves on a periodic grid of the dispersive scheme against linear theory",
    plots: &[],
    run,
};

/// Cells of 0.5 m at 1/60 s.
const DESC: GridDesc = GridDesc {
    scheme: Scheme::Dispersive,
    border: Border::Periodic,
    substeps: Some(1),
    cell_size: [0.5; 2],
    cells: [256; 2],
    wave_speed: 6.0,
    depth: f32::INFINITY,
    damping: 0.0,
    tick: 1.0 / 60.0,
};

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let deep = f64::INFINITY;
    for (depth, bound, lengths) in [
        (deep, 0.7, context.pick(&[6.0, 16.0, 64.0][..], &[6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0])),
        (19.7, 1.1, context.pick(&[][..], &[6.0, 16.0, 48.0, 128.0])),
        (4.83, 1.1, context.pick(&[10.0, 48.0][..], &[6.0, 10.0, 16.0, 48.0, 128.0])),
        (1.5, 1.1, context.pick(&[8.0][..], &[6.0, 8.0, 16.0, 48.0, 128.0])),
    ] {
        for &length in lengths {
            for diagonal in [false, true] {
                // Cells that a wave takes along either axis.
                let side = if diagonal { (length * SQRT_2).ceil() } else { length };
                let length = if diagonal { side / SQRT_2 } else { side };
                let error = 100.0 * (turn(side as usize, diagonal, length, depth)? - 1.0);
                let row = Row::new("dispersion_waves", if diagonal { "along a diagonal" } else { "along an axis" })
                    .param("cells_per_wavelength", (length * 10.0).round() / 10.0)
                    .error(error.abs(), "%", "linear theory, w^2 = g k tanh(k h)")
                    .bound(bound);
                rows.push(if depth < deep { row.param("depth_cells", depth) } else { row });
            }
        }
    }
    Ok(rows)
}

/// Frequency of a standing wave over that of linear theory. Over a window of Hann's the spectrum of its amplitude has its
/// peak there; other branches, if there are any, lie far off.
fn turn(side: usize, diagonal: bool, length: f64, depth: f64) -> Result<f64, CaseError> {
    let period = |least: usize| side * least.div_ceil(side);
    let (nx, nz) = (period(46), if diagonal { period(46) } else { 46 });
    let depth_m = (depth * f64::from(DESC.cell_size[0])) as f32;
    let mut grid = WaveGrid::new(GridDesc { cells: [nx as u32 + 2, nz as u32 + 2], depth: depth_m, ..DESC })?;
    grid.set_tile_skipping(false);
    let k = TAU / length;
    let expected = (grid.stepping().a[0] * k * (k * depth).tanh()).sqrt();
    let wave: Vec<f64> = (0..(nx + 2) * (nz + 2))
        .map(|at| {
            let (i, j) = (at % (nx + 2), at / (nx + 2));
            (TAU * (i + if diagonal { j } else { 0 }) as f64 / side as f64).cos()
        })
        .collect();
    let scaled = |factor: f64| -> Vec<f32> { wave.iter().map(|z| (0.01 * factor * z) as f32).collect() };
    grid.impose(&scaled(1.0), &scaled(expected.cos()))?;
    let steps = (30.0 * TAU / expected) as usize;
    let mut amplitudes = Vec::new();
    for _ in 0..steps {
        grid.tick();
        let own = (1..=nz).flat_map(|j| j * (nx + 2) + 1..j * (nx + 2) + 1 + nx);
        amplitudes.push(own.map(|at| f64::from(grid.heights()[at]) * wave[at]).sum::<f64>());
    }
    let power = |frequency: f64| {
        let (mut re, mut im) = (0.0, 0.0);
        for (n, amplitude) in amplitudes.iter().enumerate() {
            let window = 1.0 - (TAU * (n as f64 + 0.5) / steps as f64).cos();
            let (sin, cos) = (frequency * n as f64).sin_cos();
            re += window * amplitude * cos;
            im += window * amplitude * sin;
        }
        re * re + im * im
    };
    // The main lobe is four frequencies of the window wide; look for its top in an interval that shrinks about it.
    let mut middle = expected;
    let mut reach = PI / steps as f64;
    while reach > 1e-6 * expected {
        let five = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|part| middle + part * reach);
        middle = five.into_iter().max_by(|a, b| power(*a).total_cmp(&power(*b))).unwrap_or(middle);
        reach *= 0.5;
    }
    Ok(middle / expected)
}

//! Case `pml_moving`: what the border sends back in a window that follows a source.

use glam::DVec2;
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use crate::evidence::{Axis, Case, CaseError, Context, Plot, Row, measure};

/// See the module.
pub(super) const MOVING: Case = Case {
    name: "pml_moving",
    about: "what the border of a window that follows a source sends back, against a larger domain that stands",
    plots: &[Plot {
        file: "pml_moving",
        title: "Moving border: error over the peak at the border against speed over the waves'",
        x: Axis::Param("speed_over_c"),
        y: Axis::Error,
        label: None,
    }],
    run: moving,
};

const INTERIOR: i64 = 128;
const STEPS: usize = 420;
/// Speeds over c, and what the layers of the prototypes sent back at a = 0.45, 5-point, width 16: oscillating, dipole.
const BEFORE: [(f64, [f64; 2]); 5] = [
    (0.1, [-24.0, -15.0]),
    (0.25, [-41.0, -11.0]),
    (0.5, [-41.0, -9.0]),
    (0.75, [-50.0, -22.0]),
    (1.0, [-73.0, -72.0]),
];

struct Run {
    variant: String,
    width: u32,
    matched: bool,
    grid: WaveGrid,
    worst: f64,
}

fn desc(scheme: Scheme, cells: [u32; 2], width: u32) -> GridDesc {
    let a = if scheme == Scheme::NinePoint { 0.7f32 } else { 0.45 };
    let (wave_speed, tick) = (a.sqrt() * 100.0, 0.01);
    GridDesc {
        cells,
        cell_size: [1.0; 2],
        wave_speed,
        scheme,
        border: Border::Absorbing { width },
        tick,
        substeps: Some(1),
        ..Default::default()
    }
}

fn moving(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (scheme, five) in [(Scheme::FivePoint, true), (Scheme::NinePoint, false)] {
        let widths: &[u32] = context.pick(if five { &[16] } else { &[12] }, &[8, 12, 16, 20]);
        for (speed, before) in BEFORE {
            for (kind, bound) in ["oscillating", "dipole"].into_iter().zip(before) {
                let mut runs = Vec::new();
                for &width in widths {
                    for matched in [true, false] {
                        let stencil = if five { "5-point" } else { "9-point" };
                        let layer = if matched { "" } else { ", as on the GPU" };
                        let variant = format!("{kind}, {stencil}, width {width}{layer}");
                        let cells = INTERIOR as u32 + 2 * (width + 1);
                        let mut grid = WaveGrid::new(desc(scheme, [cells; 2], width))?;
                        grid.set_matched_motion(matched);
                        runs.push(Run { variant, width, matched, grid, worst: 0.0 });
                    }
                }
                let peak = follow(&mut runs, scheme, speed, kind == "dipole")?;
                for mut run in runs {
                    let timing = measure(context.effort, || run.grid.tick());
                    let decibels = 20.0 * (run.worst / peak).log10();
                    let mut row = Row::new("pml_moving", &*run.variant)
                        .param("source", kind)
                        .param("speed_over_c", speed)
                        .param("width", run.width)
                        .error(decibels, "dB", "a larger domain; over the peak at the border")
                        .time("a tick of the whole window", &timing);
                    // The prototypes' source was a force; for this one their own layer is 5 dB worse at 0.75.
                    let harder = speed == 0.75 && kind == "oscillating";
                    if run.matched && five && run.width == 16 {
                        row = if harder {
                            row.note("-50 dB before, for a force; no bound here")
                        } else {
                            row.bound(bound)
                        };
                    }
                    rows.push(row);
                }
            }
        }
    }
    Ok(rows)
}

/// Steps all runs beside a domain whose border no wave reaches and returns from; returns the peak at the interior's rim.
fn follow(runs: &mut [Run], scheme: Scheme, speed: f64, dipole: bool) -> Result<f64, CaseError> {
    let courant = f64::from(desc(scheme, [64; 2], 12).wave_speed) / 100.0;
    let step_length = speed * courant;
    let path = STEPS as f64 * step_length;
    let around = INTERIOR as f64 + STEPS as f64 * courant + 48.0;
    let mut large = WaveGrid::new(desc(scheme, [(around + path) as u32, around as u32], 12))?;
    large.center_on(DVec2::new((0.5 * path).round(), 0.0));
    large.set_tile_skipping(false);
    for run in &mut *runs {
        run.grid.set_tile_skipping(false);
    }
    let mut peak = 0.0f64;
    for step in 0..STEPS {
        let at = DVec2::new(step_length * step as f64, 0.0);
        runs.iter_mut().for_each(|run| run.grid.center_on(at));
        for grid in runs.iter_mut().map(|run| &mut run.grid).chain([&mut large]) {
            let start = (step as f32 / 48.0).min(1.0);
            let mut add = |x: f64, volume: f32| {
                let center = (at + DVec2::new(x, 0.0)).as_vec2();
                grid.add(Source::Displacement { center, radius: 4.0, volume })
            };
            if dipole {
                add(2.0, 0.1 * start);
                add(-2.0, -0.1 * start);
            } else {
                add(0.0, start * (std::f32::consts::TAU * step as f32 / 24.0).sin());
            }
            grid.tick();
        }
        for run in &mut *runs {
            // One cell within the layer's inner edge, wherever the window leans.
            let corner = run.grid.window().corner.map(|c| c + i64::from(run.width) + 2);
            let last = INTERIOR - 3;
            for j in 0..=last {
                for i in 0..=last {
                    let cell = [corner[0] + i, corner[1] + j];
                    let truth = height(&large, cell);
                    run.worst = run.worst.max((height(&run.grid, cell) - truth).abs());
                    if i == 0 || j == 0 || i == last || j == last {
                        peak = peak.max(truth.abs());
                    }
                }
            }
        }
    }
    Ok(peak)
}

/// Height of a cell of the world.
fn height(grid: &WaveGrid, cell: [i64; 2]) -> f64 {
    let window = grid.window();
    let [x, z] = [cell[0] - window.corner[0], cell[1] - window.corner[1]];
    f64::from(grid.heights()[(z * i64::from(window.cells[0]) + x) as usize])
}

//! Case `mach_wedge`: the half-angle of the wake of a small fast source against asin(c/U).

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};
use rustfft::num_complex::Complex;
use wave_grid::{GridDesc, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    fixtures,
};

/// See the module.
pub(super) const WEDGE: Case = Case {
    name: "mach_wedge",
    about: "half-angle of the wake that a small fast source draws in the window that follows it, against asin(c/U)",
    plots: &[Plot {
        file: "mach_wedge",
        title: "Half-angle of the wake (one line: the estimator on the exact solution)",
        x: Axis::Param("speed_over_c"),
        y: Axis::Error,
        label: None,
    }],
    run,
};

/// Cells along a side of the window.
const CELLS: usize = 256;
/// Longer than it takes the wake to fill the window.
const TICKS: usize = 480;
/// Radius of the source, cells, without the half a cell and a half that the library softens it by.
const RADIUS: f64 = 3.0;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let desc = GridDesc { cells: [CELLS as u32; 2], ..fixtures::grid() };
    let stepping = desc.stepping()?;
    let courant = stepping.a[0].sqrt() * f64::from(stepping.substeps);
    let mut rows = Vec::new();
    for &ratio in context.pick(&[1.2, 1.6, 3.0][..], &[1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0]) {
        let truth = (1.0f64 / ratio).asin().to_degrees();
        let row = |variant: String, angle: f64| {
            Row::new("mach_wedge", variant)
                .param("speed_over_c", ratio)
                .param("degrees", (angle * 100.0).round() / 100.0)
                .param("asin_c_over_u", (truth * 100.0).round() / 100.0)
                .error((angle - truth).abs(), "degrees", "asin(c/U)")
        };
        for heading in [0.0, 0.5] {
            let grid = sail(desc, ratio, heading)?;
            let place = |d: f64, y: f64| {
                let boat = DVec2::from_angle(heading) * (TICKS as f64 * ratio * courant);
                boat + DVec2::from_angle(heading).rotate(DVec2::new(-d, y))
            };
            let angle = half_angle(ratio, |d, y| cubic(&grid, place(d, y)));
            rows.push(row(format!("heading {heading} rad"), angle).param("heading_rad", heading).bound(1.0));
        }
        for &softness in context.pick(&[3.0][..], &[2.0, 4.0]) {
            let angle = half_angle(ratio, |d, y| exact(courant, ratio, softness, d, y));
            rows.push(row("exact solution, same estimator".to_owned(), angle).param("softness_cells", softness));
        }
    }
    Ok(rows)
}

/// The estimator: at distances d behind the source the crest's place y on both sides, a straight line through each
/// side's; half the angle between the lines, degrees. Crests run beside the wedge's edge at a distance of the source's
/// size, which is the lines' offset and not in their angle.
fn half_angle(ratio: f64, height: impl Fn(f64, f64) -> f64) -> f64 {
    const ROWS: usize = 16;
    const WIDEST: f64 = 92.0;
    // Where the wake is well inside the window; only the choice of rows knows the angle looked for.
    let farthest = WIDEST.min((WIDEST - 8.0) * (ratio * ratio - 1.0).sqrt());
    let nearest = (0.4 * farthest).max(24.0);
    let side = |sign: f64| {
        let crests: Vec<[f64; 2]> = (0..ROWS)
            .map(|row| nearest + (farthest - nearest) * row as f64 / (ROWS - 1) as f64)
            .map(|d| [d, crest(|y| height(d, sign * y), WIDEST)])
            .collect();
        let mean = [0, 1].map(|k| crests.iter().map(|p| p[k]).sum::<f64>() / ROWS as f64);
        let product = |k: usize| crests.iter().map(|p| (p[0] - mean[0]) * (p[k] - mean[k])).sum::<f64>();
        (product(1) / product(0)).atan()
    };
    (0.5 * (side(1.0) + side(-1.0))).to_degrees()
}

/// Place of the greatest height between 0 and `widest`, a parabola through three samples.
fn crest(height: impl Fn(f64) -> f64, widest: f64) -> f64 {
    const STEP: f64 = 1.0;
    let heights: Vec<f64> = (0..=(widest / STEP) as usize).map(|i| height(i as f64 * STEP)).collect();
    let top = (1..heights.len() - 1).max_by(|i, j| heights[*i].total_cmp(&heights[*j])).unwrap_or(1);
    let [before, at, after] = [heights[top - 1], heights[top], heights[top + 1]];
    let bend = before - 2.0 * at + after;
    let aside = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    (top as f64 + aside) * STEP
}

/// A boat that pushes water up where it is and lets it down where it was, its window after it.
fn sail(desc: GridDesc, ratio: f64, heading: f64) -> Result<WaveGrid, CaseError> {
    let mut grid = WaveGrid::new(desc)?;
    let h = f64::from(desc.cell_size[0]);
    let step = DVec2::from_angle(heading) * ratio * f64::from(desc.wave_speed) * f64::from(desc.tick);
    for tick in 1..=TICKS {
        let place = step * tick as f64;
        grid.center_on(place);
        grid.set_origin(place);
        for (center, volume) in [(Vec2::ZERO, 0.02), (-step.as_vec2(), -0.02)] {
            if !grid.add(Source::Displacement { center, radius: (RADIUS * h) as f32, volume }) {
                return Err("a source was dropped".into());
            }
        }
        grid.tick();
    }
    Ok(grid)
}

/// Height at a world place in cells, by Catmull and Rom's cubic.
fn cubic(grid: &WaveGrid, place: DVec2) -> f64 {
    let window = grid.window();
    let at = [0, 1].map(|k| place[k] - window.corner[k] as f64 - 0.5);
    let weights = |x: f64| {
        let t = x - x.floor();
        let (t2, t3) = (t * t, t * t * t);
        [2.0 * t2 - t - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2].map(|w| 0.5 * w)
    };
    let mut sum = 0.0;
    for (j, wz) in weights(at[1]).into_iter().enumerate() {
        for (i, wx) in weights(at[0]).into_iter().enumerate() {
            let cell = (at[1].floor() as usize + j - 1) * CELLS + at[0].floor() as usize + i - 1;
            sum += wx * wz * f64::from(grid.heights()[cell]);
        }
    }
    sum
}

/// The same boat on water without cells: the sum over ticks of the waves of `b / (2 pi (b^2 + r^2)^(3/2))`, volume 1, let
/// go at rest. Its transform is e^(-b k), so with s = b + i c t they are `Re[s / (s^2 + r^2)^(3/2)] / 2 pi`.
fn exact(courant: f64, ratio: f64, b: f64, d: f64, y: f64) -> f64 {
    let step = ratio * courant;
    let waves = |r2: f64, ct: f64| {
        let s = Complex::new(b, ct);
        let square = s * s + r2;
        (s / (square * square.sqrt())).re / TAU
    };
    // Ticks ago; the last source is a tick old.
    (1..=TICKS)
        .map(|age| {
            let behind = (age - 1) as f64 * step - d;
            let ct = age as f64 * courant;
            waves(behind * behind + y * y, ct) - waves((behind + step).powi(2) + y * y, ct)
        })
        .sum()
}

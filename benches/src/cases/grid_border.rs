//! Cases `pml_pulse` (what the border sends back) and `shift_exact` (a moving window leaves the water alone).

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const PML: Case = Case {
    name: "pml_pulse",
    about: "what the absorbing border sends back of a Ricker pulse, against a larger domain",
    plots: &[Plot {
        file: "pml_pulse",
        title: "Border: reflection against the time of a tick (beside the points: width in cells)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("width"),
    }],
    run: pulse,
};

/// See the module.
pub(super) const SHIFT: Case = Case {
    name: "shift_exact",
    about: "heights in the overlap before and after the window moves",
    plots: &[],
    run: shift,
};

/// Cells along a side without the border.
const INTERIOR: usize = 128;
/// Wavelength at the pulse's peak frequency, cells.
const WAVELENGTH: f64 = 10.0;

fn scene(scheme: Scheme, width: u32, cells: usize) -> GridDesc {
    let scene = if scheme == Scheme::NinePoint { fixtures::grid() } else { fixtures::paper_grid() };
    GridDesc { cells: [cells as u32; 2], border: Border::Absorbing { width }, ..scene }
}

fn pulse(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scheme) in [("9-point", Scheme::NinePoint), ("5-point", Scheme::FivePoint)] {
        for width in context.pick(&[8, 12, 16][..], &[4, 6, 8, 10, 12, 16, 20]) {
            let cells = INTERIOR + 2 * (*width as usize + 1);
            let mut small = WaveGrid::new(scene(scheme, *width, cells))?;
            // Nothing comes back from this one's border before the run ends.
            let mut large = WaveGrid::new(scene(scheme, *width, 512))?;
            let decibels = reflection(&mut small, &mut large);
            small.set_tile_skipping(false);
            let timing = measure(context.effort, || small.tick());
            let mut row = Row::new("pml_pulse", variant)
                .param("width", *width)
                .param("interior_cells", INTERIOR)
                .param("wavelength_cells", WAVELENGTH)
                .param("a", (small.stepping().a[0] * 1e4).round() / 1e4)
                .error(decibels, "dB", "512^2 domain; over the peak at the border")
                .time("a tick of the whole window", &timing);
            if scheme == Scheme::NinePoint && *width == 12 {
                row = row.bound(-75.0);
            }
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Largest difference in the interior over the largest height at its rim, decibels.
pub(super) fn reflection(small: &mut WaveGrid, large: &mut WaveGrid) -> f64 {
    // Quiet tiles differ by up to the height that counts as quiet, which is more than the border sends back.
    small.set_tile_skipping(false);
    large.set_tile_skipping(false);
    let a = small.stepping().a[0];
    let substeps = f64::from(small.stepping().substeps);
    // Peak frequency per tick, and the centre of the pulse late enough that it starts from nothing.
    let frequency = substeps * a.sqrt() / WAVELENGTH;
    let delay = 1.5 / frequency;
    let travel = (2.5 * INTERIOR as f64) / (substeps * a.sqrt());
    let volume = small.desc().cell_size[0].powi(2);
    let (mut worst, mut peak) = (0.0f64, 0.0f64);
    for tick in 0..(2.0 * delay + travel) as usize {
        let x = (std::f64::consts::PI * frequency * (tick as f64 - delay)).powi(2);
        let ricker = ((1.0 - 2.0 * x) * (-x).exp()) as f32;
        for grid in [&mut *small, &mut *large] {
            if tick as f64 <= 2.0 * delay {
                grid.add(Source::Displacement { center: Vec2::ZERO, radius: 0.0, volume: volume * ricker });
            }
            grid.tick();
        }
        for j in 0..INTERIOR {
            for i in 0..INTERIOR {
                let truth = interior(large, i, j);
                worst = worst.max(f64::from((interior(small, i, j) - truth).abs()));
                if i == 0 || j == 0 || i == INTERIOR - 1 || j == INTERIOR - 1 {
                    peak = peak.max(f64::from(truth.abs()));
                }
            }
        }
    }
    20.0 * (worst / peak).log10()
}

/// Height of cell (i, j) of the interior that both windows share.
fn interior(grid: &WaveGrid, i: usize, j: usize) -> f32 {
    let [nx, nz] = grid.desc().cells.map(|n| n as usize);
    let (rim_x, rim_z) = ((nx - INTERIOR) / 2, (nz - INTERIOR) / 2);
    grid.heights()[(j + rim_z) * nx + i + rim_x]
}

fn shift(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scheme) in [("9-point", Scheme::NinePoint), ("5-point", Scheme::FivePoint)] {
        let desc = scene(scheme, 12, 256);
        let mut grid = WaveGrid::new(desc)?;
        let mut random = Random::new(7);
        let mut worst = 0.0f64;
        let moves = context.pick(40, 400);
        for _ in 0..moves {
            disturb(&mut grid, &mut random);
            let still = grid.clone();
            // Up to 1.5 times the speed of the waves, to any side, by any fraction of a cell.
            let h = f64::from(desc.cell_size[0]);
            let middle = middle(&grid);
            grid.center_on(middle + DVec2::new(random.within(-3.0, 3.0), random.within(-3.0, 3.0)) * h);
            // The outermost ring of either window is a wall.
            worst = worst.max(difference(&still, &grid, 1));
            // The past moved along if the next tick agrees too, away from what came in at the border.
            let mut next_still = still.clone();
            next_still.tick();
            grid.tick();
            worst = worst.max(difference(&next_still, &grid, 24));
        }
        rows.push(
            Row::new("shift_exact", variant)
                .param("moves", moves)
                .param("cells", desc.cells[0])
                .error(worst, "m", "the same world cells in a window that stays")
                .bound(0.0),
        );
    }
    Ok(rows)
}

fn middle(grid: &WaveGrid) -> DVec2 {
    let window = grid.window();
    window.world_corner() + DVec2::from(window.cells.map(f64::from)) * 0.5 * f64::from(window.cell_size[0])
}

/// Some waves at a random place in the window, and time for them to spread.
fn disturb(grid: &mut WaveGrid, random: &mut Random) {
    let place = middle(grid) + DVec2::new(random.within(-8.0, 8.0), random.within(-8.0, 8.0));
    grid.add(Source::Displacement { center: place.as_vec2(), radius: 0.5, volume: 0.1 });
    for _ in 0..8 {
        grid.tick();
    }
}

/// Largest difference over the world cells of both windows, but for a margin of cells.
fn difference(one: &WaveGrid, other: &WaveGrid, margin: i64) -> f64 {
    let (a, b) = (one.window(), other.window());
    let [nx, nz] = a.cells.map(i64::from);
    let (dx, dz) = (b.corner[0] - a.corner[0], b.corner[1] - a.corner[1]);
    let mut worst = 0.0f64;
    for j in dz.max(0) + margin..nz + dz.min(0) - margin {
        for i in dx.max(0) + margin..nx + dx.min(0) - margin {
            let (at_a, at_b) = ((j * nx + i) as usize, ((j - dz) * nx + i - dx) as usize);
            worst = worst.max(f64::from((one.heights()[at_a] - other.heights()[at_b]).abs()));
        }
    }
    worst
}

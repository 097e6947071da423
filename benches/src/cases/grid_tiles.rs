//! Case `grid_tiles`: a tick of the CPU grid against the share of tiles that hold waves, and what leaving the others out changes.

use glam::Vec2;
use wave_grid::{Border, GridDesc, QUIET_HEIGHT, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure},
    fixtures,
};

/// See the module.
pub(super) const TILES: Case = Case {
    name: "grid_tiles",
    about: "a tick of the CPU grid against the share of tiles that are stepped; heights against stepping all",
    plots: &[Plot {
        file: "grid_tiles",
        title: "A tick on the CPU: time against stepped tiles",
        x: Axis::Param("percent_active"),
        y: Axis::Time,
        label: Some("percent_active"),
    }],
    run,
};

const CELLS: u32 = 512;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = vec![skipped()?];
    for &percent in context.pick(&[0u32, 5, 50, 100][..], &[0, 1, 2, 5, 10, 20, 35, 50, 70, 100]) {
        // Waves so slow that they stay where they are during a measurement.
        let desc = GridDesc {
            cells: [CELLS; 2],
            wave_speed: 0.05,
            substeps: Some(1),
            border: Border::Absorbing { width: 4 },
            ..fixtures::grid()
        };
        let mut grid = WaveGrid::new(desc)?;
        let side = (f64::from(CELLS) * (f64::from(percent) / 100.0).sqrt()) as u32;
        let mut random = fixtures::Random::new(3);
        let within = |at: u32| at % CELLS < side && at / CELLS < side;
        let heights: Vec<f32> =
            (0..CELLS * CELLS).map(|at| if within(at) { random.within(-1e-3, 1e-3) as f32 } else { 0.0 }).collect();
        grid.impose(&heights, &heights)?;
        let timing = measure(context.effort, || grid.tick());
        let tiles = (CELLS / 16).pow(2);
        let active = 100.0 * grid.active_tiles() as f64 / f64::from(tiles);
        rows.push(
            Row::new("grid_tiles", "512^2")
                .param("percent_active", active.round().min(100.0))
                .param("tiles", grid.active_tiles() as u64)
                .time("a tick, one sub-step, no foam", &timing),
        );
    }
    Ok(rows)
}

/// A splash with quiet tiles left out against one with every tile stepped.
fn skipped() -> Result<Row, CaseError> {
    let desc = GridDesc { cells: [384; 2], ..fixtures::grid() };
    let (mut lazy, mut all) = (WaveGrid::new(desc)?, WaveGrid::new(desc)?);
    all.set_tile_skipping(false);
    let (mut worst, mut peak, mut stepped) = (0.0f32, 0.0f32, 0);
    const TICKS: usize = 120;
    for tick in 0..TICKS {
        for grid in [&mut lazy, &mut all] {
            if tick < 20 {
                grid.add(Source::Displacement { center: Vec2::ZERO, radius: 1.0, volume: 0.05 });
            }
            grid.tick();
        }
        stepped += lazy.active_tiles();
        for (a, b) in lazy.heights().iter().zip(all.heights()) {
            worst = worst.max((a - b).abs());
            peak = peak.max(b.abs());
        }
    }
    let share = 100.0 * stepped as f64 / (TICKS * all.active_tiles()) as f64;
    Ok(Row::new("grid_tiles", "a splash")
        .param("tiles_stepped_percent", share.round())
        .param("peak_height_m", f64::from(peak))
        .error(f64::from(worst), "m", "the same with every tile stepped, 120 ticks")
        .bound(2.0 * f64::from(QUIET_HEIGHT)))
}

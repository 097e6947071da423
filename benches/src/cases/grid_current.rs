//! Case `grid_current`: waves in an even current against still ones, what the fading of the current before the border
//! sends back, and what a current costs.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{GridDesc, Medium, MediumCell, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure_together},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const CURRENT: Case = Case {
    name: "grid_current",
    about: "Doppler shift and damping of waves in an even current, the border's answer, the time",
    plots: &[Plot {
        file: "grid_current",
        title: "Error of the Doppler shift against cells per wavelength",
        x: Axis::Param("cells_per_wavelength"),
        y: Axis::Error,
        label: Some("damped_percent_per_wavelength"),
    }],
    run,
};

struct Even(Vec2);

impl Medium for Even {
    fn at(&self, _: DVec2, _: f32) -> MediumCell {
        MediumCell { current: self.0, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, share) in [("current of c/10", 0.1), ("current of c/4", 0.25), ("current of c/2", 0.5)] {
        for &cells in context.pick(&[8.0, 12.0, 24.0][..], &[6.0, 8.0, 10.0, 12.0, 16.0, 24.0, 32.0]) {
            let (doppler, damped) = carried(cells, share)?;
            let mut row = Row::new("grid_current", variant)
                .param("cells_per_wavelength", cells)
                .param("damped_percent_per_wavelength", (damped * 1e4).round() / 1e4)
                .error(doppler, "% of k U", "k U: rate of phase with the current less that without");
            if cells == 12.0 {
                row = row.bound(0.5);
            }
            rows.push(row);
        }
    }
    rows.push(layer()?);
    rows.push(cost(context)?);
    Ok(rows)
}

/// Error of the Doppler shift of a plane wave along the current, percent, and how much of it is lost on each
/// wavelength that it travels through the water, percent.
fn carried(cells_per_wave: f64, share: f64) -> Result<(f64, f64), CaseError> {
    let desc = GridDesc { cells: [352; 2], ..fixtures::grid() };
    let current = share * f64::from(desc.wave_speed);
    let k = TAU / cells_per_wave;
    let steps = 50u32;
    let mut rates = [[0.0; 2]; 2];
    for (current, rate) in [0.0, current].into_iter().zip(&mut rates) {
        let mut grid = WaveGrid::new(desc)?;
        let stepping = grid.stepping();
        grid.set_medium(Some(Arc::new(Even(Vec2::new(current as f32, 0.0)))));
        grid.set_tile_skipping(false);
        // Of the scheme in still water; the current only moves it.
        let turn = 2.0 * (stepping.a[0].sqrt() * (0.5 * k).sin()).asin();
        let wave = |phase: f64| -> Vec<f32> {
            (0..352 * 352).map(|at| (k * (at % 352) as f64 + phase).cos() as f32).collect()
        };
        // Both states stand in the frame of the water.
        grid.impose(&wave(0.0), &wave(turn))?;
        let project = |grid: &WaveGrid| {
            let row = &grid.heights()[176 * 352..177 * 352];
            let span = (4.0 * cells_per_wave).round() as usize;
            (176 - span / 2..176 - span / 2 + span).fold([0.0; 2], |sum, i| {
                let (sin, cos) = (k * i as f64).sin_cos();
                let z = f64::from(row[i]);
                [sum[0] + z * cos, sum[1] - z * sin]
            })
        };
        let mut last = project(&grid);
        let first = last[0].hypot(last[1]);
        let mut phase = 0.0;
        for _ in 0..steps {
            grid.tick();
            let now = project(&grid);
            phase += (now[1] * last[0] - now[0] * last[1]).atan2(now[0] * last[0] + now[1] * last[1]);
            last = now;
        }
        let ticks = f64::from(steps);
        *rate = [phase / ticks, (last[0].hypot(last[1]) / first).ln() / ticks];
    }
    let [still, moved] = rates;
    let dt = f64::from(desc.tick);
    let expected = k * current * dt / f64::from(desc.cell_size[0]);
    let doppler = 100.0 * (-(moved[0] - still[0]) / expected - 1.0).abs();
    let per_wave = TAU / -still[0];
    Ok((doppler, 100.0 * (1.0 - ((moved[1] - still[1]) * per_wave).exp())))
}

/// What comes back from the fade and the layer, where neither is.
fn layer() -> Result<Row, CaseError> {
    let pulse = |cells: u32| -> Result<WaveGrid, CaseError> {
        let desc = GridDesc { cells: [cells; 2], ..fixtures::grid() };
        let mut grid = WaveGrid::new(desc)?;
        grid.set_medium(Some(Arc::new(Even(Vec2::new(0.25 * desc.wave_speed, 0.0)))));
        grid.set_tile_skipping(false);
        grid.add(Source::Displacement { center: Vec2::ZERO, radius: 3.75, volume: 1.0 });
        Ok(grid)
    };
    let (mut small, mut large) = (pulse(160)?, pulse(448)?);
    let (mut worst, mut peak) = (0.0f32, 0.0f32);
    for _ in 0..170 {
        small.tick();
        large.tick();
        for j in 40..120 {
            for i in 40..120 {
                let exact = large.heights()[(j + 144) * 448 + i + 144];
                worst = worst.max((small.heights()[j * 160 + i] - exact).abs());
                if [40, 119].contains(&i) || [40, 119].contains(&j) {
                    peak = peak.max(exact.abs());
                }
            }
        }
    }
    Ok(Row::new("grid_current", "border, current of c/4")
        .error(20.0 * f64::from(worst / peak).log10(), "dB", "448^2 domain; over the peak where the current fades")
        .bound(-18.0))
}

fn cost(context: &Context) -> Result<Row, CaseError> {
    let desc = GridDesc { cells: [256; 2], ..fixtures::grid() };
    let rough = |current: f32| -> Result<WaveGrid, CaseError> {
        let mut grid = WaveGrid::new(desc)?;
        grid.set_medium(Some(Arc::new(Even(Vec2::new(current, 0.0)))));
        let mut random = Random::new(3);
        let heights: Vec<f32> = grid.heights().iter().map(|_| random.within(-0.01, 0.01) as f32).collect();
        grid.impose(&heights, &heights)?;
        grid.set_tile_skipping(false);
        Ok(grid)
    };
    let (mut moved, mut still) = (rough(1.0)?, rough(0.0)?);
    let [ours, theirs] = measure_together(context.effort, [&mut || moved.tick(), &mut || still.tick()]);
    Ok(Row::new("grid_current", "time")
        .param("cells", 256)
        .time("a tick with a current under the whole window", &ours)
        .baseline("the same medium, still", &theirs))
}

//! Cases `border_kinds` (what each kind of border sends back, by angle) and `pml_grazing` (waves that run along the layer).

use glam::Vec2;
use wave_grid::{Border, GridDesc, Source, WaveGrid};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure},
    fixtures,
};

/// See the module.
pub(super) const KINDS: Case = Case {
    name: "border_kinds",
    about: "what a border sends back of a pulse that meets it at 0 to 60 degrees, by kind and width",
    plots: &[Plot {
        file: "border_kinds",
        title: "Borders: worst reflection up to 60 degrees against time (beside the points: width)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("width"),
    }],
    run: kinds,
};

/// See the module.
pub(super) const GRAZING: Case = Case {
    name: "pml_grazing",
    about: "a pulse 6 cells from the border of 256 x 48 cells, 520 steps, against a larger domain",
    plots: &[],
    run: grazing,
};

/// Angles from the border's normal, degrees.
const ANGLES: [f64; 5] = [0.0, 15.0, 30.0, 45.0, 60.0];
/// Cells from the pulse to the border, and of the interior around it.
const AWAY: f64 = 20.0;
const ROOM: [i64; 2] = [160, 192];

/// A pulse in windows of different borders around the same cells.
struct Trial {
    interior: [i64; 2],
    /// Where the pulse is, cells from the interior's middle.
    at: [f64; 2],
    steps: usize,
    /// Wavelength at the pulse's peak frequency, cells.
    wavelength: f64,
}

impl Trial {
    fn grid(&self, border: Border, beyond: i64) -> Result<WaveGrid, CaseError> {
        let cells = self.interior.map(|n| (n + 2 * beyond) as u32);
        let mut grid = WaveGrid::new(GridDesc { cells, border, ..fixtures::grid() })?;
        // Quiet tiles differ by up to the height that counts as quiet, which is more than a good border sends back.
        grid.set_tile_skipping(false);
        Ok(grid)
    }

    fn window(&self, border: Border) -> Result<WaveGrid, CaseError> {
        self.grid(border, i64::from(border.width()) + 1)
    }

    /// One whose border no wave reaches and returns from.
    fn large(&self) -> Result<WaveGrid, CaseError> {
        let reach = self.steps as f64 * self.window(Border::default())?.stepping().a[0].sqrt();
        self.grid(Border::default(), (0.5 * reach) as i64 + 24)
    }

    /// Runs all side by side; `look` is shown the windows and the large one after each step.
    fn run(&self, grids: &mut [WaveGrid], large: &mut WaveGrid, mut look: impl FnMut(&[WaveGrid], &WaveGrid)) {
        let h = f64::from(large.desc().cell_size[0]);
        let frequency = large.stepping().a[0].sqrt() / self.wavelength;
        let delay = 1.5 / frequency;
        let center = Vec2::new((self.at[0] * h) as f32, (self.at[1] * h) as f32);
        for step in 0..self.steps {
            let x = (std::f64::consts::PI * frequency * (step as f64 - delay)).powi(2);
            let volume = ((1.0 - 2.0 * x) * (-x).exp() * h * h) as f32;
            for grid in grids.iter_mut().chain([&mut *large]) {
                if step as f64 <= 2.0 * delay {
                    grid.add(Source::Displacement { center, radius: 0.0, volume });
                }
                grid.tick();
            }
            look(grids, large);
        }
    }

    /// Height at cell (i, j) of the interior.
    fn height(&self, grid: &WaveGrid, [i, j]: [i64; 2]) -> f64 {
        let [nx, nz] = grid.desc().cells.map(i64::from);
        let (x, z) = (i + (nx - self.interior[0]) / 2, j + (nz - self.interior[1]) / 2);
        f64::from(grid.heights()[(z * nx + x) as usize])
    }
}

fn decibels(error: f64, peak: f64) -> f64 {
    20.0 * (error / peak).log10()
}

fn kinds(context: &Context) -> Result<Vec<Row>, CaseError> {
    let trial = Trial { interior: ROOM, at: [0.5 * ROOM[0] as f64 - AWAY, 0.0], steps: 170, wavelength: 10.0 };
    let widths: &[u32] = context.pick(&[8, 12, 16], &[4, 6, 8, 10, 12, 14, 16, 18, 20]);
    let layers = widths.iter().map(|&width| Border::Absorbing { width });
    let sponges = widths.iter().map(|&width| Border::Sponge { width });
    let borders: Vec<_> = layers.chain(sponges).chain([Border::Reflecting]).collect();
    let mut grids = borders.iter().map(|border| trial.window(*border)).collect::<Result<Vec<_>, _>>()?;
    let mut large = trial.large()?;
    // By angle: where the pulse meets the border, and where what is sent back passes the pulse's distance again.
    let source = ROOM[0] - AWAY as i64;
    let across = |degrees: f64, way: f64| ROOM[1] / 2 + (way * AWAY * degrees.to_radians().tan()).round() as i64;
    let mut worst = vec![[0.0f64; ANGLES.len()]; grids.len()];
    let mut peak = [0.0f64; ANGLES.len()];
    trial.run(&mut grids, &mut large, |grids, large| {
        for (k, angle) in ANGLES.into_iter().enumerate() {
            peak[k] = peak[k].max(trial.height(large, [ROOM[0] - 1, across(angle, 1.0)]).abs());
            let back = [source, across(angle, 2.0)];
            let truth = trial.height(large, back);
            for (grid, worst) in grids.iter().zip(&mut worst) {
                worst[k] = worst[k].max((trial.height(grid, back) - truth).abs());
            }
        }
    });
    let mut rows = Vec::new();
    for ((border, mut grid), worst) in borders.into_iter().zip(grids).zip(worst) {
        let timing = measure(context.effort, || grid.tick());
        let name = match border {
            Border::Absorbing { .. } => "matched layer",
            Border::Sponge { .. } => "sponge",
            _ => "walls",
        };
        let by_angle = worst.iter().zip(&peak).map(|(worst, peak)| decibels(*worst, *peak));
        let mut row = Row::new("border_kinds", name).param("width", border.width());
        for (angle, value) in ANGLES.into_iter().zip(by_angle.clone()) {
            row = row.param(&format!("db_at_{angle}"), (value * 10.0).round() / 10.0);
        }
        let all = by_angle.fold(f64::NEG_INFINITY, f64::max);
        rows.push(row.error(all, "dB", "a larger domain; over the peak at the border").time("a tick", &timing));
    }
    Ok(rows)
}

fn grazing(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (wavelength, bounds) in [(24.0, [None, Some(-58.0), Some(-70.0)]), (10.0, [None; 3])] {
        rows.extend(along_the_layer(wavelength, bounds)?);
    }
    Ok(rows)
}

fn along_the_layer(wavelength: f64, bounds: [Option<f64>; 3]) -> Result<Vec<Row>, CaseError> {
    let interior = [256, 48];
    let trial = Trial { interior, at: [0.0, 6.0 - 24.0], steps: 520, wavelength };
    let widths = [8, 12, 16];
    let mut grids =
        widths.iter().map(|&width| trial.window(Border::Absorbing { width })).collect::<Result<Vec<_>, _>>()?;
    let mut large = trial.large()?;
    let (mut worst, mut peak) = (vec![0.0f64; grids.len()], 0.0f64);
    trial.run(&mut grids, &mut large, |grids, large| {
        for j in 0..interior[1] {
            for i in 0..interior[0] {
                let truth = trial.height(large, [i, j]);
                if i == 0 || j == 0 || i + 1 == interior[0] || j + 1 == interior[1] {
                    peak = peak.max(truth.abs());
                }
                for (grid, worst) in grids.iter().zip(&mut worst) {
                    *worst = worst.max((trial.height(grid, [i, j]) - truth).abs());
                }
            }
        }
    });
    let rows = widths.into_iter().zip(worst).zip(bounds).map(|((width, worst), bound)| {
        let row = Row::new("pml_grazing", "9-point").param("width", width).param("wavelength_cells", wavelength);
        let row = row.error(decibels(worst, peak), "dB", "a larger domain; over the peak at the border");
        match bound {
            Some(bound) => row.bound(bound),
            None => row,
        }
    });
    Ok(rows.collect())
}

//! Cases `shoaling` (waves over a bed that rises) and `standing` (waves against a wall): closed forms of long waves.

use std::f64::consts::{PI, SQRT_2, TAU};
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, Edges, GridDesc, GridSample, Medium, MediumCell, Scheme, WaveGrid};

use crate::evidence::{Case, CaseError, Context, Row};

/// See the module.
pub(super) const SHOALING: Case = Case {
    name: "shoaling",
    about: "growth of waves from deep water to a quarter of the depth, against Green's law",
    plots: &[],
    run: shoaling,
};

/// See the module.
pub(super) const STANDING: Case = Case {
    name: "standing",
    about: "waves against a wall: how much comes back, and where the antinode stands",
    plots: &[],
    run: standing,
};

/// A channel along x between walls; its bed and its end are functions of x (metres).
struct Channel {
    /// Share of the deep water's depth.
    depth: fn(f64) -> f64,
    /// Where it ends, and in what.
    end: (f64, CellKind),
}

impl Medium for Channel {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = match place {
            p if p.y.abs() > 6.0 => CellKind::Wall,
            p if p.x > self.end.0 => self.end.1,
            _ => CellKind::Open,
        };
        MediumCell {
            speed: deep_speed * (self.depth)(place.x).sqrt() as f32,
            damping: 0.0,
            kind,
            ..MediumCell::default()
        }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

/// A run of a wave into a channel through its side of least x.
struct Run {
    grid: WaveGrid,
    period: usize,
    /// Wavenumber of the scheme in deep water, 1/m.
    k: f64,
}

impl Run {
    /// `cells_per_wave` of the deep water; cells of one metre.
    fn new(scheme: Scheme, length: u32, cells_per_wave: f64, channel: Channel) -> Result<Self, CaseError> {
        let desc = GridDesc {
            cells: [length, 64],
            cell_size: [1.0; 2],
            wave_speed: 20.0,
            tick: 1.0 / 30.0,
            substeps: Some(1),
            scheme,
            ..GridDesc::default()
        };
        let mut grid = WaveGrid::new(desc)?;
        grid.set_medium(Some(Arc::new(channel)));
        grid.set_feed(Edges { low_x: true, ..Edges::default() });
        let a = grid.stepping().a[0];
        let period = (cells_per_wave / a.sqrt()).round() as usize;
        // The dispersion relation of either scheme along an axis.
        let k = 2.0 * ((PI / period as f64).sin() / a.sqrt()).asin();
        Ok(Self { grid, period, k })
    }

    fn tick(&mut self, tick: usize) {
        let lines = self.grid.feed_lines();
        let (k, turn) = (self.k, TAU / self.period as f64);
        self.grid.tick_fed(&mut |line, _, rows| {
            for (row, x) in rows.into_iter().zip(lines[line].across) {
                // It grows over six periods.
                let phase = turn * tick as f64 - k * (x - lines[line].across[0]);
                let grown = (phase / (6.0 * TAU)).clamp(0.0, 1.0);
                row.fill((phase.cos() * (0.5 - 0.5 * (PI * grown).cos())) as f32);
            }
        });
    }

    /// Complex amplitudes (of cos, of sin) on the middle line at `places`, over the period that ends `periods` from now.
    fn amplitudes(mut self, periods: usize, places: &[f64]) -> Vec<[f64; 2]> {
        let points: Vec<Vec2> = places.iter().map(|x| Vec2::new(*x as f32, 0.0)).collect();
        let mut answers = vec![GridSample::default(); points.len()];
        let mut sums = vec![[0.0; 2]; points.len()];
        let last = periods * self.period;
        for tick in 0..last {
            self.tick(tick);
            if tick + self.period >= last {
                self.grid.sample(&points, &mut answers);
                let (sin, cos) = (TAU * tick as f64 / self.period as f64).sin_cos();
                for (sum, answer) in sums.iter_mut().zip(&answers) {
                    let z = 2.0 * f64::from(answer.height) / self.period as f64;
                    *sum = [sum[0] + z * cos, sum[1] + z * sin];
                }
            }
        }
        sums
    }
}

fn round(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

/// Share of the depth: 1, then falling evenly from x = -200 m to a quarter at 120 m.
fn slope(x: f64) -> f64 {
    1.0 - 0.75 * ((x + 200.0) / 320.0).clamp(0.0, 1.0)
}

fn shoaling(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, scheme) in [("9-point", Scheme::NinePoint), ("5-point", Scheme::FivePoint)] {
        for &cells_per_wave in context.pick(&[40.0][..], &[24.0, 40.0, 64.0]) {
            let channel = Channel { depth: slope, end: (f64::INFINITY, CellKind::Wall) };
            let run = Run::new(scheme, 700, cells_per_wave, channel)?;
            let periods = (2600.0 / run.period as f64) as usize;
            // A whole wave of the shallow water, so that what little comes back cancels.
            let places: Vec<f64> = (0..32).map(|i| 160.0 + 0.5 * cells_per_wave * f64::from(i) / 32.0).collect();
            let amplitudes = run.amplitudes(periods, &places);
            let square: f64 = amplitudes.iter().map(|[c, s]| c * c + s * s).sum::<f64>() / places.len() as f64;
            let growth = square.sqrt();
            rows.push(
                Row::new("shoaling", variant)
                    .param("deep_cells_per_wavelength", cells_per_wave)
                    .param("growth", round(growth))
                    .error(100.0 * (growth / SQRT_2 - 1.0).abs(), "%", "Green's law, a fourth root of 4")
                    .bound(if cells_per_wave < 40.0 { 2.0 } else { 1.0 }),
            );
        }
    }
    Ok(rows)
}

fn standing(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for &cells_per_wave in context.pick(&[16.0, 40.0][..], &[10.0, 16.0, 40.0]) {
        // On a face between cells, and off it to either side.
        for wall in [100.0, 100.3, 100.7] {
            for (variant, kind) in [("wall", CellKind::Wall), ("held water", CellKind::Fixed)] {
                rows.extend(against(cells_per_wave, wall, variant, kind)?);
            }
        }
    }
    Ok(rows)
}

fn against(cells_per_wave: f64, wall: f64, variant: &str, kind: CellKind) -> Result<[Row; 2], CaseError> {
    let run = Run::new(Scheme::NinePoint, 320, cells_per_wave, Channel { depth: |_| 1.0, end: (wall, kind) })?;
    let k = run.k;
    let periods = 12 + (900.0 / run.period as f64) as usize;
    // The last place is the wall.
    let places: Vec<f64> = (0..80).map(f64::from).chain([wall]).collect();
    let amplitudes = run.amplitudes(periods, &places);
    // Least squares of A exp(-i k x) + B exp(i k x), x from the wall: with c + i s the conjugate amplitudes.
    let (mut mixed, mut to, mut from) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    for (x, [c, s]) in places.iter().zip(&amplitudes).take(80) {
        let (sin, cos) = (k * (x - wall)).sin_cos();
        to = [to[0] + c * cos + s * sin, to[1] + s * cos - c * sin];
        from = [from[0] + c * cos - s * sin, from[1] + s * cos + c * sin];
        let (sin, cos) = (2.0 * k * (x - wall)).sin_cos();
        mixed = [mixed[0] + cos, mixed[1] - sin];
    }
    // [n, m; conj m, n] [A; B] = [to; from].
    let n = 80.0;
    let det = n * n - mixed[0] * mixed[0] - mixed[1] * mixed[1];
    let times = |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let solve = |one: [f64; 2], m: [f64; 2], other: [f64; 2]| {
        let cross = times(m, other);
        [(n * one[0] - cross[0]) / det, (n * one[1] - cross[1]) / det]
    };
    let incident = solve(to, mixed, from);
    let reflected = solve(from, [mixed[0], -mixed[1]], to);
    let size = |a: [f64; 2]| a[0].hypot(a[1]);
    let ratio = size(reflected) / size(incident);
    let [c, s] = amplitudes[80];
    let at_wall = c.hypot(s) / (size(incident) + size(reflected));
    let params = |row: Row| row.param("cells_per_wavelength", cells_per_wave).param("wall_at_cells", wall);
    let (expected, error) = if kind == CellKind::Wall {
        ("an antinode at the wall: height sampled there over that of both waves", 1.0 - at_wall)
    } else {
        ("a node at the wall: height sampled there over that of both waves", at_wall)
    };
    // A wall stands on faces: half a cell off at most. Held water is held at centres of cells, up to one cell off.
    let bound = match kind {
        CellKind::Wall => 100.0 * (1.0 - (0.5 * TAU / cells_per_wave).cos()) + 1.0,
        _ => 100.0 * (TAU / cells_per_wave).sin() + 1.0,
    };
    Ok([
        params(Row::new("standing", format!("{variant}, reflection")))
            .param("reflected", round(ratio))
            .error(100.0 * (1.0 - ratio).abs(), "%", "all of it")
            .bound(3.0),
        params(Row::new("standing", format!("{variant}, place")))
            .param("at_wall", round(at_wall))
            .error(100.0 * error.abs(), "%", expected)
            .bound(bound),
    ])
}

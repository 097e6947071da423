//! Case `dispersion`: phase and group speed of the dispersive scheme against linear theory, in deep water and at six
//! depths, from the shipped coefficients; and whether the fit gives these again.

use std::f64::consts::{FRAC_PI_4, TAU};

use wave_grid::dispersive::{FIELDS, MOST_G, Shares, Table};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    fit::Task,
};

/// See the module.
pub(super) const DISPERSION: Case = Case {
    name: "dispersion",
    about: "phase and group speed of the dispersive scheme, worst over direction, against linear theory",
    plots: &[Plot {
        file: "dispersion",
        title: "Phase error of the dispersive scheme by cells a wave (G = .00545)",
        x: Axis::Param("cells_per_wavelength"),
        y: Axis::Error,
        label: None,
    }],
    run,
};

/// Cells of 0.5 m at 1/60 s.
const G: f64 = 9.81 / 3600.0 / 0.5;
/// Shortest and longest wave, cells.
const BAND: [f64; 2] = [6.0, 128.0];
const THEORY: &str = "linear theory, w^2 = g k tanh(k h)";

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let lengths = context.pick(60, 400);
    for g in [2e-4, 5e-4, G / 4.0, 0.0025, 0.004, G, MOST_G] {
        let water = Water::new(g, f64::INFINITY);
        let [phase, group] = water.worst(BAND, lengths);
        let row = |what: &str| Row::new("dispersion", what).param("g_dt2_over_cell", rounded(g, 6));
        rows.push(row("phase, deep").error(phase, "%", THEORY).bound(0.7));
        rows.push(row("group, deep").error(group, "%", THEORY).bound(4.0));
    }
    for depth in [80.0, 19.7, 9.75, 4.83, 2.39, 1.5, 1.0, 0.65, 0.4] {
        // At the G of the middle and at the largest: coefficients are interpolated in both.
        let worst = [G / 4.0, MOST_G].map(|g| Water::new(g, depth).worst(BAND, lengths));
        let [phase, group] = [0, 1].map(|which| worst[0][which].max(worst[1][which]));
        let row = |what: &str| Row::new("dispersion", what).param("depth_cells", depth);
        let row_phase = row("phase, by depth").error(phase, "%", THEORY);
        rows.push(if depth >= 0.625 { row_phase.bound(1.1) } else { row_phase });
        rows.push(row("group, by depth").error(group, "%", THEORY));
    }
    for (variant, depth) in [("deep", f64::INFINITY), ("6 cells deep", 6.0), ("1.5 cells deep", 1.5)] {
        for i in 0..=14 {
            let length = BAND[0] * (BAND[1] / BAND[0]).powf(f64::from(i) / 14.0);
            let [phase, group] = Water::new(G, depth).errors(length);
            let row = Row::new("dispersion", variant).param("cells_per_wavelength", rounded(length, 1));
            rows.push(row.param("group_percent", rounded(group, 2)).error(phase, "%", THEORY));
        }
    }
    rows.push(refit());
    Ok(rows)
}

fn rounded(x: f64, digits: i32) -> f64 {
    (x * 10f64.powi(digits)).round() / 10f64.powi(digits)
}

/// The fit of this machine against the shipped table, at the G of three of its nodes, each from the one before.
fn refit() -> Row {
    let task = Task::SHIPPED;
    let mut worst = 0.0f64;
    let mut start = task.start();
    for g in [0.0062, 0.00465, 0.00155] {
        start = task.fit(g, f64::INFINITY, &start, false);
        let table = Table::new(g);
        let Shares { c, s } = table.deep();
        let own = [start.c].into_iter().chain(start.s.clone()).chain(start.r.clone());
        for (own, shipped) in own.zip([c].into_iter().chain(s).chain(table.r())) {
            worst = worst.max(100.0 * (own / f64::from(shipped) - 1.0).abs());
        }
    }
    Row::new("dispersion", "fitted again, deep").error(worst, "%", "the shipped coefficients").bound(1.0)
}

/// Water of one depth (cells) on a grid, as the scheme sees it.
struct Water {
    g: f64,
    depth: f64,
    c: f64,
    s: [f64; FIELDS],
    r: [f64; FIELDS],
}

impl Water {
    fn new(g: f64, depth: f64) -> Self {
        let table = Table::new(g);
        let Shares { c, s } = table.at(depth as f32);
        Self { g, depth, c: c.into(), s: s.map(f64::from), r: table.r().map(f64::from) }
    }

    /// Worst errors of phase and group speed over wavelengths, percent.
    fn worst(&self, [short, long]: [f64; 2], lengths: usize) -> [f64; 2] {
        (0..lengths).fold([0.0; 2], |worst, i| {
            let length = short * (long / short).powf(i as f64 / (lengths - 1) as f64);
            let errors = self.errors(length);
            [0, 1].map(|which: usize| worst[which].max(errors[which]))
        })
    }

    /// Worst errors of phase and group speed of waves of a length over 13 directions, percent.
    fn errors(&self, length: f64) -> [f64; 2] {
        let exact = |k: f64| (self.g * k * (k * self.depth).tanh()).sqrt();
        let (k, d) = (TAU / length, 1e-4);
        (0..13).fold([0.0f64; 2], |worst, direction| {
            let angle = FRAC_PI_4 * f64::from(direction) / 12.0;
            let [low, at, high] = [1.0 - d, 1.0, 1.0 + d].map(|part| self.frequency(part * k, angle));
            let group = (high - low) / (exact((1.0 + d) * k) - exact((1.0 - d) * k));
            let phase = at / exact(k);
            [worst[0].max(100.0 * (phase - 1.0).abs()), worst[1].max(100.0 * (group - 1.0).abs())]
        })
    }

    /// The lowest frequency of a plane wave, radians a step. Potential and fields follow `M (u+ - 2 u + u-) = -K u` with
    /// symmetric K and diagonal M. K - x M has as many negative pivots as there are eigenvalues below x: bisection.
    fn frequency(&self, k: f64, angle: f64) -> f64 {
        let laplacian = 2.0 * (k * angle.cos()).cos() + 2.0 * (k * angle.sin()).cos() - 4.0;
        const N: usize = FIELDS + 1;
        let mut stiffness = [[0.0; N]; N];
        let mut mass = [1.0 / self.g; N];
        stiffness[0][0] = self.r.iter().sum::<f64>() - self.c * laplacian;
        for i in 0..FIELDS {
            stiffness[0][i + 1] = -self.r[i];
            stiffness[i + 1][0] = -self.r[i];
            stiffness[i + 1][i + 1] = self.r[i] - self.s[i] * laplacian;
            mass[i + 1] = (8.0 * self.s[i] + 2.0 * self.r[i]) / 3.6;
        }
        let some_below = |x: f64| {
            let mut rest = stiffness;
            (0..N).for_each(|i| rest[i][i] -= x * mass[i]);
            // From the fields to the potential, so that the first pivots are far from zero.
            (0..N).rev().any(|pivot| {
                let (above, below) = rest.split_at_mut(pivot);
                let own = below[0];
                for row in above {
                    let factor = row[pivot] / own[pivot];
                    row.iter_mut().zip(own).for_each(|(x, y)| *x -= factor * y);
                }
                own[pivot] < 0.0
            })
        };
        let (mut low, mut high) = (0.0, 4.0);
        for _ in 0..80 {
            let x = 0.5 * (low + high);
            if some_below(x) { high = x } else { low = x }
        }
        2.0 * (0.5 * low.sqrt()).asin()
    }
}

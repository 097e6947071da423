//! Cases `border_dispersive` and `border_moving`: what the layer of water waves sends back, from windows that stand and that follow a
//! source, also with a bed and a wall in them.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec2;
use wave_grid::{Border, CellKind, GridDesc, Medium, MediumCell, Scheme, Source, WaveGrid};

use crate::evidence::{Axis, Case, CaseError, Context, Plot, Row, measure};

/// See the module.
pub(super) const STANDING: Case = Case {
    name: "border_dispersive",
    about: "what the border of a standing window of water waves sends back, against a larger domain",
    plots: &[Plot {
        file: "border_dispersive",
        title: "Standing border: error over the peak at the border against time",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("wave_cells"),
    }],
    run: standing,
};

/// See the module.
pub(super) const MOVING: Case = Case {
    name: "border_moving",
    about: "what the border of a window of water waves that follows a source sends back, against a larger domain that stands",
    plots: &[Plot {
        file: "border_moving",
        title: "Moving border: error over the peak at the border against the layer's width",
        x: Axis::Param("width"),
        y: Axis::Error,
        label: None,
    }],
    run: moving,
};

const CELL: f64 = 0.5;
const TICK: f64 = 1.0 / 60.0;
/// Ticks between two looks.
const LOOK: usize = 12;

/// What all runs of a scene do.
struct Scene {
    /// Cells of the interior, along x and z.
    interior: i64,
    ticks: usize,
    /// Where the source is at a tick, metres, and its pressure, Pa.
    path: Box<dyn Fn(usize) -> (DVec2, f64)>,
    radius: f32,
    medium: Option<Arc<dyn Medium>>,
    /// Cells of the larger domain beyond all that the windows see.
    beyond: i64,
}

struct Run {
    border: Border,
    grid: WaveGrid,
    worst: f64,
}

impl Scene {
    fn grid(&self, cells: [i64; 2], border: Border) -> Result<WaveGrid, CaseError> {
        let cells = cells.map(|n| n as u32);
        let mut grid = WaveGrid::new(GridDesc { cells, scheme: Scheme::Dispersive, border, ..Default::default() })?;
        grid.set_tile_skipping(false);
        grid.set_medium(self.medium.clone());
        Ok(grid)
    }

    /// Runs all borders beside one larger domain. Returns them and the peak at the rim of what is compared.
    fn run(&self, borders: &[Border]) -> Result<(Vec<Run>, f64), CaseError> {
        let mut runs = Vec::new();
        for border in borders {
            let cells = self.interior + 2 * (i64::from(border.width()) + 1);
            runs.push(Run { border: *border, grid: self.grid([cells; 2], *border)?, worst: 0.0 });
        }
        let length = (0..self.ticks).map(|t| (self.path)(t).0.x).fold(0.0, f64::max);
        let wide = self.interior + 2 * self.beyond;
        let mut large = self.grid([wide + (length / CELL) as i64, wide], Border::Absorbing { width: 32 })?;
        large.center_on(DVec2::new(0.5 * length, 0.0));
        let mut peak = 0.0f64;
        for t in 0..self.ticks {
            let (at, pressure) = (self.path)(t);
            let source = Source::Pressure { center: at.as_vec2(), radius: self.radius, pressure: pressure as f32 };
            runs.iter_mut().for_each(|run| run.grid.center_on(at));
            for grid in runs.iter_mut().map(|run| &mut run.grid).chain([&mut large]) {
                grid.add(source);
                grid.tick();
            }
            if t % LOOK == LOOK - 1 {
                runs.iter_mut().for_each(|run| peak = peak.max(self.look(run, &large)));
            }
        }
        Ok((runs, peak))
    }

    /// Notes the worst difference within the layer; returns the highest wave at the rim of it.
    fn look(&self, run: &mut Run, large: &WaveGrid) -> f64 {
        // One cell within the layer's inner edge, wherever the window leans.
        let corner = run.grid.window().corner.map(|c| c + i64::from(run.border.width()) + 2);
        let last = self.interior - 3;
        let mut peak = 0.0f64;
        for j in 0..=last {
            for i in 0..=last {
                let cell = [corner[0] + i, corner[1] + j];
                let truth = height(large, cell);
                run.worst = run.worst.max((height(&run.grid, cell) - truth).abs());
                if i == 0 || j == 0 || i == last || j == last {
                    peak = peak.max(truth.abs());
                }
            }
        }
        peak
    }
}

/// Height of a cell of the world.
fn height(grid: &WaveGrid, cell: [i64; 2]) -> f64 {
    let window = grid.window();
    let [x, z] = [cell[0] - window.corner[0], cell[1] - window.corner[1]];
    f64::from(grid.heights()[(z * i64::from(window.cells[0]) + x) as usize])
}

fn decibels(worst: f64, peak: f64) -> f64 {
    20.0 * (worst / peak).log10()
}

fn absorbing(width: u32) -> Border {
    Border::Absorbing { width }
}

fn standing(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for wave_cells in [24.0, 48.0] {
        let omega = (9.81 * TAU / (wave_cells * CELL)).sqrt();
        let scene = Scene {
            interior: 144,
            ticks: context.pick(1200, 1440),
            path: Box::new(move |t| {
                let time = t as f64 * TICK;
                (DVec2::ZERO, 2000.0 * (omega * time).sin() * (0.5 * time).min(1.0))
            }),
            radius: (wave_cells * CELL / 4.0) as f32,
            medium: None,
            beyond: context.pick(96, 256),
        };
        let borders = [absorbing(8), absorbing(12), absorbing(16), absorbing(24), Border::Sponge { width: 16 }];
        let (runs, peak) = scene.run(&borders)?;
        for mut run in runs {
            let (kind, width) = match run.border {
                Border::Sponge { width } => ("sponge", width),
                border => ("layer", border.width()),
            };
            let timing = measure(context.effort, || run.grid.tick());
            let row = Row::new("border_dispersive", format!("{kind}, width {width}"))
                .param("wave_cells", wave_cells)
                .param("width", width)
                .error(decibels(run.worst, peak), "dB", "a larger domain; over the peak at the border")
                .time("a tick of the whole window", &timing);
            rows.push(if kind == "layer" && width == 16 { row.bound(-55.0) } else { row });
        }
    }
    Ok(rows)
}

/// A sloping sea bed with bars, and a quay wall along the way with a gap.
struct Coast;

impl Medium for Coast {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        let wall = (place.y - 24.0).abs() < 1.0 && (place.x / 40.0).rem_euclid(1.0) < 0.8;
        let depth = 4.0 + 2.0 * (place.x / 15.0).sin() + 0.05 * (40.0 - place.y).max(0.0);
        let kind = if wall { CellKind::Wall } else { CellKind::Open };
        MediumCell { depth: depth as f32, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

fn moving(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let steady = |speed: f64| move |time: f64| speed * (time - 2.0 * (1.0 - (-0.5 * time).exp()));
    let stop_and_go = |time: f64| 3.0 * (time - (TAU * time / 8.0).sin() * 8.0 / TAU);
    type Way = Box<dyn Fn(f64) -> f64>;
    // Variant, way, seconds, cells of the interior, over a coast.
    let mut scenes: Vec<(&str, Way, f64, i64, bool)> = vec![
        ("steady, 5 m/s", Box::new(steady(5.0)), context.pick(18.0, 28.0), 222, false),
        ("stop and go, 0 to 6 m/s", Box::new(stop_and_go), 33.0, 222, false),
        ("steady, 5 m/s, bed and wall", Box::new(steady(5.0)), context.pick(14.0, 28.0), context.pick(160, 222), true),
    ];
    if context.pick(false, true) {
        scenes.push(("steady, 3 m/s", Box::new(steady(3.0)), 42.0, 222, false));
        scenes.push(("steady, 8 m/s", Box::new(steady(8.0)), 20.0, 222, false));
        scenes.push(("stop and go, bed and wall", Box::new(stop_and_go), 24.0, 222, true));
        scenes.push(("stop and go, smaller window", Box::new(stop_and_go), 24.0, 160, false));
    }
    for (variant, way, seconds, interior, coast) in scenes {
        let scene = Scene {
            interior,
            ticks: (seconds / TICK) as usize,
            path: Box::new(move |t| {
                let time = t as f64 * TICK;
                let start = time.min(1.0);
                (DVec2::new(way(time), 0.0), 3000.0 * start * start * (3.0 - 2.0 * start))
            }),
            radius: 1.5,
            medium: coast.then(|| Arc::new(Coast) as Arc<dyn Medium>),
            beyond: context.pick(80, 120),
        };
        let both = [absorbing(16), absorbing(24)];
        let of_both = context.pick(variant.ends_with("5 m/s"), true);
        let (runs, peak) = scene.run(if of_both { &both } else { &both[..1] })?;
        for mut run in runs {
            let width = run.border.width();
            let timing = measure(context.effort, || run.grid.tick());
            let row = Row::new("border_moving", variant)
                .param("width", width)
                .error(decibels(run.worst, peak), "dB", "a larger domain; over the peak at the border")
                .time("a tick of the whole window", &timing);
            rows.push(match (coast, width, variant.starts_with("steady")) {
                (true, ..) => row.note("no bound: walls and a bed in a layer that moves"),
                _ if variant.ends_with("window") => row.note("no bound: it stops where its own wake is still high"),
                (false, 16, _) => row.bound(-42.0),
                (false, 24, true) => row.bound(-50.0),
                _ => row,
            });
        }
    }
    Ok(rows)
}

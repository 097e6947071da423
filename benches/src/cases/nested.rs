//! Case `nested`: a fine grid in a coarse one, against fine cells over everything.

use std::path::Path;

use glam::{DVec2, Vec2};
use plotters::prelude::{BitMapBackend, IntoDrawingArea, RGBColor};
use wave_grid::{GridDesc, GridSample, Scheme, Source, WaveGrid};

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures,
};

/// See the module.
pub(super) const NESTED: Case = Case {
    name: "nested",
    about: "a fine grid in one of twice its cells: what its joint sends back, and both together against fine cells everywhere",
    plots: &[],
    run,
};

/// Cells of the fine grid, and of that with fine cells everywhere, whose border nothing comes back from in time.
const FINE: u32 = 256;
const LARGE: u32 = 704;
/// Fine cells, metres.
const CELL: f32 = 0.25;
/// Waves at the pulse's peak, metres, and their period, seconds.
const WAVE: f64 = 16.0;
/// Half the side of what is looked at, metres: inside the coarse grid's border.
const REACH: i32 = 56;
/// Half the side of where the fine grid alone is seen.
const INNER: f32 = 25.0;

/// A source by time, seconds: where it is and what volume it has pushed up by then.
type Maker = fn(f64, f64) -> (DVec2, f64);

/// A pulse off the middle.
fn pulse(time: f64, period: f64) -> (DVec2, f64) {
    let x = std::f64::consts::PI * (time / period - 1.5);
    (DVec2::new(6.0, 3.0), x * (-x * x).exp())
}

/// A boat at 4.5 m/s that has its window around it.
fn boat(time: f64, _: f64) -> (DVec2, f64) {
    (DVec2::from_angle(0.4) * (4.5 * time - 30.0), (time / 2.0).min(1.0))
}

struct Trial {
    fine: WaveGrid,
    coarse: WaveGrid,
    large: WaveGrid,
}

impl Trial {
    fn new(scheme: Scheme) -> Result<Self, CaseError> {
        let desc = GridDesc { cells: [FINE; 2], cell_size: [CELL; 2], scheme, ..fixtures::grid() };
        let (mut fine, coarse) =
            (WaveGrid::new(desc)?, WaveGrid::new(GridDesc { cell_size: [2.0 * CELL; 2], ..desc })?);
        fine.set_nested(true);
        Ok(Self { fine, coarse, large: WaveGrid::new(GridDesc { cells: [LARGE; 2], ..desc })? })
    }

    /// One tick, after which `make` has pushed up what it says.
    fn tick(&mut self, make: Maker, period: f64, tick: usize, follows: bool) {
        let dt = f64::from(self.fine.desc().tick);
        let [before, now] = [tick, tick + 1].map(|t| make(t as f64 * dt, period));
        for grid in [&mut self.fine, &mut self.coarse, &mut self.large] {
            for (place, volume) in [(before.0, -before.1), (now.0, now.1)] {
                let center = place.as_vec2();
                grid.add(Source::Displacement { center, radius: 2.5, volume: volume as f32 });
            }
        }
        if follows {
            self.fine.center_on(now.0);
            self.coarse.center_on(now.0);
        }
        self.coarse.set_holes(&[self.fine.hole(1.0)]);
        for grid in [&mut self.fine, &mut self.coarse, &mut self.large] {
            grid.tick();
        }
    }

    /// Heights at points: of both together, and with fine cells everywhere.
    fn heights(&self, points: &[Vec2]) -> [Vec<f64>; 2] {
        let [fine, coarse, large] = self.each(points);
        [fine.iter().zip(coarse).map(|(fine, coarse)| fine + coarse).collect(), large]
    }

    /// Heights at points as the three grids show them.
    fn each(&self, points: &[Vec2]) -> [Vec<f64>; 3] {
        let read = |grid: &WaveGrid| {
            let mut out = vec![GridSample::default(); points.len()];
            grid.sample(points, &mut out);
            out.into_iter().map(|sample| f64::from(sample.height)).collect::<Vec<_>>()
        };
        [read(&self.fine), read(&self.coarse), read(&self.large)]
    }
}

/// Every metre around a place.
fn around(middle: Vec2) -> Vec<Vec2> {
    let line = -REACH..=REACH;
    line.clone().flat_map(|z| line.clone().map(move |x| middle + Vec2::new(x as f32, z as f32))).collect()
}

/// Both heights side by side, four pixels a metre.
fn picture(left: &[f64], right: &[f64], path: &Path) -> Result<(), CaseError> {
    let side = 2 * REACH + 1;
    let area = BitMapBackend::new(path, (8 * side as u32, 4 * side as u32)).into_drawing_area();
    let most = right.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    for (k, heights) in [left, right].into_iter().enumerate() {
        for (i, z) in heights.iter().enumerate() {
            let shade = (127.5 + 120.0 * (4.0 * z / most).clamp(-1.0, 1.0)) as u8;
            let (x, y) = (i as i32 % side + k as i32 * side, i as i32 / side);
            for pixel in 0..16 {
                area.draw_pixel((4 * x + pixel % 4, 4 * y + pixel / 4), &RGBColor(shade, shade, shade))?;
            }
        }
    }
    Ok(area.present()?)
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (scheme, name) in [(Scheme::NinePoint, "9-point"), (Scheme::Dispersive, "dispersive")] {
        let period = match scheme {
            Scheme::Dispersive => (std::f64::consts::TAU * WAVE / 9.81).sqrt(),
            _ => WAVE / f64::from(fixtures::grid().wave_speed),
        };
        let mut trial = Trial::new(scheme)?;
        let points = around(Vec2::ZERO);
        let inside = |point: &Vec2| point.abs().max_element() <= INNER;
        let (mut sent, mut peak, mut worst, mut most) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for tick in 0..780 {
            trial.tick(pulse, period, tick, false);
            if tick % 20 != 19 {
                continue;
            }
            let [both, truth] = trial.heights(&points);
            for ((point, both), truth) in points.iter().zip(&both).zip(&truth) {
                if inside(point) {
                    sent = sent.max((both - truth).abs());
                } else if point.abs().max_element() <= INNER + 2.0 {
                    peak = peak.max(truth.abs());
                }
            }
            worst = worst.max(rms(both.iter().zip(&truth).map(|(a, b)| a - b)));
            most = most.max(rms(truth.into_iter()));
        }
        let row = |what: &str, value: f64, truth| {
            Row::new("nested", format!("{name}, {what}")).param("cells_ratio", 2).error(100.0 * value, "%", truth)
        };
        let truth = "fine cells everywhere; worst over the peak at the joint";
        rows.push(row("pulse: what comes back", sent / peak, truth).bound(5.0));
        rows.push(
            row("pulse: both together", worst / most, "fine cells everywhere; worst rms in 13 s over the largest")
                .bound(8.0),
        );
        let mut trial = Trial::new(scheme)?;
        for tick in 0..720 {
            trial.tick(boat, period, tick, true);
        }
        let window = trial.coarse.window();
        let middle = window.world_corner().as_vec2() + 0.5 * 2.0 * CELL * FINE as f32;
        let points = around(middle);
        let [both, truth] = trial.heights(&points);
        let error = |found: &[f64]| rms(found.iter().zip(&truth).map(|(a, b)| a - b)) / rms(truth.iter().copied());
        rows.push(row("boat: both together", error(&both), "fine cells everywhere; rms of its wake").bound(12.0));
        trial.coarse.set_holes(&[]);
        let coarse = error(&trial.each(&points)[1]);
        let row = Row::new("nested", format!("{name}, boat: the coarse grid alone")).param("cells_ratio", 2);
        rows.push(row.error(100.0 * coarse, "%", "fine cells everywhere; rms of its wake"));
        picture(&both, &truth, &context.out.join(format!("nested-{}.png", rows.len() / 4)))?;
    }
    Ok(rows)
}

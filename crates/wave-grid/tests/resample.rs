//! Waves that go on in a grid of other cells, against the closed form of a ring.

use std::f64::consts::PI;

use glam::{DVec2, Vec2};
use wave_grid::{GridDesc, GridSample, Source, WaveGrid};

const SPEED: f64 = 20.0;
const TICK: f64 = 1.0 / 60.0;
/// Ticks before the hand-over and after it.
const TICKS: usize = 24;
/// Width of the hump that the ring comes from, metres.
const WIDTH: f64 = 2.0;

/// 64 m of cells of .25 m, two sub-steps, or twice that and one.
fn grid(fine: bool) -> WaveGrid {
    let cells = if fine { 256 } else { 128 };
    let cell_size = [64.0 / cells as f32; 2];
    let desc = GridDesc { cells: [cells; 2], cell_size, wave_speed: SPEED as f32, ..GridDesc::default() };
    let grid = WaveGrid::new(desc).unwrap();
    assert_eq!(grid.stepping().substeps, if fine { 2 } else { 1 });
    grid
}

/// J0 by its integral.
fn bessel(x: f64) -> f64 {
    let n = 64;
    (0..n).map(|i| (x * (PI * (f64::from(i) + 0.5) / f64::from(n)).sin()).cos()).sum::<f64>() / f64::from(n)
}

/// Height of the hump exp(-r^2 / (2 w^2)), let go at t = 0: int k w^2 exp(-k^2 w^2 / 2) cos(c k t) J0(k r) dk.
fn ring(r: f64, t: f64) -> f64 {
    let (n, most) = (200, 6.0 / WIDTH);
    let step = most / f64::from(n);
    (0..n)
        .map(|i| {
            let k = step * (f64::from(i) + 0.5);
            k * WIDTH * WIDTH * (-0.5 * (k * WIDTH).powi(2)).exp() * (SPEED * k * t).cos() * bessel(k * r) * step
        })
        .sum()
}

/// The ring's heights by the distance, every 5 cm.
struct Rings(Vec<f64>);

impl Rings {
    fn new(t: f64) -> Self {
        Self((0..960).map(|i| ring(f64::from(i) * 0.05, t)).collect())
    }

    fn at(&self, r: f64) -> f64 {
        let x = r / 0.05;
        let i = (x as usize).min(self.0.len() - 2);
        self.0[i] + (x - i as f64) * (self.0[i + 1] - self.0[i])
    }
}

fn impose(grid: &mut WaveGrid) {
    let window = grid.window();
    let field = |t: f64| -> Vec<f32> {
        let rings = Rings::new(t);
        let n = window.cells[0];
        (0..n * n)
            .map(|at| {
                let cell = DVec2::new(f64::from(at % n), f64::from(at / n)) + 0.5;
                rings.at((window.world_corner() + cell * f64::from(window.cell_size[0])).length()) as f32
            })
            .collect()
    };
    let (now, before) = (field(0.0), field(-grid.stepping().dt));
    grid.impose(&now, &before).unwrap();
}

/// Points over the ring, on no lattice.
fn points() -> Vec<Vec2> {
    (0..4000u16).map(|i| Vec2::from_angle(f32::from(i) * 2.399_963) * 0.34 * f32::from(i).sqrt()).collect()
}

fn heights(grid: &WaveGrid, points: &[Vec2]) -> Vec<f64> {
    let mut out = vec![GridSample::default(); points.len()];
    grid.sample(points, &mut out);
    out.iter().map(|sample| f64::from(sample.height)).collect()
}

fn rms(values: impl Iterator<Item = f64> + Clone) -> f64 {
    (values.clone().map(|v| v * v).sum::<f64>() / values.count() as f64).sqrt()
}

/// Error against the closed form after both runs over its root mean square, and the largest step of the heights at the
/// hand-over over the highest.
fn run(first: bool, then: bool) -> (f64, f64) {
    let points = points();
    let mut old = grid(first);
    impose(&mut old);
    (0..TICKS).for_each(|_| old.tick());
    let mut new = grid(then);
    new.resample(&old);
    let (before, after) = (heights(&old, &points), heights(&new, &points));
    let highest = before.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    let step = before.iter().zip(&after).fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / highest;
    (0..TICKS).for_each(|_| new.tick());
    let truth = Rings::new(2.0 * TICKS as f64 * TICK);
    let truth: Vec<f64> = points.iter().map(|p| truth.at(f64::from(p.length()))).collect();
    let found = heights(&new, &points);
    let error = rms(found.iter().zip(&truth).map(|(a, b)| a - b)) / rms(truth.iter().copied());
    (error, step)
}

#[test]
fn a_ring_goes_on_in_other_cells_as_it_did() {
    let ((fine, _), (coarse, _)) = (run(true, true), run(false, false));
    let ((down, step_down), (up, step_up)) = (run(true, false), run(false, true));
    assert!(fine < 0.009 && coarse < 0.032, "{fine} {coarse}");
    // Half of the time in the coarse cells.
    assert!(down < 0.7 * coarse && up < 0.7 * coarse, "{down}, {up} against {coarse}");
    assert!(step_down < 0.002 && step_up < 0.001, "{step_down} {step_up}");
}

#[test]
fn the_volume_is_kept_and_foam_comes_along() {
    for (from, to) in [(true, false), (false, true)] {
        let (mut old, mut new) = (grid(from), grid(to));
        // Off the middle of any cell.
        let center = Vec2::new(3.21, -4.57);
        assert!(old.add(Source::Displacement { center, radius: 2.0, volume: 3.0 }));
        assert!(old.add(Source::Turbulence { center, radius: 2.0, foam: 0.8 }));
        (0..20).for_each(|_| old.tick());
        new.resample(&old);
        assert!((new.volume() - old.volume()).abs() < 1e-5, "{} {}", new.volume(), old.volume());
        let foam = |grid: &WaveGrid| {
            let [nx, nz] = grid.desc().cells;
            let mut cells = vec![[0.0; 2]; (nx * nz) as usize];
            grid.draw(1.0, &mut cells);
            cells.iter().map(|cell| f64::from(cell[1])).sum::<f64>() * f64::from(grid.desc().cell_size[0]).powi(2)
        };
        assert!(foam(&old) > 1.0 && (foam(&new) / foam(&old) - 1.0).abs() < 0.02, "{} {}", foam(&new), foam(&old));
        (0..60).for_each(|_| new.tick());
        assert!(new.is_finite());
    }
}

#[test]
fn what_is_elsewhere_or_asleep_leaves_calm_water() {
    let (mut old, mut new) = (grid(true), grid(false));
    new.add(Source::Displacement { center: Vec2::ZERO, radius: 2.0, volume: 1.0 });
    new.resample(&old);
    assert!(new.is_asleep() && new.volume() == 0.0);
    impose(&mut old);
    new.center_on(DVec2::new(500.0, 0.0));
    new.resample(&old);
    new.tick();
    assert!(new.is_asleep() && new.is_finite() && new.volume() == 0.0);
}

use super::*;
use wave_grid::{GridDesc, WaveGrid};

const DT: f32 = 1.0 / 60.0;

/// A wave that swings up and down everywhere, and what a window of it shows.
struct Swing {
    mirror: Mirror,
    seen: Hole,
    omega: f32,
}

impl Swing {
    fn new(omega: f32) -> Self {
        let desc = GridDesc { cells: [96, 64], cell_size: [0.5; 2], ..GridDesc::default() };
        let seen = WaveGrid::new(desc).unwrap().hole(1.0);
        Self { mirror: Mirror::new(desc.cells, desc.cell_size, DT), seen, omega }
    }

    fn height(&self, tick: u64, x: f32) -> f32 {
        0.3 * (self.omega * tick as f32 * DT - 0.6 * x).sin()
    }

    fn copy(&mut self, tick: u64, corner: [i64; 2]) {
        let heights = [tick, tick - 1].map(|tick| -> Vec<f32> {
            let x = |at: usize| (corner[0] as f32 + (at % 96) as f32 + 0.5) * 0.5;
            (0..96 * 64).map(|at| self.height(tick, x(at))).collect()
        });
        self.mirror.take(tick, corner, |out| {
            out.into_iter().zip(heights).for_each(|(out, heights)| *out = heights);
            true
        });
    }

    fn sample(&self, point: Vec2) -> GridSample {
        let mut out = [GridSample::default()];
        self.mirror.sample(&[point], &self.seen, &[], &mut out);
        out[0]
    }
}

const CORNER: [i64; 2] = [-48, -32];

#[test]
fn waves_are_carried_on_to_the_last_tick() {
    let mut swing = Swing::new(5.0);
    assert_eq!((swing.sample(Vec2::ZERO), swing.mirror.tick()), (GridSample::default(), None));
    for (tick, corner) in [(10, CORNER), (12, [-47, -32]), (13, [-47, -32])] {
        swing.copy(tick, corner);
        let now = tick + 6;
        swing.mirror.follow(now, &[]);
        for x in [-3.0, 0.2, 5.3].into_iter().filter(|_| tick > 10) {
            let (found, truth) = (swing.sample(Vec2::new(x, 1.0)), swing.height(now, x));
            // 6 7 8 / 6 of the third derivative's, and what the kernel adds.
            assert!((found.height - truth).abs() < 0.0105, "{tick} {x}: {found:?}, {truth}");
            let rate = (truth - swing.height(now - 1, x)) / DT;
            assert!((found.vertical_velocity - rate).abs() < 0.25, "{x}: {found:?}, {rate}");
            let slope = (swing.height(now, x + 0.01) - truth) / 0.01;
            assert!((found.slope - Vec2::X * slope).length() < 0.03, "{x}: {found:?}, {slope}");
        }
    }
    // Nothing is seen in a hole.
    let mut out = [GridSample::default()];
    swing.mirror.sample(&[Vec2::new(5.3, 1.0)], &swing.seen, &[swing.seen], &mut out);
    assert_eq!(out[0].height, 0.0);
    // Outside, and nowhere.
    for point in [Vec2::new(23.4, 0.0), Vec2::splat(f32::NAN), Vec2::splat(f32::INFINITY)] {
        assert_eq!(swing.sample(point), GridSample::default());
        assert_eq!(swing.mirror.doubt(point, &swing.seen), None);
    }
    // Over a copy that came twice or too late nothing changes.
    swing.copy(11, CORNER);
    assert_eq!(swing.mirror.tick(), Some(13));
    swing.mirror.still();
    swing.copy(13, CORNER);
    assert_eq!(swing.mirror.tick(), None);
}

#[test]
fn the_error_is_as_expected() {
    for (omega, lag) in [(3.0, 6), (6.0, 6), (6.0, 3), (4.0, 12)] {
        let mut swing = Swing::new(omega);
        let points: Vec<Vec2> = (0..60).map(|i| Vec2::new(-9.0 + 0.3 * i as f32, 2.0)).collect();
        let (mut errors, mut expected) = (0.0, 0.0);
        for tick in 2..200 {
            if tick > lag {
                swing.copy(tick - lag, CORNER);
            }
            swing.mirror.follow(tick, &[]);
            if tick > 60 {
                for point in &points {
                    errors += (swing.sample(*point).height - swing.height(tick, point.x)).powi(2);
                    let [age, error] = swing.mirror.doubt(*point, &swing.seen).unwrap();
                    assert!((age - lag as f32 * DT).abs() < 1e-6 && error > 0.0);
                    expected += error * error;
                }
            }
        }
        let ratio = (expected / errors).sqrt();
        assert!((0.7..1.4).contains(&ratio), "{omega} {lag}: {ratio}");
        // Of waves that are there anew nothing is known but their height.
        swing.mirror.still();
        swing.copy(200, CORNER);
        swing.mirror.follow(206, &[]);
        let [_, error] = swing.mirror.doubt(points[30], &swing.seen).unwrap();
        assert!(error > 0.15, "{omega} {lag}: {error} m");
    }
}

#[test]
fn what_comes_no_more_stays_bounded() {
    let mut swing = Swing::new(9.0);
    (10..20).for_each(|tick| swing.copy(tick, CORNER));
    for tick in 20..400 {
        swing.mirror.follow(tick, &[]);
        let sample = swing.sample(Vec2::new(1.0, 1.0));
        let [_, error] = swing.mirror.doubt(Vec2::new(1.0, 1.0), &swing.seen).unwrap();
        assert!(sample.height.abs() < 0.5 && error < 0.5, "{tick}: {sample:?} {error}");
        if tick > 60 {
            assert!((sample.height - swing.height(19, 1.0)).abs() < 0.03 && sample.vertical_velocity == 0.0);
        }
    }
}

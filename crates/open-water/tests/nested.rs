//! A fine grid in a coarse one.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, Controls, Edges, Follow, GridDesc, GridId, Hull, OpenWater,
    OpenWaterDesc, OpenWaterError, Preset, Radiation, Scheme, WaterSample,
};

const DT: f32 = 1.0 / 60.0;

fn calm() -> OpenWater {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    OpenWater::headless(desc).unwrap()
}

fn grid(follow: Follow, cells: u32, cell: f32) -> GridDesc {
    let wave = GridDesc { scheme: Scheme::NinePoint, wave_speed: 6.2, ..GridDesc::default() };
    GridDesc { follow, cells: [cells; 2], cell_size: [cell; 2], border: Border::Absorbing { width: 12 }, ..wave }
}

struct Run {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
}

impl Run {
    /// A boat of 6 m under way.
    fn new(radiation: Radiation) -> Self {
        let mut water = calm();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        let boat = water.add_body(BodyDesc { radiation, ..BodyDesc::boat(&hull, 4_000.0, 10.0) }).unwrap();
        water.set_controls(boat, Controls { throttle: 0.6, ..Controls::default() }).unwrap();
        let mut store = BodyStates::default();
        let start = water.body(boat).unwrap().state();
        store.insert(boat, BodyState { velocity: Vec3::X * 5.0, ..start });
        Self { water, store, boat }
    }

    fn ticks(&mut self, count: usize) -> Vec3 {
        for _ in 0..count {
            for tick in self.water.advance(DT) {
                self.water.tick(tick, &mut self.store).unwrap();
            }
        }
        self.store.get(self.boat).unwrap().position
    }

    fn heights(&self, points: &[Vec2]) -> Vec<f32> {
        let mut out = vec![WaterSample::default(); points.len()];
        self.water.sample(points, &mut out);
        out.iter().map(|sample| sample.height).collect()
    }
}

fn rms(values: impl Iterator<Item = f32>) -> f32 {
    values.map(|v| v * v).sum::<f32>().sqrt()
}

/// What one differs from the other by, over the other.
fn error(found: &[f32], truth: &[f32]) -> f32 {
    rms(found.iter().zip(truth).map(|(a, b)| a - b)) / rms(truth.iter().copied())
}

#[test]
fn a_boat_in_a_fine_grid_in_a_coarse_one_draws_one_wake() {
    for radiation in [Radiation::Coefficients, Radiation::Grid] {
        let (mut both, mut one) = (Run::new(radiation), Run::new(radiation));
        let follow = Follow::Body(both.boat);
        let around = both.water.add_grid(grid(follow, 192, 0.5)).unwrap();
        let fine = both.water.add_grid(GridDesc { within: Some(around), ..grid(follow, 160, 0.25) }).unwrap();
        one.water.add_grid(grid(Follow::Body(one.boat), 384, 0.25)).unwrap();
        let (place, truth) = (both.ticks(420), one.ticks(420));
        assert!(place.distance(truth) < 0.02 && place.x > 20.0, "{place} {truth}");
        assert_eq!(both.water.home(both.boat).unwrap(), Some(fine));
        // Where the fine grid alone is seen, and everywhere: there the coarse one's errors of short waves come in.
        let [near, all] = [13.0, 38.0].map(|reach: f32| {
            let at = |i: i32| (i as f32 / 40.0 - 1.0) * reach;
            let points: Vec<Vec2> = (0..81 * 81).map(|i| Vec2::new(place.x + at(i % 81), at(i / 81))).collect();
            error(&both.heights(&points), &one.heights(&points))
        });
        assert!(near < 0.03 && all < 0.2, "{radiation:?}: {near} {all}");
    }
}

#[test]
fn a_fine_grid_comes_and_goes_without_a_jump() {
    let mut run = Run::new(Radiation::Coefficients);
    let follow = Follow::Body(run.boat);
    let around = run.water.add_grid(grid(follow, 192, 0.5)).unwrap();
    let place = run.ticks(240);
    // Beside the hull, where the fine cells come to be.
    let points: Vec<Vec2> =
        (0..400).map(|i| Vec2::new(place.x - 14.0 + (i % 40) as f32 * 0.5, -9.0 + (i / 40) as f32 * 0.5)).collect();
    let before = run.heights(&points);
    let fine = run.water.add_grid(GridDesc { within: Some(around), ..grid(follow, 160, 0.25) }).unwrap();
    let with = error(&run.heights(&points), &before);
    assert!(with < 0.05, "{with} when it comes");
    run.ticks(60);
    run.water.remove_grid(fine).unwrap();
    let mut last = run.heights(&points);
    let mut worst = 0.0f32;
    for _ in 0..70 {
        run.ticks(1);
        let now = run.heights(&points);
        worst = worst.max(error(&now, &last));
        last = now;
    }
    // Waves of 5 m/s and 8 m go on by some 7 % of a wave in a tick, that is .4 of their height.
    assert!(worst < 0.45, "{worst} from tick to tick when it goes");
    assert_eq!(run.water.home(run.boat).unwrap(), Some(around));
    assert_eq!(run.water.grid_count(), 1);
}

#[test]
fn what_lies_in_a_grid_that_goes_stays() {
    let mut run = Run::new(Radiation::Grid);
    let follow = Follow::Body(run.boat);
    let far = run.water.add_grid(grid(follow, 192, 1.0)).unwrap();
    let around = run.water.add_grid(GridDesc { within: Some(far), ..grid(follow, 192, 0.5) }).unwrap();
    let fine = run.water.add_grid(GridDesc { within: Some(around), ..grid(follow, 160, 0.25) }).unwrap();
    run.ticks(60);
    run.water.remove_grid(around).unwrap();
    run.ticks(90);
    assert_eq!(run.water.home(run.boat).unwrap(), Some(fine));
    run.water.remove_grid(far).unwrap();
    let place = run.ticks(90);
    let point = [Vec2::new(place.x - 6.0, 2.0)];
    assert!(run.heights(&point)[0].is_finite() && place.is_finite());
    assert_eq!(run.water.grid_count(), 1);
}

#[test]
fn what_cannot_lie_in_one_another_is_refused() {
    let mut water = calm();
    let here = Follow::Fixed(DVec2::ZERO);
    let around = water.add_grid(grid(here, 256, 0.5)).unwrap();
    let fine = |within: GridId| GridDesc { within: Some(within), ..grid(here, 128, 0.25) };
    let mut refused = |desc: GridDesc, word: &str| {
        let error = water.add_grid(desc).unwrap_err();
        assert!(matches!(error, OpenWaterError::Within(_)) && error.to_string().contains(word), "{error}");
    };
    refused(GridDesc { cell_size: [0.5; 2], ..fine(around) }, "larger cells");
    refused(GridDesc { cells: [768; 2], cell_size: [0.2; 2], ..fine(around) }, "larger window");
    refused(GridDesc { wave_speed: 5.0, ..fine(around) }, "wave_speed");
    refused(GridDesc { scheme: Scheme::Dispersive, ..fine(around) }, "like scheme");
    refused(GridDesc { border: Border::Reflecting, ..fine(around) }, "absorbs");
    refused(GridDesc { follow: Follow::Fixed(DVec2::new(55.0, 0.0)), ..fine(around) }, "lies in");
    refused(GridDesc { feed: Edges { low_x: true, ..Edges::default() }, ..fine(around) }, "not fed");
    let rain = water.add_grid(GridDesc { border: Border::Periodic, ..grid(here, 256, 0.5) }).unwrap();
    assert!(water.add_grid(fine(rain)).unwrap_err().to_string().contains("repeat"));
    water.remove_grid(around).unwrap();
    assert!(matches!(water.add_grid(fine(around)), Err(OpenWaterError::UnknownGrid(_))));
}

#[test]
fn schemes_that_no_home_can_give_are_refused() {
    let mut water = calm();
    for scheme in [Scheme::Dispersive, Scheme::Spectral] {
        let fed = GridDesc {
            scheme,
            feed: Edges { low_x: true, ..Edges::default() },
            ..grid(Follow::Fixed(DVec2::ZERO), 128, 0.5)
        };
        let error = water.add_grid(fed).unwrap_err().to_string();
        assert!(error.contains("wave equation"), "{error}");
    }
    let home = open_water::GridHome::Gpu;
    let spectral = GridDesc { scheme: Scheme::Spectral, home, ..GridDesc::default() };
    let error = water.add_grid(spectral).unwrap_err().to_string();
    assert!(error.contains("Spectral") && error.contains("home on the CPU"), "{error}");
}

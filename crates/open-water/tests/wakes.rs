//! Grids that bodies get by themselves.

use glam::{Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Controls, Follow, GridDesc, Hull, Look, OpenWater, OpenWaterDesc, Preset,
    Scheme, Wake, WakesDesc, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const CELLS: u64 = 160 * 160;

struct Fleet {
    water: OpenWater,
    store: BodyStates,
    boats: Vec<BodyId>,
}

/// Wakes of 160 x 160 cells of .25 m, as many as `grids` hold.
fn wakes(grids: u64) -> WakesDesc {
    let wave = GridDesc { scheme: Scheme::NinePoint, wave_speed: 6.2, ..GridDesc::default() };
    let grid = GridDesc { cells: [160; 2], cell_size: [0.25; 2], ..wave };
    WakesDesc { grid, cells: grids * CELLS, fine: 100.0, ..WakesDesc::default() }
}

/// Boats 60 m apart along z that run along x.
fn fleet(boats: u32, desc: WakesDesc) -> Fleet {
    let mut calm: OpenWaterDesc = Preset::Low.water();
    calm.sea.partitions.clear();
    let mut water = OpenWater::headless(calm).unwrap();
    water.set_wakes(Some(desc)).unwrap();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let mut store = BodyStates::default();
    let boats = (0..boats).map(|i| {
        let id = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
        water.set_controls(id, Controls { throttle: 0.9, ..Controls::default() }).unwrap();
        let start = water.body(id).unwrap().state();
        let position = start.position + Vec3::Z * (60.0 * i as f32);
        store.insert(id, BodyState { position, velocity: Vec3::X * 8.0, ..start });
        id
    });
    let boats = boats.collect();
    Fleet { water, store, boats }
}

impl Fleet {
    fn run(&mut self, ticks: usize) {
        for _ in 0..ticks {
            for tick in self.water.advance(DT) {
                self.water.tick(tick, &mut self.store).unwrap();
            }
        }
    }

    /// From `distance` metres beside a boat.
    fn look_at(&mut self, boat: usize, distance: f32) {
        let at = self.store.get(self.boats[boat]).unwrap().position;
        let eye = at + Vec3::new(0.0, 0.3, -1.0).normalize() * distance;
        self.water.look(Look { eye, direction: at - eye, fov_y: 0.9, aspect: 1.6 });
    }

    fn wake(&self, boat: usize) -> Wake {
        self.water.wake(self.boats[boat]).unwrap()
    }

    /// Its cells, metres.
    fn cells(&self, boat: usize) -> Option<f32> {
        match self.wake(boat) {
            Wake::Grid { cell_size, .. } => Some(cell_size[0]),
            _ => None,
        }
    }

    /// Heights over a square.
    fn heights(&self, around: Vec2, across: f32) -> Vec<f32> {
        let place = |i: i32| (i as f32 / 30.0 - 0.5) * across;
        let points: Vec<Vec2> = (0..900).map(|i| around + Vec2::new(place(i % 30), place(i / 30))).collect();
        let mut out = vec![WaterSample::default(); points.len()];
        self.water.sample(&points, &mut out);
        out.iter().map(|sample| sample.height).collect()
    }
}

#[test]
fn the_boats_nearest_the_eye_have_grids_within_the_budget() {
    let mut fleet = fleet(6, wakes(2));
    for turn in 0..3 {
        // To the boats 0, 5 and 2.
        let near = [0, 5, 2][turn];
        for _ in 0..25 {
            fleet.look_at(near, 15.0);
            fleet.run(10);
            // No grid is held twice, none beyond the budget: of those that fade, too.
            assert!(fleet.water.grid_count() <= 2);
        }
        assert_eq!(fleet.cells(near), Some(0.25), "boat {near} in turn {turn}");
        let with: Vec<usize> = (0..6).filter(|boat| fleet.cells(*boat).is_some()).collect();
        assert!(with.len() == 2 && with.iter().all(|boat| boat.abs_diff(near) <= 1), "{with:?} in turn {turn}");
        assert!((0..6).filter(|boat| !with.contains(boat)).all(|boat| fleet.wake(boat) == Wake::NoRoom));
    }
}

#[test]
fn larger_cells_hold_more_boats_and_bodies_that_need_none_say_why() {
    // One grid's room: the first boat's, until the eye is far away and coarse ones find room in it.
    let mut fleet = fleet(5, wakes(1));
    let crate_hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
    let float = fleet.water.add_body(BodyDesc::from_hull(&crate_hull, 300.0)).unwrap();
    let parked =
        fleet.water.add_body(BodyDesc::boat(&Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap(), 4e3, 9.0)).unwrap();
    let away = fleet.water.add_body(BodyDesc::from_hull(&crate_hull, 300.0)).unwrap();
    fleet.store.insert(float, BodyState::at_rest(Vec3::new(3.0, 0.0, -30.0)));
    fleet.store.insert(parked, BodyState::at_rest(Vec3::new(30.0, 0.0, -60.0)));
    fleet.look_at(0, 12.0);
    fleet.run(120);
    assert_eq!(fleet.cells(0), Some(0.25));
    assert_eq!((1..5).filter_map(|boat| fleet.cells(boat)).count(), 0);
    let why = |body| fleet.water.wake(body).unwrap();
    assert_eq!((why(float), why(parked), why(away)), (Wake::Short, Wake::Still, Wake::NotAsked));
    assert!(Wake::NoRoom.to_string().contains("room"));
    for _ in 0..30 {
        fleet.look_at(0, 160.0);
        fleet.run(10);
    }
    assert_eq!(fleet.cells(0), Some(0.5), "{:?}", fleet.wake(0));
    assert!((0..5).filter_map(|boat| fleet.cells(boat)).filter(|h| *h == 0.5).count() >= 3);
    let own = GridDesc { follow: Follow::Body(fleet.boats[4]), ..wakes(1).grid };
    let own = fleet.water.add_grid(own).unwrap();
    fleet.run(30);
    let wake = fleet.wake(4);
    assert!(matches!(wake, Wake::OwnGrid | Wake::Grid { .. }), "{wake:?}");
    fleet.water.remove_grid(own).unwrap();
    fleet.water.set_wakes(None).unwrap();
    fleet.run(90);
    assert_eq!((fleet.water.grid_count(), fleet.wake(0)), (0, Wake::NotAsked));
}

#[test]
fn a_wake_that_gets_larger_cells_looks_on_as_it_did() {
    let (mut changing, mut fine) = (fleet(1, wakes(4)), fleet(1, wakes(4)));
    changing.look_at(0, 20.0);
    fine.look_at(0, 20.0);
    changing.run(180);
    fine.run(180);
    let mut seen = 0;
    let mut last: Option<[Vec<f32>; 2]> = None;
    for i in 0..90 {
        // From here on it is 130 m away, and changes within a quarter of a second.
        changing.look_at(0, 130.0);
        fine.look_at(0, 20.0);
        changing.run(1);
        fine.run(1);
        let at = fine.store.get(fine.boats[0]).unwrap().position;
        assert_eq!(at, changing.store.get(changing.boats[0]).unwrap().position, "the boat does not feel it");
        seen += usize::from(changing.cells(0) == Some(0.5));
        // Where neither window fades: from 10 m behind the boat to 6 m ahead of it.
        let [found, truth] = [&changing, &fine].map(|fleet| fleet.heights(Vec2::new(at.x - 2.0, at.z), 16.0));
        let rms = |values: &mut dyn Iterator<Item = f32>| values.map(|v| v * v).sum::<f32>().sqrt();
        let size = rms(&mut truth.iter().copied());
        let error = rms(&mut found.iter().zip(&truth).map(|(a, b)| a - b)) / size;
        // What larger cells do not carry of the wake goes slowly.
        assert!(error < 0.004 * (i + 1) as f32 && error < 0.25, "{i}: {error}");
        let heights = [&changing, &fine].map(|fleet| fleet.heights(Vec2::new(20.0, 0.0), 24.0));
        if let Some([before, before_fine]) = &last {
            let step = |a: &[f32], b: &[f32]| a.iter().zip(b).fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
            let (step, usual) = (step(&heights[0], before), step(&heights[1], before_fine));
            assert!(step < 1.3 * usual + 1e-3, "{i}: {step} m in a tick, {usual} m without a change");
        }
        last = Some(heights);
    }
    assert!((60..=90).contains(&seen), "{seen}");
}

#[test]
fn a_wake_that_is_taken_away_fades() {
    let mut fleet = fleet(2, wakes(1));
    fleet.look_at(0, 12.0);
    fleet.run(180);
    let around = Vec2::new(fleet.store.get(fleet.boats[0]).unwrap().position.x - 6.0, 0.0);
    let highest = |heights: &[f32]| heights.iter().fold(0.0f32, |most, h| most.max(h.abs()));
    let mut last = fleet.heights(around, 24.0);
    let high = highest(&last);
    assert!(high > 0.1, "{high}");
    for _ in 0..110 {
        fleet.look_at(1, 8.0);
        fleet.run(1);
        let now = fleet.heights(around, 24.0);
        let step = now.iter().zip(&last).fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
        assert!(step < 0.2 * high, "{step} of {high} in a tick");
        last = now;
    }
    assert!(highest(&last) < 1e-3 && fleet.cells(0).is_none() && fleet.cells(1).is_some());
}

#[test]
fn bad_descriptions_are_refused() {
    let mut fleet = fleet(1, wakes(1));
    let mut refused = |desc: WakesDesc| fleet.water.set_wakes(Some(desc)).unwrap_err().to_string();
    assert!(refused(WakesDesc { cells: 100, ..wakes(1) }).contains("wakes: cells is 100"));
    assert!(refused(WakesDesc { fine: f32::NAN, ..wakes(1) }).contains("wakes: fine is NaN"));
    assert!(refused(WakesDesc { least_length: -1.0, ..wakes(1) }).contains("wakes: least_length is -1"));
    let fast = GridDesc { wave_speed: 600.0, ..wakes(1).grid };
    assert!(refused(WakesDesc { grid: fast, ..wakes(1) }).contains("600"));
    fleet.run(30);
    assert!(fleet.cells(0).is_some(), "nothing was changed");
}

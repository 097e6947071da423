//! The façade on the CPU: what a server runs.

use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, BodyStore, Border, Controls, Follow, GridDesc, Hull, Look, OpenWater,
    OpenWaterDesc, OpenWaterError, Preset, Quality, Radiation, Scheme, Tick, WaterSample,
};

const DT: f32 = 1.0 / 60.0;

fn small_sea() -> OpenWaterDesc {
    Preset::Low.water()
}

fn calm() -> OpenWaterDesc {
    let mut desc = small_sea();
    desc.sea.partitions.clear();
    desc
}

fn small_grid() -> GridDesc {
    GridDesc { cells: [128; 2], border: Border::Absorbing { width: 8 }, ..GridDesc::default() }
}

fn boat() -> BodyDesc {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    BodyDesc::boat(&hull, 4_000.0, 10.0)
}

fn run(water: &mut OpenWater, store: &mut dyn BodyStore, ticks: usize) {
    for _ in 0..ticks {
        for tick in water.advance(DT) {
            water.tick(tick, store).unwrap();
        }
    }
}

fn with_boat(desc: OpenWaterDesc) -> (OpenWater, BodyStates, BodyId) {
    let mut water = OpenWater::headless(desc).unwrap();
    let id = water.add_body(boat()).unwrap();
    water.add_grid(GridDesc { follow: Follow::Body(id), ..small_grid() }).unwrap();
    water.set_controls(id, Controls { throttle: 1.0, ..Controls::default() }).unwrap();
    let mut store = BodyStates::default();
    store.insert(id, water.body(id).unwrap().state());
    (water, store, id)
}

#[test]
fn a_boat_drives_and_leaves_a_wake() {
    let (mut water, mut store, id) = with_boat(calm());
    run(&mut water, &mut store, 300);
    let state = *store.get(id).unwrap();
    assert!(state.position.x > 10.0, "{state:?}");
    let behind: Vec<Vec2> = (0..60).map(|i| Vec2::new(state.position.x - 5.0, (i as f32 - 30.0) * 0.15)).collect();
    let mut out = vec![WaterSample::default(); behind.len()];
    water.sample(&behind, &mut out);
    let highest = out.iter().map(|s| s.height.abs()).fold(0.0, f32::max);
    assert!((0.01..2.5).contains(&highest), "wake of {highest} m");
}

#[test]
fn the_wake_lifts_flotsam_that_floats_in_it() {
    let hull = Hull::cuboid(Vec3::new(0.5, 0.5, 0.5)).unwrap();
    let reach = |throttle: f32| {
        let (mut water, mut store, boat) = with_boat(calm());
        water.set_controls(boat, Controls { throttle, ..Controls::default() }).unwrap();
        let id = water.add_body(BodyDesc::from_hull(&hull, 60.0)).unwrap();
        let start = water.body(id).unwrap().state();
        store.insert(id, BodyState { position: start.position + Vec3::new(9.0, 0.0, 3.5), ..start });
        (0..300).fold(0.0f32, |reach, _| {
            run(&mut water, &mut store, 1);
            reach.max((store.get(id).unwrap().position.y - start.position.y).abs())
        })
    };
    let (passed, left) = (reach(1.0), reach(0.0));
    assert!((0.05..0.8).contains(&passed) && left < 0.2 * passed, "{passed} m in the wake, {left} m without");
}

#[test]
fn a_body_that_rides_the_ambient_sea_makes_almost_no_waves() {
    let mut water = OpenWater::headless(small_sea()).unwrap();
    let hull = Hull::cuboid(Vec3::new(0.5, 0.5, 0.5)).unwrap();
    let id = water.add_body(BodyDesc::from_hull(&hull, 60.0)).unwrap();
    let grid = water.add_grid(GridDesc { follow: Follow::Body(id), ..small_grid() }).unwrap();
    let mut store = BodyStates::default();
    store.insert(id, water.body(id).unwrap().state());
    run(&mut water, &mut store, 240);
    let heights = water.grid(grid).unwrap().unwrap().heights();
    let highest = heights.iter().fold(0.0f32, |m, z| m.max(z.abs()));
    assert!(highest < 0.1, "{highest} m");
}

#[test]
fn the_same_run_twice_and_on_one_thread_gives_the_same_bits() {
    let once = || {
        let (mut water, mut store, id) = with_boat(small_sea());
        run(&mut water, &mut store, 60);
        let s = *store.get(id).unwrap();
        [s.position, s.velocity, s.angular_velocity].map(|v| v.to_array().map(f32::to_bits))
    };
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(once);
    let many = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap().install(once);
    assert_eq!(alone, many);
}

#[test]
fn what_a_game_may_throw_at_it_stays_finite() {
    let (mut water, mut store, id) = with_boat(small_sea());
    run(&mut water, &mut store, 30);
    let nan = f32::NAN;
    let bad = [
        BodyState { position: Vec3::splat(nan), ..*store.get(id).unwrap() },
        BodyState { velocity: Vec3::splat(f32::INFINITY), ..*store.get(id).unwrap() },
        BodyState { orientation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..*store.get(id).unwrap() },
        BodyState { position: Vec3::new(5_000.0, 0.0, -7_000.0), ..*store.get(id).unwrap() },
        BodyState { velocity: Vec3::new(500.0, -500.0, 0.0), ..*store.get(id).unwrap() },
    ];
    for state in bad {
        store.insert(id, state);
        water.set_controls(id, Controls { throttle: nan, ..Controls::default() }).unwrap();
        assert!(water.advance(5.0).dropped_secs > 4.0);
        let (mut fresh, mut fresh_store, fresh_id) = with_boat(small_sea());
        fresh_store.insert(fresh_id, state);
        run(&mut fresh, &mut fresh_store, 30);
        let s = fresh_store.get(fresh_id).unwrap();
        assert!(s.position.is_finite() && s.velocity.is_finite() && s.orientation.is_finite(), "{state:?} -> {s:?}");
        let mut out = [WaterSample::default(); 3];
        fresh.sample(&[Vec2::ZERO, Vec2::splat(nan), Vec2::splat(f32::INFINITY)], &mut out);
        assert!(out.iter().all(|o| o.height.is_finite() && o.normal.is_finite()), "{out:?}");
    }
}

#[test]
fn a_teleported_body_does_not_streak_or_splash() {
    let (mut water, mut store, id) = with_boat(calm());
    run(&mut water, &mut store, 120);
    let mut state = *store.get(id).unwrap();
    state.position.z += 400.0;
    store.insert(id, state);
    run(&mut water, &mut store, 1);
    let drawn = water.drawn_pose(id).unwrap();
    assert!((drawn.position.z - 400.0).abs() < 2.0, "{drawn:?}");
    let mut out = [WaterSample::default()];
    water.sample(&[Vec2::new(state.position.x, 400.0)], &mut out);
    assert!(out[0].height.abs() < 0.5, "{out:?}");
}

#[test]
fn handles_of_removed_things_are_refused() {
    let (mut water, mut store, id) = with_boat(calm());
    let grid = water.add_grid(GridDesc { follow: Follow::Fixed(DVec2::ZERO), ..small_grid() }).unwrap();
    water.remove_grid(grid).unwrap();
    assert!(matches!(water.grid(grid), Err(OpenWaterError::UnknownGrid(_))));
    water.remove_body(id).unwrap();
    assert!(matches!(water.body(id), Err(OpenWaterError::UnknownBody(_))));
    assert!(matches!(water.remove_body(id), Err(OpenWaterError::UnknownBody(_))));
    let newer = water.add_body(boat()).unwrap();
    assert_ne!(newer, id);
    run(&mut water, &mut store, 10);
}

#[test]
fn ticks_must_come_in_order() {
    let (mut water, mut store, _) = with_boat(calm());
    let error = water.tick(Tick { index: 7, dt: DT }, &mut store).unwrap_err();
    assert!(error.to_string().contains("tick 7 was given, but tick 1 is due"), "{error}");
}

#[test]
fn wrong_descriptions_name_field_value_and_bound() {
    let text = |desc| OpenWater::headless(desc).map(|_| ()).unwrap_err().to_string();
    let error = text(OpenWaterDesc { tick: f32::NAN, ..small_sea() });
    assert!(error.contains("tick is NaN") && error.contains("0.001 to 0.1"), "{error}");
    let error = text(OpenWaterDesc { max_ticks_per_frame: 0, ..small_sea() });
    assert!(error.contains("max_ticks_per_frame is 0"), "{error}");
    let mut water = OpenWater::headless(calm()).unwrap();
    let error = water
        .add_grid(GridDesc { scheme: Scheme::NinePoint, wave_speed: 500.0, ..small_grid() })
        .unwrap_err()
        .to_string();
    assert!(error.contains("500") && error.contains("0.25"), "{error}");
    let error = water.add_grid(GridDesc { home: open_water::GridHome::Gpu, ..small_grid() }).unwrap_err();
    assert!(matches!(error, OpenWaterError::NoGpu), "{error}");
}

#[test]
fn a_boat_circling_at_speed_through_its_own_wake_stays_sane() {
    let mut water = OpenWater::headless(small_sea()).unwrap();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let id = water.add_body(BodyDesc::boat(&hull, 2_400.0, 16.0)).unwrap();
    let grid = water.add_grid(GridDesc { follow: Follow::Body(id), ..GridDesc::default() }).unwrap();
    water.set_controls(id, Controls { throttle: 1.0, steering: 1.0, ..Controls::default() }).unwrap();
    let mut store = BodyStates::default();
    let start = water.body(id).unwrap().state();
    store.insert(id, BodyState { velocity: Vec3::new(15.0, 0.0, 0.0), ..start });
    let mut fastest = 0.0f32;
    for frame in 0..900 {
        // A hitch and a teleport on the way.
        if frame == 400 {
            assert!(water.advance(5.0).map(|tick| water.tick(tick, &mut store)).all(|r| r.is_ok()));
        }
        if frame == 600 {
            let mut state = *store.get(id).unwrap();
            state.position += Vec3::new(-800.0, 2.0, 300.0);
            store.insert(id, state);
        }
        run(&mut water, &mut store, 1);
        let state = store.get(id).unwrap();
        fastest = fastest.max(state.velocity.length());
        let p = state.position;
        let mut sea = [WaterSample::default()];
        water.sample(&[Vec2::new(p.x, p.z)], &mut sea);
        assert!((p.y - sea[0].height).abs() < 5.0, "frame {frame}: {state:?} over {sea:?}");
        assert!((state.orientation * Vec3::Y).y > 0.0, "capsized in frame {frame}: {state:?}");
    }
    let waves = water.grid(grid).unwrap().unwrap();
    let highest = waves.heights().iter().fold(0.0f32, |m, z| m.max(z.abs()));
    assert!(waves.is_finite() && highest < 5.0, "{highest} m");
    assert!((8.0..25.0).contains(&fastest), "{fastest} m/s");
}

#[test]
fn a_guest_in_the_grid_of_another_makes_no_waves_unless_asked_to() {
    let highest = |radiation| {
        let (mut water, mut store, boat) = with_boat(calm());
        water.set_controls(boat, Controls::default()).unwrap();
        let hull = Hull::cuboid(Vec3::splat(0.7)).unwrap();
        let id = water.add_body(BodyDesc { radiation, ..BodyDesc::from_hull(&hull, 190.0) }).unwrap();
        store.insert(id, BodyState::at_rest(Vec3::new(1.0, 1.2, 3.5)));
        (0..60).fold(0.0f32, |highest, _| {
            run(&mut water, &mut store, 1);
            let mut out = [WaterSample::default(); 2];
            water.sample(&[Vec2::new(1.0, 4.5), Vec2::new(1.0, 3.5)], &mut out);
            out.iter().fold(highest, |most, sample| most.max(sample.height.abs()))
        })
    };
    let (guest, asked) = (highest(Radiation::Coefficients), highest(Radiation::Grid));
    assert!(guest < 1e-3 && asked > 10.0 * guest.max(1e-3), "{guest} m, asked to: {asked} m");
}

#[test]
fn hulls_are_clipped_near_the_eye() {
    let mut water = OpenWater::headless(OpenWaterDesc::default()).unwrap();
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let desc = BodyDesc { quality: Quality::Near(50.0), ..BodyDesc::from_hull(&hull, 4_000.0) };
    let id = water.add_body(desc).unwrap();
    let mut store = BodyStates::default();
    store.insert(id, water.body(id).unwrap().state());
    for (away, share) in [(20.0, 1.0), (200.0, 0.0)] {
        water.look(Look { eye: Vec3::new(away, 3.0, 0.0), direction: -Vec3::X, fov_y: 0.8, aspect: 1.6 });
        for _ in 0..60 {
            for tick in water.advance(1.0 / 60.0) {
                water.tick(tick, &mut store).unwrap();
            }
        }
        assert_eq!(water.body(id).unwrap().clipped_share(), share, "from {away} m");
    }
}

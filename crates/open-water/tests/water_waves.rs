//! Grids of water waves: what a game gets by default, over land, and for hulls of all sizes.

use std::f32::consts::TAU;

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Controls, Damping, DepthMap, Follow, GridDesc, Hull, Land, OpenWater,
    OpenWaterDesc, Preset, Scheme, Wake, WakesDesc, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 9.81;

fn calm() -> OpenWater {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    OpenWater::headless(desc).unwrap()
}

fn boat(water: &mut OpenWater, length: f32) -> BodyId {
    let hull = Hull::cuboid(Vec3::new(length, 0.2 * length, 0.3 * length)).unwrap();
    water.add_body(BodyDesc::boat(&hull, 0.2 * hull.volume() * 1025.0, 10.0)).unwrap()
}

fn tick(water: &mut OpenWater, store: &mut BodyStates) {
    for tick in water.advance(DT) {
        water.tick(tick, store).unwrap();
    }
}

/// Keeps a body on its way along x at this speed for so many ticks.
fn tow(water: &mut OpenWater, store: &mut BodyStates, body: BodyId, speed: f32, ticks: u32) -> Vec3 {
    let start = store.get(body).unwrap().position;
    for i in 0..ticks {
        let position = start + Vec3::X * (speed * DT * i as f32);
        store.insert(body, BodyState { velocity: Vec3::X * speed, ..BodyState::at_rest(position) });
        tick(water, store);
    }
    store.get(body).unwrap().position
}

#[test]
fn the_waves_behind_a_boat_are_as_long_as_its_speed_makes_them() {
    // Nothing said but: wakes.
    let mut water = calm();
    water.set_wakes(Some(WakesDesc::default())).unwrap();
    let body = boat(&mut water, 6.0);
    let mut store = BodyStates::default();
    store.insert(body, water.body(body).unwrap().state());
    let speed = 4.5;
    let place = tow(&mut water, &mut store, body, speed, 1200);
    let points: Vec<Vec2> = (0..300).map(|i| Vec2::new(place.x - 8.0 - 0.1 * i as f32, 0.0)).collect();
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(&points, &mut out);
    let crossings: Vec<f32> = (1..points.len())
        .filter(|i| out[*i - 1].height < 0.0 && out[*i].height >= 0.0)
        .map(|i| points[i].x - 0.1 * out[i].height / (out[i - 1].height - out[i].height))
        .collect();
    assert!(crossings.len() >= 2, "{crossings:?}");
    let length = (crossings[0] - crossings[crossings.len() - 1]) / (crossings.len() - 1) as f32;
    let truth = TAU * speed * speed / GRAVITY;
    assert!((length / truth - 1.0).abs() < 0.08, "{length} m, {truth} m by theory; {crossings:?}");
    assert_eq!(water.reports().long_hulls, 0);
}

#[test]
fn long_hulls_get_large_cells() {
    let mut water = calm();
    water.set_wakes(Some(WakesDesc { cells: 1 << 20, ..WakesDesc::default() })).unwrap();
    let mut store = BodyStates::default();
    let lengths = [6.0, 30.0, 90.0];
    let boats = lengths.map(|length| {
        let body = boat(&mut water, length);
        let state = water.body(body).unwrap().state();
        let position = state.position + Vec3::Z * (4.0 * length);
        store.insert(body, BodyState { velocity: Vec3::X * 0.4 * (GRAVITY * length).sqrt(), position, ..state });
        water.set_controls(body, Controls { throttle: 1.0, ..Controls::default() }).unwrap();
        body
    });
    (0..40).for_each(|_| tick(&mut water, &mut store));
    let cells = boats.map(|body| match water.wake(body).unwrap() {
        Wake::Grid { cell_size, .. } => cell_size[0],
        _ => 0.0,
    });
    assert_eq!(cells, [0.25, 1.0, 2.0]);
    assert_eq!(water.reports().long_hulls, 0);
    // The game knows better.
    let own = water.add_grid(GridDesc { follow: Follow::Body(boats[1]), ..GridDesc::default() }).unwrap();
    (0..60).for_each(|_| tick(&mut water, &mut store));
    assert_eq!(water.home(boats[1]).unwrap(), Some(own));
    assert_eq!(water.reports().long_hulls, 1);
    water.remove_grid(own).unwrap();
}

/// Water over a flat bed at this elevation, and what a hull that bobs has made in a grid of it; the water rises to `level`
/// after a second.
fn bobbing(elevation: f32, level: f32, late: bool) -> Vec<f32> {
    let mut water = calm();
    let bed = DepthMap::new(DVec2::splat(-200.0), 50.0, [9, 9], vec![elevation; 81]).unwrap();
    let damping = Damping::Beach { surf_depth: 0.0, rate: 0.0 };
    if !late {
        water.set_level(level).unwrap();
    }
    water.set_land(Some(Land { damping, ..Land::new(bed) })).unwrap();
    let hull = Hull::cuboid(Vec3::new(3.0, 1.0, 3.0)).unwrap();
    let body = water.add_body(BodyDesc::from_hull(&hull, 3_000.0)).unwrap();
    let follow = Follow::Body(body);
    let grid =
        water.add_grid(GridDesc { follow, cells: [128; 2], cell_size: [0.5; 2], ..GridDesc::default() }).unwrap();
    let mut store = BodyStates::default();
    for i in 0..300 {
        let time = i as f32 * DT;
        if late && i == 60 {
            water.set_level(level).unwrap();
        }
        let calm = if time < 1.0 { 0.0 } else { 0.15 * (TAU * (time - 1.0) / 2.5).sin() };
        store.insert(body, BodyState::at_rest(Vec3::Y * (calm + water.level())));
        tick(&mut water, &mut store);
    }
    water.grid(grid).unwrap().unwrap().heights().to_vec()
}

#[test]
fn the_water_level_is_what_water_waves_feel() {
    let rms = |values: &mut dyn Iterator<Item = f32>| values.map(|v| v * v).sum::<f32>().sqrt();
    let truth = bobbing(-2.5, 0.0, false);
    let size = rms(&mut truth.iter().copied());
    let error = |found: Vec<f32>| rms(&mut found.iter().zip(&truth).map(|(a, b)| a - b)) / size;
    let (risen, shallow) = (error(bobbing(-0.5, 2.0, true)), error(bobbing(-0.5, 0.0, true)));
    assert!(size > 0.0 && risen < 0.02 && shallow > 0.3, "{risen} {shallow}");
}

#[test]
fn open_water_has_water_waves_by_default() {
    for grid in [GridDesc::default(), WakesDesc::default().grid, Preset::Low.grid(), Preset::High.grid()] {
        assert_eq!((grid.scheme, grid.depth), (Scheme::Dispersive, f32::INFINITY));
    }
    assert_eq!(Preset::Paper.grid().scheme, Scheme::FivePoint);
    let mut water = calm();
    let error = water.add_grid(GridDesc { depth: -1.0, ..GridDesc::default() }).unwrap_err().to_string();
    assert!(error.contains("depth = -1"), "{error}");
    let error = water.add_grid(GridDesc { cell_size: [0.25, 0.5], ..GridDesc::default() }).unwrap_err().to_string();
    assert!(error.contains("square"), "{error}");
}

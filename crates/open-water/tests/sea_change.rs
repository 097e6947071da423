//! A change of the sea through the façade: no pops on the open sea, near land and in fed grids.

use glam::{DVec2, Vec2};
use open_water::{
    BodyStates, CascadeDesc, DepthMap, Edges, Follow, GridDesc, GridId, Land, OpenWater, OpenWaterDesc, OpenWaterError,
    SeaState, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const DEPTH: Option<f32> = Some(12.0);

fn light() -> SeaState {
    SeaState { depth: DEPTH, ..SeaState::height_period(0.4, 4.5, 0.0) }
}

fn strong() -> SeaState {
    SeaState { depth: DEPTH, ..SeaState::height_period(1.6, 6.5, 0.5) }
}

fn water(sea: SeaState) -> OpenWater {
    let cascades = vec![CascadeDesc::new(128, 400.0), CascadeDesc::new(32, 75.0)];
    OpenWater::headless(OpenWaterDesc { sea, cascades, ..OpenWaterDesc::default() }).unwrap()
}

/// 12 m of water that shoals to a beach beyond x = 250 m.
fn bay() -> Land {
    let elevation = |i: usize| (-12.0 + ((i % 96) as f32 * 4.0 - 250.0).max(0.0) / 8.0).min(4.0);
    let bed = DepthMap::new(DVec2::ZERO, 4.0, [96; 2], (0..96 * 96).map(elevation).collect());
    Land::new(bed.unwrap())
}

fn fed(water: &mut OpenWater) -> GridId {
    let desc = GridDesc {
        follow: Follow::Fixed(DVec2::new(150.0, 190.0)),
        cells: [120, 120],
        cell_size: 2.0,
        wave_speed: 9.4,
        feed: Edges { low_x: true, ..Edges::default() },
        ..GridDesc::default()
    };
    water.add_grid(desc).unwrap()
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|s| s.height).collect()
}

/// Runs for some seconds; the largest change of a height from tick to tick, and the rms height.
fn run(water: &mut OpenWater, seconds: f32, points: &[Vec2]) -> (f32, f32) {
    let mut store = BodyStates::default();
    let (mut last, mut step, mut square, mut count) = (heights(water, points), 0.0f32, 0.0f64, 0);
    for _ in 0..(seconds / DT) as usize {
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
            let now = heights(water, points);
            step = now.iter().zip(&last).fold(step, |step, (a, b)| step.max((a - b).abs()));
            square += now.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>();
            count += now.len();
            last = now;
        }
    }
    (step, (square / count as f64).sqrt() as f32)
}

fn points(low: Vec2, high: Vec2) -> Vec<Vec2> {
    (0..64).map(|i| low + (high - low) * Vec2::new((i % 8) as f32 / 7.0, (i / 8) as f32 / 7.0)).collect()
}

#[test]
fn the_open_sea_rises_without_a_pop_and_ends_as_the_other_sea() {
    let at = points(Vec2::splat(-90.0), Vec2::splat(90.0));
    let (mut changing, mut after) = (water(light()), water(strong()));
    let (_, before) = run(&mut changing, 2.0, &at);
    changing.change_sea(strong(), 8.0).unwrap();
    let (step, during) = run(&mut changing, 9.0, &at);
    let (usual, full) = run(&mut after, 11.0, &at);
    assert!(step < 1.2 * usual, "{step} against {usual}");
    assert!(before < during && during < full, "{before} {during} {full}");
    assert_eq!(heights(&changing, &at), heights(&after, &at));
    assert_eq!(changing.desc().sea, strong());
}

#[test]
fn maps_of_the_land_and_fed_grids_follow() {
    // At the beach, and within the grid.
    let (shore, basin) =
        (points(Vec2::new(290.0, 60.0), Vec2::new(335.0, 320.0)), points(Vec2::splat(100.0), Vec2::splat(230.0)));
    let all: Vec<Vec2> = shore.iter().chain(&basin).copied().collect();
    let with_land = |sea| {
        let mut water = water(sea);
        water.set_land(Some(bay())).unwrap();
        fed(&mut water);
        water
    };
    let (mut changing, mut after) = (with_land(light()), with_land(strong()));
    let (_, quiet) = run(&mut changing, 20.0, &basin);
    changing.change_sea(strong(), 10.0).unwrap();
    let (step, _) = run(&mut changing, 10.0, &all);
    run(&mut changing, 20.0, &basin);
    let (_, risen) = run(&mut changing, 10.0, &basin);
    run(&mut after, 50.0, &basin);
    let (usual, full) = run(&mut after, 10.0, &all);
    assert!(step < 1.3 * usual, "{step} against {usual}");
    assert!(risen > 2.5 * quiet && (risen / full - 1.0).abs() < 0.3, "{quiet} {risen} {full}");
    // The maps are those of the other sea.
    run(&mut changing, 10.0, &basin);
    let maps = [&changing, &after].map(|water| water.ocean().unwrap().amplitudes().unwrap().factors().to_vec());
    let off = maps[0].iter().flatten().zip(maps[1].iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(off < 1e-6, "{off}");
}

#[test]
fn bad_changes_are_refused_and_change_nothing() {
    let mut calm = water(SeaState { partitions: Vec::new(), depth: None });
    assert!(matches!(calm.change_sea(strong(), 5.0), Err(OpenWaterError::CalmSea)));
    let mut water = water(light());
    for (sea, seconds) in [
        (SeaState { partitions: Vec::new(), depth: None }, 5.0),
        (SeaState::wind(f32::NAN, 1e5, 0.0), 5.0),
        (strong(), f32::NAN),
        (strong(), -1.0),
        (strong(), f32::INFINITY),
    ] {
        assert!(matches!(water.change_sea(sea, seconds), Err(OpenWaterError::Ocean(_))), "{seconds}");
    }
    assert_eq!(water.desc().sea, light());
    let (_, rms) = run(&mut water, 2.0, &points(Vec2::splat(-90.0), Vec2::splat(90.0)));
    assert!(rms < 0.2, "{rms}");
}

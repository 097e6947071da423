//! A change of the sea through the façade: no pops on the open sea, near land and in fed grids.

use glam::{DVec2, Vec2};
use open_water::{
    BodyStates, CascadeDesc, DepthMap, Edges, Follow, GridDesc, GridId, Land, Obstacle, ObstacleKind, OpenWater,
    OpenWaterDesc, OpenWaterError, Scheme, SeaState, WaterSample,
};

/// The longest tick, so that what is amiss in one shows.
const DT: f32 = 0.1;
const DEPTH: Option<f32> = Some(12.0);

fn light() -> SeaState {
    SeaState { depth: DEPTH, ..SeaState::height_period(0.4, 4.5, 0.0) }
}

fn strong() -> SeaState {
    SeaState { depth: DEPTH, ..SeaState::height_period(1.6, 6.5, 0.9) }
}

fn water(sea: SeaState) -> OpenWater {
    let cascades = vec![CascadeDesc::new(128, 400.0), CascadeDesc::new(32, 75.0)];
    OpenWater::headless(OpenWaterDesc { sea, cascades, tick: DT, ..OpenWaterDesc::default() }).unwrap()
}

/// 12 m of water that shoals to a beach beyond x = 250 m.
fn bay() -> Land {
    let elevation = |i: usize| (-12.0 + ((i % 96) as f32 * 4.0 - 250.0).max(0.0) / 8.0).min(4.0);
    let bed = DepthMap::new(DVec2::ZERO, 4.0, [96; 2], (0..96 * 96).map(elevation).collect());
    Land::new(bed.unwrap())
}

/// A bay with a fed grid behind a breakwater, which the two seas come past from different sides.
fn harbour(sea: SeaState) -> (OpenWater, GridId) {
    let mut water = water(sea);
    let mut land = bay();
    let outline = [[10.0, -60.0], [20.0, -60.0], [20.0, 170.0], [10.0, 170.0]].map(DVec2::from_array).to_vec();
    land.obstacles.push(Obstacle { outline, kind: ObstacleKind::Reflecting });
    water.set_land(Some(land)).unwrap();
    let desc = GridDesc {
        follow: Follow::Fixed(DVec2::new(150.0, 190.0)),
        cells: [120, 120],
        cell_size: [2.0; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 9.4,
        feed: Edges { low_x: true, ..Edges::default() },
        ..GridDesc::default()
    };
    let grid = water.add_grid(desc).unwrap();
    (water, grid)
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
    // Along the beach, and within the grid.
    let shore = points(Vec2::new(290.0, 60.0), Vec2::new(335.0, 320.0));
    let basin = points(Vec2::splat(100.0), Vec2::splat(230.0));
    let (mut changing, mut after) = (harbour(strong()).0, harbour(light()).0);
    let (usual, _) = run(&mut changing, 5.0, &shore);
    changing.change_sea(light(), 6.0).unwrap();
    let (step, _) = run(&mut changing, 6.0, &shore);
    assert!(step < 1.3 * usual, "{step} against {usual}");
    run(&mut changing, 60.0, &[]);
    run(&mut after, 71.0, &[]);
    let maps = [&changing, &after].map(|water| water.ocean().unwrap().amplitudes().unwrap().factors().to_vec());
    let off = maps[0].iter().flatten().zip(maps[1].iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(off < 1e-6, "{off}");
    // The grid has forgotten the sea before.
    let (a, b) = (heights(&changing, &basin), heights(&after, &basin));
    let rms = |values: &mut dyn Iterator<Item = f32>| (values.map(|v| v * v).sum::<f32>() / basin.len() as f32).sqrt();
    let (off, all) = (rms(&mut a.iter().zip(&b).map(|(a, b)| a - b)), rms(&mut b.iter().copied()));
    assert!(off < 0.1 * all, "{off} of {all}");
}

#[test]
fn nothing_jolts_fed_grids() {
    let (mut water, grid) = harbour(strong());
    // Just within the contour through which the waves come in and the strip where they fade in.
    let edge: Vec<Vec2> = (0..60).map(|i| Vec2::new(68.0, 110.0 + 2.0 * i as f32)).collect();
    let steps = |water: &mut OpenWater, seconds: f32| {
        let mut store = BodyStates::default();
        let mut heights = [vec![wave_grid::GridSample::default(); edge.len()], Vec::new(), Vec::new()];
        let mut most = 0.0f32;
        for count in 0..(seconds / DT) as usize {
            for tick in water.advance(DT) {
                water.tick(tick, &mut store).unwrap();
            }
            heights.rotate_right(1);
            heights[0].resize(edge.len(), Default::default());
            water.grid(grid).unwrap().unwrap().sample(&edge, &mut heights[0]);
            if count >= 2 {
                let [a, b, c] = &heights;
                let bend = a.iter().zip(b).zip(c).map(|((a, b), c)| (a.height - 2.0 * b.height + c.height).abs());
                most = bend.fold(most, f32::max);
            }
        }
        most
    };
    steps(&mut water, 12.0);
    let usual = steps(&mut water, 6.0);
    let mut now = 0.0f32;
    // To the end, and with a second thought on the way.
    for (sea, seconds) in [(light(), 12.0), (strong(), 14.0), (light(), 3.0), (strong(), 6.0)] {
        water.change_sea(sea, 10.0).unwrap();
        now = now.max(steps(&mut water, seconds));
    }
    assert!(now < 1.5 * usual, "{now} against {usual}");
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

#[test]
fn a_fed_grid_that_can_carry_nothing_of_the_sea_leaves_all_of_it_ambient() {
    let (mut water, grid) = harbour(strong());
    // In front of the breakwater, within the grid.
    let at = points(Vec2::new(60.0, 230.0), Vec2::new(120.0, 280.0));
    let highest = |water: &OpenWater| {
        water.grid(grid).unwrap().unwrap().heights().iter().fold(0.0f32, |most, height| height.abs().max(most))
    };
    let (_, before) = run(&mut water, 40.0, &at);
    assert!(highest(&water) > 0.3);
    let tiles = |others: f32| vec![CascadeDesc::new(128, 400.0), CascadeDesc::new(32, others)];
    water.set_cascades(tiles(20.0), 1.0).unwrap();
    run(&mut water, 80.0, &at);
    let (_, after) = run(&mut water, 20.0, &at);
    assert!(highest(&water) < 0.05, "{} m", highest(&water));
    assert!(after > 0.5 * before, "{after} m, {before} m");
    water.set_cascades(tiles(75.0), 1.0).unwrap();
    run(&mut water, 40.0, &at);
    assert!(highest(&water) > 0.3);
}

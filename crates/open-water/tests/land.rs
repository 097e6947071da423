//! Land through the façade: walls, shelter, depth, water level, fed grids.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, CascadeDesc, Damping, DepthMap, Edges, Follow, GridDesc, GridHome, GridId, Hull,
    Land, Obstacle, ObstacleKind, OpenWater, OpenWaterDesc, OpenWaterError, Scheme, SeaState, Shelter, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
/// Pixels of the map along each side, and their distance in metres.
const SIDE: usize = 96;
const TEXEL: f32 = 4.0;

/// Swell of 1.2 m, 6 s, towards +x over 10 m of water, in one cascade.
fn swell() -> OpenWaterDesc {
    OpenWaterDesc {
        sea: SeaState { depth: Some(10.0), ..SeaState::height_period(1.2, 6.0, 0.0) },
        cascades: vec![CascadeDesc::new(128, 400.0), CascadeDesc::new(32, 75.0)],
        ..OpenWaterDesc::default()
    }
}

fn calm() -> OpenWaterDesc {
    let mut desc = swell();
    desc.sea.partitions.clear();
    desc
}

/// 10 m of water, and from x = 300 m on a beach that rises by 1 in 5 to 6 m above the sea.
fn bay() -> DepthMap {
    let elevation = |i: usize| {
        let x = (i % SIDE) as f32 * TEXEL;
        (-10.0 + (x - 300.0).max(0.0) / 5.0).min(6.0)
    };
    DepthMap::new(DVec2::ZERO, TEXEL, [SIDE as u32; 2], (0..SIDE * SIDE).map(elevation).collect()).unwrap()
}

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<DVec2> {
    [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]].map(DVec2::from_array).to_vec()
}

fn wall(low: [f64; 2], high: [f64; 2]) -> Obstacle {
    Obstacle { outline: rectangle(low, high), kind: ObstacleKind::Reflecting }
}

/// The bay behind a breakwater at x = 180 m with a gap of 40 m in the middle.
fn harbour() -> Land {
    let mut land = Land::new(bay());
    land.obstacles = vec![wall([180.0, -50.0], [190.0, 172.0]), wall([180.0, 212.0], [190.0, 450.0])];
    land
}

fn basin() -> GridDesc {
    GridDesc {
        follow: Follow::Fixed(DVec2::new(192.0, 192.0)),
        cells: [176, 176],
        cell_size: [2.0; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 9.37,
        feed: Edges { low_x: true, ..Edges::default() },
        ..GridDesc::default()
    }
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|s| s.height).collect()
}

fn run(water: &mut OpenWater, store: &mut BodyStates, seconds: f32, mut each: impl FnMut(&OpenWater)) {
    for _ in 0..(seconds / DT) as usize {
        for tick in water.advance(DT) {
            water.tick(tick, store).unwrap();
            each(water);
        }
    }
}

/// Four times the rms height of all points over a time: their significant height, each group by itself.
fn significant<const N: usize>(water: &mut OpenWater, seconds: f32, groups: [&[Vec2]; N]) -> [f32; N] {
    let mut sums = [0.0f64; N];
    let mut count = 0;
    run(water, &mut BodyStates::default(), seconds, |water| {
        count += 1;
        if count % 10 == 0 {
            for (sum, group) in sums.iter_mut().zip(groups) {
                let squares: f64 = heights(water, group).iter().map(|h| f64::from(h * h)).sum();
                *sum += squares / group.len() as f64;
            }
        }
    });
    sums.map(|sum| 4.0 * (sum / f64::from(count / 10)).sqrt() as f32)
}

fn line(from: [f32; 2], to: [f32; 2]) -> Vec<Vec2> {
    (0..40).map(|i| Vec2::from(from).lerp(Vec2::from(to), i as f32 / 39.0)).collect()
}

#[test]
fn without_a_grid_land_calms_the_sea_by_shelter_and_depth() {
    let mut water = OpenWater::headless(swell()).unwrap();
    water.set_land(Some(harbour())).unwrap();
    let (out, gap, lee) =
        (line([60.0, 20.0], [60.0, 360.0]), line([230.0, 188.0], [230.0, 196.0]), line([200.0, 40.0], [220.0, 60.0]));
    let surf = line([348.5, 20.0], [348.5, 360.0]);
    let [out, gap, lee, surf] = significant(&mut water, 60.0, [&out, &gap, &lee, &surf]);
    assert!((out / 1.2 - 1.0).abs() < 0.15, "{out}");
    assert!(gap > 0.4 * out && lee < 0.2 * out, "{out} {gap} {lee}");
    // .3 m of water: waves below .78 of that.
    assert!(surf < 0.25, "{surf}");
    water.set_land(None).unwrap();
    let behind = significant(&mut water, 20.0, [&line([200.0, 20.0], [220.0, 360.0])]);
    assert!(behind[0] > 0.8, "{behind:?}");
}

#[test]
fn shelter_may_be_given_or_left_out() {
    let mut land = Land::new(bay());
    land.shelter = Shelter::Given((0..SIDE * SIDE).map(|i| if i / SIDE < 48 { 1.0 } else { 0.0 }).collect());
    land.obstacles = harbour().obstacles;
    let mut water = OpenWater::headless(swell()).unwrap();
    water.set_land(Some(land.clone())).unwrap();
    let (low, high) = (line([100.0, 20.0], [100.0, 160.0]), line([100.0, 220.0], [100.0, 360.0]));
    let [low, high] = significant(&mut water, 10.0, [&low, &high]);
    assert!(low > 0.8 && high < 1e-6, "{low} {high}");
    land.shelter = Shelter::None;
    water.set_land(Some(land)).unwrap();
    let [lee] = significant(&mut water, 10.0, [&line([210.0, 20.0], [210.0, 120.0])]);
    assert!(lee > 0.8, "{lee}");
}

#[test]
fn waves_enter_a_fed_basin_by_the_gap_and_die_on_the_beach() {
    let mut water = OpenWater::headless(swell()).unwrap();
    water.set_land(Some(harbour())).unwrap();
    let id = water.add_grid(basin()).unwrap();
    run(&mut water, &mut BodyStates::default(), 60.0, |_| {});
    let (out, gap) = (line([60.0, 60.0], [60.0, 320.0]), line([200.0, 185.0], [200.0, 199.0]));
    let (bent, lee) = (line([230.0, 120.0], [260.0, 120.0]), line([200.0, 40.0], [230.0, 40.0]));
    let [out, gap, bent, lee] = significant(&mut water, 60.0, [&out, &gap, &bent, &lee]);
    println!("out {out} gap {gap} bent {bent} lee {lee}");
    // Before the wall waves stand: incoming and reflected.
    assert!(out > 0.9 && out < 2.6, "{out}");
    assert!(gap > 0.4 && gap < 2.0, "{gap}");
    assert!(bent > 0.05 && bent < 0.6 * gap, "round the head: {bent} of {gap}");
    assert!(lee < 0.5 * gap, "{lee} of {gap}");
    let grid = water.grid(id).unwrap().unwrap();
    assert!(grid.is_finite());
}

#[test]
fn a_fed_grid_takes_the_sea_over_without_a_seam() {
    // Open water: what the grid shows in its middle is about what the sea would have shown.
    let mut land = Land::new(bay());
    land.damping = Damping::Beach { surf_depth: 3.0, rate: 3.0 };
    let mut water = OpenWater::headless(swell()).unwrap();
    water.set_land(Some(land)).unwrap();
    let grid = GridDesc { feed: Edges { low_x: true, low_z: true, high_z: true, high_x: false }, ..basin() };
    water.add_grid(grid).unwrap();
    run(&mut water, &mut BodyStates::default(), 60.0, |_| {});
    let (out, within) = (line([4.0, 60.0], [4.0, 320.0]), line([150.0, 100.0], [150.0, 280.0]));
    let [out, within] = significant(&mut water, 60.0, [&out, &within]);
    assert!((within / out - 1.0).abs() < 0.25, "{within} {out}");
}

#[test]
fn a_moving_grid_sees_the_same_walls() {
    let mut water = OpenWater::headless(calm()).unwrap();
    water.set_land(Some(harbour())).unwrap();
    let grid = |x: f64| GridDesc {
        follow: Follow::Fixed(DVec2::new(x, 80.0)),
        cells: [160; 2],
        cell_size: [0.5; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 6.2,
        ..GridDesc::default()
    };
    let id = water.add_grid(grid(180.0)).unwrap();
    // A stone 8 m before the wall.
    let hull = Hull::cuboid(Vec3::new(2.0, 2.0, 2.0)).unwrap();
    let stone = water
        .add_body(BodyDesc { radiation: open_water::Radiation::Grid, ..BodyDesc::from_hull(&hull, 4_000.0) })
        .unwrap();
    let mut store = BodyStates::default();
    store.insert(stone, BodyState::at_rest(Vec3::new(172.0, 1.5, 80.0)));
    run(&mut water, &mut store, 3.0, |_| {});
    let wet = heights(&water, &line([165.0, 80.0], [179.0, 80.0])).iter().map(|h| h.abs()).fold(0.0, f32::max);
    let behind = heights(&water, &line([190.5, 70.0], [196.0, 90.0])).iter().map(|h| h.abs()).fold(0.0, f32::max);
    assert!(wet > 0.01, "{wet}");
    assert_eq!(behind, 0.0, "no wave passes the wall");
    // Without the wall it does: maps may change while running.
    water.set_land(Some(Land::new(bay()))).unwrap();
    run(&mut water, &mut store, 3.0, |_| {});
    let behind = heights(&water, &line([190.5, 70.0], [196.0, 90.0])).iter().map(|h| h.abs()).fold(0.0, f32::max);
    assert!(behind > 1e-3, "{behind}");
    assert!(water.grid(id).unwrap().unwrap().is_finite());
}

#[test]
fn water_level_lifts_everything_and_floods_the_beach() {
    let mut water = OpenWater::headless(calm()).unwrap();
    water.set_land(Some(Land::new(bay()))).unwrap();
    // One that reads a patch of water, one that reads points.
    let mut store = BodyStates::default();
    let bodies = [Vec3::new(2.0, 1.0, 2.0), Vec3::new(9.0, 1.0, 3.0)].map(|size| {
        let desc = BodyDesc::from_hull(&Hull::cuboid(size).unwrap(), 500.0 * size.element_product());
        let id = water.add_body(desc).unwrap();
        store.insert(id, BodyState::at_rest(Vec3::new(60.0 + 10.0 * size.x, 0.1, 100.0)));
        id
    });
    run(&mut water, &mut store, 10.0, |_| {});
    let low = bodies.map(|id| store.get(id).unwrap().position.y);
    let (beach, deep) = (Vec3::new(354.0, 0.9, 50.0), Vec3::new(20.0, -3.0, 20.0));
    assert!(!water.is_underwater(beach) && water.is_underwater(deep));
    assert!(!water.is_underwater(deep.with_y(-10.5)), "in the ground");
    assert!(!water.is_underwater(Vec3::NAN));
    for step in 0..200 {
        water.set_level(step as f32 * 0.01).unwrap();
        run(&mut water, &mut store, 0.1, |_| {});
    }
    run(&mut water, &mut store, 10.0, |_| {});
    assert_eq!(water.level(), 1.99);
    for (id, low) in bodies.into_iter().zip(low) {
        let high = store.get(id).unwrap().position.y;
        assert!((high - low - 1.99).abs() < 0.01, "{low} {high}");
    }
    assert_eq!(heights(&water, &[Vec2::new(20.0, 20.0)]), [1.99]);
    assert!(water.is_underwater(beach));
    let error = water.set_level(f32::NAN).unwrap_err().to_string();
    assert!(error.contains("level") && water.level() == 1.99, "{error}");
}

#[test]
fn no_water_in_a_dry_dock() {
    let mut land = Land::new(bay());
    land.no_water.push(rectangle([80.0, 80.0], [120.0, 120.0]));
    let mut water = OpenWater::headless(swell()).unwrap();
    water.set_land(Some(land)).unwrap();
    let mut samples = [WaterSample::default(); 2];
    water.sample(&[Vec2::new(100.0, 100.0), Vec2::new(60.0, 100.0)], &mut samples);
    assert_eq!(samples.map(|s| s.wet), [false, true]);
    assert!(!water.is_underwater(Vec3::new(100.0, -5.0, 100.0)) && water.is_underwater(Vec3::new(60.0, -5.0, 100.0)));
    // A crate in it falls freely.
    let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
    let id = water.add_body(BodyDesc::from_hull(&hull, 400.0)).unwrap();
    let mut store = BodyStates::default();
    store.insert(id, BodyState::at_rest(Vec3::new(100.0, -2.0, 100.0)));
    run(&mut water, &mut store, 1.0, |_| {});
    assert!(store.get(id).unwrap().velocity.y < -9.0);
}

#[test]
fn what_cannot_be_fed_is_refused_and_nothing_is_lost() {
    let mut water = OpenWater::headless(swell()).unwrap();
    let refused = |water: &mut OpenWater, desc: GridDesc| -> OpenWaterError {
        let before = water.grid_count();
        let error = water.add_grid(desc).unwrap_err();
        assert_eq!(water.grid_count(), before);
        error
    };
    assert!(refused(&mut water, basin()).to_string().contains("set_land"));
    water.set_land(Some(harbour())).unwrap();
    assert!(refused(&mut water, GridDesc { home: GridHome::Gpu, ..basin() }).to_string().contains("CPU"));
    let away = GridDesc { follow: Follow::Fixed(DVec2::new(100.0, 192.0)), ..basin() };
    assert!(refused(&mut water, away).to_string().contains("must lie on the depth map"));
    let coarse = GridDesc { cell_size: [7.0; 2], cells: [50; 2], ..basin() };
    assert!(refused(&mut water, coarse).to_string().contains("cell_size"));
    let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
    let body = water.add_body(BodyDesc::from_hull(&hull, 400.0)).unwrap();
    assert!(refused(&mut water, GridDesc { follow: Follow::Body(body), ..basin() }).to_string().contains("Fixed"));
    let id: GridId = water.add_grid(basin()).unwrap();
    assert!(water.set_land(None).is_err() && water.land().is_some());
    let mut short = harbour();
    short.obstacles[0].outline.truncate(2);
    assert!(water.set_land(Some(short)).unwrap_err().to_string().contains("outline"));
    assert_eq!(water.land(), Some(&harbour()));
    let mut bad = harbour();
    bad.damping = Damping::Given(vec![0.5; 7]);
    assert!(water.set_land(Some(bad)).unwrap_err().to_string().contains("damping map"));
    let mut bad = harbour();
    bad.shelter = Shelter::Given((0..SIDE * SIDE).map(|i| if i == 100 { 1.5 } else { 1.0 }).collect());
    assert!(water.set_land(Some(bad)).unwrap_err().to_string().contains("pixel (4, 1)"));
    water.remove_grid(id).unwrap();
    water.set_land(None).unwrap();
}

#[test]
fn bodies_touch_the_bed_and_walls() {
    let mut water = OpenWater::headless(calm()).unwrap();
    water.set_land(Some(harbour())).unwrap();
    let cube = Hull::cuboid(Vec3::ONE).unwrap();
    let mut store = BodyStates::default();
    // Too heavy to float, over 10 m of water; and one that is pushed towards the breakwater.
    let sunk = water.add_body(BodyDesc::from_hull(&cube, 2000.0)).unwrap();
    store.insert(sunk, BodyState::at_rest(Vec3::new(60.0, -8.0, 100.0)));
    let pushed = water.add_body(BodyDesc::from_hull(&cube, 500.0)).unwrap();
    store.insert(pushed, BodyState::at_rest(Vec3::new(178.0, 0.0, 60.0)));
    let force = Vec3::X * 400.0;
    water.set_controls(pushed, open_water::Controls { force, ..Default::default() }).unwrap();
    run(&mut water, &mut store, 10.0, |_| {});
    let [sunk, pushed] = [sunk, pushed].map(|id| store.get(id).unwrap().position);
    assert!((sunk.y + 9.5).abs() < 0.05, "{sunk}");
    assert!((pushed.x - 179.5).abs() < 0.05 && pushed.y.abs() < 0.2, "{pushed}");
}

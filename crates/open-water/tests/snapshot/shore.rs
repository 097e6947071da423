//! Snapshots of a water with land: a fed basin, maps that turn with the sea, a moving level.

use glam::{DVec2, Vec2};
use open_water::{
    BodyStates, CascadeDesc, DepthMap, Edges, Follow, GridDesc, Land, OpenWater, OpenWaterDesc, OpenWaterError, Scheme,
    SeaState, WaterSample, WaterSnapshot,
};

const SIDE: usize = 48;

pub(crate) fn land() -> Land {
    let elevation = |i: usize| (-10.0 + ((i % SIDE) as f32 * 8.0 - 300.0).max(0.0) / 5.0).min(6.0);
    let elevations = (0..SIDE * SIDE).map(elevation).collect();
    Land::new(DepthMap::new(DVec2::ZERO, 8.0, [SIDE as u32; 2], elevations).unwrap())
}

pub(crate) fn bay(land: Option<Land>) -> OpenWater {
    let desc = OpenWaterDesc {
        sea: SeaState { depth: Some(10.0), ..SeaState::height_period(1.2, 6.0, 0.0) },
        cascades: vec![CascadeDesc::new(64, 400.0), CascadeDesc::new(32, 75.0)],
        ..OpenWaterDesc::default()
    };
    let mut water = OpenWater::headless(desc).unwrap();
    water.set_land(land).unwrap();
    water
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

/// Runs on with the same inputs; hashes, and the height at a place in the basin.
fn run(water: &mut OpenWater, ticks: u64) -> Vec<(u64, f32)> {
    let mut results = Vec::new();
    for _ in 0..ticks {
        let next = water.last_tick() + 1;
        match next {
            10 | 70 => water.change_sea(SeaState::wind(6.0 + next as f32 * 0.1, 40e3, 0.2), 0.7).unwrap(),
            // Then the maps have time to turn.
            n if n % 9 == 0 && !(37..110).contains(&n) => water.set_level(0.01 * n as f32).unwrap(),
            33 => water.rebase(DVec2::new(12.0, -7.0)).unwrap(),
            40 => water.set_cascades(vec![CascadeDesc::new(64, 400.0), CascadeDesc::new(64, 75.0)], 0.5).unwrap(),
            _ => {}
        }
        for tick in water.ticks_until(next) {
            water.tick(tick, &mut BodyStates::default()).unwrap();
        }
        let mut sample = [WaterSample::default()];
        water.sample(&[Vec2::new(150.0, 190.0)], &mut sample);
        results.push((water.hash(), sample[0].height));
    }
    results
}

#[test]
fn a_shore_goes_back_and_on_elsewhere() {
    let mut water = bay(Some(land()));
    water.add_grid(basin()).unwrap();
    for _ in 0..6 {
        run(&mut water, 13);
        // Not yet found by a tick.
        water.set_level(water.level() + 0.03).unwrap();
        let hash = water.hash();
        let (snapshot, bytes) = (water.snapshot(), water.snapshot().to_bytes());
        let first = run(&mut water, 20);
        water.restore(&snapshot).unwrap();
        assert_eq!(water.hash(), hash);
        assert_eq!(run(&mut water, 20), first, "rollback to {}", snapshot.tick());
        let mut joiner = bay(Some(land()));
        joiner.restore(&WaterSnapshot::from_bytes(&bytes).unwrap()).unwrap();
        assert_eq!(joiner.snapshot().to_bytes(), bytes);
        assert_eq!(run(&mut joiner, 20), first, "joined at {}", snapshot.tick());
    }
}

#[test]
fn other_land_is_refused() {
    let water = bay(Some(land()));
    let snapshot = water.snapshot();
    let bytes = WaterSnapshot::from_bytes(&snapshot.to_bytes()).unwrap();
    let mut other = land();
    other.obstacles = vec![open_water::Obstacle {
        outline: [[50.0, 50.0], [60.0, 50.0], [60.0, 60.0]].map(DVec2::from_array).to_vec(),
        kind: open_water::ObstacleKind::Reflecting,
    }];
    for land in [None, Some(other)] {
        let mut water = bay(land);
        let hash = water.hash();
        for snapshot in [&snapshot, &bytes] {
            assert!(matches!(water.restore(snapshot), Err(OpenWaterError::OtherLand)));
        }
        assert_eq!(water.hash(), hash);
    }
}

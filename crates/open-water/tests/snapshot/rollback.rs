//! Back to a moment and on again.

use crate::scene::{Game, boat, small, water};
use glam::Vec3;
use open_water::{BodyState, BodyStates, Controls, Follow, GridDesc, Hull, OpenWater, Preset, Scheme, WaterSnapshot};

/// Hashes of the next `ticks`.
pub(crate) fn hashes(water: &mut OpenWater, game: &mut Game, ticks: usize) -> Vec<u64> {
    let tick = |_| {
        game.tick(water);
        water.hash()
    };
    (0..ticks).map(tick).collect()
}

#[test]
fn two_runs_have_the_same_hashes() {
    let run = || {
        let (mut water, mut game) = water();
        hashes(&mut water, &mut game, 150)
    };
    let first = run();
    assert_eq!(first, run());
    assert!(first.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn rollback_gives_the_same_ticks() {
    let (mut water, mut game) = water();
    for _ in 0..7 {
        let (snapshot, saved) = (water.snapshot(), game.clone());
        let hash = water.hash();
        let first = hashes(&mut water, &mut game, 25);
        water.restore(&snapshot).unwrap();
        game = saved;
        assert_eq!((water.hash(), water.last_tick()), (hash, snapshot.tick()));
        assert_eq!(hashes(&mut water, &mut game, 25), first);
    }
}

#[test]
fn one_bit_of_a_body_is_another_hash() {
    let (mut water, mut game) = water();
    hashes(&mut water, &mut game, 10);
    let (snapshot, saved) = (water.snapshot(), game.clone());
    game.tick(&mut water);
    let plain = water.hash();
    water.restore(&snapshot).unwrap();
    game = saved;
    let state = game.bodies.get_mut(game.ids[3]).unwrap();
    state.angular_velocity.y = f32::from_bits(state.angular_velocity.y.to_bits() ^ 1);
    game.tick(&mut water);
    assert_ne!(water.hash(), plain);
}

#[test]
fn ticks_that_were_handed_out_are_void_after_a_restore() {
    let (mut water, mut game) = water();
    let snapshot = water.snapshot();
    let late: Vec<_> = water.advance(3.0 / 60.0).collect();
    water.restore(&snapshot).unwrap();
    assert_eq!(late.len(), 3);
    let ticks: Vec<_> = water.ticks_until(2).collect();
    for tick in ticks {
        water.tick(tick, &mut game.bodies).unwrap();
    }
    assert_eq!(water.advance(1.0 / 60.0).map(|tick| tick.index).collect::<Vec<_>>(), [3]);
    water.restore(&snapshot).unwrap();
    assert_eq!(water.advance(1.0 / 60.0).map(|tick| tick.index).collect::<Vec<_>>(), [1]);
}

#[test]
fn grids_that_take_over_from_others_come_back() {
    // Of the wave equation, a boat outruns its waves, and the window trails behind.
    for (scheme, wave_speed) in [(Scheme::Dispersive, 6.0), (Scheme::NinePoint, 3.0)] {
        takes_over(GridDesc { cells: [96; 2], scheme, wave_speed, ..Preset::Low.grid() });
    }
}

fn takes_over(grid: GridDesc) {
    let mut desc = small(Preset::Low.water());
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc).unwrap();
    let id = water.add_body(boat()).unwrap();
    water.set_controls(id, Controls { throttle: 1.0, ..Controls::default() }).unwrap();
    let grid = water.add_grid(GridDesc { follow: Follow::Body(id), ..grid }).unwrap();
    let mut store = BodyStates::default();
    store.insert(id, BodyState { velocity: Vec3::X * 6.0, ..water.body(id).unwrap().state() });
    let run = |water: &mut OpenWater, store: &mut BodyStates, ticks: u64| {
        let until = water.last_tick() + ticks;
        let ticks = water.ticks_until(until);
        let tick = |tick| {
            water.tick(tick, store).unwrap();
            water.hash()
        };
        ticks.map(tick).collect::<Vec<_>>()
    };
    run(&mut water, &mut store, 60);
    water.set_grid_cells(grid, [64; 2], [0.75; 2]).unwrap();
    run(&mut water, &mut store, 20);
    let (snapshot, saved) = (water.snapshot(), store.clone());
    let first = run(&mut water, &mut store, 60);
    for from in [WaterSnapshot::from_bytes(&snapshot.to_bytes()).unwrap(), snapshot] {
        water.restore(&from).unwrap();
        store = saved.clone();
        assert_eq!(run(&mut water, &mut store, 60), first);
    }
}

#[test]
fn dry_hulls_come_back_and_those_from_bytes_stay() {
    let (mut water, mut game) = water();
    let (dry, body) = (Hull::sphere(0.6).unwrap().dry(0.0, 0.0).unwrap(), game.ids[2]);
    game.tick(&mut water);
    water.set_dry(body, Some(dry.clone())).unwrap();
    let snapshot = water.snapshot();
    let inside = |water: &OpenWater| water.is_dry(water.body(body).unwrap().state().position);
    water.set_dry(body, None).unwrap();
    assert!(!inside(&water));
    let bytes = WaterSnapshot::from_bytes(&snapshot.to_bytes()).unwrap();
    water.restore(&bytes).unwrap();
    assert!(!inside(&water));
    water.restore(&snapshot).unwrap();
    assert!(inside(&water));
    water.restore(&bytes).unwrap();
    assert!(inside(&water));
}

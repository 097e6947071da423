//! Back to a moment and on again.

use crate::scene::{Game, water};
use open_water::OpenWater;

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
}

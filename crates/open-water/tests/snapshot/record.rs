//! Recordings run again.

use crate::scene::water;
use crate::shore::{bay, land};
use open_water::{BodyStates, OpenWater, OpenWaterDesc, Replay, ReplayError};

/// A recording of so many ticks of the random game, and the hash at its end.
fn recorded(ticks: usize) -> (Vec<u8>, u64) {
    let (mut water, mut game) = water();
    (0..30).for_each(|_| game.tick(&mut water));
    water.start_recording();
    let mut file = Vec::new();
    let mut early = None;
    for tick in 0..ticks {
        game.tick(&mut water);
        match tick {
            20 => early = Some((water.snapshot(), game.clone())),
            28 => {
                let (snapshot, saved) = early.clone().unwrap();
                water.restore(&snapshot).unwrap();
                game = saved;
            }
            _ if tick % 13 == 0 => water.write_recording(&mut file).unwrap(),
            _ => {}
        }
    }
    let hash = water.hash();
    water.stop_recording(&mut file).unwrap();
    assert!(!water.is_recording());
    (file, hash)
}

#[test]
fn a_recording_replays_to_the_same_hash() {
    let (file, hash) = recorded(200);
    let mut replay = Replay::new(&file[..]).unwrap();
    let mut ticks = 0;
    while replay.tick().unwrap() {
        ticks += 1;
    }
    assert_eq!((ticks, replay.water().hash()), (200, hash));
    assert_eq!(replay.into_water().last_tick(), 30 + 200 - 8);
}

#[test]
fn land_that_comes_and_goes_is_replayed() {
    let mut water = bay(None);
    water.start_recording();
    let mut file = Vec::new();
    for (until, land) in [(3, Some(land())), (6, None), (9, Some(land())), (12, None)] {
        for tick in water.ticks_until(until) {
            water.tick(tick, &mut BodyStates::default()).unwrap();
        }
        water.write_recording(&mut file).unwrap();
        water.set_land(land).unwrap();
    }
    water.stop_recording(&mut file).unwrap();
    let mut replay = Replay::new(&file[..]).unwrap();
    while replay.tick().unwrap() {}
    assert_eq!(replay.water().hash(), water.hash());
}

#[test]
fn a_damaged_recording_is_an_error_and_no_more() {
    let (file, _) = recorded(30);
    let run = |bytes: &[u8]| -> Result<(), ReplayError> {
        let mut replay = Replay::new(bytes)?;
        while replay.tick()? {}
        Ok(())
    };
    assert!(matches!(run(b"nothing like one"), Err(ReplayError::NoRecording)));
    assert!(matches!(run(&[b"owrc".as_ref(), &[9; 4]].concat()), Err(ReplayError::Version { .. })));
    assert!(matches!(run(&file[..file.len() - 3]), Err(ReplayError::Damaged { .. })));
    // Lengths that are lies ask for no more than there is.
    let mut lie = file.clone();
    lie[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(run(&lie), Err(ReplayError::Damaged { tick: 0 })));
    for at in (0..file.len()).step_by(file.len() / 40) {
        let mut bad = file.clone();
        bad[at] ^= 0x55;
        let _ = run(&bad);
    }
}

#[test]
fn what_is_not_what_it_was_is_told() {
    let mut water = OpenWater::headless(OpenWaterDesc::default()).unwrap();
    water.start_recording();
    let mut file = Vec::new();
    for tick in water.ticks_until(3) {
        water.tick(tick, &mut BodyStates::default()).unwrap();
    }
    water.stop_recording(&mut file).unwrap();
    // The last byte is of the hash.
    *file.last_mut().unwrap() ^= 1;
    let mut replay = Replay::new(&file[..]).unwrap();
    while replay.water().last_tick() < 3 {
        replay.tick().unwrap();
    }
    assert!(matches!(replay.tick(), Err(ReplayError::Differs { tick: 3 })));
}

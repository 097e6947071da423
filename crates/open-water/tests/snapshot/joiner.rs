//! A water made from bytes alone.

use crate::rollback::hashes;
use crate::scene::{small, water};
use open_water::{OpenWater, OpenWaterDesc, SnapshotError, WaterSnapshot};

fn joined(bytes: &[u8]) -> OpenWater {
    // Whatever it was before.
    let mut water = OpenWater::headless(small(OpenWaterDesc::default())).unwrap();
    water.restore(&WaterSnapshot::from_bytes(bytes).unwrap()).unwrap();
    water
}

#[test]
fn a_late_joiner_goes_on_with_equal_hashes() {
    let (mut server, mut game) = water();
    for _ in 0..5 {
        hashes(&mut server, &mut game, 20);
        let bytes = server.snapshot().to_bytes();
        let (mut client, mut own) = (joined(&bytes), game.clone());
        assert_eq!(client.hash(), server.hash());
        assert_eq!(client.snapshot().to_bytes(), bytes);
        assert_eq!(hashes(&mut client, &mut own, 25), hashes(&mut server, &mut game, 25));
    }
}

#[test]
fn bytes_that_are_cut_off_or_damaged_are_refused() {
    let (mut water, mut game) = water();
    hashes(&mut water, &mut game, 5);
    let bytes = water.snapshot().to_bytes();
    for len in (0..bytes.len()).step_by(bytes.len() / 50).chain(0..40) {
        assert!(WaterSnapshot::from_bytes(&bytes[..len]).is_err());
    }
    for at in (0..bytes.len()).step_by(bytes.len() / 50).chain(0..40) {
        let mut bad = bytes.clone();
        bad[at] ^= 1 << (at % 8);
        assert!(WaterSnapshot::from_bytes(&bad).is_err(), "byte {at}");
    }
    assert!(matches!(WaterSnapshot::from_bytes(b"garbage"), Err(SnapshotError::NoSnapshot)));
    let mut other = bytes;
    other[4] += 1;
    assert!(matches!(WaterSnapshot::from_bytes(&other), Err(SnapshotError::Version { expected: 1, found: 2 })));
}

//! Tiles chosen for a sea.

use ocean_spectrum::{Notice, Ocean, OceanDesc, Partition, SeaState};
use proptest::prelude::*;

/// What the tiles hold of the variance.
fn held(desc: OceanDesc) -> f64 {
    let ocean = Ocean::new(desc).unwrap();
    ocean.modes().iter().map(|modes| modes.variance()).sum::<f64>() / ocean.spectrum().variance()
}

#[test]
fn seas_of_every_length_are_held() {
    let seas = [
        SeaState::wind(4.0, 2e3, 0.0),
        SeaState::default(),
        SeaState::wind(25.0, 500e3, 1.0),
        SeaState::phillips(12.0, 0.0),
        SeaState::tma(15.0, 200e3, 0.0, 6.0),
        SeaState { partitions: vec![Partition::swell(2.0, 18.0, 1.0)], depth: None },
        SeaState::wind(5.0, 20e3, 0.0).with_swell(0.4, 16.0, 2.0),
    ];
    for sea in seas {
        for size in [64, 128, 256] {
            let desc = OceanDesc::for_sea(sea.clone(), size);
            println!("{size} {:?}", desc.cascades.iter().map(|c| c.tile).collect::<Vec<_>>());
            let share = held(desc.clone());
            assert!((0.99..1.005).contains(&share), "{size} {share} {desc:?}");
            let shortest = 2.0 * desc.cascades.last().unwrap().tile / size as f32;
            assert!(shortest <= 0.13 || size == 64, "{size}: {shortest}");
        }
    }
}

#[test]
fn shares_and_ratios_keep_repetition_down() {
    for (sea, size) in
        [(SeaState::default(), 256), (SeaState::height_period(6.0, 12.0, 0.0), 256), (SeaState::default(), 512)]
    {
        let ocean = Ocean::new(OceanDesc::for_sea(sea, size)).unwrap();
        let whole: f64 = ocean.modes().iter().map(|modes| modes.variance()).sum();
        let share = ocean.modes()[0].variance() / whole;
        assert!((0.62..0.70).contains(&share), "{share}");
        let tiles: Vec<f32> = ocean.modes().iter().map(|modes| modes.tile).collect();
        assert!(tiles[0] > 2000.0, "{tiles:?}");
        let part = (tiles[0] / tiles[1]).fract();
        assert!((0.3..0.7).contains(&part), "{tiles:?}");
    }
}

#[test]
fn what_cannot_be_used_is_refused_later() {
    let sea = SeaState { partitions: vec![], depth: None };
    assert!(Ocean::new(OceanDesc::for_sea(sea, 256)).is_err());
    for size in [0, 100, 2048, u32::MAX] {
        assert!(Ocean::new(OceanDesc::for_sea(SeaState::default(), size)).is_err());
    }
}

proptest! {
    #[test]
    fn any_sea_has_tiles(
        wind in 0.5f32..80.0, fetch in 100f32..1e7, tp in 0.5f32..40.0, depth in prop::option::of(0.5f32..2e4), power in 5u32..11,
    ) {
        for sea in [SeaState::wind(wind, fetch, 0.0), SeaState::height_period(1.0, tp, 0.0)] {
            let desc = OceanDesc::for_sea(SeaState { depth, ..sea }, 1 << power);
            prop_assert!(desc.validate().is_ok(), "{desc:?}");
            prop_assert!(desc.cascades.len() >= 2 || desc.cascades[0].tile < 4.0, "{desc:?}");
        }
    }
}

#[test]
fn only_a_very_long_sea_is_lost() {
    let ocean = Ocean::new(OceanDesc::for_sea(SeaState::height_period(3.0, 40.0, 0.0), 64)).unwrap();
    assert!(!ocean.notices().iter().any(|notice| matches!(notice, Notice::VarianceLost { share } if *share > 0.03)));
}

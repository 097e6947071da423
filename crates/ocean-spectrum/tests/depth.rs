//! What depth leaves of the sea, and where its energy goes.

use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, SeaState, depth_share};

/// A wind sea in bands of an octave or less, so that factors per band are nearly factors per wave.
fn fine_bands(wind: f32, fetch: f32) -> Ocean {
    let tiles = [1600.0, 900.0, 480.0, 250.0, 130.0, 70.0, 30.0, 9.0];
    let cascades = tiles.map(|tile| CascadeDesc::new(64, tile)).to_vec();
    Ocean::new(OceanDesc { sea: SeaState::wind(wind, fetch, 0.3), cascades, ..Default::default() }).unwrap()
}

fn height_left(ocean: &Ocean, depth: f32) -> f64 {
    let left: f64 =
        ocean.modes().iter().zip(ocean.depth_factors(depth)).map(|(m, f)| m.variance() * f64::from(f * f)).sum();
    4.0 * left.sqrt()
}

#[test]
fn depth_leaves_the_heights_of_tma() {
    // Wind, fetch, Hs over deep water and over 20, 10 and 5 m: JONSWAP times the share, integrated over frequency by a
    // program of its own. With the usual piecewise parabola for the share (Thompson and Vincent 1983) they are up to 1 %
    // more: 2.006, 1.688, 1.294 for the third.
    let rows = [
        (5.0, 10e3, 0.3210, [0.3210, 0.3210, 0.3188]),
        (10.0, 10e3, 0.5935, [0.5935, 0.5923, 0.5687]),
        (10.0, 100e3, 2.1386, [2.0027, 1.6700, 1.2848]),
        (15.0, 100e3, 3.0638, [2.7089, 2.1747, 1.6409]),
        (20.0, 300e3, 7.2884, [4.7334, 3.5250, 2.5584]),
    ];
    for (wind, fetch, deep, heights) in rows {
        let three = Ocean::new(OceanDesc { sea: SeaState::wind(wind, fetch, 0.3), ..Default::default() }).unwrap();
        for ocean in [fine_bands(wind, fetch), three] {
            // What the cascades do not hold they cannot lose.
            let held = f64::from(ocean.significant_height()) / deep;
            assert!((held - 1.0).abs() < 0.005, "{wind} m/s, {fetch} m: {held}");
            for (depth, height) in [20.0, 10.0, 5.0].into_iter().zip(heights) {
                let left = height_left(&ocean, depth) / height;
                assert!((left - 1.0).abs() < 0.005, "{wind} m/s, {fetch} m, depth {depth}: {left}");
            }
        }
    }
}

#[test]
fn a_short_wave_passes_where_a_long_one_breaks() {
    // TMA at 10 m leaves a 3 s wave whole and 14 % of the variance of one of 12 s.
    let omega = |period: f64| std::f64::consts::TAU / period;
    assert!(depth_share(omega(3.0), Some(10.0)) > 0.99);
    assert!((depth_share(omega(12.0), Some(10.0)) - 0.14).abs() < 0.01);
    assert_eq!(depth_share(omega(12.0), None), 1.0);
    // Its limits: omega^2 h/2g in shallow water, 1 in deep.
    let shallow = omega(30.0) * omega(30.0) * 0.2 / (2.0 * 9.81);
    assert!((depth_share(omega(30.0), Some(0.2)) / shallow - 1.0).abs() < 0.01);
    assert!((depth_share(omega(3.0), Some(8000.0)) - 1.0).abs() < 1e-12);
    // Longer waves lose more, cascade by cascade.
    let factors = fine_bands(15.0, 200e3).depth_factors(6.0);
    assert!(factors.windows(2).all(|f| f[0] < f[1] + 1e-3) && factors[0] < 0.5 && factors[7] > 0.9, "{factors:?}");
}

#[test]
fn waves_break_before_they_are_as_high_as_the_water_deep() {
    let ocean = fine_bands(20.0, 300e3);
    let mut last = f64::INFINITY;
    for depth in [50.0f32, 10.0, 3.0, 1.0, 0.5, 0.1, 0.01, 1e-6] {
        let height = height_left(&ocean, depth);
        assert!(height <= 0.7801 * f64::from(depth) && height <= last, "{depth}: {height}");
        last = height;
    }
    // From some depth on it is the cap alone.
    assert!((height_left(&ocean, 0.5) / 0.39 - 1.0).abs() < 1e-3);
    for depth in [0.0, -3.0, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(ocean.depth_factors(depth), [0.0; 8]);
    }
    let three = Ocean::new(OceanDesc::default()).unwrap();
    assert_eq!(three.depth_factors(-1.0), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(three.depth_factors(f32::INFINITY), [1.0; 8]);
    assert!(three.depth_factors(5e3).iter().all(|f| (f - 1.0).abs() < 1e-6));
}

#[test]
fn a_sea_over_its_own_depth_keeps_its_height() {
    let sea = SeaState { depth: Some(12.0), ..SeaState::wind(12.0, 200e3, 0.0) };
    let ocean = Ocean::new(OceanDesc { sea, ..Default::default() }).unwrap();
    assert!(ocean.depth_factors(12.0)[..3].iter().all(|f| (f - 1.0).abs() < 1e-6));
    let (shallow, deep) = (ocean.depth_factors(6.0), ocean.depth_factors(40.0));
    assert!(shallow[0] < 0.9 && deep[0] > 1.05 && deep[0] <= 4.0, "{shallow:?} {deep:?}");
}

#[test]
fn energy_goes_where_the_modes_travel() {
    let sea = SeaState::wind(10.0, 100e3, 2.0);
    let ocean = Ocean::new(OceanDesc { sea, ..Default::default() }).unwrap();
    for (c, modes) in ocean.modes().iter().enumerate() {
        let shares = ocean.directional_energy(c, 8);
        assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-5);
        let (mut counted, variance) = ([0.0; 8], modes.variance());
        for (cell, amp) in modes.amp.iter().enumerate() {
            let signed = |i: usize| f64::from(modes.signed(i as u32));
            let (x, z) = (signed(cell % modes.size as usize), signed(cell / modes.size as usize));
            let sector = (z.atan2(x) / std::f64::consts::TAU * 8.0).round().rem_euclid(8.0) as usize % 8;
            counted[sector] += 2.0 * f64::from(amp[0] * amp[0] + amp[1] * amp[1]) / variance;
        }
        for (share, counted) in shares.iter().zip(counted) {
            assert!((f64::from(*share) - counted).abs() < 0.02, "{c}: {shares:?} {counted:?}");
        }
    }
    assert_eq!(ocean.directional_energy(7, 4), [0.25; 4]);
    assert!(ocean.directional_energy(0, 0).is_empty());
}

//! The made sea against published figures and its own description.

use ocean_spectrum::{CascadeDesc, Notice, Ocean, OceanDesc, SeaState, Spectrum, Spreading, WaveSpectrum, dispersion};

fn spectrum(spectrum: Spectrum) -> WaveSpectrum {
    WaveSpectrum::new(&SeaState::single(spectrum, 0.0, Spreading::Cos2s { s: 6.0 })).unwrap()
}

fn near(a: f64, b: f64, relative: f64) {
    assert!((a / b - 1.0).abs() < relative, "{a} {b}");
}

#[test]
fn pierson_moskowitz_has_its_height_and_period() {
    // Hs = .2092 U^2/g, Tp = 2 pi U/(.877 g).
    for (wind_speed, hs, tp) in
        [(5.0, 0.5332, 3.651), (10.0, 2.133, 7.302), (15.0, 4.7992, 10.953), (20.0, 8.5319, 14.604)]
    {
        let s = spectrum(Spectrum::PiersonMoskowitz { wind_speed });
        near(s.significant_height(), hs, 1e-3);
        near(s.peak_period(), tp, 2e-3);
    }
}

#[test]
fn jonswap_grows_with_wind_and_fetch() {
    let rows = [
        (5.0, 10e3, 2.296, 0.321),
        (10.0, 10e3, 2.893, 0.5935),
        (10.0, 100e3, 6.232, 2.139),
        (15.0, 100e3, 7.134, 3.064),
        (20.0, 300e3, 11.33, 7.288),
    ];
    for (wind_speed, fetch, tp, hs) in rows {
        let s = spectrum(Spectrum::JonswapFetch { wind_speed, fetch });
        near(s.significant_height(), hs, 2e-3);
        near(s.peak_period(), tp, 2e-3);
    }
}

#[test]
fn heights_given_are_heights_made() {
    for (significant_height, peak_period, gamma) in [(0.3, 3.0, 1.0), (2.5, 9.0, 3.3), (6.0, 16.0, 7.0)] {
        let s = spectrum(Spectrum::Jonswap { significant_height, peak_period, gamma });
        near(s.significant_height(), significant_height.into(), 1e-3);
        near(s.peak_period(), peak_period.into(), 2e-3);
    }
    let phillips = WaveSpectrum::new(&SeaState::phillips(12.0, 0.7)).unwrap();
    near(phillips.significant_height(), 0.21 * 144.0 / 9.81, 2e-3);
}

#[test]
fn the_plane_of_wavenumbers_holds_the_same_variance() {
    for depth in [None, Some(8.0)] {
        let sea = SeaState { depth, ..SeaState::wind(10.0, 100e3, 1.0) };
        let s = WaveSpectrum::new(&sea).unwrap();
        // Polar midpoint rule, logarithmic in k.
        let (n, m) = (1500, 128);
        let mut sum = 0.0;
        for i in 0..n {
            let (low, high) = (1e-3f64.ln(), 363.0f64.ln());
            let k = (low + (high - low) * (f64::from(i) + 0.5) / f64::from(n)).exp();
            let area = k * k * (high - low) / f64::from(n) * std::f64::consts::TAU / f64::from(m);
            for j in 0..m {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(j) / f64::from(m)).sin_cos();
                sum += s.wavenumber_density(k * cos, k * sin) * area;
            }
        }
        near(sum, s.variance(), 1e-3);
    }
}

#[test]
fn slopes_of_the_wind_sea_are_plausible_and_add_up() {
    let s = spectrum(Spectrum::JonswapFetch { wind_speed: 10.0, fetch: 100e3 });
    // Cox and Munk 1954 measured .003 + .00512 U = .054 for all waves of a clean surface.
    let all = s.hidden_slope(1e3);
    assert!((0.03..0.06).contains(&all), "{all}");
    // Above the peak the density of slope over ln k is alpha/2 for an omega^-5 tail.
    let octave = s.hidden_slope(1.0) - s.hidden_slope(0.5);
    near(octave, 0.5 * 0.01006 * 2f64.ln(), 0.02);
    assert_eq!(s.hidden_slope(0.001), 0.0);
    assert_eq!(s.hidden_slope(f64::NAN), 0.0);
    assert!(s.hidden_slope(0.0) == 0.0 && s.hidden_slope(-1.0) == 0.0);
}

fn measured_height(ocean: &Ocean) -> f64 {
    let cascades = 0..ocean.modes().len();
    let variance = cascades.map(|c| {
        let texels = ocean.fields(c).displacement;
        texels.iter().map(|t| f64::from(t[1]).powi(2)).sum::<f64>() / texels.len() as f64
    });
    4.0 * variance.sum::<f64>().sqrt()
}

#[test]
fn the_made_sea_has_the_height_described() {
    for tiles in [1.5f32, 4.0] {
        let mut squares = 0.0;
        for seed in 0..24 {
            let sea = SeaState::wind(10.0, 100e3, 0.4);
            let tile = 60.6 * tiles;
            let cascades = vec![CascadeDesc::new(128, tile), CascadeDesc::new(64, tile / 6.7)];
            let mut ocean = Ocean::new(OceanDesc { sea, seed, cascades, ..Default::default() }).unwrap();
            let described = ocean.spectrum().significant_height();
            near(ocean.significant_height().into(), described, 0.003);
            // Waves that meet make the variance of one moment differ from the mean over time.
            let mut mean = 0.0;
            for i in 0..8 {
                ocean.set_time(1.7 * f64::from(i));
                let made = measured_height(&ocean) / described;
                squares += (made - 1.0) * (made - 1.0) / (24.0 * 8.0);
                mean += made / 8.0;
            }
            assert!((mean - 1.0).abs() < 0.01, "tile {tile}, seed {seed}: {mean}");
        }
        assert!(squares.sqrt() < 0.01, "tiles of {tiles} waves: rms {}", squares.sqrt());
    }
}

#[test]
fn bands_share_the_variance_without_gap_or_overlap() {
    let ocean = Ocean::new(OceanDesc::default()).unwrap();
    let s = ocean.spectrum();
    for modes in ocean.modes() {
        // Integral over frequency between the bounds of the band, against what the cells hold.
        let omega = |k: f64| dispersion::frequency(k, None);
        let low = omega(modes.band[0]).max(0.3);
        let high = omega(modes.band[1].min(0.5 * f64::from(modes.size) * modes.step()));
        let n = 20_000;
        let step = (high - low) / f64::from(n);
        let sum: f64 = (0..n).map(|i| s.frequency_density(low + step * (f64::from(i) + 0.5))).sum();
        near(modes.variance(), sum * step, 0.01);
    }
    for pair in ocean.modes().windows(2) {
        assert_eq!(pair[0].band[1], pair[1].band[0]);
    }
    near(ocean.significant_height().into(), s.significant_height(), 0.001);
    assert!(ocean.notices().is_empty());
}

#[test]
fn a_peak_between_two_bands_is_counted_once() {
    // Bands meet at waves of 8 m, and so does the sea.
    let cascades = vec![CascadeDesc::new(128, 96.0), CascadeDesc::new(128, 48.0)];
    let sea = SeaState::height_period(0.3, 2.264, 0.3);
    let ocean = Ocean::new(OceanDesc { sea, cascades, ..Default::default() }).unwrap();
    near(ocean.significant_height().into(), ocean.spectrum().significant_height(), 6e-3);
    assert!(ocean.modes().iter().all(|modes| modes.variance() > 0.2 * ocean.spectrum().variance()));
}

#[test]
fn mean_and_nyquist_are_empty_and_mirrors_agree() {
    let ocean = Ocean::new(OceanDesc::default()).unwrap();
    for modes in ocean.modes() {
        let n = modes.size as usize;
        for i in 0..n {
            for cell in [0, i * n + n / 2, n / 2 * n + i] {
                assert_eq!((modes.amp[cell], modes.n[cell]), ([0.0; 4], 0));
            }
        }
        for (cell, a) in modes.amp.iter().enumerate() {
            let mirror = (n - cell / n) % n * n + (n - cell % n) % n;
            let b = modes.amp[mirror];
            assert_eq!((a[0], a[1], a[2], a[3]), (b[2], -b[3], b[0], -b[1]));
            assert_eq!(modes.n[cell], modes.n[mirror]);
        }
    }
}

#[test]
fn a_smaller_fft_holds_a_part_of_the_same_modes() {
    let make = |size| {
        let cascades = [485.0, 72.4, 10.8].map(|tile| CascadeDesc::new(size, tile)).to_vec();
        Ocean::new(OceanDesc { cascades, seed: 9, ..Default::default() }).unwrap()
    };
    let (small, large) = (make(64), make(256));
    for (small, large) in small.modes().iter().zip(large.modes()) {
        let mut held = 0;
        for (cell, amp) in small.amp.iter().enumerate() {
            let (i, j) = (small.signed(cell as u32 % 64), small.signed(cell as u32 / 64));
            if i == -32 || j == -32 {
                continue;
            }
            let same = (j.rem_euclid(256) * 256 + i.rem_euclid(256)) as usize;
            assert_eq!((amp, small.n[cell]), (&large.amp[same], large.n[same]));
            held += usize::from(amp[0] != 0.0);
        }
        assert!(held > 2000, "{held}");
    }
    assert!(matches!(small.notices(), [Notice::VarianceLost { share }] if *share < 0.2));
}

#[test]
fn waves_travel_where_they_are_told() {
    // The mean of k weighted by variance points along the direction.
    let sea = SeaState::wind(10.0, 100e3, 2.0);
    let ocean = Ocean::new(OceanDesc { sea, ..Default::default() }).unwrap();
    let modes = &ocean.modes()[0];
    let (mut x, mut z) = (0.0, 0.0);
    for (cell, amp) in modes.amp.iter().enumerate() {
        let power = f64::from(amp[0] * amp[0] + amp[1] * amp[1]);
        x += power * f64::from(modes.signed(cell as u32 % modes.size));
        z += power * f64::from(modes.signed(cell as u32 / modes.size));
    }
    assert!((z.atan2(x) - 2.0).abs() < 0.01, "{}", z.atan2(x));
}

#[test]
fn descriptions_out_of_bounds_are_refused() {
    let cascade = |size, tile| OceanDesc { cascades: vec![CascadeDesc::new(size, tile)], ..Default::default() };
    let bad = [
        cascade(100, 50.0),
        cascade(2048, 50.0),
        cascade(0, 50.0),
        cascade(64, f32::NAN),
        cascade(64, 0.0),
        OceanDesc { cascades: vec![], ..Default::default() },
        OceanDesc { cascades: vec![CascadeDesc::new(64, 50.0); 2], ..Default::default() },
        OceanDesc { choppiness: f32::INFINITY, ..Default::default() },
        OceanDesc { choppiness: -0.1, ..Default::default() },
        OceanDesc { loop_time: 0.0, ..Default::default() },
    ];
    for desc in bad {
        let error = Ocean::new(desc).err().unwrap().to_string();
        assert!(error.contains("; allowed: "), "{error}");
    }
}

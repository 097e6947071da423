//! Sea files: what they mean, and what is said about bad ones.

use std::f32::consts::FRAC_PI_2;

use ocean_spectrum::{Notice, OceanError, SeaState, Spectrum, Spreading, Tail, WaveSpectrum};
use proptest::prelude::*;

const TABLE: &str = "frequency density direction spread\n.1 1 270 30\n.2 4 270 30\n.3 1 270 30\n";

#[test]
fn shipped_files_are_what_they_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/assets/seas/");
    for (file, hs, tp) in [
        ("fresh-breeze.txt", 2.139, 6.23),
        ("moderate.txt", 1.8, 7.0),
        ("swell-and-wind-sea.txt", 1.92, 12.5),
        ("shallow-bay.txt", 2.0364, 7.134),
        ("crossing-swell.txt", 2.065, 14.0),
        ("two-seas-by-direction.txt", 2.382, 10.0),
    ] {
        let spectrum = WaveSpectrum::new(&SeaState::from_file(format!("{folder}{file}")).unwrap()).unwrap();
        assert!((spectrum.significant_height() / hs - 1.0).abs() < 0.02, "{file} {}", spectrum.significant_height());
        assert!((spectrum.peak_period() / tp - 1.0).abs() < 0.03, "{file} {}", spectrum.peak_period());
    }
}

#[test]
fn directions_are_where_waves_come_from() {
    for (from, x, z) in [(270, 1.0, 0.0), (0, 0.0, 1.0), (90, -1.0, 0.0), (180, 0.0, -1.0)] {
        let sea = SeaState::parse("sea", &format!("hs = 1\ntp = 6\ndirection = {from}")).unwrap();
        let (sin, cos) = sea.partitions[0].direction.sin_cos();
        assert!((cos - x).abs() < 1e-6 && (sin - z).abs() < 1e-6, "{from}");
    }
}

#[test]
fn every_form_is_read() {
    let text = "depth = 20 # m\n[swell]\nhs = 1\ntp = 12\ns = 40\n[sea]\nspectrum = pierson-moskowitz\nwind = 8\n\
        direction = 0\n[old]\nspectrum = phillips\nwind = 5\nhs = .3\n";
    let sea = SeaState::parse("sea", &format!("{text}{TABLE}")).unwrap();
    assert_eq!(sea.depth, Some(20.0));
    assert_eq!(
        sea.partitions[0].spectrum,
        Spectrum::Jonswap { significant_height: 1.0, peak_period: 12.0, gamma: 3.3 }
    );
    assert_eq!(sea.partitions[0].spreading, Spreading::Cos2s { s: 40.0 });
    assert_eq!(sea.partitions[1].spectrum, Spectrum::PiersonMoskowitz { wind_speed: 8.0 });
    assert!((sea.partitions[1].direction - FRAC_PI_2).abs() < 1e-6);
    assert_eq!(sea.partitions[2].spectrum, Spectrum::Phillips { wind_speed: 5.0, significant_height: 0.3 });
    assert_eq!(sea.partitions[2].spreading, Spreading::BothWays);
    let Spectrum::Table(rows) = &sea.partitions[3].spectrum else { panic!() };
    assert_eq!((rows.len(), rows[1].frequency, rows[1].density), (3, 0.2, 4.0));
    // 30 degrees: s = 2/.5236^2 - 1.
    assert!((rows[0].s - 6.295).abs() < 0.01);
    // r1 = s/(1+s) says the same.
    let r1 = SeaState::parse("sea", "r1 direction frequency density\n.8 0 .1 1\n.8 0 .2 1\n.8 0 .3 0\n").unwrap();
    let Spectrum::Table(rows) = &r1.partitions[0].spectrum else { panic!() };
    assert!((rows[0].s - 4.0).abs() < 1e-4);
}

#[test]
fn every_spreading_and_tail_is_read() {
    let text = "depth = 12\n[a]\nspectrum = tma\nwind = 12\nfetch = 8e4\nspreading = hasselmann\ntail = elfouhaily\n\
        [b]\nhs = 1\ntp = 11\nwind = 9\nspreading = hasselmann\nelongation = .7\n\
        [c]\nhs = 1\ntp = 5\nspreading = donelan-banner\ntail = donelan\ndepth-limited = yes\n\
        [d]\nspectrum = phillips\nwind = 7\nspreading = cos2s\ntail = of-spectrum\n[e]\nspectrum = tma\nhs = 1\ntp = 6\n\
        depth-limited = no\nspreading = both-ways";
    let sea = SeaState::parse("sea", text).unwrap();
    let p = &sea.partitions;
    assert_eq!(p[0].spectrum, Spectrum::JonswapFetch { wind_speed: 12.0, fetch: 8e4 });
    assert_eq!((p[0].spreading, p[0].depth_limited), (Spreading::Hasselmann { wind_speed: 12.0 }, true));
    assert_eq!(p[0].tail, Tail::Elfouhaily { wind_speed: 12.0 });
    assert_eq!(p[1].spectrum, Spectrum::Jonswap { significant_height: 1.0, peak_period: 11.0, gamma: 3.3 });
    assert_eq!((p[1].spreading, p[1].elongation), (Spreading::Hasselmann { wind_speed: 9.0 }, 0.7));
    assert_eq!((p[2].spreading, p[2].tail, p[2].depth_limited), (Spreading::DonelanBanner, Tail::Donelan, true));
    assert_eq!((p[3].spreading, p[3].tail), (Spreading::Cos2s { s: 6.0 }, Tail::OfSpectrum));
    assert_eq!((p[4].spreading, p[4].depth_limited), (Spreading::BothWays, false));
    assert_eq!((p[1].depth_limited, p[1].tail, p[0].elongation), (false, Tail::OfSpectrum, 0.0));
    assert!(WaveSpectrum::new(&sea).unwrap().significant_height() > 1.5);
}

const PLANE: &str = "directions 0 80 180 270\n.1 1 0 0 0\n.2 0 0 0 2\n.3 0 0 0 0\n";

#[test]
fn a_table_over_frequency_and_direction_is_read() {
    let sea = SeaState::parse("sea", &format!("{PLANE}hs = 1\ntp = 5")).unwrap();
    assert_eq!(sea.partitions.len(), 2);
    let Spectrum::Directional(table) = &sea.partitions[0].spectrum else { panic!() };
    assert_eq!((table.frequencies(), table.directions().len(), table.densities().len()), (&[0.1, 0.2, 0.3][..], 4, 12));
    // From the north, towards +z; per degree, so more per radian.
    assert!((table.directions()[0] - FRAC_PI_2).abs() < 1e-6 && (table.densities()[0] - 57.29578).abs() < 1e-3);
    // A row's integral: trapezia to both neighbours, 85 and 85 degrees of 1, or 90 and 90 of 2.
    let alone = WaveSpectrum::new(&SeaState::parse("sea", PLANE).unwrap()).unwrap();
    for (f, density) in [(0.1f64, 85.0), (0.2, 180.0), (0.15, 132.5), (0.05, 0.0), (0.6, 0.0)] {
        let made = alone.frequency_density(std::f64::consts::TAU * f * (1.0 + 1e-6)) * std::f64::consts::TAU;
        assert!((made - density).abs() < 1e-2, "{f} {made}");
    }
}

const SPEC: &str = "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) ... >\n\
    2026 11 22 06 40 0.180 0.000 (0.033) 1.500 (0.083) 999.00 (0.093) 2.000 (0.120) 0.400 (0.200)\n\
    2026 11 22 05 40 9.999 0.100 (0.033) 9.000 (0.083) 9.000 (0.093) 9.000 (0.120) 0.400 (0.200)\n";
const DIR: &str = "#YY  MM DD hh mm alpha1_1 (freq_1) ... >\n\
    2026 11 22 07 40 100.0 (0.033) 100.0 (0.083) 100.0 (0.093) 100.0 (0.120) 100.0 (0.200)\n\
    2026 11 22 06 40 999.0 (0.033) 270.0 (0.083) 270.0 (0.093) 180.0 (0.120) 999.0 (0.200)\n\
    2026 11 22 05 40 90.0 (0.033) 90.0 (0.083) 90.0 (0.093) 90.0 (0.120) 90.0 (0.200)\n";
const R1: &str = "#YY  MM DD hh mm r1_1 (freq_1) ... >\n\
    2026 11 22 06 40 999.0 (0.033) 0.90 (0.083) 0.90 (0.093) 0.80 (0.120) 0.50 (0.200)\n\
    2026 11 22 05 40 0.10 (0.033) 0.10 (0.083) 0.10 (0.093) 0.10 (0.120) 0.10 (0.200)\n";

#[test]
fn the_newest_spectrum_of_a_buoy_is_read() {
    let sea = SeaState::from_ndbc(SPEC, DIR, R1).unwrap();
    let Spectrum::Table(rows) = &sea.partitions[0].spectrum else { panic!() };
    let frequencies: Vec<_> = rows.iter().map(|row| row.frequency).collect();
    assert_eq!(frequencies, [0.033, 0.083, 0.12, 0.2]);
    assert_eq!(rows.iter().map(|row| row.density).collect::<Vec<_>>(), [0.0, 1.5, 2.0, 0.4]);
    let compass = |radians: f32| (radians.to_degrees() - 90.0).rem_euclid(360.0);
    for (row, (from, s)) in rows.iter().zip([(270.0, 9.0), (270.0, 9.0), (180.0, 4.0), (180.0, 1.0)]) {
        assert!((compass(row.direction) - from).abs() < 1e-3 && (row.s - s).abs() < 1e-3, "{row:?}");
    }
}

#[test]
fn bad_buoy_files_are_told_why() {
    let said = |spec: &str, dir: &str, r1: &str| SeaState::from_ndbc(spec, dir, r1).unwrap_err().to_string();
    let cases = [
        (said("", DIR, R1), "data_spec, line 1: found no row"),
        (said(SPEC, "# only this\n", R1), "swdir, line 2: found no row"),
        (said(SPEC, DIR, "2026 11 22 06 40"), "swr1, line 1: found no values"),
        (said(&SPEC.replace("2026 11", "2026 10"), DIR, R1), "data_spec, line 2: found no time"),
        (said(&SPEC.replace("(0.083)", "0.083"), DIR, R1), "data_spec, line 2: found `0.083` after `1.500`"),
        (said(&SPEC.replace("(0.083)", "(0.033)"), DIR, R1), "data_spec, line 2: found frequency 0.033 after 0.033"),
        (said(&SPEC.replace("1.500", "-1"), DIR, R1), "data_spec, line 2: found value `-1`"),
        (said(SPEC, DIR, &R1.replace("0.90", "nan")), "swr1, line 2: found value `nan`"),
        (said(SPEC, &DIR.replace("11 22", "13 22"), R1), "swdir, line 2: found month `13`"),
        (said(SPEC, DIR, "2026 11 22 06 40 999.0 (0.1)"), "swr1, line 1: found no values of r1"),
        (said("2026 11 22 06 40 9.9 999.0 (.1) 1 (.2) 1 (.3)", DIR, R1), "data_spec, line 1: found densities at 2"),
        (said("2026 11 22 06 40 9.9 0 (.1) 0 (.2) 0 (.3)", DIR, R1), "data_spec, line 1: found only densities of 0"),
        (said("2026 11 22 06 40 x 0 (.1)", DIR, R1), "data_spec, line 1: found separation frequency `x`"),
    ];
    for (said, expected) in cases {
        assert!(said.starts_with(expected) && said.contains("; allowed: "), "{said}\n{expected}");
    }
}

/// Line, what was found, what is allowed.
fn complaint(text: &str) -> (usize, String, String) {
    match SeaState::parse("my.txt", text) {
        Err(OceanError::File { file, line, found, allowed }) => {
            assert_eq!(file, "my.txt");
            (line, found, allowed)
        }
        other => panic!("{text:?}: {other:?}"),
    }
}

#[test]
fn bad_files_are_told_why() {
    let cases = [
        ("", 1, "no sea"),
        ("# only this\n\n", 3, "no sea"),
        ("depth = 3\n", 2, "no sea"),
        ("wind = 10\nfetch = x\n", 2, "fetch `x`"),
        ("wind = nan\n", 1, "wind `nan`"),
        ("wind = 10\nfetch = -5", 2, "fetch `-5`"),
        ("wind = 10\n\nwibble = 3", 3, "key `wibble`"),
        ("wind = 10\nwind = 11", 2, "second `wind`"),
        ("wind = 10\nhs = 1", 2, "wind, hs"),
        ("direction = 10\n", 1, "nothing"),
        ("spectrum = stokes\n", 1, "`stokes`"),
        ("[swell\nhs = 1", 1, "`[swell`"),
        ("[a]\n[b]\nhs=1\ntp=5", 1, "without keys"),
        ("hello there\n", 1, "`hello`"),
        ("frequency density direction\n.1 1 0\n", 1, "no column `spread`"),
        ("frequency density spread\n.1 1 0\n", 1, "no column `direction`"),
        ("frequency frequency density direction spread\n", 1, "second column for `frequency`"),
        ("frequency density direction spread\n.1 1 0\n", 2, "3 values"),
        ("frequency density direction spread\n.1 1 0 9\n.2 -1 0 9\n.3 0 0 9\n", 3, "density `-1`"),
        ("frequency density direction spread\n.1 NaN 0 9\n", 2, "density `NaN`"),
        ("frequency density direction spread\n.1 inf 0 9\n", 2, "density `inf`"),
        ("frequency density direction spread\n.2 1 0 9\n.1 1 0 9\n.3 0 0 9\n", 3, "0.1 after 0.2"),
        ("frequency density direction spread\n.1 1 0 9\n.1 1 0 9\n.3 0 0 9\n", 3, "0.1 after 0.1"),
        ("frequency density direction spread\n.1 1 0 9\n.2 1 0 9\n", 4, "2 rows"),
        ("frequency density direction spread\n.1 0 0 9\n.2 0 0 9\n.3 0 0 9\n", 5, "only densities of 0"),
        ("spectrum = tma\nhs = 1\ntp = 6\n", 4, "without `depth`"),
        ("spectrum = tma\nwind = 6\n", 2, "wind"),
        ("hs = 1\ntp = 6\nspreading = hasselmann\n", 3, "hasselmann without wind"),
        ("hs = 1\ntp = 6\ntail = elfouhaily\n", 3, "elfouhaily without wind"),
        ("hs = 1\ntp = 6\nwind = 9\n", 3, "wind, hs, tp"),
        ("hs = 1\ntp = 6\ns = 9\nspreading = donelan-banner\n", 4, "`s` and another"),
        ("spreading = wide\n", 1, "spreading `wide`"),
        ("tail = long\n", 1, "tail `long`"),
        ("depth-limited = maybe\n", 1, "depth-limited `maybe`"),
        ("elongation = 2\n", 1, "elongation `2`"),
        ("directions\n", 1, "0 directions"),
        ("directions 0 90 180\n", 1, "3 directions"),
        ("directions 0 90 80 270\n", 1, "-10 degrees"),
        ("directions 0 90 180 360\n", 1, "0 degrees"),
        ("directions 0 30 60 90\n", 1, "270 degrees"),
        ("directions 0 90 x 270\n", 1, "direction `x`"),
        ("directions 0 90 180 270\n.1 1 1 1\n", 2, "4 values"),
        ("directions 0 90 180 270\n.1 1 1 1 1\n.1 1 1 1 1\n", 3, "0.1 after 0.1"),
        ("directions 0 90 180 270\n.1 1 1 1 1\n.2 1 1 -1 1\n", 3, "density `-1`"),
        ("directions 0 90 180 270\n.1 1 1 1 1\n.2 1 1 1 1\nhs = 1", 4, "2 rows"),
        ("directions 0 90 180 270\n.1 0 0 0 0\n.2 0 0 0 0\n.3 0 0 0 0\n", 5, "only densities of 0"),
        ("directions 0 90 180 270\n.1 1 1 1 1\nfoo\n", 3, "1 rows"),
    ];
    for (text, line, found) in cases {
        let (at, said, allowed) = complaint(text);
        assert!(at == line && said.contains(found) && !allowed.is_empty(), "{text:?}: line {at}, {said}; {allowed}");
    }
    let text = SeaState::parse("my.txt", "wind = 900").unwrap_err().to_string();
    assert_eq!(text, "my.txt, line 1: found wind `900`; allowed: a number from 0.5 to 80");
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let error = SeaState::from_file("no/such/sea.txt").unwrap_err();
    assert!(matches!(&error, OceanError::Unreadable { file, .. } if file.ends_with("sea.txt")), "{error}");
    let path = std::env::temp_dir().join(format!("ocean-spectrum-{}.txt", std::process::id()));
    std::fs::write(&path, b"wind = 10\nfetch \xff").unwrap();
    let error = SeaState::from_file(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert!(matches!(&error, OceanError::File { line: 2, found, .. } if found == "byte 0xff"), "{error}");
}

#[test]
fn a_long_fetch_is_shortened_with_a_notice() {
    let spectrum = WaveSpectrum::new(&SeaState::parse("sea", "wind = 10\nfetch = 1e6").unwrap()).unwrap();
    let [Notice::FetchClamped { given, used }] = spectrum.notices() else { panic!("{:?}", spectrum.notices()) };
    assert!((given - 1e6).abs() < 1.0 && (used - 173.3e3).abs() < 100.0);
}

#[test]
fn descriptions_out_of_bounds_are_refused() {
    let sea = |depth| SeaState { depth: Some(depth), ..Default::default() };
    for depth in [f32::NAN, -1.0, 0.0, f32::INFINITY] {
        assert!(matches!(sea(depth).validate(), Err(OceanError::InvalidValue { field: "depth", .. })));
    }
    assert!(SeaState { partitions: vec![], depth: None }.validate().is_err());
    assert!(SeaState::wind(f32::NAN, 1e5, 0.0).validate().is_err());
    assert!(SeaState::wind(10.0, 1e5, f32::INFINITY).validate().is_err());
    assert!(SeaState::height_period(0.0, 5.0, 0.0).validate().is_err());
    assert!(SeaState::single(Spectrum::Table(vec![]), 0.0, Spreading::BothWays).validate().is_err());
}

proptest! {
    #[test]
    fn no_text_panics(text in any::<String>()) {
        let _ = SeaState::parse("sea", &text);
    }

    #[test]
    fn no_text_of_likely_words_panics(words in proptest::collection::vec(prop::sample::select(vec![
        "wind", "fetch", "hs", "tp", "gamma", "direction", "s", "depth", "spectrum", "frequency", "density", "spread",
        "r1", "=", "#", "[", "]", "[a]", "\n", "\n", " ", " ", "1", ".2", "3", "-4", "1e9", "nan", "jonswap", "phillips",
        "\u{e9}", "\r\n", "\t", "spreading", "tail", "elongation", "depth-limited", "tma", "hasselmann", "elfouhaily",
        "donelan", "yes", "directions", "directions 0 90 180 270\n", ".1 1 2 3 4\n", ".2 1 2 3 4\n", ".3 0 0 0 1\n",
    ]), 0..80)) {
        if let Ok(sea) = SeaState::parse("sea", &words.concat()) {
            let spectrum = WaveSpectrum::new(&sea).unwrap();
            prop_assert!(spectrum.significant_height().is_finite());
        }
    }
    #[test]
    fn no_damaged_file_panics(which in 0usize..5, at in 0usize..400, length in 0usize..9, junk in "[ -~\\n]{0,6}") {
        let sea = "depth = 9\nspectrum = tma\nwind = 9\nfetch = 5e4\nspreading = hasselmann\ntail = elfouhaily\n";
        let whole = [TABLE, sea, PLANE, SPEC, R1][which];
        let at = at.min(whole.len());
        let end = (at + length).min(whole.len());
        let text = format!("{}{junk}{}", &whole[..at], &whole[end..]);
        let read = match which {
            3 => SeaState::from_ndbc(&text, DIR, R1),
            4 => SeaState::from_ndbc(SPEC, DIR, &text),
            _ => SeaState::parse("sea", &text),
        };
        if let Ok(sea) = read {
            let spectrum = WaveSpectrum::new(&sea).unwrap();
            prop_assert!(spectrum.significant_height().is_finite() && spectrum.wavenumber_density(0.3, -0.2).is_finite());
        }
    }

    #[test]
    fn no_text_for_a_buoy_panics(text in any::<String>(), words in proptest::collection::vec(prop::sample::select(vec![
        "2026 11 22 06 40 ", "2026", " ", "\n", "#", "1.0 ", "(0.1) ", "(0.2) ", "(0.3) ", "999.0 ", "(", ")", "nan", "-1 ", "9.9 ",
    ]), 0..40)) {
        let words = words.concat();
        for text in [&text, &words] {
            let _ = SeaState::from_ndbc(text, DIR, R1);
            let _ = SeaState::from_ndbc(SPEC, text, R1);
            let _ = SeaState::from_ndbc(SPEC, text, text);
        }
    }
}

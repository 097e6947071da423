//! Sea files: what they mean, and what is said about bad ones.

use std::f32::consts::FRAC_PI_2;

use ocean_spectrum::{Notice, OceanError, SeaState, Spectrum, Spreading, WaveSpectrum};
use proptest::prelude::*;

const TABLE: &str = "frequency density direction spread\n.1 1 270 30\n.2 4 270 30\n.3 1 270 30\n";

#[test]
fn shipped_files_are_what_they_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/assets/seas/");
    for (file, hs, tp) in
        [("fresh-breeze.txt", 2.139, 6.23), ("moderate.txt", 1.8, 7.0), ("swell-and-wind-sea.txt", 1.92, 12.5)]
    {
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
        "\u{e9}", "\r\n", "\t",
    ]), 0..80)) {
        if let Ok(sea) = SeaState::parse("sea", &words.concat()) {
            let spectrum = WaveSpectrum::new(&sea).unwrap();
            prop_assert!(spectrum.significant_height().is_finite());
        }
    }
}

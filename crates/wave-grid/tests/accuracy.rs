//! Phase velocity against closed forms; the border against a larger domain.

mod plane_wave;

use std::f64::consts::PI;

use glam::Vec2;
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use plane_wave::turn;

fn desc(cells: [u32; 2], scheme: Scheme, a: f64) -> GridDesc {
    let speed = a.sqrt() * 0.5 * 60.0;
    GridDesc { cells, scheme, wave_speed: speed as f32, substeps: Some(1), ..Default::default() }
}

/// 4 sin^2(W/2) = a lambda(k), the dispersion relation of the scheme, W in radians per step.
fn closed_form(scheme: Scheme, a: f64, k: [f64; 2]) -> f64 {
    let (cx, cz) = (k[0].cos(), k[1].cos());
    let lambda = match scheme {
        Scheme::FivePoint => 4.0 - 2.0 * cx - 2.0 * cz,
        Scheme::NinePoint => (2.0 / 3.0) * (4.0 - 2.0 * cx - 2.0 * cz) + (1.0 / 6.0) * (4.0 - 4.0 * cx * cz),
        other => panic!("no closed form of {other:?}"),
    };
    2.0 * ((a * lambda / 4.0).sqrt()).asin()
}

/// Radians per step of a plane wave with (m, l) periods in 64 cells, from its phase after 150 steps.
fn measured(scheme: Scheme, a: f64, m: [i32; 2]) -> (f64, f64) {
    let n = 384;
    let k = m.map(|m| 2.0 * PI * f64::from(m) / 64.0);
    let expected = closed_form(scheme, a, k);
    let mut grid = WaveGrid::new(desc([n; 2], scheme, a)).unwrap();
    (turn(&mut grid, k, expected, 150), expected)
}

#[test]
fn phase_velocity_is_the_schemes_and_near_the_exact_one() {
    let cases = [
        // (scheme, a, direction, largest error of the phase velocity at about 8 cells per wave)
        (Scheme::NinePoint, 0.70, [8, 0], 0.0081),
        (Scheme::NinePoint, 0.70, [6, 5], 0.0081),
        (Scheme::NinePoint, 0.70, [-4, 7], 0.0083),
        (Scheme::FivePoint, 0.49, [8, 0], 0.0135),
        (Scheme::FivePoint, 0.49, [6, 5], 0.0010),
    ];
    for (scheme, a, m, bound) in cases {
        let (speed, expected) = measured(scheme, a, m);
        assert!((speed / expected - 1.0).abs() < 2e-6, "{scheme:?} {m:?}: {speed} against {expected}");
        let exact = a.sqrt() * 2.0 * PI * f64::from(m[0] * m[0] + m[1] * m[1]).sqrt() / 64.0;
        let error = (speed / exact - 1.0).abs();
        assert!(error < bound, "{scheme:?} {m:?}: {error}");
    }
}

/// Error over the peak at the border, dB: a Ricker pulse in an interior of 128 x 128 cells, against a domain whose
/// border the waves cannot reach and return from.
fn pulse_error(width: u32, scheme: Scheme, a: f64, at: [f32; 2]) -> f64 {
    let steps = 420;
    let rim = width as usize + 1;
    let border = Border::Absorbing { width };
    let pad = (f64::from(steps) * a.sqrt() * 0.525) as usize + 12;
    let small_n = 128 + 2 * rim;
    let large_n = 128 + 2 * (pad + rim);
    let mut small = WaveGrid::new(GridDesc { border, ..desc([small_n as u32; 2], scheme, a) }).unwrap();
    let mut large = WaveGrid::new(GridDesc { border, ..desc([large_n as u32; 2], scheme, a) }).unwrap();
    let f0 = a.sqrt() / 20.0;
    let (mut error, mut peak) = (0.0f64, 0.0f64);
    for t in 0..steps {
        let x = PI * f0 * (f64::from(t) - 1.2 / f0);
        let volume = ((1.0 - 2.0 * x * x) * (-x * x).exp()) as f32;
        for grid in [&mut small, &mut large] {
            grid.set_tile_skipping(false);
            assert!(grid.add(Source::Displacement { center: Vec2::from(at), radius: 0.0, volume }));
            grid.tick();
        }
        for j in 0..128 {
            for i in 0..128 {
                let r = large.heights()[(j + pad + rim) * large_n + i + pad + rim];
                let z = small.heights()[(j + rim) * small_n + i + rim];
                error = error.max(f64::from((r - z).abs()));
                if i == 0 || j == 0 || i == 127 || j == 127 {
                    peak = peak.max(f64::from(r.abs()));
                }
            }
        }
    }
    20.0 * (error / peak).log10()
}

#[test]
fn a_pulse_leaves_through_the_border() {
    for (width, scheme, a, bound) in [
        (12, Scheme::NinePoint, 0.45, -75.0),
        (12, Scheme::NinePoint, 0.70, -75.0),
        (12, Scheme::FivePoint, 0.45, -75.0),
        (8, Scheme::NinePoint, 0.70, -60.0),
        (16, Scheme::NinePoint, 0.70, -85.0),
    ] {
        let db = pulse_error(width, scheme, a, [0.0, 0.0]);
        println!("w {width} {scheme:?} a {a}: {db:.1} dB");
        assert!(db <= bound, "w {width} {scheme:?} a {a}: {db:.1} dB");
    }
}

#[test]
fn grazing_waves_are_absorbed_too() {
    // Six cells inside the border's edge.
    let db = pulse_error(12, Scheme::NinePoint, 0.70, [0.0, -28.0]);
    println!("grazing: {db:.1} dB");
    assert!(db <= -50.0, "{db:.1} dB");
}

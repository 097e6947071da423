//! Boxes, pressure and drops against closed forms; volume.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, Vec2};
use proptest::prelude::*;
use wave_grid::{CellKind, GridDesc, Medium, MediumCell, Source, WaveGrid};

fn desc(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 20.0, ..Default::default() }
}

/// A wall beyond x = 0.3 m.
struct Quay;

impl Medium for Quay {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if place.x > 0.3 { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn every_kind_keeps_its_volume_in_open_water_and_at_a_wall(
        x in -9.0f32..0.0, z in -9.0f32..9.0, length in 0.0f32..6.0, width in 0.0f32..3.0, heading in -7.0f32..7.0,
        volume in -20.0f32..20.0, walled in any::<bool>(),
    ) {
        let center = Vec2::new(x, z);
        let half = Vec2::new(length, width);
        for (source, given) in [
            (Source::Displacement { center, radius: width, volume }, volume),
            (Source::Box { center, half, heading, volume }, volume),
            (Source::Drop { center, radius: width, volume }, 0.0),
            (Source::Pressure { center, radius: length, pressure: 1000.0 * volume }, 0.0),
        ] {
            let mut grid = WaveGrid::new(desc(128)).unwrap();
            if walled {
                grid.set_medium(Some(Arc::new(Quay)));
            }
            prop_assert!(grid.add(source));
            let scale = f64::from(volume.abs());
            prop_assert!((grid.volume() - f64::from(given)).abs() <= 2e-6 * scale, "{source:?}: {}", grid.volume());
            for _ in 0..10 {
                grid.tick();
            }
            prop_assert!((grid.volume() - f64::from(given)).abs() <= 5e-5 * scale, "{source:?}: {}", grid.volume());
        }
    }

    #[test]
    fn no_number_makes_it_infinite(bits in proptest::array::uniform6(any::<u32>())) {
        let [x, z, length, width, heading, much] = bits.map(f32::from_bits);
        let mut grid = WaveGrid::new(desc(64)).unwrap();
        for center in [Vec2::new(x, z), Vec2::ZERO] {
            for radius in [length, 1.0] {
                grid.add(Source::Box { center, half: Vec2::new(radius, width), heading, volume: much });
                grid.add(Source::Box { center, half: Vec2::splat(radius), heading: 0.0, volume: much });
                grid.add(Source::Pressure { center, radius, pressure: much });
                grid.add(Source::Drop { center, radius, volume: much });
            }
        }
        for _ in 0..20 {
            grid.tick();
        }
        prop_assert!(grid.is_finite());
    }
}

#[test]
fn a_box_is_flat_within_and_nothing_without() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    let (half, heading) = (Vec2::new(10.0, 5.0), 0.5f32);
    assert!(grid.add(Source::Box { center: Vec2::new(1.0, -2.0), half, heading, volume: 20.0 }));
    let along = DVec2::new(f64::from(heading).cos(), f64::from(heading).sin());
    for (at, z) in grid.heights().iter().enumerate() {
        let cell = DVec2::new((at % 128) as f64 - 63.5, (at / 128) as f64 - 63.5) * 0.5 - DVec2::new(1.0, -2.0);
        let (u, v) = (cell.dot(along).abs(), cell.dot(along.perp()).abs());
        // 20 m^3 over 20 m x 10 m.
        if u < 9.2 && v < 4.2 {
            assert!((z - 0.1).abs() < 0.001, "{z} at {cell}");
        } else if u > 10.76 || v > 5.76 {
            assert_eq!(*z, 0.0, "at {cell}");
        }
    }
}

#[test]
fn steady_pressure_stands_in_a_hollow_of_its_own_weight() {
    for (wave_speed, substeps) in [(20.0, 1), (70.0, 3)] {
        let desc = GridDesc { cells: [128; 2], wave_speed, damping: 2.0, ..GridDesc::default() };
        let mut grid = WaveGrid::new(desc).unwrap();
        assert_eq!(grid.stepping().substeps, substeps);
        for _ in 0..1500 {
            assert!(grid.add(Source::Pressure { center: Vec2::ZERO, radius: 7.0, pressure: 981.0 }));
            grid.tick();
        }
        let mut worst = 0.0f64;
        for (at, z) in grid.heights().iter().enumerate() {
            let r = 0.5 * ((at % 128) as f64 - 63.5).hypot((at / 128) as f64 - 63.5);
            let t = ((7.75 - r) / 7.75).clamp(0.0, 1.0);
            worst = worst.max((f64::from(*z) + 0.1 * t * t * (3.0 - 2.0 * t)).abs());
        }
        println!("{substeps} sub-steps: {worst:e} m of 0.1");
        assert!(worst < if substeps == 1 { 5e-4 } else { 3e-3 }, "{worst}");
    }
}

/// Bessel's J0 by its integral.
fn bessel(x: f64) -> f64 {
    let n = 64 + x as usize;
    (0..n).map(|i| (x * (PI * (i as f64 + 0.5) / n as f64).sin()).cos()).sum::<f64>() / n as f64
}

#[test]
fn the_ring_of_a_drop_is_the_wave_equations() {
    // 20 m/s in steps of 1/60 s: a crater that ends at 12 m, 24 cells, in a rim that ends at 24 m.
    let mut grid = WaveGrid::new(desc(512)).unwrap();
    let (radius, volume, outer) = (11.25f64, 3.0, 12.0f64);
    assert!(grid.add(Source::Drop { center: Vec2::ZERO, radius: radius as f32, volume: volume as f32 }));
    let ticks = 150;
    for _ in 0..ticks {
        grid.tick();
    }
    // Written into both states: at rest half a step before it was told.
    let time = (f64::from(ticks) + 0.5) / 60.0;
    // Hankel transform of a smoothstep of unit volume that ends at R: integral of s(1 - r/R) J0(k r) r dr.
    let transform = |k: f64, end: f64| {
        let n = 200;
        let step = end / f64::from(n);
        let (mut sum, mut total) = (0.0, 0.0);
        for i in 0..n {
            let r = (f64::from(i) + 0.5) * step;
            let t = 1.0 - r / end;
            let s = t * t * (3.0 - 2.0 * t) * r * step;
            sum += s * bessel(k * r);
            total += s;
        }
        sum / (TAU * total)
    };
    let spectrum: Vec<(f64, f64)> = (0..600)
        .map(|i| (f64::from(i) + 0.5) * 0.005)
        .map(|k| (k, volume * (transform(k, 2.0 * outer) - transform(k, outer)) * k * 0.005))
        .collect();
    let (mut worst, mut peak) = (0.0f64, 0.0f64);
    for i in 0..180 {
        let r = 0.5 * (f64::from(i) + 0.5f64).hypot(0.5);
        let exact: f64 = spectrum.iter().map(|(k, s)| s * (20.0 * k * time).cos() * bessel(k * r)).sum();
        let z = f64::from(grid.heights()[256 * 512 + 256 + i as usize]);
        worst = worst.max((z - exact).abs());
        peak = peak.max(exact.abs());
    }
    println!("off by {worst:e} m of {peak:e}");
    assert!(worst < 0.03 * peak, "{worst} of {peak}");
}

#[test]
fn a_hundred_thousand_sources_keep_the_volume() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    let (mut told, mut sum, mut state) = (0.0f64, 0.0f64, 1u64);
    let mut uniform = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    for n in 0..100_000 {
        let center = Vec2::new(uniform() - 0.5, uniform() - 0.5) * 30.0;
        let (radius, volume) = (uniform() * 3.0, uniform() - 0.5);
        let source = match n % 3 {
            0 => Source::Displacement { center, radius, volume },
            1 => Source::Box { center, half: Vec2::new(radius, 1.0), heading: radius, volume },
            _ => Source::Drop { center, radius, volume },
        };
        assert!(grid.add(source));
        if n % 3 < 2 {
            told += f64::from(volume);
        }
        sum += f64::from(volume.abs());
    }
    let error = (grid.volume() - told).abs();
    println!("{error:e} m^3 off of {told} told, {sum} moved: {:e}", error / sum);
    assert!(error < 1e-8 * sum, "{error}");
}

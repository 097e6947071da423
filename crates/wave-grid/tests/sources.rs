//! Sources, tiles, sleep, energy, threads.

use glam::{DVec2, Vec2};
use proptest::prelude::*;
use wave_grid::{Border, GridDesc, GridError, HEIGHT_LIMIT, QUIET_HEIGHT, Scheme, Source, WaveGrid};

fn desc(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 20.0, ..Default::default() }
}

fn stone(x: f32, z: f32, radius: f32, volume: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius, volume }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn the_volume_written_is_the_volume_given(
        x in -10.0f32..10.0, z in -10.0f32..10.0, radius in 0.0f32..6.0, volume in -20.0f32..20.0,
    ) {
        let mut grid = WaveGrid::new(desc(128)).unwrap();
        prop_assert!(grid.add(stone(x, z, radius, volume)));
        prop_assert!((grid.volume() - f64::from(volume)).abs() <= 2e-6 * f64::from(volume.abs()));
        for _ in 0..10 {
            grid.tick();
        }
        prop_assert!((grid.volume() - f64::from(volume)).abs() <= 2e-5 * f64::from(volume.abs()));
    }

    #[test]
    fn no_source_makes_it_infinite(bits in proptest::array::uniform4(any::<u32>())) {
        let [x, z, radius, volume] = bits.map(f32::from_bits);
        let mut grid = WaveGrid::new(desc(64)).unwrap();
        grid.add(stone(x, z, radius, volume));
        grid.add(stone(0.0, 0.0, 1.0, volume));
        grid.add(Source::Turbulence { center: Vec2::ZERO, radius: 1.0, foam: volume });
        for _ in 0..20 {
            grid.tick();
        }
        prop_assert!(grid.is_finite());
    }
}

#[test]
fn sources_that_reach_the_layer_are_dropped_and_counted() {
    let mut grid = WaveGrid::new(desc(96)).unwrap();
    let edge = (48.0 - 14.0 - 3.0) * 0.5;
    assert!(grid.add(stone(edge - 0.01, 0.0, 0.0, 1.0)));
    let before = grid.hash();
    for source in [
        stone(edge + 0.01, 0.0, 0.0, 1.0),
        stone(0.0, -edge - 0.01, 0.0, 1.0),
        stone(0.0, 0.0, 40.0, 1.0),
        stone(f32::NAN, 0.0, 1.0, 1.0),
        stone(0.0, 0.0, -1.0, 1.0),
        stone(0.0, 0.0, 1.0, f32::INFINITY),
    ] {
        assert!(!grid.add(source), "{source:?}");
    }
    assert_eq!(grid.dropped_sources(), 6);
    assert_eq!(grid.hash(), before);
    assert!(grid.add(stone(0.0, 0.0, 1.0, 1e30)));
    assert!(grid.heights().iter().all(|z| z.abs() <= HEIGHT_LIMIT));
}

#[test]
fn energy_is_kept_until_waves_reach_the_border_and_then_leaves() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let mut grid = WaveGrid::new(GridDesc { scheme, ..desc(256) }).unwrap();
        grid.set_tile_skipping(false);
        grid.add(stone(0.0, 0.0, 4.0, 30.0));
        let start = grid.energy();
        for t in 0..600 {
            grid.tick();
            let ratio = grid.energy() / start;
            if t < 100 {
                assert!((ratio - 1.0).abs() < 1e-4, "{scheme:?} tick {t}: {ratio}");
            }
            assert!(ratio < 1.0 + 1e-4);
        }
        assert!(grid.energy() < 3e-3 * start, "{scheme:?}: {}", grid.energy() / start);
    }
}

#[test]
fn damping_takes_energy_away() {
    let mut grid = WaveGrid::new(GridDesc { damping: 0.5, ..desc(256) }).unwrap();
    grid.add(stone(0.0, 0.0, 2.0, 10.0));
    for _ in 0..10 {
        grid.tick();
    }
    let start = grid.energy();
    for _ in 0..60 {
        grid.tick();
    }
    // z_tt + sigma z_t: energy of travelling waves falls as exp(-sigma t).
    let ratio = grid.energy() / start;
    assert!((ratio - (-0.5f64).exp()).abs() < 0.02, "{ratio}");
}

#[test]
fn quiet_tiles_change_nothing_that_can_be_seen() {
    let mut lazy = WaveGrid::new(desc(256)).unwrap();
    let mut eager = lazy.clone();
    eager.set_tile_skipping(false);
    let mut least = usize::MAX;
    let mut worst = 0.0f32;
    for t in 0..600 {
        let target = DVec2::new(f64::from(t) * 0.12, 0.0);
        for grid in [&mut lazy, &mut eager] {
            grid.center_on(target);
            grid.set_origin(target);
            if (20..200).contains(&t) {
                grid.add(stone(0.0, 0.0, 1.0, 0.05 * (t as f32 * 0.2).sin()));
            }
            grid.tick();
        }
        if t == 25 {
            least = lazy.active_tiles();
        }
        for (a, b) in lazy.heights().iter().zip(eager.heights()) {
            worst = worst.max((a - b).abs());
        }
    }
    assert!(least < 60, "{least} of 289 tiles");
    println!("worst difference {worst:e}");
    assert!(worst <= 2.0 * QUIET_HEIGHT, "{worst}");
}

#[test]
fn a_calm_grid_sleeps_and_wakes() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    assert!(grid.is_asleep());
    grid.tick();
    assert_eq!(grid.active_tiles(), 0);
    grid.add(stone(0.0, 0.0, 1.0, 0.02));
    assert!(!grid.is_asleep());
    let mut ticks = 0;
    while !grid.is_asleep() {
        grid.tick();
        ticks += 1;
        assert!(ticks < 6000, "never sleeps");
    }
    assert!(ticks > 60);
    grid.tick();
    grid.tick();
    assert!(grid.heights().iter().all(|z| *z == 0.0));
    let mut drawn = vec![[1.0; 2]; 128 * 128];
    grid.draw(0.5, &mut drawn);
    assert!(drawn.iter().all(|d| *d == [0.0; 2]));
    let asleep = grid.hash();
    grid.tick();
    assert_eq!(grid.hash(), asleep);
    grid.add(stone(3.0, 0.0, 1.0, 0.02));
    grid.tick();
    assert!(grid.active_tiles() > 0);
}

#[test]
fn threads_do_not_change_the_bits() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut grid = WaveGrid::new(desc(512)).unwrap();
            grid.set_tile_skipping(false);
            for t in 0..40 {
                grid.center_on(DVec2::new(f64::from(t) * 0.3, f64::from(t) * -0.2));
                grid.add(stone(0.0, 0.0, 2.0, 1.0));
                grid.tick();
            }
            grid.hash()
        })
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn a_breaking_wake_leaves_foam_that_decays() {
    let mut grid = WaveGrid::new(desc(128)).unwrap();
    let foam = |grid: &WaveGrid| {
        let mut drawn = vec![[0.0; 2]; 128 * 128];
        grid.draw(1.0, &mut drawn);
        drawn.iter().map(|d| f64::from(d[1])).sum::<f64>()
    };
    grid.add(stone(0.0, 0.0, 2.0, 0.01));
    grid.tick();
    assert_eq!(foam(&grid), 0.0, "gentle waves do not break");
    grid.add(stone(0.0, 0.0, 2.0, 12.0));
    for _ in 0..5 {
        grid.tick();
    }
    let broken = foam(&grid);
    assert!(broken > 1.0);
    grid.clear();
    grid.add(Source::Turbulence { center: Vec2::ZERO, radius: 1.5, foam: 0.8 });
    let stirred = foam(&grid);
    assert!(stirred > 5.0);
    for _ in 0..300 {
        grid.tick();
    }
    let ratio = foam(&grid) / stirred;
    assert!((ratio - (-1.0f64).exp()).abs() < 0.01, "five seconds are one time constant: {ratio}");
}

#[test]
fn bad_descriptions_are_named() {
    let bad = |change: fn(&mut GridDesc)| {
        let mut d = GridDesc::default();
        change(&mut d);
        WaveGrid::new(d).err().map(|e| e.to_string()).unwrap_or_default()
    };
    for (message, part) in [
        (bad(|d| d.cells = [16, 64]), "cells[0] = 16"),
        (bad(|d| d.cell_size[0] = 0.0), "cell_size[0] = 0"),
        (bad(|d| d.wave_speed = f32::NAN), "wave_speed = NaN"),
        (bad(|d| d.border = Border::Absorbing { width: 40 }), "border: width = 40"),
        (bad(|d| d.damping = -1.0), "damping = -1"),
        (bad(|d| d.tick = f32::INFINITY), "tick = inf"),
        (bad(|d| d.substeps = Some(0)), "substeps = 0"),
        (bad(|d| d.wave_speed = 900.0), "h = 0.5 m"),
    ] {
        assert!(message.contains(part), "{message}");
    }
    let tight = GridDesc { wave_speed: 26.0, substeps: Some(1), ..Default::default() };
    assert!(matches!(WaveGrid::new(tight), Err(GridError::Unstable { .. })));
    let five = GridDesc { scheme: Scheme::FivePoint, wave_speed: 60.0, ..Default::default() };
    let stepping = five.stepping().unwrap();
    assert!(stepping.a[0] <= 0.49 && stepping.substeps == 3, "{stepping:?}");
    let mut grid = WaveGrid::new(GridDesc::default()).unwrap();
    assert!(grid.impose(&[0.0; 3], &[0.0; 3]).is_err());
}

#[test]
fn a_walled_grid_holds_what_was_put_into_it_while_waves_run() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint, Scheme::Dispersive] {
        let border = wave_grid::Border::Reflecting;
        let desc = GridDesc { cells: [64, 48], cell_size: [0.5; 2], scheme, border, ..GridDesc::default() };
        let mut grid = WaveGrid::new(desc).unwrap();
        let mut given = 0.0;
        for tick in 0..400u16 {
            if tick % 40 == 0 {
                let volume = if tick == 120 { -0.7 } else { 0.2 };
                assert!(grid.add(Source::Displacement { center: Vec2::new(3.0, -2.0), radius: 1.5, volume }));
                given += f64::from(volume);
            }
            grid.tick();
            let error = (grid.held_volume() - given).abs();
            assert!(error < 2e-3, "{scheme:?} tick {tick}: {error} m^3 of {given}");
        }
    }
}

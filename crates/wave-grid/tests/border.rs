//! Borders that do not absorb, and the sponge.

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, GridSample, Rain, Scheme, Source, WaveGrid};

fn desc(border: Border) -> GridDesc {
    GridDesc { cells: [66, 50], cell_size: [0.5, 0.6], wave_speed: 8.0, border, ..GridDesc::default() }
}

fn drop_at(x: f32, z: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius: 1.0, volume: 0.3 }
}

fn samples(grid: &WaveGrid, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![GridSample::default(); points.len()];
    grid.sample(points, &mut out);
    out.iter().map(|sample| sample.height).collect()
}

/// Largest difference over largest value.
fn difference(a: &[f32], b: &[f32]) -> f32 {
    let most = a.iter().fold(0.0f32, |m, v| m.max(v.abs()));
    a.iter().zip(b).fold(0.0f32, |m, (a, b)| m.max((a - b).abs())) / most
}

#[test]
fn a_reflecting_border_is_a_mirror() {
    // 64 x 48 cells between walls at x = -16 and 16, z = -14.4 and 14.4; the mirror images of the source stand in a
    // large window instead. Nothing of its own border comes back in the time.
    let mut basin = WaveGrid::new(desc(Border::Reflecting)).unwrap();
    let mut open = WaveGrid::new(GridDesc { cells: [330, 290], ..desc(Border::default()) }).unwrap();
    let (x, z) = (5.0, -3.0);
    basin.add(drop_at(x, z));
    for i in -2..=2 {
        for j in -2..=2 {
            let image = |k: i32, at: f32, side: f32| k as f32 * side + if k % 2 == 0 { at } else { -at };
            assert!(open.add(drop_at(image(i, x, 32.0), image(j, z, 28.8))));
        }
    }
    for _ in 0..360 {
        basin.tick();
        open.tick();
    }
    // 6 s: 48 m, from wall to wall and back.
    let points: Vec<_> = (0..40).map(|k| Vec2::new(-14.0 + 0.7 * k as f32, 12.5 - 0.61 * k as f32)).collect();
    let error = difference(&samples(&open, &points), &samples(&basin, &points));
    assert!(error < 1e-3, "{error}");
}

#[test]
fn a_basin_keeps_its_water_and_energy() {
    for border in [Border::Reflecting, Border::Periodic] {
        for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
            let mut grid = WaveGrid::new(GridDesc { scheme, wave_speed: 6.0, ..desc(border) }).unwrap();
            grid.add(drop_at(3.0, 2.0));
            grid.tick();
            let (volume, energy) = (grid.volume(), grid.energy());
            assert!((volume - 0.3).abs() < 1e-5);
            for _ in 0..6000 {
                grid.tick();
            }
            // Rounding walks at random, and the level with it.
            assert!((grid.volume() - volume).abs() < 5e-3, "{border:?} {scheme:?}: {} m^3", grid.volume());
            let drift = (grid.energy() / energy - 1.0).abs();
            assert!(drift < 2e-3, "{border:?} {scheme:?}: {drift}");
        }
    }
}

#[test]
fn a_plane_wave_goes_round_a_periodic_grid() {
    // Four waves on 64 cells, obliquely one on 48: cos(k x - w t) with w of the scheme, in closed form.
    let desc = GridDesc { cell_size: [0.5; 2], wave_speed: 20.0, ..desc(Border::Periodic) };
    let mut grid = WaveGrid::new(desc).unwrap();
    let (a, dt) = (grid.stepping().a[0], grid.stepping().dt);
    let [kx, kz] = [4.0, 1.0]
        .map(|n: f64| n * std::f64::consts::TAU)
        .into_iter()
        .zip([64.0, 48.0])
        .map(|(n, of)| n / of)
        .collect::<Vec<_>>()[..]
    else {
        unreachable!()
    };
    let [sx, sz] = [kx, kz].map(|k| (0.5 * k).sin().powi(2));
    let omega = 2.0 * (a * (sx + sz - 2.0 / 3.0 * sx * sz)).sqrt().asin() / dt;
    let at = |i: usize, j: usize, t: f64| (kx * i as f64 + kz * j as f64 - omega * t).cos() as f32 * 0.1;
    let wave = |t: f64| (0..50).flat_map(|j| (0..66).map(move |i| at(i, j, t))).collect::<Vec<_>>();
    grid.impose(&wave(0.0), &wave(-dt)).unwrap();
    let seconds = 600.0 / 60.0;
    for _ in 0..600 {
        grid.tick();
    }
    let error = difference(&wave(seconds), grid.heights());
    assert!(error < 2e-3, "{error}");
}

#[test]
fn a_periodic_grid_is_the_same_everywhere() {
    let period = Vec2::new(32.0, 28.8);
    let mut grid = WaveGrid::new(desc(Border::Periodic)).unwrap();
    let mut moved = grid.clone();
    moved.center_on(DVec2::new(500.0, 70.0));
    assert_eq!(moved.window(), grid.window());
    // Across a corner of the window; the other is told it three and five periods away.
    grid.add(drop_at(15.9, -14.2));
    moved.add(drop_at(15.9 + 3.0 * period.x, -14.2 - 5.0 * period.y));
    for _ in 0..50 {
        grid.tick();
        moved.tick();
    }
    let points: Vec<_> = (0..200).map(|k| Vec2::new(-30.0 + 0.37 * k as f32, 25.0 - 0.29 * k as f32)).collect();
    let there: Vec<_> = points.iter().map(|p| *p + Vec2::new(-2.0, 1.0) * period).collect();
    let here = samples(&grid, &points);
    assert!(here.iter().any(|z| z.abs() > 1e-3));
    assert!(difference(&here, &samples(&grid, &there)) < 1e-3);
    assert!(difference(&here, &samples(&moved, &points)) < 1e-3);
    // The ring spreads alike over the seam and away from it.
    let middle = |x: f32, z: f32| {
        let mut grid = WaveGrid::new(desc(Border::Periodic)).unwrap();
        grid.add(drop_at(x, z));
        (0..50).for_each(|_| grid.tick());
        let ring: Vec<_> =
            (0..60).map(|k| Vec2::new(x, z) + 0.15 * k as f32 * Vec2::from_angle(0.3 * k as f32)).collect();
        samples(&grid, &ring)
    };
    assert!(difference(&middle(0.25, 0.3), &middle(-15.75, 14.1)) < 1e-3);
}

#[test]
fn rain_ripples_a_tile_and_ends() {
    let ripples = GridDesc {
        cells: [98; 2],
        cell_size: [0.02; 2],
        wave_speed: 0.4,
        damping: 0.5,
        border: Border::Periodic,
        ..GridDesc::default()
    };
    let mut grid = WaveGrid::new(ripples).unwrap();
    let rain = Rain { rate: 30.0, drop_radius: 0.002, seed: 5 };
    let fallen: usize = (0..120)
        .map(|tick| {
            let fallen = grid.add_rain(&rain, tick);
            grid.tick();
            fallen
        })
        .sum();
    // 1.92 m square, 2 s, 30 mm/h of 33.5 mm^3: 1833 drops.
    let expected = 1.92f64.powi(2) * 2.0 * rain.density();
    assert!((fallen as f64 / expected - 1.0).abs() < 0.1, "{fallen} of {expected}");
    assert!(grid.is_finite() && grid.volume().abs() < 1e-7);
    for _ in 0..3000 {
        grid.tick();
    }
    assert!(grid.is_asleep());
}

#[test]
fn a_sponge_absorbs_and_stays_bounded() {
    let still = WaveGrid::new(desc(Border::Sponge { width: 16 })).unwrap();
    assert!(still.is_asleep());
    let left = |border| {
        let mut grid = WaveGrid::new(GridDesc { cells: [128; 2], ..desc(border) }).unwrap();
        grid.add(drop_at(0.0, 0.0));
        grid.tick();
        let energy = grid.energy();
        (0..900).for_each(|_| grid.tick());
        assert!(grid.is_finite());
        grid.energy() / energy
    };
    let (sponge, layer) = (left(Border::Sponge { width: 16 }), left(Border::Absorbing { width: 16 }));
    assert!(sponge < 1e-2 && layer < sponge, "{sponge} {layer}");
}

#[test]
fn a_repeating_grid_takes_no_medium_feed_or_pressure() {
    let mut grid = WaveGrid::new(desc(Border::Periodic)).unwrap();
    assert!(!grid.add(Source::Pressure { center: Vec2::ZERO, radius: 2.0, pressure: 100.0 }));
    assert_eq!(grid.dropped_sources(), 1);
    grid.set_feed(wave_grid::Edges { low_x: true, ..Default::default() });
    assert!(grid.feed_lines().is_empty());
}

//! Rain: its statistics, and that it falls at the same places whatever window asks.

use glam::{DVec2, Vec2};
use wave_grid::{GridDesc, Rain, Source, WaveGrid, Window};

const RAIN: Rain = Rain { rate: 36.0, drop_radius: 0.001, seed: 11 };
const TICK: f32 = 1.0 / 60.0;

fn window(corner: [i64; 2], cells: [u32; 2]) -> Window {
    let desc = GridDesc { cell_size: [0.02; 2], wave_speed: 0.5, ..GridDesc::default() };
    Window { corner, cells, ..WaveGrid::new(desc).unwrap().window() }
}

fn places(rain: &Rain, window: &Window, tick: u64) -> Vec<DVec2> {
    let origin = window.world_corner();
    let drops = rain.drops(window, origin, tick, TICK);
    drops
        .map(|drop| match drop {
            Source::Drop { center, .. } => origin + center.as_dvec2(),
            other => panic!("{other:?}"),
        })
        .collect()
}

#[test]
fn as_much_water_falls_as_the_rate_says_and_as_unevenly_as_chance() {
    // 36 mm/h are 1e-5 m/s, of drops of 4.19e-9 m^3: 2387 a second and square metre.
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    assert!((RAIN.density() - 1e-5 / volume).abs() < 1e-3 * RAIN.density());
    let window = window([-300, 1000], [250, 100]);
    let (area, ticks) = (5.0 * 2.0, 2000);
    let counts: Vec<f64> = (0..ticks).map(|tick| places(&RAIN, &window, tick).len() as f64).collect();
    let mean = counts.iter().sum::<f64>() / ticks as f64;
    let variance = counts.iter().map(|n| (n - mean).powi(2)).sum::<f64>() / (ticks - 1) as f64;
    let expected = 1e-5 / volume * area / 60.0;
    println!("mean {mean} (expected {expected}), variance {variance}");
    // Four standard errors of either.
    assert!((mean - expected).abs() < 4.0 * (expected / ticks as f64).sqrt());
    assert!((variance / expected - 1.0).abs() < 4.0 * (2.0 / ticks as f64).sqrt());
}

#[test]
fn drops_fall_evenly_within_blocks() {
    // A chi-square test over 64 cells that do not line up with the blocks.
    let window = window([0, 0], [160, 160]);
    let mut counts = [0.0f64; 64];
    for tick in 0..800 {
        for place in places(&RAIN, &window, tick) {
            let cell = (place / 3.2 * 8.0).floor();
            counts[cell.y as usize * 8 + cell.x as usize] += 1.0;
        }
    }
    let mean = counts.iter().sum::<f64>() / 64.0;
    let chi: f64 = counts.iter().map(|n| (n - mean).powi(2) / mean).sum();
    println!("chi square {chi} of 63 degrees");
    assert!((30.0..110.0).contains(&chi), "{chi}");
}

#[test]
fn windows_see_the_same_rain() {
    let whole = window([-100, -50], [320, 256]);
    let parts = [window([-100, -50], [100, 256]), window([0, -50], [220, 51]), window([0, 1], [220, 205])];
    let key = |place: &DVec2| [(place.x * 1e5).round() as i64, (place.y * 1e5).round() as i64];
    let mut differs = false;
    for tick in 0..40 {
        let mut all: Vec<_> = places(&RAIN, &whole, tick).iter().map(key).collect();
        let mut sum: Vec<_> = parts.iter().flat_map(|part| places(&RAIN, part, tick)).map(|p| key(&p)).collect();
        all.sort_unstable();
        sum.sort_unstable();
        // Local coordinates are f32: a place may round the other way.
        let near = |(a, b): (&[i64; 2], &[i64; 2])| (a[0] - b[0]).abs() < 3 && (a[1] - b[1]).abs() < 3;
        assert!(all.len() == sum.len() && !all.is_empty() && all.iter().zip(&sum).all(near), "tick {tick}");
        differs |= places(&Rain { seed: 12, ..RAIN }, &whole, tick).len() != all.len();
    }
    assert!(differs, "another seed is another rain");
}

#[test]
fn rain_on_a_moving_grid_moves_no_water() {
    let desc = GridDesc { cells: [96; 2], cell_size: [0.02; 2], wave_speed: 0.5, ..GridDesc::default() };
    let mut grid = WaveGrid::new(desc).unwrap();
    let mut fallen = 0;
    for tick in 0..300 {
        let place = DVec2::new(1e5 + f64::from(tick) * 0.01, 3.0);
        grid.center_on(place);
        grid.set_origin(place);
        fallen += grid.add_rain(&Rain { rate: 100.0, drop_radius: 0.0025, seed: 3 }, tick as u64);
        grid.tick();
    }
    assert!(fallen > 1000 && grid.dropped_sources() == 0, "{fallen}");
    assert!(grid.is_finite() && grid.heights().iter().any(|z| z.abs() > 1e-5));
    for bad in [f32::NAN, 0.0, -1.0, f32::INFINITY] {
        assert_eq!(grid.add_rain(&Rain { rate: bad, ..RAIN }, 1), 0);
        assert_eq!(grid.add_rain(&Rain { drop_radius: bad, ..RAIN }, 1), 0);
    }
    let still = WaveGrid::new(desc).unwrap();
    assert_eq!(still.window().local_corner(DVec2::ZERO), Vec2::splat(-0.96));
}

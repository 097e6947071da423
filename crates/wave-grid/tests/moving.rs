//! The border layer of a window that moves: what it sends back, against a domain whose border the waves cannot reach and
//! return from; bounded and reproducible whatever the window does.

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

const INTERIOR: i64 = 96;
const STEPS: usize = 300;

fn desc(cells: [u32; 2], width: u32) -> GridDesc {
    // a = 0.45, a sub-step a tick, cells of a metre.
    let wave_speed = 0.45f32.sqrt() * 100.0;
    let (scheme, tick) = (Scheme::FivePoint, 0.01);
    GridDesc {
        cells,
        cell_size: [1.0; 2],
        wave_speed,
        scheme,
        border: Border::Absorbing { width },
        tick,
        ..GridDesc::default()
    }
}

/// What a source that keeps up with the window adds in a step.
fn press(grid: &mut WaveGrid, at: DVec2, step: usize, dipole: bool) {
    let start = (step as f32 / 48.0).min(1.0);
    let mut add = |x: f64, volume: f32| {
        let center = (at + DVec2::new(x, 0.0)).as_vec2();
        assert!(grid.add(Source::Displacement { center, radius: 4.0, volume }));
    };
    if dipole {
        add(2.0, 0.1 * start);
        add(-2.0, -0.1 * start);
    } else {
        add(0.0, start * (std::f32::consts::TAU * step as f32 / 24.0).sin());
    }
}

/// Error over the peak at the interior's border, dB.
fn reflection(velocity: DVec2, dipole: bool, matched: bool) -> f64 {
    let width = 16;
    let mut small = WaveGrid::new(desc([INTERIOR as u32 + 2 * (width + 1); 2], width)).unwrap();
    small.set_matched_motion(matched);
    let mut large = WaveGrid::new(desc([640, 512], width)).unwrap();
    for grid in [&mut small, &mut large] {
        grid.set_tile_skipping(false);
    }
    let step_length = velocity * f64::from(0.45f32).sqrt();
    let middle = step_length * (STEPS as f64 / 2.0);
    // Stands where the window passes half-way.
    large.center_on(middle.round());
    let (mut worst, mut peak) = (0.0f64, 0.0f64);
    for step in 0..STEPS {
        let at = step_length * step as f64;
        small.center_on(at);
        for grid in [&mut small, &mut large] {
            press(grid, at, step, dipole);
            grid.tick();
        }
        let corner = small.window().corner.map(|c| c + i64::from(width) + 2);
        let read = |grid: &WaveGrid, i: i64, j: i64| {
            let window = grid.window();
            let [x, z] = [i - window.corner[0], j - window.corner[1]];
            f64::from(grid.heights()[(z * i64::from(window.cells[0]) + x) as usize])
        };
        let last = INTERIOR - 3;
        for j in 0..=last {
            for i in 0..=last {
                let truth = read(&large, corner[0] + i, corner[1] + j);
                worst = worst.max((read(&small, corner[0] + i, corner[1] + j) - truth).abs());
                if i == 0 || j == 0 || i == last || j == last {
                    peak = peak.max(truth.abs());
                }
            }
        }
    }
    20.0 * (worst / peak).log10()
}

#[test]
fn waves_leave_through_a_border_that_moves() {
    // Along an axis, back, along the other, diagonally, as fast as the waves.
    for (velocity, osc, dip) in [
        (DVec2::new(0.1, 0.0), -50.0, -35.0),
        (DVec2::new(-0.5, 0.0), -45.0, -28.0),
        (DVec2::new(0.0, 0.5), -45.0, -28.0),
        (DVec2::new(0.35, -0.35), -38.0, -25.0),
        (DVec2::new(1.0, 0.0), -60.0, -50.0),
    ] {
        for (dipole, bound) in [(false, osc), (true, dip)] {
            let error = reflection(velocity, dipole, true);
            println!("{velocity} dipole {dipole}: {error:.1}, without {:.1}", reflection(velocity, dipole, false));
            assert!(error < bound, "{velocity} dipole {dipole}: {error:.1} dB");
        }
    }
}

#[test]
fn a_border_that_moves_at_random_stays_bounded_and_repeats_its_bits() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let run = || {
            let wave_speed = if scheme == Scheme::NinePoint { 83.0 } else { 67.0 };
            let mut grid = WaveGrid::new(GridDesc { scheme, wave_speed, ..desc([80, 96], 12) }).unwrap();
            let (mut at, mut velocity, mut seed) = (DVec2::ZERO, DVec2::ZERO, 5u64);
            let mut random = || {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (seed >> 33) as f64 / 2f64.powi(30) - 1.0
            };
            let mut highest = 0.0f32;
            for step in 0..4000 {
                if step % 200 == 0 {
                    // Up to 1.5 c along both axes; it stands now and then.
                    velocity = if step % 1000 == 0 { DVec2::ZERO } else { DVec2::new(random(), random()) * 1.5 * 0.8 };
                }
                at += velocity;
                grid.center_on(at);
                let volume = (step as f32 / 4.0).sin();
                let center = Vec2::new(at.x as f32, at.y as f32);
                grid.add(Source::Displacement { center, radius: 3.0, volume });
                grid.tick();
                highest = grid.heights().iter().fold(highest, |most, z| most.max(z.abs()));
            }
            (highest, grid.hash())
        };
        let (highest, hash) = run();
        assert!(highest < 1.0, "{scheme:?}: {highest} m");
        assert_eq!(hash, run().1);
    }
}

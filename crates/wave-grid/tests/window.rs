//! The moving window: exact shifts, boundedness, teleports, the fade.

use glam::{DVec2, Vec2};
use wave_grid::{GridDesc, GridSample, Source, WaveGrid};

fn near_the_bound(cells: u32) -> GridDesc {
    GridDesc { cells: [cells; 2], wave_speed: 25.0, ..Default::default() }
}

fn splash(grid: &mut WaveGrid, x: f32, z: f32, volume: f32) -> bool {
    grid.add(Source::Displacement { center: Vec2::new(x, z), radius: 1.5, volume })
}

/// Heights by world cell.
fn at(grid: &WaveGrid, cell: [i64; 2]) -> f32 {
    let w = grid.window();
    let i = (cell[0] - w.corner[0]) as usize;
    let j = (cell[1] - w.corner[1]) as usize;
    grid.heights()[j * w.cells[0] as usize + i]
}

#[test]
fn a_shift_changes_no_bit_away_from_the_border() {
    let mut still = WaveGrid::new(near_the_bound(320)).unwrap();
    let mut moving = still.clone();
    let path = [[0.0, 0.0], [3.0, 2.0], [7.3, -4.0], [-6.0, 1.0], [11.0, 9.0], [0.0, 0.0]];
    for (t, target) in path.iter().cycle().take(60).enumerate() {
        moving.center_on(DVec2::from(*target));
        for grid in [&mut still, &mut moving] {
            if t < 25 {
                splash(grid, (t % 5) as f32, -3.0, 0.4);
            }
            grid.tick();
        }
    }
    assert_ne!(still.window().corner[1], i64::MIN);
    // Within 60 steps the border is felt 60 cells in: 160 - 22 (shift) - 14 (layer) - 60.
    for z in -60..60 {
        for x in -60..60 {
            assert_eq!(at(&still, [x, z]).to_bits(), at(&moving, [x, z]).to_bits(), "cell {x}, {z}");
        }
    }
    assert!(at(&still, [40, 0]).abs() > 1e-4, "waves must have crossed the cells compared");
}

#[test]
fn the_surface_drawn_does_not_jump_when_the_window_shifts() {
    let mut grid = WaveGrid::new(near_the_bound(128)).unwrap();
    splash(&mut grid, 0.0, 0.0, 5.0);
    for _ in 0..40 {
        grid.tick();
    }
    let points: Vec<Vec2> = (0..400).map(|i| Vec2::new(i as f32 * 0.05, 3.0 + i as f32 * 0.04)).collect();
    let mut before = vec![GridSample::default(); points.len()];
    let mut after = before.clone();
    grid.sample(&points, &mut before);
    let mut moves = 0;
    for step in 1..300 {
        let corner = grid.window().corner;
        grid.center_on(DVec2::new(f64::from(step) * 0.01, 0.0));
        moves += i32::from(corner != grid.window().corner);
        grid.sample(&points, &mut after);
        for (a, b) in before.iter().zip(&after) {
            // The fade itself moves by 1 cm: slope 1.5 / (12 cells of .5 m).
            assert!((a.height - b.height).abs() <= 0.0026 * 0.3 + 1e-6);
        }
        before.clone_from(&after);
    }
    assert!(moves > 2);
}

#[test]
fn random_motion_stays_bounded() {
    let desc = GridDesc { cells: [96; 2], wave_speed: 25.0, ..Default::default() };
    let mut grid = WaveGrid::new(desc).unwrap();
    let mut random = 7u64;
    let mut uniform = || {
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (random >> 40) as f64 / f64::from(1 << 23) - 1.0
    };
    let (mut position, mut velocity) = (DVec2::ZERO, DVec2::ZERO);
    let mut peak = [0.0f32; 4];
    let ticks = 12_000;
    for t in 0..ticks {
        if t % 200 == 0 {
            velocity = DVec2::new(uniform(), uniform()) * 1.5 * 25.0;
        }
        position += velocity / 60.0;
        grid.center_on(position);
        grid.set_origin(position);
        splash(&mut grid, 0.0, 0.0, 0.3 * (t as f32 / 4.0).sin());
        grid.tick();
        if t % 50 == 0 {
            let most = grid.heights().iter().fold(0.0f32, |m, z| m.max(z.abs()));
            peak[t * 4 / ticks] = peak[t * 4 / ticks].max(most);
        }
    }
    assert!(grid.is_finite());
    assert!(peak[3] < 1.5 * peak[0] && peak[3] < 1.0, "{peak:?}");
}

#[test]
fn teleports_and_nonsense_stay_finite() {
    let mut grid = WaveGrid::new(near_the_bound(96)).unwrap();
    let corner = grid.window().corner;
    for target in [DVec2::NAN, DVec2::new(f64::INFINITY, 0.0), DVec2::new(1e300, 0.0)] {
        splash(&mut grid, 0.0, 0.0, 1.0);
        grid.tick();
        grid.center_on(target);
        assert_eq!(grid.window().corner, corner);
    }
    for target in [DVec2::new(1e6, -1e6), DVec2::new(1e6 + 20.0, -1e6), DVec2::new(-4e12, 0.0), DVec2::ZERO] {
        splash(&mut grid, 0.0, 0.0, 1.0);
        grid.tick();
        grid.center_on(target);
        grid.set_origin(target);
        grid.tick();
        assert!(grid.is_finite());
        let middle = grid.window().world_corner() + DVec2::splat(24.0);
        assert!((middle - target).abs().max_element() <= 0.5 + 1e-3, "{middle} {target}");
    }
    assert!(grid.is_asleep(), "a jump past the window leaves calm water");
}

#[test]
fn the_rim_is_drawn_as_zero() {
    let mut grid = WaveGrid::new(near_the_bound(64)).unwrap();
    let ones = vec![1.0; 64 * 64];
    for target in [0.0, 0.37, 0.49, 0.81, 7.0] {
        grid.center_on(DVec2::new(target, -target));
        grid.impose(&ones, &ones).unwrap();
        let mut drawn = vec![[f32::NAN; 2]; 64 * 64];
        grid.draw(1.0, &mut drawn);
        for j in 0..64usize {
            for i in 0..64usize {
                let [height, foam] = drawn[j * 64 + i];
                let from_rim = i.min(j).min(63 - i).min(63 - j);
                assert!((0.0..=1.0).contains(&height) && foam == 0.0);
                assert!(from_rim >= 3 || height == 0.0, "{i} {j} {height}");
                assert!(from_rim <= 18 || height == 1.0, "{i} {j} {height}");
            }
        }
        let corner = grid.window().world_corner();
        let mut out = [GridSample { height: f32::NAN, ..Default::default() }];
        for x in [-5.0, 0.01, 0.7, 1.2, 31.5, 31.99, 40.0, f64::NAN] {
            grid.sample(&[(corner + DVec2::new(x, 16.0)).as_vec2()], &mut out);
            assert_eq!(out[0].height, 0.0, "{x}");
        }
    }
}

#[test]
fn samples_are_the_drawn_cells_and_their_slopes() {
    let mut grid = WaveGrid::new(near_the_bound(128)).unwrap();
    let field = |x: f64, z: f64| 0.3 * (0.4 * x + 0.25 * z).sin();
    let heights: Vec<f32> = (0..128 * 128)
        .map(|c| {
            let x = (c % 128) as f64 * 0.5 + 0.25 - 32.0;
            let z = (c / 128) as f64 * 0.5 + 0.25 - 32.0;
            field(x, z) as f32
        })
        .collect();
    grid.impose(&heights, &heights).unwrap();
    let mut drawn = vec![[0.0; 2]; 128 * 128];
    grid.draw(0.4, &mut drawn);
    let mut out = [GridSample::default(); 2];
    for (i, j) in [(30usize, 64usize), (17, 20), (8, 60), (100, 119)] {
        let centre = Vec2::new(i as f32 * 0.5 + 0.25 - 32.0, j as f32 * 0.5 + 0.25 - 32.0);
        grid.sample(&[centre], &mut out);
        assert!((out[0].height - drawn[j * 128 + i][0]).abs() < 1e-6);
    }
    for x in 0..40 {
        let p = Vec2::new(x as f32 * 0.137 - 3.0, x as f32 * 0.091);
        grid.sample(&[p, p + Vec2::new(0.01, 0.0)], &mut out);
        let (px, pz) = (f64::from(p.x), f64::from(p.y));
        assert!((f64::from(out[0].height) - field(px, pz)).abs() < 1e-4);
        assert!((f64::from(out[0].slope.x) - 0.12 * (0.4 * px + 0.25 * pz).cos()).abs() < 2e-3);
        assert!((f64::from(out[0].slope.y) - 0.075 * (0.4 * px + 0.25 * pz).cos()).abs() < 2e-3);
        assert!(out[0].vertical_velocity == 0.0);
    }
}

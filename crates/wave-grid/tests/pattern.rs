//! Patterns: what is added and read with the same weights.

use glam::{DVec2, Vec2};
use wave_grid::{Border, GridDesc, GridError, Pattern, PatternKernel, Scheme, WaveGrid};

fn kernel(offset: Vec2, depth: f32, weight: f32) -> PatternKernel {
    PatternKernel { offset, depth, weight }
}

/// Heave, a pair along x, a pair along z, something else.
fn pattern() -> Pattern {
    let heave = [kernel(Vec2::ZERO, 1.0, 12.0), kernel(Vec2::ZERO, 3.0, -4.0)];
    let pitch = [kernel(Vec2::X * 2.0, 1.5, 6.0), kernel(Vec2::X * -2.0, 1.5, -6.0)];
    let roll = [kernel(Vec2::Y, 1.0, -3.0), kernel(Vec2::NEG_Y, 1.0, 3.0)];
    let hull = [kernel(Vec2::new(1.0, 0.5), 1.0, 2.0)];
    Pattern::new([&heave, &roll, &pitch, &hull], 12.0).unwrap()
}

fn grid() -> WaveGrid {
    WaveGrid::new(GridDesc { cells: [128; 2], scheme: Scheme::Dispersive, ..GridDesc::default() }).unwrap()
}

/// What layer `read` finds of a metre of layer `written`.
fn found(at: Vec2, heading: f32, written: usize) -> [f32; 4] {
    let mut grid = grid();
    let mut amounts = [0.0; 4];
    amounts[written] = 1.0;
    grid.add_pattern(&pattern(), at, heading, amounts);
    grid.read_pattern(&pattern(), at, heading)
}

#[test]
fn writing_and_reading_are_transposes_of_each_other() {
    for (at, heading) in [(Vec2::ZERO, 0.0), (Vec2::new(3.17, -4.9), 0.7), (Vec2::new(-25.0, 26.0), -2.6)] {
        let table: Vec<[f32; 4]> = (0..4).map(|written| found(at, heading, written)).collect();
        for (i, row) in table.iter().enumerate() {
            assert!(row[i] > 0.0);
            for (j, found) in row.iter().enumerate() {
                let scale = (row[i] * table[j][j]).sqrt();
                assert!((found - table[j][i]).abs() < 1e-5 * scale, "{at} {i} {j}: {table:?}");
            }
        }
    }
}

#[test]
fn the_weights_are_those_of_the_kernels_wherever_they_stand() {
    // Of a kernel of depth d within a reach R: w d integral (1 - (r/R)^2)^2 r / (r^2 + d^2)^1.5 dr, by summing rings.
    let (depth, reach, steps) = (1.5f64, 12.0f64, 40_000);
    let volume: f64 = (0..steps)
        .map(|i| {
            let r = (f64::from(i) + 0.5) / f64::from(steps) * reach;
            let left = 1.0 - (r / reach) * (r / reach);
            depth * left * left * r / (r * r + depth * depth).powf(1.5) * reach / f64::from(steps)
        })
        .sum();
    let one = [kernel(Vec2::new(1.0, -2.0), depth as f32, 5.0)];
    let pattern = Pattern::new([&one, &[], &[], &[]], reach as f32).unwrap();
    for (at, heading) in [(Vec2::ZERO, 0.0), (Vec2::new(0.21, 0.37), 1.1), (Vec2::new(7.3, -8.1), 3.0)] {
        let mut grid = grid();
        grid.add_pattern(&pattern, at, heading, [1.0, 0.0, 0.0, 0.0]);
        let (mut sum, mut first) = (0.0, DVec2::ZERO);
        let window = grid.window();
        for (i, z) in grid.heights().iter().enumerate() {
            let place = DVec2::new((i % 128) as f64 + 0.5, (i / 128) as f64 + 0.5) * 0.5 + window.world_corner();
            (sum, first) = (sum + f64::from(*z) * 0.25, first + place * f64::from(*z) * 0.25);
        }
        assert!((sum / (5.0 * volume) - 1.0).abs() < 0.01, "{sum} against {}", 5.0 * volume);
        let (sin, cos) = f64::from(heading).sin_cos();
        let middle = at.as_dvec2() + DVec2::new(cos + 2.0 * sin, sin - 2.0 * cos);
        assert!((first / sum).distance(middle) < 0.02, "{} against {middle}", first / sum);
    }
}

#[test]
fn a_still_grid_reads_zero_and_an_edge_cuts_both_ways() {
    assert_eq!(grid().read_pattern(&pattern(), Vec2::ZERO, 0.3), [0.0; 4]);
    // Half of it over the border layer, all of it beyond the window.
    let at = Vec2::new(27.0, 0.0);
    let [cut, whole] = [found(at, 0.0, 2), found(Vec2::ZERO, 0.0, 2)];
    assert!(cut[2] > 0.0 && cut[2] < whole[2]);
    assert_eq!(found(Vec2::new(100.0, 0.0), 0.0, 2), [0.0; 4]);
    assert_eq!(found(Vec2::new(f32::NAN, 0.0), 0.0, 2), [0.0; 4]);
    let mut grid = grid();
    grid.add_pattern(&pattern(), Vec2::ZERO, 0.0, [f32::NAN, 0.0, 0.0, 0.0]);
    assert!(grid.is_finite() && grid.heights().iter().all(|z| *z == 0.0));
}

#[test]
fn a_float_that_exchanges_by_a_pattern_never_swings_up() {
    // No wall absorbs: what it gives the water comes back, and no more.
    let desc =
        GridDesc { cells: [96; 2], scheme: Scheme::Dispersive, border: Border::Reflecting, ..GridDesc::default() };
    let mut grid = WaveGrid::new(desc).unwrap();
    let heave = [kernel(Vec2::ZERO, 1.0, 10.0)];
    let pattern = Pattern::new([&heave, &[], &[], &[]], 10.0).unwrap();
    let (mass, stiffness, dt) = (8000.0f32, 1000.0 * 9.81 * 12.0, 1.0 / 60.0);
    let (mut z, mut v, mut early, mut late) = (0.3f32, 0.0f32, 0.0f32, 0.0f32);
    for tick in 0..60 * 120 {
        let [head, ..] = grid.read_pattern(&pattern, Vec2::new(1.3, -0.4), 0.0);
        v += dt * (9810.0 * head - stiffness * z) / mass;
        z += dt * v;
        grid.add_pattern(&pattern, Vec2::new(1.3, -0.4), 0.0, [-dt * v, 0.0, 0.0, 0.0]);
        grid.tick();
        let most = if tick < 600 { &mut early } else { &mut late };
        *most = most.max(z.abs());
    }
    assert!(early > 0.2 && late < early && grid.is_finite(), "{early} then {late}");
}

#[test]
fn bad_patterns_are_refused_by_name() {
    let one = [kernel(Vec2::ZERO, 1.0, 1.0)];
    let field = |layer: &[PatternKernel], reach: f32| match Pattern::new([layer, &[], &[], &[]], reach) {
        Err(GridError::InvalidValue { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(field(&one, 0.0), "pattern: reach");
    assert_eq!(field(&one, f32::NAN), "pattern: reach");
    assert_eq!(field(&[kernel(Vec2::ZERO, 0.0, 1.0)], 5.0), "pattern: depth");
    assert_eq!(field(&[kernel(Vec2::NAN, 1.0, 1.0)], 5.0), "pattern: offset");
    assert_eq!(field(&[kernel(Vec2::ZERO, 1.0, f32::INFINITY)], 5.0), "pattern: weight");
    assert_eq!(field(&[], 5.0), "pattern: kernels");
}

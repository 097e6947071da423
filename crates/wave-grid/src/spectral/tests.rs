use super::*;
use crate::{GridDesc, WaveGrid};

fn desc(cells: [u32; 2], tick: f32) -> GridDesc {
    GridDesc { cells, tick, scheme: crate::Scheme::Spectral, border: Border::Periodic, ..GridDesc::default() }
}

/// Heights of a plane wave of `number` waves along each axis of a grid that repeats, `phase` turns on.
fn plane(desc: &GridDesc, number: [f64; 2], phase: f64) -> Vec<f32> {
    let [nx, nz] = desc.cells.map(|n| n as usize);
    let turns = |at: usize| {
        let x = (at % nx) as f64 / (nx - 2) as f64;
        let z = (at / nx) as f64 / (nz - 2) as f64;
        number[0] * x + number[1] * z - phase
    };
    (0..nx * nz).map(|at| (0.1 * libm::cos(TAU * turns(at))) as f32).collect()
}

/// Waves of one wavenumber, imposed as they were a step ago and are, after `ticks` against the closed form; in parts of the amplitude.
fn run(desc: GridDesc, number: [f64; 2], ticks: u32) -> f64 {
    let mut grid = WaveGrid::new(desc).unwrap();
    let k = (0..2).map(|i| (TAU * number[i] / (f64::from(desc.cells[i] - 2) * f64::from(desc.cell_size[i]))).powi(2));
    let k = k.sum::<f64>().sqrt();
    let frequency = (9.81 * k * (k * f64::from(desc.depth)).tanh()).sqrt() / TAU;
    let turn = frequency * f64::from(desc.tick);
    grid.impose(&plane(&desc, number, 0.0), &plane(&desc, number, -turn)).unwrap();
    grid.set_tile_skipping(false);
    for _ in 0..ticks {
        grid.tick();
    }
    let truth = plane(&desc, number, turn * f64::from(ticks));
    let nx = desc.cells[0] as usize;
    let inside = |at: &usize| (1..nx - 1).contains(&(at % nx)) && (1..desc.cells[1] as usize - 1).contains(&(at / nx));
    let error = |at: usize| f64::from((grid.heights()[at] - truth[at]).abs()) / 0.1;
    (0..truth.len()).filter(inside).map(error).fold(0.0, f64::max)
}

#[test]
fn plane_waves_are_exact_at_any_step_depth_and_size() {
    for (desc, number) in [
        (desc([66, 66], 1.0 / 60.0), [5.0, 0.0]),
        (desc([66, 130], 1.0 / 60.0), [3.0, -7.0]),
        // Neither is even.
        (desc([79, 101], 0.4), [-6.0, 11.0]),
        (GridDesc { depth: 0.7, ..desc([66, 62], 0.1) }, [2.0, 1.0]),
        (GridDesc { cell_size: [0.5, 0.8], ..desc([98, 66], 0.05) }, [9.0, 4.0]),
    ] {
        let error = run(desc, number, 200);
        assert!(error < 2e-4, "{number:?} of {:?}: {error}", desc.cells);
    }
}

#[test]
fn waves_of_two_cells_stand_and_turn() {
    // They have no direction: let go at rest, they stand.
    let desc = GridDesc { substeps: Some(1), ..desc([66, 50], 1.0 / 60.0) };
    let mut grid = WaveGrid::new(desc).unwrap();
    let heights = plane(&desc, [32.0, 24.0], 0.0);
    let k = std::f64::consts::PI / 0.5 * 2f64.sqrt();
    let turn = (9.81 * k).sqrt() * f64::from(desc.tick);
    let before: Vec<f32> = heights.iter().map(|z| z * turn.cos() as f32).collect();
    grid.impose(&heights, &before).unwrap();
    for tick in 1..=40 {
        grid.tick();
        let at = 20 * 66 + 31;
        let truth = heights[at] * (turn * f64::from(tick)).cos() as f32;
        assert!((grid.heights()[at] - truth).abs() < 1e-5, "tick {tick}: {} {truth}", grid.heights()[at]);
    }
}

#[test]
fn a_raised_level_stays() {
    let desc = desc([66, 50], 0.5);
    let mut grid = WaveGrid::new(desc).unwrap();
    let level = vec![0.3; 66 * 50];
    grid.impose(&level, &level).unwrap();
    for _ in 0..500 {
        grid.tick();
    }
    assert!(grid.heights().iter().all(|z| (z - 0.3).abs() < 1e-5));
}

#[test]
fn damping_takes_half_its_rate_of_the_amplitude() {
    let desc = GridDesc { damping: 0.2, ..desc([66, 66], 1.0 / 30.0) };
    let mut grid = WaveGrid::new(desc).unwrap();
    let (k, half) = (TAU * 4.0 / 32.0, 0.1f64);
    let turn = (9.81 * k - half * half).sqrt() * f64::from(desc.tick) / TAU;
    let grown = (half * f64::from(desc.tick)).exp() as f32;
    let before: Vec<f32> = plane(&desc, [4.0, 0.0], -turn).iter().map(|z| z * grown).collect();
    grid.impose(&plane(&desc, [4.0, 0.0], 0.0), &before).unwrap();
    let before = grid.energy();
    for _ in 0..150 {
        grid.tick();
    }
    // Twice the amplitude's rate, for 5 s.
    let kept = grid.energy() / before;
    assert!((kept / (-0.2f64 * 5.0).exp() - 1.0).abs() < 0.01, "{kept}");
}

#[test]
fn the_energy_of_a_plane_wave_is_that_of_its_heights_twice() {
    let desc = desc([66, 66], 1.0 / 60.0);
    let mut grid = WaveGrid::new(desc).unwrap();
    let turn = (9.81 * TAU * 5.0 / 32.0).sqrt() * f64::from(desc.tick) / TAU;
    grid.impose(&plane(&desc, [5.0, 0.0], 0.0), &plane(&desc, [5.0, 0.0], -turn)).unwrap();
    // g A^2 / 2 a square metre.
    let truth = 0.5 * 9.81 * 0.01 * 32.0 * 32.0;
    assert!((grid.energy() / truth - 1.0).abs() < 1e-3, "{}", grid.energy() / truth);
}

#[test]
fn pressure_held_lowers_the_water_by_its_head() {
    let desc = GridDesc { border: Border::Absorbing { width: 24 }, cells: [128; 2], ..desc([128; 2], 1.0 / 20.0) };
    let mut grid = WaveGrid::new(desc).unwrap();
    for _ in 0..1200 {
        let pressure = 0.1 * 9810.0;
        assert!(grid.add(crate::Source::Pressure { center: glam::Vec2::ZERO, radius: 6.0, pressure }));
        grid.tick();
    }
    let mut middle = [crate::GridSample::default()];
    grid.sample(&[glam::Vec2::ZERO], &mut middle);
    assert!((middle[0].height + 0.1).abs() < 0.005, "{:?}", middle[0]);
}

//! How fast a plane wave turns on a grid.

use std::f64::consts::PI;

use wave_grid::WaveGrid;

/// Phase in radians by which a wave of `k` radians a cell moves on in a sub-step, measured over `steps` ticks in the 64 x 64
/// cells from (160, 160), which hold whole waves and nothing of the edges reaches. `expected` is about that.
pub(super) fn turn(grid: &mut WaveGrid, k: [f64; 2], expected: f64, steps: u32) -> f64 {
    let [nx, nz] = grid.desc().cells.map(|n| n as usize);
    let phase = |i: usize, j: usize| k[0] * i as f64 + k[1] * j as f64;
    let wave =
        |time: f64| -> Vec<f32> { (0..nx * nz).map(|at| (phase(at % nx, at / nx) - time).cos() as f32).collect() };
    grid.impose(&wave(0.0), &wave(-expected)).unwrap();
    for _ in 0..steps {
        grid.tick();
    }
    let (mut re, mut im) = (0.0, 0.0);
    for j in 160..224 {
        for i in 160..224 {
            let z = f64::from(grid.heights()[j * nx + i]);
            re += z * phase(i, j).cos();
            im += z * phase(i, j).sin();
        }
    }
    let turned = im.atan2(re) - expected * f64::from(steps);
    expected + ((turned + PI).rem_euclid(2.0 * PI) - PI) / f64::from(steps)
}

//! Reads the drawn field between cells with the cubic kernel of `wgsl/shared/cubic.wgsl`.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};

use crate::{GridSample, Window, state::State};

/// The state at the end of the last tick at a local point; zero outside and for points that are not finite.
pub(crate) fn sample(
    state: &State,
    window: &Window,
    fade: &[Vec<f32>; 2],
    dt: f32,
    origin: DVec2,
    point: Vec2,
) -> GridSample {
    let at = window.cells_from_corner(point, origin) - 0.5;
    let base = at.floor();
    let inside = |x: f64, n: u32| x >= 1.0 && x <= f64::from(n) - 3.0;
    if !(inside(base.x, window.cells[0]) && inside(base.y, window.cells[1])) {
        return GridSample::default();
    }
    let t = at - base;
    let (wx, wz) = (weights(t.x as f32), weights(t.y as f32));
    let (dx, dz) = (slopes(t.x as f32), slopes(t.y as f32));
    let (first_x, first_z) = (base.x as usize - 1, base.y as usize - 1);
    let fade_x = &fade[0][first_x..first_x + 4];
    let mut sum = [0.0f32; 4];
    for j in 0..4 {
        let row = (first_z + j) * state.nx + first_x;
        let (z, old) = (&state.z[row..row + 4], &state.old[row..row + 4]);
        let (mut value, mut slope, mut rate) = (0.0, 0.0, 0.0);
        for i in 0..4 {
            let height = fade_x[i] * z[i];
            value += wx[i] * height;
            slope += dx[i] * height;
            rate += wx[i] * fade_x[i] * (z[i] - old[i]);
        }
        let f = fade[1][first_z + j];
        sum[0] += f * wz[j] * value;
        sum[1] += f * wz[j] * slope;
        sum[2] += f * dz[j] * value;
        sum[3] += f * wz[j] * rate;
    }
    GridSample {
        height: sum[0],
        slope: Vec2::new(sum[1], sum[2]) / Vec2::from(window.cell_size),
        vertical_velocity: sum[3] / dt,
    }
}

//! Reads the drawn field between cells with the cubic kernel of `wgsl/shared/cubic.wgsl`.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};

use crate::{GridSample, Window, hole::Holes, state::State};

/// The state at the end of the last tick at a place in cells from the corner; zero outside and where it is not finite.
/// Beyond the last column or row a window that `repeats` goes on with its third.
pub(crate) fn sample(
    state: &State,
    window: &Window,
    (fade, holes): (&[Vec<f32>; 2], &Holes),
    dt: f32,
    place: DVec2,
    repeats: bool,
) -> GridSample {
    let at = place - 0.5;
    let base = at.floor();
    let inside = |x: f64, n: u32| x >= 1.0 && x <= f64::from(n) - if repeats { 2.0 } else { 3.0 };
    if !(inside(base.x, window.cells[0]) && inside(base.y, window.cells[1])) {
        return GridSample::default();
    }
    let t = at - base;
    let (wx, wz) = (weights(t.x as f32), weights(t.y as f32));
    let (dx, dz) = (slopes(t.x as f32), slopes(t.y as f32));
    let (first_x, first_z) = (base.x as usize - 1, base.y as usize - 1);
    let seam = first_x + 4 > state.nx;
    let wrapped = |i: usize, n: usize| if i >= n { i - (n - 2) } else { i };
    let mut sum = [0.0f32; 4];
    for j in 0..4 {
        let row = wrapped(first_z + j, state.nz);
        let from = row * state.nx;
        let f = fade[1][row];
        let [value, slope, rate] = if seam {
            let [fade, z, old] = [&fade[0][..], &state.z[from..], &state.old[from..]].map(|line| {
                let of = |i: usize| line[wrapped(first_x + i, state.nx)];
                [of(0), of(1), of(2), of(3)]
            });
            sums([&fade, &z, &old], wx, dx)
        } else {
            let (cells, columns) = (from + first_x..from + first_x + 4, first_x..first_x + 4);
            let mut seen = [0.0f32; 4];
            seen.copy_from_slice(&fade[0][columns]);
            if !holes.is_empty() {
                seen.iter_mut().zip(holes.left(row, first_x)).for_each(|(seen, left)| *seen *= left);
            }
            sums([&seen, &state.z[cells.clone()], &state.old[cells]], wx, dx)
        };
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

/// Height, its slope and its change along a row of four cells: fade, z and z_old.
#[inline(always)]
fn sums([fade, z, old]: [&[f32]; 3], w: [f32; 4], d: [f32; 4]) -> [f32; 3] {
    let (fade, z, old) = (&fade[..4], &z[..4], &old[..4]);
    let (mut value, mut slope, mut rate) = (0.0, 0.0, 0.0);
    for i in 0..4 {
        let height = fade[i] * z[i];
        value += w[i] * height;
        slope += d[i] * height;
        rate += w[i] * fade[i] * (z[i] - old[i]);
    }
    [value, slope, rate]
}

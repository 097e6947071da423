//! The drawn heights of a GPU-homed grid as they came back to the CPU.

use glam::{DVec2, Vec2};
use open_water_shaders::cubic::{slopes, weights};
use wave_grid::{GridSample, Window};

/// An old copy of a grid's drawn heights.
pub(crate) struct Mirror {
    window: Window,
    /// World place of the local origin, metres.
    pub(crate) origin: DVec2,
    /// (height, foam) of each cell; empty until the first copy.
    cells: Vec<[f32; 2]>,
    tick: Option<u64>,
}

impl Mirror {
    pub(crate) fn new(cells: [u32; 2], cell_size: [f32; 2]) -> Self {
        Self { window: Window { corner: [0; 2], cells, cell_size }, origin: DVec2::ZERO, cells: Vec::new(), tick: None }
    }

    /// The tick that it shows.
    pub(crate) fn tick(&self) -> Option<u64> {
        self.tick
    }

    pub(crate) fn take(&mut self, tick: u64, corner: [i64; 2], bytes: &[u8]) {
        if self.tick == Some(tick) || !bytes.len().is_multiple_of(size_of::<[f32; 2]>()) {
            return;
        }
        self.cells.resize(bytes.len() / size_of::<[f32; 2]>(), [0.0; 2]);
        bytemuck::cast_slice_mut(&mut self.cells).copy_from_slice(bytes);
        self.window.corner = corner;
        self.tick = Some(tick);
    }

    /// The grid sleeps: whatever came back last is over.
    pub(crate) fn still(&mut self) {
        self.cells.clear();
    }

    /// As `grid_at` in `wgsl/shared/surface.wgsl`. Without a rate: the copy knows one moment only.
    pub(crate) fn sample(&self, points: &[Vec2], out: &mut [GridSample]) {
        for (point, out) in points.iter().zip(out) {
            *out = self.sample_one(*point).unwrap_or_default();
        }
    }

    fn sample_one(&self, point: Vec2) -> Option<GridSample> {
        let [nx, nz] = self.window.cells.map(|n| n as usize);
        if self.cells.len() != nx * nz {
            return None;
        }
        let at = self.window.cells_from_corner(point, self.origin) - 0.5;
        let base = at.floor();
        let inside = |x: f64, n: usize| x >= 1.0 && x <= n as f64 - 3.0;
        if !(inside(base.x, nx) && inside(base.y, nz)) {
            return None;
        }
        let t = (at - base).as_vec2();
        let (wx, wz, dx, dz) = (weights(t.x), weights(t.y), slopes(t.x), slopes(t.y));
        let mut sample = GridSample::default();
        for j in 0..4 {
            let first = (base.y as usize - 1 + j) * nx + base.x as usize - 1;
            for (i, [height, _]) in self.cells[first..first + 4].iter().enumerate() {
                sample.height += wx[i] * wz[j] * height;
                sample.slope += Vec2::new(dx[i] * wz[j], wx[i] * dz[j]) * *height / Vec2::from(self.window.cell_size);
            }
        }
        Some(sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_comes_back_as_it_was_sent() {
        let mut mirror = Mirror::new([48, 32], [0.5; 2]);
        let corner = [-10, 4];
        let plane = |x: f32, z: f32| 0.2 * x - 0.3 * z + 1.0;
        let cells: Vec<[f32; 2]> = (0..48 * 32)
            .map(|n| {
                let (i, j) = ((n % 48) as f32, (n / 48) as f32);
                [plane((i - 10.0 + 0.5) * 0.5, (j + 4.0 + 0.5) * 0.5), 0.0]
            })
            .collect();
        let mut out = [GridSample::default(); 3];
        let points = [Vec2::new(3.13, 9.71), Vec2::new(-4.9, 9.0), Vec2::new(f32::NAN, 9.0)];
        mirror.sample(&points, &mut out);
        assert_eq!((out[0].height, mirror.tick()), (0.0, None));
        mirror.take(7, corner, bytemuck::cast_slice(&cells));
        mirror.sample(&points, &mut out);
        assert!((out[0].height - plane(3.13, 9.71)).abs() < 1e-4, "{out:?}");
        assert!((out[0].slope - Vec2::new(0.2, -0.3)).length() < 1e-4, "{out:?}");
        assert_eq!((out[1].height, out[2].height, mirror.tick()), (0.0, 0.0, Some(7)));
    }
}

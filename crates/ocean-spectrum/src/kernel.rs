//! The cubic (Catmull-Rom) reading of a periodic array: C1, exact at texels. The WGSL side reads with the same weights.

use glam::Vec2;
use open_water_shaders::cubic::weights;

/// Where a point lies in an array, and the weights of the 16 texels around it.
pub(crate) struct Taps {
    columns: [usize; 4],
    rows: [usize; 4],
    wx: [f32; 4],
    wz: [f32; 4],
}

impl Taps {
    /// Taps at `at`, in texels, in an array of `size` (a power of two) squared.
    #[inline]
    pub(crate) fn new(at: Vec2, size: usize) -> Self {
        let base = at.floor();
        let t = at - base;
        let mask = size - 1;
        // Negative numbers wrap rightly, as two's complement ends on a multiple of the size.
        let (i, j) = (base.x as i32 as usize, base.y as i32 as usize);
        let wrapped = |i: usize| [0, 1, 2, 3].map(|n: usize| i.wrapping_add(n).wrapping_sub(1) & mask);
        Self { columns: wrapped(i), rows: wrapped(j).map(|row| row * size), wx: weights(t.x), wz: weights(t.y) }
    }

    #[inline]
    pub(crate) fn read(&self, texels: &[[f32; 4]]) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for (row, wz) in self.rows.iter().zip(self.wz) {
            let mut line = [0.0; 4];
            for (column, wx) in self.columns.iter().zip(self.wx) {
                let texel = &texels[row + column];
                for c in 0..4 {
                    line[c] += wx * texel[c];
                }
            }
            for c in 0..4 {
                sum[c] += wz * line[c];
            }
        }
        sum
    }
}

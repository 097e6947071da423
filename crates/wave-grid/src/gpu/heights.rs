//! Where a grid's heights stand in the device's memory, for who copies them back, and what the copies mean.

use super::{GpuGridId, GpuGrids};
use crate::cpu::ghosts;

/// Where heights stand.
#[derive(Debug, Clone, Copy)]
pub struct Stored<'a> {
    /// The buffer.
    pub buffer: &'a wgpu::Buffer,
    /// Offsets in it of the heights after the last tick and after the one before, bytes.
    pub offsets: [u64; 2],
    /// Size of either, bytes.
    pub bytes: u64,
}

impl GpuGrids {
    /// Bytes of a grid's heights of one moment.
    pub fn height_bytes(&self, id: GpuGridId) -> u64 {
        16 * u64::from(self.grids[id.0].stride())
    }

    /// Where an awake grid's heights stand once the ticks encoded so far have run; `None` while there are ticks that were
    /// queued and not encoded. [`Self::arrange`] reads copies of them.
    pub fn stored(&self, id: GpuGridId) -> Option<Stored<'_>> {
        let grid = &self.grids[id.0];
        let array = |k: u32| 16 * u64::from(grid.base + k * grid.stride());
        (self.encoded_ticks == self.queued_ticks).then(|| Stored {
            buffer: self.buffers.heights_and_ground()[0],
            offsets: [array(grid.parity), array(2)],
            bytes: self.height_bytes(id),
        })
    }

    /// Lays out heights of two moments, as copied when the window stood at `corner`, as cells of the window as it stands
    /// now, row-major, x fastest, without fade; what was not in that window is zero. Walls beside water have its height.
    /// False where the copies are of another size.
    pub fn arrange(&self, id: GpuGridId, corner: [i64; 2], copies: [&[f32]; 2], mut out: [&mut Vec<f32>; 2]) -> bool {
        let grid = &self.grids[id.0];
        let window = &grid.place.window;
        if copies.iter().any(|copy| copy.len() != grid.torus[0] * grid.torus[1]) {
            return false;
        }
        let [nx, nz] = window.cells.map(|n| n as usize);
        // Cells of the window that were in that one too.
        let both: [std::ops::Range<usize>; 2] = std::array::from_fn(|k| {
            let (n, ahead) = (i64::from(window.cells[k]), corner[k].saturating_sub(window.corner[k]));
            let first = ahead.clamp(0, n);
            first as usize..ahead.saturating_add(n).clamp(first, n) as usize
        });
        for (copy, out) in copies.into_iter().zip(&mut out) {
            out.clear();
            out.resize(nx * nz, 0.0);
            for j in both[1].clone() {
                let row = (window.corner[1] + j as i64).rem_euclid(grid.torus[1] as i64) as usize;
                let stored = &copy[row * grid.torus[0]..(row + 1) * grid.torus[0]];
                let from = (window.corner[0] + both[0].start as i64).rem_euclid(grid.torus[0] as i64) as usize;
                let cells = stored[from..].iter().chain(&stored[..from]);
                out[j * nx..(j + 1) * nx][both[0].clone()].iter_mut().zip(cells).for_each(|(out, z)| *out = *z);
            }
        }
        if let Some(cells) = grid.cells() {
            ghosts::fill_all(out.map(|out| &mut out[..]), cells);
        }
        true
    }
}

//! How many tiles the GPU stepped, as it comes back: it puts grids to sleep.

use std::collections::VecDeque;

use open_water_shaders::grid::{ACTIVE_WORD, COUNT_WORDS};
use open_water_shaders::pipeline::Readback;

use super::GpuGridId;
use super::grid::Grid;

/// Copies under way at most.
const SLOTS: usize = 4;
/// Lists of grids remembered at most: those of copies under way and of ones that were dropped meanwhile.
const REMEMBERED: usize = 64;

/// The counts that come back, and which grids they are of.
#[derive(Debug)]
pub(super) struct Activity {
    ring: Readback<u64>,
    /// Number of a copy, and at each place of its tick's parameters the grid and the number of its tick.
    asked: VecDeque<(u64, Vec<(GpuGridId, u64)>)>,
    next: u64,
}

impl Activity {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let bytes = u64::from(4 * COUNT_WORDS);
        Self { ring: Readback::new(device, "grid counts", bytes, SLOTS), asked: VecDeque::new(), next: 0 }
    }

    /// Notes whose counts the next copy has.
    pub(super) fn expect(&mut self, grids: &[(GpuGridId, u64)]) {
        self.next += 1;
        if self.asked.len() == REMEMBERED {
            self.asked.pop_front();
        }
        self.asked.push_back((self.next, grids.to_vec()));
    }

    /// Encodes the copy of a tick's counts; when too many are under way these do not come back.
    pub(super) fn encode(&mut self, encoder: &mut wgpu::CommandEncoder, counts: &wgpu::Buffer, offset: u64) {
        let _ = self.ring.encode(encoder, counts, offset, u64::from(4 * COUNT_WORDS), self.next);
    }

    /// Takes what has come back. A grid without active tiles is all zero; it sleeps unless something came later.
    pub(super) fn poll(&mut self, device: &wgpu::Device, grids: &mut [Grid]) {
        let Some(reading) = self.ring.poll(device) else { return };
        while self.asked.front().is_some_and(|(number, _)| *number < reading.stamp) {
            self.asked.pop_front();
        }
        let Some((_, of)) = self.asked.pop_front_if(|(number, _)| *number == reading.stamp) else { return };
        let counts: Vec<u32> = bytemuck::pod_collect_to_vec(reading.bytes);
        for ((GpuGridId(id), tick), active) in of.into_iter().zip(&counts[ACTIVE_WORD as usize..]) {
            let grid = &mut grids[id];
            grid.active = Some(*active);
            if *active == 0 && grid.disturbed <= tick {
                grid.awake = 0;
            }
        }
    }
}

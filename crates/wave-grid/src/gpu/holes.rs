//! Where finer grids are seen instead of one on the GPU.

use open_water_shaders::grid::MAX_HOLES;

use super::{GpuGridId, GpuGrids};
use crate::hole::Hole;

impl GpuGrids {
    /// As [`crate::WaveGrid::hole`].
    pub fn hole(&self, id: GpuGridId, gain: f32) -> Hole {
        Hole::new(&self.grids[id.0].place, gain)
    }

    /// As [`crate::WaveGrid::set_holes`], for [`Self::encode_draw`]; those beyond the first [`MAX_HOLES`] are left out.
    pub fn set_holes(&mut self, id: GpuGridId, holes: &[Hole]) {
        let own = &mut self.grids[id.0].holes;
        own.clear();
        own.extend(holes.iter().take(MAX_HOLES));
    }

    /// As [`crate::WaveGrid::set_nested`].
    pub fn set_nested(&mut self, id: GpuGridId, nested: bool) {
        self.grids[id.0].place.nested = nested;
    }
}

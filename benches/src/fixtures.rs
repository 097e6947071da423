//! Inputs that cases and criterion benches share.

use floating_body::{BodyError, Hull};
use glam::Vec3;
use ocean_spectrum::{CascadeDesc, OceanDesc, SeaState};
use wave_grid::{GridDesc, Scheme};

/// Wind of the sea, m/s.
pub const WIND: f32 = 10.0;
/// Its fetch, m.
pub const FETCH: f32 = 100e3;

/// A wind sea on three cascades of one FFT size.
pub fn ocean(size: u32) -> OceanDesc {
    let cascades = [485.0, 72.4, 10.8].map(|tile| CascadeDesc { size, tile }).to_vec();
    OceanDesc { sea: SeaState::wind(WIND, FETCH, 0.0), seed: 1, cascades, ..OceanDesc::default() }
}

/// The grid that follows the boat of the scene.
pub fn grid() -> GridDesc {
    GridDesc { cells: [512; 2], cell_size: 0.125, wave_speed: 6.2, ..GridDesc::default() }
}

/// The grid of the paper's set-up.
pub fn paper_grid() -> GridDesc {
    GridDesc { wave_speed: 5.2, scheme: Scheme::FivePoint, ..grid() }
}

/// Mass of a crate of flotsam, kg.
pub const CRATE_MASS: f32 = 400.0;

/// A crate of flotsam, 1 m^3.
///
/// # Errors
/// Never: its sizes are in bounds.
pub fn crate_hull() -> Result<Hull, BodyError> {
    Hull::cuboid(Vec3::new(1.25, 0.8, 1.0))
}

/// Random numbers of our own (xorshift64*, Vigna 2016), so that a row means the same everywhere.
pub struct Random(u64);

impl Random {
    /// A sequence that the seed decides.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next number, uniform in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11;
        low + (high - low) * bits as f64 / (1u64 << 53) as f64
    }
}

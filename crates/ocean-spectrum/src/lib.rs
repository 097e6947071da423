//! FFT ocean: sea state to spectrum to modes to surface, on the CPU and on wgpu.

pub mod dispersion;
mod error;
mod file;
#[cfg(feature = "gpu")]
pub mod gpu;
mod kernel;
mod modes;
mod ocean;
mod pack;
mod parameters;
mod patch;
mod query;
mod random;
pub mod reference;
mod sea;
mod shape;
mod spectrum;
mod synthesis;
mod table;
pub mod turns;

pub use error::{Notice, OceanError};
pub use modes::CascadeModes;
pub use ocean::{CascadeDesc, CascadeFields, Ocean, OceanDesc, Repro};
pub use patch::OceanPatch;
pub use query::OceanSample;
pub use sea::{Partition, SeaState, Spectrum, Spreading, TableRow};
pub use spectrum::{SLOPE_CUTOFF, WaveSpectrum};

/// Acceleration of gravity, m/s^2.
pub const GRAVITY: f64 = 9.81;

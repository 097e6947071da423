//! FFT ocean: sea state to spectrum to modes to surface, on the CPU and on wgpu.
//!
//! A sea is described in an oceanographer's words ([`SeaState`]), turned into modes (plane waves with fixed amplitudes,
//! [`CascadeModes`]) on a few periodic tiles ([`OceanDesc`]), and known at one time, with height, normal and motion at
//! any point ([`Ocean::sample`], [`Ocean::patch`]):
//!
//! ```
//! use glam::Vec2;
//! use ocean_spectrum::{Ocean, OceanDesc, OceanSample, SeaState};
//!
//! // 12 m/s of wind over 80 km of water, blowing towards +x.
//! let desc = OceanDesc { sea: SeaState::wind(12.0, 80e3, 0.0), seed: 7, ..Default::default() };
//! let mut ocean = Ocean::new(desc)?;
//! assert!((ocean.significant_height() - 2.3).abs() < 0.1);
//!
//! ocean.set_time(2.5); // seconds
//! let mut answers = [OceanSample::default(); 2];
//! ocean.sample(&[Vec2::new(10.0, -4.0), Vec2::new(12.0, -4.0)], &mut answers);
//! assert!(answers[0].height.abs() < 3.0 && answers[0].normal.y > 0.5);
//! # Ok::<(), ocean_spectrum::OceanError>(())
//! ```
//!
//! Conventions: y is up; metres, seconds, radians; waves travel towards their direction `(cos a, sin a)` in (x, z);
//! arrays are row-major with x fastest, texel `(i, j)` at `(i, j) tile/size`. A point of calm water at `x` is seen at
//! `x + D(x)`, with `D = -choppiness k/|k| a sin(theta)` for each wave `a cos(theta)`: crests get sharp.
//!
//! The seed, the tiles and the loop time decide the modes, with arithmetic that is the same on every machine; the sizes
//! of the FFTs only decide how many of them are held. Feature `gpu` adds synthesis on wgpu from the same modes; without
//! it the crate does not know wgpu.
//!
//! Which sea to choose is what the crate's README teaches, with pictures: by wind and fetch ([`SeaState::wind`]), by height
//! and period ([`SeaState::height_period`]), with swell ([`SeaState::with_swell`]), in shallow water ([`SeaState::tma`]), or
//! as a buoy measured it ([`SeaState::from_file`], [`SeaState::from_ndbc`]). [`OceanDesc::for_sea`] finds tiles that suit it,
//! and [`Ocean::change_to`] lets one sea become another.
//!
//! Arrays are made when something reads them ([`Ocean::prepare`] makes them on all threads before). A second time is looked
//! at through a clone, which shares the modes. A server that asks for few points needs no arrays: [`Queries::Largest`].
//!
//! Near land an [`AmplitudeMap`] scales the cascades from place to place ([`Ocean::depth_factors`] says by how much over
//! a depth), and [`EdgeFeed`] hands the incoming waves to an interactive grid.
//!
//! Not here: interactive waves, bodies, refraction (a wave's length follows from one depth everywhere), the shape of
//! breaking waves.

mod desc;
pub mod dispersion;
mod error;
mod feed;
mod files;
#[cfg(feature = "gpu")]
pub mod gpu;
mod modes;
mod ocean;
mod query;
pub mod reference;
mod sea;
mod snapshot;
mod synthesis;

pub use desc::{CascadeDesc, OceanDesc};
pub use error::{Notice, OceanError};
pub use feed::{EdgeDesc, EdgeFeed};
pub use modes::moment::Moment;
pub use modes::{Amplitudes, CascadeModes};
pub use ocean::{CascadeFields, Ocean};
pub use query::OceanSample;
pub use query::amplitude::{AmplitudeMap, CascadeFactors};
pub use query::largest::Queries;
pub use query::patch::OceanPatch;
pub use sea::SeaState;
pub use sea::partition::{Partition, Spectrum, Spreading, TableRow, Tail};
pub use sea::plane::DirectionalTable;
pub use sea::shoal::{BREAKING_HEIGHT, depth_share};
pub use sea::spectrum::{SLOPE_CUTOFF, WaveSpectrum};
pub use snapshot::OceanSnapshot;
pub use synthesis::lazy::Outputs;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// Acceleration of gravity, m/s^2.
pub const GRAVITY: f64 = 9.81;

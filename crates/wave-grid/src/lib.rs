//! Interactive water waves on a shifting window with absorbing borders, on the CPU and on wgpu.
//!
//! A [`WaveGrid`] carries waves on a window of cells that follows a target in whole cells. Bodies disturb it
//! with [`Source`]s; its border absorbs what leaves; its drawn height fades to zero at the edge, so grids and
//! ambient sea can be summed. A [`Scheme`] says which waves: of the wave equation, all of one speed, or of water, whose long ones
//! outrun the short. A [`Medium`] slows them over a bed, damps them and puts walls in their way. A grid knows nothing of bodies or
//! of the ambient sea.
//!
//! ```
//! use glam::{DVec2, Vec2};
//! use wave_grid::{GridDesc, GridSample, Source, WaveGrid};
//!
//! let mut grid = WaveGrid::new(GridDesc::default())?;
//! grid.center_on(DVec2::new(1000.0, 0.0));
//! grid.set_origin(DVec2::new(1000.0, 0.0));
//! // A stone of 10 litres.
//! grid.add(Source::Displacement { center: Vec2::ZERO, radius: 0.2, volume: 0.01 });
//! for _ in 0..60 {
//!     grid.tick();
//! }
//! let mut ring = [GridSample::default()];
//! grid.sample(&[Vec2::new(6.0, 0.0)], &mut ring);
//! assert!(ring[0].height > 1e-5 && grid.is_finite());
//! # Ok::<(), wave_grid::GridError>(())
//! ```

// Tests within share scenarios with those without.
#[cfg(test)]
extern crate self as wave_grid;

mod access;
mod border;
mod cells;
mod cpu;
mod desc;
mod dispersion;
pub mod dispersive;
mod drift;
mod error;
mod feed;
mod field;
mod fourier;
#[cfg(feature = "gpu")]
pub mod gpu;
mod grid;
mod ground;
mod hole;
mod hulls;
mod measure;
mod medium;
mod pattern;
mod plane;
mod resample;
mod settings;
mod snapshot;
mod source;
mod spectral;
mod start;
mod state;
mod tick;
mod train;
#[cfg(feature = "serde")]
mod values;
mod window;

pub use border::Border;
pub use cpu::tiles::{QUIET_FOAM, QUIET_HEIGHT};
pub use desc::{GridDesc, MAX_SUBSTEPS, Scheme, Stepping, TILE};
pub use error::GridError;
pub use feed::{Edges, FeedLine, Incident, Side};
pub use grid::{GridSample, WaveGrid};
pub use hole::Hole;
pub use hulls::HullOutline;
pub use medium::{CellKind, Medium, MediumCell};
pub use pattern::{PATTERN_LAYERS, Pattern, PatternKernel};
pub use snapshot::GridSnapshot;
pub use source::{HEIGHT_LIMIT, Rain, Source, WaveMaker};
pub use train::WaveTrain;
pub use window::Window;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! How a body and the water of a dispersive grid move each other, one texture a mode.
//!
//! `table` and `curve` say what is known of a mode, `fit` finds the kernels of `kernel`, `texture` puts them where the hull
//! is, `motion` follows how the body moves against the ambient water. Where no grid carries the waves, `memory` may.

mod curve;
mod fit;
mod kernel;
mod memory;
mod motion;
mod table;
mod texture;

pub(crate) use memory::{Memory, Past};
pub use motion::Imprint;
pub(crate) use motion::{Motion, Radiator};
pub use table::{RadiationTable, RadiationTables};
pub(crate) use texture::Afloat;
pub use texture::{TextureKernel, Textures};

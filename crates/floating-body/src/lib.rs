//! Rigid bodies floating on a water surface: hulls, forces, integration.
//!
//! The crate is usable alone: it asks for the water through [`WaterSurface`] and answers with poses, and with the
//! volume that each body displaced ([`Body::displacements`]). [`FlatWater`] and [`AiryWave`] stand in for an ocean.
//! [`Fleet`] moves many pieces of one description for a fraction of what bodies of their own cost.
//! Method: force points as in Yang et al. 2017, section 3, with hydrostatics and added mass of linear theory.
//! Units are m, s, kg, rad; y is up, a hull's x is forward. No planing lift; hulls do not touch each other.
//!
//! ```
//! use floating_body::{Body, BodyDesc, BodyState, Controls, FlatWater, Hull};
//! use glam::Vec3;
//!
//! # fn main() -> Result<(), floating_body::BodyError> {
//! let hull = Hull::cuboid(Vec3::splat(1.0))?; // a crate of 1 m^3
//! let mut body = Body::new(BodyDesc::from_hull(&hull, 512.5))?; // half as heavy as sea water
//! body.set_state(BodyState::at_rest(Vec3::new(0.0, 1.5, 0.0))); // dropped from above
//!
//! let water = FlatWater::default();
//! for _ in 0..60 * 60 {
//!     body.step(1.0 / 60.0, &water, &Controls::default());
//! }
//! assert!(body.state().position.y.abs() < 0.01); // floats half immersed
//! # Ok(())
//! # }
//! ```

mod arena;
mod body;
mod coefficients;
mod contact;
mod desc;
mod drag;
#[cfg(feature = "serde")]
pub mod endless;
mod engine;
mod error;
#[cfg(feature = "mesh-files")]
mod files;
mod fleet;
mod forces;
mod hull;
mod lewis;
mod mooring;
mod point;
mod radiation;
mod rotation;
mod skin;
mod slam;
mod source;
mod water;
mod wind;

pub use arena::Arena;
pub use body::{Body, BodySnapshot, BodyState, Explanation, Load, LoadKind, Wrench};
pub use coefficients::Coefficients;
pub use contact::Contact;
pub use desc::{BodyDesc, ForcePoints, Inertia, Quality, Radiation, Sampling};
pub use drag::Drag;
pub use engine::{Controls, Engine};
pub use error::BodyError;
pub use fleet::{Activity, Fleet, FleetDesc, PieceId, SoftContact};
pub use hull::{Clip, Clipper, Closure, DryHull, Hull, HullKind, Push, TriMesh, Waterline};
pub use mooring::MooringLine;
pub use point::{ForcePoint, PointShape};
pub use radiation::{Imprint, RadiationTable, RadiationTables, TextureKernel, Textures};
pub use skin::Skin;
pub use slam::Slamming;
pub use source::Displacement;
pub use water::{AiryWave, FlatWater, Home, SurfacePatch, SurfaceSample, Touch, WaterSurface};
pub use wind::Windage;

/// Gravity in m/s^2.
pub const GRAVITY: f32 = 9.81;

/// Density of sea water in kg/m^3, the default of a [`BodyDesc`].
pub const WATER_DENSITY: f32 = 1025.0;

//! Real-time open water for games.
//!
//! [`OpenWater`] owns the ambient sea, the interactive grids and the bodies, and runs them on one clock. The host
//! drives it: [`OpenWater::advance`] says which ticks are due, [`OpenWater::tick`] runs one, [`OpenWater::plan`] says
//! what a frame will run on the GPU, [`OpenWater::encode`] records it into the host's encoder. Heights at any place are
//! answered at once by [`OpenWater::sample`].
//!
//! ```
//! use glam::{Vec2, Vec3};
//! use open_water::{BodyDesc, BodyState, BodyStates, Hull, OpenWater, OpenWaterDesc};
//!
//! let mut water = OpenWater::headless(OpenWaterDesc::default())?;
//! let crate_hull = Hull::cuboid(Vec3::splat(1.0))?;
//! let id = water.add_body(BodyDesc::from_hull(&crate_hull, 400.0))?;
//! let mut bodies = BodyStates::default();
//! bodies.insert(id, BodyState::at_rest(Vec3::new(0.0, 2.0, 0.0)));
//!
//! for _frame in 0..120 {
//!     for tick in water.advance(1.0 / 60.0) {
//!         water.tick(tick, &mut bodies)?;
//!     }
//! }
//! // The crate has fallen into the sea and floats.
//! let crate_now = bodies.get(id).unwrap().position;
//! let mut sea = [open_water::WaterSample::default()];
//! water.sample(&[Vec2::new(crate_now.x, crate_now.z)], &mut sea);
//! assert!((crate_now.y - sea[0].height).abs() < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! It does not draw (see the crate `water-view`), collide bodies (a physics engine does), or make sounds.

#[macro_use]
mod note;

mod bodies;
mod body_access;
mod clock;
mod cpu;
mod desc;
mod dry;
mod error;
mod fleets;
mod follow;
#[cfg(feature = "gpu")]
mod gpu;
mod grid_access;
mod grids;
mod handover;
mod home;
mod land;
mod moorings;
mod nested;
mod plan;
mod planner;
#[cfg(feature = "rapier")]
pub mod rapier;
mod rebase;
#[cfg(feature = "serde")]
mod record;
mod rules;
mod sea;
mod shore;
mod snapshot;
mod store;
mod stores;
mod trace;
mod wakes;
mod water;

pub use bodies::Pose;
pub use clock::{Tick, Ticks};
pub use cpu::surface::WaterSample;
pub use desc::{Consumers, GridDesc, GridHome, OpenWaterDesc, Preset, View};
pub use error::OpenWaterError;
pub use follow::{Follow, Look};
#[cfg(feature = "gpu")]
pub use gpu::{DeviceLoss, Encoded, GpuTimes};
pub use grids::MAX_GRIDS;
pub use land::{Damping, DepthMap, DepthScale, Land, Obstacle, ObstacleKind, Shelter};
pub use moorings::Mooring;
pub use plan::{FramePlan, MAX_WORK, Reason, Skipped, SkippedWork, Work};
#[cfg(feature = "serde")]
pub use record::{Replay, ReplayError};
pub use rules::Rules;
#[cfg(feature = "serde")]
pub use snapshot::SnapshotError;
pub use snapshot::WaterSnapshot;
pub use store::{BodyId, BodyMotion, BodyStates, BodyStore, FleetId, GridId, MooringId, Wants};
pub use stores::{BodySlices, SliceStore, Stores};
pub use wakes::{Wake, WakesDesc};
pub use water::{OpenWater, Reports};

pub use floating_body::{
    Activity, Body, BodyDesc, BodyState, Closure, Coefficients, Contact, Controls, Drag, DryHull, Engine, Explanation,
    Fleet, FleetDesc, ForcePoints, Hull, HullKind, Inertia, Load, LoadKind, MooringLine, PieceId, Quality, Radiation,
    RadiationTable, RadiationTables, Sampling, Skin, Slamming, SoftContact, TriMesh, Windage, Wrench,
};
pub use ocean_spectrum::{
    CascadeDesc, DirectionalTable, Ocean, OceanDesc, Partition, SeaState, Spectrum, Spreading, TableRow, Tail,
};
pub use wave_grid::{Border, Edges, Rain, Scheme, WaveGrid};

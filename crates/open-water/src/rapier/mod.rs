//! Bodies in a [Rapier](rapier3d) world: Rapier moves and collides them, the water pushes them.
//!
//! [`RapierBodies`] knows which rigid body is which body of the water. Each physics step is preceded by a tick of the
//! water, which reads poses and velocities from the `RigidBodySet` and leaves a force and a torque on each rigid body.
//!
//! ```
//! use glam::Vec3;
//! use open_water::rapier::{GRAVITY, RapierBodies};
//! use open_water::{BodyDesc, BodyState, Hull, OpenWater, OpenWaterDesc};
//! use rapier3d::prelude::*;
//!
//! let mut water = OpenWater::headless(OpenWaterDesc::default())?;
//! let mut world = PhysicsWorld::new();
//! (world.gravity, world.integration_parameters.dt) = (GRAVITY, water.desc().tick);
//!
//! // A quay, known to Rapier only, and a crate, known to both.
//! world.insert_collider(ColliderBuilder::cuboid(1.0, 5.0, 20.0).translation(Vec3::new(4.0, 0.0, 0.0)), None);
//! let mut floating = RapierBodies::default();
//! let id = water.add_body(BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0))?, 400.0))?;
//! let start = BodyState::at_rest(Vec3::new(0.0, 1.0, 0.0));
//! let handle = floating.spawn(&water, id, start, &mut world.bodies, &mut world.colliders)?;
//!
//! for _frame in 0..120 {
//!     for tick in water.advance(1.0 / 60.0) {
//!         water.tick(tick, &mut floating.store(&mut world.bodies))?;
//!         world.step();
//!     }
//!     let _where_to_draw_it = floating.drawn_pose(&water, &world.bodies, id);
//! }
//! assert!(world.bodies[handle].translation().x < 2.51 && world.bodies[handle].translation().y > -1.5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - **Frame.** The rigid body's frame is the hull's: colliders, meshes and joints are placed in hull axes, and the
//!   centre of mass is where the description has it.
//! - **Mass** comes from the description ([`rigid_body`] sets it), so colliders must have density 0. What a game adds
//!   later, such as cargo, is plain mass to Rapier.
//! - **Added mass** is in the wrench: without contact the body moves as `(M + A)^-1` of all forces. Contacts and joints
//!   feel `M` only: wind presses a hull on to its fenders with `M / (M + A)` of its force, 0.84 for a launch abeam.
//!   Moorings ([`OpenWater::add_mooring`](crate::OpenWater::add_mooring)) feel all.
//! - **Forces of your own.** A tick sets the rigid body's user force and torque anew; it is how the water acts. Add yours
//!   between tick and step, as impulses, or through [`Controls`](crate::Controls), where they feel added mass.
//! - **Time.** One physics step of the same length per tick, with four or more solver iterations (Rapier's default), and
//!   [`GRAVITY`]. Fewer iterations damp swings, and stiff moorings then shake.
//! - **Sleep.** A body that is at rest in still water falls asleep and is not woken until the water's force on it changes;
//!   one that floats in waves or drifts stays awake.
//! - Kinematic and fixed rigid bodies push the water, but not back; disabled and removed ones take no part.
//!
//! Bodies without a rigid body, such as flotsam by the hundred, can live in another store: [`Stores`](crate::Stores).

mod error;
mod link;
mod make;
mod store;

pub use rapier3d;

pub use self::error::RapierError;
pub use self::make::{collider, rigid_body};
pub use self::store::{RapierBodies, RapierStore};

use glam::Vec3;

/// The gravity that the water reckons with, m/s^2. Give it to `PhysicsPipeline::step`.
pub const GRAVITY: Vec3 = Vec3::new(0.0, -floating_body::GRAVITY, 0.0);

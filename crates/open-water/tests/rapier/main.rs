//! Bodies in a Rapier world.
#![cfg(feature = "rapier")]

mod float;
mod live;
mod moored;
mod rest;
mod world;

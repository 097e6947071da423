//! What needs an adapter, and the validation of every shader (which needs none).
//!
//! One adapter for all tests, a fresh device for each; a module per pass. Without an adapter these tests fail with the
//! command that sets one up.

mod context;
mod fault;
mod grid_dispersive;
mod grid_draw;
mod grid_home;
mod grid_medium;
mod grid_query;
mod grid_step;
mod ocean_fields;
mod ocean_looks;
mod ocean_surface;
mod readback;
mod rules;
mod shaders;
mod surface;
mod times;
mod view_land;
mod view_picture;
mod view_stage;

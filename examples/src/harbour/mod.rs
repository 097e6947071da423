//! What the scene `harbour` is made of: its plan, the bed and its depth map, and the meshes of land and works.

mod arms;
mod bed;
mod chart;
mod courses;
mod green;
mod ground;
mod plan;
mod scatter;
mod works;
mod world;

pub use arms::breakwaters;
pub use bed::{elevation, picture};
pub use chart::{basin, depth_map, extent, land, marks};
pub use courses::{ferry, near, round};
pub use green::green;
pub use ground::{Extent, ground};
pub use plan::{
    BERTH, JETTY, JETTY_HALF_WIDTH, JETTY_TOP, MAP_CORNER, MAP_METRES_PER_LEVEL, MAP_SEA_LEVEL, MAP_SIZE, MAP_TEXEL,
    QUAY_HIGH, QUAY_LOW, QUAY_TOP, arm_outline, distance, walls,
};
pub use scatter::{afloat, lines, stack};
pub use works::{bollards, jetty, piles, quay};
pub use world::{FENDER_FACE, World, refused};

//! What disturbs a grid: displaced water, pressure, drops, foam.
//!
//! No border absorbs waves of one or two cells, so a source falls off with a C1 kernel over at least three cells (a flat
//! top sheds short waves as it moves), and its discrete sum is normalised: the volume written is the volume asked for,
//! wherever it stands between cells and walls.

pub(crate) mod footprint;
mod maker;
mod rain;
mod tiled;
mod write;

use glam::Vec2;

pub use maker::WaveMaker;
pub use open_water_shaders::grid::HEIGHT_LIMIT;
pub use rain::Rain;

/// Density of the water that [`Source::Pressure`] presses on, kg/m^3.
pub(crate) const DENSITY: f32 = 1000.0;
/// Gravity, m/s^2.
pub(crate) const GRAVITY: f32 = 9.81;

/// A disturbance of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Source {
    /// Water pushed up (positive) or let down (negative), written into this and the last state: no kick in velocity.
    Displacement {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Volume, cubic metres, signed.
        volume: f32,
    },
    /// The same over a rectangle, its edges smoothed over three cells.
    Box {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Half its length along its heading and half its width, metres; below 1.5 cells they count as 1.5 cells.
        half: Vec2,
        /// Direction of its length, radians from x towards z.
        heading: f32,
        /// Volume, cubic metres, signed.
        volume: f32,
    },
    /// Water pumped up (positive) or down along a line, smoothed over three cells to either side: what a
    /// [`WaveMaker`] does. What would fall on walls is left out, so a line from wall to wall does the same all along.
    Paddle {
        /// One end, local (x, z), metres.
        from: Vec2,
        /// The other end.
        to: Vec2,
        /// Volume per length of line, square metres, signed.
        flow: f32,
    },
    /// Pressure on the surface during one tick: `z_tt = c^2 lap(z + p / (rho g))`, written as one impulse. It moves water
    /// and makes none. Told in every tick, it comes to rest with the surface p / (rho g) lower (rho g = 9810 N/m^3).
    Pressure {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Pressure in the middle, Pa.
        pressure: f32,
    },
    /// What a drop leaves: a crater in a rim twice as wide that holds the crater's water. No net volume.
    Drop {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius of the crater, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Water moved from the middle to the rim, cubic metres; negative for a jet instead of a crater.
        volume: f32,
    },
    /// Foam stirred up, as behind a propeller.
    Turbulence {
        /// Local position (x, z), metres.
        center: Vec2,
        /// Radius, metres; below 1.5 cells it counts as 1.5 cells.
        radius: f32,
        /// Foam added in the middle, 0 to 1.
        foam: f32,
    },
}

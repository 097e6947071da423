//! What a host says of a frame, and the uniform block made of it.

use glam::Vec3;
use open_water_shaders::view::ViewFrame;

use crate::camera::{Rays, View};
use crate::desc::{Output, ViewDesc};
use crate::projector::Projector;
use crate::sky::{Light, RAYLEIGH};

/// Sun, air and exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    /// Towards the sun; need not be normalised.
    pub sun_direction: Vec3,
    /// Vertical optical depth of aerosol: 0.03 very clear, 0.1 hazy.
    pub aerosol: f32,
    /// Distance at which 2 % of a black thing's contrast is left (Koschmieder), metres.
    pub visibility: f32,
    /// Radiance factor; a clear horizon is about 1 before it.
    pub exposure: f32,
}

impl Default for Sky {
    /// A clear forenoon, the sun 32 degrees high towards -z and a little to +x.
    fn default() -> Self {
        Self { sun_direction: Vec3::new(0.35, 0.62, -0.95), aerosol: 0.04, visibility: 25_000.0, exposure: 0.5 }
    }
}

/// The water's own colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaterLook {
    /// Diffuse reflectance of deep water, per channel, 0 to 1.
    pub scatter: Vec3,
    /// Absorption of light in the water, per channel, 1/m.
    pub absorption: Vec3,
    /// Depth of an even bed below still water, metres; `None` when it does not show. A land has its own depth, and its
    /// bed is drawn by the host before the water, which lets it show through.
    pub depth: Option<f32>,
    /// Reflectance of the bed, per channel, 0 to 1. Over a land it tints what blue and green pass longer than red.
    pub bed: Vec3,
    /// Metres that one foam texture covers.
    pub foam_size: f32,
    /// How much foam beaches and walls of a land make; 1 as it looks right, 0 none.
    pub surf: f32,
}

impl Default for WaterLook {
    /// Open sea, clear blue-green.
    fn default() -> Self {
        Self {
            scatter: Vec3::new(0.0050, 0.0230, 0.0330),
            absorption: Vec3::new(0.35, 0.07, 0.045),
            depth: None,
            bed: Vec3::new(0.42, 0.38, 0.28),
            foam_size: 3.7,
            surf: 1.0,
        }
    }
}

/// What changes from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewParams {
    /// The camera.
    pub view: View,
    /// Light and air.
    pub sky: Sky,
    /// Colour of the water.
    pub water: WaterLook,
    /// Significant height of all waves together, metres: the grid must know how far they may reach.
    pub wave_height: f32,
    /// Level of still water, metres: what the composite surface has.
    pub level: f32,
}

impl ViewParams {
    /// A camera over two-metre waves under the default sky, still water at 0.
    pub fn new(view: View) -> Self {
        Self { view, sky: Sky::default(), water: WaterLook::default(), wave_height: 2.0, level: 0.0 }
    }
}

fn finite(value: f32, low: f32, high: f32) -> f32 {
    if value.is_finite() { value.clamp(low, high) } else { low }
}

fn color(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(|x| finite(x, 0.0, 100.0))
}

/// The uniform block of a frame, and whether any water is in view. `None` when the camera is not usable.
pub(crate) fn build(desc: &ViewDesc, output: Output, params: &ViewParams, light: &Light) -> Option<(ViewFrame, bool)> {
    let rays = Rays::of(&params.view)?;
    let wave_height = finite(params.wave_height, 0.0, 40.0);
    // The highest of some thousand waves, and room for a wake.
    let reach = 1.25 * wave_height + 0.6;
    let level = if params.level.is_finite() { params.level.clamp(-1e4, 1e4) } else { 0.0 };
    let grid = Projector::place(&rays.above(level), reach, desc.grid[0], desc.grid[1]);
    let mut frame = ViewFrame {
        clip_from_world: (params.view.clip_from_view * params.view.view_from_world).to_cols_array_2d(),
        camera: rays.eye.into(),
        reverse_z: f32::from(u8::from(desc.reverse_z)),
        ray_center: rays.center.into(),
        exposure: finite(params.sky.exposure, 0.0, 1e4),
        ray_right: rays.right.into(),
        haze: 3.912 / finite(params.sky.visibility, 100.0, 1e7),
        ray_up: rays.up.into(),
        mie: light.mie,
        sun: light.sun.into(),
        far: 1.0,
        sunlight: light.sunlight.into(),
        depth: params.water.depth.map_or(0.0, |d| finite(d, 0.01, 1e4)),
        airlight: light.airlight.into(),
        foam_size: finite(params.water.foam_size, 0.1, 1e3),
        skylight: light.skylight.into(),
        display_step: output.step,
        rayleigh: RAYLEIGH.into(),
        output_mode: output.mode,
        scatter: color(params.water.scatter),
        absorption: color(params.water.absorption),
        bed: color(params.water.bed),
        columns: desc.grid[0],
        wave_height,
        level,
        surf: finite(params.water.surf, 0.0, 4.0),
        ..ViewFrame::default()
    };
    if let Some(grid) = grid {
        frame.pole = grid.pole.into();
        frame.far = grid.far;
        frame.row_step = grid.row_step;
        frame.first_row = grid.first_row;
        frame.turn = grid.turn;
        frame.column_step = std::f32::consts::TAU / grid.turn as f32;
        frame.first_column = grid.first_column;
        frame.closed = u32::from(grid.closed);
    }
    Some((frame, grid.is_some()))
}

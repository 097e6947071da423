// What every pass of the view reads: camera, light, air, water, the projected grid. Same fields as ViewFrame in Rust.
struct ViewFrame {
    clip_from_world: mat4x4<f32>,
    camera: vec3<f32>,
    // 1 when depth 0 is far.
    reverse_z: f32,
    ray_center: vec3<f32>,
    // Radiance factor before the display curve.
    exposure: f32,
    ray_right: vec3<f32>,
    // Extinction of the air along the sea, 1/m.
    haze: f32,
    ray_up: vec3<f32>,
    // Optical depth of aerosol, vertical.
    mie: f32,
    // Towards the sun.
    sun: vec3<f32>,
    // Distance at which the sea has become the horizon, metres.
    far: f32,
    // Irradiance of the sun on a surface facing it.
    sunlight: vec3<f32>,
    // Depth of the bed, metres; 0: too deep to show.
    depth: f32,
    // Irradiance of the sun that the air scatters.
    airlight: vec3<f32>,
    // Metres that one foam texture covers.
    foam_size: f32,
    // Irradiance of the sky on level ground.
    skylight: vec3<f32>,
    // One step of the display format: what dither must cover; 0 for none.
    display_step: f32,
    // Optical depth of clear air, vertical.
    rayleigh: vec3<f32>,
    // 0 linear out, 1 curve out (the target encodes sRGB), 2 curve and sRGB out.
    output_mode: u32,
    // Diffuse reflectance of deep water.
    scatter: vec3<f32>,
    // Natural logarithm of the ratio between grid rows.
    row_step: f32,
    // Absorption of water, 1/m.
    absorption: vec3<f32>,
    // Angle between grid columns.
    column_step: f32,
    // Reflectance of the bed.
    bed: vec3<f32>,
    // Row 0 is exp(first_row * row_step) metres from the pole.
    first_row: i32,
    // Where the projector stands (x, z).
    pole: vec2<f32>,
    first_column: u32,
    // Columns in a full turn.
    turn: u32,
    columns: u32,
    // 1 when the innermost row is the pole itself.
    closed: u32,
    // Wave height that the water's colour is scaled by, metres.
    wave_height: f32,
    // Level of still water, metres.
    level: f32,
    // How much foam shores and walls make.
    surf: f32,
    pad0: f32,
    pad1: f32,
    pad2: f32,
}

@group(0) @binding(0) var<uniform> view: ViewFrame;
@group(0) @binding(1) var foam_texture: texture_2d<f32>;
@group(0) @binding(2) var foam_sampler: sampler;

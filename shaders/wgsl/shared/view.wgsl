// A hull whose inside shows no water: rows of the transform into its box, which is -1 to 1 on each axis, x forward.
struct Cutout {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

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
    cutout_count: u32,
    cutouts: array<Cutout, MAX_CUTOUTS>,
}

@group(0) @binding(0) var<uniform> view: ViewFrame;
@group(0) @binding(1) var foam_texture: texture_2d<f32>;
@group(0) @binding(2) var foam_sampler: sampler;

// Luminance-preserving filmic curve (Narkowicz 2015, a fit to ACES).
fn display_curve(x: vec3<f32>) -> vec3<f32> {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3<f32>(0.0), vec3<f32>(1.0));
}

fn srgb_from_linear(x: vec3<f32>) -> vec3<f32> {
    return select(1.055 * pow(x, vec3<f32>(1.0 / 2.4)) - 0.055, 12.92 * x, x < vec3<f32>(0.0031308));
}

fn linear_from_srgb(x: vec3<f32>) -> vec3<f32> {
    return select(pow((x + 0.055) / 1.055, vec3<f32>(2.4)), x / 12.92, x < vec3<f32>(0.04045));
}

// Interleaved gradient noise (Jimenez 2014): the same for a pixel in every frame, so a still picture stays still.
fn pixel_noise(pixel: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715))));
}

// Radiance to what the target stores: exposure, display curve, dither, encoding.
fn target_color(radiance: vec3<f32>, pixel: vec2<f32>) -> vec4<f32> {
    let light = min(max(radiance, vec3<f32>(0.0)), vec3<f32>(6.0e4)) * view.exposure;
    if view.output_mode == 0u {
        return vec4<f32>(light, 1.0);
    }
    let noise = (pixel_noise(pixel) - 0.5) * view.display_step;
    let encoded = clamp(srgb_from_linear(display_curve(light)) + noise, vec3<f32>(0.0), vec3<f32>(1.0));
    if view.output_mode == 1u {
        return vec4<f32>(linear_from_srgb(encoded), 1.0);
    }
    return vec4<f32>(encoded, 1.0);
}

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

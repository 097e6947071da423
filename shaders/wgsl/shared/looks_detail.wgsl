// How much of a cascade a pixel shades: once many of its tiles fit into the picture their repetition would show, so it
// fades and its slopes become roughness.
fn shading_weight(index: u32, footprint: f32) -> f32 {
    return 1.0 - smoothstep(0.02, SHADING_END, footprint / surface_table.cascades[index].tile);
}

// Ripples finer than the last cascade's texels, where a pixel would show them: the cascade itself, shrunk.
fn ripple_slope(rest: vec2<f32>, footprint: f32) -> vec2<f32> {
    let c = surface_table.cascade_count - 1u;
    let cascade = surface_table.cascades[c];
    let texel = cascade.tile / cascade.size;
    if surface_table.cascade_count == 0u || footprint >= texel {
        return vec2<f32>(0.0);
    }
    let turned = vec2<f32>(0.92 * rest.x - 0.39 * rest.y, 0.39 * rest.x + 0.92 * rest.y);
    let uv = turned * (5.3 / cascade.tile);
    let level = max(cascade_level(cascade, footprint * 5.3), 0.0);
    let d = textureSampleLevel(looks_derivative, looks_sampler, uv, c, level).xy;
    return vec2<f32>(0.92 * d.x + 0.39 * d.y, 0.92 * d.y - 0.39 * d.x) * (0.4 * (1.0 - footprint / texel));
}

// A small tile repeats every few metres, and its crests would join into endless straight lines. For shading alone its
// coordinates are bent by a slow static field (x, z, metres) and its slopes strengthened and weakened in patches, as
// gusts do (third component).
fn small_tile_gusts(rest: vec2<f32>, tile: f32) -> vec3<f32> {
    let p = rest * (10.8 / tile);
    let a = sin(vec4<f32>(dot(p, vec2<f32>(0.113, 0.071)), dot(p, vec2<f32>(-0.047, 0.131)) + 1.7,
        dot(p, vec2<f32>(0.029, -0.107)) + 4.1, dot(p, vec2<f32>(0.137, 0.043)) + 2.9));
    let gust = 1.0 + 0.25 * (a.x * a.z + a.y * a.w) + 0.15 * (a.x + a.z);
    return vec3<f32>(vec2<f32>(a.x + a.y, a.z + a.w) * (0.055 * tile), gust);
}

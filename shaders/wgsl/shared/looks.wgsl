struct SurfaceLook {
    normal: vec3<f32>,
    // Mean square slope of what the footprint hides.
    roughness: f32,
    foam: f32,
}

// Mip level whose texel is as wide as the footprint (metres).
fn looks_level(index: u32, footprint: f32) -> f32 {
    let c = surface_table.cascades[index];
    return log2(max(footprint * c.size / c.tile, 1e-6));
}

// How much of a cascade still shows: 1 near, 0 when the footprint is wider than half its tile.
fn looks_weight(index: u32, footprint: f32) -> f32 {
    let c = surface_table.cascades[index];
    return 1.0 - smoothstep(0.25, 0.5, footprint / c.tile);
}

// Keeps a slope below what water can stand at: folds of the horizontal displacement would sparkle.
fn soft_slope(slope: vec2<f32>) -> vec2<f32> {
    return slope * inverseSqrt(1.0 + dot(slope, slope) / 1.44);
}

// Where the vertex at a rest point stands (x, y, z), for looks.
fn surface_vertex(rest: vec2<f32>, footprint: f32) -> vec3<f32> {
    let factors = land_factors(rest);
    var d = vec3<f32>(0.0);
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let weight = looks_weight(c, footprint) * land_factor(factors, c);
        if weight <= 0.0 {
            continue;
        }
        let cascade = surface_table.cascades[c];
        let uv = (rest + cascade.offset) / cascade.tile + 0.5 / cascade.size;
        d += weight * textureSampleLevel(looks_displacement, looks_sampler, uv, c, max(looks_level(c, footprint), 0.0)).xyz;
    }
    let point = rest + d.xz;
    return vec3<f32>(point.x, d.y + grids_vertex(point, footprint) + surface_table.land.level, point.y);
}

// Normal, hidden roughness and foam at a rest point, for looks. The slopes of the land's factors are left out: they are
// much flatter than waves, and would show the raster.
fn surface_shading(rest: vec2<f32>, footprint: f32) -> SurfaceLook {
    let factors = land_factors(rest);
    var derivative = vec4<f32>(0.0);
    var displacement = vec4<f32>(0.0);
    var hidden = footprint;
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let cascade = surface_table.cascades[c];
        var weight = shading_weight(c, footprint);
        hidden = max(hidden, (1.0 - weight) * cascade.tile / 12.0);
        weight *= land_factor(factors, c);
        if weight <= 0.0 {
            continue;
        }
        var gusts = vec3<f32>(0.0, 0.0, 1.0);
        if cascade.tile < 40.0 {
            gusts = small_tile_gusts(rest + cascade.offset, cascade.tile);
        }
        let uv = (rest + cascade.offset + gusts.xy) / cascade.tile + 0.5 / cascade.size;
        let level = max(looks_level(c, footprint), 0.0);
        derivative += weight * gusts.z * textureSampleLevel(looks_derivative, looks_sampler, uv, c, level);
        displacement += weight * textureSampleLevel(looks_displacement, looks_sampler, uv, c, level);
    }
    let grids = grids_look(rest + displacement.xz, footprint);
    let ripples = ripple_slope(rest, footprint) * last_factor(factors);
    let slope = soft_slope(world_slope(Gradient(derivative, vec2<f32>(0.0))) + ripples + grids.yz);
    let normal = normalize(vec3<f32>(-slope.x, 1.0, -slope.y));
    return SurfaceLook(normal, hidden_left(hidden, factors), clamp(displacement.w + grids.w, 0.0, 1.0));
}

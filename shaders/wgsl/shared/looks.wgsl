struct SurfaceLook {
    normal: vec3<f32>,
    // Mean square slope of what the footprint hides.
    roughness: f32,
    foam: f32,
}

// Where the vertex at a rest point stands (x, y, z), for looks.
fn surface_vertex(rest: vec2<f32>, footprint: f32) -> vec3<f32> {
    let factors = land_factors(rest);
    var d = vec3<f32>(0.0);
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let cascade = surface_table.cascades[c];
        let weight = cascade_weight(cascade, footprint) * land_factor(factors, c);
        if weight <= 0.0 {
            continue;
        }
        let level = max(cascade_level(cascade, footprint), 0.0);
        d += weight * textureSampleLevel(looks_displacement, looks_sampler, cascade_uv(cascade, rest), c, level).xyz;
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
        let uv = cascade_uv(cascade, rest + gusts.xy);
        let level = max(cascade_level(cascade, footprint), 0.0);
        derivative += weight * gusts.z * textureSampleLevel(looks_derivative, looks_sampler, uv, c, level);
        displacement += weight * textureSampleLevel(looks_displacement, looks_sampler, uv, c, level);
    }
    let grids = grids_look(rest + displacement.xz, footprint);
    let ripples = ripple_slope(rest, footprint) * last_factor(factors);
    let slope = soft_slope(world_slope(Gradient(derivative, vec2<f32>(0.0))) + ripples + grids.yz);
    let normal = normalize(vec3<f32>(-slope.x, 1.0, -slope.y));
    return SurfaceLook(normal, hidden_left(hidden, factors), clamp(displacement.w + grids.w, 0.0, 1.0));
}

struct OpenWaterSurface {
    // From the rest point to where its water is, y up, metres.
    displacement: vec3<f32>,
    normal: vec3<f32>,
    // 0 to 1.
    foam: f32,
}

// The sea at a rest point (x, z), averaged over a footprint: the width in metres that a sample stands for, such as a
// pixel's or a mesh's cell. What is finer is left out. 0: as fine as the sea is.
fn open_water_surface_over(xz: vec2<f32>, footprint: f32) -> OpenWaterSurface {
    var displacement = vec4<f32>(0.0);
    var derivative = vec4<f32>(0.0);
    for (var c = 0u; c < open_water_sea.cascade_count; c++) {
        let cascade = open_water_sea.cascades[c].place;
        let weight = cascade_weight(cascade, footprint);
        if weight <= 0.0 {
            continue;
        }
        let uv = cascade_uv(cascade, xz);
        let level = max(cascade_level(cascade, footprint), 0.0);
        displacement += weight * textureSampleLevel(open_water_displacement, open_water_sampler, uv, c, level);
        derivative += weight * textureSampleLevel(open_water_derivative, open_water_sampler, uv, c, level);
    }
    let slope = soft_slope(world_slope(Gradient(derivative, vec2<f32>(0.0))));
    let normal = normalize(vec3<f32>(-slope.x, 1.0, -slope.y));
    return OpenWaterSurface(displacement.xyz, normal, clamp(displacement.w, 0.0, 1.0));
}

// The sea at a rest point (x, z): the water that is at xz when it is calm.
fn open_water_surface(xz: vec2<f32>) -> OpenWaterSurface {
    return open_water_surface_over(xz, 0.0);
}

// The sky, behind everything: one triangle at the far depth.
struct SkyVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) ray: vec3<f32>,
}

@vertex
fn sky_vertex(@builtin(vertex_index) index: u32) -> SkyVertex {
    let corner = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    let ray = view.ray_center + corner.x * view.ray_right + corner.y * view.ray_up;
    return SkyVertex(vec4<f32>(corner, 1.0 - view.reverse_z, 1.0), ray);
}

@fragment
fn sky_fragment(in: SkyVertex) -> @location(0) vec4<f32> {
    let direction = normalize(in.ray);
    let pixel_angle = length(dpdx(direction)) + 1e-5;
    var radiance = sky_radiance(direction);
    if direction.y > 0.0 {
        radiance += sun_disc(direction, pixel_angle);
    }
    return target_color(radiance, in.clip.xy);
}

// Lit triangle meshes under the same sun and sky.
struct MeshVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
}

@vertex
fn mesh_vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
    @location(3) row_x: vec4<f32>,
    @location(4) row_y: vec4<f32>,
    @location(5) row_z: vec4<f32>,
    @location(6) tint: vec4<f32>,
) -> MeshVertex {
    let p = vec4<f32>(position, 1.0);
    let world = vec3<f32>(dot(row_x, p), dot(row_y, p), dot(row_z, p));
    let n = vec3<f32>(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal));
    return MeshVertex(view.clip_from_world * vec4<f32>(world, 1.0), world, n, vec4<f32>(linear_from_srgb(color.rgb) * tint.rgb, color.a));
}

@fragment
fn mesh_fragment(in: MeshVertex) -> @location(0) vec4<f32> {
    let n = normalize(in.normal);
    let offset = view.camera - in.world;
    let distance = length(offset);
    let to_eye = offset / distance;
    let up = 0.5 + 0.5 * n.y;
    let bounce = view.scatter * (view.skylight + view.sunlight * max(view.sun.y, 0.0)) + 0.2 * view.skylight;
    let light = view.sunlight * max(dot(n, view.sun), 0.0) + mix(bounce, view.skylight, up);
    // Alpha is gloss: 0 dull, 1 wet paint.
    let gloss = in.color.a;
    let f = gloss * fresnel(dot(n, to_eye));
    let mirror = reflect(-to_eye, n);
    let h = normalize(view.sun + to_eye);
    let power = exp2(4.0 + 6.0 * gloss);
    let glint = view.sunlight * (gloss * 0.04 * (power + 2.0) / 25.0 * pow(max(dot(n, h), 0.0), power) * max(dot(n, view.sun), 0.0));
    let radiance = mix(in.color.rgb * light / 3.14159265, sky_radiance(mirror), f) + glint;
    return target_color(mix(sky_radiance(-offset), radiance, exp(-view.haze * distance)), in.clip.xy);
}

// Answers `open_water_surface_over` for a list of points (x, z, footprint, -): displacement and foam, normal and 0.
@group(1) @binding(0) var<storage, read> probe_points: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read_write> probe_answers: array<vec4<f32>>;

@compute @workgroup_size(64)
fn ocean_surface_probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&probe_points) {
        return;
    }
    let p = probe_points[id.x];
    var s = open_water_surface(p.xy);
    if p.z > 0.0 {
        s = open_water_surface_over(p.xy, p.z);
    }
    probe_answers[2u * id.x] = vec4<f32>(s.displacement, s.foam);
    probe_answers[2u * id.x + 1u] = vec4<f32>(s.normal, 0.0);
}

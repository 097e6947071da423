// Answers `surface_at` for a list of points; used to compare the GPU's answer with the CPU's.
@group(1) @binding(0) var<storage, read> probe_points: array<vec2<f32>>;
@group(1) @binding(1) var<storage, read_write> probe_answers: array<vec4<f32>>;

@compute @workgroup_size(64)
fn surface_probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&probe_points) {
        return;
    }
    let s = surface_at(probe_points[id.x]);
    probe_answers[id.x] = vec4<f32>(s.height, s.normal);
}

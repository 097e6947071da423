// Transforms along z: the fields, straight into the textures. One workgroup: LINES neighbouring columns of one layer.
@group(0) @binding(0) var<uniform> ocean: OceanParams;
@group(0) @binding(1) var<storage, read> half_done: array<vec4<f32>>;
// Displacement layers, then derivative layers.
@group(0) @binding(2) var fields: texture_storage_2d_array<rgba32float, write>;

fn line_index(line: u32, i: u32) -> u32 {
    return swizzle(i) * LINES + line;
}

fn fetch(place: Place, i: u32) -> vec4<f32> {
    return half_done[(place.layer * N + i) * PITCH + place.line];
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    textureStore(fields, vec2<u32>(place.line, i), place.layer, value);
}

@compute @workgroup_size(THREADS)
fn ocean_columns(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) id: u32) {
    // Neighbouring threads read neighbouring columns.
    let line = id % LINES;
    let t = id / LINES;
    let place = place_of(group.z, group.x * LINES + line);
    var v: Points;
    points_fetch(&v, place, t);
    transform(&v, line, t);
    points_emit(&v, place, t);
}

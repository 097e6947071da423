// The whole transforms along z: the fields. One workgroup: LINES neighbouring columns of one layer.
@group(0) @binding(0) var<uniform> ocean: OceanParams;
@group(0) @binding(1) var input: texture_2d_array<f32>;
@group(0) @binding(2) var output: texture_storage_2d_array<rgba32float, write>;

fn line_index(line: u32, i: u32) -> u32 {
    return swizzle(i) * LINES + line;
}

fn fetch(place: Place, i: u32) -> vec4<f32> {
    if !may_hold_modes(place, i) {
        return vec4<f32>(0.0);
    }
    return textureLoad(input, vec2<u32>(place.line, i), place.layer, 0);
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    textureStore(output, vec2<u32>(place.line, i), place.layer, value);
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
    points_emit(&v, place, t, THREADS_PER_LINE);
}

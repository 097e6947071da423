// One more stage of the transforms along x or z, for adapters on which workgroup memory is slow.
@group(0) @binding(0) var<uniform> ocean: OceanParams;
@group(0) @binding(1) var input: texture_2d_array<f32>;
@group(0) @binding(2) var output: texture_storage_2d_array<rgba32float, write>;

// Points of each line that are transformed among themselves already.
override DONE: u32;
override ALONG_X: bool;

fn texel(place: Place, i: u32) -> vec2<u32> {
    return select(vec2<u32>(place.line, i), vec2<u32>(i, place.line), ALONG_X);
}

fn fetch(place: Place, i: u32) -> vec4<f32> {
    return textureLoad(input, texel(place, i), place.layer, 0);
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    textureStore(output, texel(place, i), place.layer, value);
}

@compute @workgroup_size(THREADS)
fn ocean_stage(@builtin(global_invocation_id) id: vec3<u32>) {
    // Neighbouring threads read neighbouring texels.
    let t = select(id.x / N, id.x % THREADS_PER_LINE, ALONG_X);
    let place = place_of(id.z, select(id.x % N, id.x / THREADS_PER_LINE, ALONG_X));
    if t >= THREADS_PER_LINE || place.line >= N {
        return;
    }
    var v: Points;
    points_fetch(&v, place, t);
    if DONE * 16u <= N {
        stage16(&v, t, DONE);
        points_emit(&v, place, stage_target(t, DONE), DONE);
    } else {
        last_stage(&v, t * TURN);
        points_emit(&v, place, t, THREADS_PER_LINE);
    }
}

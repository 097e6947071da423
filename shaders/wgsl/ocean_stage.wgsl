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
    let value = textureLoad(input, texel(place, i), place.layer, 0);
    // Rows without modes were never written.
    return select(vec4<f32>(0.0), value, ALONG_X || DONE > 1u || may_hold_modes(place, i));
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    textureStore(output, texel(place, i), place.layer, value);
}

@compute @workgroup_size(THREADS)
fn ocean_stage(@builtin(global_invocation_id) id: vec3<u32>) {
    // Neighbouring threads read neighbouring texels.
    let t = select(id.x / N, id.x % THREADS_OF_STAGE, ALONG_X);
    var place = place_of(id.z, id.x % N);
    if ALONG_X {
        place = place_of_row(id.z, id.x / THREADS_OF_STAGE);
    }
    if t >= THREADS_OF_STAGE || place.line >= N {
        return;
    }
    var v: Points;
    points_fetch(&v, place, t);
    if WIDE {
        var odd: Points;
        points_fetch(&odd, place, t + THREADS_OF_STAGE);
        stage32(&v, &odd, t, DONE);
        let first = stage_target(t, DONE, 32u);
        points_emit(&v, place, first, DONE);
        points_emit(&odd, place, first + 16u * DONE, DONE);
    } else if DONE * 16u <= N {
        stage16(&v, t, DONE);
        points_emit(&v, place, stage_target(t, DONE, 16u), DONE);
    } else {
        last_stage(&v, t * TURN);
        points_emit(&v, place, t, THREADS_PER_LINE);
    }
}

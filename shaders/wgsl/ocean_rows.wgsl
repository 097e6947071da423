// The spectra and their whole transforms along x. One workgroup: LINES rows of one layer.
fn line_index(line: u32, i: u32) -> u32 {
    return line * N + swizzle(i);
}

fn fetch(place: Place, i: u32) -> vec4<f32> {
    if !may_hold_modes(place, i) || place.line >= N {
        return vec4<f32>(0.0);
    }
    let s = spectra(place, i);
    return select(s.derivative, s.displacement, place.pair == 0u);
}

@compute @workgroup_size(THREADS)
fn ocean_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) id: u32) {
    if place_of_row(group.z, group.x * LINES).line >= N {
        return;
    }
    let line = id / THREADS_PER_LINE;
    let t = id % THREADS_PER_LINE;
    let place = place_of_row(group.z, group.x * LINES + line);
    var v: Points;
    points_fetch(&v, place, t);
    transform(&v, line, t);
    if place.line < N {
        points_emit(&v, place, t, THREADS_PER_LINE);
    }
}

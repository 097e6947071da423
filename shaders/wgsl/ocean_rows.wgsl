// The spectra and their whole transforms along x. One workgroup: LINES rows of one layer.
fn line_index(line: u32, i: u32) -> u32 {
    return line * N + swizzle(i);
}

@compute @workgroup_size(THREADS)
fn ocean_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) id: u32) {
    let line = id / THREADS_PER_LINE;
    let t = id % THREADS_PER_LINE;
    let place = place_of(group.z, group.x * LINES + line);
    var v: Points;
    points_fetch(&v, place, t);
    transform(&v, line, t);
    points_emit(&v, place, t, THREADS_PER_LINE);
}

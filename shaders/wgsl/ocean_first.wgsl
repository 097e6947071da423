// The spectra and the first stage of their transforms along x, for adapters on which workgroup memory is slow.
@compute @workgroup_size(THREADS)
fn ocean_first(@builtin(global_invocation_id) id: vec3<u32>) {
    let t = id.x % THREADS_PER_LINE;
    let place = place_of(id.z, id.x / THREADS_PER_LINE);
    if place.line >= N {
        return;
    }
    var v: Points;
    points_fetch(&v, place, t);
    stage16(&v, t, 1u);
    points_emit(&v, place, stage_target(t, 1u), 1u);
}

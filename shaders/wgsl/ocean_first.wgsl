// The spectra and the first stage of their transforms along x, for adapters on which workgroup memory is slow. A thread
// works on both layers of a cascade: reading a mode and turning it costs more than a stage.
@compute @workgroup_size(THREADS)
fn ocean_first(@builtin(global_invocation_id) id: vec3<u32>) {
    let t = id.x % THREADS_OF_STAGE;
    let place = place_of_row(2u * id.z, id.x / THREADS_OF_STAGE);
    if place.line >= N {
        return;
    }
    var derivative = place;
    derivative.layer += ocean.cascade_count;
    var v: Points;
    var u: Points;
    points_fetch_both(&v, &u, place, t);
    if !WIDE {
        radix16(&v);
        radix16(&u);
        points_emit(&v, place, 16u * t, 1u);
        points_emit(&u, derivative, 16u * t, 1u);
        return;
    }
    var v_odd: Points;
    var u_odd: Points;
    points_fetch_both(&v_odd, &u_odd, place, t + THREADS_OF_STAGE);
    stage32(&v, &v_odd, t, 1u);
    stage32(&u, &u_odd, t, 1u);
    points_emit(&v, place, 32u * t, 1u);
    points_emit(&v_odd, place, 32u * t + 16u, 1u);
    points_emit(&u, derivative, 32u * t, 1u);
    points_emit(&u_odd, derivative, 32u * t + 16u, 1u);
}

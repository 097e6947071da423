// Stages of radix 32 in two halves of 16 points, for kernels to which a stage costs a pass over memory.
override WIDE: bool = false;
override THREADS_OF_STAGE: u32 = select(THREADS_PER_LINE, THREADS_PER_LINE / 2u, WIDE);

// v, w <- v + f w, v - f w
fn butterfly(v: ptr<function, Points>, w: ptr<function, Points>, e: u32, f: vec2<f32>) {
    let turned = times((*w)[e], f);
    (*w)[e] = (*v)[e] - turned;
    (*v)[e] += turned;
}

// Points t + e N/16 in `even`, t + N/32 + e N/16 in `odd`. Results belong at `stage_target(t, done, 32) + e done`: the
// first 16 in `even`, the others in `odd`.
fn stage32(even: ptr<function, Points>, odd: ptr<function, Points>, t: u32, done: u32) {
    let turns = (t % done) * (0x08000000u / done);
    if done > 1u {
        twiddle16(even, 2u * turns);
        twiddle16(odd, 2u * turns);
    }
    radix16(even);
    radix16(odd);
    // The odd points' own factor, and 1/32 of a turn from one to the next.
    points_butterfly(even, odd, turns);
}

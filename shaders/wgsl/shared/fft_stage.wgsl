// Stockham stages of inverse transforms of N points. Thread t of a line holds point t + e N/16 as `v[e]`.
override N: u32;
override THREADS_PER_LINE: u32 = N / 16u;
// Radix of the last stage, 1 if there is none: N = 16 LAST or 256 LAST.
override LAST: u32 = select(THREADS_PER_LINE, THREADS_PER_LINE / 16u, THREADS_PER_LINE > 16u);
// A turn over N.
override TURN: u32 = 0x80000000u / (N / 2u);

// Twiddles of a radix-16 stage: v[r] by r `turns`. Products of two exact ones keep the error at a few ulp.
fn twiddle16(v: ptr<function, Points>, turns: u32) {
    let w1 = turns_cos_sin(turns);
    let w4 = turns_cos_sin(4u * turns);
    let w2 = square(w1);
    let w3 = product(w2, w1);
    let w8 = square(w4);
    let w12 = product(w8, w4);
    (*v)[1] = times((*v)[1], w1);
    (*v)[2] = times((*v)[2], w2);
    (*v)[3] = times((*v)[3], w3);
    (*v)[4] = times((*v)[4], w4);
    (*v)[5] = times((*v)[5], product(w4, w1));
    (*v)[6] = times((*v)[6], product(w4, w2));
    (*v)[7] = times((*v)[7], product(w4, w3));
    (*v)[8] = times((*v)[8], w8);
    (*v)[9] = times((*v)[9], product(w8, w1));
    (*v)[10] = times((*v)[10], product(w8, w2));
    (*v)[11] = times((*v)[11], product(w8, w3));
    (*v)[12] = times((*v)[12], w12);
    (*v)[13] = times((*v)[13], product(w12, w1));
    (*v)[14] = times((*v)[14], product(w12, w2));
    (*v)[15] = times((*v)[15], product(w12, w3));
}

// Radix-16 stage after `done` points of each line are transformed among themselves. Its results belong at
// `stage_target(t, done, 16) + e done`.
fn stage16(v: ptr<function, Points>, t: u32, done: u32) {
    if done > 1u {
        twiddle16(v, (t % done) * (0x10000000u / done));
    }
    radix16(v);
}

fn stage_target(t: u32, done: u32, radix: u32) -> u32 {
    let within = t % done;
    return (t - within) * radix + within;
}

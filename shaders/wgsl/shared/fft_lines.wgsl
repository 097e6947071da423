// Stockham stages: point `v[e]` of thread t stands at index t + e THREADS_PER_LINE before and after `transform`.
// LINES lines share a workgroup; `line_index` (of the pass) says where they stand in its memory.
override N: u32;
override THREADS_PER_LINE: u32 = N / 16u;
override LINES: u32 = BLOCK / N;
// Radix of the last stage, 1 if there is none: N = 16 LAST or 256 LAST.
override LAST: u32 = select(THREADS_PER_LINE, THREADS_PER_LINE / 16u, THREADS_PER_LINE > 16u);

var<workgroup> line_points: array<vec4<f32>, BLOCK>;

// Spreads strides of 16 over the banks.
fn swizzle(i: u32) -> u32 {
    return i ^ ((i >> 4u) & 15u);
}

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

// Radix-16 stage after `done` points of each line are transformed among themselves, its results exchanged.
fn exchange(v: ptr<function, Points>, line: u32, t: u32, done: u32) {
    radix16(v);
    let within = t % done;
    points_store(v, line, (t - within) * 16u + within, done);
    workgroupBarrier();
    points_load(v, line, t);
}

fn transform(v: ptr<function, Points>, line: u32, t: u32) {
    if LAST == 1u {
        radix16(v);
        return;
    }
    exchange(v, line, t, 1u);
    if N > 256u {
        workgroupBarrier();
        twiddle16(v, (t % 16u) << 24u);
        exchange(v, line, t, 16u);
    }
    if LAST == 16u {
        twiddle16(v, t << 24u);
        radix16(v);
    } else {
        last_stage(v, t * TURN);
    }
}

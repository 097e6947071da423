// Whole transforms in workgroup memory: LINES lines share a workgroup; `line_index` (of the pass) says where they stand.
override LINES: u32 = BLOCK / N;

var<workgroup> line_points: array<vec4<f32>, BLOCK>;

// Spreads strides of 16 over the banks.
fn swizzle(i: u32) -> u32 {
    return i ^ ((i >> 4u) & 15u);
}

fn exchange(v: ptr<function, Points>, line: u32, t: u32, done: u32) {
    points_store(v, line, stage_target(t, done, 16u), done);
    workgroupBarrier();
    points_load(v, line, t);
}

// Points in and out at t + e THREADS_PER_LINE.
fn transform(v: ptr<function, Points>, line: u32, t: u32) {
    stage16(v, t, 1u);
    if LAST == 1u {
        return;
    }
    exchange(v, line, t, 1u);
    if N > 256u {
        stage16(v, t, 16u);
        workgroupBarrier();
        exchange(v, line, t, 16u);
    }
    if LAST == 16u {
        stage16(v, t, 16u);
    } else {
        last_stage(v, t * TURN);
    }
}

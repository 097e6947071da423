// Inverse Fourier transforms (e^{+i}, not scaled) of lines of N points in workgroup memory. A point is a vec4: two
// complex numbers (re, im, re, im) transformed alike; a thread holds 16 points of a line.
alias Points = array<vec4<f32>, 16>;

fn times_i(v: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(-v.y, v.x, -v.w, v.z);
}

fn times(v: vec4<f32>, w: vec2<f32>) -> vec4<f32> {
    return v * w.x + times_i(v) * w.y;
}

fn square(a: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(a.x * a.x - a.y * a.y, 2.0 * a.x * a.y);
}

fn product(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn radix2(v: ptr<function, Points>, a: u32, b: u32) {
    let difference = (*v)[a] - (*v)[b];
    (*v)[a] += (*v)[b];
    (*v)[b] = difference;
}

fn radix4(v: ptr<function, Points>, a: u32, b: u32, c: u32, d: u32) {
    let s0 = (*v)[a] + (*v)[c];
    let s1 = (*v)[a] - (*v)[c];
    let s2 = (*v)[b] + (*v)[d];
    let s3 = times_i((*v)[b] - (*v)[d]);
    (*v)[a] = s0 + s2;
    (*v)[b] = s1 + s3;
    (*v)[c] = s0 - s2;
    (*v)[d] = s1 - s3;
}

// Points a, a + 2, ... a + 14.
fn radix8(v: ptr<function, Points>, a: u32) {
    const H = 0.70710678118654752;
    radix4(v, a, a + 4u, a + 8u, a + 12u);
    radix4(v, a + 2u, a + 6u, a + 10u, a + 14u);
    (*v)[a + 6u] = H * ((*v)[a + 6u] + times_i((*v)[a + 6u]));
    (*v)[a + 10u] = times_i((*v)[a + 10u]);
    (*v)[a + 14u] = H * (times_i((*v)[a + 14u]) - (*v)[a + 14u]);
    radix2(v, a, a + 2u);
    radix2(v, a + 4u, a + 6u);
    radix2(v, a + 8u, a + 10u);
    radix2(v, a + 12u, a + 14u);
    // From place 2 k2 + 4 k1 to 2 k1 + 8 k2.
    let p2 = (*v)[a + 2u];
    let p4 = (*v)[a + 4u];
    let p6 = (*v)[a + 6u];
    (*v)[a + 2u] = p4;
    (*v)[a + 4u] = (*v)[a + 8u];
    (*v)[a + 6u] = (*v)[a + 12u];
    (*v)[a + 8u] = p2;
    (*v)[a + 12u] = (*v)[a + 10u];
    (*v)[a + 10u] = p6;
}

fn swap(v: ptr<function, Points>, a: u32, b: u32) {
    let old = (*v)[a];
    (*v)[a] = (*v)[b];
    (*v)[b] = old;
}

fn radix16(v: ptr<function, Points>) {
    const C = 0.92387953251128674;
    const S = 0.38268343236508977;
    const H = 0.70710678118654752;
    radix4(v, 0u, 4u, 8u, 12u);
    radix4(v, 1u, 5u, 9u, 13u);
    radix4(v, 2u, 6u, 10u, 14u);
    radix4(v, 3u, 7u, 11u, 15u);
    (*v)[5] = times((*v)[5], vec2<f32>(C, S));
    (*v)[6] = times((*v)[6], vec2<f32>(H, H));
    (*v)[7] = times((*v)[7], vec2<f32>(S, C));
    (*v)[9] = times((*v)[9], vec2<f32>(H, H));
    (*v)[10] = times_i((*v)[10]);
    (*v)[11] = times((*v)[11], vec2<f32>(-H, H));
    (*v)[13] = times((*v)[13], vec2<f32>(S, C));
    (*v)[14] = times((*v)[14], vec2<f32>(-H, H));
    (*v)[15] = times((*v)[15], vec2<f32>(-C, -S));
    radix4(v, 0u, 1u, 2u, 3u);
    radix4(v, 4u, 5u, 6u, 7u);
    radix4(v, 8u, 9u, 10u, 11u);
    radix4(v, 12u, 13u, 14u, 15u);
    swap(v, 1u, 4u);
    swap(v, 2u, 8u);
    swap(v, 3u, 12u);
    swap(v, 6u, 9u);
    swap(v, 7u, 13u);
    swap(v, 11u, 14u);
}

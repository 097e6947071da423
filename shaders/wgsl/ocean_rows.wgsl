// The spectra at one time from the modes, and their transforms along x. One workgroup: LINES rows of one layer.
@group(0) @binding(0) var<uniform> ocean: OceanParams;
// (h0(k), conj(h0(-k))) of each cell, cascade after cascade, FFT order.
@group(0) @binding(1) var<storage, read> amplitudes: array<vec4<f32>>;
// Turns of each cell per loop.
@group(0) @binding(2) var<storage, read> turns_per_loop: array<u32>;
@group(0) @binding(3) var<storage, read_write> half_done: array<vec4<f32>>;

fn line_index(line: u32, i: u32) -> u32 {
    return line * N + swizzle(i);
}

fn signed_index(i: u32) -> f32 {
    return f32(select(i32(i) - i32(N), i32(i), i < N / 2u));
}

// Two packed spectra of the layer at column i. A pair of real fields f, g travels as the one complex f + i g, so that
// its transform is (f, g).
fn fetch(place: Place, i: u32) -> vec4<f32> {
    let cell = (place.cascade * N + place.line) * N + i;
    let a = amplitudes[cell];
    let w = turns_cos_sin(turns_per_loop[cell] * ocean.phase);
    // h = h0(k) e^{-i omega t} + conj(h0(-k)) e^{i omega t}
    let h = vec2<f32>((a.x + a.z) * w.x + (a.y - a.w) * w.y, (a.y + a.w) * w.x + (a.z - a.x) * w.y);
    let ih = vec2<f32>(-h.y, h.x);
    let k = ocean.cascades[place.cascade].wave_step * vec2<f32>(signed_index(i), signed_index(place.line));
    // Horizontal displacement: i lambda k/|k| h. The mean has no wave.
    let to_displacement = ocean.choppiness * k * inverseSqrt(max(dot(k, k), 1e-20));
    if place.pair == 0u {
        // Dx + i h, Dz + i dDx/dz
        return vec4<f32>(ih * (1.0 + to_displacement.x), ih * (to_displacement.y * (1.0 - k.x)));
    }
    // dh/dx + i dh/dz, dDx/dx + i dDz/dz
    let d = -to_displacement * k;
    return vec4<f32>(product(ih, k), product(h, d));
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    half_done[(place.layer * N + place.line) * PITCH + i] = value;
}

@compute @workgroup_size(THREADS)
fn ocean_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) id: u32) {
    let line = id / THREADS_PER_LINE;
    let t = id % THREADS_PER_LINE;
    let place = place_of(group.z, group.x * LINES + line);
    var v: Points;
    points_fetch(&v, place, t);
    transform(&v, line, t);
    points_emit(&v, place, t);
}

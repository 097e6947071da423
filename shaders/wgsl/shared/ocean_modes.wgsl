// The spectra at one time from the modes, as rows to be transformed along x.
@group(0) @binding(0) var<uniform> ocean: OceanParams;
// (h0(k), conj(h0(-k))) of each cell, a layer per cascade, FFT order; then those of the
// second mode set.
@group(0) @binding(1) var amplitudes: texture_2d_array<f32>;
// Turns of each cell per loop.
@group(0) @binding(2) var turns_per_loop: texture_2d_array<u32>;
@group(0) @binding(3) var output: texture_storage_2d_array<rgba32float, write>;

// Whether there are two mode sets, to be mixed.
override MIXED: bool;

fn signed_index(i: u32) -> f32 {
    return f32(select(i32(i) - i32(N), i32(i), i < N / 2u));
}

// h = h0(k) e^{-i omega t} + conj(h0(-k)) e^{i omega t} of a mode set.
fn mode_at(cell: vec2<u32>, layer: u32, phase: u32) -> vec2<f32> {
    let a = textureLoad(amplitudes, cell, layer, 0);
    let w = turns_cos_sin(textureLoad(turns_per_loop, cell, layer, 0).x * phase);
    return vec2<f32>((a.x + a.z) * w.x + (a.y - a.w) * w.y, (a.y + a.w) * w.x + (a.z - a.x) * w.y);
}

// Packed spectra of both layers of a cascade at column i. A pair of real fields f, g travels as the one complex f + i g,
// so that its transform is (f, g).
struct Spectra {
    displacement: vec4<f32>,
    derivative: vec4<f32>,
}

fn spectra(place: Place, i: u32) -> Spectra {
    let cell = vec2<u32>(i, place.line);
    var h = mode_at(cell, place.cascade, ocean.phase.x);
    if MIXED {
        h = ocean.weight.x * h + ocean.weight.y * mode_at(cell, place.cascade + ocean.cascade_count, ocean.phase.y);
    }
    let ih = vec2<f32>(-h.y, h.x);
    let k = place.wave_step * vec2<f32>(signed_index(i), signed_index(place.line));
    // Horizontal displacement: i lambda k/|k| h. The mean has no wave.
    let to_displacement = ocean.choppiness * k * inverseSqrt(max(dot(k, k), 1e-20));
    let d = -to_displacement * k;
    return Spectra(
        // Dx + i h, Dz + i dDx/dz
        vec4<f32>(ih * (1.0 + to_displacement.x), ih * (to_displacement.y * (1.0 - k.x))),
        // dh/dx + i dh/dz, dDx/dx + i dDz/dz
        vec4<f32>(product(ih, k), product(h, d)),
    );
}

fn emit(place: Place, i: u32, value: vec4<f32>) {
    textureStore(output, vec2<u32>(i, place.line), place.layer, value);
}

// The next two mip levels after one of SIDE texels, down to 2 x 2: a coarser one is never looked at. One thread: 4 x 4
// texels of one layer.
override SIDE: u32;

@group(0) @binding(0) var finer: texture_2d_array<f32>;
@group(0) @binding(1) var level1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(2) var level2: texture_storage_2d_array<rgba16float, write>;

fn texel(p: vec2<u32>, layer: u32) -> vec4<f32> {
    return textureLoad(finer, p, layer, 0);
}

// Writes a texel of the next level and returns it.
fn mip1(layer: u32, p1: vec2<u32>) -> vec4<f32> {
    let p = 2u * p1;
    let mean = mean4(texel(p, layer), texel(p + vec2<u32>(1u, 0u), layer),
        texel(p + vec2<u32>(0u, 1u), layer), texel(p + vec2<u32>(1u, 1u), layer));
    textureStore(level1, p1, layer, mean);
    return mean;
}

@compute @workgroup_size(8, 8)
fn ocean_mips(@builtin(global_invocation_id) id: vec3<u32>) {
    let layer = (id.z >> 1u) + (id.z & 1u) * (textureNumLayers(finer) / 2u);
    if any(id.xy >= vec2<u32>(SIDE / 4u)) {
        return;
    }
    let p1 = 2u * id.xy;
    let mean = mean4(mip1(layer, p1), mip1(layer, p1 + vec2<u32>(1u, 0u)),
        mip1(layer, p1 + vec2<u32>(0u, 1u)), mip1(layer, p1 + vec2<u32>(1u, 1u)));
    if SIDE >= 8u {
        textureStore(level2, id.xy, layer, mean);
    }
}

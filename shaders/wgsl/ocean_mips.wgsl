// The next four mip levels after one of SIDE texels, down to 2 x 2: a coarser one is never looked at. One workgroup:
// 16 x 16 texels of one layer.
override SIDE: u32;

@group(0) @binding(0) var finer: texture_2d_array<f32>;
@group(0) @binding(1) var level1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(2) var level2: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(3) var level3: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(4) var level4: texture_storage_2d_array<rgba16float, write>;

fn texel(p: vec2<u32>, layer: u32) -> vec4<f32> {
    return textureLoad(finer, min(p, vec2<u32>(SIDE - 1u)), layer, 0);
}

// Whether level `l` has 2 x 2 texels or more, and holds texel p.
fn holds(p: vec2<u32>, l: u32) -> bool {
    let side = SIDE >> l;
    return side >= 2u && all(p < vec2<u32>(side));
}

@compute @workgroup_size(8, 8)
fn ocean_mips(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) id: u32,
) {
    let layer = group.z;
    let p1 = 8u * group.xy + local.xy;
    let p = 2u * p1;
    let mean1 = 0.25 * ((texel(p, layer) + texel(p + vec2<u32>(1u, 0u), layer))
        + (texel(p + vec2<u32>(0u, 1u), layer) + texel(p + vec2<u32>(1u), layer)));
    if holds(p1, 1u) {
        textureStore(level1, p1, layer, mean1);
    }
    block[id] = mean1;
    let mean2 = coarser(id, 4u);
    let p2 = 4u * group.xy + vec2<u32>(id % 4u, id / 4u);
    if id < 16u && holds(p2, 2u) {
        textureStore(level2, p2, layer, mean2);
    }
    let mean3 = coarser(id, 2u);
    let p3 = 2u * group.xy + vec2<u32>(id % 2u, id / 2u);
    if id < 4u && holds(p3, 3u) {
        textureStore(level3, p3, layer, mean3);
    }
    let mean4 = coarser(id, 1u);
    if id < 1u && holds(group.xy, 4u) {
        textureStore(level4, group.xy, layer, mean4);
    }
}

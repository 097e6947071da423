// Half-float copies of the fields with foam in the spare channel, mip levels 0 to 3. One workgroup: 16 x 16 texels of
// one layer.
override N: u32;

@group(0) @binding(0) var<uniform> ocean: OceanParams;
@group(0) @binding(1) var fields: texture_2d_array<f32>;
@group(0) @binding(2) var<storage, read_write> foam: array<f32>;
@group(0) @binding(3) var level0: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(4) var level1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(5) var level2: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(6) var level3: texture_storage_2d_array<rgba16float, write>;

// Foam on the water now: the chance that the sum of all cascades folds below the threshold, given this one's
// derivatives (a logistic for the normal distribution), less what the other cascades' foam accounts for.
fn breaking(cascade: u32, cross: f32, d: vec4<f32>) -> f32 {
    let c = ocean.cascades[cascade];
    let jacobian = (1.0 + d.z) * (1.0 + d.w) - cross * cross;
    let x = clamp(1.702 * (jacobian - ocean.foam_threshold) / c.foam_spread, -30.0, 30.0);
    return clamp(1.0 / (1.0 + exp(x)) - c.foam_share, 0.0, 1.0);
}

fn look(layer: u32, p: vec2<u32>) -> vec4<f32> {
    let v = textureLoad(fields, p, layer, 0);
    if layer >= ocean.cascade_count {
        return v;
    }
    let at = (layer * N + p.y) * N + p.x;
    let fresh = breaking(layer, v.w, textureLoad(fields, p, layer + ocean.cascade_count, 0));
    let now = max(fresh, foam[at] * ocean.foam_decay);
    foam[at] = now;
    return vec4<f32>(v.xyz, now);
}

@compute @workgroup_size(8, 8)
fn ocean_looks(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) id: u32,
) {
    let layer = group.z;
    let p = 2u * (8u * group.xy + local.xy);
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        let q = p + vec2<u32>(i & 1u, i >> 1u);
        let v = look(layer, q);
        textureStore(level0, q, layer, v);
        sum += v;
    }
    let mean = 0.25 * sum;
    textureStore(level1, p / 2u, layer, mean);
    block[id] = mean;
    let mean2 = coarser(id, 4u);
    if id < 16u {
        textureStore(level2, 4u * group.xy + vec2<u32>(id % 4u, id / 4u), layer, mean2);
    }
    let mean3 = coarser(id, 2u);
    if id < 4u {
        textureStore(level3, 2u * group.xy + vec2<u32>(id % 2u, id / 2u), layer, mean3);
    }
}

// Half-float copies of the fields with foam in the spare channel, mip levels 0 to 2. One thread: 4 x 4 texels of one
// layer, so that no memory is shared.
override N: u32;

@group(0) @binding(0) var<uniform> ocean: OceanParams;
@group(0) @binding(1) var fields: texture_2d_array<f32>;
@group(0) @binding(2) var<storage, read_write> foam: array<f32>;
@group(0) @binding(3) var level0: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(4) var level1: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(5) var level2: texture_storage_2d_array<rgba16float, write>;

// Foam on the water now: the chance that the sum of all cascades folds below the threshold, given this one's
// derivatives (a logistic for the normal distribution), less what the other cascades' foam accounts for.
fn breaking(cascade: u32, cross: f32, d: vec4<f32>) -> f32 {
    let c = ocean.cascades[cascade];
    let jacobian = (1.0 + d.z) * (1.0 + d.w) - cross * cross;
    let x = clamp(1.702 * (jacobian - ocean.foam_threshold) / c.foam_spread, -30.0, 30.0);
    return clamp(1.0 / (1.0 + exp(x)) - c.foam_share, 0.0, 1.0);
}

// What is there now of fresh and old foam; it replaces the old.
fn foam_after(layer: u32, p: vec2<u32>, cross: f32) -> f32 {
    let at = (layer * N + p.y) * N + p.x;
    let fresh = breaking(layer, cross, textureLoad(fields, p, layer + ocean.cascade_count, 0));
    let now = max(fresh, foam[at] * ocean.foam_decay);
    foam[at] = now;
    return now;
}

// Writes a texel of level 0 and returns it.
fn look(layer: u32, p: vec2<u32>) -> vec4<f32> {
    var v = textureLoad(fields, p, layer, 0);
    if layer < ocean.cascade_count {
        v.w = foam_after(layer, p, v.w);
    }
    textureStore(level0, p, layer, v);
    return v;
}

// Writes a texel of level 1 and the four below it, and returns it.
fn look1(layer: u32, p1: vec2<u32>) -> vec4<f32> {
    let p = 2u * p1;
    let mean = mean4(look(layer, p), look(layer, p + vec2<u32>(1u, 0u)),
        look(layer, p + vec2<u32>(0u, 1u)), look(layer, p + vec2<u32>(1u, 1u)));
    textureStore(level1, p1, layer, mean);
    return mean;
}

@compute @workgroup_size(8, 8)
fn ocean_looks(@builtin(global_invocation_id) id: vec3<u32>) {
    let layer = (id.z >> 1u) + (id.z & 1u) * ocean.cascade_count;
    if any(id.xy >= vec2<u32>(N / 4u)) {
        return;
    }
    let p1 = 2u * id.xy;
    let mean = mean4(look1(layer, p1), look1(layer, p1 + vec2<u32>(1u, 0u)),
        look1(layer, p1 + vec2<u32>(0u, 1u)), look1(layer, p1 + vec2<u32>(1u, 1u)));
    textureStore(level2, id.xy, layer, mean);
}

// The displacement (Dx, h, Dz, dDx/dz) of the ambient sea and its slopes along x and z.
struct Reading {
    value: vec4<f32>,
    along_x: vec4<f32>,
    along_z: vec4<f32>,
}

// Where a rest point lies in the arrays of a cascade, in texels.
fn texel_place(index: u32, rest: vec2<f32>) -> vec2<f32> {
    let c = surface_table.cascades[index];
    return (rest + c.offset) * (c.size / c.tile);
}

fn texel_at(array: texture_2d_array<f32>, index: u32, at: vec2<i32>) -> vec4<f32> {
    let mask = vec2<i32>(i32(surface_table.cascades[index].size) - 1);
    return textureLoad(array, at & mask, index, 0);
}

// A cascade of an array at a rest point, by the cubic kernel.
fn read_cascade(array: texture_2d_array<f32>, index: u32, rest: vec2<f32>) -> vec4<f32> {
    let x = texel_place(index, rest);
    let base = floor(x);
    let wx = cubic_weights(x.x - base.x);
    let wz = cubic_weights(x.y - base.y);
    var sum = vec4<f32>(0.0);
    for (var j = 0; j < 4; j++) {
        for (var i = 0; i < 4; i++) {
            sum += wx[i] * wz[j] * texel_at(array, index, vec2<i32>(base) + vec2<i32>(i - 1, j - 1));
        }
    }
    return sum;
}

// The displacement of the first `count` cascades, nearly: bilinear.
fn rough_displacement(rest: vec2<f32>, count: u32) -> vec4<f32> {
    let factors = land_factors(rest);
    var sum = vec4<f32>(0.0);
    for (var c = 0u; c < count; c++) {
        let x = texel_place(c, rest);
        let base = floor(x);
        let t = x - base;
        let i = vec2<i32>(base);
        let d = surface_displacement;
        let near = mix(texel_at(d, c, i), texel_at(d, c, i + vec2<i32>(1, 0)), t.x);
        let far = mix(texel_at(d, c, i + vec2<i32>(0, 1)), texel_at(d, c, i + vec2<i32>(1, 1)), t.x);
        sum += land_factor(factors, c) * mix(near, far, t.y);
    }
    return sum;
}

// The displacement at a rest point, its slopes those of the kernel and of the land's factors.
fn reading_at(rest: vec2<f32>) -> Reading {
    let factors = land_factors(rest);
    var slopes: LandSlopes;
    if has_land() {
        slopes = land_slopes(rest);
    }
    var r = Reading(vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0));
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let x = texel_place(c, rest);
        let base = floor(x);
        let t = x - base;
        let scale = surface_table.cascades[c].size / surface_table.cascades[c].tile;
        let wx = cubic_weights(t.x);
        let wz = cubic_weights(t.y);
        let sx = scale * cubic_slopes(t.x);
        let sz = scale * cubic_slopes(t.y);
        var sum = Reading(vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0));
        for (var j = 0; j < 4; j++) {
            var line = vec4<f32>(0.0);
            var along = vec4<f32>(0.0);
            for (var i = 0; i < 4; i++) {
                let texel = texel_at(surface_displacement, c, vec2<i32>(base) + vec2<i32>(i - 1, j - 1));
                line += wx[i] * texel;
                along += sx[i] * texel;
            }
            sum.value += wz[j] * line;
            sum.along_x += wz[j] * along;
            sum.along_z += sz[j] * line;
        }
        let f = land_factor(factors, c);
        r.value += f * sum.value;
        r.along_x += f * sum.along_x + land_factor(slopes.x, c) * sum.value;
        r.along_z += f * sum.along_z + land_factor(slopes.z, c) * sum.value;
    }
    return r;
}

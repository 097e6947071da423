struct SurfacePoint {
    height: f32,
    normal: vec3<f32>,
    rest: vec2<f32>,
}

// The surface's gradient by rest coordinates.
struct Gradient {
    // (dh/dx, dh/dz, dDx/dx, dDz/dz)
    d: vec4<f32>,
    // (dDx/dz, dDz/dx): equal but for what the land's factors add.
    cross: vec2<f32>,
}

// A cascade of an array at a rest point, by the cubic kernel.
fn read_cascade(array: texture_2d_array<f32>, index: u32, rest: vec2<f32>) -> vec4<f32> {
    let c = surface_table.cascades[index];
    let x = (rest + c.offset) * (c.size / c.tile);
    let base = floor(x);
    let mask = vec2<i32>(i32(c.size) - 1);
    let wx = cubic_weights(x.x - base.x);
    let wz = cubic_weights(x.y - base.y);
    var sum = vec4<f32>(0.0);
    for (var j = 0; j < 4; j++) {
        for (var i = 0; i < 4; i++) {
            let texel = (vec2<i32>(base) + vec2<i32>(i - 1, j - 1)) & mask;
            sum += wx[i] * wz[j] * textureLoad(array, texel, index, 0);
        }
    }
    return sum;
}

// (Dx, h, Dz, dDx/dz) of the ambient sea at a rest point; the last without what the factors' slopes add.
fn displacement_at(rest: vec2<f32>) -> vec4<f32> {
    let factors = land_factors(rest);
    var sum = vec4<f32>(0.0);
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        sum += land_factor(factors, c) * read_cascade(surface_displacement, c, rest);
    }
    return sum;
}

// The gradient of the ambient sea at a rest point, where displacement_at gave `cross` for dDx/dz, as if the factors were
// the same everywhere: near enough to find a rest point with.
fn level_gradient_at(rest: vec2<f32>, cross: f32) -> Gradient {
    let factors = land_factors(rest);
    var g = Gradient(vec4<f32>(0.0), vec2<f32>(cross));
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        g.d += land_factor(factors, c) * read_cascade(surface_derivative, c, rest);
    }
    return g;
}

// The gradient with the slopes of the factors.
fn gradient_at(rest: vec2<f32>, cross: f32) -> Gradient {
    var g = level_gradient_at(rest, cross);
    if has_land() {
        let slopes = land_slopes(rest);
        for (var c = 0u; c < surface_table.cascade_count; c++) {
            let d = read_cascade(surface_displacement, c, rest);
            let s = vec2<f32>(land_factor(slopes.x, c), land_factor(slopes.z, c));
            g.d += vec4<f32>(d.y * s, d.xz * s);
            g.cross += d.xz * s.yx;
        }
    }
    return g;
}

// Determinant of the rest-to-world gradient (1 + grad D). Where the surface is compressed below `least`, it counts as
// compressed that much, so that what is divided by it stays finite at folds.
fn compression(g: Gradient, least: f32) -> f32 {
    return max((1.0 + g.d.z) * (1.0 + g.d.w) - g.cross.x * g.cross.y, least);
}

// Slope of the ambient sea in world coordinates.
fn world_slope(g: Gradient) -> vec2<f32> {
    let s = vec2<f32>((1.0 + g.d.w) * g.d.x - g.cross.y * g.d.y, (1.0 + g.d.z) * g.d.y - g.cross.x * g.d.x);
    return s / compression(g, CHOP_LEAST_SLOPE);
}

// Where the water at a world point comes from: a few fixed-point rounds, then Newton's method, which also gets to the
// steep places.
fn rest_of(point: vec2<f32>) -> vec2<f32> {
    var rest = point;
    var best = point;
    var least = 1e30;
    for (var round = 0u; round <= CHOP_FIXED_ROUNDS + CHOP_NEWTON_ROUNDS; round++) {
        let d = displacement_at(rest);
        let miss = point - rest - d.xz;
        let residual = length(miss);
        if residual < least {
            least = residual;
            best = rest;
        }
        if residual < CHOP_TOLERANCE {
            break;
        }
        var step = miss;
        if round >= CHOP_FIXED_ROUNDS {
            let g = level_gradient_at(rest, d.w);
            step = vec2<f32>((1.0 + g.d.w) * miss.x - g.cross.x * miss.y, (1.0 + g.d.z) * miss.y - g.cross.y * miss.x);
            step /= compression(g, CHOP_LEAST_STEP);
            step *= min(1.0, 4.0 * residual / length(step));
        }
        rest += step;
    }
    return best;
}

// The water at a world point (x, z): the horizontal displacement is inverted, the grids and the level added.
fn surface_at(point: vec2<f32>) -> SurfacePoint {
    let rest = rest_of(point);
    let d = displacement_at(rest);
    let grids = grids_at(point);
    let slope = world_slope(gradient_at(rest, d.w)) + grids.yz;
    let height = d.y + grids.x + surface_table.land.level;
    return SurfacePoint(height, normalize(vec3<f32>(-slope.x, 1.0, -slope.y)), rest);
}

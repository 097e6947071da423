struct SurfacePoint {
    height: f32,
    normal: vec3<f32>,
    rest: vec2<f32>,
}

// A place found: the displacement there and its rest point.
struct Found {
    rest: vec2<f32>,
    displacement: vec4<f32>,
}

// The gradient at a rest point, where dDx/dz is `cross` but for what the slopes of the factors add.
fn gradient_at(rest: vec2<f32>, cross: f32) -> Gradient {
    let factors = land_factors(rest);
    var g = Gradient(vec4<f32>(0.0), vec2<f32>(cross));
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        g.d += land_factor(factors, c) * read_cascade(surface_derivative, c, rest);
    }
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

// The step at rest that moves the surface by `miss`, by Newton's method.
fn newton_step(r: Reading, miss: vec2<f32>) -> vec2<f32> {
    let a = 1.0 + r.along_x.x;
    let b = 1.0 + r.along_z.z;
    let p = r.along_z.x;
    let q = r.along_x.z;
    // Near a fold the step would be arbitrarily long.
    let step = vec2<f32>(b * miss.x - p * miss.y, a * miss.y - q * miss.x) / max(a * b - p * q, CHOP_LEAST_STEP);
    let most = 4.0 * length(miss);
    return select(step, step * (most / length(step)), length(step) > most);
}

// Where the water at a world point comes from: two rough rounds of rest = point - D(rest), then Newton's method until
// its step is so short that the tangent planes tell what is at its end.
fn find(point: vec2<f32>) -> Found {
    var rest = point - rough_displacement(point, 1u).xz;
    rest = point - rough_displacement(rest, surface_table.cascade_count).xz;
    var best = Found(rest, vec4<f32>(0.0));
    var least = 1e30;
    for (var round = 0u; round < CHOP_ROUNDS; round++) {
        let r = reading_at(rest);
        let miss = point - rest - r.value.xz;
        let step = newton_step(r, miss);
        if length(step) < CHOP_LAST_STEP {
            return Found(rest + step, r.value + step.x * r.along_x + step.y * r.along_z);
        }
        if length(miss) < least {
            least = length(miss);
            best = Found(rest, r.value);
        }
        rest += step;
    }
    return best;
}

// The water at a world point (x, z): the horizontal displacement is inverted, the grids and the level added.
fn surface_at(point: vec2<f32>) -> SurfacePoint {
    let found = find(point);
    let grids = grids_at(point);
    let slope = world_slope(gradient_at(found.rest, found.displacement.w)) + grids.yz;
    let height = found.displacement.y + grids.x + surface_table.land.level;
    return SurfacePoint(height, normalize(vec3<f32>(-slope.x, 1.0, -slope.y)), found.rest);
}

// A factor for each cascade: 0 to 3 in `low`, 4 to 7 in `high`; and their slopes along x and z, 1/m.
struct LandFactors {
    low: vec4<f32>,
    high: vec4<f32>,
}

struct LandSlopes {
    x: LandFactors,
    z: LandFactors,
}

// Factors on the amplitudes of the cascades at a rest point.
fn land_factors(rest: vec2<f32>) -> LandFactors {
    var factors = LandFactors(vec4<f32>(1.0), vec4<f32>(1.0));
    if has_land() {
        let place = land_place(rest);
        // A software adapter runs what a condition skips, but not what a loop does not come to.
        var layer = 0u;
        loop {
            let four = land_mix(land_corners(layer, place), place.t);
            if layer == 0u {
                factors.low = four;
            } else {
                factors.high = four;
            }
            layer++;
            if layer > 1u || surface_table.cascade_count <= 4u {
                break;
            }
        }
    }
    return factors;
}

fn land_slopes_of(layer: u32, place: LandPlace) -> array<vec4<f32>, 2> {
    let k = land_corners(layer, place);
    let low = k.b - k.a;
    let left = k.c - k.a;
    let scale = place.inside / surface_table.land.texel;
    return array<vec4<f32>, 2>(
        (low + ((k.d - k.c) - low) * place.t.y) * scale.x,
        (left + ((k.d - k.b) - left) * place.t.x) * scale.y,
    );
}

// Slopes of the factors. Only where there is land.
fn land_slopes(rest: vec2<f32>) -> LandSlopes {
    let place = land_place(rest);
    let low = land_slopes_of(0u, place);
    var high = array<vec4<f32>, 2>(vec4<f32>(0.0), vec4<f32>(0.0));
    if surface_table.cascade_count > 4u {
        high = land_slopes_of(1u, place);
    }
    return LandSlopes(LandFactors(low[0], high[0]), LandFactors(low[1], high[1]));
}

fn land_factor(factors: LandFactors, cascade: u32) -> f32 {
    return select(factors.low, factors.high, cascade >= 4u)[cascade & 3u];
}

// The surface's gradient by rest coordinates.
struct Gradient {
    // (dh/dx, dh/dz, dDx/dx, dDz/dz)
    d: vec4<f32>,
    // (dDx/dz, dDz/dx): equal but for what the land's factors add.
    cross: vec2<f32>,
}

// Slope of the ambient sea in world coordinates. Where the surface is compressed more, it counts as compressed by
// CHOP_LEAST_SLOPE, so that slopes stay finite at folds.
fn world_slope(g: Gradient) -> vec2<f32> {
    let s = vec2<f32>((1.0 + g.d.w) * g.d.x - g.cross.y * g.d.y, (1.0 + g.d.z) * g.d.y - g.cross.x * g.d.x);
    let compression = (1.0 + g.d.z) * (1.0 + g.d.w) - g.cross.x * g.cross.y;
    return s / max(compression, CHOP_LEAST_SLOPE);
}

// Keeps a slope below what water can stand at: folds of the horizontal displacement would sparkle.
fn soft_slope(slope: vec2<f32>) -> vec2<f32> {
    return slope * inverseSqrt(1.0 + dot(slope, slope) / 1.44);
}

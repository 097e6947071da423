struct SurfaceCascade {
    offset: vec2<f32>,
    tile: f32,
    size: f32,
}

// Mip level whose texel is as wide as the footprint (metres); negative when that is narrower than a texel.
fn cascade_level(c: SurfaceCascade, footprint: f32) -> f32 {
    return log2(max(footprint * c.size / c.tile, 1e-6));
}

// How much of a cascade still shows: 1 near, 0 when the footprint is wider than half its tile.
fn cascade_weight(c: SurfaceCascade, footprint: f32) -> f32 {
    return 1.0 - smoothstep(0.25, 0.5, footprint / c.tile);
}

// Where a filtering sampler finds a rest point: texel (0, 0) itself lies at the tile's corner, not half a texel inside.
fn cascade_uv(c: SurfaceCascade, rest: vec2<f32>) -> vec2<f32> {
    return (rest + c.offset) / c.tile + 0.5 / c.size;
}

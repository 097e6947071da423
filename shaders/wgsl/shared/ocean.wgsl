struct OceanCascade {
    // Wavenumber step of the cells, rad/m.
    wave_step: f32,
    // Standard deviation of the other cascades' divergence of the displacement, at least a little.
    foam_spread: f32,
    // Foam of this cascade that the others account for.
    foam_share: f32,
    // Rows and columns `0..half` and `N - half + 1..N` may hold modes, at most N/2.
    half: u32,
    place: SurfaceCascade,
}

struct OceanParams {
    // Time within the loop of each mode set, and factor on its amplitudes.
    phase: vec2<u32>,
    weight: vec2<f32>,
    cascade_count: u32,
    choppiness: f32,
    // Jacobian below which water breaks.
    foam_threshold: f32,
    // Factor on old foam.
    foam_decay: f32,
    cascades: array<OceanCascade, OCEAN_CASCADES>,
}

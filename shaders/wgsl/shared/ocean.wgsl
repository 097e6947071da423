struct OceanCascade {
    // Wavenumber step of the cells, rad/m.
    wave_step: f32,
    // Standard deviation of the other cascades' divergence of the displacement, at least a little.
    foam_spread: f32,
    // Foam of this cascade that the others account for.
    foam_share: f32,
    pad: f32,
}

struct OceanParams {
    phase: u32,
    cascade_count: u32,
    choppiness: f32,
    // Jacobian below which water breaks.
    foam_threshold: f32,
    // Factor on old foam.
    foam_decay: f32,
    pad_a: u32,
    pad_b: u32,
    pad_c: u32,
    cascades: array<OceanCascade, OCEAN_CASCADES>,
}

// A row or a column of a layer. Layers: pair 0 of each cascade (displacement), then pair 1 (derivative).
struct Place {
    cascade: u32,
    pair: u32,
    layer: u32,
    line: u32,
}

fn place_of(layer: u32, line: u32) -> Place {
    let pair = select(0u, 1u, layer >= ocean.cascade_count);
    return Place(layer - pair * ocean.cascade_count, pair, layer, line);
}

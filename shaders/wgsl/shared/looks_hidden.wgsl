// Mean square slope of the waves that a footprint (metres) hides.
fn hidden_slope(footprint: f32) -> f32 {
    let x = clamp(log2(max(footprint, 1e-6)) + HIDDEN_SLOPE_BIAS, 0.0, 15.0);
    let i = u32(x);
    let j = min(i + 1u, 15u);
    let a = surface_table.hidden_slope[i / 4u][i % 4u];
    let b = surface_table.hidden_slope[j / 4u][j % 4u];
    return mix(a, b, x - f32(i));
}

// The same where the land's factors hold: each cascade, which has the waves up to a sixth of its tile, by its own.
fn hidden_left(footprint: f32, factors: LandFactors) -> f32 {
    var below = hidden_slope(footprint);
    if !has_land() || surface_table.cascade_count == 0u {
        return below;
    }
    var sum = 0.0;
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let above = below;
        below = 0.0;
        if c + 1u < surface_table.cascade_count {
            below = hidden_slope(min(footprint, surface_table.cascades[c + 1u].tile / 12.0));
        }
        let factor = land_factor(factors, c);
        sum += factor * factor * (above - below);
    }
    return sum;
}

// The factor of the finest cascade.
fn last_factor(factors: LandFactors) -> f32 {
    return land_factor(factors, max(surface_table.cascade_count, 1u) - 1u);
}

// Foam that the land makes, before it is broken up into lace: swash and breakers on a beach, white water along walls.
// `wave`: height above still water, `depth`: water under the surface, metres; `near`: nearness of a wall.
fn shore_foam(wave: f32, depth: f32, near: f32, normal: vec3<f32>) -> f32 {
    if !has_land() {
        return 0.0;
    }
    let rise = max(wave, 0.0);
    let still = max(depth - wave, 0.0);
    // The swash: a band where the water is a hand deep, wider and whiter under a crest, lace where it runs back.
    let swash = 1.0 - smoothstep(0.02, 0.22 + 1.5 * rise, depth);
    let edge = swash * (0.65 + 0.35 * smoothstep(-0.05, 0.15, wave));
    // Waves break where they are high against the depth.
    let breaker = smoothstep(0.3, 0.6, rise / max(still, 0.25)) * (1.0 - smoothstep(2.0, 4.0, still));
    // Walls: where a crest stands or water is steep.
    let slope = length(normal.xz) / max(normal.y, 0.1);
    let wall = near * smoothstep(0.04, 0.35, rise + 0.6 * slope);
    return clamp(view.surf * max(max(0.8 * edge, 0.9 * breaker), 0.85 * wall), 0.0, 1.0);
}

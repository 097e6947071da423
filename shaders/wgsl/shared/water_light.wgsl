// Share of a pixel that foam covers: the amount decides how much of the texture stands out. A texture finer than the
// pixel fades into its mean.
fn foam_cover(amount: f32, rest: vec2<f32>, dx: vec2<f32>, dy: vec2<f32>) -> f32 {
    if amount <= 0.002 {
        return 0.0;
    }
    let scale = 1.0 / view.foam_size;
    let fine = textureSampleGrad(foam_texture, foam_sampler, rest * scale, dx * scale, dy * scale).x;
    let turned = vec2<f32>(0.8 * rest.x - 0.6 * rest.y, 0.6 * rest.x + 0.8 * rest.y) * (scale * 0.41);
    let coarse = textureSampleGrad(foam_texture, foam_sampler, turned, dx * scale * 0.41, dy * scale * 0.41).x;
    let pattern = 0.6 * fine + 0.4 * coarse;
    let edge = 1.0 - amount;
    let sharp = smoothstep(edge - 0.15, edge + 0.3, pattern) * (0.5 + 0.5 * fine);
    let blur = smoothstep(0.1, 0.7, max(length(dx), length(dy)) * scale);
    return mix(sharp, 0.75 * amount * amount * (1.5 - 0.5 * amount), blur) * smoothstep(0.0, 0.1, amount);
}

// What leaves the surface towards the eye, and the share of what was drawn behind it that it lets through.
struct WaterLight {
    radiance: vec3<f32>,
    through: f32,
}

// Light out of the body of the water: deep scatter, the bed through it, and sun through the crests. `height` is above
// still water. An even bed is not drawn by anyone else and is seen here; a land's bed has been drawn: the share of it that
// all colours let through is left to it, the rest of the colours, which blue and green pass longer, is added.
fn water_body(normal: vec3<f32>, to_eye: vec3<f32>, height: f32, depth: f32, bubbles: f32) -> WaterLight {
    let down = view.sunlight * (0.95 * max(view.sun.y, 0.0)) + view.skylight;
    // Bubbles under foam scatter what the water lets through.
    let deep = view.scatter * (1.0 + 5.0 * bubbles);
    var albedo = deep;
    var through = 0.0;
    let land = has_land();
    if land || view.depth > 0.0 {
        // Down along the refracted sun ray, up along the refracted line of sight.
        let path_up = inverseSqrt(1.0 - (1.0 - to_eye.y * to_eye.y) * 0.5625);
        let path_down = inverseSqrt(1.0 - (1.0 - view.sun.y * view.sun.y) * 0.5625);
        let below = select(view.depth + height, depth, land);
        let clear = exp(-view.absorption * max(below, 0.0) * (path_up + path_down));
        if land {
            // Nothing of the bed once a hundredth is left of the weakest colour.
            through = max(min(clear.x, min(clear.y, clear.z)) - 0.01, 0.0) / 0.99;
        }
        albedo = mix(deep, view.bed, clear) - view.bed * through;
    }
    let glow = pow(max(dot(to_eye.xz, -view.sun.xz), 0.0), 3.0) * pow(max(0.5 - 0.5 * dot(normal, view.sun), 0.0), 2.0);
    let crest = clamp(height / max(view.wave_height, 0.05) + 0.35, 0.0, 1.2);
    let tint = view.scatter * vec3<f32>(1.2, 1.35, 0.85);
    let lit = (albedo * down * (0.85 + 0.3 * crest) + tint * view.sunlight * ((1.0 - through) * glow * crest * 6.0)) / 3.14159265;
    return WaterLight(lit, through);
}

// Radiance that leaves the surface towards the eye: sky and sun reflected by facets of Gaussian slope around the
// resolved normal, the water's body, foam.
fn water_radiance(look: SurfaceLook, foam: f32, to_eye: vec3<f32>, height: f32, depth: f32) -> WaterLight {
    // A facet seen from behind is hidden by the one in front: turn it until it is seen edge-on.
    let n = normalize(look.normal + to_eye * max(0.03 - dot(look.normal, to_eye), 0.0));
    // Slope variance along one axis; the floor is the sun's own width and ripples finer than any table.
    let variance = 0.5 * look.roughness + 4e-4;
    let s = sqrt(variance);
    let facing = dot(n, to_eye);
    let across = to_eye - n * facing;
    let grazing = max(length(across), 1e-4);
    // Mean slope towards the eye of the facets it sees: s P(a)/g(a), a = cot(angle)/s, with logistic P and its integral g.
    let a = facing / (grazing * s);
    let seen = a + log(1.0 + exp(-1.7376 * a)) / 1.7376;
    let tilt = s / ((1.0 + exp(-1.7376 * a)) * seen);
    let m = normalize(n + across * (tilt / grazing));
    let f = fresnel(dot(m, to_eye));
    let body = water_body(n, to_eye, height, depth, look.foam);
    var mirror = reflect(-to_eye, m);
    // A ray that meets the water again sees its body and a little of the sky in it.
    let again = 1.0 - smoothstep(-0.3, 0.1, mirror.y);
    mirror.y = max(mirror.y, 0.03);
    let above = sky_radiance(mirror);
    let sky = mix(above, 0.3 * above + body.radiance, 0.8 * again);
    let h = normalize(view.sun + to_eye);
    let hy = max(h.y, 0.05);
    let off = h.xz / hy - n.xz / max(n.y, 0.05);
    let spread = exp(-dot(off, off) / (2.0 * variance)) / (6.2831853 * variance);
    let projected = max(4.0 * hy * hy * hy * hy * grazing * s * seen, 0.02);
    let glitter = view.sunlight * (fresnel(dot(h, to_eye)) * spread / projected * smoothstep(-0.02, 0.05, view.sun.y));
    let water = mix(body.radiance, sky, f) + glitter;
    let lit = view.sunlight * max(0.3 * view.sun.y + 0.7 * dot(n, view.sun), 0.0) + view.skylight;
    let radiance = mix(water, lit * (0.75 / 3.14159265), foam);
    return WaterLight(radiance, body.through * (1.0 - f) * (1.0 - foam));
}

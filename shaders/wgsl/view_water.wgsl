// The sea: a grid projected from a level projector onto the mean plane, displaced and shaded by the composite surface.
// Its colour is premultiplied: over a land's bed it lets through what stands behind it.
struct WaterVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) rest: vec2<f32>,
}

@vertex
fn water_vertex(@builtin(vertex_index) index: u32) -> WaterVertex {
    let stride = view.columns + 1u;
    let column = (view.first_column + index % stride) % view.turn;
    let row = index / stride;
    // The accuracy of sin and cos does not matter: the rest point is wherever they say, the same for both neighbours.
    let angle = f32(column) * view.column_step;
    var radius = exp(f32(view.first_row + i32(row)) * view.row_step);
    if view.closed == 1u && row == 0u {
        radius = 0.0;
    }
    let rest = view.pole + radius * vec2<f32>(cos(angle), sin(angle));
    let spacing = max(radius, 0.05) * max(view.row_step, view.column_step);
    let point = surface_vertex(rest, GRID_FILTER * spacing);
    // Towards the horizon waves sink into the plane, so that the last row is level.
    let world = mix(point, vec3<f32>(rest.x, view.level, rest.y), smoothstep(0.5, 0.9, radius / view.far));
    var clip = view.clip_from_world * vec4<f32>(world, 1.0);
    // The sea reaches beyond a host's far plane: such vertices stand on it.
    if clip.w > 0.0 {
        clip.z = select(min(clip.z, clip.w * 0.9999999), max(clip.z, clip.w * 1e-9), view.reverse_z > 0.5);
    }
    return WaterVertex(clip, world, rest);
}

@fragment
fn water_fragment(in: WaterVertex) -> @location(0) vec4<f32> {
    let dx = dpdx(in.rest);
    let dy = dpdy(in.rest);
    // Axes of the pixel's ellipse on the rest plane.
    let trace = dot(dx, dx) + dot(dy, dy);
    let area = abs(dx.x * dy.y - dx.y * dy.x);
    let major = sqrt(max(0.5 * (trace + sqrt(max(trace * trace - 4.0 * area * area, 0.0))), 1e-12));
    let minor = area / major;
    // Between the two: the long axis alone blurs all waves away at grazing angles, the short one alone shimmers.
    let footprint = max(sqrt(major * minor), major / PIXEL_STRETCH);
    let look = surface_shading(in.rest, footprint);
    // (elevation of the bed, open water, nearness of walls); without land far below, open and away from walls.
    let land = land_at(in.world.xz);
    let depth = in.world.y - land.x;
    let wave = in.world.y - view.level;
    if depth <= 0.0 || land.y < LEAST_OPEN || surface_is_dry(in.world) {
        discard;
    }
    let white = max(look.foam, shore_foam(wave, depth, land.z, look.normal));
    let foam = foam_cover(white, in.rest, dx, dy);
    let offset = view.camera - in.world;
    let distance = length(offset);
    let water = water_radiance(look, foam, offset / distance, wave, depth);
    let seen = exp(-view.haze * distance) * (1.0 - smoothstep(0.5, 0.98, distance / view.far));
    // Light that is added over light that is let through, as the target wants it: a colour and how much it covers.
    let cover = 1.0 - water.through * seen;
    let radiance = mix(sky_radiance(-offset), water.radiance, seen) / max(cover, 0.005);
    let opacity = cover * smoothstep(0.0, SHORE_EDGE, depth);
    return vec4<f32>(target_color(radiance, in.clip.xy).rgb, 1.0) * opacity;
}

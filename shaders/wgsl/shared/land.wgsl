// Where a point lies in the land's rasters: the texel below it on both axes, and the fraction to the next. Outside, the
// edge goes on, without slope.
struct LandPlace {
    at: vec2<u32>,
    t: vec2<f32>,
    inside: vec2<f32>,
}

struct LandCorners {
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
    d: vec4<f32>,
}

// A pipeline that never sees land may set SURFACE_LAND to false: then nothing of it is compiled.
fn has_land() -> bool {
    return SURFACE_LAND && surface_table.land.present != 0u;
}

fn land_place(point: vec2<f32>) -> LandPlace {
    let land = surface_table.land;
    let x = (point - land.corner) / land.texel;
    let last = vec2<f32>(land.size) - 1.0;
    let held = clamp(x, vec2<f32>(0.0), last);
    let base = min(floor(held), last - 1.0);
    return LandPlace(vec2<u32>(base), held - base, select(vec2<f32>(0.0), vec2<f32>(1.0), held == x));
}

fn land_corners(layer: u32, place: LandPlace) -> LandCorners {
    let next = place.at + 1u;
    return LandCorners(
        textureLoad(surface_land, place.at, layer, 0),
        textureLoad(surface_land, vec2<u32>(next.x, place.at.y), layer, 0),
        textureLoad(surface_land, vec2<u32>(place.at.x, next.y), layer, 0),
        textureLoad(surface_land, next, layer, 0),
    );
}

fn land_mix(k: LandCorners, t: vec2<f32>) -> vec4<f32> {
    let low = k.a + (k.b - k.a) * t.x;
    let high = k.c + (k.d - k.c) * t.x;
    return low + (high - low) * t.y;
}

// (elevation of the bed, open water, nearness of walls, 0) at a point.
fn land_at(point: vec2<f32>) -> vec4<f32> {
    if !has_land() {
        return vec4<f32>(-1000.0, 1.0, 0.0, 0.0);
    }
    let place = land_place(point);
    return land_mix(land_corners(2u, place), place.t);
}

// Elevation of the bed above datum, metres; -1000 where there is no land.
fn bed_at(point: vec2<f32>) -> f32 {
    return land_at(point).x;
}

// 1 in water, 0 where there is none (inside a dock or a hull, behind a quay), between in between.
fn water_open(point: vec2<f32>) -> f32 {
    return land_at(point).y;
}

// 1 at a wall, falling to 0 away from it.
fn wall_nearness(point: vec2<f32>) -> f32 {
    return land_at(point).z;
}

// Depth of still water, metres; negative on dry land.
fn water_depth(point: vec2<f32>) -> f32 {
    return surface_table.land.level - bed_at(point);
}

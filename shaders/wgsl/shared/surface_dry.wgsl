// A node of a dry hull's raster: lower and upper side in the hull's frame, distance inside the edge of its plan, metres.
fn dry_node(hull: SurfaceDry, at: vec2<u32>) -> vec3<f32> {
    let first = hull.base + 2u * (at.y * hull.nodes.x + at.x);
    return vec3<f32>(surface_grids[first], surface_grids[first + 1u].x);
}

fn dry_in_hull(hull: SurfaceDry, point: vec3<f32>) -> bool {
    let d = vec4<f32>(point - hull.place, 1.0);
    let at = vec2<f32>(dot(hull.x, d), dot(hull.z, d));
    let last = vec2<f32>(hull.nodes) - 1.0;
    if !(all(at >= vec2<f32>(0.0)) && all(at <= last)) {
        return false;
    }
    let base = min(floor(at), last - 1.0);
    let t = at - base;
    let first = vec2<u32>(base);
    let near = mix(dry_node(hull, first), dry_node(hull, first + vec2<u32>(1u, 0u)), t.x);
    let far = mix(dry_node(hull, first + vec2<u32>(0u, 1u)), dry_node(hull, first + 1u), t.x);
    let node = mix(near, far, t.y);
    let y = dot(hull.y, d);
    return node.z >= 0.0 && y >= node.x && y <= node.y;
}

// Whether a point (x, y, z) of the water lies in a hull that is kept dry, between its skin and its rim.
fn surface_is_dry(point: vec3<f32>) -> bool {
    // A software adapter runs what a condition skips, but not what a loop does not come to.
    let near = all(point.xz >= surface_table.dry_low) && all(point.xz <= surface_table.dry_high);
    let count = select(0u, surface_table.dry_count, near);
    for (var i = 0u; i < count; i++) {
        if dry_in_hull(surface_table.dry[i], point) {
            return true;
        }
    }
    return false;
}

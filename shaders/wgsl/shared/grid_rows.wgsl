// Four cells of a row with those before and after each.
struct Row {
    west: vec4<f32>,
    here: vec4<f32>,
    east: vec4<f32>,
}

// Eight cells of a row.
struct Wide {
    a: Row,
    b: Row,
}

fn wide(w: f32, a: vec4<f32>, b: vec4<f32>, e: f32) -> Wide {
    return Wide(
        Row(vec4<f32>(w, a.xyz), a, vec4<f32>(a.yzw, b.x)),
        Row(vec4<f32>(a.w, b.xyz), b, vec4<f32>(b.yzw, e)));
}

// Cells of the row whose first vec4 is `first`: the two vec4 from `here` on, the last of `west`, the first of `east`.
fn read_heights(first: u32, west: u32, here: u32, east: u32) -> Wide {
    return wide(
        grid_heights[first + west].w, grid_heights[first + here], grid_heights[first + here + 1u],
        grid_heights[first + east].x);
}

// The same of a, which stands in the medium.
fn read_ground(first: u32, west: u32, here: u32, east: u32) -> Wide {
    return wide(
        grid_ground[first + west].w, grid_ground[first + here], grid_ground[first + here + 1u],
        grid_ground[first + east].x);
}

fn flush(x: vec4<f32>) -> vec4<f32> {
    return select(x, vec4<f32>(0.0), abs(x) < vec4<f32>(TINY));
}

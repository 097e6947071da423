// phi and chi of four cells, or a number for each.
struct Fields {
    p: vec4<f32>,
    x1: vec4<f32>,
    x2: vec4<f32>,
    x3: vec4<f32>,
}

// What eight cells lie in: the faces of each field, m, and 1 / (1 + sigma dt / 2), 0 in what is not open water.
struct Bed {
    w_p: Faces,
    w_1: Faces,
    w_2: Faces,
    w_3: Faces,
    m_a: Fields,
    m_b: Fields,
    damp: Pair,
}

fn even_bed(water: GridWater) -> Bed {
    let w = water.shares;
    let damp = vec4<f32>(water.gains.x);
    let m = Fields(damp, vec4<f32>(water.gains.y), vec4<f32>(water.gains.z), vec4<f32>(water.gains.w));
    return Bed(
        even_faces(w.x), even_faces(w.y), even_faces(w.z), even_faces(w.w), m, m, Pair(damp, damp));
}

// Of the cells from `at` on, `east` the vec4 after and `north` that above them.
fn read_bed(grid: GridParams, water: GridWater, at: u32, east: u32, north: u32) -> Bed {
    var bed: Bed;
    bed.w_p = read_faces(water.faces, grid.stride, 0u, at, east, north);
    bed.w_1 = read_faces(water.faces, grid.stride, 1u, at, east, north);
    bed.w_2 = read_faces(water.faces, grid.stride, 2u, at, east, north);
    bed.w_3 = read_faces(water.faces, grid.stride, 3u, at, east, north);
    let damp = grid.base / 2u + grid.stride + at;
    bed.damp = Pair(grid_ground[damp], grid_ground[damp + 1u]);
    let m_1 = read_m(water.faces, grid.stride, 0u, at);
    let m_2 = read_m(water.faces, grid.stride, 1u, at);
    let m_3 = read_m(water.faces, grid.stride, 2u, at);
    bed.m_a = Fields(bed.damp.a, m_1.a, m_2.a, m_3.a);
    bed.m_b = Fields(bed.damp.b, m_1.b, m_2.b, m_3.b);
    return bed;
}

// Heights and fields of four cells after a sub-step.
struct Next {
    z: vec4<f32>,
    u: Fields,
}

// `stays` tells which cells keep the fields they have.
fn advance(
    water: GridWater, z: vec4<f32>, u: Fields, old: Fields, flow: Fields, m: Fields, damp: vec4<f32>, open: vec4<bool>, stays: vec4<bool>,
) -> Next {
    let none = vec4<f32>(0.0);
    let pull_1 = water.rates.y * (u.p - u.x1);
    let pull_2 = water.rates.z * (u.p - u.x2);
    let pull_3 = water.rates.w * (u.p - u.x3);
    var next: Next;
    next.z = select(none, flush(z - (flow.p - pull_1 - pull_2 - pull_3)), open);
    next.u.p = select(select(none, u.p, stays), flush((2.0 * damp - 1.0) * u.p - damp * water.rates.x * next.z), open);
    next.u.x1 = select(select(none, u.x1, stays), flush(2.0 * u.x1 - old.x1 + m.x1 * (flow.x1 + pull_1)), open);
    next.u.x2 = select(select(none, u.x2, stays), flush(2.0 * u.x2 - old.x2 + m.x2 * (flow.x2 + pull_2)), open);
    next.u.x3 = select(select(none, u.x3, stays), flush(2.0 * u.x3 - old.x3 + m.x3 * (flow.x3 + pull_3)), open);
    return next;
}

fn store_next(at: u32, heights: u32, next: vec4<u32>, to: Next) {
    grid_heights[heights + at] = to.z;
    grid_memory[next.x + at] = to.u.p;
    grid_memory[next.y + at] = to.u.x1;
    grid_fields[next.z + at] = to.u.x2;
    grid_fields[next.w + at] = to.u.x3;
}

// How much the water breaks, 0 to 1, and the factor of the foam that is left.
struct Foam {
    breaking: vec4<f32>,
    keep: vec4<f32>,
}

// Of four cells: heights in three rows before the sub-step and after it; where the medium varies its a and the faces' c.
fn foam_of(
    strip: Strip, s: Row, c: Row, n: Row, next: vec4<f32>, a_s: vec4<f32>, a_c: Row, a_n: vec4<f32>,
    faces: Fluxes, open: vec4<bool>,
) -> Foam {
    let none = vec4<f32>(0.0);
    let grid = strip.grid;
    let mixed = (strip.entry.w & MIXED_TILE) != 0u;
    var bend = (c.west - c.here) + (c.east - c.here) + (s.here - c.here) + (n.here - c.here);
    if MIXED {
        bend = select(bend, open_bend(s, c, n, faces, 1.0), vec4<bool>(mixed));
    }
    var excess = clamp(-bend * grid.foam_scale - grid.foam_onset, none, vec4<f32>(1.0));
    if MIXED {
        let limit = grid.foam_depth / grid.deep;
        let shore = foam_excess(excess, c.here, next, a_c, min(a_s, a_n), limit, grid.foam_splash);
        excess = select(excess, shore, vec4<bool>(mixed));
    }
    return Foam(select(none, excess, open), select(none, vec4<f32>(grid.foam_keep), open));
}

// A field of eight cells with the rows below and above: what flows into each cell.
struct Pair {
    a: vec4<f32>,
    b: vec4<f32>,
}

// Of the faces of eight cells: those west of each, the one east of the last, south and north ones.
struct Faces {
    x: Pair,
    far: f32,
    s: Pair,
    n: Pair,
}

// Three rows of a field.
struct Rows {
    s: Wide,
    c: Wide,
    n: Wide,
}

fn even_faces(w: f32) -> Faces {
    let all = Pair(vec4<f32>(w), vec4<f32>(w));
    return Faces(all, w, all, all);
}

// The jumps across the faces.
fn jumps_of(u: Rows) -> Faces {
    return Faces(
        Pair(u.c.a.here - u.c.a.west, u.c.b.here - u.c.b.west),
        u.c.b.east.w - u.c.b.here.w,
        Pair(u.c.a.here - u.s.a.here, u.c.b.here - u.s.b.here),
        Pair(u.n.a.here - u.c.a.here, u.n.b.here - u.c.b.here));
}

// What flows in along x, of the jumps and of the faces' coefficients.
fn along_x(jumps: Faces, w: Faces) -> Pair {
    let a = w.x.a * jumps.x.a;
    let b = w.x.b * jumps.x.b;
    return Pair(vec4<f32>(a.yzw, b.x) - a, vec4<f32>(b.yzw, w.far * jumps.far) - b);
}

fn along_z(jumps: Faces, w: Faces) -> Pair {
    return Pair(w.n.a * jumps.n.a - w.s.a * jumps.s.a, w.n.b * jumps.n.b - w.s.b * jumps.s.b);
}

// Both where all faces have the same coefficient.
fn spread(u: Rows, w: f32) -> Pair {
    let c = u.c;
    return Pair(
        w * ((c.a.west - c.a.here) + (c.a.east - c.a.here) + (u.s.a.here - c.a.here) + (u.n.a.here - c.a.here)),
        w * ((c.b.west - c.b.here) + (c.b.east - c.b.here) + (u.s.b.here - c.b.here) + (u.n.b.here - c.b.here)));
}

fn read_memory(first: u32, west: u32, here: u32, east: u32) -> Wide {
    return wide(
        grid_memory[first + west].w, grid_memory[first + here], grid_memory[first + here + 1u],
        grid_memory[first + east].x);
}

fn read_fields(first: u32, west: u32, here: u32, east: u32) -> Wide {
    return wide(
        grid_fields[first + west].w, grid_fields[first + here], grid_fields[first + here + 1u],
        grid_fields[first + east].x);
}

// The faces of field k for the eight cells from `at` on, `east` the vec4 after and `north` that above them.
fn read_faces(first: u32, stride: u32, k: u32, at: u32, east: u32, north: u32) -> Faces {
    let x = first + k * stride;
    let z = x + FIELDS * stride;
    return Faces(
        Pair(grid_faces[x + at], grid_faces[x + at + 1u]), grid_faces[x + east].x,
        Pair(grid_faces[z + at], grid_faces[z + at + 1u]), Pair(grid_faces[z + north], grid_faces[z + north + 1u]));
}

// m of chi number k.
fn read_m(first: u32, stride: u32, k: u32, at: u32) -> Pair {
    let m = first + (2u * FIELDS + k) * stride + at;
    return Pair(grid_faces[m], grid_faces[m + 1u]);
}

override ROWS: u32 = 1u;
override LAST: bool = true;
override MIXED: bool = true;

// What a thread walks: eight columns of a tile, ROWS rows.
struct Strip {
    grid: GridParams,
    water: GridWater,
    entry: vec4<u32>,
    // In vec4: the grid's columns, the strip's first one, and those before and after it.
    columns: u32,
    column: u32,
    west: u32,
    east: u32,
    // Its first row, in the tile and on the torus, and which half of the tile it is.
    row_in_tile: u32,
    first_row: u32,
    half: u32,
    // First vec4 of z and of phi, chi_1, chi_2, chi_3: now and after.
    z_now: u32,
    z_next: u32,
    now: vec4<u32>,
    next: vec4<u32>,
}

fn strip_of(entry: vec4<u32>, part: u32) -> Strip {
    let tile = entry.x;
    var strip: Strip;
    strip.grid = grid_params[tile >> 16u];
    strip.water = grid_water[tile >> 16u];
    strip.entry = entry;
    strip.columns = strip.grid.torus.x / 4u;
    strip.half = part % 2u;
    strip.column = (tile & 0xffu) * (TILE / 4u) + 2u * strip.half;
    strip.row_in_tile = part / 2u * ROWS;
    strip.first_row = ((tile >> 8u) & 0xffu) * TILE + strip.row_in_tile;
    strip.west = select(strip.column - 1u, strip.columns - 1u, strip.column == 0u);
    strip.east = select(strip.column + 2u, 0u, strip.column + 2u == strip.columns);
    let stride = strip.grid.stride;
    let base = strip.grid.base;
    let now = ((strip.grid.parity + grid_dispatch.substep) & 1u) * stride;
    let fields = vec4<u32>(base, base + 2u * stride, strip.water.fields, strip.water.fields + 2u * stride);
    strip.z_now = base + now;
    strip.z_next = base + stride - now;
    strip.now = fields + now;
    strip.next = fields + stride - now;
    return strip;
}

// The fields in the rows below, here and above; heights where foam is wanted, a where the medium varies besides.
struct Walk {
    p: Rows,
    x1: Rows,
    x2: Rows,
    x3: Rows,
    z: Rows,
    a: Rows,
}

fn walk_from(s: Strip) -> Walk {
    let south = select(s.first_row - 1u, s.grid.torus.y - 1u, s.first_row == 0u) * s.columns;
    let here = s.first_row * s.columns;
    var walk: Walk;
    walk.p.s = read_memory(s.now.x + south, s.west, s.column, s.east);
    walk.p.c = read_memory(s.now.x + here, s.west, s.column, s.east);
    walk.x1.s = read_memory(s.now.y + south, s.west, s.column, s.east);
    walk.x1.c = read_memory(s.now.y + here, s.west, s.column, s.east);
    walk.x2.s = read_fields(s.now.z + south, s.west, s.column, s.east);
    walk.x2.c = read_fields(s.now.z + here, s.west, s.column, s.east);
    walk.x3.s = read_fields(s.now.w + south, s.west, s.column, s.east);
    walk.x3.c = read_fields(s.now.w + here, s.west, s.column, s.east);
    if LAST {
        walk.z.s = read_heights(s.z_now + south, s.west, s.column, s.east);
        walk.z.c = read_heights(s.z_now + here, s.west, s.column, s.east);
    }
    return walk;
}

// Reads the row above `row`, whose first vec4 is `north`.
fn look_north(walk: ptr<function, Walk>, s: Strip, row: u32, north: u32) {
    (*walk).p.n = read_memory(s.now.x + north, s.west, s.column, s.east);
    (*walk).x1.n = read_memory(s.now.y + north, s.west, s.column, s.east);
    (*walk).x2.n = read_fields(s.now.z + north, s.west, s.column, s.east);
    (*walk).x3.n = read_fields(s.now.w + north, s.west, s.column, s.east);
    if LAST {
        (*walk).z.n = read_heights(s.z_now + north, s.west, s.column, s.east);
    } else {
        let at = s.z_now + row * s.columns + s.column;
        (*walk).z.c.a.here = grid_heights[at];
        (*walk).z.c.b.here = grid_heights[at + 1u];
    }
}

fn step_north(u: Rows) -> Rows {
    return Rows(u.c, u.n, u.n);
}

fn walk_north(walk: Walk) -> Walk {
    return Walk(
        step_north(walk.p), step_north(walk.x1), step_north(walk.x2), step_north(walk.x3), step_north(walk.z),
        step_north(walk.a));
}

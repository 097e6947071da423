// One sub-step in place over the older heights. A thread walks up a strip of eight columns and `ROWS` rows (a divisor of
// 16) and keeps the rows below and here: what it costs is the number of loads and stores. A tile has 32 / `ROWS` such
// threads, a workgroup `THREADS`, a multiple of that.
override ROWS: u32 = 1u;
override THREADS: u32 = 64u;

@compute @workgroup_size(THREADS)
fn grid_step(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let parts = 2u * TILE / ROWS;
    let number = group.x * (THREADS / parts) + local / parts;
    let part = local % parts;
    let tile = grid_tiles[grid_dispatch.first + min(number, grid_dispatch.count - 1u)].x;
    // Threads beyond the list walk no row.
    let rows = select(0u, ROWS, number < grid_dispatch.count);
    let grid = grid_params[tile >> 16u];
    let torus = grid.torus;
    let columns = torus.x / 4u;
    let column = (tile & 0xffu) * (TILE / 4u) + part % 2u * 2u;
    let first_row = ((tile >> 8u) & 0xffu) * TILE + part / 2u * ROWS;
    let west = select(column - 1u, columns - 1u, column == 0u);
    let east = select(column + 2u, 0u, column + 2u == columns);
    let south = select(first_row - 1u, torus.y - 1u, first_row == 0u);

    let stride = grid.stride;
    let level = (grid.parity + grid_dispatch.substep) & 1u;
    let now = grid.base + level * stride;
    let next = grid.base + (1u - level) * stride;
    let foam = grid.base + 3u * stride;
    let ground = grid.base / 2u;
    let last = grid_dispatch.substep + 1u == grid.substeps;
    let cells_a = unwrap(vec4<u32>(4u * column) + vec4<u32>(0u, 1u, 2u, 3u), grid.corner.x, torus.x);
    let cells_b = unwrap(vec4<u32>(4u * column + 4u) + vec4<u32>(0u, 1u, 2u, 3u), grid.corner.x, torus.x);

    var s = read_heights(now + south * columns, west, column, east);
    var c = read_heights(now + first_row * columns, west, column, east);
    var ground_s: Wide;
    var ground_c: Wide;
    var ground_n: Wide;
    if MIXED {
        ground_s = read_ground(ground + south * columns, west, column, east);
        ground_c = read_ground(ground + first_row * columns, west, column, east);
    }
    var a: Own;
    var b: Own;
    a.i = cells_a;
    b.i = cells_b;
    if LAYER {
        a.pz_north = grid_memory[now + 2u * stride + first_row * columns + column];
        b.pz_north = grid_memory[now + 2u * stride + first_row * columns + column + 1u];
    }
    for (var k = 0u; k < rows; k++) {
        let row = first_row + k;
        let north = select(row + 1u, 0u, row + 1u == torus.y) * columns;
        let at = row * columns + column;
        let n = read_heights(now + north, west, column, east);
        a.j = unwrap(vec4<u32>(row), grid.corner.y, torus.y).x;
        b.j = a.j;
        a.old = grid_heights[next + at];
        b.old = grid_heights[next + at + 1u];
        if MIXED {
            ground_n = read_ground(ground + north, west, column, east);
            a.r = grid_ground[ground + stride + at];
            b.r = grid_ground[ground + stride + at + 1u];
        }
        if LAYER {
            a.px = grid_memory[now + at];
            b.px = grid_memory[now + at + 1u];
            a.px_east = vec4<f32>(a.px.yzw, b.px.x);
            b.px_east = vec4<f32>(b.px.yzw, grid_memory[now + row * columns + east].x);
            a.pz = a.pz_north;
            b.pz = b.pz_north;
            a.pz_north = grid_memory[now + 2u * stride + north + column];
            b.pz_north = grid_memory[now + 2u * stride + north + column + 1u];
        }
        if LAST {
            a.foam = grid_heights[foam + at];
            b.foam = grid_heights[foam + at + 1u];
        }
        let to_a = advance(grid, s.a, c.a, n.a, ground_s.a, ground_c.a, ground_n.a, a);
        let to_b = advance(grid, s.b, c.b, n.b, ground_s.b, ground_c.b, ground_n.b, b);
        grid_heights[next + at] = to_a.z;
        grid_heights[next + at + 1u] = to_b.z;
        if LAYER {
            grid_memory[next + at] = to_a.px;
            grid_memory[next + at + 1u] = to_b.px;
            grid_memory[next + 2u * stride + at] = to_a.pz;
            grid_memory[next + 2u * stride + at + 1u] = to_b.pz;
        }
        if LAST {
            grid_heights[foam + at] = select(a.foam, to_a.foam, vec4<bool>(last));
            grid_heights[foam + at + 1u] = select(b.foam, to_b.foam, vec4<bool>(last));
        }
        s = c;
        c = n;
        if MIXED {
            ground_s = ground_c;
            ground_c = ground_n;
        }
    }
}

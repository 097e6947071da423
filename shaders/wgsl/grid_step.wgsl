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
    let listed = number < grid_counts[grid_dispatch.work + 3u];
    let entry = grid_list[select(0u, grid_dispatch.first + number, listed)];
    let tile = entry.x;
    let grid = grid_params[tile >> 16u];
    // Threads beyond the list, or of a grid with fewer sub-steps, walk no row.
    let rows = select(0u, ROWS, listed && grid_dispatch.substep < grid.substeps);
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
    let now_kept = grid.base + 2u * stride;
    let foam = grid.base + 3u * stride;
    let foamy = (entry.w & FOAMED) != 0u;
    let ground = grid.base / 2u;
    let keeps = grid_dispatch.substep == 0u && (entry.w & PREPARED) == 0u;
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
    var highest = vec4<f32>(0.0);
    var foamiest = vec4<f32>(0.0);
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
        if keeps {
            grid_heights[now_kept + at] = c.a.here;
            grid_heights[now_kept + at + 1u] = c.b.here;
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
            highest = max(max(highest, max(abs(c.a.here), abs(c.b.here))), max(abs(to_a.z), abs(to_b.z)));
            // Most tiles have no foam and get none.
            if last && (foamy || any(max(to_a.breaking, to_b.breaking) > vec4<f32>(0.0))) {
                let foam_a = to_a.keep * grid_heights[foam + at] + to_a.breaking * grid.foam_growth;
                let foam_b = to_b.keep * grid_heights[foam + at + 1u] + to_b.breaking * grid.foam_growth;
                grid_heights[foam + at] = min(foam_a, vec4<f32>(1.0));
                grid_heights[foam + at + 1u] = min(foam_b, vec4<f32>(1.0));
                foamiest = max(foamiest, max(foam_a, foam_b));
            }
        }
        s = c;
        c = n;
        if MIXED {
            ground_s = ground_c;
            ground_c = ground_n;
        }
    }
    if LAST {
        let waves = select(0u, BUSY, any(highest > vec4<f32>(QUIET_HEIGHT)));
        let foams = select(0u, FOAMED, any(foamiest > vec4<f32>(0.0)));
        let marks = waves | foams | select(0u, BUSY, any(foamiest > vec4<f32>(QUIET_FOAM)));
        if last && marks != 0u {
            let tiles = torus / TILE;
            atomicOr(&grid_marks[marks_of(grid, 0u) + ((tile >> 8u) & 0xffu) * tiles.x + (tile & 0xffu)], marks);
        }
    }
}

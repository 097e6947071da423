// One sub-step of dispersive grids: phi and chi over the older level, heights too. Threads share the tiles as in grid_step.
// Tiles of open water of one depth stand in a list, others in the next, with workgroups of their own: a software adapter
// walks a loop that none of a vector's threads takes once.
override THREADS: u32 = 64u;

@group(1) @binding(3) var<storage, read> grid_list: array<vec4<u32>>;
@group(1) @binding(4) var<storage, read> grid_counts: array<u32>;
@group(1) @binding(5) var<storage, read_write> grid_marks: array<atomic<u32>>;

// What flows into the cells of field k.
fn flow_of(k: u32, u: Rows, w: Faces, layer: Layer, far: ptr<function, vec4<f32>>, south: ptr<function, Pair>) -> Pair {
    let jumps = stretch_jumps(k, jumps_of(u), layer, far, south);
    let across = Damp(layer.across.keep.zzzz, layer.across.gain.zzzz);
    let x = stretch_flow(k, layer.slots.x, layer.fresh.x, along_x(jumps, w), layer.node_a, layer.node_b, layer);
    let z = stretch_flow(k, layer.slots.y, layer.fresh.y, along_z(jumps, w), across, across, layer);
    return Pair(x.a + z.a, x.b + z.b);
}

// The layer, beds and walls.
fn step_general(s: Strip, rows: u32, first: Found) -> Found {
    let cells = s.grid.cells;
    let mixed = MIXED && (s.entry.w & MIXED_TILE) != 0u;
    let i_a = unwrap(vec4<u32>(4u * s.column) + vec4<u32>(0u, 1u, 2u, 3u), s.grid.corner.x, s.grid.torus.x);
    let i_b = unwrap(vec4<u32>(4u * s.column + 4u) + vec4<u32>(0u, 1u, 2u, 3u), s.grid.corner.x, s.grid.torus.x);
    let columns_a = (i_a > vec4<u32>(0u)) & (i_a + 1u < vec4<u32>(cells.x));
    let columns_b = (i_b > vec4<u32>(0u)) & (i_b + 1u < vec4<u32>(cells.x));
    var layer = layer_of(s, i_a, i_b);
    var edge_p = first_edges(0u, layer);
    var edge_1 = first_edges(1u, layer);
    var edge_2 = first_edges(2u, layer);
    var edge_3 = first_edges(3u, layer);
    var found = first;
    var walk = walk_from(s);
    let ground = s.grid.base / 2u;
    if LAST && mixed {
        let south = select(s.first_row - 1u, s.grid.torus.y - 1u, s.first_row == 0u) * s.columns;
        walk.a.s = read_ground(ground + south, s.west, s.column, s.east);
        walk.a.c = read_ground(ground + s.first_row * s.columns, s.west, s.column, s.east);
    }
    for (var k = 0u; k < rows; k++) {
        let row = s.first_row + k;
        let at = row * s.columns + s.column;
        let north = select(row + 1u, 0u, row + 1u == s.grid.torus.y) * s.columns;
        look_north(&walk, s, row, north);
        let j = unwrap(vec4<u32>(row), s.grid.corner.y, s.grid.torus.y).x;
        let row_open = vec4<bool>(j > 0u && j + 1u < cells.y);
        layer.across = damp(f32(j) + vec4<f32>(-0.5, 0.5, 0.0, 0.0), cells.y, s.water.peaks.zw, s.water);
        layer.ends = k + 1u == ROWS;
        let after = layer.slots.x + 2u * FIELDS * TILE_THREADS + 2u * (s.row_in_tile + k) + s.half;
        var far = vec4<f32>(0.0);
        if layer.slots.x != NO_SLOT {
            far = remembered(after, layer.fresh.x);
        }
        var bed = even_bed(s.water);
        if mixed {
            if LAST {
                walk.a.n = read_ground(ground + north, s.west, s.column, s.east);
            }
            bed = read_bed(s.grid, s.water, at, row * s.columns + s.east, north + s.column);
        }
        let flow = Flows(
            flow_of(0u, walk.p, bed.w_p, layer, &far, &edge_p), flow_of(1u, walk.x1, bed.w_1, layer, &far, &edge_1),
            flow_of(2u, walk.x2, bed.w_2, layer, &far, &edge_2), flow_of(3u, walk.x3, bed.w_3, layer, &far, &edge_3));
        if layer.slots.x != NO_SLOT {
            grid_fields[after] = far;
        }
        layer.at += TILE / 4u;
        let open = Open(
            columns_a & row_open & (bed.damp.a > vec4<f32>(0.0)), columns_b & row_open & (bed.damp.b > vec4<f32>(0.0)),
            stays(i_a, j, cells, s.water.left), stays(i_b, j, cells, s.water.left));
        found = finish_row(s, walk, at, flow, bed, open, found);
        walk = walk_north(walk);
    }
    return found;
}

@compute @workgroup_size(THREADS)
fn grid_water_step(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let parts = 2u * TILE / ROWS;
    let tiles = THREADS / parts;
    let open = grid_counts[grid_dispatch.work + 3u];
    let open_groups = (open + tiles - 1u) / tiles;
    let general = group.x >= open_groups;
    let number = select(group.x, group.x - open_groups, general) * tiles + local / parts;
    let listed = number < select(open, grid_counts[grid_dispatch.work + 7u], general);
    let first = grid_dispatch.first + select(0u, grid_dispatch.count, general);
    let strip = strip_of(grid_list[select(grid_dispatch.first, first + number, listed)], local % parts);
    let grid = strip.grid;
    // Threads beyond the list, or of a grid with fewer sub-steps, walk no row.
    let rows = select(0u, ROWS, listed && grid_dispatch.substep < grid.substeps);
    var found = Found(vec4<f32>(0.0), vec4<f32>(0.0));
    found = step_open(strip, select(rows, 0u, general), found);
    found = step_general(strip, select(0u, rows, general), found);
    if LAST {
        let waves = select(0u, BUSY, any(found.height > vec4<f32>(QUIET_HEIGHT)));
        let foams = select(0u, FOAMED, any(found.foam > vec4<f32>(0.0)));
        let marks = waves | foams | select(0u, BUSY, any(found.foam > vec4<f32>(QUIET_FOAM)));
        if grid_dispatch.substep + 1u == grid.substeps && marks != 0u {
            let at = vec2<u32>(strip.entry.x & 0xffu, (strip.entry.x >> 8u) & 0xffu);
            atomicOr(&grid_marks[marks_of(grid, 0u) + at.y * (grid.torus.x / TILE) + at.x], marks);
        }
    }
}

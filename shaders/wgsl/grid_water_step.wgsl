// One sub-step of dispersive grids: phi and chi over the older level, heights too. Threads share the tiles as in grid_step.
override ROWS: u32 = 1u;
override THREADS: u32 = 64u;
override LAST: bool = true;

@group(1) @binding(3) var<storage, read> grid_list: array<vec4<u32>>;
@group(1) @binding(4) var<storage, read> grid_counts: array<u32>;
@group(1) @binding(5) var<storage, read_write> grid_marks: array<atomic<u32>>;

// What flows into the cells of field k.
fn flow(k: u32, u: Rows, w: Faces, layer: Layer, far: ptr<function, vec4<f32>>, south: ptr<function, Pair>) -> Pair {
    let jumps = stretch_jumps(k, jumps_of(u), layer, far, south);
    let across = Damp(layer.across.keep.zzzz, layer.across.gain.zzzz);
    let x = stretch_flow(k, layer.slots.x, layer.fresh.x, along_x(jumps, w), layer.node_a, layer.node_b, layer);
    let z = stretch_flow(k, layer.slots.y, layer.fresh.y, along_z(jumps, w), across, across, layer);
    return Pair(x.a + z.a, x.b + z.b);
}

@compute @workgroup_size(THREADS)
fn grid_water_step(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let parts = 2u * TILE / ROWS;
    let number = group.x * (THREADS / parts) + local / parts;
    let part = local % parts;
    let listed = number < grid_counts[grid_dispatch.work + 3u];
    let entry = grid_list[select(0u, grid_dispatch.first + number, listed)];
    let tile = entry.x;
    let grid = grid_params[tile >> 16u];
    let water = grid_water[tile >> 16u];
    // Threads beyond the list, or of a grid with fewer sub-steps, walk no row.
    let rows = select(0u, ROWS, listed && grid_dispatch.substep < grid.substeps);
    let columns = grid.torus.x / 4u;
    let column = (tile & 0xffu) * (TILE / 4u) + part % 2u * 2u;
    let row_in_tile = part / 2u * ROWS;
    let first_row = ((tile >> 8u) & 0xffu) * TILE + row_in_tile;
    let west = select(column - 1u, columns - 1u, column == 0u);
    let east = select(column + 2u, 0u, column + 2u == columns);
    let south = select(first_row - 1u, grid.torus.y - 1u, first_row == 0u) * columns;
    let here = first_row * columns;

    let stride = grid.stride;
    let level = (grid.parity + grid_dispatch.substep) & 1u;
    let now = vec4<u32>(grid.base, grid.base + 2u * stride, water.fields, water.fields + 2u * stride) + level * stride;
    let next = vec4<u32>(grid.base, grid.base + 2u * stride, water.fields, water.fields + 2u * stride) + (1u - level) * stride;
    let heights = grid.base;
    let foamy = (entry.w & FOAMED) != 0u;
    let keeps = grid_dispatch.substep == 0u && (entry.w & PREPARED) == 0u;
    let last = grid_dispatch.substep + 1u == grid.substeps;
    let i_a = unwrap(vec4<u32>(4u * column) + vec4<u32>(0u, 1u, 2u, 3u), grid.corner.x, grid.torus.x);
    let i_b = unwrap(vec4<u32>(4u * column + 4u) + vec4<u32>(0u, 1u, 2u, 3u), grid.corner.x, grid.torus.x);
    let columns_a = (i_a > vec4<u32>(0u)) & (i_a + 1u < vec4<u32>(grid.cells.x));
    let columns_b = (i_b > vec4<u32>(0u)) & (i_b + 1u < vec4<u32>(grid.cells.x));

    var layer = layer_of(grid, water, entry, i_a, i_b, part % 2u, row_in_tile);
    var edge_p = first_edges(0u, layer);
    var edge_1 = first_edges(1u, layer);
    var edge_2 = first_edges(2u, layer);
    var edge_3 = first_edges(3u, layer);
    var p: Rows;
    var x1: Rows;
    var x2: Rows;
    var x3: Rows;
    p.s = read_memory(now.x + south, west, column, east);
    p.c = read_memory(now.x + here, west, column, east);
    x1.s = read_memory(now.y + south, west, column, east);
    x1.c = read_memory(now.y + here, west, column, east);
    x2.s = read_fields(now.z + south, west, column, east);
    x2.c = read_fields(now.z + here, west, column, east);
    x3.s = read_fields(now.w + south, west, column, east);
    x3.c = read_fields(now.w + here, west, column, east);
    let ground = grid.base / 2u;
    var ground_s: Wide;
    var ground_c: Wide;
    var ground_n: Wide;
    if LAST && MIXED && (entry.w & MIXED_TILE) != 0u {
        ground_s = read_ground(ground + south, west, column, east);
        ground_c = read_ground(ground + here, west, column, east);
    }
    var z: Rows;
    if LAST {
        z.s = read_heights(heights + level * stride + south, west, column, east);
        z.c = read_heights(heights + level * stride + here, west, column, east);
    }
    var highest = vec4<f32>(0.0);
    var foamiest = vec4<f32>(0.0);
    for (var k = 0u; k < rows; k++) {
        let row = first_row + k;
        let at = row * columns + column;
        let north = select(row + 1u, 0u, row + 1u == grid.torus.y) * columns;
        p.n = read_memory(now.x + north, west, column, east);
        x1.n = read_memory(now.y + north, west, column, east);
        x2.n = read_fields(now.z + north, west, column, east);
        x3.n = read_fields(now.w + north, west, column, east);
        if LAST {
            z.n = read_heights(heights + level * stride + north, west, column, east);
        } else {
            z.c.a.here = grid_heights[heights + level * stride + at];
            z.c.b.here = grid_heights[heights + level * stride + at + 1u];
        }
        let j = unwrap(vec4<u32>(row), grid.corner.y, grid.torus.y).x;
        let row_open = vec4<bool>(j > 0u && j + 1u < grid.cells.y);
        layer.across = damp(f32(j) + vec4<f32>(-0.5, 0.5, 0.0, 0.0), grid.cells.y, water.peaks.zw, water);
        layer.ends = k + 1u == ROWS;
        let after = layer.slots.x + 2u * FIELDS * TILE_THREADS + 2u * (row_in_tile + k) + part % 2u;
        var far = vec4<f32>(0.0);
        if layer.slots.x != NO_SLOT {
            far = remembered(after, layer.fresh.x);
        }
        var bed = even_bed(water);
        if MIXED {
            if (entry.w & MIXED_TILE) != 0u {
                if LAST {
                    ground_n = read_ground(ground + north, west, column, east);
                }
                bed = read_bed(grid, water, at, row * columns + east, north + column);
            }
        }
        let flow_p = flow(0u, p, bed.w_p, layer, &far, &edge_p);
        let flow_1 = flow(1u, x1, bed.w_1, layer, &far, &edge_1);
        let flow_2 = flow(2u, x2, bed.w_2, layer, &far, &edge_2);
        let flow_3 = flow(3u, x3, bed.w_3, layer, &far, &edge_3);
        if layer.slots.x != NO_SLOT {
            grid_fields[after] = far;
        }
        layer.at += TILE / 4u;
        let open_a = columns_a & row_open & (bed.damp.a > vec4<f32>(0.0));
        let open_b = columns_b & row_open & (bed.damp.b > vec4<f32>(0.0));
        let none = vec4<f32>(0.0);
        let to_a = advance(
            water, z.c.a.here, Fields(p.c.a.here, x1.c.a.here, x2.c.a.here, x3.c.a.here),
            Fields(none, grid_memory[next.y + at], grid_fields[next.z + at], grid_fields[next.w + at]),
            Fields(flow_p.a, flow_1.a, flow_2.a, flow_3.a), bed.m_a, bed.damp.a, open_a,
            stays(i_a, j, grid.cells, water.left));
        let to_b = advance(
            water, z.c.b.here, Fields(p.c.b.here, x1.c.b.here, x2.c.b.here, x3.c.b.here),
            Fields(none, grid_memory[next.y + at + 1u], grid_fields[next.z + at + 1u], grid_fields[next.w + at + 1u]),
            Fields(flow_p.b, flow_1.b, flow_2.b, flow_3.b), bed.m_b, bed.damp.b, open_b,
            stays(i_b, j, grid.cells, water.left));
        if keeps {
            grid_heights[heights + 2u * stride + at] = z.c.a.here;
            grid_heights[heights + 2u * stride + at + 1u] = z.c.b.here;
        }
        store_next(at, heights + (1u - level) * stride, next, to_a);
        store_next(at + 1u, heights + (1u - level) * stride, next, to_b);
        if LAST {
            highest = max(max(highest, max(abs(z.c.a.here), abs(z.c.b.here))), max(abs(to_a.z), abs(to_b.z)));
            let foam = heights + 3u * stride + at;
            let w = bed.w_p;
            let mixed = (entry.w & MIXED_TILE) != 0u;
            let of_a = foam_of(
                grid, mixed, z.s.a, z.c.a, z.n.a, to_a.z, ground_s.a.here, ground_c.a, ground_n.a.here,
                Fluxes(w.x.a, vec4<f32>(w.x.a.yzw, w.x.b.x), w.s.a, w.n.a), open_a);
            let of_b = foam_of(
                grid, mixed, z.s.b, z.c.b, z.n.b, to_b.z, ground_s.b.here, ground_c.b, ground_n.b.here,
                Fluxes(w.x.b, vec4<f32>(w.x.b.yzw, w.far), w.s.b, w.n.b), open_b);
            // Most tiles have no foam and get none.
            if last && (foamy || any(max(of_a.breaking, of_b.breaking) > none)) {
                let foam_a = of_a.keep * grid_heights[foam] + of_a.breaking * grid.foam_growth;
                let foam_b = of_b.keep * grid_heights[foam + 1u] + of_b.breaking * grid.foam_growth;
                grid_heights[foam] = min(foam_a, vec4<f32>(1.0));
                grid_heights[foam + 1u] = min(foam_b, vec4<f32>(1.0));
                foamiest = max(foamiest, max(foam_a, foam_b));
            }
            z.s = z.c;
            z.c = z.n;
            if MIXED {
                ground_s = ground_c;
                ground_c = ground_n;
            }
        }
        p.s = p.c;
        p.c = p.n;
        x1.s = x1.c;
        x1.c = x1.n;
        x2.s = x2.c;
        x2.c = x2.n;
        x3.s = x3.c;
        x3.c = x3.n;
    }
    if LAST {
        let waves = select(0u, BUSY, any(highest > vec4<f32>(QUIET_HEIGHT)));
        let foams = select(0u, FOAMED, any(foamiest > vec4<f32>(0.0)));
        let marks = waves | foams | select(0u, BUSY, any(foamiest > vec4<f32>(QUIET_FOAM)));
        if last && marks != 0u {
            let tiles = grid.torus / TILE;
            atomicOr(&grid_marks[marks_of(grid, 0u) + ((tile >> 8u) & 0xffu) * tiles.x + (tile & 0xffu)], marks);
        }
    }
}

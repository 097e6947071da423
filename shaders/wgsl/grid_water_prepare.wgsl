// The start of a tick in tiles of dispersive grids that moved, end, or have sources: as grid_prepare, for phi, chi and what
// the layer remembers too.
override ROWS: u32 = 1u;

@group(1) @binding(3) var<storage, read> grid_list: array<vec4<u32>>;
@group(1) @binding(4) var<storage, read> grid_sources: array<GridSource>;

struct GridSource {
    center: vec2<f32>,
    outer: f32,
    height: f32,
    foam: f32,
    stretch: f32,
    kick: f32,
    pad: f32,
}

fn keep_field(at: u32, keep: vec4<bool>) {
    grid_fields[at] = select(vec4<f32>(0.0), grid_fields[at], keep);
}

// Forgets what the layer remembers where cells entered the window, and of edges and cells that no step reads: what stands in
// the outermost cells would come back. `open` tells that a cell is not one of these along an axis, `nodes` that it is none
// and was none; what was remembered of the edges at the window's ends is of cells beside on the torus, not in the window.
fn keep_slots(
    slots: vec2<u32>, local: u32, held: vec4<bool>, nodes: vec4<bool>, open_x: vec4<bool>, open_z: bool,
    first: vec4<bool>, first_z: bool, last_z: bool, was: vec4<i32>, was_z: i32, cells: vec2<u32>,
) {
    let row = local / (TILE / 4u);
    if slots.x != NO_SLOT {
        for (var k = 0u; k < FIELDS; k++) {
            keep_field(slots.x + k * TILE_THREADS + local, held & !first & (was > vec4<i32>(0)) & vec4<bool>(open_z));
            keep_field(slots.x + (FIELDS + k) * TILE_THREADS + local, nodes);
        }
        if local % 2u == 1u {
            // The edge after a cell, which for the window's last there is not.
            let after = held.w && (open_x.w || first.w) && open_z && was.w + 1 < i32(cells.x);
            keep_field(slots.x + 2u * FIELDS * TILE_THREADS + local / 2u, vec4<bool>(after));
        }
    }
    if slots.y != NO_SLOT {
        for (var k = 0u; k < FIELDS; k++) {
            keep_field(slots.y + k * TILE_THREADS + local, held & open_x & vec4<bool>(!first_z && was_z > 0));
            keep_field(slots.y + (FIELDS + k) * TILE_THREADS + local, nodes);
        }
        if (row + 1u) % ROWS == 0u {
            let beyond = slots.y + 2u * FIELDS * TILE_THREADS + row / ROWS * FIELDS * (TILE / 4u) + local % (TILE / 4u);
            for (var k = 0u; k < FIELDS; k++) {
                keep_field(beyond + k * (TILE / 4u), held & open_x & vec4<bool>(!last_z && was_z + 1 < i32(cells.y)));
            }
        }
    }
}

@compute @workgroup_size(TILE_THREADS)
fn grid_water_prepare(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let entry = grid_list[grid_dispatch.first + group.x];
    let tile = entry.x;
    let ending = (entry.w & ENDING) != 0u;
    let grid = &grid_params[tile >> 16u];
    let water = &grid_water[tile >> 16u];
    let cells = (*grid).cells;
    let at = place_of(tile, local, (*grid).corner, (*grid).torus);
    let offset = at.row * ((*grid).torus.x / 4u) + at.column;
    let stride = (*grid).stride;
    let first = (*grid).base + offset;
    let now_at = first + (*grid).parity * stride;
    let old_at = first + (1u - (*grid).parity) * stride;
    let foam_at = first + 3u * stride;

    let stood = vec4<bool>((*grid).moved == STOOD);
    let was = vec4<i32>(at.i) + vec4<i32>((*grid).shift.x);
    let was_row = i32(at.j) + (*grid).shift.y;
    let row_held = (*grid).moved == SHIFTED && at.j < cells.y && was_row >= 0 && was_row < i32(cells.y);
    let held = (at.i < vec4<u32>(cells.x)) & (was >= vec4<i32>(0)) & (was < vec4<i32>(i32(cells.x))) & vec4<bool>(row_held);
    let inner = held & (at.i > vec4<u32>(0u)) & (at.i < vec4<u32>(cells.x - 1u)) & vec4<bool>(at.j > 0u && at.j < cells.y - 1u);
    let open = (inner | (held & stays(at.i, at.j, cells, (*water).kept)) | stood) & vec4<bool>(!ending);
    var now = select(vec4<f32>(0.0), grid_heights[now_at], inner | stood);
    var old = select(vec4<f32>(0.0), grid_heights[old_at], inner | stood);
    var foam = select(vec4<f32>(0.0), grid_heights[foam_at], held | stood);
    var phi = select(vec4<f32>(0.0), grid_memory[now_at], open);
    for (var k = 0u; k < 4u; k++) {
        grid_memory[first + k * stride] = select(vec4<f32>(0.0), grid_memory[first + k * stride], open);
        keep_field((*water).fields + offset + k * stride, open);
    }
    if (*grid).moved != STOOD {
        let open_x = (at.i > vec4<u32>(0u)) & (at.i < vec4<u32>(cells.x - 1u));
        let open_z = at.j > 0u && at.j < cells.y - 1u;
        let slots = slots_of(*grid, *water, tile, entry.w);
        let was_open = (was > vec4<i32>(0)) & (was < vec4<i32>(i32(cells.x) - 1)) & vec4<bool>(was_row > 0 && was_row < i32(cells.y) - 1);
        keep_slots(slots, local, held, inner & was_open, open_x, open_z, at.i == vec4<u32>(0u), at.j == 0u, at.j == cells.y - 1u,
            was, was_row, cells);
    }
    grid_heights[first + 2u * stride] = select(now, vec4<f32>(0.0), ending);

    // Sources are written into open water only.
    let inside = (at.i < vec4<u32>(cells.x)) & vec4<bool>(at.j < cells.y)
        & (vec4<bool>((entry.w & MIXED_TILE) == 0u) | (grid_ground[(*grid).base / 2u + stride + offset] > vec4<f32>(0.0)));
    for (var s = entry.y; s < entry.y + entry.z; s++) {
        let source = grid_sources[s];
        let dx = vec4<f32>(at.i) + 0.5 - source.center.x;
        let dz = source.stretch * (f32(at.j) + 0.5 - source.center.y);
        let t = clamp((source.outer - sqrt(dx * dx + dz * dz)) / source.outer, vec4<f32>(0.0), vec4<f32>(1.0));
        let weight = select(vec4<f32>(0.0), t * t * (3.0 - 2.0 * t), inside);
        now = clamp(now + weight * source.height, vec4<f32>(-HEIGHT_LIMIT), vec4<f32>(HEIGHT_LIMIT));
        old = clamp(old + weight * source.height, vec4<f32>(-HEIGHT_LIMIT), vec4<f32>(HEIGHT_LIMIT));
        foam = min(foam + weight * source.foam, vec4<f32>(1.0));
        phi = clamp(phi - weight * source.kick, vec4<f32>(-HEIGHT_LIMIT), vec4<f32>(HEIGHT_LIMIT));
    }
    grid_memory[now_at] = select(phi, vec4<f32>(0.0), ending);
    grid_heights[now_at] = select(now, vec4<f32>(0.0), ending);
    grid_heights[old_at] = select(old, vec4<f32>(0.0), ending);
    grid_heights[foam_at] = select(foam, vec4<f32>(0.0), ending);
}

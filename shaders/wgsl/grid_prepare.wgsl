// The start of a tick in tiles that moved, end, or have sources: what entered the window is calm, the heights of the last
// tick are kept for drawing, sources are written into z and z_old. Each thread touches its own four cells only.
override MOVED: bool = true;
override MEDIUM: bool = true;

@compute @workgroup_size(TILE_THREADS)
fn grid_prepare(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let entry = grid_list[grid_dispatch.first + group.x];
    let tile = entry.x;
    let ending = (entry.w & ENDING) != 0u;
    let grid = &grid_params[tile >> 16u];
    let cells = (*grid).cells;
    let at = place_of(tile, local, (*grid).corner, (*grid).torus);
    let offset = at.row * ((*grid).torus.x / 4u) + at.column;
    let stride = (*grid).stride;
    let first = (*grid).base + offset;
    let now_at = first + (*grid).parity * stride;
    let old_at = first + (1u - (*grid).parity) * stride;
    let foam_at = first + 3u * stride;
    var now = grid_heights[now_at];
    var old = grid_heights[old_at];
    var foam = grid_heights[foam_at];

    if MOVED {
        let w = (*grid).thickness;
        let stood = (*grid).moved == STOOD;
        let was = vec4<i32>(at.i) + vec4<i32>((*grid).shift.x);
        let was_row = i32(at.j) + (*grid).shift.y;
        let row_held = (*grid).moved == SHIFTED && at.j < cells.y && was_row >= 0 && was_row < i32(cells.y);
        let held = (at.i < vec4<u32>(cells.x)) & (was >= vec4<i32>(0)) & (was < vec4<i32>(i32(cells.x))) & vec4<bool>(row_held);
        let open = held & (at.i > vec4<u32>(0u)) & (at.i < vec4<u32>(cells.x - 1u)) & vec4<bool>(at.j > 0u && at.j < cells.y - 1u);
        now = select(vec4<f32>(0.0), now, open | vec4<bool>(stood));
        old = select(vec4<f32>(0.0), old, open | vec4<bool>(stood));
        foam = select(vec4<f32>(0.0), foam, held | vec4<bool>(stood));
        // phi that left the layer would never decay.
        let free_x = (at.i > vec4<u32>(w)) & (at.i < vec4<u32>(cells.x - w)) & vec4<bool>(at.j >= w && at.j < cells.y - w);
        let free_z = (at.i >= vec4<u32>(w)) & (at.i < vec4<u32>(cells.x - w)) & vec4<bool>(at.j > w && at.j < cells.y - w);
        let keep_x = (held & !free_x) | vec4<bool>(stood);
        let keep_z = (held & !free_z) | vec4<bool>(stood);
        grid_memory[first] = select(vec4<f32>(0.0), grid_memory[first], keep_x);
        grid_memory[first + stride] = select(vec4<f32>(0.0), grid_memory[first + stride], keep_x);
        grid_memory[first + 2u * stride] = select(vec4<f32>(0.0), grid_memory[first + 2u * stride], keep_z);
        grid_memory[first + 3u * stride] = select(vec4<f32>(0.0), grid_memory[first + 3u * stride], keep_z);
    }
    grid_heights[first + 2u * stride] = select(now, vec4<f32>(0.0), ending);

    var inside = (at.i < vec4<u32>(cells.x)) & vec4<bool>(at.j < cells.y);
    if MEDIUM {
        // Sources are written into open water only.
        let r = grid_ground[(*grid).base / 2u + stride + offset];
        inside = inside & (vec4<bool>((entry.w & MIXED_TILE) == 0u) | (r > vec4<f32>(0.0)));
    }
    for (var s = entry.y; s < entry.y + entry.z; s++) {
        let source = grid_sources[s];
        let dx = vec4<f32>(at.i) + 0.5 - source.center.x;
        let dz = source.stretch * (f32(at.j) + 0.5 - source.center.y);
        let t = clamp((source.outer - sqrt(dx * dx + dz * dz)) / source.outer, vec4<f32>(0.0), vec4<f32>(1.0));
        let weight = select(vec4<f32>(0.0), t * t * (3.0 - 2.0 * t), inside);
        now = clamp(now + weight * source.height, vec4<f32>(-HEIGHT_LIMIT), vec4<f32>(HEIGHT_LIMIT));
        old = clamp(old + weight * source.height, vec4<f32>(-HEIGHT_LIMIT), vec4<f32>(HEIGHT_LIMIT));
        foam = min(foam + weight * source.foam, vec4<f32>(1.0));
    }
    grid_heights[now_at] = select(now, vec4<f32>(0.0), ending);
    grid_heights[old_at] = select(old, vec4<f32>(0.0), ending);
    grid_heights[foam_at] = select(foam, vec4<f32>(0.0), ending);
    if ending {
        for (var k = 0u; k < 4u; k++) {
            grid_memory[first + k * stride] = vec4<f32>(0.0);
        }
    }
}

// Stores the listed cells' medium. What is no open water is stilled, for walls the layer's memory
// included.
@compute @workgroup_size(MEDIUM_THREADS)
fn grid_medium(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= grid_dispatch.count {
        return;
    }
    let cell = grid_cells[grid_dispatch.first + id.x];
    let grid = &grid_params[cell.place >> 24u];
    let at = cell.place & 0xffffffu;
    let stride = (*grid).stride;
    let first = (*grid).base + at / 4u;
    let part = at % 4u;
    let ground = (*grid).base / 2u + at / 4u;
    grid_ground[ground][part] = cell.a;
    grid_ground[ground + stride][part] = cell.r;
    if cell.r == 0.0 {
        for (var k = 0u; k < 4u; k++) {
            grid_heights[first + k * stride][part] = 0.0;
        }
    }
    // Water flows through the faces of held water.
    if cell.a <= 0.0 {
        for (var k = 0u; k < 4u; k++) {
            grid_memory[first + k * stride][part] = 0.0;
        }
    }
}

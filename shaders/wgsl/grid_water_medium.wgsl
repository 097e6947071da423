struct GridWaterCell {
    // c, s_1, s_2, s_3 of the face before it along x and along z.
    along: vec4<f32>,
    across: vec4<f32>,
    // m of each chi.
    m: vec3<f32>,
    // As in GridCell.
    a: f32,
    r: f32,
    place: u32,
    pad_x: u32,
    pad_y: u32,
}

@group(1) @binding(3) var<storage, read> grid_water_cells: array<GridWaterCell>;

// Stores the listed cells' medium; what is no open water is stilled.
@compute @workgroup_size(MEDIUM_THREADS)
fn grid_water_medium(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= grid_dispatch.count {
        return;
    }
    let cell = grid_water_cells[grid_dispatch.first + id.x];
    let slot = cell.place >> 24u;
    let grid = &grid_params[slot];
    let water = &grid_water[slot];
    let at = cell.place & 0xffffffu;
    let part = at % 4u;
    let stride = (*grid).stride;
    let ground = (*grid).base / 2u + at / 4u;
    grid_ground[ground][part] = cell.a;
    grid_ground[ground + stride][part] = cell.r;
    for (var k = 0u; k < FIELDS; k++) {
        grid_faces[(*water).faces + at / 4u + k * stride][part] = cell.along[k];
        grid_faces[(*water).faces + at / 4u + (k + FIELDS) * stride][part] = cell.across[k];
    }
    for (var k = 0u; k + 1u < FIELDS; k++) {
        grid_faces[(*water).faces + at / 4u + (k + 2u * FIELDS) * stride][part] = cell.m[k];
    }
    if cell.r == 0.0 {
        for (var k = 0u; k < 4u; k++) {
            grid_heights[(*grid).base + at / 4u + k * stride][part] = 0.0;
            grid_memory[(*grid).base + at / 4u + k * stride][part] = 0.0;
            grid_fields[(*water).fields + at / 4u + k * stride][part] = 0.0;
        }
    }
}

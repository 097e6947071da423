// What the passes of dispersive grids know of each besides GridParams; the scheme is that of wave-grid's dispersive.
struct GridWater {
    // c, s_1, s_2, s_3 of plain water.
    shares: vec4<f32>,
    // g dt^2 / h, r_1, r_2, r_3.
    rates: vec4<f32>,
    // 1 / (1 + sigma dt / 2), m_1, m_2, m_3 of plain water.
    gains: vec4<f32>,
    // sigma dt of the layer at the window's west, east, south and north side.
    peaks: vec4<f32>,
    // First vec4 in the fields: of chi_2, of the layer's slots along x and along z.
    fields: u32,
    slots_x: u32,
    slots_z: u32,
    // First vec4 of its faces.
    faces: u32,
    // Cells of the layer, and its shift of frequencies at the inner side times dt.
    width: u32,
    alpha: f32,
    // Sides whose outermost cells keep what they hold, bit k as of peaks: in a sub-step, and as the window shifts.
    left: u32,
    kept: u32,
}

@group(1) @binding(0) var<uniform> grid_water: array<GridWater, MAX_GRIDS>;
// Per grid chi_2, chi_2, chi_3, chi_3 (old and new by turns), then what its layer remembers; grid_memory holds phi, phi,
// chi_1, chi_1.
@group(1) @binding(1) var<storage, read_write> grid_fields: array<vec4<f32>>;
// Per grid c, s_1, s_2, s_3 of the face before each cell along x, then along z, and m of each chi.
@group(1) @binding(2) var<storage, read_write> grid_faces: array<vec4<f32>>;

// Whether cells are outermost ones of such sides only.
fn stays(i: vec4<u32>, j: u32, cells: vec2<u32>, sides: u32) -> vec4<bool> {
    let low = i == vec4<u32>(0u);
    let high = i + 1u == vec4<u32>(cells.x);
    let south = j == 0u;
    let north = j + 1u == cells.y;
    let off = (vec4<u32>(sides) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u);
    let on = (low & vec4<bool>(!off.x)) | (high & vec4<bool>(!off.y)) | vec4<bool>(south && !off.z) | vec4<bool>(north && !off.w);
    let inside = (i < vec4<u32>(cells.x)) & vec4<bool>(j < cells.y);
    return inside & (low | high | vec4<bool>(south || north)) & !on;
}

// First vec4 of a tile's slots along x and z, NO_SLOT outside the layer.
fn slots_of(grid: GridParams, water: GridWater, tile: u32, flags: u32) -> vec2<u32> {
    let at = vec2<u32>(tile & 0xffu, (tile >> 8u) & 0xffu);
    let slot = vec2<u32>((flags >> SLOT_X_BIT) & 0xffu, (flags >> SLOT_Z_BIT) & 0xffu);
    let tiles = grid.torus / TILE;
    let first = vec2<u32>(
        water.slots_x + (slot.x * tiles.y + at.y) * SLOT_X_VECTORS,
        water.slots_z + (slot.y * tiles.x + at.x) * SLOT_Z_VECTORS);
    return select(first, vec2<u32>(NO_SLOT), slot == vec2<u32>(0xffu));
}

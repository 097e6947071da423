struct GridParams {
    corner: vec2<u32>,
    cells: vec2<u32>,
    torus: vec2<u32>,
    shift: vec2<i32>,
    base: u32,
    stride: u32,
    parity: u32,
    substeps: u32,
    moved: u32,
    thickness: u32,
    exponent: u32,
    peak: f32,
    weights: vec2<f32>,
    damping: f32,
    foam_scale: f32,
    foam_onset: f32,
    foam_growth: f32,
    foam_keep: f32,
    deep: f32,
    foam_depth: f32,
    foam_splash: f32,
    peak_z: f32,
    aspect: f32,
    flip: u32,
    pad_x: u32,
    pad_y: u32,
    pad_z: u32,
}

struct GridDispatch {
    first: u32,
    substep: u32,
    count: u32,
    work: u32,
}

@group(0) @binding(0) var<uniform> grid_dispatch: GridDispatch;
@group(0) @binding(1) var<uniform> grid_params: array<GridParams, MAX_GRIDS>;
// Per grid: z, z (old and new by turns), z of the last tick, foam.
@group(0) @binding(2) var<storage, read_write> grid_heights: array<vec4<f32>>;
// Per grid: phi_x, phi_x, phi_z, phi_z (old and new by turns).
@group(0) @binding(3) var<storage, read_write> grid_memory: array<vec4<f32>>;
// Per grid: a, r; see wave-grid's ground.rs.
@group(0) @binding(4) var<storage, read_write> grid_ground: array<vec4<f32>>;

// Where the marks of a grid's tiles begin that are written (0) or read (1) in this tick.
fn marks_of(grid: GridParams, read: u32) -> u32 {
    let tiles = grid.torus / TILE;
    return grid.base / (TILE * TILE / 2u) + ((grid.flip + read) & 1u) * tiles.x * tiles.y;
}

// Where a thread's four cells stand.
struct Place {
    // vec4 on the torus along x, and row.
    column: u32,
    row: u32,
    // Window coordinates; cells beyond the window's extent are not in it.
    i: vec4<u32>,
    j: u32,
}

// Window coordinate of a torus coordinate.
fn unwrap(at: vec4<u32>, corner: u32, torus: u32) -> vec4<u32> {
    let x = at + vec4<u32>(torus - corner);
    return select(x, x - vec4<u32>(torus), x >= vec4<u32>(torus));
}

fn place_of(tile: u32, local: u32, corner: vec2<u32>, torus: vec2<u32>) -> Place {
    let column = (tile & 0xffu) * (TILE / 4u) + local % (TILE / 4u);
    let row = ((tile >> 8u) & 0xffu) * TILE + local / (TILE / 4u);
    let i = unwrap(vec4<u32>(4u * column) + vec4<u32>(0u, 1u, 2u, 3u), corner.x, torus.x);
    return Place(column, row, i, unwrap(vec4<u32>(row), corner.y, torus.y).x);
}

struct SurfaceGrid {
    corner: vec2<f32>,
    cell_size: vec2<f32>,
    cells: vec2<u32>,
    base: u32,
    pad: u32,
}

// The rasters of the land: local place of texel (0, 0), texel size, whether there are any, texels along x and z; and the
// level of still water above datum, which holds without them too.
struct SurfaceLand {
    corner: vec2<f32>,
    texel: f32,
    present: u32,
    size: vec2<u32>,
    level: f32,
    pad: f32,
}

struct SurfaceTable {
    cascade_count: u32,
    grid_count: u32,
    time: f32,
    significant_height: f32,
    hidden_slope: array<vec4<f32>, 4>,
    cascades: array<SurfaceCascade, MAX_CASCADES>,
    grids: array<SurfaceGrid, MAX_GRIDS>,
    land: SurfaceLand,
}

// Height, slope and foam of one grid at a world point: (height, dh/dx, dh/dz, foam). Zero outside its window.
fn grid_at(index: u32, point: vec2<f32>) -> vec4<f32> {
    let grid = surface_table.grids[index];
    let x = (point - grid.corner) / grid.cell_size - 0.5;
    let base = floor(x);
    // Two cells of margin: the fade has brought the height to zero there.
    if any(base < vec2<f32>(1.0)) || any(base > vec2<f32>(grid.cells) - 3.0) {
        return vec4<f32>(0.0);
    }
    let t = x - base;
    let wx = cubic_weights(t.x);
    let wz = cubic_weights(t.y);
    let dx = cubic_slopes(t.x) / grid.cell_size.x;
    let dz = cubic_slopes(t.y) / grid.cell_size.y;
    let first = vec2<u32>(base) - 1u;
    var sum = vec4<f32>(0.0);
    for (var j = 0u; j < 4u; j++) {
        let row = grid.base + (first.y + j) * grid.cells.x + first.x;
        for (var i = 0u; i < 4u; i++) {
            let v = surface_grids[row + i];
            sum += vec4<f32>(wx[i] * wz[j] * v.x, dx[i] * wz[j] * v.x, wx[i] * dz[j] * v.x, wx[i] * wz[j] * v.y);
        }
    }
    return sum;
}

// The same of all grids.
fn grids_at(point: vec2<f32>) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var g = 0u; g < surface_table.grid_count; g++) {
        sum += grid_at(g, point);
    }
    return sum;
}

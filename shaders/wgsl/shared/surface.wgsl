// A tiled grid stands for the whole plane: it repeats with its window less the outermost ring of cells, and fades with
// the distance from `middle`, to nothing at `reach`.
struct SurfaceGrid {
    corner: vec2<f32>,
    cell_size: vec2<f32>,
    cells: vec2<u32>,
    base: u32,
    gain: f32,
    middle: vec2<f32>,
    reach: f32,
    tiled: u32,
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

// A hull that is kept dry. The rows take a point, less `place`, into its raster: nodes along x and z, metres along y.
struct SurfaceDry {
    place: vec3<f32>,
    base: u32,
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    nodes: vec2<u32>,
    pad: vec2<u32>,
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
    dry_low: vec2<f32>,
    dry_high: vec2<f32>,
    dry_count: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
    dry: array<SurfaceDry, MAX_DRY>,
}

// Where a grid is read for a world point: cells from the first cell's centre, and how much of it counts there.
struct GridPlace {
    at: vec2<f32>,
    share: f32,
}

fn grid_place(grid: SurfaceGrid, point: vec2<f32>) -> GridPlace {
    let x = (point - grid.corner) / grid.cell_size - 0.5;
    if grid.tiled == 0u {
        return GridPlace(x, grid.gain);
    }
    let period = vec2<f32>(grid.cells) - 2.0;
    let fade = 1.0 - smoothstep(0.5 * grid.reach, grid.reach, distance(point, grid.middle));
    return GridPlace(x - floor((x - 1.0) / period) * period, grid.gain * fade);
}

// Whether `margin` cells around the four that hold a place are there to be read.
fn grid_holds(grid: SurfaceGrid, base: vec2<f32>, margin: f32) -> bool {
    return grid.tiled != 0u || (all(base >= vec2<f32>(margin)) && all(base <= vec2<f32>(grid.cells) - 2.0 - margin));
}

// Columns or rows of a grid, `count` of them; beyond the last a tiled one begins again.
fn grid_line(grid: SurfaceGrid, cells: vec4<u32>, count: u32) -> vec4<u32> {
    return select(cells, cells - (count - 2u), vec4<bool>(grid.tiled != 0u) & (cells >= vec4<u32>(count)));
}

// Height, slope and foam of one grid at a world point: (height, dh/dx, dh/dz, foam). Zero outside its window.
fn grid_at(index: u32, point: vec2<f32>) -> vec4<f32> {
    let grid = surface_table.grids[index];
    let place = grid_place(grid, point);
    let base = floor(place.at);
    // Two cells of margin: the fade has brought the height to zero there.
    if place.share == 0.0 || !grid_holds(grid, base, 1.0) {
        return vec4<f32>(0.0);
    }
    let t = place.at - base;
    let wx = cubic_weights(t.x);
    let wz = cubic_weights(t.y);
    let dx = cubic_slopes(t.x) / grid.cell_size.x;
    let dz = cubic_slopes(t.y) / grid.cell_size.y;
    let first = vec2<u32>(base) - 1u;
    let columns = grid_line(grid, first.x + vec4<u32>(0u, 1u, 2u, 3u), grid.cells.x);
    let rows = grid_line(grid, first.y + vec4<u32>(0u, 1u, 2u, 3u), grid.cells.y) * grid.cells.x + grid.base;
    var sum = vec4<f32>(0.0);
    for (var j = 0u; j < 4u; j++) {
        for (var i = 0u; i < 4u; i++) {
            let v = surface_grids[rows[j] + columns[i]];
            sum += vec4<f32>(wx[i] * wz[j] * v.x, dx[i] * wz[j] * v.x, wx[i] * dz[j] * v.x, wx[i] * wz[j] * v.y);
        }
    }
    return sum * place.share;
}

// The same of all grids.
fn grids_at(point: vec2<f32>) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var g = 0u; g < surface_table.grid_count; g++) {
        sum += grid_at(g, point);
    }
    return sum;
}

struct GridQuery {
    corner: vec2<u32>,
    cells: vec2<u32>,
    torus: vec2<u32>,
    middle: vec2<f32>,
    outer: vec2<f32>,
    scale: vec2<f32>,
    offset: vec2<f32>,
    width: f32,
    rate: f32,
    now: u32,
    old: u32,
    medium: u32,
    pad: u32,
}

struct GridQueries {
    points: u32,
    grids: u32,
    pad_x: u32,
    pad_y: u32,
    list: array<GridQuery, MAX_GRIDS>,
}

override MEDIUM: bool = true;

@group(0) @binding(0) var<uniform> grid_queries: GridQueries;
@group(0) @binding(1) var<storage, read> grid_heights: array<f32>;
@group(0) @binding(2) var<storage, read> grid_ground: array<f32>;
@group(0) @binding(3) var<storage, read> grid_points: array<vec2<f32>>;
// (height, dh/dx, dh/dz, dh/dt) at every point.
@group(0) @binding(4) var<storage, read_write> grid_samples: array<vec4<f32>>;

// One axis' factor of the fade at a cell's centre.
fn fade(cell: u32, middle: f32, outer: f32, width: f32) -> f32 {
    let t = clamp((outer - abs(f32(cell) + 0.5 - middle)) / width, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Sums what the grids hold at points, by the cubic kernel over the faded heights: sample.rs of wave-grid.
@compute @workgroup_size(QUERY_THREADS)
fn grid_query(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= grid_queries.points {
        return;
    }
    var sum = vec4<f32>(0.0);
    for (var g = 0u; g < grid_queries.grids; g++) {
        let grid = grid_queries.list[g];
        let at = grid_points[id.x] * grid.scale + grid.offset - 0.5;
        let base = floor(at);
        let inside = all(base >= vec2<f32>(1.0)) && all(base <= vec2<f32>(grid.cells) - 3.0);
        let first = vec2<u32>(select(vec2<f32>(1.0), base, vec2<bool>(inside))) - 1u;
        let t = select(vec2<f32>(0.0), at - base, vec2<bool>(inside));
        let wx = cubic_weights(t.x);
        let wz = cubic_weights(t.y);
        let dx = cubic_slopes(t.x) * grid.scale.x;
        let dz = cubic_slopes(t.y) * grid.scale.y;
        // Points outside read no cell.
        for (var k = 0u; k < select(0u, 16u, inside); k++) {
            let i = k % 4u;
            let j = k / 4u;
            let cell_at = first + vec2<u32>(i, j);
            let place = cell_at + grid.corner;
            let wrapped = select(place, place - grid.torus, place >= grid.torus);
            let cell = wrapped.y * grid.torus.x + wrapped.x;
            var heights = vec2<f32>(grid_heights[grid.now + cell], grid_heights[grid.old + cell]);
            if MEDIUM {
                if grid.medium != NO_MEDIUM && grid_ground[grid.medium + cell] == 0.0 {
                    let lattice = Lattice(grid.corner, grid.cells, grid.torus, grid.medium, grid.now, grid.old);
                    heights = ghost(lattice, cell_at);
                }
            }
            let f = fade(cell_at.x, grid.middle.x, grid.outer.x, grid.width)
                * fade(cell_at.y, grid.middle.y, grid.outer.y, grid.width);
            let rise = (heights.x - heights.y) * grid.rate;
            sum += f * vec4<f32>(
                wx[i] * wz[j] * heights.x, dx[i] * wz[j] * heights.x, wx[i] * dz[j] * heights.x, wx[i] * wz[j] * rise);
        }
    }
    grid_samples[id.x] = sum;
}

struct GridDraw {
    corner: vec2<u32>,
    cells: vec2<u32>,
    torus: vec2<u32>,
    middle: vec2<f32>,
    outer: vec2<f32>,
    width: f32,
    alpha: f32,
    now: u32,
    previous: u32,
    foam: u32,
    out: u32,
    medium: u32,
    pad_x: u32,
    pad_y: u32,
    pad_z: u32,
}

override MEDIUM: bool = true;

@group(0) @binding(0) var<uniform> grid_draws: array<GridDraw, MAX_GRIDS>;
@group(0) @binding(1) var<storage, read> grid_heights: array<f32>;
@group(0) @binding(2) var<storage, read_write> grid_pool: array<vec2<f32>>;
@group(0) @binding(3) var<storage, read> grid_ground: array<f32>;

// (now, previous) of a wall cell beside water: the mean of the water next to it, a diagonal neighbour counting 1/64; of
// the water two cells away where there is none. See ghosts.rs of wave-grid.
fn ghost(draw: GridDraw, cell_at: vec2<u32>) -> vec2<f32> {
    // Sums of heights and weights, of the ring of eight and of that of sixteen.
    var near = vec3<f32>(0.0);
    var far = vec3<f32>(0.0);
    for (var k = 0u; k < 25u; k++) {
        let by = vec2<i32>(vec2<u32>(k % 5u, k / 5u)) - 2;
        let at = vec2<i32>(cell_at) + by;
        let inside = all(at >= vec2<i32>(0)) && all(at < vec2<i32>(draw.cells));
        let place = vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(draw.cells) - 1)) + draw.corner;
        let wrapped = select(place, place - draw.torus, place >= draw.torus);
        let cell = wrapped.y * draw.torus.x + wrapped.x;
        let wet = inside && grid_ground[draw.medium + cell] > 0.0;
        let weight = select(0.0, select(1.0 / 64.0, 1.0, any(by == vec2<i32>(0))), wet);
        let term = weight * vec3<f32>(grid_heights[draw.now + cell], grid_heights[draw.previous + cell], 1.0);
        let is_near = all(abs(by) <= vec2<i32>(1));
        near += select(vec3<f32>(0.0), term, is_near);
        far += select(term, vec3<f32>(0.0), is_near);
    }
    let sum = select(far, near, near.z > 0.0);
    return sum.xy / max(sum.z, 1e-30);
}

// Writes (height, foam) of every cell of the windows in the list, faded, `alpha` of the way to the last tick.
@compute @workgroup_size(DRAW_THREADS)
fn grid_draw(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) group: vec3<u32>) {
    let draw = &grid_draws[group.z];
    let cells = (*draw).cells;
    // Threads beyond the window repeat its last cells.
    let cell_at = min(id.xy, cells - 1u);
    let torus = (*draw).torus;
    let sum = cell_at + (*draw).corner;
    let at = select(sum, sum - torus, sum >= torus);
    let cell = at.y * torus.x + at.x;
    let distance = abs(vec2<f32>(cell_at) + 0.5 - (*draw).middle);
    let t = clamp(((*draw).outer - distance) / (*draw).width, vec2<f32>(0.0), vec2<f32>(1.0));
    let ramp = t * t * (3.0 - 2.0 * t);
    let fade = ramp.x * ramp.y;
    var heights = vec2<f32>(grid_heights[(*draw).now + cell], grid_heights[(*draw).previous + cell]);
    if MEDIUM {
        if (*draw).medium != NO_MEDIUM && grid_ground[(*draw).medium + cell] == 0.0 {
            heights = ghost(*draw, cell_at);
        }
    }
    let foam = grid_heights[(*draw).foam + cell];
    grid_pool[(*draw).out + cell_at.y * cells.x + cell_at.x] = fade * vec2<f32>(mix(heights.y, heights.x, (*draw).alpha), foam);
}

struct GridHole {
    low: vec2<f32>,
    high: vec2<f32>,
    rise: vec2<f32>,
    gain: f32,
    pad: f32,
}

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
    hole_count: u32,
    pad_x: u32,
    pad_y: u32,
    holes: array<GridHole, MAX_HOLES>,
}

override MEDIUM: bool = true;
override HOLES: bool = true;

@group(0) @binding(0) var<uniform> grid_draws: array<GridDraw, MAX_GRIDS>;
@group(0) @binding(1) var<storage, read> grid_heights: array<f32>;
@group(0) @binding(2) var<storage, read_write> grid_pool: array<vec2<f32>>;
@group(0) @binding(3) var<storage, read> grid_ground: array<f32>;

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
    var fade = ramp.x * ramp.y;
    if HOLES {
        var left = 1.0;
        for (var i = 0u; i < (*draw).hole_count; i++) {
            let hole = &(*draw).holes[i];
            let place = vec2<f32>(cell_at) + 0.5;
            let s = clamp(min(place - (*hole).low, (*hole).high - place) / (*hole).rise, vec2<f32>(0.0), vec2<f32>(1.0));
            let seen = s * s * (3.0 - 2.0 * s);
            left -= (*hole).gain * seen.x * seen.y;
        }
        fade *= max(left, 0.0);
    }
    var heights = vec2<f32>(grid_heights[(*draw).now + cell], grid_heights[(*draw).previous + cell]);
    if MEDIUM {
        if (*draw).medium != NO_MEDIUM && grid_ground[(*draw).medium + cell] == 0.0 {
            let lattice = Lattice((*draw).corner, cells, torus, (*draw).medium, (*draw).now, (*draw).previous);
            heights = ghost(lattice, cell_at);
        }
    }
    let foam = grid_heights[(*draw).foam + cell];
    grid_pool[(*draw).out + cell_at.y * cells.x + cell_at.x] = fade * vec2<f32>(mix(heights.y, heights.x, (*draw).alpha), foam);
}

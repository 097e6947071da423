struct GridSource {
    center: vec2<f32>,
    outer: f32,
    height: f32,
    foam: f32,
    stretch: f32,
    kick: f32,
    pad: f32,
}

struct GridCell {
    place: u32,
    a: f32,
    r: f32,
    pad: u32,
}

@group(1) @binding(0) var<storage, read> grid_sources: array<GridSource>;
@group(1) @binding(1) var<storage, read> grid_cells: array<GridCell>;
// What grid_schedule found: (column + 2^8 row + 2^16 grid, first source, number of sources, flags).
@group(1) @binding(2) var<storage, read> grid_list: array<vec4<u32>>;
// Per dispatch of a list: workgroups along x, y and z, tiles.
@group(1) @binding(3) var<storage, read> grid_counts: array<u32>;
// Per tile of each grid, twice: what its last step found.
@group(1) @binding(4) var<storage, read_write> grid_marks: array<atomic<u32>>;

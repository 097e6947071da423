// Where a grid's cells stand: window and torus, a in the medium, two arrays of heights.
struct Lattice {
    corner: vec2<u32>,
    cells: vec2<u32>,
    torus: vec2<u32>,
    medium: u32,
    first: u32,
    second: u32,
}

// (first, second) of a wall cell beside water: the mean of the water next to it, a diagonal neighbour counting 1/64; of
// the water two cells away where there is none. See ghosts.rs of wave-grid.
fn ghost(grid: Lattice, cell_at: vec2<u32>) -> vec2<f32> {
    // Sums of heights and weights, of the ring of eight and of that of sixteen.
    var near = vec3<f32>(0.0);
    var far = vec3<f32>(0.0);
    for (var k = 0u; k < 25u; k++) {
        let by = vec2<i32>(vec2<u32>(k % 5u, k / 5u)) - 2;
        let at = vec2<i32>(cell_at) + by;
        let inside = all(at >= vec2<i32>(0)) && all(at < vec2<i32>(grid.cells));
        let place = vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(grid.cells) - 1)) + grid.corner;
        let wrapped = select(place, place - grid.torus, place >= grid.torus);
        let cell = wrapped.y * grid.torus.x + wrapped.x;
        let wet = inside && grid_ground[grid.medium + cell] > 0.0;
        let weight = select(0.0, select(1.0 / 64.0, 1.0, any(by == vec2<i32>(0))), wet);
        let term = weight * vec3<f32>(grid_heights[grid.first + cell], grid_heights[grid.second + cell], 1.0);
        let is_near = all(abs(by) <= vec2<i32>(1));
        near += select(vec3<f32>(0.0), term, is_near);
        far += select(term, vec3<f32>(0.0), is_near);
    }
    let sum = select(far, near, near.z > 0.0);
    return sum.xy / max(sum.z, 1e-30);
}

// The lesser side of a grid's cells, metres.
fn grid_cell(index: u32) -> f32 {
    let sides = surface_table.grids[index].cell_size;
    return min(sides.x, sides.y);
}

// Height of a grid at a point between its four nearest cells; zero outside its window.
fn grid_height(index: u32, point: vec2<f32>) -> f32 {
    let grid = surface_table.grids[index];
    let place = grid_place(grid, point);
    let base = floor(place.at);
    if place.share == 0.0 || !grid_holds(grid, base, 0.0) {
        return 0.0;
    }
    let t = place.at - base;
    let at = vec2<u32>(base);
    let columns = grid_line(grid, vec4<u32>(at.x, at.x + 1u, 0u, 0u), grid.cells.x);
    let rows = grid_line(grid, vec4<u32>(at.y, at.y + 1u, 0u, 0u), grid.cells.y) * grid.cells.x + grid.base;
    let low = mix(surface_grids[rows.x + columns.x].x, surface_grids[rows.x + columns.y].x, t.x);
    let high = mix(surface_grids[rows.y + columns.x].x, surface_grids[rows.y + columns.y].x, t.x);
    return place.share * mix(low, high, t.y);
}

// Height of all grids for a vertex: a tent as wide as the footprint takes out what the mesh could not carry.
fn grids_vertex(point: vec2<f32>, footprint: f32) -> f32 {
    var sum = 0.0;
    for (var g = 0u; g < surface_table.grid_count; g++) {
        let width = footprint / grid_cell(g);
        if width < 0.5 {
            sum += grid_at(g, point).x;
        } else if width < 32.0 {
            let step = 0.5 * footprint;
            var mean = 0.0;
            for (var k = 0u; k < 9u; k++) {
                let d = vec2<f32>(f32(k % 3u) - 1.0, f32(k / 3u) - 1.0);
                let weight = (2.0 - abs(d.x)) * (2.0 - abs(d.y)) / 16.0;
                mean += weight * grid_height(g, point + step * d);
            }
            sum += mean * (1.0 - smoothstep(16.0, 32.0, width));
        }
    }
    return sum;
}

// All grids for shading: waves too short for the footprint fade.
fn grids_look(point: vec2<f32>, footprint: f32) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var g = 0u; g < surface_table.grid_count; g++) {
        let width = footprint / grid_cell(g);
        if width < 32.0 {
            let waves = 1.0 - smoothstep(2.0, 8.0, width);
            let foam = 1.0 - smoothstep(8.0, 32.0, width);
            sum += grid_at(g, point) * vec4<f32>(waves, waves, waves, foam);
        }
    }
    return sum;
}

// One sub-step in place over the older heights; see kernels.rs of wave-grid for the formulas. The layer keeps phi on the
// edges before each cell; each cell recomputes the phi of the edges after it. Tiles without a cell of the layer have a
// pipeline of their own.
override LAYER: bool = true;
override LAST: bool = true;

struct Row {
    west: vec4<f32>,
    here: vec4<f32>,
    east: vec4<f32>,
}

fn read_row(first: u32, west: u32, here: u32, east: u32) -> Row {
    let w = grid_heights[first + west].w;
    let h = grid_heights[first + here];
    let e = grid_heights[first + east].x;
    return Row(vec4<f32>(w, h.xyz), h, vec4<f32>(h.yzw, e));
}

fn flush(x: vec4<f32>) -> vec4<f32> {
    return select(x, vec4<f32>(0.0), abs(x) < vec4<f32>(TINY));
}

// Z of the layer at x (a node's index, or half less for the edge before it) on an axis of n cells.
fn layer_z(x: vec4<f32>, n: u32, thickness: u32, exponent: u32, peak: f32) -> vec4<f32> {
    let w = f32(thickness);
    let d = clamp(max(w - x, x - (f32(n) - 1.0 - w)) / w, vec4<f32>(0.0), vec4<f32>(1.0));
    return peak * d * d * d * select(vec4<f32>(1.0), d, vec4<bool>(exponent == 4u));
}

// phi after the step on an edge with Z e and, across it, Z z.
fn next_phi(phi: vec4<f32>, e: vec4<f32>, z: vec4<f32>, flux: vec4<f32>) -> vec4<f32> {
    let gain = 1.0 / (1.0 + 0.5 * e);
    return (1.0 - 0.5 * e) * gain * phi + gain * (z - e) * flux;
}

@compute @workgroup_size(TILE_THREADS)
fn grid_step(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let tile = grid_tiles[grid_dispatch.first + group.x].x;
    let grid = &grid_params[tile >> 16u];
    let cells = (*grid).cells;
    let torus = (*grid).torus;
    let at = place_of(tile, local, (*grid).corner, torus);
    let columns = torus.x / 4u;
    let west = select(at.column - 1u, columns - 1u, at.column == 0u);
    let east = select(at.column + 1u, 0u, at.column + 1u == columns);
    let south = select(at.row - 1u, torus.y - 1u, at.row == 0u);
    let north = select(at.row + 1u, 0u, at.row + 1u == torus.y);
    let stride = (*grid).stride;
    let level = ((*grid).parity + grid_dispatch.substep) & 1u;
    let first = (*grid).base + level * stride;
    let offset = at.row * columns + at.column;
    let old_at = (*grid).base + (1u - level) * stride + offset;

    let s = read_row(first + south * columns, west, at.column, east);
    let c = read_row(first + at.row * columns, west, at.column, east);
    let n = read_row(first + north * columns, west, at.column, east);
    let old = grid_heights[old_at];
    let z = c.here;
    let straight = (*grid).weights.x;
    let beside = (*grid).weights.y;
    let damping = (*grid).damping;
    let cross = ((c.west - z) + (c.east - z)) + ((s.here - z) + (n.here - z));

    if !LAYER {
        let diagonal = ((s.west - z) + (s.east - z)) + ((n.west - z) + (n.east - z));
        let scale = 1.0 / (1.0 + damping);
        let change = (1.0 - damping) * scale * (z - old)
            + (scale * (straight - 2.0 * beside) * cross + scale * 2.0 * beside * diagonal);
        grid_heights[old_at] = flush(z + change);
    } else {
        let flux_w = straight * (z - c.west) + beside * ((n.here - n.west) + (s.here - s.west));
        let flux_e = straight * (c.east - z) + beside * ((n.east - n.here) + (s.east - s.here));
        let flux_s = straight * (z - s.here) + beside * ((c.east - s.east) + (c.west - s.west));
        let flux_n = straight * (n.here - z) + beside * ((n.east - c.east) + (n.west - c.west));
        let w = (*grid).thickness;
        let x = vec4<f32>(at.i);
        let y = vec4<f32>(f32(at.j));
        let power = (*grid).exponent;
        let peak = (*grid).peak;
        let zi = layer_z(x, cells.x, w, power, peak);
        let zj = layer_z(y, cells.y, w, power, peak);
        let memory = (*grid).base + level * stride;
        let px = grid_memory[memory + offset];
        let px_east = vec4<f32>(px.yzw, grid_memory[memory + at.row * columns + east].x);
        let pz = grid_memory[memory + 2u * stride + offset];
        let pz_north = grid_memory[memory + 2u * stride + north * columns + at.column];
        let phi_w = next_phi(px, layer_z(x - 0.5, cells.x, w, power, peak), zj, flux_w);
        let phi_e = next_phi(px_east, layer_z(x + 0.5, cells.x, w, power, peak), zj, flux_e);
        let phi_s = next_phi(pz, layer_z(y - 0.5, cells.y, w, power, peak), zi, flux_s);
        let phi_n = next_phi(pz_north, layer_z(y + 0.5, cells.y, w, power, peak), zi, flux_n);
        let plain = (flux_e - flux_w) + (flux_n - flux_s);
        let layer = ((phi_e + px_east) - (phi_w + px)) + ((phi_n + pz_north) - (phi_s + pz));
        let scale = 1.0 / ((1.0 + 0.5 * zi) * (1.0 + 0.5 * zj) * (1.0 + damping));
        let rate = (1.0 - damping) * (1.0 - 0.5 * zi) * (1.0 - 0.5 * zj);
        let next = z + scale * (rate * (z - old) - zi * zj * z + (plain + 0.5 * layer));
        // The ring is zero; it stores the phi of the edges between itself and the last cells.
        let columns_open = (at.i > vec4<u32>(0u)) & (at.i + 1u < vec4<u32>(cells.x));
        let rows_open = at.j > 0u && at.j + 1u < cells.y;
        let edge_x = (at.i > vec4<u32>(0u)) & (at.i < vec4<u32>(cells.x)) & vec4<bool>(rows_open);
        let edge_z = columns_open & vec4<bool>(at.j > 0u && at.j < cells.y);
        let next_memory = (*grid).base + (1u - level) * stride;
        grid_memory[next_memory + offset] = select(vec4<f32>(0.0), flush(phi_w), edge_x);
        grid_memory[next_memory + 2u * stride + offset] = select(vec4<f32>(0.0), flush(phi_s), edge_z);
        grid_heights[old_at] = select(vec4<f32>(0.0), flush(next), columns_open & vec4<bool>(rows_open));
    }

    if LAST {
        let last = grid_dispatch.substep + 1u == (*grid).substeps;
        let foam_at = (*grid).base + 3u * stride + offset;
        let foam = grid_heights[foam_at];
        let excess = clamp(-cross * (*grid).foam_scale - (*grid).foam_onset, vec4<f32>(0.0), vec4<f32>(1.0));
        let open = (at.i > vec4<u32>(0u)) & (at.i + 1u < vec4<u32>(cells.x)) & vec4<bool>(at.j > 0u && at.j + 1u < cells.y);
        let next = min(foam * (*grid).foam_keep + excess * (*grid).foam_growth, vec4<f32>(1.0));
        grid_heights[foam_at] = select(foam, select(vec4<f32>(0.0), next, open), vec4<bool>(last));
    }
}

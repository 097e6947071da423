// One sub-step in place over the older heights; see kernels.rs of wave-grid for the formulas. The layer keeps phi on the
// edges before each cell; each cell recomputes the phi of the edges after it. Tiles without a cell of the layer have a
// pipeline of their own, and so have those where the medium varies.
override LAYER: bool = true;
override LAST: bool = true;
override MIXED: bool = true;

fn read_row(first: u32, west: u32, here: u32, east: u32) -> Row {
    let w = grid_heights[first + west].w;
    let h = grid_heights[first + here];
    let e = grid_heights[first + east].x;
    return Row(vec4<f32>(w, h.xyz), h, vec4<f32>(h.yzw, e));
}

// The same of a, which stands at `first` in the medium.
fn read_ground(first: u32, west: u32, here: u32, east: u32) -> Row {
    let w = grid_ground[first + west].w;
    let h = grid_ground[first + here];
    let e = grid_ground[first + east].x;
    return Row(vec4<f32>(w, h.xyz), h, vec4<f32>(h.yzw, e));
}

fn flush(x: vec4<f32>) -> vec4<f32> {
    return select(x, vec4<f32>(0.0), abs(x) < vec4<f32>(TINY));
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
    let aspect = (*grid).aspect;
    let along_x = (c.west - z) + (c.east - z);
    let along_z = (s.here - z) + (n.here - z);

    // r = 1 / (1 + damping), and the faces' coefficients where they vary.
    var r = vec4<f32>(1.0 / (1.0 + (*grid).damping));
    var flux: Fluxes;
    var faces: Fluxes;
    var a_s: Row;
    var a_c: Row;
    var a_n: Row;
    if MIXED {
        let ground = (*grid).base / 2u;
        a_s = read_ground(ground + south * columns, west, at.column, east);
        a_c = read_ground(ground + at.row * columns, west, at.column, east);
        a_n = read_ground(ground + north * columns, west, at.column, east);
        r = grid_ground[ground + stride + offset];
        faces = Fluxes(
            face(a_c.west, a_c.here), face(a_c.here, a_c.east), face(a_s.here, a_c.here), face(a_c.here, a_n.here));
        flux = mixed_fluxes(s, c, n, a_s, a_c, a_n, faces, (*grid).weights / (*grid).deep, aspect);
    }
    var next: vec4<f32>;
    if !LAYER {
        var divergence: vec4<f32>;
        if MIXED {
            divergence = (flux.east - flux.west) + (flux.north - flux.south);
        } else {
            let diagonal = ((s.west - z) + (s.east - z)) + ((n.west - z) + (n.east - z));
            divergence = (straight - 2.0 * aspect * beside) * along_x + (aspect * straight - 2.0 * beside) * along_z
                + (1.0 + aspect) * beside * diagonal;
        }
        next = flush(z + ((2.0 * r - 1.0) * (z - old) + r * divergence));
        grid_heights[old_at] = next;
    } else {
        if !MIXED {
            flux = plain_fluxes(s, c, n, vec2<f32>(straight, aspect * straight), vec2<f32>(beside, aspect * beside));
        }
        let w = (*grid).thickness;
        let x = vec4<f32>(at.i);
        let y = vec4<f32>(f32(at.j));
        let power = (*grid).exponent;
        let peak = (*grid).peak;
        let peak_z = (*grid).peak_z;
        let zi = layer_z(x, cells.x, w, power, peak);
        let zj = layer_z(y, cells.y, w, power, peak_z);
        let memory = (*grid).base + level * stride;
        var px = grid_memory[memory + offset];
        var px_east = vec4<f32>(px.yzw, grid_memory[memory + at.row * columns + east].x);
        var pz = grid_memory[memory + 2u * stride + offset];
        var pz_north = grid_memory[memory + 2u * stride + north * columns + at.column];
        if MIXED {
            // What a new wall cut off.
            px = select(vec4<f32>(0.0), px, faces.west > vec4<f32>(0.0));
            px_east = select(vec4<f32>(0.0), px_east, faces.east > vec4<f32>(0.0));
            pz = select(vec4<f32>(0.0), pz, faces.south > vec4<f32>(0.0));
            pz_north = select(vec4<f32>(0.0), pz_north, faces.north > vec4<f32>(0.0));
        }
        let phi_w = next_phi(px, layer_z(x - 0.5, cells.x, w, power, peak), zj, flux.west);
        let phi_e = next_phi(px_east, layer_z(x + 0.5, cells.x, w, power, peak), zj, flux.east);
        let phi_s = next_phi(pz, layer_z(y - 0.5, cells.y, w, power, peak_z), zi, flux.south);
        let phi_n = next_phi(pz_north, layer_z(y + 0.5, cells.y, w, power, peak_z), zi, flux.north);
        let plain = (flux.east - flux.west) + (flux.north - flux.south);
        let layer = ((phi_e + px_east) - (phi_w + px)) + ((phi_n + pz_north) - (phi_s + pz));
        let scale = 1.0 / ((1.0 + 0.5 * zi) * (1.0 + 0.5 * zj));
        let rate = (2.0 * r - 1.0) * (1.0 - 0.5 * zi) * (1.0 - 0.5 * zj);
        next = flush(z + scale * (rate * (z - old) + r * ((plain + 0.5 * layer) - zi * zj * z)));
        // The ring is zero; it stores the phi of the edges between itself and the last cells.
        let columns_open = (at.i > vec4<u32>(0u)) & (at.i + 1u < vec4<u32>(cells.x));
        let rows_open = at.j > 0u && at.j + 1u < cells.y;
        let edge_x = (at.i > vec4<u32>(0u)) & (at.i < vec4<u32>(cells.x)) & vec4<bool>(rows_open);
        let edge_z = columns_open & vec4<bool>(at.j > 0u && at.j < cells.y);
        let next_memory = (*grid).base + (1u - level) * stride;
        grid_memory[next_memory + offset] = select(vec4<f32>(0.0), flush(phi_w), edge_x);
        grid_memory[next_memory + 2u * stride + offset] = select(vec4<f32>(0.0), flush(phi_s), edge_z);
        grid_heights[old_at] = select(vec4<f32>(0.0), next, columns_open & vec4<bool>(rows_open));
    }

    if LAST {
        let last = grid_dispatch.substep + 1u == (*grid).substeps;
        let foam_at = (*grid).base + 3u * stride + offset;
        let foam = grid_heights[foam_at];
        var bend = along_x + aspect * along_z;
        if MIXED {
            bend = open_bend(s, c, n, faces, aspect);
        }
        var excess = clamp(-bend * (*grid).foam_scale - (*grid).foam_onset, vec4<f32>(0.0), vec4<f32>(1.0));
        if MIXED {
            let limit = (*grid).foam_depth / (*grid).deep;
            excess = foam_excess(excess, z, next, a_c, min(a_s.here, a_n.here), limit, (*grid).foam_splash);
            excess = select(vec4<f32>(0.0), excess, r > vec4<f32>(0.0));
        }
        let open = (at.i > vec4<u32>(0u)) & (at.i + 1u < vec4<u32>(cells.x)) & vec4<bool>(at.j > 0u && at.j + 1u < cells.y);
        var keep = vec4<f32>((*grid).foam_keep);
        if MIXED {
            keep = select(vec4<f32>(0.0), keep, r > vec4<f32>(0.0));
        }
        let foamed = min(foam * keep + excess * (*grid).foam_growth, vec4<f32>(1.0));
        grid_heights[foam_at] = select(foam, select(vec4<f32>(0.0), foamed, open), vec4<bool>(last));
    }
}

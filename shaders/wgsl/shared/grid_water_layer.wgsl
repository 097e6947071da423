// The absorbing layer of dispersive grids: a convolutional PML on the Laplacian of every field. A slot keeps what a tile's
// edges and cells remember, the edges that a thread's strip shares with another's twice: threads need nothing of each
// other and write in place.

// Factors of m' = keep m + gain x.
struct Damp {
    keep: vec4<f32>,
    gain: vec4<f32>,
}

// At positions x of an axis of n cells (a node's index, or half less for the edge before it).
fn damp(x: vec4<f32>, n: u32, peak: vec2<f32>, water: GridWater) -> Damp {
    let none = vec4<f32>(0.0);
    let w = f32(water.width);
    let low = clamp((w - 0.5 - x) / w, none, vec4<f32>(1.0));
    let high = clamp((x - (f32(n) - 0.5 - w)) / w, none, vec4<f32>(1.0));
    let sigma = peak.x * low * low * low + peak.y * high * high * high;
    let sum = sigma + water.alpha * (1.0 - max(low, high));
    let keep = exp(-sum);
    let inside = sigma > none;
    // 1 - keep over the sum, by its series where the difference would cancel.
    let series = 1.0 - sum * (1.0 / 2.0 - sum * (1.0 / 6.0 - sum * (1.0 / 24.0 - sum * (1.0 / 120.0 - sum / 720.0))));
    let gain = -sigma * select((1.0 - keep) / max(sum, vec4<f32>(0.1)), series, sum < vec4<f32>(0.3));
    return Damp(select(none, keep, inside), select(none, gain, inside));
}

// What a thread knows of the layer: factors along x, and along z in this row (south edges, north edges, nodes).
struct Layer {
    slots: vec2<u32>,
    edge_a: Damp,
    edge_b: Damp,
    far: Damp,
    node_a: Damp,
    node_b: Damp,
    across: Damp,
    // vec4 of its first four cells in an array of the tile.
    at: u32,
    // vec4 of field 0's edges above its last row.
    beyond: u32,
    // The thread's last row.
    ends: bool,
    // What is remembered along x and z is of an earlier tile.
    fresh: vec2<bool>,
}

fn layer_of(s: Strip, i_a: vec4<u32>, i_b: vec4<u32>) -> Layer {
    let water = s.water;
    let n = s.grid.cells.x;
    let peak = water.peaks.xy;
    let a = vec4<f32>(i_a);
    let b = vec4<f32>(i_b);
    var layer: Layer;
    layer.slots = slots_of(s.grid, water, s.entry.x, s.entry.w);
    layer.edge_a = damp(a - 0.5, n, peak, water);
    layer.edge_b = damp(b - 0.5, n, peak, water);
    layer.far = damp(b.wwww + 0.5, n, peak, water);
    layer.node_a = damp(a, n, peak, water);
    layer.node_b = damp(b, n, peak, water);
    layer.at = s.row_in_tile * (TILE / 4u) + 2u * s.half;
    layer.beyond =
        layer.slots.y + 2u * FIELDS * TILE_THREADS + s.row_in_tile / ROWS * FIELDS * (TILE / 4u) + 2u * s.half;
    layer.fresh = ((vec2<u32>(s.entry.w) & vec2<u32>(FRESH_X, FRESH_Z)) != vec2<u32>(0u)) & vec2<bool>(grid_dispatch.substep == 0u);
    return layer;
}

fn remembered(at: u32, fresh: bool) -> vec4<f32> {
    return select(grid_fields[at], vec4<f32>(0.0), fresh);
}

// What the edges below a thread's first row remember of field k.
fn first_edges(k: u32, layer: Layer) -> Pair {
    var edges = Pair(vec4<f32>(0.0), vec4<f32>(0.0));
    if layer.slots.y != NO_SLOT {
        let at = layer.slots.y + k * TILE_THREADS + layer.at;
        edges = Pair(remembered(at, layer.fresh.y), remembered(at + 1u, layer.fresh.y));
    }
    return edges;
}

// Edges of field k: the jumps with what they remember, which moves on. `far` is that of the edges after the cells, all
// fields; `north` that of the south edges on entry, of the north ones on return.
fn stretch_jumps(k: u32, jumps: Faces, layer: Layer, far: ptr<function, vec4<f32>>, north: ptr<function, Pair>) -> Faces {
    var out = jumps;
    if layer.slots.x != NO_SLOT {
        let at = layer.slots.x + k * TILE_THREADS + layer.at;
        let a = flush(layer.edge_a.keep * remembered(at, layer.fresh.x) + layer.edge_a.gain * jumps.x.a);
        let b = flush(layer.edge_b.keep * remembered(at + 1u, layer.fresh.x) + layer.edge_b.gain * jumps.x.b);
        let last = flush(vec4<f32>(layer.far.keep.x * (*far)[k] + layer.far.gain.x * jumps.far)).x;
        grid_fields[at] = a;
        grid_fields[at + 1u] = b;
        (*far)[k] = last;
        out.x = Pair(jumps.x.a + a, jumps.x.b + b);
        out.far = jumps.far + last;
    }
    if layer.slots.y != NO_SLOT {
        let at = layer.slots.y + k * TILE_THREADS + layer.at;
        let beyond = layer.beyond + k * (TILE / 4u);
        let above = select(at + TILE / 4u, beyond, layer.ends);
        let s_a = flush(layer.across.keep.x * (*north).a + layer.across.gain.x * jumps.s.a);
        let s_b = flush(layer.across.keep.x * (*north).b + layer.across.gain.x * jumps.s.b);
        *north = Pair(remembered(above, layer.fresh.y), remembered(above + 1u, layer.fresh.y));
        let n_a = flush(layer.across.keep.y * (*north).a + layer.across.gain.y * jumps.n.a);
        let n_b = flush(layer.across.keep.y * (*north).b + layer.across.gain.y * jumps.n.b);
        grid_fields[at] = s_a;
        grid_fields[at + 1u] = s_b;
        if layer.ends {
            grid_fields[beyond] = n_a;
            grid_fields[beyond + 1u] = n_b;
        }
        out.s = Pair(jumps.s.a + s_a, jumps.s.b + s_b);
        out.n = Pair(jumps.n.a + n_a, jumps.n.b + n_b);
    }
    return out;
}

// Cells of field k: what flows in along an axis with what they remember of it, which moves on.
fn stretch_flow(k: u32, slot: u32, fresh: bool, flow: Pair, a: Damp, b: Damp, layer: Layer) -> Pair {
    var out = flow;
    if slot != NO_SLOT {
        let at = slot + (FIELDS + k) * TILE_THREADS + layer.at;
        let to_a = flush(a.keep * remembered(at, fresh) + a.gain * flow.a);
        let to_b = flush(b.keep * remembered(at + 1u, fresh) + b.gain * flow.b);
        grid_fields[at] = to_a;
        grid_fields[at + 1u] = to_b;
        out = Pair(flow.a + to_a, flow.b + to_b);
    }
    return out;
}

// What flows into eight cells, of each field.
struct Flows {
    p: Pair,
    x1: Pair,
    x2: Pair,
    x3: Pair,
}

// The highest wave and the most foam found.
struct Found {
    height: vec4<f32>,
    foam: vec4<f32>,
}

// Which of eight cells advance, and which others keep what they hold.
struct Open {
    a: vec4<bool>,
    b: vec4<bool>,
    stays_a: vec4<bool>,
    stays_b: vec4<bool>,
}

// Eight cells of a row advance by a sub-step.
fn finish_row(s: Strip, walk: Walk, at: u32, flow: Flows, bed: Bed, open: Open, found: Found) -> Found {
    let none = vec4<f32>(0.0);
    let stride = s.grid.stride;
    let z = walk.z.c;
    let to_a = advance(
        s.water, z.a.here, Fields(walk.p.c.a.here, walk.x1.c.a.here, walk.x2.c.a.here, walk.x3.c.a.here),
        Fields(none, grid_memory[s.next.y + at], grid_fields[s.next.z + at], grid_fields[s.next.w + at]),
        Fields(flow.p.a, flow.x1.a, flow.x2.a, flow.x3.a), bed.m_a, bed.damp.a, open.a, open.stays_a);
    let to_b = advance(
        s.water, z.b.here, Fields(walk.p.c.b.here, walk.x1.c.b.here, walk.x2.c.b.here, walk.x3.c.b.here),
        Fields(none, grid_memory[s.next.y + at + 1u], grid_fields[s.next.z + at + 1u], grid_fields[s.next.w + at + 1u]),
        Fields(flow.p.b, flow.x1.b, flow.x2.b, flow.x3.b), bed.m_b, bed.damp.b, open.b, open.stays_b);
    if grid_dispatch.substep == 0u && (s.entry.w & PREPARED) == 0u {
        grid_heights[s.grid.base + 2u * stride + at] = z.a.here;
        grid_heights[s.grid.base + 2u * stride + at + 1u] = z.b.here;
    }
    store_next(at, s.z_next, s.next, to_a);
    store_next(at + 1u, s.z_next, s.next, to_b);
    var out = found;
    if LAST {
        out.height = max(max(found.height, max(abs(z.a.here), abs(z.b.here))), max(abs(to_a.z), abs(to_b.z)));
        let w = bed.w_p;
        let faces_a = Fluxes(w.x.a, vec4<f32>(w.x.a.yzw, w.x.b.x), w.s.a, w.n.a);
        let faces_b = Fluxes(w.x.b, vec4<f32>(w.x.b.yzw, w.far), w.s.b, w.n.b);
        let a = walk.a;
        let of_a = foam_of(s, walk.z.s.a, z.a, walk.z.n.a, to_a.z, a.s.a.here, a.c.a, a.n.a.here, faces_a, open.a);
        let of_b = foam_of(s, walk.z.s.b, z.b, walk.z.n.b, to_b.z, a.s.b.here, a.c.b, a.n.b.here, faces_b, open.b);
        let last = grid_dispatch.substep + 1u == s.grid.substeps;
        // Most tiles have no foam and get none.
        if last && ((s.entry.w & FOAMED) != 0u || any(max(of_a.breaking, of_b.breaking) > none)) {
            let foam = s.grid.base + 3u * stride + at;
            let foam_a = of_a.keep * grid_heights[foam] + of_a.breaking * s.grid.foam_growth;
            let foam_b = of_b.keep * grid_heights[foam + 1u] + of_b.breaking * s.grid.foam_growth;
            grid_heights[foam] = min(foam_a, vec4<f32>(1.0));
            grid_heights[foam + 1u] = min(foam_b, vec4<f32>(1.0));
            out.foam = max(found.foam, max(foam_a, foam_b));
        }
    }
    return out;
}

// Open water of one depth, away from the layer.
fn step_open(s: Strip, rows: u32, first: Found) -> Found {
    let bed = even_bed(s.water);
    let open = Open(vec4<bool>(true), vec4<bool>(true), vec4<bool>(false), vec4<bool>(false));
    var found = first;
    var walk = walk_from(s);
    for (var k = 0u; k < rows; k++) {
        let row = s.first_row + k;
        look_north(&walk, s, row, select(row + 1u, 0u, row + 1u == s.grid.torus.y) * s.columns);
        let w = s.water.shares;
        let flow = Flows(spread(walk.p, w.x), spread(walk.x1, w.y), spread(walk.x2, w.z), spread(walk.x3, w.w));
        found = finish_row(s, walk, row * s.columns + s.column, flow, bed, open, found);
        walk = walk_north(walk);
    }
    return found;
}

// Four cells advance by one sub-step; see kernels.rs and mixed.rs of wave-grid for the formulas. `LAYER` tells whether
// they may lie in the layer, which keeps phi on the edges before each cell, `LAST` whether foam is wanted, `MIXED`
// whether the medium varies.
override LAYER: bool = true;
override LAST: bool = true;
override MIXED: bool = true;

// What four cells hold besides heights, and where they are in the window.
struct Own {
    i: vec4<u32>,
    j: u32,
    old: vec4<f32>,
    // 1 / (1 + sigma dt / 2).
    r: vec4<f32>,
    // phi on the edges before, after, below and above.
    px: vec4<f32>,
    px_east: vec4<f32>,
    pz: vec4<f32>,
    pz_north: vec4<f32>,
}

// What they hold after it.
struct Next {
    z: vec4<f32>,
    px: vec4<f32>,
    pz: vec4<f32>,
    // How much the water breaks, 0 to 1, and the factor of the foam that is left.
    breaking: vec4<f32>,
    keep: vec4<f32>,
}

// The rows below, here and above, their a where the medium varies.
fn advance(grid: GridParams, s: Row, c: Row, n: Row, a_s: Row, a_c: Row, a_n: Row, own: Own) -> Next {
    let none = vec4<f32>(0.0);
    let z = c.here;
    let straight = grid.weights.x;
    let beside = grid.weights.y;
    let aspect = grid.aspect;
    let along_x = (c.west - z) + (c.east - z);
    let along_z = (s.here - z) + (n.here - z);
    let open = (own.i > vec4<u32>(0u)) & (own.i + 1u < vec4<u32>(grid.cells.x)) & vec4<bool>(own.j > 0u && own.j + 1u < grid.cells.y);
    var r = vec4<f32>(1.0 / (1.0 + grid.damping));
    var flux: Fluxes;
    var faces: Fluxes;
    if MIXED {
        r = own.r;
        faces = Fluxes(
            face(a_c.west, a_c.here), face(a_c.here, a_c.east), face(a_s.here, a_c.here), face(a_c.here, a_n.here));
        flux = mixed_fluxes(s, c, n, a_s, a_c, a_n, faces, grid.weights / grid.deep, aspect);
    }
    var next: Next;
    if !LAYER {
        var divergence: vec4<f32>;
        if MIXED {
            divergence = (flux.east - flux.west) + (flux.north - flux.south);
        } else {
            let diagonal = ((s.west - z) + (s.east - z)) + ((n.west - z) + (n.east - z));
            divergence = (straight - 2.0 * aspect * beside) * along_x + (aspect * straight - 2.0 * beside) * along_z
                + (1.0 + aspect) * beside * diagonal;
        }
        next.z = flush(z + ((2.0 * r - 1.0) * (z - own.old) + r * divergence));
    } else {
        if !MIXED {
            flux = plain_fluxes(s, c, n, vec2<f32>(straight, aspect * straight), vec2<f32>(beside, aspect * beside));
        }
        next = layer_next(grid, z, flux, faces, r, own);
    }
    if LAST {
        var bend = along_x + aspect * along_z;
        if MIXED {
            bend = open_bend(s, c, n, faces, aspect);
        }
        var excess = clamp(-bend * grid.foam_scale - grid.foam_onset, none, vec4<f32>(1.0));
        var keep = vec4<f32>(grid.foam_keep);
        if MIXED {
            let limit = grid.foam_depth / grid.deep;
            excess = foam_excess(excess, z, next.z, a_c, min(a_s.here, a_n.here), limit, grid.foam_splash);
            excess = select(none, excess, r > none);
            keep = select(none, keep, r > none);
        }
        next.breaking = select(none, excess, open);
        next.keep = select(none, keep, open);
    }
    if LAYER {
        // The ring is zero; it stores the phi of the edges between itself and the last cells.
        let rows_open = own.j > 0u && own.j + 1u < grid.cells.y;
        let columns_open = (own.i > vec4<u32>(0u)) & (own.i + 1u < vec4<u32>(grid.cells.x));
        let edge_x = (own.i > vec4<u32>(0u)) & (own.i < vec4<u32>(grid.cells.x)) & vec4<bool>(rows_open);
        let edge_z = columns_open & vec4<bool>(own.j > 0u && own.j < grid.cells.y);
        next.px = select(none, flush(next.px), edge_x);
        next.pz = select(none, flush(next.pz), edge_z);
        next.z = select(none, next.z, open);
    }
    return next;
}

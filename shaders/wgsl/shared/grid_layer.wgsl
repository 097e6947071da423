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

// Heights and phi after the step; `faces` are the faces' coefficients where the medium varies.
fn layer_next(grid: GridParams, z: vec4<f32>, flux: Fluxes, faces: Fluxes, r: vec4<f32>, own: Own) -> Next {
    let none = vec4<f32>(0.0);
    let w = grid.thickness;
    let power = grid.exponent;
    let n = grid.cells;
    let x = vec4<f32>(own.i);
    let y = vec4<f32>(f32(own.j));
    let zi = layer_z(x, n.x, w, power, grid.peak);
    let zj = layer_z(y, n.y, w, power, grid.peak_z);
    var px = own.px;
    var px_east = own.px_east;
    var pz = own.pz;
    var pz_north = own.pz_north;
    if MIXED {
        // What a new wall cut off.
        px = select(none, px, faces.west > none);
        px_east = select(none, px_east, faces.east > none);
        pz = select(none, pz, faces.south > none);
        pz_north = select(none, pz_north, faces.north > none);
    }
    let phi_w = next_phi(px, layer_z(x - 0.5, n.x, w, power, grid.peak), zj, flux.west);
    let phi_e = next_phi(px_east, layer_z(x + 0.5, n.x, w, power, grid.peak), zj, flux.east);
    let phi_s = next_phi(pz, layer_z(y - 0.5, n.y, w, power, grid.peak_z), zi, flux.south);
    let phi_n = next_phi(pz_north, layer_z(y + 0.5, n.y, w, power, grid.peak_z), zi, flux.north);
    let plain = (flux.east - flux.west) + (flux.north - flux.south);
    let layer = ((phi_e + px_east) - (phi_w + px)) + ((phi_n + pz_north) - (phi_s + pz));
    let scale = 1.0 / ((1.0 + 0.5 * zi) * (1.0 + 0.5 * zj));
    let rate = (2.0 * r - 1.0) * (1.0 - 0.5 * zi) * (1.0 - 0.5 * zj);
    let next = flush(z + scale * (rate * (z - own.old) + r * ((plain + 0.5 * layer) - zi * zj * z)));
    return Next(next, phi_w, phi_s, none, none);
}

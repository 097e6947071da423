// Fluxes through the faces of a cell, and the coefficients of those faces where they vary.
struct Fluxes {
    west: vec4<f32>,
    east: vec4<f32>,
    south: vec4<f32>,
    north: vec4<f32>,
}

// Coefficient of the face between two cells: their mean, zero beside a wall.
fn face(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return select(vec4<f32>(0.0), 0.5 * (a + b), min(a, b) > vec4<f32>(0.0));
}

// 1 where both cells are wall.
fn walls(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return select(vec4<f32>(1.0), vec4<f32>(0.0), max(a, b) > vec4<f32>(0.0));
}

fn plain_fluxes(s: Row, c: Row, n: Row, straight: vec2<f32>, beside: vec2<f32>) -> Fluxes {
    return Fluxes(
        straight.x * (c.here - c.west) + beside.x * ((n.here - n.west) + (s.here - s.west)),
        straight.x * (c.east - c.here) + beside.x * ((n.east - n.here) + (s.east - s.here)),
        straight.y * (c.here - s.here) + beside.y * ((c.east - s.east) + (c.west - s.west)),
        straight.y * (n.here - c.here) + beside.y * ((n.east - c.east) + (n.west - c.west)),
    );
}

// Where a varies; `faces` are those of the four faces, all relative to the x axis. See mixed.rs and ground.rs of wave-grid for the formulas.
fn mixed_fluxes(s: Row, c: Row, n: Row, a_s: Row, a_c: Row, a_n: Row, faces: Fluxes, w: vec2<f32>, aspect: f32) -> Fluxes {
    let own_w = faces.west * (w.x + w.y * (walls(a_s.west, a_s.here) + walls(a_n.west, a_n.here)));
    let own_e = faces.east * (w.x + w.y * (walls(a_s.here, a_s.east) + walls(a_n.here, a_n.east)));
    let own_s = faces.south * (w.x + w.y * (walls(a_s.west, a_c.west) + walls(a_s.east, a_c.east)));
    let own_n = faces.north * (w.x + w.y * (walls(a_c.west, a_n.west) + walls(a_c.east, a_n.east)));
    return Fluxes(
        own_w * (c.here - c.west) + w.y * (min(faces.west, face(a_n.west, a_n.here)) * (n.here - n.west)
            + min(faces.west, face(a_s.west, a_s.here)) * (s.here - s.west)),
        own_e * (c.east - c.here) + w.y * (min(faces.east, face(a_n.here, a_n.east)) * (n.east - n.here)
            + min(faces.east, face(a_s.here, a_s.east)) * (s.east - s.here)),
        aspect * (own_s * (c.here - s.here) + w.y * (min(faces.south, face(a_s.east, a_c.east)) * (c.east - s.east)
            + min(faces.south, face(a_s.west, a_c.west)) * (c.west - s.west))),
        aspect * (own_n * (n.here - c.here) + w.y * (min(faces.north, face(a_c.east, a_n.east)) * (n.east - c.east)
            + min(faces.north, face(a_c.west, a_n.west)) * (n.west - c.west))),
    );
}

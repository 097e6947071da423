// The cascades of a dispatch: FIRST_CASCADE and those after it, each with two layers one after the other, so that fewer
// workgroups along z leave the last cascades out.
override FIRST_CASCADE: u32 = 0u;
// Rows and columns that hold modes in none of them are known when the pipeline is made, and not read at all:
// `HALF..N - HALF + 1`. N: any may.
override HALF: u32 = N;

// A row or a column of a layer. Layers: pair 0 of each cascade (displacement), then pair 1 (derivative).
struct Place {
    cascade: u32,
    pair: u32,
    layer: u32,
    line: u32,
    // The cascade's: read once, not at every point.
    half: u32,
    wave_step: f32,
}

fn place_of(z: u32, line: u32) -> Place {
    let pair = z & 1u;
    let cascade = FIRST_CASCADE + (z >> 1u);
    let half = ocean.cascades[cascade].half;
    return Place(cascade, pair, cascade + pair * ocean.cascade_count, line, half, ocean.cascades[cascade].wave_step);
}

// Place of the row numbered among those that may hold modes; from N on there is none.
fn place_of_row(z: u32, row: u32) -> Place {
    var place = place_of(z, row);
    place.line += select(0u, N + 1u - 2u * place.half, row >= place.half);
    return place;
}

fn may_hold_modes(place: Place, i: u32) -> bool {
    return i < place.half || i + place.half > N;
}

// Whether points t + e THREADS_PER_LINE hold no modes for any t.
fn is_empty(e: u32) -> bool {
    return e * THREADS_PER_LINE >= HALF && (e + 1u) * THREADS_PER_LINE + HALF <= N + 1u;
}

struct SurfaceCascade {
    offset: vec2<f32>,
    tile: f32,
    size: f32,
}

struct SurfaceGrid {
    corner: vec2<f32>,
    cell_size: f32,
    base: u32,
    cells: vec2<u32>,
    pad: vec2<u32>,
}

struct SurfaceTable {
    cascade_count: u32,
    grid_count: u32,
    time: f32,
    significant_height: f32,
    hidden_slope: array<vec4<f32>, 4>,
    cascades: array<SurfaceCascade, MAX_CASCADES>,
    grids: array<SurfaceGrid, MAX_GRIDS>,
}

struct SurfacePoint {
    height: f32,
    normal: vec3<f32>,
    rest: vec2<f32>,
}

// Texel of the period that holds `p`, and the fraction within it.
struct Texel {
    base: vec2<i32>,
    fraction: vec2<f32>,
}

fn cascade_texel(index: u32, rest: vec2<f32>) -> Texel {
    let c = surface_table.cascades[index];
    let x = (rest + c.offset) * (c.size / c.tile);
    let base = floor(x);
    return Texel(vec2<i32>(base), x - base);
}

// All cascades of an array at a rest point, by the cubic kernel.
fn read_cascades(array: texture_2d_array<f32>, rest: vec2<f32>) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var c = 0u; c < surface_table.cascade_count; c++) {
        let at = cascade_texel(c, rest);
        let mask = vec2<i32>(i32(surface_table.cascades[c].size) - 1);
        let wx = cubic_weights(at.fraction.x);
        let wz = cubic_weights(at.fraction.y);
        for (var j = 0; j < 4; j++) {
            for (var i = 0; i < 4; i++) {
                let texel = (at.base + vec2<i32>(i - 1, j - 1)) & mask;
                sum += wx[i] * wz[j] * textureLoad(array, texel, c, 0);
            }
        }
    }
    return sum;
}

// Height, slope and foam of one grid at a world point: (height, dh/dx, dh/dz, foam). Zero outside its window.
fn grid_at(index: u32, point: vec2<f32>) -> vec4<f32> {
    let grid = surface_table.grids[index];
    let x = (point - grid.corner) / grid.cell_size - 0.5;
    let base = floor(x);
    // Two cells of margin: the fade has brought the height to zero there.
    if any(base < vec2<f32>(1.0)) || any(base > vec2<f32>(grid.cells) - 3.0) {
        return vec4<f32>(0.0);
    }
    let t = x - base;
    let wx = cubic_weights(t.x);
    let wz = cubic_weights(t.y);
    let dx = cubic_slopes(t.x) / grid.cell_size;
    let dz = cubic_slopes(t.y) / grid.cell_size;
    let first = vec2<u32>(base) - 1u;
    var sum = vec4<f32>(0.0);
    for (var j = 0u; j < 4u; j++) {
        let row = grid.base + (first.y + j) * grid.cells.x + first.x;
        for (var i = 0u; i < 4u; i++) {
            let v = surface_grids[row + i];
            sum += vec4<f32>(wx[i] * wz[j] * v.x, dx[i] * wz[j] * v.x, wx[i] * dz[j] * v.x, wx[i] * wz[j] * v.y);
        }
    }
    return sum;
}

// The same of all grids.
fn grids_at(point: vec2<f32>) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var g = 0u; g < surface_table.grid_count; g++) {
        sum += grid_at(g, point);
    }
    return sum;
}

// `miss` carried through the inverse of the rest-to-world gradient (1 + grad D), d = (.., .., dDx/dx, dDz/dz). Where the
// surface is compressed below `least`, it counts as compressed that much, so that the answer stays finite at folds.
fn uncompress(miss: vec2<f32>, d: vec4<f32>, cross: f32, least: f32) -> vec2<f32> {
    let a = 1.0 + d.z;
    let b = 1.0 + d.w;
    return vec2<f32>(b * miss.x - cross * miss.y, a * miss.y - cross * miss.x) / max(a * b - cross * cross, least);
}

// Slope of the ambient sea in world coordinates from (dh/dx, dh/dz, dDx/dx, dDz/dz) and dDx/dz.
fn world_slope(d: vec4<f32>, cross: f32) -> vec2<f32> {
    return uncompress(d.xy, d, cross, CHOP_LEAST_SLOPE);
}

// Where the water at a world point comes from: a few fixed-point rounds, then Newton's method, which also gets to the
// steep places.
fn rest_of(point: vec2<f32>) -> vec2<f32> {
    var rest = point;
    var best = point;
    var least = 1e30;
    for (var round = 0u; round <= CHOP_FIXED_ROUNDS + CHOP_NEWTON_ROUNDS; round++) {
        let d = read_cascades(surface_displacement, rest);
        let miss = point - rest - d.xz;
        let residual = length(miss);
        if residual < least {
            least = residual;
            best = rest;
        }
        if residual < CHOP_TOLERANCE {
            break;
        }
        var step = miss;
        if round >= CHOP_FIXED_ROUNDS {
            step = uncompress(miss, read_cascades(surface_derivative, rest), d.w, CHOP_LEAST_STEP);
            step *= min(1.0, 4.0 * residual / length(step));
        }
        rest += step;
    }
    return best;
}

// The water at a world point (x, z): the horizontal displacement is inverted, the grids added.
fn surface_at(point: vec2<f32>) -> SurfacePoint {
    let rest = rest_of(point);
    let d = read_cascades(surface_displacement, rest);
    let grids = grids_at(point);
    let slope = world_slope(read_cascades(surface_derivative, rest), d.w) + grids.yz;
    return SurfacePoint(d.y + grids.x, normalize(vec3<f32>(-slope.x, 1.0, -slope.y)), rest);
}

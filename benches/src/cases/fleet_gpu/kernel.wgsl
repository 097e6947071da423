// One tick of boxes on eight force points over a height field that repeats. One thread a body; state in four vec4.
struct Settings {
    count: u32,
    cells: u32,
    dt: f32,
    cell: f32,
    half: vec4<f32>,
    inertia: vec4<f32>,
    mass: f32,
    weight: f32,
    drag: f32,
    spin_drag: f32,
}
struct Piece {
    position: vec4<f32>,
    orientation: vec4<f32>,
    velocity: vec4<f32>,
    spin: vec4<f32>,
}
@group(0) @binding(0) var<uniform> s: Settings;
@group(0) @binding(1) var<storage, read> field: array<f32>;
@group(0) @binding(2) var<storage, read_write> pieces: array<Piece>;
// 0 pre-rigid, 1 full tensor, 2 tensor inverted in the world's axes.
override ROTATION: u32;

fn rotation(q: vec4<f32>) -> mat3x3<f32> {
    let a = q.xyz * q.xyz;
    let b = q.xyz * q.yzx;
    let c = q.xyz * q.w;
    return mat3x3<f32>(
        vec3<f32>(1.0 - 2.0 * (a.y + a.z), 2.0 * (b.x + c.z), 2.0 * (b.z - c.y)),
        vec3<f32>(2.0 * (b.x - c.z), 1.0 - 2.0 * (a.x + a.z), 2.0 * (b.y + c.x)),
        vec3<f32>(2.0 * (b.z + c.y), 2.0 * (b.y - c.x), 1.0 - 2.0 * (a.x + a.y)),
    );
}

fn skew(v: vec3<f32>) -> mat3x3<f32> {
    return mat3x3<f32>(vec3<f32>(0.0, v.z, -v.y), vec3<f32>(-v.z, 0.0, v.x), vec3<f32>(v.y, -v.x, 0.0));
}

fn inverse(m: mat3x3<f32>) -> mat3x3<f32> {
    let a = cross(m[1], m[2]);
    let b = cross(m[2], m[0]);
    let c = cross(m[0], m[1]);
    return transpose(mat3x3<f32>(a, b, c)) * (1.0 / dot(m[2], c));
}

// Height and slope, bilinear.
fn water(at: vec2<f32>) -> vec3<f32> {
    let place = at / s.cell;
    let base = floor(place);
    let t = place - base;
    let mask = s.cells - 1u;
    let i = vec2<u32>(vec2<i32>(base)) & vec2<u32>(mask);
    let j = (i + 1u) & vec2<u32>(mask);
    let low = vec2<f32>(field[i.y * s.cells + i.x], field[i.y * s.cells + j.x]);
    let high = vec2<f32>(field[j.y * s.cells + i.x], field[j.y * s.cells + j.x]);
    let along = mix(low, high, t.y);
    let across = mix(vec2<f32>(low.x, high.x), vec2<f32>(low.y, high.y), t.x);
    return vec3<f32>(mix(along.x, along.y, t.x), (along.y - along.x) / s.cell, (across.y - across.x) / s.cell);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= s.count) {
        return;
    }
    var piece = pieces[id.x];
    let axes = rotation(piece.orientation);
    var force = vec3<f32>(0.0, -s.mass * 9.81, 0.0);
    var torque = vec3<f32>(0.0);
    var wet = 0.0;
    for (var k = 0u; k < 8u; k++) {
        let side = vec3<f32>(vec3<u32>(k, k >> 1u, k >> 2u) & vec3<u32>(1u)) - 0.5;
        let arm = axes * (side * s.half.xyz);
        let at = piece.position.xyz + arm;
        let h = water(at.xz);
        let gradient = vec3<f32>(-h.y, 1.0, -h.z);
        let extent = length(0.5 * s.half.xyz * (normalize(gradient) * axes));
        let share = clamp(0.5 + 0.5 * (h.x - at.y) / extent, 0.0, 1.0);
        let lift = gradient * (0.125 * s.weight * share);
        force += lift;
        torque += cross(arm, lift);
        wet += 0.125 * share;
    }
    var velocity = piece.velocity.xyz + force * (s.dt / s.mass);
    velocity /= 1.0 + s.dt * s.drag * wet * (1.0 + length(velocity));
    var spin = piece.spin.xyz;
    if (ROTATION == 2u) {
        let turning = mat3x3<f32>(vec3<f32>(s.inertia.x, 0.0, 0.0), vec3<f32>(0.0, s.inertia.y, 0.0), vec3<f32>(0.0, 0.0, s.inertia.z));
        let whole = axes * turning * transpose(axes);
        spin += inverse(whole) * (torque - cross(spin, whole * spin)) * s.dt;
    } else if (ROTATION == 1u) {
        var w = spin * axes + (torque * axes) / s.inertia.xyz * s.dt;
        let momentum = s.inertia.xyz * w;
        let diagonal = mat3x3<f32>(vec3<f32>(s.inertia.x, 0.0, 0.0), vec3<f32>(0.0, s.inertia.y, 0.0), vec3<f32>(0.0, 0.0, s.inertia.z));
        let jacobian = diagonal + (skew(w) * diagonal - skew(momentum)) * s.dt;
        w -= inverse(jacobian) * cross(w, momentum) * s.dt;
        spin = axes * w;
    } else {
        spin += torque / s.inertia.w * s.dt;
    }
    spin /= 1.0 + s.dt * s.spin_drag * wet;
    let turn = 0.5 * s.dt * spin;
    let q = piece.orientation;
    let turned = q + vec4<f32>(turn * q.w + cross(turn, q.xyz), -dot(turn, q.xyz));
    pieces[id.x] = Piece(
        vec4<f32>(piece.position.xyz + velocity * s.dt, 0.0),
        normalize(turned),
        vec4<f32>(velocity, 0.0),
        vec4<f32>(spin, 0.0),
    );
}

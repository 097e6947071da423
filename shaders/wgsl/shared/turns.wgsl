// (cos, sin) of turns / 2^32 turns, error below 1.5e-7.
fn turns_cos_sin(turns: u32) -> vec2<f32> {
    // The nearest quarter turn, and what is left, at most an eighth of a turn either way.
    let quarter = (turns + 0x20000000u) >> 30u;
    let rest = bitcast<i32>(turns - (quarter << 30u));
    let x = f32(rest) * TURNS_RADIANS;
    let x2 = x * x;
    let s = x + x * x2 * (TURNS_SIN.x + x2 * (TURNS_SIN.y + x2 * TURNS_SIN.z));
    let c = 1.0 - 0.5 * x2 + x2 * x2 * (TURNS_COS.x + x2 * (TURNS_COS.y + x2 * TURNS_COS.z));
    let r = select(vec2<f32>(c, s), vec2<f32>(-s, c), (quarter & 1u) == 1u);
    return select(r, -r, (quarter & 2u) == 2u);
}

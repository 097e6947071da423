//! Cosine and sine of an angle in 1/2^32 turns: the twin of `wgsl/shared/turns.wgsl`.
//!
//! WGSL's own `cos` and `sin` promise only 2^-11. Here the angle is exact, and the error below 1.5e-7.

use std::f32::consts::TAU;

/// Radians per 1/2^32 turn.
pub const RADIANS: f32 = TAU / 4_294_967_296.0;
/// Sine on [-pi/4, pi/4]: `x + x^3 (S[0] + S[1] x^2 + S[2] x^4)` (Cephes `sinf`).
pub const SIN: [f32; 3] = [-1.666_665_5e-1, 8.332_161e-3, -1.951_529_6e-4];
/// Cosine on [-pi/4, pi/4]: `1 - x^2/2 + x^4 (C[0] + C[1] x^2 + C[2] x^4)` (Cephes `cosf`).
pub const COS: [f32; 3] = [4.166_664_6e-2, -1.388_731_6e-3, 2.443_315_7e-5];

/// The constants as WGSL.
pub fn constants() -> String {
    let vec3 = |v: [f32; 3]| format!("vec3<f32>({:?}, {:?}, {:?})", v[0], v[1], v[2]);
    format!(
        "const TURNS_RADIANS: f32 = {RADIANS:?};\nconst TURNS_SIN = {};\nconst TURNS_COS = {};\n",
        vec3(SIN),
        vec3(COS)
    )
}

/// `(cos, sin)` of `turns` / 2^32 turns. Branch-free, so that loops over it vectorise.
#[inline]
pub fn cos_sin(turns: u32) -> [f32; 2] {
    // The nearest quarter turn, and what is left, at most an eighth of a turn either way.
    let quarter = turns.wrapping_add(1 << 29) >> 30;
    let rest = turns.wrapping_sub(quarter << 30) as i32;
    let x = rest as f32 * RADIANS;
    let x2 = x * x;
    let s = x + x * x2 * (SIN[0] + x2 * (SIN[1] + x2 * SIN[2]));
    let c = 1.0 - 0.5 * x2 + x2 * x2 * (COS[0] + x2 * (COS[1] + x2 * COS[2]));
    let (s, c) = if quarter & 1 == 0 { (s, c) } else { (c, s) };
    let flip_s = (quarter & 2) << 30;
    let flip_c = (quarter.wrapping_add(1) & 2) << 30;
    [f32::from_bits(c.to_bits() ^ flip_c), f32::from_bits(s.to_bits() ^ flip_s)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_is_below_1_5e_7() {
        let mut worst = 0.0f64;
        // All over the circle, and around every eighth of it, where the pieces meet.
        let all_over = (0..1_000_003u32).map(|i| i.wrapping_mul(4_294_957));
        let seams = (0..8u32).flat_map(|eighth| (-3..=3).map(move |off| (eighth << 29).wrapping_add_signed(off)));
        for turns in all_over.chain(seams) {
            let angle = f64::from(turns) / 4_294_967_296.0 * std::f64::consts::TAU;
            let [c, s] = cos_sin(turns).map(f64::from);
            worst = worst.max((c - angle.cos()).abs()).max((s - angle.sin()).abs());
        }
        assert!(worst < 1.5e-7, "{worst:e}");
        assert_eq!(cos_sin(0), [1.0, 0.0]);
        assert_eq!(cos_sin(1 << 31), [-1.0, 0.0]);
    }
}

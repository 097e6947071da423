//! Sine and cosine of an angle in turns of 2^32: exact argument reduction, no platform library, the same operations
//! everywhere. The WGSL passes do the same.

use std::f32::consts::TAU;

/// `(sin, cos)` of `turns / 2^32` of a turn, within 1.2e-7. Branch-free, so that loops over it vectorise.
#[inline]
pub fn sincos(turns: u32) -> (f32, f32) {
    let quadrant = turns.wrapping_add(1 << 29) >> 30;
    let rest = turns.wrapping_sub(quadrant << 30) as i32;
    // Within a quarter of pi; minimax polynomials of the Cephes library (sinf, cosf).
    let x = rest as f32 * (TAU / 4_294_967_296.0);
    let z = x * x;
    let sin = x + x * z * (-1.666_665_5e-1 + z * (8.332_161e-3 + z * -1.951_529_6e-4));
    let cos = 1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
    let (a, b) = if quadrant & 1 == 0 { (sin, cos) } else { (cos, sin) };
    let flip_sin = (quadrant & 2) << 30;
    let flip_cos = (quadrant.wrapping_add(1) & 2) << 30;
    (f32::from_bits(a.to_bits() ^ flip_sin), f32::from_bits(b.to_bits() ^ flip_cos))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn close_to_the_true_values() {
        let mut worst = 0.0f64;
        let check = |turns: u32, worst: &mut f64| {
            let angle = f64::from(turns) / 4_294_967_296.0 * std::f64::consts::TAU;
            let (sin, cos) = sincos(turns);
            *worst = worst.max((f64::from(sin) - angle.sin()).abs()).max((f64::from(cos) - angle.cos()).abs());
        };
        for i in 0..200_000u32 {
            check(i.wrapping_mul(0x9e37_79b9), &mut worst);
        }
        for eighth in 0..8u32 {
            for off in -3i32..=3 {
                check((eighth << 29).wrapping_add_signed(off), &mut worst);
            }
        }
        assert!(worst < 1.2e-7, "{worst:e}");
    }
}

//! Vectors, matrices and functions of eight pieces side by side.
//!
//! Each lane does what it would do alone, with additions, products, quotients and roots only: no fused multiply-add and no
//! function of the platform, so that every machine computes the same bits.

use std::f32::consts::FRAC_PI_2;
use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, f32x8, i32x8, prelude::*};
use glam::Vec3;

/// Pieces side by side.
pub(super) const LANES: usize = 8;
/// A number of each.
pub(super) type Row = [f32; LANES];

/// A number of each.
pub(super) type Num<S> = f32x8<S>;

#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, row: &Row) -> Num<S> {
    f32x8::from_slice(simd, row)
}

#[inline(always)]
pub(super) fn pair<S: Simd>(simd: S, rows: &[Row; 2]) -> [Num<S>; 2] {
    [load(simd, &rows[0]), load(simd, &rows[1])]
}

/// A vector of each.
#[derive(Clone, Copy)]
pub(super) struct V3<S: Simd> {
    pub(super) x: Num<S>,
    pub(super) y: Num<S>,
    pub(super) z: Num<S>,
}

impl<S: Simd> V3<S> {
    #[inline(always)]
    pub(super) fn new(x: Num<S>, y: Num<S>, z: Num<S>) -> Self {
        Self { x, y, z }
    }

    /// The same for all.
    #[inline(always)]
    pub(super) fn all(simd: S, v: Vec3) -> Self {
        Self::new(f32x8::splat(simd, v.x), f32x8::splat(simd, v.y), f32x8::splat(simd, v.z))
    }

    #[inline(always)]
    pub(super) fn load(simd: S, rows: &[Row; 3]) -> Self {
        Self::new(load(simd, &rows[0]), load(simd, &rows[1]), load(simd, &rows[2]))
    }

    #[inline(always)]
    pub(super) fn store(self, rows: &mut [Row; 3]) {
        self.x.store_slice(&mut rows[0]);
        self.y.store_slice(&mut rows[1]);
        self.z.store_slice(&mut rows[2]);
    }

    #[inline(always)]
    pub(super) fn dot(self, o: Self) -> Num<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    #[inline(always)]
    pub(super) fn cross(self, o: Self) -> Self {
        Self::new(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }

    #[inline(always)]
    pub(super) fn scale(self, by: Num<S>) -> Self {
        Self::new(self.x * by, self.y * by, self.z * by)
    }

    #[inline(always)]
    pub(super) fn over(self, o: Self) -> Self {
        Self::new(self.x / o.x, self.y / o.y, self.z / o.z)
    }

    /// No longer than `most`.
    #[inline(always)]
    pub(super) fn shortened(self, simd: S, most: f32) -> Self {
        let most = f32x8::splat(simd, most);
        self.scale(most / self.dot(self).sqrt().max(most))
    }

    #[inline(always)]
    pub(super) fn either(mask: <Num<S> as SimdBase<S>>::Mask, a: Self, b: Self) -> Self {
        Self::new(mask.select(a.x, b.x), mask.select(a.y, b.y), mask.select(a.z, b.z))
    }
}

impl<S: Simd> Add for V3<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<S: Simd> Sub for V3<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl<S: Simd> Mul for V3<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self::new(self.x * o.x, self.y * o.y, self.z * o.z)
    }
}

/// A matrix of each, by columns.
#[derive(Clone, Copy)]
pub(super) struct M3<S: Simd> {
    pub(super) x: V3<S>,
    pub(super) y: V3<S>,
    pub(super) z: V3<S>,
}

impl<S: Simd> M3<S> {
    #[inline(always)]
    pub(super) fn times(&self, v: V3<S>) -> V3<S> {
        self.x.scale(v.x) + self.y.scale(v.y) + self.z.scale(v.z)
    }

    /// The transposed matrix times `v`.
    #[inline(always)]
    pub(super) fn back(&self, v: V3<S>) -> V3<S> {
        V3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// The solution of `self * x = v`, by Cramer's rule.
    #[inline(always)]
    pub(super) fn solve(&self, simd: S, v: V3<S>) -> V3<S> {
        let (a, b, c) = (self.y.cross(self.z), self.z.cross(self.x), self.x.cross(self.y));
        let inverse = f32x8::splat(simd, 1.0) / self.x.dot(a);
        V3::new(a.dot(v), b.dot(v), c.dot(v)).scale(inverse)
    }
}

/// A rotation of each, a unit quaternion.
#[derive(Clone, Copy)]
pub(super) struct Turn<S: Simd> {
    pub(super) v: V3<S>,
    pub(super) w: Num<S>,
}

impl<S: Simd> Turn<S> {
    #[inline(always)]
    pub(super) fn load(simd: S, rows: &[Row; 4]) -> Self {
        let [x, y, z, w] = rows;
        Self { v: V3::new(load(simd, x), load(simd, y), load(simd, z)), w: load(simd, w) }
    }

    #[inline(always)]
    pub(super) fn store(self, rows: &mut [Row; 4]) {
        self.v.x.store_slice(&mut rows[0]);
        self.v.y.store_slice(&mut rows[1]);
        self.v.z.store_slice(&mut rows[2]);
        self.w.store_slice(&mut rows[3]);
    }

    /// Body to world: see [`matrix`](crate::rotation::matrix).
    #[inline(always)]
    pub(super) fn matrix(&self) -> M3<S> {
        let V3 { x, y, z } = self.v;
        let two = -((self.v.dot(self.v) + self.w * self.w) * 2.0) + 4.0;
        let (x2, y2, z2, w2) = (x * two, y * two, z * two, self.w * two);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (w2 * x, w2 * y, w2 * z);
        M3 {
            x: V3::new(-(yy + zz) + 1.0, xy + wz, xz - wy),
            y: V3::new(xy - wz, -(xx + zz) + 1.0, yz + wx),
            z: V3::new(xz + wy, yz - wx, -(xx + yy) + 1.0),
        }
    }

    /// Turned further by the Cayley map of `turn` (body axes), as [`turned`](crate::rotation::turned).
    #[inline(always)]
    pub(super) fn turned(&self, simd: S, turn: V3<S>) -> Self {
        let t = turn.scale(f32x8::splat(simd, 0.5));
        let v = t.scale(self.w) + self.v + self.v.cross(t);
        let w = self.w - self.v.dot(t);
        let inverse = f32x8::splat(simd, 1.0) / (v.dot(v) + w * w).sqrt();
        Self { v: v.scale(inverse), w: w * inverse }
    }
}

/// The exponential of numbers that are not positive: within 2e-7 of its value, 0 at -87 and below.
#[inline(always)]
pub(super) fn exp<S: Simd>(simd: S, x: Num<S>) -> Num<S> {
    let x = x.max(f32x8::splat(simd, -87.0));
    // Doublings apart: x = n ln 2 + r with |r| <= ln 2 / 2, truncation being towards zero.
    let n: i32x8<S> = (x * std::f32::consts::LOG2_E - 0.5).to_int();
    let whole: f32x8<S> = n.to_float();
    let r = (x - whole * 0.693_359_4) + whole * 2.121_944_4e-4;
    // Taylor's series.
    let mut sum = r * (1.0 / 720.0) + 1.0 / 120.0;
    for c in [1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
        sum = sum * r + c;
    }
    let power: f32x8<S> = ((n + 127) << 23).bitcast();
    sum * power
}

/// The arc sine of numbers from -1 to 1, within 1e-6 (Abramowitz and Stegun, 4.4.46).
#[inline(always)]
pub(super) fn asin<S: Simd>(simd: S, x: Num<S>) -> Num<S> {
    let a = x.abs();
    let mut sum = a * -0.001_262_491_1 + 0.006_670_09;
    for c in [-0.017_088_126, 0.030_891_88, -0.050_174_303, 0.088_978_99, -0.214_598_8, FRAC_PI_2] {
        sum = sum * a + c;
    }
    let root = (-a + 1.0).max(f32x8::splat(simd, 0.0)).sqrt();
    (-(root * sum) + FRAC_PI_2).copysign(x)
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    #[inline(always)]
    fn worst<S: Simd>(simd: S) -> [f64; 2] {
        let mut worst = [0.0_f64; 2];
        for i in 0..=20_000 {
            let x = -87.0 * i as f32 / 20_000.0;
            let e = exp(simd, f32x8::splat(simd, x)).to_array()[3];
            worst[0] = worst[0].max((f64::from(e) / f64::from(x).exp() - 1.0).abs());
            let x = (i - 10_000) as f32 / 10_000.0;
            let a = asin(simd, f32x8::splat(simd, x)).to_array()[5];
            worst[1] = worst[1].max((f64::from(a) - f64::from(x).asin()).abs());
        }
        worst
    }

    #[test]
    fn functions_are_what_they_say() {
        let [exp, asin] = dispatch!(Level::new(), simd => worst(simd));
        assert!(exp < 5e-7, "{exp}");
        assert!(asin < 1e-6, "{asin}");
    }
}

//! What inner loops compute with: one value, or as many as the machine's vectors hold. Each lane does the same operations in
//! the same order, without fused multiply-add, so that the bits are the same.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, prelude::*};
use open_water_shaders::grid::TINY;

use crate::cpu::kernels::{flush, note};

/// Numbers of neighbouring cells.
pub(crate) trait Lanes: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// What makes them.
    type Make: Copy;
    /// How many.
    const LEN: usize;
    /// Those from `from[i]` on.
    fn load(make: Self::Make, from: &[f32], i: usize) -> Self;
    /// The same number for all.
    fn all(make: Self::Make, value: f32) -> Self;
    /// The lesser of each; no number is NaN.
    fn lesser(self, other: Self) -> Self;
    /// See [`flush`].
    fn flushed(self) -> Self;
    /// Writes them from `to[i]` on.
    fn store(self, to: &mut [f32], i: usize);
    /// See [`note`].
    fn note(self, most: &mut [f32], i: usize);
}

impl Lanes for f32 {
    type Make = ();
    const LEN: usize = 1;

    #[inline(always)]
    fn load(_: (), from: &[f32], i: usize) -> f32 {
        from[i]
    }

    #[inline(always)]
    fn all(_: (), value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn lesser(self, other: f32) -> f32 {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn flushed(self) -> f32 {
        flush(self)
    }

    #[inline(always)]
    fn store(self, to: &mut [f32], i: usize) {
        to[i] = self;
    }

    #[inline(always)]
    fn note(self, most: &mut [f32], i: usize) {
        note(&mut most[i], self);
    }
}

/// Where numbers are read: from cell `i` of what is given on. Methods, as closures are not inlined for certain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct At<L: Lanes> {
    pub(crate) make: L::Make,
    pub(crate) i: usize,
}

impl<L: Lanes> At<L> {
    /// `offset` cells further.
    #[inline(always)]
    pub(crate) fn get(self, from: &[f32], offset: usize) -> L {
        L::load(self.make, from, self.i + offset)
    }

    #[inline(always)]
    pub(crate) fn all(self, value: f32) -> L {
        L::all(self.make, value)
    }
}

/// A vector.
#[derive(Clone, Copy)]
pub(crate) struct Vector<S: Simd>(S, S::f32s);

impl<S: Simd> Add for Vector<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0, self.1 + other.1)
    }
}

impl<S: Simd> Sub for Vector<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0, self.1 - other.1)
    }
}

impl<S: Simd> Mul for Vector<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0, self.1 * other.1)
    }
}

impl<S: Simd> Lanes for Vector<S> {
    type Make = S;
    const LEN: usize = S::f32s::LEN;

    #[inline(always)]
    fn load(simd: S, from: &[f32], i: usize) -> Self {
        Self(simd, S::f32s::from_slice(simd, &from[i..i + Self::LEN]))
    }

    #[inline(always)]
    fn all(simd: S, value: f32) -> Self {
        Self(simd, S::f32s::splat(simd, value))
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self(self.0, self.1.min(other.1))
    }

    #[inline(always)]
    fn flushed(self) -> Self {
        // Sizes compare as their bits do; a NaN stays.
        let bits: S::i32s = self.1.abs().bitcast();
        let least = S::i32s::splat(self.0, TINY.to_bits() as i32 - 1);
        Self(self.0, bits.simd_gt(least).select(self.1, S::f32s::splat(self.0, 0.0)))
    }

    #[inline(always)]
    fn store(self, to: &mut [f32], i: usize) {
        self.1.store_slice(&mut to[i..i + Self::LEN]);
    }

    #[inline(always)]
    fn note(self, most: &mut [f32], i: usize) {
        let most = &mut most[i..i + Self::LEN];
        self.1.abs().max(S::f32s::from_slice(self.0, most)).store_slice(most);
    }
}

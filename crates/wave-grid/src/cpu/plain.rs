//! Open water of uniform c, away from the layer: the bulk of all steps, at the speed of the memory.
//!
//! Several rows at once, so that a row is loaded and summed once and not three times; vectors of the machine's width.

use std::ops::Range;

use fearless_simd::{Simd, prelude::*};
use open_water_shaders::grid::TINY;

use crate::{GridDesc, Scheme, Stepping};

/// Rows that are stepped together.
pub(crate) const ROWS: usize = 4;

/// z+ = middle z - keep z_old + sum over the 8 neighbours. Multiples of 2^-23, so that `middle` is exactly
/// 1 + keep - the sum of the others, and level water neither rises nor falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlainLaw {
    /// 2 - those of the eight neighbours, where undamped.
    middle: f32,
    /// (1 - s)/(1 + s), s = sigma dt / 2.
    keep: f32,
    /// Of the neighbours along x and z.
    edge: [f32; 2],
    /// Of the diagonal ones.
    corner: f32,
}

impl PlainLaw {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping) -> Self {
        let (straight, beside) = desc.scheme.weights();
        let s = 0.5 * f64::from(desc.damping) * stepping.dt;
        let [x, z] = stepping.a.map(|a| a / (1.0 + s));
        let rounded = |v: f64| (v * f64::from(1 << 23)).round() / f64::from(1 << 23);
        let edge = [x * straight - z * 2.0 * beside, z * straight - x * 2.0 * beside].map(rounded);
        let corner = if desc.scheme == Scheme::NinePoint { rounded((x + z) * beside) } else { 0.0 };
        let keep = rounded((1.0 - s) / (1.0 + s));
        let middle = 1.0 + keep - 2.0 * (edge[0] + edge[1]) - 4.0 * corner;
        Self { middle: middle as f32, keep: keep as f32, edge: edge.map(|v| v as f32), corner: corner as f32 }
    }
}

/// Cells `x` of rows `first..first + rows` of the window: `z` is all of it, `old` begins at row `first`. Notes the largest
/// new |z| of each column in `most`, one for each column of the window. `faint` where values may be small enough to become
/// denormals, which are many times slower.
pub(crate) struct Block<'a> {
    pub(crate) nx: usize,
    pub(crate) z: &'a [f32],
    pub(crate) first: usize,
    pub(crate) rows: usize,
    pub(crate) x: Range<usize>,
}

impl Block<'_> {
    #[inline(always)]
    pub(crate) fn step<S: Simd>(&self, simd: S, old: &mut [f32], most: &mut [f32], law: &PlainLaw, faint: bool) {
        let nine = law.corner != 0.0;
        match (nine, law.keep != 1.0, faint) {
            (true, false, false) => self.all::<S, true, false, false>(simd, old, most, law),
            (true, false, true) => self.all::<S, true, false, true>(simd, old, most, law),
            (true, true, _) => self.all::<S, true, true, true>(simd, old, most, law),
            (false, false, false) => self.all::<S, false, false, false>(simd, old, most, law),
            (false, false, true) => self.all::<S, false, false, true>(simd, old, most, law),
            (false, true, _) => self.all::<S, false, true, true>(simd, old, most, law),
        }
    }

    #[inline(always)]
    fn all<S: Simd, const NINE: bool, const DAMPED: bool, const FAINT: bool>(
        &self,
        simd: S,
        old: &mut [f32],
        most: &mut [f32],
        law: &PlainLaw,
    ) {
        let law = Law::<S, NINE, DAMPED, FAINT>::new(simd, law);
        let (nx, x) = (self.nx, &self.x);
        let most = &mut most[x.start - 1..x.end + 1];
        let (mut j, end) = (self.first, self.first + self.rows);
        let mut old = old;
        while j + ROWS <= end {
            let (four, rest) = old.split_at_mut(ROWS * nx);
            let (low, high) = four.split_at_mut(2 * nx);
            let ((a, b), (c, d)) = (low.split_at_mut(nx), high.split_at_mut(nx));
            let of = |j: usize| j * nx + x.start - 1..j * nx + x.end + 1;
            let (own, z) = (of(0), self.z);
            let z = [&z[of(j - 1)], &z[of(j)], &z[of(j + 1)], &z[of(j + 2)], &z[of(j + 3)], &z[of(j + 4)]];
            let four = [&mut a[own.clone()], &mut b[own.clone()], &mut c[own.clone()], &mut d[own]];
            law.rows::<ROWS>(z, four, most);
            (old, j) = (rest, j + ROWS);
        }
        while j < end {
            let (one, rest) = old.split_at_mut(nx);
            let of = |j: usize| j * nx + x.start - 1..j * nx + x.end + 1;
            let (own, z) = (of(0), self.z);
            let north = &z[of(j + 1)];
            law.rows::<1>([&z[of(j - 1)], &z[of(j)], north, north, north, north], [&mut one[own]], most);
            (old, j) = (rest, j + 1);
        }
    }
}

/// The law in every lane.
#[derive(Clone, Copy)]
struct Law<S: Simd, const NINE: bool, const DAMPED: bool, const FAINT: bool> {
    simd: S,
    middle: S::f32s,
    keep: S::f32s,
    edge: [S::f32s; 2],
    corner: S::f32s,
    scalar: PlainLaw,
}

impl<S: Simd, const NINE: bool, const DAMPED: bool, const FAINT: bool> Law<S, NINE, DAMPED, FAINT> {
    #[inline(always)]
    fn new(simd: S, law: &PlainLaw) -> Self {
        let all = |v: f32| S::f32s::splat(simd, v);
        Self {
            simd,
            middle: all(law.middle),
            keep: all(law.keep),
            edge: law.edge.map(all),
            corner: all(law.corner),
            scalar: *law,
        }
    }

    /// Steps `R` rows in place of `old`. All slices have one length, one cell more on both sides than is stepped; of the
    /// rows of `z` the first R + 2 are read.
    #[inline(always)]
    fn rows<const R: usize>(&self, z: [&[f32]; ROWS + 2], mut old: [&mut [f32]; R], most: &mut [f32]) {
        let lanes = S::f32s::LEN;
        let len = most.len();
        let [a, b, c, d, e, f] = z;
        let z = [&a[..len], &b[..len], &c[..len], &d[..len], &e[..len], &f[..len]];
        for row in &old {
            // Known to the compiler from here on.
            assert_eq!(row.len(), len);
        }
        if len < lanes + 2 {
            for i in 0..len.saturating_sub(2) {
                for r in 0..R {
                    let next = self.one([&z[r][i..i + 3], &z[r + 1][i..i + 3], &z[r + 2][i..i + 3]], old[r][i + 1]);
                    old[r][i + 1] = next;
                    super::kernels::note(&mut most[i + 1], next);
                }
            }
            return;
        }
        // The last vector overlaps the one before: it is made first, of what is still old.
        let last = len - lanes - 2;
        let ending = self.vector(last, &z, &old);
        let mut i = 0;
        while i + lanes + 2 <= len {
            let next = self.vector(i, &z, &old);
            self.store(i, next, &mut old, most);
            i += lanes;
        }
        self.store(last, ending, &mut old, most);
    }

    /// Cells from `i + by` on. Every slice is cut at the same place first, so that one check does for all.
    #[inline(always)]
    fn cut(&self, row: &[f32], i: usize, by: usize) -> S::f32s {
        let lanes = S::f32s::LEN;
        S::f32s::from_slice(self.simd, &row[i..i + lanes + 2][by..by + lanes])
    }

    /// The sum of the cells before and after.
    #[inline(always)]
    fn beside(&self, row: &[f32], i: usize) -> S::f32s {
        self.cut(row, i, 0) + self.cut(row, i, 2)
    }

    /// The next values of a vector of columns in each row.
    #[inline(always)]
    fn vector<const R: usize>(&self, i: usize, z: &[&[f32]; ROWS + 2], old: &[&mut [f32]; R]) -> [S::f32s; R] {
        let (mut south, mut here) = (self.cut(z[0], i, 1), self.cut(z[1], i, 1));
        let mut beside_south = if NINE { self.beside(z[0], i) } else { south };
        let mut beside_here = self.beside(z[1], i);
        let mut next = [south; R];
        for r in 0..R {
            let north = self.cut(z[r + 2], i, 1);
            let beside_north = if NINE || r + 1 < R { self.beside(z[r + 2], i) } else { north };
            let mut sum = self.edge[0] * beside_here + self.edge[1] * (south + north);
            if NINE {
                sum += self.corner * (beside_south + beside_north);
            }
            let before = self.cut(old[r], i, 1);
            let before = if DAMPED { self.keep * before } else { before };
            next[r] = (sum - before) + self.middle * here;
            (south, here, beside_south, beside_here) = (here, north, beside_here, beside_north);
        }
        next
    }

    #[inline(always)]
    fn store<const R: usize>(&self, i: usize, next: [S::f32s; R], old: &mut [&mut [f32]; R], most: &mut [f32]) {
        let lanes = S::f32s::LEN;
        let most = &mut most[i..i + lanes + 2][1..lanes + 1];
        let mut largest = S::f32s::from_slice(self.simd, most);
        for (next, old) in next.into_iter().zip(old) {
            let size = next.abs();
            let next = if FAINT {
                // Sizes compare as their bits do; a NaN stays.
                let bits: S::i32s = size.bitcast();
                let least = S::i32s::splat(self.simd, TINY.to_bits() as i32 - 1);
                bits.simd_gt(least).select(next, S::f32s::splat(self.simd, 0.0))
            } else {
                next
            };
            largest = size.max(largest);
            next.store_slice(&mut old[i..i + lanes + 2][1..lanes + 1]);
        }
        largest.store_slice(most);
    }

    /// One cell, as a lane of [`Self::vector`]: rows south of it, its own and north of it, three cells each.
    #[inline(always)]
    fn one(&self, [south, here, north]: [&[f32]; 3], old: f32) -> f32 {
        let law = &self.scalar;
        let beside = |row: &[f32]| row[0] + row[2];
        let mut sum = law.edge[0] * beside(here) + law.edge[1] * (south[1] + north[1]);
        if NINE {
            sum += law.corner * (beside(south) + beside(north));
        }
        let next = (sum - law.keep * old) + law.middle * here[1];
        if FAINT { super::kernels::flush(next) } else { next }
    }
}

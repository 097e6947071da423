//! Open water of one depth, away from the layer.

use fearless_simd::Simd;

use crate::cpu::lanes::{At, Lanes, Vector};
use crate::dispersive::{FIELDS, Law};

/// A row of a field with those below and above; each has one more cell at both ends.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    pub(crate) below: &'a [f32],
    pub(crate) row: &'a [f32],
    pub(crate) above: &'a [f32],
}

/// What a row reads: the potential, the screened fields, its heights.
pub(crate) struct Input<'a> {
    pub(crate) potential: Around<'a>,
    pub(crate) screened: [Around<'a>; FIELDS],
    pub(crate) z: &'a [f32],
}

/// What a row writes; `older` holds the screened fields of a sub-step ago.
pub(crate) struct Output<'a> {
    pub(crate) z: &'a mut [f32],
    pub(crate) potential: &'a mut [f32],
    pub(crate) older: [&'a mut [f32]; FIELDS],
    /// Takes the largest |z| and |P| of each column.
    pub(crate) most: &'a mut [f32],
}

/// Cells of a row. With `FAINT` what would become denormal is zeroed.
#[inline(always)]
pub(crate) fn plain_row<S: Simd, const FAINT: bool>(simd: S, input: &Input, out: &mut Output, law: &Law) {
    let n = out.z.len();
    let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
    let mut i = 0;
    while i < vectors {
        cells::<_, FAINT>(At::<Vector<S>> { make: simd, i }, input, out, law);
        i += Vector::<S>::LEN;
    }
    for i in vectors..n {
        cells::<_, FAINT>(At::<f32> { make: (), i }, input, out, law);
    }
}

/// L(u) with weights of 1, and u.
#[inline(always)]
fn laplacian<L: Lanes>(at: At<L>, u: &Around) -> [L; 2] {
    let here = at.get(u.row, 1);
    let sides = at.get(u.row, 0) + at.get(u.row, 2);
    let ends = at.get(u.below, 1) + at.get(u.above, 1);
    [(sides + ends) - at.all(4.0) * here, here]
}

#[inline(always)]
fn cells<L: Lanes, const FAINT: bool>(at: At<L>, input: &Input, out: &mut Output, law: &Law) {
    let flushed = |v: L| if FAINT { v.flushed() } else { v };
    let [lap, p] = laplacian(at, &input.potential);
    let mut a = at.all(law.c) * lap;
    for k in 0..FIELDS {
        let [lap, x] = laplacian(at, &input.screened[k]);
        let pull = at.all(law.r[k]) * (p - x);
        a = a - pull;
        let older = at.get(out.older[k], 0);
        let next = ((x + x) - older) + at.all(law.m[k]) * (at.all(law.s[k]) * lap + pull);
        flushed(next).store(out.older[k], at.i);
    }
    let z = flushed(at.get(input.z, 0) - a);
    let next = flushed(at.all(2.0 * law.damp - 1.0) * p - at.all(law.damp * law.g) * z);
    z.store(out.z, at.i);
    next.store(out.potential, at.i);
    z.note(out.most, at.i);
}

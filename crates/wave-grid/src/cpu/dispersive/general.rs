//! Cells in the border layer, over a bed or beside walls.

use fearless_simd::Simd;

use super::plain::{Around, Input, Output};
use crate::cpu::lanes::{At, Lanes, Vector};
use crate::dispersive::layer::MEMORIES;
use crate::dispersive::{FIELDS, Law};

/// Coefficients of a row where the medium varies.
#[derive(Clone, Copy)]
pub(crate) struct BedRow<'a> {
    /// c and s of the faces along x, one more than cells.
    pub(crate) along: [&'a [f32]; MEMORIES],
    /// Those of the faces along z below and above.
    pub(crate) below: [&'a [f32]; MEMORIES],
    pub(crate) above: [&'a [f32]; MEMORIES],
    pub(crate) m: [&'a [f32]; FIELDS],
    /// 1 / (1 + sigma dt / 2); 0 in walls and held water.
    pub(crate) damp: &'a [f32],
}

/// The layer along one axis: psi on the faces before and after the cells, zeta, and the factors of zeta.
pub(crate) struct LayerRow<'a> {
    pub(crate) before: [&'a [f32]; MEMORIES],
    pub(crate) after: [&'a [f32]; MEMORIES],
    pub(crate) zeta: [&'a mut [f32]; MEMORIES],
    /// b and c at the cells; along z of the row.
    pub(crate) factors: Factors<'a>,
}

#[derive(Clone, Copy)]
pub(crate) enum Factors<'a> {
    Cells([&'a [f32]; 2]),
    Row([f32; 2]),
}

impl Factors<'_> {
    #[inline(always)]
    fn at<L: Lanes>(&self, at: At<L>) -> [L; 2] {
        match self {
            Self::Cells([b, c]) => [at.get(b, 0), at.get(c, 0)],
            Self::Row([b, c]) => [at.all(*b), at.all(*c)],
        }
    }
}

/// Where a row lies.
pub(crate) struct General<'a> {
    pub(crate) bed: Option<BedRow<'a>>,
    pub(crate) along: Option<LayerRow<'a>>,
    pub(crate) across: Option<LayerRow<'a>>,
}

impl General<'_> {
    #[inline(always)]
    pub(crate) fn row<S: Simd>(&mut self, simd: S, input: &Input, out: &mut Output, law: &Law) {
        let n = out.z.len();
        let vectors = n / Vector::<S>::LEN * Vector::<S>::LEN;
        let mut i = 0;
        while i < vectors {
            self.cells(At::<Vector<S>> { make: simd, i }, input, out, law);
            i += Vector::<S>::LEN;
        }
        for i in vectors..n {
            self.cells(At::<f32> { make: (), i }, input, out, law);
        }
    }

    /// L_w of field `k` and its value; w is `plain` where there is no bed.
    #[inline(always)]
    fn laplacian<L: Lanes>(&mut self, at: At<L>, k: usize, plain: f32, u: &Around) -> [L; 2] {
        let here = at.get(u.row, 1);
        let (mut west, mut east) = (here - at.get(u.row, 0), at.get(u.row, 2) - here);
        let (mut south, mut north) = (here - at.get(u.below, 1), at.get(u.above, 1) - here);
        if let Some(layer) = &self.along {
            west = west + at.get(layer.before[k], 0);
            east = east + at.get(layer.after[k], 0);
        }
        if let Some(layer) = &self.across {
            south = south + at.get(layer.before[k], 0);
            north = north + at.get(layer.after[k], 0);
        }
        let [mut along, mut across] = match &self.bed {
            Some(bed) => [
                at.get(bed.along[k], 1) * east - at.get(bed.along[k], 0) * west,
                at.get(bed.above[k], 0) * north - at.get(bed.below[k], 0) * south,
            ],
            None => [at.all(plain) * (east - west), at.all(plain) * (north - south)],
        };
        for (layer, flux) in [(&mut self.along, &mut along), (&mut self.across, &mut across)] {
            if let Some(layer) = layer {
                let [b, c] = layer.factors.at(at);
                let zeta = (b * at.get(layer.zeta[k], 0) + c * *flux).flushed();
                zeta.store(layer.zeta[k], at.i);
                *flux = *flux + zeta;
            }
        }
        [along + across, here]
    }

    #[inline(always)]
    fn cells<L: Lanes>(&mut self, at: At<L>, input: &Input, out: &mut Output, law: &Law) {
        let (mut damp, mut open) = (at.all(law.damp), at.all(1.0));
        if let Some(bed) = &self.bed {
            damp = at.get(bed.damp, 0);
            // 0 in walls and held water, 1 elsewhere.
            open = (at.all(1e8) * damp).lesser(open);
        }
        let [mut a, p] = self.laplacian(at, 0, law.c, &input.potential);
        for k in 0..FIELDS {
            let [lap, x] = self.laplacian(at, k + 1, law.s[k], &input.screened[k]);
            let pull = at.all(law.r[k]) * (p - x);
            a = a - pull;
            let older = at.get(out.older[k], 0);
            let m = match &self.bed {
                Some(bed) => at.get(bed.m[k], 0),
                None => at.all(law.m[k]),
            };
            let next = open * (((x + x) - older) + m * (lap + pull));
            next.flushed().store(out.older[k], at.i);
        }
        let z = (open * (at.get(input.z, 0) - a)).flushed();
        let next = (at.all(2.0) * damp - open) * p - (damp * at.all(law.g)) * z;
        z.store(out.z, at.i);
        next.flushed().store(out.potential, at.i);
        z.note(out.most, at.i);
    }
}

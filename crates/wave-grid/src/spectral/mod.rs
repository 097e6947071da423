//! The exact scheme over water of one depth: what [`crate::Scheme::Spectral`] keeps besides the heights, and its step.
//!
//! Any step is exact but for rounding. The window is one period of a plane of its copies: at a border that absorbs, heights and
//! potential are damped in each step, by more towards the edge, so that what leaves does not come back from the other side.

mod mode;
mod transform;

use crate::border::Border;
use crate::desc::GRAVITY;
use crate::field::Field;
use crate::{GridDesc, Stepping};
use mode::Law;
use transform::{Patch, Propagator};

/// What damping at the outer edge takes, 1/s, times sqrt(width in metres / g): the time that a wave as long as the border is wide
/// needs to cross it.
const STRENGTH: f64 = 2.0;

/// The potential, and what steps it and the heights.
#[derive(Debug, Clone)]
pub(crate) struct Spectral {
    /// P = phi / sqrt(g D), metres, D the cell size.
    p: Field,
    propagator: Propagator,
    patch: Patch,
    /// What a metre of head changes P by in a tick.
    press: f32,
}

impl Spectral {
    /// Calm water.
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping) -> Self {
        let [nx, nz] = desc.cells.map(|n| n as usize);
        let h = desc.cell_size.map(f64::from);
        let law = law(desc, stepping);
        // A window that repeats does so without its outermost ring.
        let ring = usize::from(desc.border == Border::Periodic);
        let mask = [0, 1].map(|axis| mask(desc, stepping, axis));
        Self {
            p: Field::new(nx, nz, 0.0, 2),
            propagator: Propagator::new([nx - 2 * ring, nz - 2 * ring], h, law),
            patch: Patch { width: nx, first: ring, mask },
            press: (GRAVITY * law.dt * f64::from(stepping.substeps) / law.unit()) as f32,
        }
    }

    /// One sub-step: `next` takes the heights after those in `now`. The outermost ring of what repeats is left as it is.
    pub(crate) fn step(&mut self, now: &[f32], next: &mut [f32]) {
        self.propagator.step(&self.patch, now, next, &mut self.p);
    }

    /// A tick's pressure over rho g at a cell, metres.
    pub(crate) fn press(&mut self, at: usize, head: f32) {
        self.p[at] -= self.press * head;
    }

    /// The window moved: the water stands still, what enters is calm.
    pub(crate) fn shift(&mut self, shift: [i64; 2]) {
        self.p.shift(shift);
    }

    /// Stills the water.
    pub(crate) fn clear(&mut self) {
        self.p.fill(0.0);
    }

    /// P of all cells.
    pub(crate) fn potential(&self) -> &Field {
        &self.p
    }

    /// P of all cells.
    pub(crate) fn potential_mut(&mut self) -> &mut Field {
        &mut self.p
    }
}

/// The water of a grid and the time of its sub-step.
fn law(desc: &GridDesc, stepping: &Stepping) -> Law {
    let [hx, hz] = desc.cell_size.map(f64::from);
    Law {
        depth: f64::from(desc.depth),
        damping: f64::from(desc.damping),
        dt: stepping.dt,
        cell: libm::sqrt(hx * hz),
    }
}

/// Factors of a sub-step along an axis: 1 inside, 0 on the outermost ring.
fn mask(desc: &GridDesc, stepping: &Stepping, axis: usize) -> Vec<f32> {
    let n = desc.cells[axis] as usize;
    let width = desc.border.width() as usize;
    if width == 0 {
        return vec![1.0; n];
    }
    let metres = width as f64 * f64::from(desc.cell_size[axis]);
    let rate = STRENGTH * libm::sqrt(GRAVITY / metres) * stepping.dt;
    let at = |i: usize| match i.min(n - 1 - i) {
        0 => 0.0,
        from_edge => {
            let d = (1.0 - (from_edge as f64 - 0.5) / width as f64).max(0.0);
            libm::exp(-rate * d * d * d) as f32
        }
    };
    (0..n).map(at).collect()
}

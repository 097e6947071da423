//! The exact scheme over water of one depth: what [`crate::Scheme::Spectral`] keeps besides the heights, and its step.
//!
//! Any step is exact but for rounding. The window is one period of a plane of its copies: at a border that absorbs, heights and
//! potential are damped in each step, by more towards the edge, so that what leaves does not come back from the other side.

mod mode;
#[cfg(test)]
mod tests;
mod transform;

use std::f64::consts::TAU;

use rustfft::num_complex::Complex64;

use crate::border::Border;
use crate::desc::GRAVITY;
use crate::field::Field;
use crate::fourier::Fourier;
use crate::plane::Plane;
use crate::source::HEIGHT_LIMIT;
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
    law: Law,
    size: [usize; 2],
    cell: [f64; 2],
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
        let size = [nx - 2 * ring, nz - 2 * ring];
        Self {
            p: Field::new(nx, nz, 0.0, 2),
            propagator: Propagator::new(size, h, law),
            patch: Patch { width: nx, first: ring, mask },
            press: (GRAVITY * law.dt * f64::from(stepping.substeps) / law.unit()) as f32,
            law,
            size,
            cell: h,
        }
    }

    /// One sub-step: `next` takes the heights after those in `now`. The outermost ring of what repeats is left as it is.
    pub(crate) fn step(&mut self, now: &[f32], next: &mut [f32]) {
        self.propagator.step(&self.patch, now, next, &mut self.p);
    }

    /// A tick's pressure over rho g at a cell, metres. By how much P changes.
    pub(crate) fn press(&mut self, at: usize, head: f32) -> f32 {
        let kick = self.press * head;
        self.p[at] = (self.p[at] - kick).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
        kick.abs()
    }

    /// The window moved: the water stands still, what enters is calm.
    pub(crate) fn shift(&mut self, shift: [i64; 2]) {
        self.p.shift(shift);
    }

    /// Stills the water.
    pub(crate) fn clear(&mut self) {
        self.p.fill(0.0);
    }

    /// Finds P of waves from their heights now and a sub-step ago.
    pub(crate) fn start(&mut self, desc: &GridDesc, now: &[f32], before: &[f32]) {
        let plane = Plane::new(desc);
        let pair = plane.forth(now, before);
        let of = |at: [usize; 2], [now, before]: [Complex64; 2]| {
            let [first, second] = self.law.potential(wavenumber(self.size, self.cell, at));
            first * now + second * before
        };
        let p = &mut self.p;
        plane.back(&pair, of, |at, [value, _]| p[at] = value as f32);
    }

    /// Takes over a velocity potential, m^2/s.
    pub(crate) fn start_from_potential(&mut self, phi: &[f32]) {
        let unit = self.law.unit() as f32;
        self.p.iter_mut().zip(phi).for_each(|(p, phi)| *p = phi / unit);
    }

    /// The velocity potential, m^2/s.
    pub(crate) fn velocity_potential(&self) -> Vec<f32> {
        let unit = self.law.unit() as f32;
        self.p.iter().map(|p| unit * p).collect()
    }

    /// Energy over the density, m^5/s^2: hx hz / 2 times the sum of g z^2 + phi T phi.
    pub(crate) fn energy(&self, z: &[f32]) -> f64 {
        let ([n, m], [hx, hz], cells) = (self.size, self.cell, (self.size[0] * self.size[1]) as f64);
        let places = (0..n * m).map(|at| (at / n + self.patch.first) * self.patch.width + at % n + self.patch.first);
        let p: Vec<_> = places.clone().map(|at| Complex64::from(f64::from(self.p[at]))).collect();
        let spectrum = Fourier::new(self.size).forth(&p);
        let moving = spectrum.iter().enumerate().map(|(at, p)| {
            let k = wavenumber(self.size, self.cell, [at / m, at % m]);
            self.law.t(k) * p.norm_sqr() * self.law.unit() * self.law.unit() / cells
        });
        let standing = places.map(|at| GRAVITY * f64::from(z[at]) * f64::from(z[at]));
        0.5 * hx * hz * (standing.sum::<f64>() + moving.sum::<f64>())
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

/// |k|, 1/m, at a place of a spectrum of `size` cells of `h` metres.
fn wavenumber(size: [usize; 2], h: [f64; 2], at: [usize; 2]) -> f64 {
    let [x, z] = [0, 1].map(|k| TAU * at[k].min(size[k] - at[k]) as f64 / (size[k] as f64 * h[k]));
    libm::hypot(x, z)
}

/// The water of a grid and the time of its sub-step.
fn law(desc: &GridDesc, stepping: &Stepping) -> Law {
    let [hx, hz] = desc.cell_size.map(f64::from);
    Law { depth: f64::from(desc.depth), damping: f64::from(desc.damping), dt: stepping.dt, cell: libm::sqrt(hx * hz) }
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

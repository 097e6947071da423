//! A window as one period of a plane of waves: for what is found wavenumber by wavenumber.

use rustfft::num_complex::Complex64;

use crate::fourier::Fourier;
use crate::{Border, GridDesc};

/// Which cells a period is made of, and how much of each counts.
pub(crate) struct Plane {
    size: [usize; 2],
    /// Per axis the cell and its weight: waves are let go towards a border that absorbs.
    places: [Vec<(usize, f64)>; 2],
    nx: usize,
    fourier: Fourier,
}

/// Spectra of two real fields a + i b.
pub(crate) struct Pair(Vec<Complex64>);

impl Plane {
    pub(crate) fn new(desc: &GridDesc) -> Self {
        let cells = desc.cells.map(|n| n as usize);
        let places = cells.map(|n| match desc.border {
            Border::Periodic => (1..n - 1).map(|i| (i, 1.0)).collect(),
            // A wall is a mirror.
            Border::Reflecting => (1..n - 1).chain((1..n - 1).rev()).map(|i| (i, 1.0)).collect(),
            Border::Absorbing { width } | Border::Sponge { width } => {
                let weight = |i: usize| {
                    let t = (i.min(n - 1 - i) as f64 / f64::from(width)).min(1.0);
                    t * t * (3.0 - 2.0 * t)
                };
                (0..n).map(|i| (i, weight(i))).collect::<Vec<_>>()
            }
        });
        let size = [places[0].len(), places[1].len()];
        Self { size, places, nx: cells[0], fourier: Fourier::new(size) }
    }

    /// Wavenumbers along x and z.
    pub(crate) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The spectra of two fields.
    pub(crate) fn forth(&self, a: &[f32], b: &[f32]) -> Pair {
        let mut field = Vec::with_capacity(self.size[0] * self.size[1]);
        for (j, across) in &self.places[1] {
            field.extend(self.places[0].iter().map(|(i, along)| {
                let at = j * self.nx + i;
                Complex64::new(f64::from(a[at]), f64::from(b[at])) * (along * across)
            }));
        }
        Pair(self.fourier.forth(&field))
    }

    /// What `f` makes of the places in a spectrum and the two fields there, as two fields a + i b again: written to the cells, with
    /// the place of each, by `write`.
    pub(crate) fn back(
        &self,
        pair: &Pair,
        f: impl Fn([usize; 2], [Complex64; 2]) -> Complex64,
        mut write: impl FnMut(usize, [f64; 2]),
    ) {
        let [n, m] = self.size;
        let mut spectrum = Vec::with_capacity(n * m);
        for i in 0..n {
            for j in 0..m {
                let (z, mirrored) = (pair.0[i * m + j], pair.0[(n - i) % n * m + (m - j) % m].conj());
                let halves = [0.5 * (z + mirrored), Complex64::new(0.0, -0.5) * (z - mirrored)];
                spectrum.push(f([i, j], halves) / (n * m) as f64);
            }
        }
        let field = self.fourier.back(&spectrum);
        for ((j, _), row) in self.places[1].iter().zip(field.chunks_exact(n)) {
            for ((i, _), z) in self.places[0].iter().zip(row) {
                write(j * self.nx + i, [z.re, z.im]);
            }
        }
    }
}

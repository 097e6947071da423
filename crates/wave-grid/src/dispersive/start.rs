//! What the dispersive scheme keeps besides heights, from heights: the potential and the screened fields of the waves that
//! they are, none of the fields' own swinging.
//!
//! In open water of one depth every wavenumber, K the eigenvalue of minus the Laplacian, turns by theta a sub-step with
//! `lambda = 2 - 2 cos theta = G kappa(lambda)`, `kappa = c K + sum_i r_i (1 - rho_i)` and
//! `X_i = rho_i P`, `rho_i = m_i r_i / (m_i (s_i K + r_i) - lambda)`: the scheme's equations for waves `e^(-i theta n)`. kappa falls as
//! lambda rises, so there is one solution below the fields' own. Then `z - z_old = kappa P_old`.
//!
//! Walls are not seen, and a bed counts by its mean depth: what that misses goes into the screened fields.

use rustfft::num_complex::Complex64;

use super::{FIELDS, Fields, Law};
use crate::plane::{Pair, Plane};
use crate::{Border, GridDesc};

/// kappa and rho at one K.
#[derive(Clone, Copy)]
struct Mode {
    kappa: f64,
    rho: [f64; FIELDS],
}

impl Mode {
    fn new(law: &Law, k: f64) -> Self {
        let [r, s, m] = [law.r, law.s, law.m].map(|three| three.map(f64::from));
        let (c, g) = (f64::from(law.c), f64::from(law.g));
        let own: [f64; FIELDS] = std::array::from_fn(|i| m[i] * (s[i] * k + r[i]));
        let lowest = own.into_iter().fold(f64::INFINITY, f64::min);
        let rho = |lambda: f64| -> [f64; FIELDS] { std::array::from_fn(|i| m[i] * r[i] / (own[i] - lambda)) };
        let kappa = |rho: &[f64; FIELDS]| c * k + (0..FIELDS).map(|i| r[i] * (1.0 - rho[i])).sum::<f64>();
        let mut lambda = 0.0;
        // Newton's steps of a convex function, from above after the first.
        for _ in 0..8 {
            let rho = rho(lambda);
            let slope: f64 = (0..FIELDS).map(|i| r[i] * rho[i] / (own[i] - lambda)).sum();
            lambda -= (lambda - g * kappa(&rho)) / (1.0 + g * slope);
            lambda = lambda.clamp(0.0, 0.999 * lowest);
        }
        let rho = rho(lambda);
        Self { kappa: kappa(&rho), rho }
    }
}

/// What the waves of a window are found from.
pub(crate) struct Start {
    plane: Plane,
    /// By wavenumber along x and z, up to half of them.
    modes: Vec<Mode>,
    law: Law,
    rim: bool,
}

impl Start {
    pub(crate) fn new(desc: &GridDesc, law: Law) -> Self {
        let plane = Plane::new(desc);
        let [n, m] = plane.size();
        let share = |i: usize, n: usize| {
            let sin = libm::sin(std::f64::consts::PI * i as f64 / n as f64);
            4.0 * sin * sin
        };
        let modes = (0..=n / 2).flat_map(|i| (0..=m / 2).map(move |j| (i, j)));
        let modes = modes.map(|(i, j)| Mode::new(&law, share(i, n) + share(j, m))).collect();
        Self { plane, modes, law, rim: !matches!(desc.border, Border::Periodic | Border::Reflecting) }
    }

    fn mode(&self, [i, j]: [usize; 2]) -> &Mode {
        let [n, m] = self.plane.size();
        &self.modes[i.min(n - i) * (m / 2 + 1) + j.min(m - j)]
    }

    /// From the heights now and a sub-step ago. The mean potential, which no height tells, is zero.
    pub(crate) fn by_heights(&self, z: &[f32], old: &[f32], fields: &mut Fields) {
        let pair = self.plane.forth(z, old);
        let before = |at: [usize; 2], [z, old]: [Complex64; 2]| {
            let p = if at == [0; 2] { Complex64::default() } else { (z - old) / self.mode(at).kappa };
            p + Complex64::i() * z
        };
        self.write(&pair, before, z, fields);
    }

    /// From the heights and the potential P half a sub-step ago.
    pub(crate) fn by_potential(&self, z: &[f32], middle: &[f32], fields: &mut Fields) {
        let half = 0.5 * self.law.g;
        let before: Vec<f32> = middle.iter().zip(z).map(|(p, z)| p + half * z).collect();
        let pair = self.plane.forth(&before, z);
        self.write(&pair, |_, [p, z]| p + Complex64::i() * z, z, fields);
    }

    /// From P a sub-step ago + i z, wavenumber by wavenumber.
    fn write(
        &self,
        pair: &Pair,
        before: impl Fn([usize; 2], [Complex64; 2]) -> Complex64,
        z: &[f32],
        fields: &mut Fields,
    ) {
        let (damp, g) = (f64::from(self.law.damp), f64::from(self.law.g));
        // P' = (2 R - 1) P - R G z', and X_i like P.
        let after = |before: f64, z: f64| (2.0 * damp - 1.0) * before - damp * g * z;
        let Fields { potential, screened, older, .. } = &mut *fields;
        self.plane.back(pair, &before, |at, [p, _]| potential[at] = after(p, f64::from(z[at])) as f32);
        for (i, (now, old)) in screened.iter_mut().zip(older).enumerate() {
            let part = |at: [usize; 2], pair: [Complex64; 2]| self.mode(at).rho[i] * before(at, pair);
            self.plane.back(pair, part, |at, [p, z]| (now[at], old[at]) = (after(p, z) as f32, p as f32));
        }
        if self.rim {
            fields.clear_rim();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scheme, WaveGrid};

    fn grid(border: Border, cells: [u32; 2]) -> WaveGrid {
        WaveGrid::new(GridDesc { cells, border, scheme: Scheme::Dispersive, ..GridDesc::default() }).unwrap()
    }

    fn largest_field(grid: &WaveGrid, of: impl Fn(&Fields) -> f32) -> f32 {
        of(grid.fields.as_ref().unwrap())
    }

    /// How far, of its amplitude, a plane wave of so many cells is from where its own turn a step brings it after `ticks`,
    /// and where the closed form, deep water, would.
    fn run(number: f64, ticks: u32, border: Border) -> f64 {
        let cells = [130, 50];
        let mut grid = grid(border, cells);
        let law = grid.fields.as_ref().unwrap().law;
        let theta = std::f64::consts::TAU * number / 128.0;
        let half = (0.5 * theta).sin();
        let mode = Mode::new(&law, 4.0 * half * half);
        let turn = (1.0 - 0.5 * f64::from(law.g) * mode.kappa).acos();
        // Standing between walls.
        let wave = |steps: f64| -> Vec<f32> {
            let at = |at: usize| (at % 130) as f64 - 0.5;
            let z = |x: f64| match border {
                Border::Reflecting => (theta * x).cos() * (turn * steps).cos(),
                _ => (theta * x - turn * steps).cos(),
            };
            (0..130 * 50).map(|k| (0.1 * z(at(k))) as f32).collect()
        };
        let now = 10.0;
        grid.impose(&wave(now), &wave(now - 1.0)).unwrap();
        grid.set_tile_skipping(false);
        (0..ticks).for_each(|_| grid.tick());
        let truth = wave(now + f64::from(ticks));
        let inside = (1..49).flat_map(|j| j * 130 + 1..j * 130 + 129);
        inside.map(|at| f64::from((grid.heights()[at] - truth[at]).abs()) / 0.1).fold(0.0, f64::max)
    }

    #[test]
    fn plane_waves_begin_as_such() {
        for number in [1.0, 2.0, 5.0, 11.0, 21.0] {
            let error = run(number, 300, Border::Periodic);
            assert!(error < 2e-3, "{number} waves: {error}");
        }
    }

    #[test]
    fn standing_waves_between_walls_begin_as_such() {
        for number in [1.5, 4.0, 10.5] {
            let error = run(number, 300, Border::Reflecting);
            assert!(error < 2e-3, "{number} waves: {error}");
        }
    }

    #[test]
    fn waves_that_are_taken_over_go_on() {
        let mut first = grid(Border::default(), [128, 128]);
        let source = |grid: &mut WaveGrid| {
            let center = glam::Vec2::new(1.0, -2.0);
            assert!(grid.add(crate::Source::Displacement { center, radius: 4.0, volume: 2.0 }));
        };
        source(&mut first);
        (0..90).for_each(|_| first.tick());
        for scheme in [Scheme::Dispersive, Scheme::Spectral] {
            let mut second = WaveGrid::new(GridDesc { scheme, ..*first.desc() }).unwrap();
            second.resample(&first);
            let mut first = first.clone();
            // Waves of both branches pass; what the fields held of their own stays behind.
            for _ in 0..60 {
                first.tick();
                second.tick();
            }
            let most = first.heights().iter().fold(0.0f32, |most, z| most.max(z.abs()));
            let apart = first.heights().iter().zip(second.heights());
            let worst = apart.fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
            assert!(worst < 0.1 * most, "{scheme:?}: {worst} of {most}");
        }
        assert!(largest_field(&first, |fields| fields.potential.iter().fold(0.0, |m: f32, p| m.max(p.abs()))) > 0.0);
    }
}

//! The surface by direct summation in f64: the meaning of the modes, written as plainly as possible.
//!
//! Shares no code with the FFT path. It is what tests and benches measure against; far too slow for a game.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::CascadeModes;

/// All fields at a rest point, in the order of [`CascadeFields`](crate::CascadeFields).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fields {
    /// `(Dx, h, Dz, dDx/dz)`.
    pub displacement: [f64; 4],
    /// `(dh/dx, dh/dz, dDx/dx, dDz/dz)`.
    pub derivative: [f64; 4],
    /// `(dDx/dt, dh/dt, dDz/dt, d^2h/dt^2)`.
    pub velocity: [f64; 4],
}

/// Sums the waves of one cascade at rest point `x` (metres, in the tile) and time `t` (seconds): height `a cos(theta)`,
/// displacement `-choppiness k/|k| a sin(theta)`, `theta = k.x - omega t + phase`, and what follows by differentiation.
pub fn direct_sum(modes: &CascadeModes, choppiness: f64, loop_time: f64, x: DVec2, t: f64) -> Fields {
    let size = modes.size;
    let fraction = (t / loop_time).rem_euclid(1.0);
    let mut f = Fields::default();
    for (cell, (amp, &n)) in modes.amp.iter().zip(&modes.n).enumerate() {
        let (re, im) = (f64::from(amp[0]), f64::from(amp[1]));
        if re == 0.0 && im == 0.0 {
            continue;
        }
        let wrapped = |index: u32| f64::from(index) - if index >= size / 2 { f64::from(size) } else { 0.0 };
        let step = TAU / f64::from(modes.tile);
        let kx = wrapped(cell as u32 % size) * step;
        let kz = wrapped(cell as u32 / size) * step;
        let k = kx.hypot(kz);
        let omega = TAU * f64::from(n) / loop_time;
        // The modes at k and -k each hold half of the wave that travels along k.
        let a = 2.0 * re.hypot(im);
        let theta = kx * x.x + kz * x.y - TAU * (f64::from(n) * fraction).fract() + im.atan2(re);
        let (sin, cos) = theta.sin_cos();
        let (ux, uz) = (choppiness * kx / k, choppiness * kz / k);
        let add = |sum: &mut [f64; 4], terms: [f64; 4]| sum.iter_mut().zip(terms).for_each(|(s, t)| *s += a * t);
        add(&mut f.displacement, [-ux * sin, cos, -uz * sin, -ux * kz * cos]);
        add(&mut f.derivative, [-kx * sin, -kz * sin, -ux * kx * cos, -uz * kz * cos]);
        add(&mut f.velocity, [omega * ux * cos, omega * sin, omega * uz * cos, -omega * omega * cos]);
    }
    f
}

//! The memory of radiated waves: Cummins' equation (1962) by convolution with the velocities of the past.
//!
//! `M v' + A v' + integral K(t - s) v(s) ds = F` with `K(t) = 2/pi integral B(w) cos(w t) dw` and, by Ogilvie (1964),
//! `A = A(w) + 1/w integral K(t) sin(w t) dt`, taken at the mode's own frequency: there added mass and damping are those
//! of the table or the estimate. Modes do not couple, and there is no effect of speed.

use super::curve::{Curve, Mode};
use super::texture::{Afloat, line};
use crate::GRAVITY;

/// Intervals of the past in a swing of the body.
const PER_SWING: f64 = 64.0;
/// Swings that are remembered at most.
const SWINGS: f64 = 6.0;
/// What is forgotten, as a share of the kernel's start.
const FORGOTTEN: f64 = 2.0e-3;
/// Frequencies of the kernel's integral, up to this multiple of the body's own.
const FREQUENCIES: (u32, f64) = (600, 8.0);
/// Least mass left, as a share of that at the body's own frequency.
const LEAST: f64 = 0.1;
/// Ticks longer than so many intervals remember nothing.
const LONGEST: f32 = 6.0;

/// One mode.
#[derive(Clone, Debug)]
struct Remembering {
    /// Added mass or inertia at infinite frequency, kg or kg m^2.
    left: f32,
    /// Length of an interval in s.
    step: f32,
    /// K at multiples of `step`; the last is 0.
    kernel: Vec<f32>,
    past: Past,
}

/// The past of a mode.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Past {
    /// How far the mode moved in each interval, the newest at `newest`.
    moves: Vec<f32>,
    newest: usize,
    /// Time since the newest interval ended, and how far the mode moved since.
    since: f32,
    moved: f32,
}

/// Of heave, roll and pitch.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    modes: [Option<Remembering>; 3],
}

/// What memory makes of a mode in a sub-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Recalled {
    /// Added mass or inertia.
    pub(crate) left: f32,
    /// Damping of the sub-step's own motion, N s/m or N m s.
    pub(crate) damping: f32,
    /// Force in N or torque in N m of the past.
    pub(crate) force: f32,
}

impl Remembering {
    fn of(a: &Afloat, index: usize, mode: &Mode) -> Option<Self> {
        let elements = line(a, index);
        let curve = Curve::new(a, mode, &elements, index)?;
        let (count, most) = FREQUENCIES;
        let width = most * mode.natural / f64::from(count);
        let damping: Vec<f64> = (0..count)
            .map(|i| {
                let omega = (f64::from(i) + 0.5) * width;
                let q = curve.excitation(omega);
                0.5 * f64::from(a.density) * omega * (omega * omega / f64::from(GRAVITY)) * q * q
            })
            .collect();
        let at = |time: f64| {
            let terms = damping.iter().zip(0..count).map(|(b, i)| b * libm::cos((f64::from(i) + 0.5) * width * time));
            2.0 / std::f64::consts::PI * width * terms.sum::<f64>()
        };
        let step = std::f64::consts::TAU / mode.natural / PER_SWING;
        let mut kernel: Vec<f64> = (0..(SWINGS * PER_SWING) as u32).map(|i| at(f64::from(i) * step)).collect();
        let lasting = kernel.iter().rposition(|k| k.abs() > FORGOTTEN * kernel[0])?;
        kernel.truncate(lasting + 1);
        kernel.push(0.0);
        let sine = |i: usize| libm::sin(mode.natural * i as f64 * step);
        let swung: f64 = kernel.iter().enumerate().map(|(i, k)| k * sine(i)).sum();
        let left = (mode.added + swung * step / mode.natural).max(LEAST * mode.added);
        let past = Past { moves: vec![0.0; kernel.len() - 1], newest: 0, since: 0.0, moved: 0.0 };
        let kernel: Vec<f32> = kernel.iter().map(|k| *k as f32).collect();
        let sane = left.is_finite() && kernel.iter().all(|k| k.is_finite()) && kernel[0] > 0.0;
        let (left, step) = (left as f32, step as f32);
        sane.then_some(Self { left, step, kernel, past })
    }

    /// K at `x` intervals.
    fn kernel_at(&self, x: f32) -> f32 {
        let last = self.kernel.len() - 1;
        let i = (x as usize).min(last);
        let share = (x - i as f32).clamp(0.0, 1.0);
        self.kernel[i] + share * (self.kernel[(i + 1).min(last)] - self.kernel[i])
    }

    /// For a sub-step of `dt` s, the force as it is half way.
    fn recall(&self, dt: f32) -> Recalled {
        let Past { moves, newest, since, moved } = &self.past;
        let recent = (since + 0.5 * dt) / self.step;
        let mut force = moved * self.kernel_at(0.5 * (since + dt) / self.step);
        // All intervals lie between two rows of the kernel with the same shares.
        let shift = (recent + 0.5) as usize;
        let share = recent + 0.5 - shift as f32;
        let (mut low, mut high) = (0.0, 0.0);
        let rows = self.kernel.get(shift..).unwrap_or_default();
        let (newer, older) = moves.split_at(*newest);
        for (moved, pair) in older.iter().chain(newer).zip(rows.windows(2)) {
            low += moved * pair[0];
            high += moved * pair[1];
        }
        force += low + share * (high - low);
        Recalled { left: self.left, damping: 0.5 * dt * self.kernel_at(0.25 * dt / self.step), force: -force }
    }

    fn remember(&mut self, moved: f32, dt: f32) {
        let (mut left, rate, past) = (dt, moved / dt, &mut self.past);
        while past.since + left >= self.step {
            let part = self.step - past.since;
            past.newest = if past.newest == 0 { past.moves.len() - 1 } else { past.newest - 1 };
            past.moves[past.newest] = past.moved + rate * part;
            (past.since, past.moved, left) = (0.0, 0.0, left - part);
        }
        past.since += left;
        past.moved += rate * left;
    }

    fn forget(&mut self) {
        self.past.moves.fill(0.0);
        (self.past.since, self.past.moved) = (0.0, 0.0);
    }

    /// Whether it could have come to this.
    fn fits(&self, past: &Past) -> bool {
        past.moves.len() == self.past.moves.len()
            && past.newest < past.moves.len()
            && (0.0..=self.step).contains(&past.since)
    }
}

impl Memory {
    /// `None` where nothing swings. Takes some milliseconds.
    pub(crate) fn new(a: &Afloat) -> Option<Self> {
        if !(a.waterline.area > 0.0 && a.waterline.volume > 0.0) {
            return None;
        }
        let modes = Mode::of(a).ok()?;
        let modes = [0, 1, 2].map(|i| modes[i].as_ref().and_then(|mode| Remembering::of(a, i, mode)));
        modes.iter().any(Option::is_some).then_some(Self { modes })
    }

    /// Heave, roll and pitch in a sub-step of `dt` s; `None` for what remembers nothing.
    pub(crate) fn recall(&self, dt: f32) -> [Option<Recalled>; 3] {
        [0, 1, 2].map(|i| self.modes[i].as_ref().filter(|m| dt <= LONGEST * m.step).map(|m| m.recall(dt)))
    }

    /// How far the modes moved through the water in `dt` s: m, rad, rad.
    pub(crate) fn remember(&mut self, moved: [f32; 3], dt: f32) {
        for (mode, moved) in self.modes.iter_mut().zip(moved) {
            match mode {
                Some(mode) if dt <= LONGEST * mode.step && moved.is_finite() => mode.remember(moved, dt),
                Some(mode) => mode.forget(),
                None => {}
            }
        }
    }

    /// Of heave, roll and pitch.
    pub(crate) fn past(&self) -> [Option<Past>; 3] {
        [0, 1, 2].map(|i| self.modes[i].as_ref().map(|mode| mode.past.clone()))
    }

    /// Whether it could have come to this.
    pub(crate) fn fits(&self, past: &[Option<Past>; 3]) -> bool {
        self.modes.iter().zip(past).all(|(mode, past)| match (mode, past) {
            (Some(mode), Some(past)) => mode.fits(past),
            (mode, past) => mode.is_none() && past.is_none(),
        })
    }

    pub(crate) fn restore(&mut self, past: &[Option<Past>; 3]) {
        for (mode, past) in self.modes.iter_mut().flatten().zip(past.iter().flatten()) {
            mode.past.clone_from(past);
        }
    }

    /// After a teleport.
    pub(crate) fn forget(&mut self) {
        self.modes.iter_mut().flatten().for_each(Remembering::forget);
    }
}

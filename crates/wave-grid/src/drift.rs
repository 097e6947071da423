//! How fast a window moves over the water, for its border layer.

use crate::Stepping;
use crate::cpu::boost::Motion;
use crate::window::Place;

/// Share of a change of velocity that is taken over in a tick.
const FOLLOW: f64 = 0.25;
/// Speed over c from which the layer is left as if it stood still: no wave reaches the front, and all fall behind.
const FAST: f64 = 0.95;
/// Speed over c that counts as none.
const NONE: f64 = 1e-3;

/// Velocity of a window.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Drift {
    /// Where it stood, cells.
    at: Option<[f64; 2]>,
    /// Cells per sub-step in the last tick.
    last: [f64; 2],
    /// The same, smoothed, over the speed of waves.
    beta: [f64; 2],
    /// For which velocity the layer's memory holds.
    pub(crate) held: [f64; 2],
}

impl Drift {
    pub(crate) fn is_finite(&self) -> bool {
        let [at, last, beta, held] = [self.at.unwrap_or_default(), self.last, self.beta, self.held];
        [at, last, beta, held].as_flattened().iter().all(|value| value.is_finite())
    }

    /// Once a tick: where the window stands now.
    pub(crate) fn note(&mut self, place: &Place, stepping: &Stepping) {
        let at = [0, 1].map(|k| place.window.corner[k] as f64 + place.lean[k]);
        let was = self.at.replace(at).unwrap_or(at);
        for k in 0..2 {
            self.last[k] = (at[k] - was[k]) / f64::from(stepping.substeps);
            self.beta[k] += FOLLOW * (self.last[k] / stepping.a[k].sqrt() - self.beta[k]);
        }
    }

    /// The velocity, smoothed, over the speed of waves: of those of 2 pi cells where waves disperse.
    pub(crate) fn beta(&self) -> [f64; 2] {
        self.beta
    }

    /// What the layer needs in a sub-step.
    pub(crate) fn motion(&self, place: &Place, substep: u32, substeps: u32) -> Motion {
        let speed = (self.beta[0] * self.beta[0] + self.beta[1] * self.beta[1]).sqrt();
        let beta = if !(NONE..=FAST).contains(&speed) { [0.0; 2] } else { self.beta };
        let since = f64::from(substep) + 0.5 - 0.5 * f64::from(substeps);
        Motion { beta, lean: [0, 1].map(|k| (place.lean[k] + self.last[k] * since).clamp(-1.0, 1.0)) }
    }
}

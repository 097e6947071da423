//! Constants of the foam.
//!
//! Water breaks where the Jacobian of the horizontal displacement falls below a threshold, and leaves foam that fades.
//! The Jacobian that counts is that of the sum of all cascades, but a texel knows only its own: it holds the chance that
//! the sum breaks given its own derivatives, less the share of the mean that the other cascades' texels bring. That is
//! the best approximation of the sum's foam by a sum over cascades (the first-order terms of its analysis of variance).

use open_water_shaders::ocean::OceanCascade;

use crate::{CascadeModes, Ocean};

/// Seconds in which foam fades to 1/e.
pub const FOAM_SECONDS: f32 = 4.0;
/// Jacobian below which water breaks: the coverage of a wind sea then grows from 1 % at 10 m/s to some 10 % at 20 m/s.
pub const FOAM_THRESHOLD: f32 = 0.6;
/// Least standard deviation over which an edge of foam is soft.
const SOFTNESS: f64 = 0.03;

/// Factor on old foam after `dt` seconds.
pub(super) fn decay(dt: f32) -> f32 {
    let dt = if dt.is_finite() { dt.max(0.0) } else { 0.0 };
    libm::expf(-dt / FOAM_SECONDS)
}

/// Variance of the divergence of the horizontal displacement.
fn divergence_variance(modes: &CascadeModes, choppiness: f64) -> f64 {
    let step = modes.step();
    let size = modes.size as usize;
    let sum: f64 = (0..)
        .zip(&modes.amp)
        .map(|(cell, a): (usize, _)| {
            let [i, j] = [cell % size, cell / size].map(|x| f64::from(modes.signed(x as u32)));
            (i * i + j * j) * (f64::from(a[0]).powi(2) + f64::from(a[1]).powi(2))
        })
        .sum();
    2.0 * (choppiness * step).powi(2) * sum
}

/// What the shader knows of each cascade.
pub(super) fn cascades(ocean: &Ocean) -> Vec<OceanCascade> {
    let choppiness = f64::from(ocean.desc().choppiness);
    let variances: Vec<f64> = ocean.modes().iter().map(|modes| divergence_variance(modes, choppiness)).collect();
    let total: f64 = variances.iter().sum();
    let spread = |variance: f64| (variance + SOFTNESS * SOFTNESS).sqrt();
    // Logistic in place of the normal distribution, as in the shader.
    let mean = 1.0 / (1.0 + libm::exp(1.702 * (1.0 - f64::from(FOAM_THRESHOLD)) / spread(total)));
    let others = 1.0 - 1.0 / variances.len() as f64;
    ocean
        .modes()
        .iter()
        .zip(&variances)
        .map(|(modes, variance)| OceanCascade {
            wave_step: modes.step() as f32,
            foam_spread: spread(total - variance) as f32,
            foam_share: (mean * others) as f32,
            pad: 0.0,
        })
        .collect()
}

//! The spectrum of a whole sea state: densities, and the figures that follow from them.

use std::f64::consts::{PI, TAU};

use crate::sea::shape::Shape;
use crate::{Notice, OceanError, SeaState, dispersion};

/// Wavenumber up to which slopes are summed, rad/m: the slowest wave (1.7 cm), beyond which surface tension rules. With
/// an omega^-5 tail the mean square slope grows without bound, so a cutoff is part of its meaning.
pub const SLOPE_CUTOFF: f64 = 363.0;

/// Frequencies at which the figures are tabulated, equally spaced in the logarithm.
const STEPS: usize = 6000;
const LOWEST_OMEGA: f64 = 0.05;

/// A sea state prepared for evaluation, in f64.
pub struct WaveSpectrum {
    shapes: Vec<Shape>,
    depth: Option<f64>,
    notices: Vec<Notice>,
    variance: f64,
    peak_frequency: f64,
    /// Mean square slope of all waves above each tabulated frequency.
    slope_above: Vec<f64>,
    highest_omega: f64,
}

impl WaveSpectrum {
    /// Prepares a sea state.
    ///
    /// # Errors
    /// As [`SeaState::validate`].
    pub fn new(sea: &SeaState) -> Result<Self, OceanError> {
        sea.validate()?;
        let depth = sea.depth.map(f64::from);
        let mut notices = Vec::new();
        let shapes = sea.partitions.iter().map(|p| Shape::new(p, depth, &mut notices)).collect();
        let highest_omega = dispersion::frequency(SLOPE_CUTOFF, depth);
        let mut spectrum =
            Self { shapes, depth, notices, variance: 0.0, peak_frequency: 1.0, slope_above: Vec::new(), highest_omega };
        spectrum.tabulate();
        Ok(spectrum)
    }

    fn tabulate(&mut self) {
        let mut slope_above = vec![0.0; STEPS + 1];
        let mut peak = 0.0;
        let mut last: Option<(f64, f64, f64)> = None;
        for i in (0..=STEPS).rev() {
            let omega = self.tabulated(i);
            let k = dispersion::wavenumber(omega, self.depth);
            let density: f64 = self.shapes.iter().map(|shape| shape.density(omega, k)).sum();
            let slope = density * k * k;
            if let Some((omega_above, density_above, slope_density_above)) = last {
                let step = 0.5 * (omega_above - omega);
                self.variance += step * (density + density_above);
                slope_above[i] = slope_above[i + 1] + step * (slope + slope_density_above);
            }
            if density > peak {
                peak = density;
                self.peak_frequency = omega;
            }
            last = Some((omega, density, slope));
        }
        self.slope_above = slope_above;
    }

    /// Angular frequency of a row of the table.
    fn tabulated(&self, i: usize) -> f64 {
        let span = libm::log(self.highest_omega / LOWEST_OMEGA);
        LOWEST_OMEGA * libm::exp(span * i as f64 / STEPS as f64)
    }

    /// Variance density over angular frequency `omega` (rad/s), m^2 s/rad.
    pub fn frequency_density(&self, omega: f64) -> f64 {
        let k = dispersion::wavenumber(omega, self.depth);
        self.shapes.iter().map(|shape| shape.density(omega, k)).sum()
    }

    /// Variance density over the wavenumber plane at `(kx, kz)` (rad/m), m^4/rad^2: `S(omega) D (d omega/dk)/k`.
    /// Waves travel along the wavenumber. Zero at zero.
    pub fn wavenumber_density(&self, kx: f64, kz: f64) -> f64 {
        let k = (kx * kx + kz * kz).sqrt();
        if k == 0.0 {
            return 0.0;
        }
        let omega = dispersion::frequency(k, self.depth);
        let sum: f64 = self.shapes.iter().map(|shape| shape.directional(omega, k, kx / k, kz / k)).sum();
        sum * dispersion::group_velocity(k, self.depth) / k
    }

    /// Water depth, metres; `None` is deep.
    pub fn depth(&self) -> Option<f64> {
        self.depth
    }

    /// Variance of the height, m^2, of waves up to [`SLOPE_CUTOFF`].
    pub fn variance(&self) -> f64 {
        self.variance
    }

    /// Significant wave height `4 sqrt(variance)`, metres.
    pub fn significant_height(&self) -> f64 {
        4.0 * self.variance.sqrt()
    }

    /// Angular frequency with the largest density over frequency, rad/s.
    pub fn peak_frequency(&self) -> f64 {
        self.peak_frequency
    }

    /// Period of the peak, seconds.
    pub fn peak_period(&self) -> f64 {
        TAU / self.peak_frequency
    }

    /// Wavenumber of the peak at this depth, rad/m.
    pub fn peak_wavenumber(&self) -> f64 {
        dispersion::wavenumber(self.peak_frequency, self.depth)
    }

    /// Mean square slope (both axes together) of the waves shorter than twice the footprint (metres), down to
    /// [`SLOPE_CUTOFF`]: what a pixel or a texel of that width cannot show. Never negative; 0 for a NaN.
    pub fn hidden_slope(&self, footprint: f64) -> f64 {
        let k = PI / footprint.max(1e-9);
        if k.is_nan() || k >= SLOPE_CUTOFF {
            return 0.0;
        }
        let omega = dispersion::frequency(k, self.depth);
        let x = libm::log(omega / LOWEST_OMEGA) / libm::log(self.highest_omega / LOWEST_OMEGA) * STEPS as f64;
        let x = x.clamp(0.0, STEPS as f64);
        let i = (x as usize).min(STEPS - 1);
        let t = x - i as f64;
        (1.0 - t) * self.slope_above[i] + t * self.slope_above[i + 1]
    }

    /// What was changed in the description.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }
}

//! A measured spectrum over frequency and direction.

use std::f64::consts::{PI, TAU};

use crate::OceanError;
use crate::error::check;

/// Variance density over frequency and direction: bilinear between its nodes, round the circle; zero below the first
/// frequency, continued above the last by a frequency^-5 tail with that row's directions.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Raw"))]
pub struct DirectionalTable {
    frequencies: Vec<f32>,
    directions: Vec<f32>,
    densities: Vec<f32>,
}

/// As it is read, unchecked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Raw {
    frequencies: Vec<f32>,
    directions: Vec<f32>,
    densities: Vec<f32>,
}

#[cfg(feature = "serde")]
impl TryFrom<Raw> for DirectionalTable {
    type Error = OceanError;

    fn try_from(raw: Raw) -> Result<Self, OceanError> {
        Self::new(raw.frequencies, raw.directions, raw.densities)
    }
}

impl DirectionalTable {
    /// A table from its nodes.
    ///
    /// `frequencies`: Hz, ascending, above 0 to 5, 3 to 4,096 of them. `directions`: radians, towards which waves travel
    /// ((cos, sin) in (x, z)), ascending within one turn, 4 to 720 of them, not all within half a circle (add zeros where
    /// nothing comes from). `densities`: m^2/(Hz rad), 0 to 10^6, one row per frequency, at least one above 0.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for the first value out of its bound.
    pub fn new(frequencies: Vec<f32>, directions: Vec<f32>, densities: Vec<f32>) -> Result<Self, OceanError> {
        let (rows, columns) = (frequencies.len(), directions.len());
        check("table rows", rows as f64, (3..=4096).contains(&rows), "3 to 4096")?;
        check("directions", columns as f64, (4..=720).contains(&columns), "4 to 720")?;
        let mut last = 0.0;
        for &f in &frequencies {
            check("frequency", f.into(), f > last && f <= 5.0, "above the row before (and 0), up to 5 Hz")?;
            last = f;
        }
        for (i, &direction) in directions.iter().enumerate() {
            let finite = direction.abs() <= 1e3;
            check("direction", direction.into(), finite, "a finite angle in radians")?;
            // The node after the last is the first, a turn on.
            let next = directions.get(i + 1).map_or(f64::from(directions[0]) + TAU, |next| f64::from(*next));
            let gap = next - f64::from(direction);
            check("angle to the next direction", gap, gap > 1e-4 && gap < PI, "above 0.0001 to below pi")?;
        }
        let count = densities.len();
        check("densities", count as f64, count == rows * columns, "one per frequency and direction")?;
        for &density in &densities {
            check("density", density.into(), (0.0..=1e6).contains(&density), "0 to 1e6 m^2/(Hz rad)")?;
        }
        let peak = densities.iter().copied().fold(0.0, f32::max);
        check("largest density", peak.into(), peak > 0.0, "above 0")?;
        Ok(Self { frequencies, directions, densities })
    }

    /// Frequencies of the rows, Hz.
    pub fn frequencies(&self) -> &[f32] {
        &self.frequencies
    }

    /// Directions of the columns, radians.
    pub fn directions(&self) -> &[f32] {
        &self.directions
    }

    /// Densities row by row, m^2/(Hz rad).
    pub fn densities(&self) -> &[f32] {
        &self.densities
    }
}

/// A table over angular frequency.
pub(crate) struct Plane {
    omegas: Vec<f64>,
    angles: Vec<f64>,
    densities: Vec<f64>,
    /// Integral of each row over direction.
    sums: Vec<f64>,
}

impl Plane {
    pub(crate) fn new(table: &DirectionalTable) -> Self {
        let omegas = table.frequencies.iter().map(|f| TAU * f64::from(*f)).collect();
        let angles: Vec<f64> = table.directions.iter().map(|a| f64::from(*a)).collect();
        let densities: Vec<f64> = table.densities.iter().map(|d| f64::from(*d) / TAU).collect();
        let n = angles.len();
        let sum = |row: &[f64]| {
            let trapezium = |i: usize| 0.5 * gap(&angles, i) * (row[i] + row[(i + 1) % n]);
            (0..n).map(trapezium).sum()
        };
        let sums = densities.chunks_exact(n).map(sum).collect();
        Self { omegas, angles, densities, sums }
    }

    /// Highest frequency of the table, rad/s.
    pub(crate) fn last(&self) -> f64 {
        self.omegas[self.omegas.len() - 1]
    }

    /// Frequency of the row that holds most.
    pub(crate) fn peak(&self) -> f64 {
        let rows = self.omegas.iter().zip(&self.sums);
        rows.fold((0.0, 0.0), |(peak, most), (omega, sum)| if *sum > most { (*omega, *sum) } else { (peak, most) }).0
    }

    /// Density over frequency, m^2 s/rad.
    pub(crate) fn density(&self, omega: f64) -> f64 {
        self.over_rows(omega, |row| self.sums[row])
    }

    /// Share of the density towards `(x, z)`, per radian.
    pub(crate) fn spread(&self, omega: f64, x: f64, z: f64) -> f64 {
        let n = self.angles.len();
        let turned = (libm::atan2(z, x) - self.angles[0]).rem_euclid(TAU);
        let i = self.angles.partition_point(|angle| angle - self.angles[0] <= turned) - 1;
        let t = (turned - (self.angles[i] - self.angles[0])) / gap(&self.angles, i);
        let at = |row: usize| (1.0 - t) * self.densities[row * n + i] + t * self.densities[row * n + (i + 1) % n];
        let sum = self.density(omega);
        if sum > 0.0 { self.over_rows(omega, at) / sum } else { 0.0 }
    }

    fn over_rows(&self, omega: f64, at: impl Fn(usize) -> f64) -> f64 {
        let after = self.omegas.partition_point(|row| *row <= omega);
        let Some(i) = after.checked_sub(1) else { return 0.0 };
        match self.omegas.get(after) {
            Some(next) => {
                let t = (omega - self.omegas[i]) / (next - self.omegas[i]);
                (1.0 - t) * at(i) + t * at(after)
            }
            None => at(i) * libm::pow(self.omegas[i] / omega, 5.0),
        }
    }
}

/// Angle from a node to the next, round the circle.
fn gap(angles: &[f64], i: usize) -> f64 {
    angles.get(i + 1).map_or(angles[0] + TAU - angles[i], |next| next - angles[i])
}

//! Skin friction along a hull, by the ITTC-1957 line.

use crate::BodyError;
use crate::error::check_range;

/// Kinematic viscosity of sea water at 15 degrees C, m^2/s (ITTC).
pub(crate) const VISCOSITY: f32 = 1.1883e-6;
/// The line is one for ships: below this Reynolds number it keeps the value that it has there.
const LEAST_REYNOLDS: f32 = 1.0e5;

/// What rubs along the water. Acts along the hull's x; across it form drag is far larger.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Skin {
    /// Wetted area at rest in m^2, 0 to 1e6.
    pub area: f32,
    /// Length of the waterline in m, 0.001 to 1000.
    pub length: f32,
    /// Form factor `1 + k`: what the hull's curvature adds, 1 to 3.
    pub form: f32,
}

impl Skin {
    /// Denny and Mumford's wetted area, `1.7 L T + V/T`, of a hull of `length` m, `draft` m and displaced `volume` m^3;
    /// form factor 1.15.
    pub fn new(length: f32, draft: f32, volume: f32) -> Self {
        let (length, draft) = (length.clamp(1.0e-3, 1.0e3), draft.max(1.0e-3));
        let area = (1.7 * length * draft + volume.max(0.0) / draft).min(1.0e6);
        Self { area: if area.is_finite() { area } else { 0.0 }, length, form: 1.15 }
    }

    /// Friction coefficient of the ITTC-1957 line, `0.075/(log10 Re - 2)^2`, at the Reynolds number `reynolds`.
    pub fn ittc_1957(reynolds: f32) -> f32 {
        let powers = libm::log10f(reynolds.max(LEAST_REYNOLDS)) - 2.0;
        0.075 / (powers * powers)
    }

    /// Resistance over the speed squared, kg/m, at `speed` m/s in water of `density` kg/m^3.
    pub(crate) fn quadratic(&self, speed: f32, density: f32) -> f32 {
        let friction = Self::ittc_1957(speed.abs() * self.length / VISCOSITY);
        0.5 * density * self.area * friction * self.form
    }

    pub(crate) fn check(&self) -> Result<(), BodyError> {
        check_range("skin.area", self.area, 0.0, 1.0e6, "in [0, 1e6] m^2")?;
        check_range("skin.length", self.length, 1.0e-3, 1.0e3, "in [0.001, 1000] m")?;
        check_range("skin.form", self.form, 1.0, 3.0, "in [1, 3]").map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_has_its_published_values() {
        // ITTC (1957), table of the line.
        for (reynolds, expected) in
            [(1.0e5, 8.333e-3), (1.0e6, 4.688e-3), (1.0e7, 3.000e-3), (1.0e8, 2.083e-3), (1.0e9, 1.531e-3)]
        {
            let found = Skin::ittc_1957(reynolds);
            assert!((found / expected - 1.0).abs() < 1e-3, "{reynolds}: {found} against {expected}");
        }
    }
}

//! Added mass of a ship's hull by strips, each a Lewis section (Lewis 1929).
//!
//! A section of beam b, draft T and area S is the image of a circle under `z = M (w + a1/w + a3/w^3)`; its added mass in
//! heave at high frequency is `C rho pi b^2/8`. Strips do not know of each other: Pabst's correction is for the whole hull.

use std::f32::consts::PI;

/// A cross-section of a hull at rest.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Strip {
    /// Where, hull frame, m.
    pub(crate) x: f32,
    /// Its length along x, m.
    pub(crate) length: f32,
    /// Breadth of the waterline, m.
    pub(crate) beam: f32,
    /// m.
    pub(crate) draft: f32,
    /// Immersed area, m^2.
    pub(crate) area: f32,
}

/// Fullness S/(b T) that a section may have: below the map folds over the keel, above it has no root.
const FULLNESS: (f32, f32) = (0.35, 1.0);

/// C of a section of half beam over draft `ratio` and of `fullness` S/(b T): 1 for a half circle and for a plate.
pub(crate) fn heave(ratio: f32, fullness: f32) -> f32 {
    let slim = (ratio - 1.0) / (ratio + 1.0);
    let full = 4.0 / PI * fullness.clamp(FULLNESS.0, FULLNESS.1);
    let c = 3.0 + full + (1.0 - full) * slim * slim;
    let a3 = (3.0 - c + (9.0 - 2.0 * c).max(0.0).sqrt()) / c;
    let a1 = slim * (1.0 + a3);
    ((1.0 + a1) * (1.0 + a1) + 3.0 * a3 * a3) / ((1.0 + a1 + a3) * (1.0 + a1 + a3))
}

/// Sums over strips about `center` (hull frame x, m): heave (m^3), pitch (m^5), roll (m^5), sway (m^3), yaw (m^5), to be
/// multiplied with the density; two-dimensional, at high frequency.
pub(crate) fn sums(strips: &[Strip], center: f32) -> [f32; 5] {
    let mut out = [0.0; 5];
    for s in strips.iter().filter(|s| s.beam > 0.0 && s.draft > 0.0) {
        let fullness = s.area / (s.beam * s.draft);
        let lever = (s.x - center) * (s.x - center);
        let heave = PI / 8.0 * s.beam * s.beam * heave(0.5 * s.beam / s.draft, fullness) * s.length;
        // A plate of beam b, less round bilges: pi/256 b^4; a wall of depth T: pi/2 T^2.
        let corners = ((fullness - 0.45) / 0.55).clamp(0.1, 1.0);
        let roll = PI / 256.0 * s.beam.powi(4) * corners * s.length;
        let sway = PI / 2.0 * s.draft * s.draft * s.length;
        for (sum, term) in out.iter_mut().zip([heave, heave * lever, roll, sway, sway * lever]) {
            *sum += term;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_have_their_closed_forms() {
        // A half circle; a thin plate; half an ellipse: all pi b^2/8.
        assert!((heave(1.0, PI / 4.0) - 1.0).abs() < 1e-5);
        assert!((heave(1.0e4, PI / 4.0) - 1.0).abs() < 1e-3);
        assert!((heave(2.5, PI / 4.0) - 1.0).abs() < 1e-5);
        // Half a square by its exact map: 4.754 rho a^2 for the whole (Wendel 1950). Lewis' has round corners.
        assert!((heave(1.0, 1.0) / 1.513 - 1.0).abs() < 0.06, "{}", heave(1.0, 1.0));
    }

    #[test]
    fn strips_of_a_half_cylinder_add_up() {
        let strip = |i: u16| Strip { x: f32::from(i) * 0.1 + 0.05, length: 0.1, beam: 2.0, draft: 1.0, area: PI / 2.0 };
        let strips: Vec<_> = (0..100).map(strip).collect();
        let [heave, pitch, _, sway, _] = sums(&strips, 5.0);
        assert!((heave / (PI / 2.0 * 10.0) - 1.0).abs() < 1e-4, "{heave}");
        assert!((pitch / (PI / 2.0 * 1000.0 / 12.0) - 1.0).abs() < 1e-3, "{pitch}");
        assert!((sway / (PI / 2.0 * 10.0) - 1.0).abs() < 1e-4);
    }
}

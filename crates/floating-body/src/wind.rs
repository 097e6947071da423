//! Wind on what is out of the water.

use glam::Vec3;

use crate::BodyError;
use crate::error::check_range;
use crate::hull::Waterline;

/// Density of air at sea level and 15 degrees C, kg/m^3.
pub(crate) const AIR_DENSITY: f32 = 1.225;
/// Fastest wind that is believed, m/s.
const FASTEST: f32 = 100.0;
/// How wind over the sea grows with height: `(y / 10 m)^0.11` (Hsu, Meindl and Gilhousen 1994).
const GROWTH: (f32, f32) = (10.0, 0.11);
/// Drag coefficients: a bluff body's faces, a ball, and a ship head on and abeam (from memory of Blendermann's tables).
const BLUFF: f32 = 1.0;
const BALL: f32 = 0.47;
const SHIP: (f32, f32) = (0.6, 0.9);

/// What the wind finds. It acts where [`WaterSurface::wind`](crate::WaterSurface::wind) is not zero.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Windage {
    /// Drag area `Cd A` in m^2 along each of the hull's axes, of what is dry at rest; in proportion to the dry volume.
    pub area: Vec3,
    /// Where it acts, hull frame, m.
    pub center: Vec3,
}

impl Windage {
    /// Of a hull that reaches from `low` to `high` (hull frame, m) about its waterline at rest.
    pub(crate) fn estimate(w: &Waterline, low: Vec3, high: Vec3, round: bool, blunt: bool) -> Self {
        let dry = (high.y - w.level.max(low.y)).max(0.0);
        let size = high - low;
        // A mesh is a hull with a sheer and raked ends.
        let (along, across, fill) = match (round, blunt) {
            (true, _) => (BALL, BALL, std::f32::consts::FRAC_PI_4),
            (_, true) => (BLUFF, BLUFF, 1.0),
            _ => (SHIP.0, SHIP.1, 0.85),
        };
        Self {
            area: Vec3::new(along * size.z * dry, across * size.x * size.z, across * size.x * dry) * fill,
            center: Vec3::new(0.5 * (low.x + high.x), high.y - 0.5 * dry, 0.5 * (low.z + high.z)),
        }
    }

    /// The wind at its centre, `height` m over the water, from that at 10 m.
    pub(crate) fn at_height(&self, height: f32) -> f32 {
        libm::powf((height / GROWTH.0).clamp(0.005, 10.0), GROWTH.1)
    }

    /// Decay rates times mass (N s/m) of the velocity `rel` through the air, hull axes.
    pub(crate) fn rates(&self, rel: Vec3) -> Vec3 {
        self.area * (0.5 * AIR_DENSITY * rel.length())
    }

    pub(crate) fn check(&self) -> Result<(), BodyError> {
        for v in self.area.to_array() {
            check_range("windage.area", v, 0.0, 1.0e6, "in [0, 1e6] m^2")?;
        }
        for v in self.center.to_array() {
            check_range("windage.center", v, -1.0e4, 1.0e4, "within +-10000 m")?;
        }
        Ok(())
    }
}

/// A wind that was told, made harmless.
pub(crate) fn believed(wind: Vec3) -> Vec3 {
    if wind.is_finite() { wind.clamp_length_max(FASTEST) } else { Vec3::ZERO }
}

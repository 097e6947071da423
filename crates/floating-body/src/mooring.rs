//! A mooring line: a spring with a damper that pulls when taut and does nothing when slack.
//!
//! Straight and without weight: no sag, no catenary, no contact with quay or bed. An anchor drags where more pulls than it
//! holds, level and towards the body; it does not dig in again deeper, nor follow the bed.

use glam::Vec3;

use crate::BodyError;
use crate::error::check_range;

/// A line from a point of the hull to a place that stays.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MooringLine {
    /// Where it is made fast on board, hull frame, m.
    pub point: Vec3,
    /// Where it is made fast ashore or on the bed, local world, m.
    pub anchor: Vec3,
    /// Length in m up to which it hangs slack, 0 to 100000.
    pub length: f32,
    /// Tension per stretch beyond `length` in N/m, 0 to 1e9.
    pub stiffness: f32,
    /// Tension per speed of stretching in N s/m, 0 to 1e9. It never makes the line push.
    pub damping: f32,
    /// Pull in N at which its anchor drags, so that it never pulls more; above 0. Infinite (default of
    /// [`MooringLine::rope`]) where it is made fast for good.
    #[cfg_attr(feature = "serde", serde(with = "crate::endless"))]
    pub holds: f32,
}

impl MooringLine {
    /// A rope fit for a body of `mass` kg: half a metre of stretch where it holds a fifth of the weight, a quarter of
    /// critical damping.
    pub fn rope(point: Vec3, anchor: Vec3, length: f32, mass: f32) -> Self {
        Self { point, anchor, length, stiffness: 4.0 * mass, damping: mass, holds: f32::INFINITY }
    }

    /// The same to an anchor that drags beyond a pull of `holds` N.
    pub fn anchored(point: Vec3, anchor: Vec3, length: f32, mass: f32, holds: f32) -> Self {
        Self { holds, ..Self::rope(point, anchor, length, mass) }
    }

    /// Refuses what a step could not digest.
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        for v in self.point.to_array() {
            check_range("mooring.point", v, -1.0e4, 1.0e4, "within +-10000 m")?;
        }
        for v in self.anchor.to_array() {
            check_range("mooring.anchor", v, -1.0e6, 1.0e6, "within +-1000 km")?;
        }
        check_range("mooring.length", self.length, 0.0, 1.0e5, "in [0, 100000] m")?;
        check_range("mooring.stiffness", self.stiffness, 0.0, 1.0e9, "in [0, 1e9] N/m")?;
        check_range("mooring.damping", self.damping, 0.0, 1.0e9, "in [0, 1e9] N s/m")?;
        if self.holds > 0.0 {
            return Ok(());
        }
        let (field, bound) = ("mooring.holds", "above 0 N, or infinite");
        Err(BodyError::InvalidValue { field, value: f64::from(self.holds), bound })
    }

    /// Tension in N over a step of `dt` s: stretched by `stretch` m, growing at `rate` m/s, on a body of which a unit
    /// impulse along the line changes the rate by `mobility` (1/kg).
    ///
    /// The damper is implicit, and the line at most as stiff as the step resolves: an overshoot of one step is not flung
    /// back. What is stiffer stretches by some 2 mm under a fifth of the weight, at 60 steps a second. Also returns by how
    /// many m the anchor drags.
    pub(crate) fn tension(&self, stretch: f32, rate: f32, mobility: f32, dt: f32) -> (f32, f32) {
        if stretch <= 0.0 {
            return (0.0, 0.0);
        }
        let stiffness = self.stiffness.min(RESOLVED / (mobility * dt * dt));
        let resist = self.damping + SETTLE * stiffness * dt;
        let tension = ((stiffness * stretch + resist * rate) / (1.0 + resist * mobility * dt)).max(0.0);
        if tension <= self.holds {
            return (tension, 0.0);
        }
        // It follows until the line's stretch alone pulls no more than it holds.
        (self.holds, (stretch - self.holds / stiffness.max(1.0e-6)).max(0.0))
    }
}

/// Square of the angle, in radians, by which a line's swing may turn within a step.
const RESOLVED: f32 = 0.25;
/// Share of a step's spring that acts as a damper too, against the energy that comes in when a line grows taut within a
/// step: with a quarter none is left, whatever the stiffness.
const SETTLE: f32 = 0.25;

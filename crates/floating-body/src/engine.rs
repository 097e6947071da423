//! The engine: a propeller on the hull's axis that steers, as an outboard does, and a rudder behind it.

use glam::Vec3;

use crate::BodyError;
use crate::error::check_range;

/// What the game asks of a body in one tick.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Controls {
    /// Engine power from -1 (astern) to 1.
    pub throttle: f32,
    /// Steering from -1 (port) to 1 (starboard).
    pub steering: f32,
    /// Further force on the centre of mass in N, world axes: contact, towing, wind (Fc of Eq. 7).
    pub force: Vec3,
    /// Further torque in N m, world axes.
    pub torque: Vec3,
}

impl Controls {
    /// Numbers a game may pass by mistake are made harmless: NaN becomes 0, the rest is clamped.
    pub(crate) fn sane(&self) -> Self {
        let unit = |v: f32| if v.is_finite() { v.clamp(-1.0, 1.0) } else { 0.0 };
        let vector = |v: Vec3| if v.is_finite() { v.clamp_length_max(1.0e9) } else { Vec3::ZERO };
        Self {
            throttle: unit(self.throttle),
            steering: unit(self.steering),
            force: vector(self.force),
            torque: vector(self.torque),
        }
    }
}

/// A propeller with a rudder. The paper lets the engine push along the velocity, which is undefined at rest; here it
/// pushes along the hull's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Engine {
    /// Thrust in N at standstill and full throttle.
    pub bollard_thrust: f32,
    /// Speed in m/s at which the propeller no longer pushes; thrust falls linearly until there.
    pub pitch_speed: f32,
    /// Share of the thrust that is left astern, 0 to 1.
    pub astern: f32,
    /// The propeller's centre, hull frame, m. Out of the water it gives no thrust.
    pub position: Vec3,
    /// The propeller's radius in m: thrust fades while it breaks the surface.
    pub radius: f32,
    /// Angle in radians by which the thrust turns at full steering, up to 1.
    pub max_angle: f32,
    /// Area of the rudder in m^2; it steers without thrust, by the flow along the hull.
    pub rudder_area: f32,
}

impl Engine {
    pub(crate) fn check(&self) -> Result<(), BodyError> {
        check_range("engine.bollard_thrust", self.bollard_thrust, 0.0, 1.0e9, "in [0, 1e9] N")?;
        check_range("engine.pitch_speed", self.pitch_speed, 0.1, 200.0, "in [0.1, 200] m/s")?;
        check_range("engine.astern", self.astern, 0.0, 1.0, "in [0, 1]")?;
        for v in self.position.to_array() {
            check_range("engine.position", v, -1.0e4, 1.0e4, "within +-10000 m")?;
        }
        check_range("engine.radius", self.radius, 1.0e-3, 100.0, "in [0.001, 100] m")?;
        check_range("engine.max_angle", self.max_angle, 0.0, 1.0, "in [0, 1] rad")?;
        check_range("engine.rudder_area", self.rudder_area, 0.0, 1.0e3, "in [0, 1000] m^2").map(drop)
    }

    /// How much of the propeller is under water, 0 to 1, its centre being `depth` m deep.
    pub(crate) fn immersion(&self, depth: f32) -> f32 {
        (0.5 + 0.5 * depth / self.radius).clamp(0.0, 1.0)
    }

    /// Force in N on the hull (hull axes) for speed `ahead` m/s through the water.
    ///
    /// Thrust falls linearly with the speed of advance, as a propeller's open-water curve does; the rudder is a thin
    /// foil of aspect ratio about 2: lift slope 3 per radian on the flow past it. Its lift is at most `most`, N: what a step
    /// resolves.
    pub(crate) fn force(&self, controls: &Controls, ahead: f32, depth: f32, density: f32, most: f32) -> Vec3 {
        let throttle = controls.throttle;
        let full = if throttle < 0.0 { self.bollard_thrust * self.astern } else { self.bollard_thrust };
        let slip = (1.0 - ahead * throttle.signum() / self.pitch_speed).clamp(0.0, 1.5);
        let thrust = full * throttle * slip;
        let angle = controls.steering * self.max_angle;
        let lift = 0.5 * density * self.rudder_area * 3.0 * angle * ahead * ahead.abs();
        let lift = lift.clamp(-most, most);
        let force = Vec3::new(thrust * libm::cosf(angle), 0.0, -thrust * libm::sinf(angle) - lift);
        force * self.immersion(depth)
    }
}

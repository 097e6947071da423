//! The light of the sky on the CPU: what the shader needs as constants. `radiance` is the twin of `sky_radiance` in
//! `wgsl/shared/sky.wgsl`.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::frame::Sky;

/// Vertical optical depth of clear air at 680, 550 and 440 nm (8 km of 5.8, 13.5 and 33.1e-6 per metre).
pub(crate) const RAYLEIGH: Vec3 = Vec3::new(0.0464, 0.108, 0.2648);
/// Radiant scale of the sun outside the air: white, in units that make a clear horizon about 1.
const SUN: f32 = 20.0;

/// Sky light over that scattered once: what is scattered more than once is about as blue and comes from everywhere.
const MULTIPLE: f32 = 1.6;

/// Constants that follow from a [`Sky`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Light {
    pub(crate) sun: Vec3,
    pub(crate) mie: f32,
    pub(crate) sunlight: Vec3,
    pub(crate) airlight: Vec3,
    pub(crate) skylight: Vec3,
}

fn exp(v: Vec3) -> Vec3 {
    v.exp()
}

fn air_mass(y: f32) -> f32 {
    1.0 / (y + 0.025 * (-11.0 * y).exp())
}

impl Light {
    pub(crate) fn of(sky: &Sky) -> Self {
        let sun = sky.sun_direction.try_normalize().filter(|v| v.is_finite()).unwrap_or(Vec3::Y);
        let mie = if sky.aerosol.is_finite() { sky.aerosol.clamp(1e-3, 2.0) } else { 1e-3 };
        let path = (RAYLEIGH + mie) * air_mass(sun.y.max(0.0));
        // The disc sinks: below the horizon only the air above is lit, and soon nothing.
        let day = ((sun.y + 0.1) / 0.1).clamp(0.0, 1.0);
        let mut light = Self {
            sun,
            mie,
            sunlight: SUN * exp(-path) * ((sun.y + 0.02) / 0.04).clamp(0.0, 1.0),
            // Light that reaches the eye by the sky has on average come a shorter way through the dense air.
            airlight: SUN * exp(-0.35 * path) * day,
            skylight: Vec3::ZERO,
        };
        light.skylight = MULTIPLE * light.irradiance();
        light
    }

    /// Radiance towards a direction, without the disc.
    pub(crate) fn radiance(&self, direction: Vec3) -> Vec3 {
        let d = direction.with_y(direction.y.max(0.0)).normalize();
        let c = d.dot(self.sun);
        let c2 = 1.0 + c * c;
        let clear = 3.0 / (16.0 * PI) * c2;
        let g = 0.76f32;
        let g2 = g * g;
        let s = (1.0 + g2 - 2.0 * g * c).max(1e-4);
        let aerosol = 3.0 / (8.0 * PI) * (1.0 - g2) * c2 / ((2.0 + g2) * s * s.sqrt());
        let total = RAYLEIGH + self.mie;
        let phase = (RAYLEIGH * clear + Vec3::splat(self.mie * aerosol)) / total;
        self.airlight * phase * (Vec3::ONE - exp(-total * air_mass(d.y)))
    }

    /// Irradiance on level ground by the midpoint rule over equal areas of the disc below the hemisphere.
    fn irradiance(&self) -> Vec3 {
        const RINGS: u32 = 24;
        const SPOKES: u32 = 48;
        let mut sum = Vec3::ZERO;
        for i in 0..RINGS {
            let r2 = (i as f32 + 0.5) / RINGS as f32;
            for j in 0..SPOKES {
                let (sin, cos) = (TAU * (j as f32 + 0.5) / SPOKES as f32).sin_cos();
                let r = r2.sqrt();
                sum += self.radiance(Vec3::new(r * cos, (1.0 - r2).sqrt(), r * sin));
            }
        }
        sum * (PI / (RINGS * SPOKES) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clear_day_is_blue_above_bright_at_the_horizon_and_mostly_sun() {
        let light = Light::of(&Sky::default());
        let away = Vec3::new(-light.sun.x, 0.0, -light.sun.z).normalize();
        let zenith = light.radiance(Vec3::Y);
        let horizon = light.radiance(away);
        assert!(zenith.z > 2.0 * zenith.x, "{zenith}");
        assert!(horizon.y > 2.0 * zenith.y, "{horizon} {zenith}");
        assert!((horizon.z / horizon.x) < 1.5, "a white horizon: {horizon}");
        // Diffuse over direct on level ground: 10-35 % on a clear day with the sun at 20 to 60 degrees (Iqbal 1983).
        let share = light.skylight.y / (light.sunlight.y * light.sun.y);
        assert!((0.08..0.4).contains(&share), "{share}");
    }

    #[test]
    fn broken_input_gives_finite_light() {
        let sky = Sky { sun_direction: Vec3::NAN, aerosol: f32::NAN, ..Sky::default() };
        let light = Light::of(&sky);
        assert!(light.skylight.is_finite() && light.sunlight.is_finite());
    }
}

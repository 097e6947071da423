//! What a body asks of the water, and two waters to test and play with: a flat one and one regular wave.
//!
//! Does not own an ocean: any composite surface implements [`WaterSurface`] and is handed to a body's step.

use std::f64::consts::TAU;

use glam::{Vec2, Vec3};

use crate::GRAVITY;

/// The water at one horizontal position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Height of the surface in m without the waves of the body's own home grid: the ambient sea, other grids, the
    /// water level.
    pub height: f32,
    /// Height in m of the waves of the body's own home grid, to be added to `height`; 0 without one.
    pub own: f32,
    /// Unit normal of the surface, upwards.
    pub normal: Vec3,
    /// Velocity of the water at the surface in m/s: orbital motion plus current.
    pub velocity: Vec3,
    /// Vertical acceleration of the water at the surface in m/s^2.
    pub acceleration: f32,
    /// Wavenumber in rad/m with which the wave's pressure decays with depth, `exp(-k d)`; 0 for no decay.
    pub decay_wavenumber: f32,
    /// Height in m of the still water, part of `height`: the wave, whose pressure decays, is `height - level`.
    pub level: f32,
}

impl SurfaceSample {
    /// Still water at height 0.
    pub const CALM: Self = Self {
        height: 0.0,
        own: 0.0,
        normal: Vec3::Y,
        velocity: Vec3::ZERO,
        acceleration: 0.0,
        decay_wavenumber: 0.0,
        level: 0.0,
    };
}

impl Default for SurfaceSample {
    fn default() -> Self {
        Self::CALM
    }
}

/// The water under a body that is smaller than the waves it feels: a plane with one motion.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SurfacePatch {
    /// Height in m at the patch's centre without the body's own home grid, as [`SurfaceSample::height`].
    pub height: f32,
    /// Slope of `height`, (dh/dx, dh/dz).
    pub gradient: Vec2,
    /// Height in m of the home grid's waves at the centre, as [`SurfaceSample::own`].
    pub own: f32,
    /// Slope of `own`.
    pub own_gradient: Vec2,
    /// Velocity of the water in m/s.
    pub velocity: Vec3,
    /// Vertical acceleration of the water in m/s^2.
    pub acceleration: f32,
    /// As [`SurfaceSample::decay_wavenumber`].
    pub decay_wavenumber: f32,
    /// As [`SurfaceSample::level`].
    pub level: f32,
}

/// How far a point is inside something solid: the bed, a quay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// How far inside in m, along the normal; not positive outside.
    pub depth: f32,
    /// Unit normal, out of what is solid.
    pub normal: Vec3,
}

impl Touch {
    /// Nothing solid near by.
    pub const NONE: Self = Self { depth: f32::NEG_INFINITY, normal: Vec3::Y };
}

/// The grid that carries the waves a body makes, as far as the body is concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Home {
    /// There is none: `own` is 0.
    #[default]
    None,
    /// A grid for this body alone: `own` holds nothing but its own waves.
    Own,
    /// A grid that others disturb too: `own` holds their waves with its own, and is always felt.
    Shared,
}

/// The water surface as one body sees it (its `own` grid differs from body to body).
///
/// Positions are local world in m. Every call must answer for any finite position, without allocation.
pub trait WaterSurface: Sync {
    /// Fills `out` with the water at `points`; both have the same length.
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]);
    /// The water averaged over a disc of `radius` m about `center`.
    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch;
    /// The waves of the home grid, the body's own among them, over the body's textures (heave, roll, pitch: m^3, m^4, m^4)
    /// about its centre of mass and with its heading (radians from x towards z). `None` where no grid carries them; asked
    /// of bodies with [`Radiation::Grid`](crate::Radiation::Grid) whose textures were fitted
    /// ([`Body::fit_textures`](crate::Body::fit_textures)).
    fn radiated(&self, _at: Vec2, _heading: f32) -> Option<[f32; 3]> {
        None
    }
    /// [`patch`](Self::patch) for many places at once; all slices have the same length.
    fn patches(&self, centers: &[Vec2], radius: f32, out: &mut [SurfacePatch]) {
        for (center, out) in centers.iter().zip(out) {
            *out = self.patch(*center, radius);
        }
    }
    /// Whether the water between two corners is at rest and stays so for the next tick. False when in doubt.
    fn is_calm(&self, _low: Vec2, _high: Vec2) -> bool {
        false
    }
    /// What is solid at `points`; both slices have the same length. Returns whether anything is touched.
    fn touch(&self, _points: &[Vec3], _out: &mut [Touch]) -> bool {
        false
    }
    /// Velocity of the wind 10 m above the water in m/s, the same everywhere.
    fn wind(&self) -> Vec3 {
        Vec3::ZERO
    }
    /// Whose waves `own` holds.
    fn home(&self) -> Home {
        Home::None
    }
}

/// Flat water at one height with a uniform current.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct FlatWater {
    /// Height of the surface in m.
    pub height: f32,
    /// Velocity of the water in m/s.
    pub current: Vec3,
}

impl WaterSurface for FlatWater {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        let (height, velocity) = (self.height, self.current);
        let sample = SurfaceSample { height, velocity, level: height, ..SurfaceSample::CALM };
        out[..points.len()].fill(sample);
    }

    fn patch(&self, _center: Vec2, _radius: f32) -> SurfacePatch {
        let (height, velocity) = (self.height, self.current);
        SurfacePatch { height, velocity, level: height, ..SurfacePatch::default() }
    }

    fn is_calm(&self, _low: Vec2, _high: Vec2) -> bool {
        self.current == Vec3::ZERO
    }
}

/// One regular wave of linear (Airy) theory: `eta = level + a cos(k.x - omega t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AiryWave {
    /// Amplitude in m.
    pub amplitude: f32,
    /// Wave vector in rad/m; the wave travels towards it.
    pub wave_vector: Vec2,
    /// Angular frequency in rad/s.
    pub frequency: f32,
    /// Phase in radians at x = 0, t = 0.
    pub phase: f32,
    /// Time in s; set before each step.
    pub time: f64,
    /// Height of the still water in m.
    pub level: f32,
}

impl AiryWave {
    /// A deep-water wave (`omega^2 = g k`) of `wavelength` m that travels towards `direction` radians from +x to +z.
    ///
    /// A wavelength that is not positive gives flat water.
    pub fn new(amplitude: f32, wavelength: f32, direction: f32) -> Self {
        if !(wavelength > 0.0 && wavelength.is_finite() && direction.is_finite() && amplitude.is_finite()) {
            return Self { amplitude: 0.0, wave_vector: Vec2::ZERO, frequency: 0.0, phase: 0.0, time: 0.0, level: 0.0 };
        }
        let k = (TAU / f64::from(wavelength)) as f32;
        Self {
            amplitude,
            wave_vector: Vec2::new(libm::cosf(direction), libm::sinf(direction)) * k,
            frequency: (GRAVITY * k).sqrt(),
            phase: 0.0,
            time: 0.0,
            level: 0.0,
        }
    }

    /// Cosine and sine of the phase at a point, reduced in f64 so that long times stay exact.
    fn cos_sin(&self, point: Vec2) -> (f32, f32) {
        let k = self.wave_vector.as_dvec2();
        let theta = k.dot(point.as_dvec2()) - f64::from(self.frequency) * self.time + f64::from(self.phase);
        (libm::cos(theta) as f32, libm::sin(theta) as f32)
    }

    /// The wave at one point, without averaging.
    pub fn at(&self, point: Vec2) -> SurfacePatch {
        let (c, s) = self.cos_sin(point);
        let (a, w, k) = (self.amplitude, self.frequency, self.wave_vector.length());
        let along = if k > 0.0 { self.wave_vector / k } else { Vec2::ZERO };
        let u = along * (a * w * c);
        SurfacePatch {
            height: self.level + a * c,
            level: self.level,
            gradient: self.wave_vector * (-a * s),
            velocity: Vec3::new(u.x, a * w * s, u.y),
            acceleration: -a * w * w * c,
            decay_wavenumber: k,
            ..SurfacePatch::default()
        }
    }
}

impl WaterSurface for AiryWave {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (point, sample) in points.iter().zip(out) {
            let p = self.at(*point);
            *sample = SurfaceSample {
                height: p.height,
                own: 0.0,
                normal: Vec3::new(-p.gradient.x, 1.0, -p.gradient.y).normalize_or(Vec3::Y),
                velocity: p.velocity,
                acceleration: p.acceleration,
                decay_wavenumber: p.decay_wavenumber,
                level: p.level,
            };
        }
    }

    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        let p = self.at(center);
        let x = f64::from(p.decay_wavenumber) * f64::from(radius);
        // The mean of a wave over a disc.
        let mean = if x > 1.0e-3 { (2.0 * libm::j1(x) / x) as f32 } else { 1.0 };
        SurfacePatch {
            height: self.level + (p.height - self.level) * mean,
            gradient: p.gradient * mean,
            velocity: p.velocity * mean,
            acceleration: p.acceleration * mean,
            ..p
        }
    }
}

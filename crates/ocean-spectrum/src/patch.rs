//! The water under a small body, in one answer.

use glam::{Vec2, Vec3};

use crate::layers::State;
use crate::query::is_place;
use crate::{CascadeFactors, CascadeModes, Ocean};

/// The sea around a point as a small body feels it: a plane with its motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OceanPatch {
    /// Height, metres.
    pub height: f32,
    /// Slope (dh/dx, dh/dz) in world coordinates.
    pub gradient: Vec2,
    /// Velocity of the water at the surface, m/s.
    pub velocity: Vec3,
    /// Vertical acceleration of the water at the surface, m/s^2.
    pub vertical_acceleration: f32,
    /// Wavenumber k with which the motion fades with depth as e^(-k d), rad/m; see [`Ocean::decay_wavenumber`].
    pub decay_wavenumber: f32,
}

/// Means over the energy of one cascade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Band {
    variance: f32,
    wavenumber: f32,
}

impl Band {
    /// Of one cascade given twice, or the mixed terms of two.
    pub(crate) fn of(modes: &CascadeModes, other: &CascadeModes) -> Self {
        let size = modes.size as usize;
        let (mut sum, mut weighted) = (f64::MIN_POSITIVE, 0.0);
        for (cell, (amp, other)) in modes.amp.iter().zip(&other.amp).enumerate() {
            let power = f64::from(amp[0] * other[0] + amp[1] * other[1]);
            let index = |i: usize| f64::from(modes.signed(i as u32));
            let (i, j) = (index(cell % size), index(cell / size));
            sum += power;
            weighted += power * modes.step() * (i * i + j * j).sqrt();
        }
        Self { variance: (2.0 * sum) as f32, wavenumber: (weighted / sum) as f32 }
    }

    /// Of a mix: the sum of such terms with their weights.
    pub(crate) fn sum(terms: impl Iterator<Item = (f32, Self)>) -> Self {
        let (sum, weighted) = terms.fold((f32::MIN_POSITIVE, 0.0), |(sum, weighted), (weight, band)| {
            let variance = weight * band.variance;
            (sum + variance, weighted + variance * band.wavenumber)
        });
        Self { variance: sum, wavenumber: weighted / sum }
    }

    /// Share of the waves that is left in their mean over a disc: `2 J1(x)/x` at `x = k radius`, 0 from its first zero.
    fn share(self, radius: f32) -> f32 {
        let x = self.wavenumber * radius.max(1e-3);
        if x < 3.8317 { 2.0 * libm::j1f(x) / x } else { 0.0 }
    }
}

impl Ocean {
    /// The sea under a body of the given radius (metres) at a local position, at the time set.
    ///
    /// A body does not feel waves much shorter than itself, since their rise and fall cancels over its area: each
    /// cascade counts by the mean that is left over a disc of that radius at the cascade's mean wavenumber. With
    /// radius 0 the answer is that of [`Ocean::sample`]. Calm water where the position is not finite or farther than
    /// 10^8 m; a radius that is negative or not a number counts as 0.
    pub fn patch(&self, center: Vec2, radius: f32) -> OceanPatch {
        let decay_wavenumber = self.decay_wavenumber(radius);
        if !is_place(center) {
            return OceanPatch { decay_wavenumber, ..Default::default() };
        }
        let layers = self.layers();
        let rest = layers.find(center).rest;
        let State { displacement, gradient, velocity } = layers.state(rest, |c| self.layers[c].band.share(radius));
        OceanPatch {
            height: displacement[1],
            gradient: gradient.world_slope(),
            velocity: Vec3::new(velocity[0], velocity[1], velocity[2]),
            vertical_acceleration: velocity[3],
            decay_wavenumber: layers.map.map_or(decay_wavenumber, |map| self.decay(radius, map.values(rest))),
        }
    }

    /// Mean wavenumber, weighted by variance, of the waves that a body of the given radius (metres) feels, rad/m: the
    /// pressure and motion of the sea fade about as e^(-k d) with depth d under it. That of the open sea, where no map
    /// weakens it.
    pub fn decay_wavenumber(&self, radius: f32) -> f32 {
        self.decay(radius, [1.0; 8])
    }

    fn decay(&self, radius: f32, factors: CascadeFactors) -> f32 {
        let (mut sum, mut weighted) = (f32::MIN_POSITIVE, 0.0);
        for (band, factor) in self.layers.iter().map(|layer| layer.band).zip(factors) {
            let share = band.share(radius) * factor;
            let weight = band.variance * share * share;
            sum += weight;
            weighted += weight * band.wavenumber;
        }
        // A body that averages out every wave feels at least the longest.
        if weighted > 0.0 { weighted / sum } else { self.layers[0].band.wavenumber }
    }
}

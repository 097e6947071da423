//! What the body tells the water: the signed changes of displaced volume, column by column.
//!
//! Measured against the surface without the body's own grid. A source that includes the waves it made feeds itself and
//! grows; one that leaves the ambient sea in would make waves by merely riding a swell.

use glam::{Vec2, Vec3};

use crate::ForcePoint;
use crate::forces::{LocalWater, Pose};

/// A change of displaced volume to be put into the home grid, or wash from a propeller.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Displacement {
    /// Where, local world (x, z) in m.
    pub center: Vec2,
    /// Radius in m over which it is spread.
    pub radius: f32,
    /// Volume in m^3: positive where the hull has pushed water away, negative where it has left.
    pub volume: f32,
    /// Foam that comes with it, 0 to 1.
    pub foam: f32,
}

/// The column of water that a force point displaced when it was last told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Column {
    at: Vec2,
    volume: f32,
    /// The volume before, where it was before.
    old_at: Vec2,
    old_volume: f32,
}

/// Moves shorter than this share of the radius wait until they have added up.
pub(crate) const NEAR: f32 = 0.005;
/// So do changes smaller than this share of the point's volume.
pub(crate) const QUIET: f32 = 1.0e-6;

/// Discs told to the water are wider than their columns by this factor, so that they overlap and a moving hull makes one
/// wake, not one per column.
const SPREAD: f32 = 2.5;

/// Radius of the disc with a point's horizontal area.
fn radius(point: &ForcePoint) -> f32 {
    (point.half.x * point.half.z * (4.0 / std::f32::consts::PI)).sqrt()
}

impl Column {
    /// Takes the volume now displaced by `point`. `age` is the time since the water was sampled: the surface is carried
    /// on with its velocity so that a float riding a swell keeps its draft. With `restart` nothing is told.
    pub(crate) fn measure(
        &mut self,
        point: &ForcePoint,
        water: &LocalWater,
        pose: &Pose,
        age: f32,
        reach: f32,
        restart: bool,
    ) {
        let at = pose.position + pose.rotation * point.position;
        let now = Vec2::new(at.x, at.z);
        let depth = water.ambient(now) + water.rise() * age - at.y;
        let normal = Vec3::new(-water.slope.x, 1.0, -water.slope.y).normalize();
        let i = point.immersion(depth, pose.rotation.transpose() * normal);
        // What goes on far below hardly moves the surface.
        let below = (depth - i.extent).max(0.0) / reach;
        let volume = point.volume * i.share / (1.0 + below * below);
        (self.old_at, self.old_volume) = if restart { (now, volume) } else { (self.at, self.volume) };
        if restart || now.distance(self.at) >= NEAR * radius(point) {
            (self.at, self.volume) = (now, volume);
        } else if (volume - self.volume).abs() >= QUIET * point.volume {
            self.volume = volume;
        }
    }

    /// Appends what has changed.
    pub(crate) fn tell(&self, point: &ForcePoint, out: &mut Vec<Displacement>) {
        let radius = SPREAD * radius(point);
        let mut push = |center, volume: f32| {
            if volume != 0.0 {
                out.push(Displacement { center, radius, volume, foam: 0.0 });
            }
        };
        if self.at == self.old_at {
            push(self.at, self.volume - self.old_volume);
        } else {
            push(self.old_at, -self.old_volume);
            push(self.at, self.volume);
        }
    }

    /// Moves with the local origin.
    pub(crate) fn rebase(&mut self, offset: Vec2) {
        self.at -= offset;
        self.old_at -= offset;
    }

    /// Volume that was last told.
    pub(crate) fn told(&self) -> f32 {
        self.volume
    }
}

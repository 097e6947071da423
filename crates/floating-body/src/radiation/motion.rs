//! What a body that radiates through textures tells the water, and what the water answers.
//!
//! The motion told is that against the ambient water: a float that rides a swell makes no waves. What the hull displaces
//! is the volume of its columns, as it is for grids without textures, so that a body that leaves the water takes all of it
//! along; while it is afloat heave's texture stands for the change.

use glam::{Vec2, Vec3};

use super::texture::Textures;
use crate::ForcePoint;
use crate::forces::{LocalWater, Pose};

/// Layers of [`Textures`] (heave, roll, pitch, hull) to be added to a grid at a place: heights in m are the sum of the
/// amounts times the kernels.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Imprint {
    /// The body's centre of mass, local (x, z), m.
    pub at: Vec2,
    /// Of the hull's x axis, radians from x towards z.
    pub heading: f32,
    /// Heave in m, roll and pitch in radians, share of the volume at rest.
    pub amounts: [f32; 4],
}

/// Moves shorter than this share of the waterplane's radius wait until they have added up, in m per m.
const NEAR: f32 = 1.0e-3;
/// So do changes of height below this, m.
const QUIET: f32 = 1.0e-6;
/// Upright enough for the textures: the cosine of the tilt at which they fade, and that at which they are gone.
const UPRIGHT: (f32, f32) = (0.8, 0.5);

/// Where a body is against the ambient water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Place {
    at: Vec2,
    heading: f32,
    /// Heave in m, roll and pitch in radians.
    modes: Vec3,
    /// Volume over the volume at rest.
    share: f32,
}

/// What changes from tick to tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Motion {
    told: Place,
    before: Place,
    /// How much of the textures acts, 0 to 1.
    gate: f32,
    /// Amounts of the last tick.
    change: Vec3,
    /// The water's answer in this tick: m^3, m^4, m^4.
    pub(crate) heads: Vec3,
    /// It takes part in this tick.
    pub(crate) on: bool,
}

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct Radiator {
    pub(crate) textures: Textures,
    /// Centre of the waterplane from the centre of mass, hull axes (x, z), m.
    pub(crate) center: Vec2,
    /// Of the waterplane, m.
    radius: f32,
    /// Of the waterplane over the volume at rest, 1/m.
    area_by_volume: f32,
    /// Sums over the points' areas: the areas, their second moments.
    areas: [f32; 3],
    /// See [`crossing`], at rest.
    afloat: f32,
    pub(crate) motion: Motion,
}

fn area(point: &ForcePoint) -> f32 {
    4.0 * point.half.x * point.half.z
}

/// How much a hull of which this share of the volume is under water counts as afloat. Asked of the whole hull: where it is
/// made of layers, the surface may lie between two of them.
fn crossing(share: f32) -> f32 {
    (10.0 * share.min(1.0 - share)).clamp(0.0, 1.0)
}

impl Radiator {
    pub(crate) fn new(textures: Textures, center: Vec2, plane: f32, volume: f32) -> Self {
        Self {
            textures,
            center,
            radius: (plane / std::f32::consts::PI).sqrt(),
            area_by_volume: plane / volume,
            areas: [0.0; 3],
            afloat: 0.0,
            motion: Motion::default(),
        }
    }

    /// Sums over the points; at rest the water is at `level` over the centre of mass.
    pub(crate) fn weigh(&mut self, points: &[ForcePoint], level: f32) {
        self.areas = [0.0; 3];
        let (mut wet, mut whole) = (0.0, 0.0);
        for point in points {
            let from = Vec2::new(point.position.x, point.position.z) - self.center;
            self.areas[0] += area(point);
            self.areas[1] += area(point) * from.x * from.x;
            self.areas[2] += area(point) * from.y * from.y;
            wet += point.volume * point.immersion(level - point.position.y, Vec3::Y).share;
            whole += point.volume;
        }
        self.afloat = crossing(wet / whole);
    }

    /// Where the textures lie: the centre of mass and the heading of the hull's x axis.
    pub(crate) fn spot(pose: &Pose) -> (Vec2, f32) {
        let along = pose.rotation.x_axis;
        (Vec2::new(pose.position.x, pose.position.z), libm::atan2f(along.z, along.x))
    }

    /// Takes the body's motion against the ambient water, `age` s after that was read, and the volume now displaced.
    pub(crate) fn measure(
        &mut self,
        points: &[ForcePoint],
        waters: &[LocalWater],
        pose: &Pose,
        age: f32,
        volume_share: f32,
        restart: bool,
    ) {
        let r = pose.rotation;
        let (at, heading) = Self::spot(pose);
        let (mut sums, mut wet, mut all) = (Vec3::ZERO, 0.0, 0.0);
        let middle = pose.position + r * Vec3::new(self.center.x, 0.0, self.center.y);
        let height_at = |point: &ForcePoint, water: &LocalWater| {
            let p = pose.position + r * point.position;
            let here = Vec2::new(p.x, p.z);
            (water.ambient(here) + water.rise() * age, p.y)
        };
        for (point, water) in points.iter().zip(waters) {
            let (height, y) = height_at(point, water);
            let from = Vec2::new(point.position.x, point.position.z) - self.center;
            let over = height - middle.y;
            sums += Vec3::new(over, -from.y * over, from.x * over) * area(point);
            let share = point.immersion(height - y, r.transpose() * Vec3::Y).share;
            wet += point.volume * share;
            all += point.volume;
        }
        let [whole, along, across] = self.areas;
        let per = |sum: f32, by: f32| if by > 0.0 { sum / by } else { 0.0 };
        let water = Vec3::new(per(sums.x, whole), per(sums.y, across), per(sums.z, along));
        let modes = Vec3::new(0.0, -r.z_axis.y, r.x_axis.y) - water;
        let upright = ((r.y_axis.y - UPRIGHT.1) / (UPRIGHT.0 - UPRIGHT.1)).clamp(0.0, 1.0);
        self.motion.gate = upright * per(2.0 * crossing(wet / all), self.afloat).min(1.0);
        let now = Place { at, heading, modes, share: volume_share };
        self.motion.before = if restart { now } else { self.motion.told };
        if restart {
            self.motion.told = now;
            self.motion.change = Vec3::ZERO;
            return;
        }
        let change = modes - self.motion.told.modes;
        let moved = at.distance(self.motion.told.at) + self.radius * turn(heading - self.motion.told.heading).abs();
        if moved >= NEAR * self.radius {
            (self.motion.told.at, self.motion.told.heading) = (at, heading);
        }
        let heights = change.abs() * Vec3::new(1.0, self.radius, self.radius);
        if heights.max_element() >= QUIET {
            self.motion.told.modes = modes;
            self.motion.told.share = volume_share;
            self.motion.change = change * self.motion.gate;
        } else {
            self.motion.change = Vec3::ZERO;
        }
    }

    /// The force in N and the torque about the hull's x and z in N m of the grid's waves.
    pub(crate) fn push(&self, density: f32) -> Vec3 {
        self.motion.heads * (self.motion.gate * density * crate::GRAVITY)
    }

    /// What is to be written: the hull is taken from where it was and put where it is, the modes act there.
    pub(crate) fn imprints(&self) -> [Imprint; 2] {
        let (old, new) = (&self.motion.before, &self.motion.told);
        let Vec3 { x: heave, y: roll, z: pitch } = -self.motion.change;
        // Heave's texture brings the volume itself.
        let volume = new.share - heave * self.area_by_volume;
        let here = Imprint { at: new.at, heading: new.heading, amounts: [heave, roll, pitch, volume] };
        if old.at == new.at && old.heading == new.heading {
            let mut one = here;
            one.amounts[3] -= old.share;
            return [one, Imprint::default()];
        }
        [Imprint { at: old.at, heading: old.heading, amounts: [0.0, 0.0, 0.0, -old.share] }, here]
    }

    /// Moves with the local origin.
    pub(crate) fn rebase(&mut self, offset: Vec2) {
        self.motion.told.at -= offset;
        self.motion.before.at -= offset;
    }
}

/// An angle in (-pi, pi].
fn turn(angle: f32) -> f32 {
    angle - std::f32::consts::TAU * (angle / std::f32::consts::TAU).round()
}

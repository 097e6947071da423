//! What a body that radiates through textures tells the water, and what the water answers.
//!
//! The motion told is that against the ambient water: a float that rides a swell makes no waves. What the hull displaces
//! is the volume of its columns, as it is for grids without textures, so that a body that leaves the water takes all of it
//! along; while it is afloat heave's texture stands for the change.
//!
//! What has been told depends on where the body is, not on the way there: a game that leads a body in and out of the water,
//! in leaps if it likes, raises no more water than the hull holds.

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
/// So do changes below this of height, in m, and of the share of the volume.
const QUIET: f32 = 1.0e-6;
/// Upright enough for the textures, by the sine of the tilt against the water.
const UPRIGHT: Fade = Fade { from: 0.6, to: 0.866 };
/// Share of the volume that is under water where textures begin to fade as the hull rises, and that is dry as it sinks;
/// half of what it is at rest, if that is less.
const AFLOAT: f32 = 0.05;

/// Second moments below this share of the area's with the waterplane's radius are none.
const NARROW: f32 = 1.0e-6;

/// Where a body is against the ambient water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Place {
    at: Vec2,
    heading: f32,
    /// Heave in m from rest, roll and pitch in radians, of which only so much counts as the textures act.
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
    /// Heave from rest above which and, turned about, below which textures fade, m.
    rise: Fade,
    sink: Fade,
    /// Height of the water over the centre of mass at rest, m.
    level: f32,
    pub(crate) motion: Motion,
}

fn area(point: &ForcePoint) -> f32 {
    4.0 * point.half.x * point.half.z
}

/// Something acts up to one amount of a motion and no more from another on.
#[derive(Clone, Copy, Debug, Default)]
struct Fade {
    from: f32,
    to: f32,
}

impl Fade {
    /// How far it has faded at an amount, 0 to 1.
    fn gone(&self, amount: f32) -> f32 {
        ((amount - self.from) / (self.to - self.from).max(1.0e-6)).clamp(0.0, 1.0)
    }

    /// The integral of what is left from 0 to an amount: so much of the motion counts.
    fn counted(&self, amount: f32) -> f32 {
        let gone = self.gone(amount);
        amount.min(self.from) + (self.to - self.from).max(1.0e-6) * gone * (1.0 - 0.5 * gone)
    }
}

impl Radiator {
    pub(crate) fn new(textures: Textures, center: Vec2, plane: f32, volume: f32) -> Self {
        Self {
            textures,
            center,
            radius: (plane / std::f32::consts::PI).sqrt(),
            area_by_volume: plane / volume,
            areas: [0.0; 3],
            rise: Fade::default(),
            sink: Fade::default(),
            level: 0.0,
            motion: Motion::default(),
        }
    }

    /// Sums over the points; at rest the water is at `level` over the centre of mass.
    pub(crate) fn weigh(&mut self, points: &[ForcePoint], level: f32) {
        self.areas = [0.0; 3];
        for point in points {
            let from = Vec2::new(point.position.x, point.position.z) - self.center;
            self.areas[0] += area(point);
            self.areas[1] += area(point) * from.x * from.x;
            self.areas[2] += area(point) * from.y * from.y;
        }
        // Points in a line tell no slope across it.
        let least = NARROW * self.areas[0] * self.radius * self.radius;
        self.areas[1..].iter_mut().filter(|moment| **moment < least).for_each(|moment| *moment = 0.0);
        let whole: f32 = points.iter().map(|point| point.volume).sum();
        let wet = |heave: f32| {
            let under = |point: &ForcePoint| point.immersion(level - heave - point.position.y, Vec3::Y).share;
            points.iter().map(|point| point.volume * under(point)).sum::<f32>() / whole
        };
        let (mut low, mut high) = (0.0f32, 0.0f32);
        for point in points {
            low = low.min(level - point.position.y - point.half.y);
            high = high.max(level - point.position.y + point.half.y);
        }
        let until = |end: f32, holds: &dyn Fn(f32) -> bool| {
            let (mut near, mut far) = (0.0, end);
            for _ in 0..24 {
                let middle = 0.5 * (near + far);
                *(if holds(middle) { &mut near } else { &mut far }) = middle;
            }
            near.abs()
        };
        let rest = wet(0.0);
        let (dry, full) = (AFLOAT.min(0.5 * rest), AFLOAT.min(0.5 * (1.0 - rest)));
        self.rise = Fade { from: until(high, &|heave| wet(heave) > dry), to: high };
        self.sink = Fade { from: until(low, &|heave| 1.0 - wet(heave) > full), to: -low };
        self.level = level;
    }

    /// What counts of a heave from rest in m and of a roll and pitch, and how much of the textures acts, 0 to 1.
    fn counted(&self, heave: f32, turned: Vec2, upright: bool) -> (Vec3, f32) {
        let fade = if heave > 0.0 { self.rise } else { self.sink };
        let afloat = 1.0 - fade.gone(heave.abs());
        let tilt = turned.length();
        let (left, part) = if !upright {
            // Bottom up they do not act, and what was told has gone back by the time the hull's sides are level again.
            (0.0, UPRIGHT.counted(1.0))
        } else if tilt > UPRIGHT.from {
            (1.0 - UPRIGHT.gone(tilt), UPRIGHT.counted(tilt) / tilt)
        } else {
            (1.0, 1.0)
        };
        let heave = heave.signum() * fade.counted(heave.abs()) * left;
        let turned = turned * (part * afloat);
        (Vec3::new(heave, turned.x, turned.y), left * afloat)
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
        let mut sums = Vec3::ZERO;
        let middle = pose.position + r * Vec3::new(self.center.x, 0.0, self.center.y);
        for (point, water) in points.iter().zip(waters) {
            let p = pose.position + r * point.position;
            let height = water.ambient(Vec2::new(p.x, p.z)) + water.rise() * age;
            let from = Vec2::new(point.position.x, point.position.z) - self.center;
            let over = height - middle.y;
            sums += Vec3::new(over, -from.y * over, from.x * over) * area(point);
        }
        let [whole, along, across] = self.areas;
        let per = |sum: f32, by: f32| if by > 0.0 { sum / by } else { 0.0 };
        let water = Vec3::new(per(sums.x, whole), per(sums.y, across), per(sums.z, along));
        // A ball has no tilt, however it lies.
        let round = along == 0.0 && across == 0.0;
        let turned = if round { Vec2::ZERO } else { Vec2::new(-r.z_axis.y - water.y, r.x_axis.y - water.z) };
        let (modes, gate) = self.counted(self.level - water.x, turned, round || r.y_axis.y > 0.0);
        self.motion.gate = gate;
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
        // Under water what the surface knows of the hull goes on changing when nothing else does.
        if heights.max_element() >= QUIET || (volume_share - self.motion.told.share).abs() >= QUIET {
            self.motion.told.modes = modes;
            self.motion.told.share = volume_share;
            self.motion.change = change;
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

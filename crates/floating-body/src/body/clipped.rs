//! A body whose hull is clipped at the water surface instead of summed over force points, always or near the eye.

use fearless_simd::Level;
use glam::{Vec2, Vec3};

use super::Body;
use crate::desc::{Quality, Sampling};
use crate::forces::{LocalWater, Pose, Wetness, buoyancy};
use crate::hull::clip::closed;
use crate::hull::clip::lanes::{Fade, Plane, push};
use crate::hull::clip::panels::Panels;
use crate::hull::shapes::Shape;
use crate::{BodyDesc, ForcePoint, GRAVITY};

/// A change of quality is spread over so many s.
const BLEND: f32 = 0.5;
/// Beyond `Near` clipping fades out until this multiple of it.
const FAR: f32 = 1.25;
/// Triangles under a surface that is sampled have edges of this share of the hull's length at most.
pub(super) const LONGEST: f32 = 1.0 / 12.0;
/// Samples closer than this share of the hull's length count once.
const SAME: f32 = 1.0e-3;

/// What is clipped.
#[derive(Clone, Debug)]
enum Cut {
    Panels(Panels),
    /// A ball or cylinder under one plane.
    Shape(Shape),
}

#[derive(Clone, Debug)]
pub(super) struct Clipping {
    level: Level,
    cut: Cut,
    /// The force points whose water the planes are.
    samples: Vec<usize>,
    planes: Vec<Plane>,
    depths: Vec<f32>,
    /// Share of the clipped forces, 0 to 1; the rest is the points'.
    share: f32,
    near: f32,
    distance: f32,
}

impl Clipping {
    /// `None` for bodies of force points. `points` are relative to the centre of mass.
    pub(super) fn new(desc: &BodyDesc, points: &[ForcePoint]) -> Option<Box<Self>> {
        let near = match desc.quality {
            Quality::Points => return None,
            Quality::Clipped => f32::INFINITY,
            Quality::Near(near) => near,
        };
        let (low, high) = desc.hull.bounds();
        let longest = (high - low).max_element();
        let mut samples: Vec<usize> = vec![0];
        let at = |i: usize| Vec2::new(points[i].position.x, points[i].position.z);
        let cut = match (desc.sampling, desc.hull.round()) {
            (Sampling::Patch, Some(shape)) => Cut::Shape(shape),
            (Sampling::Patch, None) => {
                Cut::Panels(Panels::new(&desc.hull.skin(f32::INFINITY), desc.center_of_mass, &[]))
            }
            (Sampling::Points, _) => {
                for i in 1..points.len() {
                    if samples.iter().all(|s| at(*s).distance(at(i)) > SAME * longest) {
                        samples.push(i);
                    }
                }
                let places: Vec<Vec2> = samples.iter().map(|i| at(*i)).collect();
                let skin = desc.hull.skin(LONGEST * longest);
                Cut::Panels(Panels::new(&skin, desc.center_of_mass, &places))
            }
        };
        let planes = Vec::with_capacity(samples.len());
        let share = if near == f32::INFINITY { 1.0 } else { 0.0 };
        Some(Box::new(Self {
            level: Level::new(),
            cut,
            samples,
            planes,
            depths: Vec::new(),
            share,
            near,
            distance: f32::INFINITY,
        }))
    }

    /// Share and distance.
    pub(super) fn seen(&self) -> (f32, f32) {
        (self.share, self.distance)
    }

    pub(super) fn see(&mut self, (share, distance): (f32, f32)) {
        (self.share, self.distance) = (share, distance);
    }

    /// Moves the share towards what the distance asks for; at once after a teleport.
    fn attend(&mut self, dt: f32, restart: bool) {
        if self.near == f32::INFINITY {
            return;
        }
        let out = ((self.distance / self.near - 1.0) / (FAR - 1.0)).clamp(0.0, 1.0);
        let step = if restart { 1.0 } else { dt / BLEND };
        self.share += ((1.0 - out) - self.share).clamp(-step, step);
    }

    /// Replaces buoyancy by what clipping finds, as far as the share goes.
    pub(super) fn mix(&mut self, wet: &mut Wetness, waters: &[LocalWater], own: bool, pose: &Pose, desc: &BodyDesc) {
        let to_hull = pose.rotation.transpose();
        let at = Vec2::new(pose.position.x, pose.position.z);
        let plane = |water: &LocalWater| {
            let height = water.ambient(at) + if own { water.own } else { 0.0 };
            let slope = Vec3::new(-water.slope.x, 1.0, -water.slope.y);
            (height - pose.position.y, slope)
        };
        let weight = desc.water_density * GRAVITY;
        let (force, torque, volume) = match &self.cut {
            Cut::Shape(shape) => {
                let water = &waters[0];
                let (depth, slope) = plane(water);
                let steep = slope.length();
                let normal = to_hull * slope / steep;
                let height = (depth + (to_hull * slope).dot(desc.center_of_mass)) / steep;
                let Some(part) = closed::below(shape, normal.as_dvec3(), f64::from(height)) else { return };
                let whole = desc.hull.volume();
                let volume = part.volume as f32;
                if volume <= 0.0 {
                    (Vec3::ZERO, Vec3::ZERO, 0.0)
                } else {
                    let (pull, fade) = buoyancy(volume / whole, part.extent as f32, height, water);
                    let force = Vec3::new(slope.x * fade, 1.0, slope.z * fade) * (weight * whole * pull);
                    let center = (part.moment / part.volume).as_vec3() - desc.center_of_mass;
                    (force, (pose.rotation * center).cross(force), volume)
                }
            }
            Cut::Panels(panels) => {
                self.planes.clear();
                let (mut level, mut decay) = (0.0, 0.0);
                for i in &self.samples {
                    let (depth, slope) = plane(&waters[*i]);
                    self.planes.push(Plane { depth, slope: to_hull * slope });
                    (level, decay) = (level + waters[*i].level, decay + waters[*i].decay);
                }
                let share = 1.0 / self.samples.len() as f32;
                let up = to_hull * Vec3::Y;
                let still = Plane { depth: level * share - pose.position.y, slope: up };
                let fade = Fade { wavenumber: decay * share, still };
                let deep = fade.wavenumber * (self.reach(desc) + still.depth.max(0.0));
                let fade = (deep >= 1.0e-3).then_some(fade);
                let push = push(self.level, panels, &self.planes, fade, &mut self.depths);
                let turned = |v: Vec3| pose.rotation * v * weight;
                (turned(push.force), turned(push.torque), push.lift.dot(up).max(0.0))
            }
        };
        wet.force += (force - wet.force) * self.share;
        wet.torque += (torque - wet.torque) * self.share;
        wet.volume += (volume - wet.volume) * self.share;
    }

    fn reach(&self, desc: &BodyDesc) -> f32 {
        let (low, high) = desc.hull.bounds();
        (high - low).length()
    }
}

impl Body {
    /// Tells how far the eye is, in m, for [`Quality::Near`]; infinitely far until then. What is not a number is ignored.
    pub fn set_distance(&mut self, distance: f32) {
        if let Some(clipping) = self.clipping.as_mut().filter(|_| !distance.is_nan()) {
            clipping.distance = distance;
        }
    }

    /// Share of the buoyancy that comes from clipping, 0 to 1; the rest is the force points'.
    pub fn clipped_share(&self) -> f32 {
        self.clipping.as_ref().map_or(0.0, |c| c.share)
    }

    pub(super) fn attend(&mut self, dt: f32) {
        if let Some(clipping) = &mut self.clipping {
            clipping.attend(dt, self.restart);
        }
    }

    pub(super) fn clip(&mut self, wet: &mut Wetness, pose: &Pose) {
        if let Some(clipping) = self.clipping.as_mut().filter(|c| c.share > 0.0) {
            clipping.mix(wet, &self.waters, self.feels_own, pose, &self.desc);
        }
    }
}

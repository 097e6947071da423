//! The forces of Eq. 7 of the paper, one small function each, and the water they read.
//!
//! Moorings are in `mooring.rs`, contact in `contact.rs`, drag in `drag.rs`, friction in `skin.rs`, blows in `slam.rs`, wind in
//! `wind.rs`, radiated waves in `coefficients.rs` and `radiation`. There is no planing lift.

use glam::{Mat3, Vec2, Vec3};

use crate::{ForcePoint, GRAVITY, SurfacePatch, SurfaceSample, WaterSurface};

/// The water at a force point for the length of a tick: a plane through what was sampled.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct LocalWater {
    pub(crate) at: Vec2,
    /// Without the body's own grid.
    pub(crate) height: f32,
    pub(crate) own: f32,
    pub(crate) slope: Vec2,
    pub(crate) velocity: Vec3,
    pub(crate) acceleration: f32,
    pub(crate) decay: f32,
    /// Height of the still water.
    pub(crate) level: f32,
}

/// Steepest slope that is believed; steeper water is breaking and no height field.
const STEEPEST: f32 = 1.0;
/// Fastest water that is believed, m/s.
const FASTEST: f32 = 50.0;

impl LocalWater {
    /// A sample, made harmless, the wave averaged over a disc with the square of a radius `footprint`, m^2.
    fn new(at: Vec2, s: &SurfaceSample, footprint: f32) -> Self {
        let patch = SurfacePatch {
            height: s.height,
            own: s.own,
            gradient: Vec2::new(-s.normal.x, -s.normal.z) / s.normal.y.max(0.1),
            own_gradient: Vec2::ZERO,
            velocity: s.velocity,
            acceleration: s.acceleration,
            decay_wavenumber: s.decay_wavenumber,
            level: s.level,
        };
        let w = Self::plane(at, &patch);
        let mean = mean_over_disc(w.decay * w.decay * footprint);
        Self {
            height: w.level + (w.height - w.level) * mean,
            slope: w.slope * mean,
            // A current flows level and is no wave.
            velocity: Vec3::new(w.velocity.x, w.velocity.y * mean, w.velocity.z),
            acceleration: w.acceleration * mean,
            ..w
        }
    }

    /// A patch, made harmless: what is not finite becomes calm water.
    fn plane(at: Vec2, p: &SurfacePatch) -> Self {
        let slope = p.gradient + p.own_gradient;
        // A number times 0 is 0 unless it is none.
        let none = (p.height + p.level + p.own + p.acceleration + p.decay_wavenumber) * 0.0
            + (slope.element_sum() + p.velocity.element_sum()) * 0.0;
        if none.is_nan() {
            return Self { at, ..Self::default() };
        }
        Self {
            at,
            height: p.height.clamp(-1.0e4, 1.0e4),
            own: p.own.clamp(-100.0, 100.0),
            slope: shortened(slope),
            velocity: if p.velocity.length_squared() > FASTEST * FASTEST {
                p.velocity.clamp_length_max(FASTEST)
            } else {
                p.velocity
            },
            acceleration: p.acceleration.clamp(-0.9 * GRAVITY, 3.0 * GRAVITY),
            decay: p.decay_wavenumber.clamp(0.0, 100.0),
            level: p.level.clamp(-1.0e4, 1.0e4),
        }
    }

    /// How fast the surface rises at a fixed place, m/s.
    pub(crate) fn rise(&self) -> f32 {
        self.velocity.y - self.slope.dot(Vec2::new(self.velocity.x, self.velocity.z))
    }

    /// Height of the ambient surface at a point near by.
    pub(crate) fn ambient(&self, point: Vec2) -> f32 {
        self.height + self.slope.dot(point - self.at)
    }
}

/// What is left of a regular wave averaged over a disc of radius r, by `(k r)^2`: `2 J1(k r)/(k r)`, here `exp(-(k r)^2/8)`,
/// which is no more than .03 above it up to k r = 2.
fn mean_over_disc(square: f32) -> f32 {
    if square < 8.0e-3 { 1.0 } else { libm::expf(-0.125 * square) }
}

/// Fills `out` from one sample per point, averaged over what the point stands for; past the points (the propeller) as it is.
pub(crate) fn read_points(
    water: &dyn WaterSurface,
    at: &[Vec2],
    points: &[ForcePoint],
    samples: &mut [SurfaceSample],
    out: &mut [LocalWater],
) {
    water.sample(at, samples);
    let footprints = points.iter().map(ForcePoint::footprint).chain(std::iter::once(0.0));
    for (((p, s), o), footprint) in at.iter().zip(&*samples).zip(out).zip(footprints) {
        *o = LocalWater::new(*p, s, footprint);
    }
}

/// The slope, if it is not too steep.
fn shortened(slope: Vec2) -> Vec2 {
    if slope.length_squared() > STEEPEST * STEEPEST { slope.clamp_length_max(STEEPEST) } else { slope }
}

/// The plane of a patch read about `center`, and the slope of its height without the home grid's waves.
pub(crate) fn read_plane(center: Vec2, patch: &SurfacePatch) -> (LocalWater, Vec2) {
    let gradient = if patch.gradient.is_finite() { shortened(patch.gradient) } else { Vec2::ZERO };
    (LocalWater::plane(center, patch), gradient)
}

/// Fills `out` from one patch about `center`.
pub(crate) fn read_patch(water: &dyn WaterSurface, center: Vec2, radius: f32, at: &[Vec2], out: &mut [LocalWater]) {
    let (plane, gradient) = read_plane(center, &water.patch(center, radius));
    for (p, o) in at.iter().zip(out) {
        let away = *p - center;
        let height = plane.height + gradient.dot(away);
        *o = LocalWater { at: *p, height, own: plane.own + (plane.slope - gradient).dot(away), ..plane };
    }
}

/// What the water does to all force points together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wetness {
    /// Buoyancy in N and its torque about the centre of mass in N m, world axes.
    pub(crate) force: Vec3,
    pub(crate) torque: Vec3,
    /// Immersed volume in m^3.
    pub(crate) volume: f32,
    /// Mean velocity and vertical acceleration of the water about the immersed volume.
    pub(crate) velocity: Vec3,
    pub(crate) acceleration: f32,
    /// Mean slope of the surface over the immersed volume.
    pub(crate) slope: Vec2,
    /// Rotation about the centre of mass, rad/s, body axes, of the surface as the moving body meets it.
    pub(crate) spin: Vec3,
}

/// Where the body is within a tick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) position: Vec3,
    pub(crate) rotation: Mat3,
    /// Of the centre of mass, m/s.
    pub(crate) velocity: Vec3,
}

/// Sums buoyancy and the water's motion over the force points (relative to the centre of mass, body axes).
pub(crate) fn immerse(points: &[ForcePoint], waters: &[LocalWater], pose: &Pose, own: bool, density: f32) -> Wetness {
    let mut w = Wetness::default();
    let (mut turning, mut arm) = (Vec3::ZERO, Vec3::ZERO);
    let (mut place, mut stream) = (Vec3::ZERO, Vec3::ZERO);
    let up = pose.rotation.transpose();
    for (p, water) in points.iter().zip(waters) {
        let r = pose.rotation * p.position;
        let at = pose.position + r;
        let surface = water.ambient(Vec2::new(at.x, at.z)) + if own { water.own } else { 0.0 };
        let gradient = Vec3::new(-water.slope.x, 1.0, -water.slope.y);
        let depth = surface - at.y;
        let i = p.immersion(depth, up * gradient.normalize());
        if i.share <= 0.0 {
            continue;
        }
        let (pull, fade) = buoyancy(i.share, i.extent, depth, water);
        let direction = Vec3::new(gradient.x * fade, 1.0, gradient.z * fade) * (density * GRAVITY * p.volume);
        w.force += direction * pull;
        w.torque += r.cross(direction * pull) + (pose.rotation * i.moment).cross(direction * (pull / i.share));
        let volume = p.volume * i.share;
        w.volume += volume;
        w.velocity += water.velocity * (volume * fade);
        w.acceleration += water.acceleration * (volume * fade);
        w.slope += water.slope * volume;
        // A hull under way meets the surface rising with its slope as well as with the water.
        let through = pose.velocity - water.velocity;
        let rise = Vec3::Y * Vec2::new(through.x, through.z).dot(water.slope);
        let flow = up * (water.velocity + rise);
        turning += p.position.cross(flow) * volume;
        arm += Vec3::splat(p.position.length_squared()) * volume - p.position * p.position * volume;
        place += p.position * volume;
        stream += up * Vec3::new(water.velocity.x, pose.velocity.y, water.velocity.z) * volume;
    }
    if w.volume > 0.0 {
        w.velocity /= w.volume;
        w.acceleration /= w.volume;
        w.slope /= w.volume;
        // A uniform stream does not turn; water that rises under a bow does.
        let floor = Vec3::splat(1.0e-3 * 0.5 * (arm.x + arm.y + arm.z) + 1.0e-6 * w.volume);
        turning -= place.cross(stream) / w.volume;
        w.spin = (turning / arm.max(floor)).clamp_length_max(20.0);
    }
    w
}

/// Buoyancy of one piece as a share of `rho g V`, and the factor by which the wave's pressure has faded there.
///
/// Hydrostatic pressure acts along the surface normal, `rho g V (-dh/dx, 1, -dh/dz)` per immersed volume: bodies slide
/// down a wave's face. A wave's pressure fades as `exp(-k d)`, so that its height `h` over the still water counts in full
/// at the surface only:
/// the difference between bottom and top is `rho g h (exp(-k d_top) - exp(-k d_bottom))` less than hydrostatic (linear
/// wave theory).
pub(crate) fn buoyancy(share: f32, extent: f32, depth: f32, water: &LocalWater) -> (f32, f32) {
    let (top, bottom) = ((depth - extent).max(0.0), (depth + extent).max(0.0));
    if water.decay * bottom < 1.0e-3 {
        return (share, 1.0);
    }
    let (at_top, at_bottom) = (libm::expf(-water.decay * top), libm::expf(-water.decay * bottom));
    let lost = (water.height - water.level) * (at_top - at_bottom) / (2.0 * extent);
    ((share - lost).clamp(0.0, 1.5), 0.5 * (at_top + at_bottom))
}

/// The axes in which water resists a body: its own, but for a hull afloat the upward one is the surface's normal, so that
/// running along a wave's face is no heave. `blunt` bodies have no way to run and keep their own.
pub(crate) fn resistance_axes(rotation: Mat3, slope: Vec2, blunt: bool) -> Mat3 {
    let normal = Vec3::new(-slope.x, 1.0, -slope.y).normalize();
    if blunt || rotation.y_axis.dot(normal) < 0.7 {
        return rotation;
    }
    let side = rotation.x_axis.cross(normal).normalize_or(rotation.z_axis);
    Mat3::from_cols(normal.cross(side), normal, side)
}

/// Weight in N.
pub(crate) fn gravity(mass: f32) -> Vec3 {
    Vec3::new(0.0, -mass * GRAVITY, 0.0)
}

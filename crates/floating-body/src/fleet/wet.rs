//! Buoyancy of eight pieces on a plane of water each: what [`immerse`](crate::forces::immerse) sums, for planes.
//!
//! On a plane the depth of a point is linear in its place on the hull, so that nothing is turned into the world point by
//! point, and all sums are taken in the hull's axes.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::Vec3;

use super::lanes::{M3, Num, V3, asin, exp};
use super::template::{Group, Template};
use crate::PointShape;

/// The surface as a tick sees it.
#[derive(Clone, Copy)]
pub(super) struct Surface<S: Simd> {
    /// Where its height holds, x and z.
    pub(super) center: [Num<S>; 2],
    pub(super) height: Num<S>,
    /// Slope of what floats a piece.
    pub(super) gradient: [Num<S>; 2],
    /// Slope of the water as it is.
    pub(super) slope: [Num<S>; 2],
    pub(super) flow: V3<S>,
    pub(super) acceleration: Num<S>,
    pub(super) decay: Num<S>,
    /// Height of the wave without the home grid over the still water, and its slope.
    pub(super) wave: Num<S>,
    /// Height of the still water.
    pub(super) still: Num<S>,
    pub(super) ambient: [Num<S>; 2],
    /// Some wave's pressure decays within a piece.
    pub(super) fades: bool,
}

/// What the water does to a piece: see [`Wetness`](crate::forces::Wetness).
pub(super) struct Wet<S: Simd> {
    /// World axes.
    pub(super) force: V3<S>,
    /// Hull axes.
    pub(super) torque: V3<S>,
    pub(super) volume: Num<S>,
    /// Volume over which the water's motion counts: less where the wave has faded.
    pub(super) moved: Num<S>,
}

/// Sums over points, hull axes; volumes that push up and volumes that push along.
struct Sums<S: Simd> {
    volume: Num<S>,
    moved: Num<S>,
    up: Num<S>,
    along: Num<S>,
    /// First moment of the volumes that push up, along, and of all.
    up_at: V3<S>,
    along_at: V3<S>,
    at: V3<S>,
}

/// A number that is linear in the place on the hull.
struct Linear<S: Simd> {
    /// At the centre of mass.
    center: Num<S>,
    /// Its change along the hull's axes.
    change: V3<S>,
}

impl<S: Simd> Linear<S> {
    #[inline(always)]
    fn at(&self, place: Vec3) -> Num<S> {
        self.center + (self.change.x * place.x + self.change.y * place.y + self.change.z * place.z)
    }
}

/// The water over the hull.
struct Tilt<S: Simd> {
    depth: Linear<S>,
    /// Height of the wave.
    wave: Linear<S>,
}

/// What the points of a group share: where a shape's centre of volume goes as it turns.
struct Facing<S: Simd> {
    inverse_extent: Num<S>,
    extent: Num<S>,
    gradient: V3<S>,
    twist: V3<S>,
    standing: Num<S>,
    /// Of a wave from a wet point's bottom to its top.
    growth: Num<S>,
}

impl<S: Simd> Facing<S> {
    #[inline(always)]
    fn new(simd: S, group: &Group, normal: V3<S>, decay: Option<Num<S>>) -> Self {
        let half = V3::all(simd, group.half);
        let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
        let scaled = half * normal;
        let extent = scaled.dot(scaled).sqrt().max(f32x8::splat(simd, 1.0e-6));
        let inverse_extent = one / extent;
        let gradient = (half * scaled).scale(inverse_extent);
        let (mut twist, mut standing) = (V3::new(zero, zero, zero), zero);
        if group.shape == PointShape::DiscX {
            let lean = scaled.x * inverse_extent;
            standing = lean * lean;
            let along = V3::new(half.x * lean * 2.0, zero, zero);
            twist = along - gradient.scale(standing * 2.0);
        }
        let growth = match decay {
            // Farther a wave does not reach.
            Some(decay) => one / exp(simd, -(decay * extent * 2.0).min(f32x8::splat(simd, 40.0))),
            None => one,
        };
        Self { inverse_extent, extent, gradient, twist, standing, growth }
    }
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = f32x8::splat(simd, 0.0);
        let none = V3::new(zero, zero, zero);
        let (up_at, along_at, at) = (none, none, none);
        Self { volume: zero, moved: zero, up: zero, along: zero, up_at, along_at, at }
    }

    /// Adds the points of a group. Without `FADES` what pushes up, what pushes along and what is wet are the same.
    #[inline(always)]
    fn add<const FADES: bool>(&mut self, simd: S, group: &Group, facing: &Facing<S>, tilt: &Tilt<S>, decay: Num<S>) {
        let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
        // Sums of how much the centre of volume has moved along `gradient` and along `twist`.
        let (mut moment, mut twist) = ([zero; 2], [zero; 2]);
        for spot in &group.spots {
            let depth = tilt.depth.at(spot.at);
            let u = (depth * facing.inverse_extent).max(-one).min(one);
            let (share, shift, twisted) = part(simd, group.shape, facing.standing, u);
            let volume = share * spot.volume;
            let at = V3::all(simd, spot.at);
            self.volume += volume;
            if FADES {
                let (pull, fade) = faded(simd, share, facing, depth, tilt.wave.at(spot.at), decay);
                let up = pull * spot.volume;
                let along = up * fade;
                self.up += up;
                self.along += along;
                self.moved += volume * fade;
                self.up_at = self.up_at + at.scale(up);
                self.along_at = self.along_at + at.scale(along);
                moment[0] += shift * up;
                moment[1] += shift * along;
                twist[0] += twisted * up;
                twist[1] += twisted * along;
            } else {
                self.at = self.at + at.scale(volume);
                moment[0] += shift * volume;
                twist[0] += twisted * volume;
            }
        }
        if FADES {
            self.up_at = self.up_at - (facing.gradient.scale(moment[0]) + facing.twist.scale(twist[0]));
            self.along_at = self.along_at - (facing.gradient.scale(moment[1]) + facing.twist.scale(twist[1]));
        } else {
            self.up_at = self.up_at - (facing.gradient.scale(moment[0]) + facing.twist.scale(twist[0]));
        }
    }
}

/// Share under water of a piece whose centre is `u` half-extents deep, and how far the centre of what is wet has moved along
/// the facing's gradient and twist: `G - u G'` and what the two sections of a cylinder differ by, over the share.
#[inline(always)]
fn part<S: Simd>(simd: S, shape: PointShape, standing: Num<S>, u: Num<S>) -> (Num<S>, Num<S>, Num<S>) {
    let (zero, tiny) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0e-12));
    match shape {
        PointShape::Box => {
            let share = u * 0.5 + 0.5;
            (share, -share + 1.0, zero)
        }
        PointShape::Ball => {
            let u2 = u * u;
            let share = (u * 3.0 - u2 * u + 2.0) * 0.25;
            let whole = (u * 2.0 + u2 * 1.5 - u2 * u2 * 0.25) * 0.25 + 0.1875;
            (share, (whole - u * share) / share.max(tiny), zero)
        }
        PointShape::DiscX => {
            let inv_pi = std::f32::consts::FRAC_1_PI;
            let flat = (u * 0.5 + 0.5, (u + 1.0) * (u + 1.0) * 0.25);
            let (root, angle) = ((-(u * u) + 1.0).max(zero).sqrt(), asin(simd, u));
            let round = (
                (u * root + angle) * inv_pi + 0.5,
                u * 0.5 + (u * angle + root - root * root * root * (1.0 / 3.0)) * inv_pi,
            );
            let lying = -standing + 1.0;
            let share = standing * flat.0 + lying * round.0;
            let shift = standing * flat.1 + lying * round.1 - u * share;
            let inverse = f32x8::splat(simd, 1.0) / share.max(tiny);
            (share, shift * inverse, (flat.1 - round.1) * inverse)
        }
    }
}

/// As `buoyancy` of [`crate::forces`]: pull as a share, and how far the wave has faded.
#[inline(always)]
fn faded<S: Simd>(
    simd: S,
    share: Num<S>,
    facing: &Facing<S>,
    depth: Num<S>,
    wave: Num<S>,
    decay: Num<S>,
) -> (Num<S>, Num<S>) {
    let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
    let deep = decay * (depth + facing.extent).max(zero);
    let at_bottom = exp(simd, -deep);
    let at_top = depth.simd_gt(facing.extent).select((at_bottom * facing.growth).min(one), one);
    let lost = wave * (at_top - at_bottom) * (facing.inverse_extent * 0.5);
    let pull = (share - lost).max(zero).min(f32x8::splat(simd, 1.5));
    let shallow = deep.simd_lt(f32x8::splat(simd, 1.0e-3));
    let pull = share.simd_le(zero).select(zero, shallow.select(share, pull));
    (pull, shallow.select(one, (at_top + at_bottom) * 0.5))
}

/// What the water does at a pose.
#[inline(always)]
pub(super) fn immerse<S: Simd>(
    simd: S,
    template: &Template,
    surface: &Surface<S>,
    position: V3<S>,
    rotation: &M3<S>,
) -> Wet<S> {
    let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
    let [gx, gz] = surface.gradient;
    let [sx, sz] = surface.slope;
    let away = [position.x - surface.center[0], position.z - surface.center[1]];
    let [ax, az] = surface.ambient;
    let tilt = Tilt {
        depth: Linear {
            center: surface.height + (gx * away[0] + gz * away[1]) - position.y,
            change: rotation.back(V3::new(gx, -one, gz)),
        },
        wave: Linear {
            center: surface.wave + (ax * away[0] + az * away[1]),
            change: rotation.back(V3::new(ax, zero, az)),
        },
    };
    let steep = one / (sx * sx + sz * sz + 1.0).sqrt();
    let normal = rotation.back(V3::new(-(sx * steep), steep, -(sz * steep)));
    let mut sums = Sums::new(simd);
    for group in &template.groups {
        let facing = Facing::new(simd, group, normal, if surface.fades { Some(surface.decay) } else { None });
        if surface.fades {
            sums.add::<true>(simd, group, &facing, &tilt, surface.decay);
        } else {
            sums.add::<false>(simd, group, &facing, &tilt, surface.decay);
        }
    }
    if !surface.fades {
        (sums.up, sums.along, sums.moved) = (sums.volume, sums.volume, sums.volume);
        // Until here the shift of the centres alone.
        sums.up_at = sums.up_at + sums.at;
        sums.along_at = sums.up_at;
    }
    let force = V3::new(-(sx * sums.along), sums.up, -(sz * sums.along)).scale(f32x8::splat(simd, template.weight));
    // Up and along have levers of their own.
    let upright = V3::new(zero, one, zero);
    let level = V3::new(-sx, zero, -sz);
    let torque = sums.up_at.cross(rotation.back(upright)) + sums.along_at.cross(rotation.back(level));
    let torque = torque.scale(f32x8::splat(simd, template.weight));
    // The flow past the hull is the same everywhere on a plane: it does not turn.
    Wet { force, torque, volume: sums.volume, moved: sums.moved }
}

/// Volumes under the surface without the home grid, carried on by `time` s, at a pose.
#[inline(always)]
pub(super) fn displaced<S: Simd>(
    simd: S,
    template: &Template,
    surface: &Surface<S>,
    time: f32,
    position: V3<S>,
    rotation: &M3<S>,
) -> Num<S> {
    let one = f32x8::splat(simd, 1.0);
    let [ax, az] = surface.ambient;
    let [sx, sz] = surface.slope;
    let rise = (surface.flow.y - (sx * surface.flow.x + sz * surface.flow.z)) * time;
    let away = [position.x - surface.center[0], position.z - surface.center[1]];
    let depth = Linear {
        center: surface.still + surface.wave + rise + (ax * away[0] + az * away[1]) - position.y,
        change: rotation.back(V3::new(ax, -one, az)),
    };
    let steep = one / (sx * sx + sz * sz + 1.0).sqrt();
    let normal = rotation.back(V3::new(-(sx * steep), steep, -(sz * steep)));
    let mut volume = f32x8::splat(simd, 0.0);
    for group in &template.groups {
        let facing = Facing::new(simd, group, normal, None);
        for spot in &group.spots {
            let u = (depth.at(spot.at) * facing.inverse_extent).max(-one).min(one);
            volume += part(simd, group.shape, facing.standing, u).0 * spot.volume;
        }
    }
    // What goes on far below hardly moves the surface.
    let below = (depth.center - template.reach).max(f32x8::splat(simd, 0.0)) * (1.0 / template.reach);
    volume / (below * below + 1.0)
}

//! Slamming: water that a falling bottom catches, by von Karman's momentum (1929) with Wagner's pile-up (1932).
//!
//! As a wedge of deadrise `b` enters, water rises along it to `p = pi/2 - b (1 - 2/pi)` times its depth (Pierson), and moves
//! as a plate's added mass `pi/2 rho c^2 (1 - b/(2 pi))^2` of that half width c. What is newly wetted takes its share of
//! the momentum, point by point, as a perfectly inelastic blow: no energy comes of it, however long the step. Leaving the
//! water gives nothing back. No air cushion, no compressibility, no load on a bottom that is already wet.

use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, TAU};

use glam::{Vec2, Vec3};

use crate::error::check_range;
use crate::hull::Waterline;
use crate::{BodyError, ForcePoint};

/// How a bottom meets the water.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slamming {
    /// Mean angle of the bottom to the water, radians, 0 to 1.5.
    pub deadrise: f32,
}

/// Flattest bottom: a flat one meets rough water.
const FLATTEST: f32 = 0.05;

impl Slamming {
    /// The deadrise of a V bottom with this draft, beam and mean draft.
    pub(crate) fn estimate(w: &Waterline) -> Self {
        let mean = if w.area > 0.0 { w.volume / w.area } else { w.draft };
        let rise = 2.0 * (w.draft - mean).max(0.0);
        let half = 0.5 * w.extent.min_element();
        Self { deadrise: if half > 0.0 { libm::atanf(rise / half).min(1.5) } else { 0.0 } }
    }

    pub(crate) fn check(&self) -> Result<(), BodyError> {
        check_range("slamming.deadrise", self.deadrise, 0.0, 1.5, "in [0, 1.5] rad").map(drop)
    }

    /// Wagner's rise of the water over the depth of the keel.
    fn pile_up(&self) -> f32 {
        FRAC_PI_2 - self.deadrise * (1.0 - FRAC_2_PI)
    }
}

/// What a force point's bottom catches.
#[derive(Clone, Copy, Debug, Default)]
struct Catch {
    /// Which point.
    point: usize,
    /// Mass in kg when all of it is wet.
    mass: f32,
    /// It gets wet while its depth, times the pile-up, goes from `-ahead` to `range - ahead`, m.
    ahead: f32,
    range: f32,
    /// Share that is wet.
    wet: f32,
}

/// The bottoms of a body.
#[derive(Clone, Debug)]
pub(crate) struct Slam {
    pile_up: f32,
    bottoms: Vec<Catch>,
}

impl Slam {
    /// `points` are relative to the centre of mass; `finite` is how much of the two-dimensional mass a hull of this length
    /// keeps.
    pub(crate) fn new(slamming: &Slamming, points: &[ForcePoint], w: &Waterline, finite: f32, density: f32) -> Self {
        let beam_along_z = w.extent.x >= w.extent.y;
        let across = |v: Vec3| if beam_along_z { v.z } else { v.x };
        let bottom = |p: &ForcePoint| p.position.y - p.half.y;
        let volume: f32 = points.iter().map(|p| p.volume).sum();
        let middle = points.iter().map(|p| across(p.position) * p.volume).sum::<f32>() / volume;
        let pile_up = slamming.pile_up();
        let blunt = 1.0 - slamming.deadrise / TAU;
        let slope = libm::tanf(slamming.deadrise.max(FLATTEST));
        let out = |p: &ForcePoint| (across(p.position) - middle).abs().max(0.5 * across(p.half));
        // A column's bottom is the mean of what it stands on.
        let deepest = points.iter().min_by(|p, q| bottom(p).total_cmp(&bottom(q)));
        let keel = deepest.map_or(0.0, |p| bottom(p) - out(p) * slope);
        // What lies over another point has no bottom.
        let over = |p: &ForcePoint, q: &ForcePoint| {
            let apart = (p.position - q.position).abs();
            bottom(p) > bottom(q) + 0.5 * q.half.y && apart.x < 0.5 * p.half.x && apart.z < 0.5 * p.half.z
        };
        let bottoms =
            points.iter().enumerate().filter(|(_, p)| !points.iter().any(|q| over(p, q))).map(|(point, p)| {
                let out = out(p);
                // A column's own area: few rays make its extents too small.
                let area = p.volume / (2.0 * p.half.y);
                let mass = FRAC_PI_2 * density * out * area * blunt * blunt * finite;
                let range = 2.0 * across(p.half) * slope;
                let ahead = (pile_up - 1.0) * (bottom(p) - keel).min(out * slope) + 0.5 * range;
                Catch { point, mass, ahead, range, wet: 1.0 }
            });
        Self { pile_up, bottoms: bottoms.collect() }
    }

    /// Share of each bottom that is wet.
    pub(crate) fn wet(&self) -> impl Iterator<Item = f32> + '_ {
        self.bottoms.iter().map(|bottom| bottom.wet)
    }

    pub(crate) fn set_wet(&mut self, wet: &[f32]) {
        self.bottoms.iter_mut().zip(wet).for_each(|(bottom, wet)| bottom.wet = *wet);
    }

    /// Calls `caught(point, mass, place)` with what each bottom catches anew, kg, and its place in the hull's frame about the
    /// centre of mass. `depth(point)` is that of a bottom's middle under the surface, `lean(point)` the surface's normal in
    /// hull axes. With `quiet` they are wet as they are.
    pub(crate) fn catch(
        &mut self,
        points: &[ForcePoint],
        lean: impl Fn(usize) -> Vec3,
        depth: impl Fn(usize) -> f32,
        quiet: bool,
        mut caught: impl FnMut(usize, f32, Vec3),
    ) {
        for bottom in &mut self.bottoms {
            let (p, lean) = (&points[bottom.point], lean(bottom.point));
            let tilt = 2.0 * Vec2::new(p.half.x, p.half.z).dot(Vec2::new(lean.x, lean.z).abs());
            let range = (bottom.range + tilt).max(1.0e-4);
            let wet = ((self.pile_up * depth(bottom.point) + bottom.ahead) / range).clamp(0.0, 1.0);
            let more = wet - bottom.wet;
            bottom.wet = wet;
            if more > 0.0 && !quiet {
                caught(bottom.point, bottom.mass * more, p.position - Vec3::Y * p.half.y);
            }
        }
    }
}

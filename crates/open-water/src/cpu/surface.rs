//! The composite surface on the CPU: the twin of `wgsl/shared/surface.wgsl`.
//!
//! Answers from the state after the last tick. Bodies see it through `body_water.rs`.

use floating_body::{SurfacePatch, Touch};
use glam::{Vec2, Vec3};
use ocean_spectrum::{Ocean, OceanPatch, OceanSample};
use wave_grid::GridSample;

use crate::grids::{Grid, Grids};
use crate::land::Shore;

/// Points answered at a time, on the stack.
pub(super) const BATCH: usize = 32;
/// Waves below this height, metres, are calm.
const CALM: f32 = 2e-3;

/// The water at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaterSample {
    /// Height, metres.
    pub height: f32,
    /// Unit normal, upwards.
    pub normal: Vec3,
    /// Velocity of the water at the surface, m/s.
    pub velocity: Vec3,
    /// Whether the surface folds over itself there, so that the answer is one of several.
    pub folded: bool,
    /// Whether there is water: false on dry land and where the land says so.
    pub wet: bool,
    /// How long ago the heights were known from which it was carried on to the last tick, seconds: 0 for the ambient sea and
    /// grids homed on the CPU, some frames for one homed on the GPU.
    pub age: f32,
    /// Standard deviation of the height that is to be expected of that, metres: 0 with them, infinite in the first frames
    /// of waves on the GPU, of which nothing is known yet.
    pub error: f32,
}

impl Default for WaterSample {
    /// Calm water.
    fn default() -> Self {
        Self { height: 0.0, normal: Vec3::Y, velocity: Vec3::ZERO, folded: false, wet: true, age: 0.0, error: 0.0 }
    }
}

/// Height of the water that a body finds where there is none: far below everything.
pub(super) const NO_WATER: f32 = -1000.0;

/// What all waters are made of, as one state.
#[derive(Clone, Copy)]
pub(crate) struct Composite<'a> {
    pub(crate) ocean: Option<&'a Ocean>,
    pub(crate) grids: &'a Grids,
    pub(crate) shore: &'a Shore,
    /// Velocity 10 m above the water, m/s.
    pub(crate) wind: Vec2,
}

impl Composite<'_> {
    pub(super) fn ambient(&self, points: &[Vec2], out: &mut [OceanSample]) {
        match self.ocean {
            Some(ocean) => ocean.sample(points, out),
            None => out.fill(OceanSample::default()),
        }
    }

    /// The water at local positions (x, z); as many answers as the shorter slice holds.
    pub(crate) fn surface_at(&self, points: &[Vec2], out: &mut [WaterSample]) {
        for (points, out) in points.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let n = points.len().min(out.len());
            let points = &points[..n];
            let mut ambient = [OceanSample::default(); BATCH];
            self.ambient(points, &mut ambient[..n]);
            let mut sum = [GridSample::default(); BATCH];
            for grid in self.grids.iter() {
                add(grid, points, 1.0, &mut sum[..n]);
            }
            for (((out, a), g), point) in out.iter_mut().zip(&ambient).zip(&sum[..n]).zip(points) {
                let [age, error] = self.grids.doubt(*point);
                *out = WaterSample {
                    height: self.shore.level + a.height + g.height,
                    normal: tilt(a.normal, g.slope),
                    velocity: a.velocity + Vec3::Y * g.vertical_velocity,
                    folded: a.folded,
                    wet: !self.shore.is_dry(*point),
                    age,
                    error,
                };
            }
        }
    }
}

impl Composite<'_> {
    /// The water under bodies of one radius, given what of the grids' waves is others' and own. At most [`BATCH`].
    pub(super) fn patches(
        &self,
        centers: &[Vec2],
        radius: f32,
        (others, own): (&[GridSample], &[GridSample]),
        out: &mut [SurfacePatch],
    ) {
        let level = self.shore.level;
        let mut ambient = [OceanPatch::default(); BATCH];
        if let Some(ocean) = self.ocean {
            ocean.patches(centers, &[radius; BATCH], &mut ambient);
        }
        for (i, (center, out)) in centers.iter().zip(out).enumerate() {
            let (a, others, own) = (&ambient[i], &others[i], &own[i]);
            *out = SurfacePatch {
                height: level + a.height + others.height,
                level,
                gradient: a.gradient + others.slope,
                own: own.height,
                // What a body displaces is measured with this slope: it must hold none of its own waves.
                own_gradient: Vec2::ZERO,
                velocity: a.velocity + Vec3::Y * others.vertical_velocity,
                acceleration: a.vertical_acceleration,
                decay_wavenumber: a.decay_wavenumber,
            };
            if self.shore.is_kept_dry(*center) {
                *out = SurfacePatch { height: NO_WATER, level: NO_WATER, ..SurfacePatch::default() };
            }
        }
    }

    /// Whether there is next to no wave between two corners, now and after the next tick, and the level stands still.
    pub(super) fn is_calm(&self, low: Vec2, high: Vec2) -> bool {
        self.shore.stands()
            && self.grids.iter().all(|grid| grid.largest_within(low, high) < CALM)
            && self.ocean.is_none_or(|ocean| ocean.significant_height_within(low, high) < CALM)
    }

    /// What is solid at points.
    pub(super) fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        self.shore.touch(points, out)
    }
}

/// Adds a share of a grid's waves.
pub(super) fn add(grid: &Grid, points: &[Vec2], share: f32, sum: &mut [GridSample]) {
    let mut one = [GridSample::default(); BATCH];
    let one = &mut one[..points.len()];
    grid.sample(points, one);
    for (sum, one) in sum.iter_mut().zip(one) {
        sum.height += share * one.height;
        sum.slope += share * one.slope;
        sum.vertical_velocity += share * one.vertical_velocity;
    }
}

/// Adds a slope to a surface with this normal.
pub(super) fn tilt(normal: Vec3, slope: Vec2) -> Vec3 {
    if slope == Vec2::ZERO {
        return normal;
    }
    let up = normal.y.max(1e-3);
    Vec3::new(normal.x / up - slope.x, 1.0, normal.z / up - slope.y).normalize()
}

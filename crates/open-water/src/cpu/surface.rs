//! The composite surface on the CPU: the twin of `wgsl/shared/surface.wgsl`.
//!
//! Answers from the state after the last tick. Bodies see it through [`BodyWater`], which knows which grid is the
//! body's own.

use floating_body::{Home, SurfacePatch, SurfaceSample, WaterSurface};
use glam::{Vec2, Vec3};
use ocean_spectrum::{Ocean, OceanSample};
use wave_grid::{GridSample, Pattern};

use crate::bodies::carries;
use crate::grids::{Grid, Grids, Sim};
use crate::handover::Homes;
use crate::land::Shore;
use crate::store::BodyId;

/// Points answered at a time, on the stack.
const BATCH: usize = 32;

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
}

impl Default for WaterSample {
    /// Calm water.
    fn default() -> Self {
        Self { height: 0.0, normal: Vec3::Y, velocity: Vec3::ZERO, folded: false, wet: true }
    }
}

/// Height of the water that a body finds where there is none: far below everything.
const NO_WATER: f32 = -1000.0;

/// What all waters are made of, as one state.
#[derive(Clone, Copy)]
pub(crate) struct Composite<'a> {
    pub(crate) ocean: Option<&'a Ocean>,
    pub(crate) grids: &'a Grids,
    pub(crate) shore: &'a Shore,
}

impl Composite<'_> {
    fn ambient(&self, points: &[Vec2], out: &mut [OceanSample]) {
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
                *out = WaterSample {
                    height: self.shore.level + a.height + g.height,
                    normal: tilt(a.normal, g.slope),
                    velocity: a.velocity + Vec3::Y * g.vertical_velocity,
                    folded: a.folded,
                    wet: !self.shore.is_dry(*point),
                };
            }
        }
    }
}

/// Adds a share of a grid's waves.
fn add(grid: &Grid, points: &[Vec2], share: f32, sum: &mut [GridSample]) {
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
fn tilt(normal: Vec3, slope: Vec2) -> Vec3 {
    if slope == Vec2::ZERO {
        return normal;
    }
    let up = normal.y.max(1e-3);
    Vec3::new(normal.x / up - slope.x, 1.0, normal.z / up - slope.y).normalize()
}

/// The water as one body sees it.
pub(crate) struct BodyWater<'a> {
    pub(crate) water: Composite<'a>,
    pub(crate) body: BodyId,
    /// The grid that the body disturbs, and what else holds its waves. They go into `own` and nowhere else: what the body
    /// displaces is measured against everything else, and would grow if any of its own waves were in there.
    pub(crate) homes: &'a Homes,
    /// The body feels its own waves.
    pub(crate) by_grid: bool,
    /// Its textures, as the home grid writes and reads them.
    pub(crate) pattern: Option<&'a Pattern>,
}

impl BodyWater<'_> {
    /// A body that makes no waves has none of its own to tell apart.
    fn others_and_own(&self, points: &[Vec2], others: &mut [GridSample], own: &mut [GridSample]) {
        for grid in self.water.grids.iter() {
            let share = self.homes.share(grid);
            if share == 0.0 || share == 1.0 {
                add(grid, points, 1.0, if share == 1.0 { &mut *own } else { &mut *others });
            } else {
                add(grid, points, share, own);
                add(grid, points, 1.0 - share, others);
            }
        }
    }
}

impl WaterSurface for BodyWater<'_> {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (points, out) in points.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let n = points.len().min(out.len());
            let points = &points[..n];
            let mut ambient = [OceanSample::default(); BATCH];
            self.water.ambient(points, &mut ambient[..n]);
            let mut others = [GridSample::default(); BATCH];
            let mut own = [GridSample::default(); BATCH];
            self.others_and_own(points, &mut others[..n], &mut own[..n]);
            let k = self.water.ocean.map_or(0.0, Ocean::peak_wavenumber);
            let level = self.water.shore.level;
            for (i, out) in out[..n].iter_mut().enumerate() {
                let (a, g) = (&ambient[i], &others[i]);
                if self.water.shore.is_kept_dry(points[i]) {
                    *out = SurfaceSample { height: NO_WATER, level: NO_WATER, ..SurfaceSample::CALM };
                    continue;
                }
                *out = SurfaceSample {
                    height: level + a.height + g.height,
                    level,
                    own: own[i].height,
                    normal: tilt(a.normal, g.slope),
                    velocity: a.velocity + Vec3::Y * g.vertical_velocity,
                    acceleration: a.vertical_acceleration,
                    decay_wavenumber: k,
                };
            }
        }
    }

    fn home(&self) -> Home {
        let grid = self.homes.now().and_then(|home| self.water.grids.get(home).ok());
        match grid {
            Some(grid) if grid.follows(self.body) => Home::Own,
            Some(_) => Home::Shared,
            // The waves it left behind are felt on as they were.
            None if self.by_grid && self.homes.any() => Home::Shared,
            None => Home::None,
        }
    }

    fn radiated(&self, at: Vec2, heading: f32) -> Option<[f32; 3]> {
        let grid = self.homes.now().and_then(|home| self.water.grids.get(home).ok())?;
        match &grid.sim {
            Sim::Cpu(sim) if carries(grid).is_some() => {
                let [heave, roll, pitch, _] = sim.read_pattern(self.pattern?, at, heading);
                Some([heave, roll, pitch])
            }
            _ => None,
        }
    }

    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        if self.water.shore.is_kept_dry(center) {
            return SurfacePatch { height: NO_WATER, level: NO_WATER, ..SurfacePatch::default() };
        }
        let level = self.water.shore.level;
        let a = self.water.ocean.map_or_else(Default::default, |ocean| ocean.patch(center, radius));
        let mut others = [GridSample::default()];
        let mut own = [GridSample::default()];
        self.others_and_own(&[center], &mut others, &mut own);
        SurfacePatch {
            height: level + a.height + others[0].height,
            level,
            gradient: a.gradient + others[0].slope,
            own: own[0].height,
            // What a body displaces is measured with this slope: it must hold none of its own waves.
            own_gradient: Vec2::ZERO,
            velocity: a.velocity + Vec3::Y * others[0].vertical_velocity,
            acceleration: a.vertical_acceleration,
            decay_wavenumber: a.decay_wavenumber,
        }
    }
}

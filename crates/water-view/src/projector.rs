//! Which part of the mean plane the grid covers.
//!
//! A projected grid (Johanson 2004) whose projector is a level cylinder: rays of equal azimuth steps, rows at equal
//! ratios of distance. Columns and rows sit on absolute ladders, so turning the camera moves no vertex and a step
//! forward moves each by less than a spacing. The projector stands behind the camera by a few wave heights, so that
//! waves that reach the camera from beside or behind the picture are still on the grid.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::camera::Rays;

/// Placement of the grid for one view; the fields of the same name in `ViewFrame`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Projector {
    pub(crate) pole: Vec2,
    pub(crate) far: f32,
    pub(crate) row_step: f32,
    pub(crate) first_row: i32,
    pub(crate) turn: u32,
    pub(crate) first_column: u32,
    pub(crate) closed: bool,
}

/// Distance at which the sea has become the horizon: the gap left above it is less than a tenth of a milliradian
/// from a ship's bridge.
fn horizon(eye_height: f32) -> f32 {
    (eye_height.abs() * 6000.0).clamp(20_000.0, 200_000.0)
}

/// Corners of the visible part of the slab `|y| <= reach`, seen from above, relative to the eye.
fn footprint(rays: &Rays, reach: f32, far: f32) -> Vec<Vec2> {
    let eye = rays.eye.y;
    let ends = rays.corners().map(|ray| ray * far);
    let mut points = Vec::with_capacity(24);
    let inside = |p: Vec3| (eye + p.y).abs() <= reach;
    let flat = |p: Vec3| Vec2::new(p.x, p.z);
    points.extend(std::iter::once(Vec3::ZERO).chain(ends).filter(|p| inside(*p)).map(flat));
    for i in 0..4 {
        for (a, b) in [(Vec3::ZERO, ends[i]), (ends[i], ends[(i + 1) % 4])] {
            for level in [-reach, reach] {
                let t = (level - eye - a.y) / (b.y - a.y);
                if t > 0.0 && t < 1.0 {
                    points.push(flat(a.lerp(b, t)));
                }
            }
        }
    }
    points
}

/// Distance from the origin to the segment a-b.
fn segment_distance(a: Vec2, b: Vec2) -> f32 {
    let d = b - a;
    let t = (-a.dot(d) / d.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (a + t * d).length()
}

/// The smallest power of 2^(1/8) not below `x`: steps stay put while the camera moves a little.
fn ladder(x: f32) -> f32 {
    ((8.0 * x.log2()).ceil() / 8.0).exp2()
}

impl Projector {
    /// `reach`: how far waves move the surface, up, down or sideways, metres. `None` when no water is in view.
    pub(crate) fn place(rays: &Rays, reach: f32, columns: u32, rows: u32) -> Option<Self> {
        let far = horizon(rays.eye.y);
        let points = footprint(rays, reach, far);
        if points.is_empty() {
            return None;
        }
        let ahead = rays.center.normalize();
        let back = Vec2::new(ahead.x, ahead.z) * (3.0 * reach + 0.5 * (rays.eye.y.abs() - reach).max(0.0));
        let pole = Vec2::new(rays.eye.x, rays.eye.z) - back;
        let points: Vec<Vec2> = points.iter().map(|p| *p + back).collect();
        let nearest = points
            .iter()
            .enumerate()
            .flat_map(|(i, a)| points[i..].iter().map(move |b| segment_distance(*a, *b)))
            .fold(f32::INFINITY, f32::min);
        let mut angles: Vec<f32> = points.iter().map(|p| p.y.atan2(p.x)).collect();
        angles.sort_by(f32::total_cmp);
        // The widest gap between neighbouring directions is what is out of sight.
        let (gap, after) = (0..angles.len())
            .map(|i| {
                let next = angles[(i + 1) % angles.len()];
                let wrap = if i + 1 == angles.len() { TAU } else { 0.0 };
                (next + wrap - angles[i], next)
            })
            .fold((0.0, 0.0), |best, g| if g.0 > best.0 { g } else { best });
        let around = gap <= 0.5 * TAU || nearest <= 1.05 * reach;
        let near = (nearest - reach).max(0.02 * far.min(reach + rays.eye.y.abs()).max(1.0));
        let widen = (reach / nearest.max(reach)).asin();
        let range = TAU - gap + 2.0 * widen;
        let closed = around || range >= 0.95 * TAU;
        let row_step = ladder((far * 1.01 / near).ln() / (rows - 2) as f32);
        let first_row = (near.ln() / row_step).floor() as i32;
        let (turn, first_column) = if closed {
            (columns, 0)
        } else {
            let step = ladder(range / (columns - 2) as f32);
            let turn = ((TAU / step) as u32).max(columns);
            let column = ((after - widen).rem_euclid(TAU) / (TAU / turn as f32)) as u32;
            (turn, column % turn)
        };
        Some(Self { pole, far, row_step, first_row, turn, first_column, closed })
    }
}

#[cfg(test)]
#[path = "projector_tests.rs"]
mod tests;

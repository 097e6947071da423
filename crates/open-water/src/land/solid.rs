//! What bodies touch: the bed as its raster has it, and obstacles as upright walls without a top.

use floating_body::Touch;
use glam::{DVec2, Vec2, Vec3};

use super::{DepthMap, Terrain};

/// Solids farther than this are not told of, metres: no body gets there in a tick.
const REACH: f32 = 2.0;

impl DepthMap {
    /// Elevation of the bed at a world place and its slope along x and z; level outside the raster.
    fn plane(&self, place: DVec2) -> (f32, Vec2) {
        let step = 0.5 * f64::from(self.texel());
        let at = |x: f64, z: f64| self.elevation(place + DVec2::new(x, z));
        let slope = Vec2::new(at(step, 0.0) - at(-step, 0.0), at(0.0, step) - at(0.0, -step)) / self.texel();
        (self.elevation(place), slope)
    }
}

impl Terrain {
    /// What is solid at points (x and z from `origin` in the world, y above the datum). Returns whether anything is near.
    pub(crate) fn touch(&self, origin: DVec2, points: &[Vec3], out: &mut [Touch]) -> bool {
        let (low, high) =
            points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let flat = |v: Vec3, by: f32| origin + DVec2::new((v.x + by).into(), (v.z + by).into());
        let (from, to) = (flat(low, -REACH), flat(high, REACH));
        let by_bed = low.y - REACH < self.bed().highest(from, to);
        let by_wall = self.walls().any(|wall| wall.may_touch(from, to));
        if !(by_bed || by_wall) {
            return false;
        }
        let mut near = false;
        for (point, out) in points.iter().zip(out) {
            *out = Touch::NONE;
            let place = origin + DVec2::new(point.x.into(), point.z.into());
            if by_bed {
                let (elevation, slope) = self.bed().plane(place);
                let normal = Vec3::new(-slope.x, 1.0, -slope.y).normalize();
                *out = Touch { depth: (elevation - point.y) * normal.y, normal };
            }
            for wall in self.walls().filter(|_| by_wall) {
                // The deepest counts, but of a wall and the ground beneath it the wall.
                if let Some((depth, way)) = wall.depth(place, REACH.into())
                    && (depth as f32 > out.depth || depth > 0.0)
                {
                    *out = Touch { depth: depth as f32, normal: Vec3::new(way.x as f32, 0.0, way.y as f32) };
                }
            }
            near |= out.depth > -REACH;
        }
        near
    }
}

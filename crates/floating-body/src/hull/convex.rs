//! The convex hull of a point set, by adding points one at a time (f64).
//!
//! The worst case is points times faces; meshes as hulls use it at load time only. Written here rather than taken from
//! parry3d because its hull asserts on nearly coplanar points, and a bad mesh must give an error, not a panic.

use std::collections::HashMap;

use glam::DVec3;

use super::topology::Surface;
use crate::BodyError;

/// Points are moved by up to this share of the bounding box's diagonal while the faces are found. Then no four lie in one
/// plane, which is what breaks such algorithms on hulls with flat sides; the corners returned are the original ones.
const JITTER_SHARE: f64 = 1.0e-6;

struct Face {
    corners: [u32; 3],
    normal: DVec3,
    offset: f64,
}

impl Face {
    fn new(corners: [u32; 3], points: &[DVec3]) -> Self {
        let [a, b, c] = corners.map(|i| points[i as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self { corners, normal, offset: normal.dot(a) }
    }

    fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// The hull's surface, wound outwards, with the points that are its corners.
pub(crate) fn convex_hull(original: &[DVec3]) -> Result<Surface, BodyError> {
    let flat = || BodyError::ConvexHull { reason: "the points lie in one plane, on one line or in one spot".into() };
    let first = simplex(original).ok_or_else(flat)?;
    let jittered = jitter(original);
    let points = jittered.as_slice();
    let inside = first.iter().map(|i| points[*i as usize]).sum::<DVec3>() / 4.0;
    let mut faces: Vec<Face> = Vec::new();
    for skip in 0..4 {
        let mut c = [first[(skip + 1) % 4], first[(skip + 2) % 4], first[(skip + 3) % 4]];
        if Face::new(c, points).distance(inside) > 0.0 {
            c.swap(1, 2);
        }
        faces.push(Face::new(c, points));
    }
    let mut horizon: HashMap<(u32, u32), ()> = HashMap::new();
    for (index, point) in points.iter().enumerate() {
        if first.contains(&(index as u32)) {
            continue;
        }
        horizon.clear();
        for face in faces.iter().filter(|f| f.distance(*point) > 0.0) {
            let [a, b, c] = face.corners;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                // An edge between two visible faces is met once in each direction and drops out.
                if horizon.remove(&(to, from)).is_none() {
                    horizon.insert((from, to), ());
                }
            }
        }
        if horizon.is_empty() {
            continue;
        }
        faces.retain(|f| f.distance(*point) <= 0.0);
        let mut rim: Vec<(u32, u32)> = horizon.keys().copied().collect();
        rim.sort_unstable();
        faces.extend(rim.iter().map(|(from, to)| Face::new([*from, *to, index as u32], points)));
    }
    Ok(compact(&faces, original))
}

/// The points, each moved by its own small random vector (splitmix64 of its number).
fn jitter(points: &[DVec3]) -> Vec<DVec3> {
    let size = diagonal(points) * JITTER_SHARE;
    let random = |n: u64| {
        let mut z = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let moved = |(i, p): (usize, &DVec3)| {
        let n = 3 * i as u64 + 1;
        *p + DVec3::new(random(n), random(n + 1), random(n + 2)) * size
    };
    points.iter().enumerate().map(moved).collect()
}

fn diagonal(points: &[DVec3]) -> f64 {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    (high - low).length()
}

/// Four points far apart: the ends of the longest axis, the farthest from their line, the farthest from that plane.
fn simplex(points: &[DVec3]) -> Option<[u32; 4]> {
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        let best = (0..points.len()).max_by(|a, b| measure(points[*a]).total_cmp(&measure(points[*b])))?;
        Some((best, measure(points[best])))
    };
    let size = diagonal(points);
    let (a, _) = farthest(&|p| -p.x - p.y * 1.0e-3 - p.z * 1.0e-6)?;
    let (b, far) = farthest(&|p| p.distance(points[a]))?;
    let line = (points[b] - points[a]).normalize_or_zero();
    let (c, wide) = farthest(&|p| (p - points[a]).cross(line).length())?;
    let normal = (points[b] - points[a]).cross(points[c] - points[a]).normalize_or_zero();
    let (d, high) = farthest(&|p| (p - points[a]).dot(normal).abs())?;
    let proper = far > 0.0 && wide > 1.0e-6 * size && high > 1.0e-6 * size;
    proper.then_some([a as u32, b as u32, c as u32, d as u32])
}

fn compact(faces: &[Face], points: &[DVec3]) -> Surface {
    let mut renumbered: HashMap<u32, u32> = HashMap::new();
    let mut surface = Surface::default();
    for face in faces {
        surface.triangles.push(face.corners.map(|old| {
            *renumbered.entry(old).or_insert_with(|| {
                surface.vertices.push(points[old as usize]);
                surface.vertices.len() as u32 - 1
            })
        }));
    }
    surface
}

//! Simple polygons in the world's plane.

use glam::DVec2;

use crate::OpenWaterError;

/// An outline with its bounding box.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polygon {
    corners: Vec<DVec2>,
    low: DVec2,
    high: DVec2,
}

impl Polygon {
    pub(crate) fn new(field: &'static str, corners: &[DVec2]) -> Result<Self, OpenWaterError> {
        if corners.len() < 3 {
            let value = corners.len() as f64;
            return Err(OpenWaterError::InvalidValue { field, value, bound: "an outline of 3 corners or more" });
        }
        for corner in corners.iter().flat_map(|c| c.to_array()) {
            if corner.is_nan() || corner.abs() > 1e9 {
                return Err(OpenWaterError::InvalidValue { field, value: corner, bound: "corners within 10^9 m" });
            }
        }
        let low = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = corners.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        Ok(Self { corners: corners.to_vec(), low, high })
    }

    /// Whether its bounding box touches a rectangle.
    pub(crate) fn may_touch(&self, low: DVec2, high: DVec2) -> bool {
        self.low.cmple(high).all() && self.high.cmpge(low).all()
    }

    /// Whether a place is inside, by the even-odd rule.
    pub(crate) fn contains(&self, p: DVec2) -> bool {
        if !self.may_touch(p, p) {
            return false;
        }
        let mut inside = false;
        for (a, b) in self.edges() {
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
        inside
    }

    /// Distance of a place from the outline, metres; 0 inside. Places farther than `reach` from the bounding box are
    /// told to be at `reach`.
    #[cfg(any(feature = "gpu", test))]
    pub(crate) fn distance(&self, p: DVec2, reach: f64) -> f64 {
        if !self.may_touch(p - reach, p + reach) {
            return reach;
        }
        if self.contains(p) { 0.0 } else { self.nearest(p).distance(p).min(reach) }
    }

    /// The place of the outline that is nearest.
    fn nearest(&self, p: DVec2) -> DVec2 {
        let on_edge = |(a, b): (DVec2, DVec2)| {
            let along = b - a;
            a + ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0) * along
        };
        let nearer = |best: DVec2, at: DVec2| if at.distance_squared(p) < best.distance_squared(p) { at } else { best };
        self.edges().map(on_edge).fold(DVec2::INFINITY, nearer)
    }

    /// How far a place is inside, metres, negative outside, and the way out; `None` farther than `reach` outside.
    pub(crate) fn depth(&self, p: DVec2, reach: f64) -> Option<(f64, DVec2)> {
        if !self.may_touch(p - reach, p + reach) {
            return None;
        }
        let (inside, to_edge) = (self.contains(p), self.nearest(p) - p);
        let distance = to_edge.length();
        if !inside && distance > reach {
            return None;
        }
        // On the edge itself there is no way to tell.
        let way = to_edge.try_normalize().unwrap_or(DVec2::X);
        Some(if inside { (distance, way) } else { (-distance, -way) })
    }

    fn edges(&self) -> impl Iterator<Item = (DVec2, DVec2)> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().copied().zip(next.copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_and_distance() {
        let l: Vec<DVec2> =
            [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]].map(DVec2::from_array).to_vec();
        let polygon = Polygon::new("outline", &l).unwrap();
        assert!(polygon.contains(DVec2::new(0.5, 3.5)) && polygon.contains(DVec2::new(3.5, 0.5)));
        assert!(!polygon.contains(DVec2::new(2.0, 2.0)) && !polygon.contains(DVec2::new(-0.1, 0.5)));
        assert!((polygon.distance(DVec2::new(2.0, 3.0), 9.0) - 1.0).abs() < 1e-12);
        assert!((polygon.distance(DVec2::new(5.0, 2.0), 9.0) - 2f64.sqrt()).abs() < 1e-12);
        assert_eq!(polygon.distance(DVec2::new(3.0, 0.5), 9.0), 0.0);
        assert_eq!(polygon.distance(DVec2::new(30.0, 0.5), 9.0), 9.0);
        // In the bay of a U, with two walls to the right.
        let u = [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [4.0, 4.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];
        let bay = Polygon::new("outline", &u.map(DVec2::from_array)).unwrap();
        assert!(!bay.contains(DVec2::new(3.0, 3.0)) && bay.contains(DVec2::new(1.0, 3.0)));
        let (depth, way) = polygon.depth(DVec2::new(0.3, 2.0), 1.0).unwrap();
        assert!((depth - 0.3).abs() < 1e-12 && way.distance(DVec2::NEG_X) < 1e-12);
        let (depth, way) = polygon.depth(DVec2::new(1.5, 2.0), 1.0).unwrap();
        assert!((depth + 0.5).abs() < 1e-12 && way.distance(DVec2::X) < 1e-12);
        assert!(polygon.depth(DVec2::new(2.5, 3.0), 1.0).is_none() && polygon.depth(DVec2::NAN, 1.0).is_none());
        assert!(Polygon::new("outline", &l[..2]).is_err());
        assert!(Polygon::new("outline", &[DVec2::NAN; 3]).is_err());
    }
}

//! Where a hull floats upright, and what the plane of floatation looks like.

use glam::{DVec2, Vec2, Vec3};

use super::spans::{RAYS, Span};

/// Upright floatation of a hull at a given displaced volume, in the hull's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waterline {
    /// Height y of the water in m.
    pub level: f32,
    /// Depth of the lowest point in m.
    pub draft: f32,
    /// Displaced volume in m^3.
    pub volume: f32,
    /// Area of the waterplane in m^2.
    pub area: f32,
    /// Length (x) and beam (z) of the waterplane in m.
    pub extent: Vec2,
    /// Centre of the waterplane (x, z) in m.
    pub center: Vec2,
    /// Second moments of the waterplane about its centre in m^4: of x^2 (pitch) and of z^2 (roll).
    pub moments: Vec2,
    /// Centre of buoyancy in m.
    pub center_of_buoyancy: Vec3,
    /// Immersed areas in m^2 seen along x (frontal) and along z (lateral).
    pub profile: Vec2,
    /// Where the lateral area's centre lies along x, in m.
    pub lateral_center: f32,
}

impl Waterline {
    /// Metacentric heights (roll, pitch) in m for a centre of mass at height `y` (hull frame): `KB + BM - KG`.
    pub fn metacentric_heights(&self, y: f32) -> Vec2 {
        let below = self.center_of_buoyancy.y - y;
        Vec2::new(self.moments.y, self.moments.x) / self.volume + Vec2::splat(below)
    }
}

fn volume_at(spans: &[Span], level: f64) -> f64 {
    spans.iter().map(|s| s.area * s.wet(level)).sum()
}

/// The level at which `spans` displace `volume`, by bisection; the top if they cannot.
pub(crate) fn level_for(spans: &[Span], volume: f64) -> f64 {
    let mut low = spans.iter().map(|s| s.bottom).fold(f64::INFINITY, f64::min);
    let mut high = spans.iter().map(|s| s.top).fold(f64::NEG_INFINITY, f64::max);
    for _ in 0..60 {
        let middle = (low + high) * 0.5;
        if volume_at(spans, middle) < volume { low = middle } else { high = middle }
    }
    (low + high) * 0.5
}

pub(crate) fn waterline(spans: &[Span], volume: f64) -> Waterline {
    let level = level_for(spans, volume);
    let crossing = || spans.iter().filter(|s| s.bottom < level && s.top >= level);
    let area: f64 = crossing().map(|s| s.area).sum();
    let first: DVec2 = crossing().map(|s| s.at * s.area).sum();
    let center = if area > 0.0 { first / area } else { DVec2::ZERO };
    let moments: DVec2 = crossing().map(|s| (s.at - center) * (s.at - center) * s.area).sum();
    let wet = || spans.iter().filter(|s| s.wet(level) > 0.0);
    let immersed = volume_at(spans, level).max(1.0e-12);
    let horizontal: DVec2 = wet().map(|s| s.at * (s.area * s.wet(level))).sum::<DVec2>() / immersed;
    let height: f64 = wet().map(|s| s.area * s.wet(level) * (s.bottom + s.wet(level) * 0.5)).sum::<f64>() / immersed;
    let (mut deepest_x, mut deepest_z) = (vec![0.0_f64; RAYS[0]], vec![0.0_f64; RAYS[1]]);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for s in wet() {
        deepest_x[s.ray[0]] = deepest_x[s.ray[0]].max(s.wet(level));
        deepest_z[s.ray[1]] = deepest_z[s.ray[1]].max(s.wet(level));
        (low, high) = (low.min(s.at), high.max(s.at));
    }
    let rays = DVec2::new(RAYS[0] as f64, RAYS[1] as f64);
    let all = |f: fn(DVec2, DVec2) -> DVec2, from: DVec2| spans.iter().map(|s| s.at).fold(from, f);
    let (first_ray, last_ray) = (all(DVec2::min, DVec2::INFINITY), all(DVec2::max, DVec2::NEG_INFINITY));
    let cell = (last_ray - first_ray) / (rays - 1.0);
    let lateral: f64 = deepest_x.iter().sum::<f64>();
    let lateral_center: f64 = deepest_x.iter().enumerate().map(|(i, d)| d * i as f64).sum::<f64>() / lateral.max(1e-12);
    let bottom = wet().map(|s| s.bottom).fold(level, f64::min);
    Waterline {
        level: level as f32,
        draft: (level - bottom) as f32,
        volume: immersed as f32,
        area: area as f32,
        extent: (high - low + cell).max(DVec2::ZERO).as_vec2(),
        center: center.as_vec2(),
        moments: moments.as_vec2(),
        center_of_buoyancy: Vec3::new(horizontal.x as f32, height as f32, horizontal.y as f32),
        profile: Vec2::new((deepest_z.iter().sum::<f64>() * cell.y) as f32, (lateral * cell.x) as f32),
        lateral_center: (first_ray.x + lateral_center * cell.x) as f32,
    }
}

//! A hull as vertical spans under a fine grid: where it is solid, from which height to which.
//!
//! Everything that depends on a waterline (draft, waterplane, force points) is summed from these, at load time.

use glam::{DVec2, DVec3};

use super::topology::Surface;
use crate::lewis::Strip;

/// Rays along x and z.
pub(crate) const RAYS: [usize; 2] = [96, 48];

/// A solid stretch of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    /// Ray, along x and z.
    pub(crate) ray: [usize; 2],
    /// Horizontal position in m.
    pub(crate) at: DVec2,
    /// Horizontal area in m^2 that the ray stands for.
    pub(crate) area: f64,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}

impl Span {
    /// Immersed length with the water at `level`.
    pub(crate) fn wet(&self, level: f64) -> f64 {
        (level.min(self.top) - self.bottom).max(0.0)
    }

    pub(crate) fn volume(&self) -> f64 {
        self.area * (self.top - self.bottom)
    }
}

/// The cross-sections below `level`, one a row of rays.
pub(crate) fn strips(spans: &[Span], level: f64) -> Vec<Strip> {
    let mut strips = vec![Strip::default(); RAYS[0]];
    let places: Vec<f64> = spans.iter().map(|s| s.at.x).collect();
    let (low, high) = places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
    let rows = spans.iter().map(|s| s.ray[0]).fold((usize::MAX, 0), |(l, h), i| (l.min(i), h.max(i)));
    let count = rows.1.saturating_sub(rows.0);
    if count == 0 {
        return Vec::new();
    }
    let length = (high - low) / count as f64;
    for s in spans.iter().filter(|s| s.wet(level) > 0.0) {
        let strip = &mut strips[s.ray[0]];
        let width = s.area / length;
        (strip.x, strip.length) = (s.at.x as f32, length as f32);
        strip.beam += if s.top >= level { width as f32 } else { 0.0 };
        strip.draft = strip.draft.max((level - s.bottom) as f32);
        strip.area += (width * s.wet(level)) as f32;
    }
    strips.retain(|s| s.area > 0.0);
    strips
}

/// Spans of a solid given by its stretches at each ray, scaled so that they sum to `volume`.
pub(crate) fn spans_by(
    low: DVec3,
    high: DVec3,
    volume: f64,
    mut stretches: impl FnMut([usize; 2], DVec2, &mut Vec<(f64, f64)>),
) -> Vec<Span> {
    let cell = DVec2::new((high.x - low.x) / RAYS[0] as f64, (high.z - low.z) / RAYS[1] as f64);
    let (mut spans, mut found) = (Vec::new(), Vec::new());
    for j in 0..RAYS[1] {
        for i in 0..RAYS[0] {
            let at = ray_position(low, cell, [i, j]);
            found.clear();
            stretches([i, j], at, &mut found);
            let proper = found.iter().filter(|(b, t)| t > b);
            spans.extend(proper.map(|&(bottom, top)| Span { ray: [i, j], at, area: cell.x * cell.y, bottom, top }));
        }
    }
    let sum: f64 = spans.iter().map(Span::volume).sum();
    if sum > 0.0 {
        spans.iter_mut().for_each(|s| s.area *= volume / sum);
    }
    spans
}

/// Where a ray stands.
pub(crate) fn ray_position(low: DVec3, cell: DVec2, ray: [usize; 2]) -> DVec2 {
    DVec2::new(low.x + (ray[0] as f64 + 0.5) * cell.x, low.z + (ray[1] as f64 + 0.5) * cell.y)
}

/// Spans of a closed surface, by rasterising its triangles from above.
pub(crate) fn spans_of(surface: &Surface, low: DVec3, high: DVec3, volume: f64) -> Vec<Span> {
    let mut hits = hits_of(surface, low, high, RAYS);
    spans_by(low, high, volume, |ray, _, found| stretches(&mut hits[ray[1] * RAYS[0] + ray[0]], found))
}

/// What an upward ray meets: heights, with +1 where it enters the solid and -1 where it leaves.
pub(crate) type Hits = Vec<(f64, i32)>;

/// The hits of `rays` rays along x and z in the middles of as many cells of a box, row by row.
pub(crate) fn hits_of(surface: &Surface, low: DVec3, high: DVec3, rays: [usize; 2]) -> Vec<Hits> {
    let mut hits = vec![Hits::new(); rays[0] * rays[1]];
    let cell = DVec2::new((high.x - low.x) / rays[0] as f64, (high.z - low.z) / rays[1] as f64);
    let index = |x: f64, count: usize| (x.max(0.0) as usize).min(count);
    for t in &surface.triangles {
        let p = t.map(|i| surface.vertices[i as usize]);
        let (a, b) = (p[0].min(p[1]).min(p[2]) - low, p[0].max(p[1]).max(p[2]) - low);
        for j in index(a.z / cell.y - 0.5, rays[1])..index(b.z / cell.y + 1.5, rays[1]) {
            for i in index(a.x / cell.x - 0.5, rays[0])..index(b.x / cell.x + 1.5, rays[0]) {
                if let Some(hit) = crossing(*t, p, ray_position(low, cell, [i, j])) {
                    hits[j * rays[0] + i].push(hit);
                }
            }
        }
    }
    hits
}

/// Where a ray with these hits is in the solid: from, to. None where the hits do not add up.
pub(crate) fn stretches(hits: &mut Hits, found: &mut Vec<(f64, f64)>) {
    hits.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let (mut depth, mut bottom) = (0, 0.0);
    for (y, step) in hits.iter() {
        if depth == 0 {
            bottom = *y;
        }
        depth += step;
        if depth == 0 {
            found.push((bottom, *y));
        }
    }
    if depth != 0 {
        found.clear();
    }
}

/// Where a vertical ray meets a triangle. A ray on an edge belongs to exactly one of the two triangles there, because
/// both compute the edge from its lower index to its higher one and share the tie.
fn crossing(t: [u32; 3], p: [DVec3; 3], at: DVec2) -> Option<(f64, i32)> {
    let side = |a: usize, b: usize| {
        let (from, to, flip) = if t[a] < t[b] { (p[a], p[b], 1.0) } else { (p[b], p[a], -1.0) };
        let value = (to.x - from.x) * (at.y - from.z) - (to.z - from.z) * (at.x - from.x);
        (value * flip, (value >= 0.0) == (flip > 0.0))
    };
    let (bc, ca, ab) = (side(1, 2), side(2, 0), side(0, 1));
    let sum = bc.0 + ca.0 + ab.0;
    if bc.1 != ca.1 || ca.1 != ab.1 || sum == 0.0 {
        return None;
    }
    let y = (bc.0 * p[0].y + ca.0 * p[1].y + ab.0 * p[2].y) / sum;
    Some((y, if sum > 0.0 { 1 } else { -1 }))
}

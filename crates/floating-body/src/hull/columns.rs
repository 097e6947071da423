//! Force points of a mesh hull: upright columns fitted at the waterline where the body will float.
//!
//! A column answers linearly, a V-shaped bottom does not. So each column takes its area, volume and immersed volume from
//! the spans under it at that waterline: there draft, stiffness and centre of buoyancy are those of the mesh; away
//! from it they are approximate, and a fully immersed hull displaces its whole volume again.

use glam::{DVec2, DVec3, Vec3};

use super::spans::{RAYS, Span};
use super::waterline::level_for;
use crate::point::{ForcePoint, PointShape};

/// Columns of less than this share of the hull's volume are left out (their volume goes to the others).
const SMALLEST_SHARE: f64 = 1.0e-4;

/// About `count` columns under `spans`, fitted for a floating body that displaces `volume`.
pub(crate) fn columns(spans: &[Span], low: DVec3, high: DVec3, count: u32, volume: f64) -> Vec<ForcePoint> {
    let grid = grid_for(count, high.x - low.x, high.z - low.z);
    let total: f64 = spans.iter().map(Span::volume).sum();
    let level = level_for(spans, volume.min(total * 0.999));
    let mut cells: Vec<Vec<Span>> = vec![Vec::new(); grid[0] * grid[1]];
    for s in spans {
        cells[s.ray[1] * grid[1] / RAYS[1] * grid[0] + s.ray[0] * grid[0] / RAYS[0]].push(*s);
    }
    let mut points: Vec<Column> = cells.iter().filter_map(|c| Column::fit(c, level)).collect();
    points.retain(|c| c.volume > SMALLEST_SHARE * total);
    match_moments(&mut points, spans, level);
    let kept: f64 = points.iter().map(|c| c.volume).sum();
    points.iter().map(|c| c.point(total / kept)).collect()
}

/// Cells about as long as wide, but at least four across so that roll is felt.
fn grid_for(count: u32, length: f64, beam: f64) -> [usize; 2] {
    let n = f64::from(count.max(1));
    let least = if count >= 16 { 4.0 } else { 2.0_f64.min(n) };
    let across = (n * beam / length).sqrt().round().max(least).min(n);
    [((n / across).round() as usize).clamp(1, RAYS[0]), (across as usize).clamp(1, RAYS[1])]
}

struct Column {
    at: DVec2,
    half: DVec2,
    bottom: f64,
    top: f64,
    area: f64,
    volume: f64,
    immersed: f64,
}

impl Column {
    fn fit(spans: &[Span], level: f64) -> Option<Self> {
        let volume: f64 = spans.iter().map(Span::volume).sum();
        if spans.is_empty() || volume <= 0.0 {
            return None;
        }
        let immersed: f64 = spans.iter().map(|s| s.area * s.wet(level)).sum();
        let plan: f64 = spans.iter().map(|s| s.area).sum();
        let crossing: f64 = spans.iter().filter(|s| s.bottom < level && s.top >= level).map(|s| s.area).sum();
        let mean = |f: fn(&Span) -> f64| spans.iter().map(|s| s.area * f(s)).sum::<f64>() / plan;
        let (area, bottom) = if crossing > 0.05 * plan {
            (crossing, level - immersed / crossing)
        } else if immersed > 0.5 * volume {
            (plan, mean(|s| s.top) - volume / plan)
        } else {
            (plan, mean(|s| s.bottom))
        };
        let weight = |s: &Span| s.area * if immersed > 0.0 { s.wet(level) } else { s.top - s.bottom };
        let sum: f64 = spans.iter().map(weight).sum();
        let at = spans.iter().map(|s| s.at * weight(s)).sum::<DVec2>() / sum;
        let middle = spans.iter().map(|s| s.at * s.area).sum::<DVec2>() / plan;
        let variance = spans.iter().map(|s| (s.at - middle) * (s.at - middle) * s.area).sum::<DVec2>() / plan;
        let half = DVec2::new((3.0 * variance.x).sqrt(), (3.0 * variance.y).sqrt()).max(DVec2::splat(1.0e-3));
        Some(Self { at, half, bottom, top: bottom + volume / area, area, volume, immersed })
    }

    /// The column's own second moment as its response has it: see `ForcePoint::immersion`.
    fn own_moment(&self) -> DVec2 {
        let share = (self.immersed / self.volume).clamp(0.0, 1.0);
        self.half * self.half * (2.0 * share * (1.0 - share) * self.area)
    }

    fn point(&self, scale: f64) -> ForcePoint {
        ForcePoint {
            position: Vec3::new(self.at.x as f32, ((self.bottom + self.top) * 0.5) as f32, self.at.y as f32),
            half: Vec3::new(self.half.x as f32, ((self.top - self.bottom) * 0.5) as f32, self.half.y as f32),
            volume: (self.volume * scale) as f32,
            shape: PointShape::Box,
        }
    }
}

/// Spreads the columns about their centre so that the waterplane's second moments are the mesh's.
fn match_moments(columns: &mut [Column], spans: &[Span], level: f64) {
    let crossing = || spans.iter().filter(|s| s.bottom < level && s.top >= level);
    let area: f64 = crossing().map(|s| s.area).sum();
    let wet = |c: &&mut Column| c.bottom < level && c.top > level;
    let (mut sum, mut first, mut own, mut second) = (0.0, DVec2::ZERO, DVec2::ZERO, DVec2::ZERO);
    for c in columns.iter_mut().filter(wet) {
        (sum, first, own) = (sum + c.area, first + c.at * c.area, own + c.own_moment());
    }
    if sum <= 0.0 || area <= 0.0 {
        return;
    }
    let (middle, center) = (first / sum, crossing().map(|s| s.at * s.area).sum::<DVec2>() / area);
    let target = crossing().map(|s| (s.at - center) * (s.at - center) * s.area).sum::<DVec2>();
    for c in columns.iter_mut().filter(wet) {
        second += (c.at - middle) * (c.at - middle) * c.area;
    }
    let spread = |target: f64, second: f64| {
        if second > 0.0 { (target / second).max(0.0).sqrt().clamp(0.8, 1.25) } else { 1.0 }
    };
    let scale = DVec2::new(spread(target.x - own.x, second.x), spread(target.y - own.y, second.y));
    for c in columns {
        c.at = middle + (c.at - middle) * scale;
    }
}

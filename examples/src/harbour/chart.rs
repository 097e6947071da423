//! The depth map as the scene uses it.

use std::path::Path;

use glam::Vec2;

use super::ground::Extent;
use super::plan::{
    ARM_PROFILE, BERTH, JETTY, JETTY_HALF_WIDTH, MAP_CORNER, MAP_SIZE, MAP_TEXEL, NORTH_ARM, QUAY_HIGH, QUAY_LOW,
    SOUTH_ARM, arm_outline,
};
use crate::{Mark, SceneError};

/// Elevations of bed and land.
#[derive(Debug, Clone)]
pub struct Bed {
    heights: Vec<f32>,
}

impl Bed {
    /// The map in a file; the harbour's own without one.
    ///
    /// # Errors
    /// The file is bad.
    pub fn read(_path: Option<&Path>) -> Result<Self, SceneError> {
        let heights = (0..MAP_SIZE * MAP_SIZE)
            .map(|k| {
                super::bed::elevation(
                    MAP_CORNER.as_vec2() + MAP_TEXEL * Vec2::new((k % MAP_SIZE) as f32, (k / MAP_SIZE) as f32),
                )
            })
            .collect();
        Ok(Self { heights })
    }

    /// What it covers.
    pub fn extent(&self) -> Extent {
        let low = MAP_CORNER.as_vec2();
        Extent { low, high: low + MAP_TEXEL * (MAP_SIZE - 1) as f32, step: MAP_TEXEL }
    }

    /// Elevation at a place, metres.
    pub fn elevation(&self, p: Vec2) -> f32 {
        let last = (MAP_SIZE - 1) as f32;
        let x = ((p - MAP_CORNER.as_vec2()) / MAP_TEXEL).clamp(Vec2::ZERO, Vec2::splat(last));
        let base = x.floor().min(Vec2::splat(last - 1.0));
        let t = x - base;
        let at = |i: usize, j: usize| self.heights[(base.y as usize + j) * MAP_SIZE as usize + base.x as usize + i];
        let row = |j| at(0, j) + t.x * (at(1, j) - at(0, j));
        row(0) + t.y * (row(1) - row(0))
    }
}

/// The works as flat shapes, each convex.
pub fn marks() -> Vec<Mark> {
    let _ = BERTH;
    let quad = |low: Vec2, high: Vec2, color| Mark {
        outline: vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)],
        color,
    };
    let mut marks = vec![quad(QUAY_LOW, QUAY_HIGH, [164, 160, 150])];
    let (low, high) = (JETTY[0].min(JETTY[1]), JETTY[0].max(JETTY[1]));
    let side = Vec2::Y * JETTY_HALF_WIDTH;
    marks.push(quad(low - side, high + side, [126, 102, 74]));
    for axis in [&NORTH_ARM, &SOUTH_ARM] {
        for (half, color) in [(ARM_PROFILE[1].0, [112, 108, 102]), (ARM_PROFILE[0].0, [176, 172, 162])] {
            let outline = arm_outline(axis, half);
            let (n, last) = (axis.len(), outline.len() - 1);
            for i in 0..n - 1 {
                let corners = [i, i + 1, last - i - 1, last - i].map(|k| outline[k]).to_vec();
                marks.push(Mark { outline: corners, color });
            }
            marks.push(Mark { outline: outline[n - 1..=last + 1 - n].to_vec(), color });
        }
    }
    marks
}

//! Chase and orbit cameras.

use glam::{Vec2, Vec3};
use open_water::{OpenWater, WaterSample};
use water_view::Camera;

use crate::Subject;

/// Which camera follows the subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    Chase,
    Orbit,
}

/// A camera that follows a subject smoothly.
#[derive(Debug, Clone)]
pub(crate) struct Rig {
    pub(crate) mode: Mode,
    /// Orbit: angle around the subject and above it, radians.
    pub(crate) yaw: f32,
    pub(crate) pitch: f32,
    /// Distance over the subject's length.
    pub(crate) zoom: f32,
    eye: Option<Vec3>,
    target: Vec3,
}

impl Default for Rig {
    fn default() -> Self {
        Self { mode: Mode::Chase, yaw: 2.4, pitch: 0.35, zoom: 1.0, eye: None, target: Vec3::ZERO }
    }
}

/// Share of the way to go in `dt` seconds when `1/e` is left after `tau`.
fn ease(dt: f32, tau: f32) -> f32 {
    1.0 - (-dt / tau).exp()
}

impl Rig {
    /// The next camera; `dt` seconds after the last.
    pub(crate) fn follow(&mut self, subject: &Subject, water: &OpenWater, size: [u32; 2], dt: f32) -> Camera {
        let forward = subject.orientation * Vec3::X;
        let ahead = Vec2::new(forward.x, forward.z).normalize_or(Vec2::X);
        let ahead = Vec3::new(ahead.x, 0.0, ahead.y);
        let length = subject.length;
        let (eye, target) = match self.mode {
            Mode::Chase => {
                let side = Vec3::Y.cross(ahead);
                let back = self.zoom * length * (2.1 * ahead - 0.45 * side) - Vec3::Y * (0.65 * self.zoom * length);
                (subject.position - back, subject.position + 1.2 * length * ahead + 0.05 * length * Vec3::Y)
            }
            Mode::Orbit => {
                let around = Vec3::new(self.yaw.cos(), 0.0, self.yaw.sin()) * self.pitch.cos();
                let arm = 3.0 * self.zoom * length * (around + Vec3::Y * self.pitch.sin());
                (subject.position + arm, subject.position)
            }
        };
        // The boat heaves, the camera less so.
        let last = self.eye.unwrap_or(eye);
        if self.eye.is_none() {
            self.target = target;
        }
        let flat = ease(dt, if self.mode == Mode::Chase { 0.35 } else { 0.08 });
        let lift = ease(dt, 1.2);
        let blend = |from: Vec3, to: Vec3| {
            Vec3::new(from.x + flat * (to.x - from.x), from.y + lift * (to.y - from.y), from.z + flat * (to.z - from.z))
        };
        let mut eye = blend(last, eye);
        self.target = blend(self.target, target);
        let mut below = [WaterSample::default()];
        water.sample(&[Vec2::new(eye.x, eye.z)], &mut below);
        eye.y = eye.y.max(below[0].height + 1.0);
        self.eye = Some(eye);
        let [w, h] = size;
        Camera { aspect: w as f32 / h as f32, ..Camera::default() }.look_at(eye, self.target)
    }

    /// Turns the orbit by a drag, in pixels.
    pub(crate) fn drag(&mut self, dx: f32, dy: f32) {
        self.yaw += 0.006 * dx;
        self.pitch = (self.pitch + 0.005 * dy).clamp(0.02, 1.5);
    }

    /// Moves closer (negative) or away.
    pub(crate) fn wheel(&mut self, steps: f32) {
        self.zoom = (self.zoom * 1.1f32.powf(steps)).clamp(0.3, 20.0);
    }
}

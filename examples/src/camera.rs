//! Chase and orbit cameras.

use glam::{Vec2, Vec3};
use open_water::{OpenWater, WaterSample};
use water_view::Camera;

use crate::{Scene, Subject};

/// Which camera follows the subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    Chase,
    Orbit,
    /// One of the scene's own viewpoints.
    Stand(usize),
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

fn camera([w, h]: [u32; 2]) -> Camera {
    Camera { aspect: w as f32 / h as f32, ..Camera::default() }
}

impl Rig {
    /// The camera of this number, from 1.
    pub(crate) fn number(view: u32) -> Self {
        let mode = match view {
            0 | 1 => Mode::Chase,
            2 => Mode::Orbit,
            more => Mode::Stand(more as usize - 3),
        };
        Self { mode, ..Self::default() }
    }

    /// Goes on to the next camera of scene `S`.
    pub(crate) fn next<S: Scene>(&mut self) {
        self.mode = match self.mode {
            Mode::Chase => Mode::Orbit,
            Mode::Orbit if S::VIEWPOINTS > 0 => Mode::Stand(0),
            Mode::Stand(index) if index + 1 < S::VIEWPOINTS => Mode::Stand(index + 1),
            Mode::Orbit | Mode::Stand(_) => Mode::Chase,
        };
        self.eye = None;
    }

    /// The next camera of a scene; `dt` seconds after the last.
    pub(crate) fn look<S: Scene>(&mut self, scene: &S, size: [u32; 2], dt: f32) -> Camera {
        let stand = match self.mode {
            Mode::Stand(index) => scene.viewpoint(index),
            Mode::Chase | Mode::Orbit => None,
        };
        match stand {
            Some(at) => camera(size).look_at(at.eye, at.target),
            None => self.follow(&scene.subject(), scene.water(), size, dt),
        }
    }

    fn follow(&mut self, subject: &Subject, water: &OpenWater, size: [u32; 2], dt: f32) -> Camera {
        let forward = subject.orientation * Vec3::X;
        let ahead = Vec2::new(forward.x, forward.z).normalize_or(Vec2::X);
        let ahead = Vec3::new(ahead.x, 0.0, ahead.y);
        let length = subject.length;
        let (eye, target) = match self.mode {
            Mode::Chase | Mode::Stand(_) => {
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
        let flat = ease(dt, if self.mode == Mode::Orbit { 0.08 } else { 0.35 });
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
        camera(size).look_at(eye, self.target)
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

//! The host's camera as the view needs it.

use glam::camera::rh::proj::directx::perspective_infinite_reverse;
use glam::{Mat4, Quat, Vec3};

/// A perspective camera as two matrices: what a host usually has at hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Rigid transform from local space (y up, metres) to the eye's (x right, y up, -z forward).
    pub view_from_world: Mat4,
    /// Perspective projection with depth 0 to 1, forward or reversed as [`crate::ViewDesc::reverse_z`] says; the far
    /// plane may be infinite. The sea is drawn to the horizon whatever the far plane.
    pub clip_from_view: Mat4,
}

/// A camera for hosts without matrices of their own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Eye, local metres.
    pub position: Vec3,
    /// Turns the camera's axes (x right, y up, -z forward) into local space.
    pub orientation: Quat,
    /// Vertical field of view, radians.
    pub fov_y: f32,
    /// Width over height of the target.
    pub aspect: f32,
    /// Distance of the near plane, metres. The far plane is at infinity.
    pub near: f32,
}

impl Default for Camera {
    /// Three metres above the water, looking along -z, 50 degrees high, square.
    fn default() -> Self {
        Self {
            position: Vec3::new(0.0, 3.0, 0.0),
            orientation: Quat::IDENTITY,
            fov_y: 50f32.to_radians(),
            aspect: 1.0,
            near: 0.1,
        }
    }
}

impl Camera {
    /// Turns the camera from `position` towards `target`, upright. Does nothing when the two coincide.
    pub fn look_at(mut self, position: Vec3, target: Vec3) -> Self {
        self.position = position;
        let Some(forward) = (target - position).try_normalize() else {
            return self;
        };
        let up = if forward.y.abs() > 0.9999 { Vec3::NEG_Z } else { Vec3::Y };
        let right = forward.cross(up).normalize();
        let up = right.cross(forward);
        self.orientation = Quat::from_mat3(&glam::Mat3::from_cols(right, up, -forward));
        self
    }

    /// The matrices.
    pub fn view(&self, reverse_z: bool) -> View {
        let world_from_view = Mat4::from_rotation_translation(self.orientation, self.position);
        let mut clip_from_view = perspective_infinite_reverse(self.fov_y, self.aspect, self.near);
        if !reverse_z {
            // depth' = 1 - depth
            let flip = Mat4::from_cols_array(&[1., 0., 0., 0., 0., 1., 0., 0., 0., 0., -1., 0., 0., 0., 1., 1.]);
            clip_from_view = flip * clip_from_view;
        }
        View { view_from_world: world_from_view.inverse(), clip_from_view }
    }
}

/// A view taken apart: the eye, and the direction through a point (x, y) of the target in clip units,
/// `center + x * right + y * up`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rays {
    pub(crate) eye: Vec3,
    pub(crate) center: Vec3,
    pub(crate) right: Vec3,
    pub(crate) up: Vec3,
}

impl Rays {
    /// `None` when the matrices are not finite, not invertible or not perspective.
    pub(crate) fn of(view: &View) -> Option<Self> {
        let world_from_view = view.view_from_world.inverse();
        let eye = world_from_view.w_axis.truncate();
        let view_from_clip = view.clip_from_view.inverse();
        // On a plane of constant depth, view space is affine in clip x and y.
        let at = |x, y| view_from_clip.project_point3(Vec3::new(x, y, 0.5));
        let origin = at(0.0, 0.0);
        let turn = |v: Vec3| world_from_view.transform_vector3(v);
        let scale = 1.0 / origin.length();
        let rays = Self {
            eye,
            center: turn(origin * scale),
            right: turn((at(1.0, 0.0) - origin) * scale),
            up: turn((at(0.0, 1.0) - origin) * scale),
        };
        let finite = [rays.eye, rays.center, rays.right, rays.up].iter().all(|v| v.is_finite());
        let perspective = view.clip_from_view.w_axis.w.abs() < 1e-6;
        (finite && perspective && rays.right.cross(rays.up).length() > 1e-9).then_some(rays)
    }

    /// The same rays over a plane at `level` as over one at 0.
    pub(crate) fn above(&self, level: f32) -> Self {
        Self { eye: self.eye - Vec3::Y * level, ..*self }
    }

    /// Directions through the corners of the target, around it in order.
    pub(crate) fn corners(&self) -> [Vec3; 4] {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| (self.center + x * self.right + y * self.up).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_pass_through_what_the_matrices_project() {
        for reverse_z in [false, true] {
            let camera = Camera { aspect: 1.7, ..Camera::default() };
            let view = camera.look_at(Vec3::new(3.0, 7.0, -2.0), Vec3::new(20.0, -4.0, 11.0)).view(reverse_z);
            let rays = Rays::of(&view).unwrap();
            assert!((rays.eye - Vec3::new(3.0, 7.0, -2.0)).length() < 1e-4);
            let clip_from_world = view.clip_from_view * view.view_from_world;
            for (x, y) in [(0.0, 0.0), (-0.7, 0.3), (0.9, -0.8)] {
                let point = rays.eye + 31.0 * (rays.center + x * rays.right + y * rays.up);
                let seen = clip_from_world.project_point3(point);
                assert!((seen.x - x).abs() < 1e-4 && (seen.y - y).abs() < 1e-4, "{seen}");
            }
        }
    }

    #[test]
    fn broken_matrices_are_refused() {
        let mut view = Camera::default().view(true);
        view.view_from_world.w_axis.x = f32::NAN;
        assert!(Rays::of(&view).is_none());
        let view = View {
            view_from_world: Mat4::IDENTITY,
            clip_from_view: glam::camera::rh::proj::directx::orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 10.0),
        };
        assert!(Rays::of(&view).is_none());
        let view = View { view_from_world: Mat4::IDENTITY, clip_from_view: Mat4::ZERO };
        assert!(Rays::of(&view).is_none());
    }
}

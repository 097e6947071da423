//! A body without any symmetry: its products of inertia count when it tumbles, and it floats where its shape says.

use floating_body::{Body, BodyDesc, BodyState, Closure, Controls, FlatWater, Hull, Quality, TriMesh, WATER_DENSITY};
use glam::{Mat3, Vec3};

/// A tetrahedron with three edges along the axes.
const SIDES: Vec3 = Vec3::new(2.0, 1.0, 3.0);

fn corner() -> Hull {
    let vertices = vec![Vec3::ZERO, Vec3::X * SIDES.x, Vec3::Y * SIDES.y, Vec3::Z * SIDES.z];
    let mesh = TriMesh { vertices, indices: vec![0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
    Hull::from_mesh(&mesh, Closure::Require).unwrap()
}

#[test]
fn its_tensor_has_the_products_of_the_closed_form() {
    let t = corner().unit_inertia();
    let s = SIDES;
    // Of a tetrahedron at a corner, about its centroid per mass: I_xx = 3/80 (b^2 + c^2), I_xy = a b/80.
    let square = s * s * (3.0 / 80.0);
    let diagonal = Vec3::splat(square.x + square.y + square.z) - square;
    let found = Vec3::new(t.x_axis.x, t.y_axis.y, t.z_axis.z);
    assert!(found.abs_diff_eq(diagonal, 1e-5), "{found} {diagonal}");
    let products = Vec3::new(t.y_axis.x, t.z_axis.y, t.x_axis.z);
    let expected = Vec3::new(s.x * s.y, s.y * s.z, s.z * s.x) / 80.0;
    assert!(products.abs_diff_eq(expected, 1e-5), "{products} {expected}");
}

#[test]
fn it_tumbles_freely() {
    let mut desc = BodyDesc::from_hull(&corner(), 700.0);
    desc.drag = floating_body::Drag::default();
    let mut body = Body::new(desc).unwrap();
    body.set_state(BodyState {
        angular_velocity: Vec3::new(2.0, 1.0, -1.5),
        ..BodyState::at_rest(Vec3::new(0.0, 50_000.0, 0.0))
    });
    let momentum = |body: &Body| {
        let turn = Mat3::from_quat(body.state().orientation);
        turn * (body.inertia() * (turn.transpose() * body.state().angular_velocity))
    };
    let first = momentum(&body);
    let energy = body.state().angular_velocity.dot(first);
    let (mut changed, start) = (0.0_f32, body.state().angular_velocity);
    for _ in 0..6000 {
        body.step(1.0 / 60.0, &FlatWater::default(), &Controls::default());
        changed = changed.max((body.state().angular_velocity - start).length());
    }
    assert!((momentum(&body) - first).length() < 0.01 * first.length(), "{} {first}", momentum(&body));
    let now = body.state().angular_velocity.dot(momentum(&body));
    assert!((now / energy - 1.0).abs() < 0.01, "{now} {energy}");
    // A tensor without its products would keep an axis that this one does not.
    assert!(changed > 1.0, "it hardly tumbled: {changed}");
}

#[test]
fn it_floats_with_its_buoyancy_under_its_mass() {
    for (quality, near) in [(Quality::Clipped, 0.004), (Quality::Points, 0.05)] {
        let mut desc = BodyDesc::from_hull(&corner(), 0.4 * WATER_DENSITY * corner().volume());
        desc.quality = quality;
        let mut body = Body::new(desc).unwrap();
        for _ in 0..60 * 180 {
            body.step(1.0 / 60.0, &FlatWater::default(), &Controls::default());
        }
        let (origin, orientation) = body.hull_pose();
        let clip = corner().clip(origin, orientation, |_| 0.0);
        let off = (clip.center - body.state().position).with_y(0.0).length();
        assert!((clip.volume / (0.4 * corner().volume()) - 1.0).abs() < 4.0 * near, "{quality:?}: {}", clip.volume);
        assert!(off < near, "{quality:?}: off by {off} m");
        assert!(body.state().angular_velocity.length() < 1e-3);
    }
}

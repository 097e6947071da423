//! Force points of meshes against the mesh clipped exactly: volume and righting arms, upright, heeled and trimmed.

use floating_body::{
    Body, BodyDesc, BodyState, Closure, Controls, FlatWater, ForcePoints, Hull, TriMesh, WATER_DENSITY,
};
use glam::{Quat, Vec3};

/// A V over its whole height: 5 m long, 4 m wide, 1 m deep, whose sides a column cannot follow.
fn vee() -> Hull {
    let section = [Vec3::new(0.0, 1.0, -2.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 2.0)];
    let ends = [Vec3::X * -2.5, Vec3::X * 2.5];
    let vertices = ends.iter().flat_map(|end| section.map(|v| v + *end)).collect();
    let indices = vec![0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5, 0, 1, 2, 3, 5, 4];
    Hull::from_mesh(&TriMesh { vertices, indices }, Closure::Cap).unwrap()
}

/// A boat: V sections that narrow and rise to the bow, with a transom; open on top.
fn boat() -> Hull {
    let mut mesh = TriMesh::default();
    let stations = 9_u32;
    for i in 0..stations {
        let s = i as f32 / (stations - 1) as f32;
        let (beam, keel) = (1.2 * (1.0 - 0.97 * s * s * s), 0.6 * s * s * s);
        let x = -3.5 + 7.0 * s;
        mesh.vertices.extend(
            [(1.0, 1.0), (0.85, 0.25), (0.0, 0.0), (-0.85, 0.25), (-1.0, 1.0)]
                .map(|(z, y)| Vec3::new(x, keel + (1.0 - keel) * y, beam * z)),
        );
    }
    for i in 0..stations - 1 {
        for k in 0..4 {
            let (a, b) = (5 * i + k, 5 * i + k + 5);
            mesh.indices.extend([a, a + 1, b, b, a + 1, b + 1]);
        }
    }
    for end in [0, 5 * (stations - 1)] {
        mesh.indices.extend([(0, 1, 2), (0, 2, 3), (0, 3, 4)].iter().flat_map(|(a, b, c)| [end + a, end + b, end + c]));
    }
    Hull::from_mesh(&mesh, Closure::Cap).unwrap()
}

/// The height of the surface at which `hull`, turned, displaces `volume`, by bisection on the exact cut.
fn level(hull: &Hull, turn: Quat, volume: f32) -> f32 {
    let (mut low, mut high) = (-20.0_f32, 20.0_f32);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let found = hull.clip(Vec3::ZERO, turn, |_| middle).volume;
        if found < volume { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn thirty_two_points_displace_what_the_mesh_does() {
    for (name, hull) in [("vee", vee()), ("boat", boat())] {
        for density in [0.25_f32, 0.4, 0.5, 0.75] {
            let volume = density * hull.volume();
            let draft = level(&hull, Quat::IDENTITY, volume) - hull.bounds().0.y;
            let mut desc = BodyDesc::from_hull(&hull, volume * WATER_DENSITY);
            desc.points = ForcePoints::Count(32);
            let center = desc.center_of_mass;
            for (heel, trim) in
                [(0.0_f32, 0.0_f32), (5.0, 0.0), (-10.0, 0.0), (20.0, 0.0), (0.0, 2.0), (0.0, -4.0), (20.0, 3.0)]
            {
                let turn = Quat::from_rotation_x(heel.to_radians()) * Quat::from_rotation_z(trim.to_radians());
                // Where the points displace it: the volume of one short step from rest, at two heights.
                let volume_at = |rise: f32| {
                    let mut body = Body::new(desc.clone()).unwrap();
                    body.set_state(BodyState {
                        orientation: turn,
                        ..BodyState::at_rest(turn * center + Vec3::Y * rise)
                    });
                    body.step(1e-6, &FlatWater::default(), &Controls::default());
                    body.immersed_volume()
                };
                let height = -level(&hull, turn, volume);
                let slope = (volume_at(height - 0.01) - volume_at(height + 0.01)) / 0.02;
                let error = (volume_at(height) - volume) / slope / draft;
                let bound = if name == "vee" { 0.015 } else { 0.01 };
                assert!(error.abs() < bound, "{name} at {density}, {heel}, {trim}: {} % of the draft", 100.0 * error);
            }
        }
    }
}

#[test]
fn points_of_a_mesh_are_fitted_once() {
    let hull = boat();
    let first = hull.force_points(32, 2.0);
    assert_eq!(first, hull.force_points(32, 2.0));
    assert_ne!(first, hull.force_points(32, 1.0));
    let sum: f32 = first.iter().map(|p| p.volume).sum();
    assert!((sum / hull.volume() - 1.0).abs() < 0.01, "{sum} of {}", hull.volume());
}

//! What bodies feel against the exact cut and against sums that share nothing with either.

use fearless_simd::Level;
use glam::{DVec3, Quat, Vec2, Vec3};

use super::closed::below;
use super::lanes::{Fade, Plane, push};
use super::panels::Panels;
use crate::hull::shapes::Shape;
use crate::rotation::matrix;
use crate::{Hull, TriMesh};

/// A blob of some hundred triangles without any symmetry.
fn blob() -> Hull {
    let Ok(ball) = Hull::sphere(1.0) else { panic!("no ball") };
    let skin = ball.skin(f32::INFINITY);
    let bend = |v: &Vec3| Vec3::new(2.0 * v.x + 0.3 * v.y * v.y, v.y - 0.2 * v.x, v.z * (1.0 + 0.2 * v.x));
    let mesh = TriMesh { vertices: skin.vertices.iter().map(bend).collect(), indices: skin.indices };
    Hull::from_mesh(&mesh, crate::Closure::Require).unwrap()
}

fn pose(i: u32) -> (Vec3, Quat) {
    let a = i as f32;
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.37 * a, 0.83 * a, 1.3 * a);
    (Vec3::new(3.0, 0.9 * libm::sinf(1.7 * a), -2.0), turn)
}

#[test]
fn the_sweep_is_the_exact_cut() {
    let hull = blob();
    let center = Vec3::new(0.1, -0.2, 0.05);
    let panels = Panels::new(&hull.skin(f32::INFINITY), center, &[]);
    let slope = Vec2::new(0.15, -0.3);
    for i in 0..60 {
        let (position, turn) = pose(i);
        let to_hull = matrix(turn).transpose();
        let clip = hull.clip(position, turn, |p| slope.dot(p - Vec2::new(3.0, -2.0)));
        let com = position + matrix(turn) * center;
        let depth = slope.dot(Vec2::new(com.x - 3.0, com.z + 2.0)) - com.y;
        let plane = Plane { depth, slope: to_hull * Vec3::new(-slope.x, 1.0, -slope.y) };
        let found = push(Level::new(), &panels, &[plane], None, &mut Vec::new());
        let (force, torque) = (matrix(turn) * found.force, matrix(turn) * found.torque);
        let expected = clip.torque - (com - position).cross(clip.force);
        let volume = found.lift.dot(to_hull * Vec3::Y);
        assert!((volume - clip.volume).abs() < 2e-5 * hull.volume(), "{i}: {volume} {}", clip.volume);
        assert!(force.distance(clip.force) < 2e-5 * hull.volume(), "{i}: {force} {}", clip.force);
        assert!(torque.distance(expected) < 5e-5 * hull.volume(), "{i}: {torque} {expected}");
    }
}

#[test]
fn every_machine_has_the_same_bits() {
    let hull = blob();
    let samples = [Vec2::ZERO, Vec2::X, Vec2::new(-1.0, 0.5), Vec2::new(0.5, -0.7), Vec2::new(-0.6, -0.6), Vec2::Y];
    for samples in [&samples[..0], &samples[..]] {
        let panels = Panels::new(&hull.skin(f32::INFINITY), Vec3::ZERO, samples);
        let planes: Vec<Plane> = (0..samples.len().max(1))
            .map(|i| Plane { depth: 0.1 * i as f32, slope: Vec3::new(0.02 * i as f32, 0.9, 0.1) })
            .collect();
        let fade = Fade { wavenumber: 0.4, still: Plane { depth: 0.05, slope: Vec3::Y } };
        let best = push(Level::new(), &panels, &planes, Some(fade), &mut Vec::new());
        let plain = push(Level::baseline(), &panels, &planes, Some(fade), &mut Vec::new());
        assert_eq!(best, plain);
    }
}

#[test]
fn planes_that_agree_are_one_plane() {
    let hull = blob();
    let places = [(-1.5, -0.5), (-0.5, 0.4), (0.1, -0.3), (0.8, 0.5), (1.4, -0.2), (0.5, 0.0), (-1.0, 0.3)];
    let samples: Vec<Vec2> = places.iter().map(|(x, z)| Vec2::new(*x, *z)).collect();
    let plane = Plane { depth: 0.2, slope: Vec3::new(-0.1, 0.95, 0.3) };
    let skin = hull.skin(f32::INFINITY);
    let one = push(Level::new(), &Panels::new(&skin, Vec3::ZERO, &[]), &[plane], None, &mut Vec::new());
    let many = Panels::new(&skin, Vec3::ZERO, &samples);
    let many = push(Level::new(), &many, &vec![plane; samples.len()], None, &mut Vec::new());
    assert!(one.force.distance(many.force) < 1e-4 && one.torque.distance(many.torque) < 1e-4, "{one:?} {many:?}");
}

/// The part of a shape below a plane by summing small cubes, 100 along each side.
fn cubes(shape: &Shape, normal: DVec3, height: f64) -> (f64, DVec3) {
    let solid = shape.solid();
    let (size, n) = (solid.high - solid.low, 100);
    let cell = size / f64::from(n);
    let (mut volume, mut moment) = (0.0, DVec3::ZERO);
    for i in 0..n * n * n {
        let index = DVec3::new(f64::from(i % n), f64::from(i / n % n), f64::from(i / n / n));
        let p = solid.low + (index + 0.5) * cell;
        let inside = match shape {
            Shape::Sphere { radius } => p.length() < *radius,
            _ => p.y.hypot(p.z) < solid.high.y,
        };
        if inside && normal.dot(p) < height {
            let piece = cell.x * cell.y * cell.z;
            (volume, moment) = (volume + piece, moment + p * piece);
        }
    }
    (volume, moment)
}

#[test]
fn balls_and_cylinders_in_closed_form() {
    let rod = Shape::Cylinder { radius: 0.5, length: 2.0 };
    let whole = rod.solid().volume;
    for (shape, normals) in [
        (Shape::Sphere { radius: 0.8 }, vec![DVec3::new(0.3, 0.8, -0.2)]),
        (
            rod,
            vec![
                DVec3::Y,
                DVec3::X,
                -DVec3::X,
                DVec3::new(1e-4, 1.0, 0.3),
                DVec3::new(0.7, 0.6, -0.3),
                DVec3::new(-0.2, -0.9, 0.1),
            ],
        ),
    ] {
        for normal in normals {
            let normal = normal.normalize();
            for height in [-0.9, -0.35, 0.0, 0.2, 0.6] {
                let part = below(&shape, normal, height).unwrap();
                let (volume, moment) = cubes(&shape, normal, height);
                let near = 6e-3 * whole;
                assert!((part.volume - volume).abs() < near, "{shape:?} {normal} {height}: {part:?} {volume}");
                assert!(part.moment.distance(moment) < near, "{shape:?} {normal} {height}: {part:?} {moment}");
            }
        }
    }
    // Turning through level is smooth, and beyond its ends all or nothing is wet.
    let at = |x: f64| below(&rod, DVec3::new(x, (1.0 - x * x).sqrt(), 0.0), 0.1).unwrap();
    for x in [9.9e-5, 5.0e-5, 1.0e-3] {
        assert!((at(x).volume - at(0.0).volume).abs() < 1e-3 * x, "{x}");
        assert!((at(x).moment - at(-x).moment).y.abs() < 1e-9 && (at(x).moment + at(-x).moment).x.abs() < 1e-9);
    }
    // On both sides of where the closed form gives way to its limit.
    assert!((at(4.99e-5).moment.x / at(5.01e-5).moment.x - 0.996).abs() < 1e-3);
    assert_eq!(below(&rod, DVec3::Y, -3.0).unwrap().volume, 0.0);
    assert!((below(&rod, DVec3::new(0.6, 0.8, 0.0), 9.0).unwrap().volume / whole - 1.0).abs() < 1e-12);
}

#[test]
fn pressure_fades_as_linear_theory_has_it() {
    // A box 2 m wide and 1 m deep with its bottom `1 + rise` under a crest: the lift is that of the bottom's pressure.
    let hull = Hull::cuboid(Vec3::new(2.0, 1.0, 1.0)).unwrap();
    let panels = Panels::new(&hull.skin(f32::INFINITY), Vec3::ZERO, &[]);
    for (k, crest) in [(0.3_f32, 0.4_f32), (1.5, 0.4), (6.0, -0.3)] {
        let plane = Plane { depth: 0.2, slope: Vec3::Y };
        let fade = Fade { wavenumber: k, still: Plane { depth: 0.2 - crest, slope: Vec3::Y } };
        let found = push(Level::new(), &panels, &[plane], Some(fade), &mut Vec::new());
        let bottom = 0.7;
        let head = bottom - crest * (1.0 - (-k * bottom).exp());
        assert!((found.force.y / (2.0 * head) - 1.0).abs() < 2e-4, "{k}: {} {}", found.force.y, 2.0 * head);
        assert!((found.lift.y - 1.4).abs() < 1e-5);
    }
}

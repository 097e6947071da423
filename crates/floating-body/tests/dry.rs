//! The room of a hull that is kept dry, against the solid angle under which a mesh is seen from a point.

use std::f64::consts::PI;

use floating_body::{BodyError, Closure, DryHull, Hull, TriMesh};
use glam::{DVec3, Vec3};

/// An open box of 4 x 1.5 x 2 m with walls and floor `wall` m thick: outside, then the well in it.
fn tray(wall: f32) -> TriMesh {
    let mut mesh = TriMesh::default();
    let mut ring = |x: f32, y: f32, z: f32| {
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend([(-x, -z), (x, -z), (x, z), (-x, z)].map(|(x, z)| Vec3::new(x, y, z)));
        first
    };
    let rings = [
        ring(2.0, 0.0, 1.0),
        ring(2.0, 1.5, 1.0),
        ring(2.0 - wall, 1.5, 1.0 - wall),
        ring(2.0 - wall, wall, 1.0 - wall),
    ];
    for pair in rings.windows(2) {
        for k in 0..4 {
            let [a, b, c, d] = [pair[0] + k, pair[0] + (k + 1) % 4, pair[1] + k, pair[1] + (k + 1) % 4];
            mesh.indices.extend([a, c, b, b, c, d]);
        }
    }
    for first in [rings[0], rings[3]] {
        mesh.indices.extend([first, first + 1, first + 2, first, first + 2, first + 3]);
    }
    mesh
}

/// Whether a point is inside a closed mesh: the sum of its triangles' solid angles (Van Oosterom and Strackee 1983).
fn inside(mesh: &TriMesh, point: Vec3) -> bool {
    let angle = |t: &[u32]| {
        let [a, b, c]: [DVec3; 3] = std::array::from_fn(|k| (mesh.vertices[t[k] as usize] - point).as_dvec3());
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let bottom = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(bottom)
    };
    mesh.indices.chunks_exact(3).map(angle).sum::<f64>().abs() > 2.0 * PI
}

/// Points spread evenly over a box, on no lattice (Roberts' sequence).
fn points(low: Vec3, high: Vec3, count: u32) -> impl Iterator<Item = Vec3> {
    let unit = move |i: u32| (f64::from(i) * DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478)).fract().as_vec3();
    (0..count).map(move |i| low + unit(i) * (high - low))
}

/// How far from the skin the room ends, m: the most that a point must move to be told apart rightly.
fn error(dry: &DryHull, mesh: &TriMesh) -> f32 {
    let (low, high) = dry.bounds();
    let margin = 0.05 * (high - low);
    let mut worst = 0.0f32;
    for p in points(low - margin, high + margin, 20_000) {
        let found = dry.contains(p);
        if found == inside(mesh, p) {
            continue;
        }
        let near = |d: f32| {
            [Vec3::X, Vec3::Y, Vec3::Z].iter().any(|a| [d, -d].iter().any(|d| inside(mesh, p + *a * *d) == found))
        };
        let steps = (1..400).map(|k| k as f32 * 1e-3).find(|d| near(*d));
        worst = worst.max(steps.unwrap_or(1.0));
    }
    worst
}

fn launch() -> Hull {
    let text = include_str!("../../../examples/assets/hulls/launch.obj");
    let mut mesh = TriMesh::default();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let kind = words.next();
        let numbers: Vec<f32> = words.filter_map(|w| w.parse().ok()).collect();
        match kind {
            Some("v") => mesh.vertices.push(Vec3::from_slice(&numbers)),
            Some("f") => mesh.indices.extend(numbers.iter().map(|n| *n as u32 - 1)),
            _ => {}
        }
    }
    Hull::from_mesh(&mesh, Closure::Cap).unwrap()
}

#[test]
fn the_room_of_an_open_boat_ends_at_its_skin_and_its_cap() {
    let hull = launch();
    let dry = hull.dry(0.0, 0.0).unwrap();
    let worst = error(&dry, hull.mesh().unwrap());
    println!("launch of 8 m: {worst} m");
    assert!(worst < 0.03, "{worst} m");
}

#[test]
fn a_well_is_dry_up_to_its_edge_and_a_tank_of_the_same_shape_too() {
    let hull = Hull::from_mesh(&tray(0.1), Closure::Require).unwrap();
    let dry = hull.dry(0.0, 0.0).unwrap();
    let full = Hull::cuboid(Vec3::new(4.0, 1.5, 2.0)).unwrap().dry(0.0, 0.0).unwrap();
    for p in points(Vec3::new(-2.2, -0.2, -1.1), Vec3::new(2.2, 1.7, 1.1), 20_000) {
        let beside = ((p - Vec3::new(0.0, 0.75, 0.0)).abs() - Vec3::new(2.0, 0.75, 1.0)).max_element();
        if beside.abs() > 0.005 {
            assert_eq!(dry.contains(p), beside < 0.0, "{p}");
            assert_eq!(full.contains(p - Vec3::Y * 0.75), beside < 0.0, "{p}");
        }
    }
}

#[test]
fn the_room_shrinks_by_the_inset_and_grows_by_the_rim() {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.5, 2.0)).unwrap();
    let dry = hull.dry(0.5, 0.2).unwrap();
    assert_eq!(dry.bounds().1.y, 1.25);
    for p in points(Vec3::splat(-2.2), Vec3::splat(2.2), 20_000) {
        let middle = Vec3::new(0.0, 0.35, 0.0);
        let beside = ((p - middle).abs() - Vec3::new(1.8, 0.9, 0.8)).max_element();
        if beside.abs() > 0.01 {
            assert_eq!(dry.contains(p), beside < 0.0, "{p}");
        }
    }
    let ball = Hull::sphere(1.0).unwrap().dry(0.0, 0.1).unwrap();
    for p in points(Vec3::splat(-1.1), Vec3::splat(1.1), 20_000) {
        // Above, it is dry up to the skin; beside, a shell of the inset is not.
        let off = p.length();
        if p.y < 0.0 && (off - 0.9).abs() > 0.02 {
            assert_eq!(ball.contains(p), off < 0.9, "{p}");
        }
    }
}

#[test]
fn a_hole_through_a_hull_shows_its_water() {
    // A frame: two ends and two sides of a raft around open water.
    let mut mesh = TriMesh::default();
    let mut ring = |x: f32, y: f32, z: f32| {
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend([(-x, -z), (x, -z), (x, z), (-x, z)].map(|(x, z)| Vec3::new(x, y, z)));
        first
    };
    let rings = [ring(3.0, 0.0, 2.0), ring(3.0, 1.0, 2.0), ring(1.0, 1.0, 1.0), ring(1.0, 0.0, 1.0)];
    for (lower, upper) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        for k in 0..4 {
            let [a, b] = [k, (k + 1) % 4].map(|k| rings[lower] + k);
            let [c, d] = [k, (k + 1) % 4].map(|k| rings[upper] + k);
            mesh.indices.extend([a, c, b, b, c, d]);
        }
    }
    let dry = Hull::from_mesh(&mesh, Closure::Require).unwrap().dry(0.0, 0.0).unwrap();
    assert!(!dry.contains(Vec3::new(0.0, 0.5, 0.0)) && dry.contains(Vec3::new(2.0, 0.5, 0.0)));
    assert!(!dry.contains(Vec3::new(0.95, 0.5, 0.0)) && dry.contains(Vec3::new(1.05, 0.5, 0.0)));
}

#[test]
fn what_cannot_be_is_refused_and_odd_points_are_wet() {
    let hull = Hull::cuboid(Vec3::ONE).unwrap();
    for (rim, inset) in [(f32::NAN, 0.0), (-0.1, 0.0), (0.0, f32::INFINITY), (0.0, -1.0)] {
        assert!(matches!(hull.dry(rim, inset), Err(BodyError::InvalidValue { .. })), "{rim} {inset}");
    }
    let dry = hull.dry(0.0, 0.0).unwrap();
    for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
        assert!(!dry.contains(Vec3::new(v, 0.0, 0.0)) && !dry.contains(Vec3::new(0.0, v, 0.0)));
    }
    // An inset wider than the hull leaves nothing.
    let none = hull.dry(0.0, 0.8).unwrap();
    assert!(points(Vec3::splat(-1.0), Vec3::ONE, 2_000).all(|p| !none.contains(p)));
}

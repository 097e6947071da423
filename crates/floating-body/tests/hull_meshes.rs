//! Meshes in memory: welding, winding, closing, and what is refused.

use floating_body::{BodyError, Closure, Hull, TriMesh};
use glam::Vec3;
use proptest::prelude::*;

/// A welded box of 2 x 1 x 3 m, wound outwards; `faces` picks sides (0 left, 1 right, 2 bottom, 3 top, 4 back, 5 front).
fn brick(faces: &[usize]) -> TriMesh {
    let corner = |i: u32| Vec3::new((i & 1) as f32 * 2.0 - 1.0, (i >> 1 & 1) as f32, (i >> 2) as f32 * 3.0 - 1.5);
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let indices = faces.iter().flat_map(|f| {
        let [a, b, c, d] = quads[*f];
        [a, b, c, a, c, d]
    });
    TriMesh { vertices: (0..8).map(corner).collect(), indices: indices.collect() }
}

fn unwelded(mesh: &TriMesh) -> TriMesh {
    let vertices: Vec<Vec3> = mesh.indices.iter().map(|i| mesh.vertices[*i as usize]).collect();
    TriMesh { indices: (0..vertices.len() as u32).collect(), vertices }
}

const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];
const OPEN: [usize; 5] = [0, 1, 2, 4, 5];

fn assert_brick(hull: &Hull) {
    assert!((hull.volume() - 6.0).abs() < 1e-4, "{}", hull.volume());
    assert!((hull.centroid() - Vec3::new(0.0, 0.5, 0.0)).length() < 1e-5);
    // Solid box: (b^2 + c^2)/12 per kg.
    let expected = Vec3::new(1.0 + 9.0, 4.0 + 9.0, 4.0 + 1.0) / 12.0;
    let t = hull.unit_inertia();
    assert!((Vec3::new(t.x_axis.x, t.y_axis.y, t.z_axis.z) - expected).length() < 1e-5, "{t}");
    assert!(t.x_axis.y.abs() + t.x_axis.z.abs() + t.y_axis.z.abs() < 1e-5);
}

#[test]
fn welding_and_winding_give_the_solid() {
    let mesh = brick(&ALL);
    assert_brick(&Hull::from_mesh(&mesh, Closure::Require).unwrap());
    let mut soup = unwelded(&mesh);
    assert_brick(&Hull::from_mesh(&soup, Closure::Require).unwrap());
    soup.indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
    assert_brick(&Hull::from_mesh(&soup, Closure::Require).unwrap());
    soup.indices.chunks_exact_mut(3).step_by(3).for_each(|t| t.swap(0, 1));
    assert_brick(&Hull::from_mesh(&soup, Closure::Require).unwrap());
}

#[test]
fn closures_close_an_open_top() {
    let open = unwelded(&brick(&OPEN));
    let refused = Hull::from_mesh(&open, Closure::Require).unwrap_err();
    assert!(matches!(refused, BodyError::OpenMesh { open_edges: 4, loops: 1 }), "{refused}");
    assert!(refused.to_string().starts_with("the mesh is open: 4 open edges in 1 loops"), "{refused}");
    assert_brick(&Hull::from_mesh(&open, Closure::Cap).unwrap());
    assert_brick(&Hull::from_mesh(&open, Closure::ConvexHull).unwrap());
    assert_brick(&Hull::from_mesh(&brick(&[2, 3]), Closure::ConvexHull).unwrap());
}

#[test]
fn the_convex_hull_of_a_ball_of_points_is_the_ball() {
    let mut mesh = TriMesh::default();
    let count = 2000_u32;
    for i in 0..count {
        let y = 1.0 - 2.0 * (i as f32 + 0.5) / count as f32;
        let (r, angle) = ((1.0 - y * y).sqrt(), 2.399_963 * i as f32);
        mesh.vertices.push(Vec3::new(r * angle.cos(), y, r * angle.sin()));
    }
    mesh.indices = (0..count / 3 * 3).collect();
    let hull = Hull::from_mesh(&mesh, Closure::ConvexHull).unwrap();
    assert!((hull.volume() / 4.18879 - 1.0).abs() < 0.01, "{}", hull.volume());
}

#[test]
fn what_is_no_hull_is_refused_by_name() {
    let text = |mesh: &TriMesh| Hull::from_mesh(mesh, Closure::Cap).unwrap_err().to_string();
    assert!(text(&TriMesh::default()).contains("0 vertices, 0 triangles"));

    let mut nan = brick(&ALL);
    nan.vertices[5].y = f32::NAN;
    assert!(text(&nan).contains("1 vertices are not finite or beyond 10 km from the origin, the first is number 5"));

    let mut wild = brick(&ALL);
    wild.indices[7] = 99;
    assert!(text(&wild).contains("triangle 2 uses vertex 99, but there are 8 vertices"));

    let mut fin = brick(&ALL);
    fin.vertices.push(Vec3::new(0.0, 5.0, 0.0));
    fin.indices.extend([0, 1, 8]);
    assert!(text(&fin).contains("1 edges are shared by more than two"));

    let flat = TriMesh { vertices: brick(&ALL).vertices, indices: vec![0, 1, 4, 4, 1, 0] };
    assert!(text(&flat).contains("encloses 0 m^3"), "{}", text(&flat));

    let dot = TriMesh { vertices: vec![Vec3::ONE; 3], indices: vec![0, 1, 2] };
    assert!(text(&dot).contains("of which 1 are degenerate"), "{}", text(&dot));

    // A Moebius strip of five quads.
    let mut strip = TriMesh::default();
    for i in 0..5_u32 {
        let a = i as f32 * std::f32::consts::TAU / 5.0;
        let (radial, half) = (Vec3::new(a.cos(), 0.0, a.sin()), a / 2.0);
        let across = radial * half.cos() * 0.3 + Vec3::Y * half.sin() * 0.3;
        strip.vertices.extend([radial - across, radial + across]);
    }
    for i in 0..5_u32 {
        let (a, b) = (2 * i, 2 * i + 1);
        let (c, d) = if i < 4 { (a + 2, b + 2) } else { (1, 0) };
        strip.indices.extend([a, b, c, b, d, c]);
    }
    assert!(text(&strip).contains("cannot be wound consistently"), "{}", text(&strip));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_soup_gives_a_hull_or_an_error(
        points in proptest::collection::vec((-2.0..2.0_f32, -2.0..2.0_f32, -2.0..2.0_f32), 0..24),
        picks in proptest::collection::vec(0..26_u32, 0..60),
    ) {
        let vertices = points.iter().map(|(x, y, z)| Vec3::new(x.round(), *y, *z)).collect();
        let mesh = TriMesh { vertices, indices: picks };
        for closure in [Closure::Require, Closure::Cap, Closure::ConvexHull] {
            if let Ok(hull) = Hull::from_mesh(&mesh, closure) {
                prop_assert!(hull.volume() > 0.0 && hull.centroid().is_finite());
            }
        }
    }

    #[test]
    fn the_convex_hull_holds_every_point(
        points in proptest::collection::vec((0..5_u8, 0..5_u8, 0..5_u8), 8..60),
    ) {
        // Integer coordinates: many points in one plane, on one line, in one spot.
        let vertices: Vec<Vec3> = points.iter().map(|(x, y, z)| Vec3::new(f32::from(*x), f32::from(*y), f32::from(*z))).collect();
        let indices = (0..vertices.len() as u32 / 3 * 3).collect();
        let mesh = TriMesh { vertices, indices };
        match Hull::from_mesh(&mesh, Closure::ConvexHull) {
            Ok(hull) => {
                let solid = hull.mesh().unwrap();
                for t in solid.indices.chunks_exact(3) {
                    let [a, b, c] = [0, 1, 2].map(|i| solid.vertices[t[i] as usize]);
                    let normal = (b - a).cross(c - a);
                    for p in &mesh.vertices {
                        prop_assert!(normal.dot(*p - a) < 1e-3, "{p} outside {a} {b} {c}");
                    }
                }
            }
            Err(e) => prop_assert!(matches!(e, BodyError::ConvexHull { .. } | BodyError::EmptyMesh { .. }), "{e}"),
        }
    }
}

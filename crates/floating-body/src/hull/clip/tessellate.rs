//! Triangles for closed shapes, and smaller triangles where a wave must be felt between corners.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::super::shapes::Shape;
use crate::TriMesh;

/// Corners around a ball's or cylinder's axis.
const AROUND: u32 = 32;
/// Rows of a ball from pole to pole.
const ROWS: u32 = 16;
/// Splitting ends when a mesh has this many triangles.
const MOST: usize = 20_000;

/// A closed, outward mesh of the shape with its volume.
pub(crate) fn shape(shape: &Shape) -> TriMesh {
    let (mesh, volume) = match *shape {
        Shape::Cuboid { half } => return cuboid(half),
        Shape::Sphere { radius } => {
            let row = |i: u32| {
                let angle = std::f64::consts::PI * f64::from(i) / f64::from(ROWS);
                (-radius * libm::cos(angle), radius * libm::sin(angle))
            };
            (turned(&(0..=ROWS).map(row).collect::<Vec<_>>()), shape.solid().volume)
        }
        Shape::Cylinder { radius, length } | Shape::HollowCylinder { radius, length, .. } => {
            let x = length / 2.0;
            (turned(&[(-x, 0.0), (-x, radius), (x, radius), (x, 0.0)]), shape.solid().volume)
        }
    };
    let scale = volume / volume_of(&mesh);
    let round = matches!(shape, Shape::Sphere { .. });
    let (along, across) = if round { (libm::cbrt(scale), libm::cbrt(scale)) } else { (1.0, libm::sqrt(scale)) };
    let scale = DVec3::new(along, across, across).as_vec3();
    TriMesh { vertices: mesh.vertices.iter().map(|v| *v * scale).collect(), ..mesh }
}

fn cuboid(half: DVec3) -> TriMesh {
    let sign = |bit: u32, i: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |i: u32| (half * DVec3::new(sign(0, i), sign(1, i), sign(2, i))).as_vec3();
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let indices = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
    TriMesh { vertices: (0..8).map(corner).collect(), indices }
}

/// The line of (x, distance from the axis) turned about x; its ends lie on the axis.
fn turned(line: &[(f64, f64)]) -> TriMesh {
    let mut mesh = TriMesh::default();
    let (first, last) = (line[0], line[line.len() - 1]);
    let inner = &line[1..line.len() - 1];
    for (x, r) in inner {
        for k in 0..AROUND {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(AROUND);
            mesh.vertices.push(DVec3::new(*x, r * libm::cos(angle), r * libm::sin(angle)).as_vec3());
        }
    }
    let poles = mesh.vertices.len() as u32;
    mesh.vertices.extend([Vec3::X * first.0 as f32, Vec3::X * last.0 as f32]);
    let rows = inner.len() as u32;
    for k in 0..AROUND {
        let next = (k + 1) % AROUND;
        mesh.indices.extend([poles, next, k]);
        for row in 1..rows {
            let (low, high) = ((row - 1) * AROUND, row * AROUND);
            mesh.indices.extend([low + k, low + next, high + next, low + k, high + next, high + k]);
        }
        let top = (rows - 1) * AROUND;
        mesh.indices.extend([top + k, top + next, poles + 1]);
    }
    mesh
}

fn volume_of(mesh: &TriMesh) -> f64 {
    let corner = |i: &u32| mesh.vertices[*i as usize].as_dvec3();
    mesh.indices.chunks_exact(3).map(|t| corner(&t[0]).dot(corner(&t[1]).cross(corner(&t[2]))) / 6.0).sum()
}

/// Halves edges longer than `longest` until none is left (or the triangles become too many). Whether an edge is halved
/// depends on the edge alone, so no crack opens.
pub(crate) fn split(mut mesh: TriMesh, longest: f32) -> TriMesh {
    loop {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut indices = Vec::with_capacity(mesh.indices.len());
        let mut vertices = std::mem::take(&mut mesh.vertices);
        for t in mesh.indices.chunks_exact(3) {
            let mut middle = |a: u32, b: u32| {
                let (p, q) = (vertices[a as usize], vertices[b as usize]);
                if p.distance(q) <= longest {
                    return None;
                }
                Some(*middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    vertices.push((p + q) * 0.5);
                    vertices.len() as u32 - 1
                }))
            };
            let [a, b, c] = [t[0], t[1], t[2]];
            match (middle(a, b), middle(b, c), middle(c, a)) {
                (None, None, None) => indices.extend([a, b, c]),
                (Some(m), None, None) => indices.extend([a, m, c, m, b, c]),
                (None, Some(m), None) => indices.extend([b, m, a, m, c, a]),
                (None, None, Some(m)) => indices.extend([c, m, b, m, a, b]),
                (Some(m), Some(n), None) => indices.extend([m, b, n, a, m, n, a, n, c]),
                (None, Some(m), Some(n)) => indices.extend([m, c, n, b, m, n, b, n, a]),
                (Some(n), None, Some(m)) => indices.extend([m, a, n, c, m, n, c, n, b]),
                (Some(l), Some(m), Some(n)) => indices.extend([a, l, n, l, b, m, n, m, c, l, m, n]),
            }
        }
        let done = middles.is_empty() || indices.len() / 3 > MOST;
        mesh = TriMesh { vertices, indices };
        if done {
            return mesh;
        }
    }
}

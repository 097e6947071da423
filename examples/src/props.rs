//! Meshes of hulls, crates and barrels.

use std::collections::HashMap;

use glam::Vec3;
use open_water::TriMesh;
use water_view::{MeshData, MeshVertex};

/// Triangles that meet below this angle shade as one smooth surface (cosine).
const CREASE: f32 = 0.8;

/// A corner of a triangle: where and its normal.
type Corner = (Vec3, Vec3);

/// Cuts a triangle along the level `y` so that no piece crosses it.
fn split(triangle: [Corner; 3], y: f32, out: &mut Vec<[Corner; 3]>) {
    for sign in [-1.0, 1.0] {
        let above = |c: &Corner| sign * (c.0.y - y);
        let mut piece: Vec<Corner> = Vec::with_capacity(4);
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            if above(&a) >= 0.0 {
                piece.push(a);
            }
            if above(&a) * above(&b) < 0.0 {
                let t = above(&a) / (above(&a) - above(&b));
                piece.push((a.0.lerp(b.0, t), a.1.lerp(b.1, t)));
            }
        }
        for k in 2..piece.len() {
            out.push([piece[0], piece[k - 1], piece[k]]);
        }
    }
}

/// A mesh for drawing from a hull's triangles: smooth but for creases, cut at `levels`, coloured by `paint` from a
/// piece's centre and normal.
pub fn hull_mesh(mesh: &TriMesh, levels: &[f32], paint: impl Fn(Vec3, Vec3) -> [u8; 4]) -> MeshData {
    let corner = |t: &[u32], k: usize| mesh.vertices[t[k] as usize];
    let normals: Vec<Vec3> = mesh
        .indices
        .chunks_exact(3)
        .map(|t| (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)))
        .collect();
    let mut around: HashMap<u32, Vec<usize>> = HashMap::new();
    for (face, t) in mesh.indices.chunks_exact(3).enumerate() {
        for index in t {
            around.entry(*index).or_default().push(face);
        }
    }
    let mut data = MeshData::default();
    for (face, t) in mesh.indices.chunks_exact(3).enumerate() {
        let own = normals[face].normalize_or(Vec3::Y);
        let smooth = |k: usize| {
            let faces = around[&t[k]].iter().map(|other| normals[*other]);
            let sum: Vec3 = faces.filter(|n| n.normalize_or_zero().dot(own) > CREASE).sum();
            sum.normalize_or(own)
        };
        let mut pieces = vec![std::array::from_fn(|k| (corner(t, k), smooth(k)))];
        for level in levels {
            let mut cut = Vec::with_capacity(3 * pieces.len());
            pieces.iter().for_each(|piece| split(*piece, *level, &mut cut));
            pieces = cut;
        }
        for piece in pieces {
            let color = paint((piece[0].0 + piece[1].0 + piece[2].0) / 3.0, own);
            for (position, normal) in piece {
                data.indices.push(data.vertices.len() as u32);
                let normal = normal.normalize_or(own).into();
                data.vertices.push(MeshVertex { position: position.into(), normal, color });
            }
        }
    }
    data
}

/// A crate of this size, metres, with battens.
pub fn crate_box(size: Vec3) -> MeshData {
    let mut data = MeshData::default();
    let wood = [148, 122, 88, 10];
    let batten = [112, 88, 60, 10];
    data.cuboid(Vec3::ZERO, 0.48 * size, wood);
    for (y, z) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let edge = 0.45 * size;
        data.cuboid(Vec3::new(0.0, y * edge.y, z * edge.z), Vec3::new(0.5, 0.055, 0.055) * size, batten);
        data.cuboid(Vec3::new(y * edge.x, 0.0, z * edge.z), Vec3::new(0.055, 0.5, 0.055) * size, batten);
        data.cuboid(Vec3::new(y * edge.x, z * edge.y, 0.0), Vec3::new(0.055, 0.055, 0.5) * size, batten);
    }
    data
}

/// A barrel along x, metres, with hoops.
pub fn barrel(radius: f32, length: f32) -> MeshData {
    let mut data = MeshData::default();
    let x = |s: f32| Vec3::X * (s * length);
    data.cylinder(x(-0.5), x(0.5), 0.96 * radius, 20, [205, 205, 205, 130]);
    for s in [-0.47, -0.16, 0.16, 0.47] {
        data.cylinder(x(s - 0.02), x(s + 0.02), radius, 20, [120, 120, 120, 130]);
    }
    data
}

#[cfg(test)]
mod tests {
    use open_water::Hull;

    use super::*;

    #[test]
    fn a_cube_stays_sharp_and_a_barrel_smooth() {
        let hull = Hull::from_mesh(&cube(), open_water::Closure::Require).unwrap();
        let data = hull_mesh(hull.mesh().unwrap(), &[0.25], |_, _| [0; 4]);
        for v in &data.vertices {
            let n = Vec3::from(v.normal).abs();
            assert!(n.max_element() > 0.999, "{n}");
        }
        for piece in data.vertices.chunks(3) {
            let y = piece.iter().map(|v| v.position[1] - 0.25);
            assert!(y.clone().all(|y| y >= -1e-6) || y.clone().all(|y| y <= 1e-6), "a piece crosses the cut");
        }
        let around = barrel(0.3, 0.9);
        assert!(around.indices.iter().all(|i| (*i as usize) < around.vertices.len()));
    }

    fn cube() -> TriMesh {
        let mut data = MeshData::default();
        data.cuboid(Vec3::ZERO, Vec3::ONE, [0; 4]);
        TriMesh { vertices: data.vertices.iter().map(|v| v.position.into()).collect(), indices: data.indices }
    }
}

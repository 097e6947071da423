//! The mesh of a boat, and the room in it that is kept dry.

use std::collections::{HashMap, HashSet};

use glam::Vec3;
use open_water::{DryHull, Hull, TriMesh};
use water_view::MeshData;

use crate::SceneError;
use crate::props::hull_mesh;

const PAINT: [u8; 4] = [232, 233, 228, 120];
const KEEL: [u8; 4] = [120, 30, 24, 60];
const DECK: [u8; 4] = [158, 132, 100, 20];
const TRIM: [u8; 4] = [34, 62, 104, 150];
const GLASS: [u8; 4] = [60, 76, 84, 255];
const RUBBER: [u8; 4] = [52, 52, 54, 90];
const LINING: [u8; 4] = [196, 192, 180, 30];

/// Thickness of the planking of an open boat, metres.
const PLANK: f32 = 0.05;
/// Its sole lies so far under the waterline: water would show in it. Metres.
const SOLE: f32 = 0.12;
/// How far above the rim spray is kept off, metres.
const SPRAY: f32 = 0.25;

/// The room of a boat in which no water shows.
///
/// # Errors
/// None with hulls of boats.
pub fn dry_room(hull: &Hull) -> Result<DryHull, SceneError> {
    hull.dry(SPRAY, 0.5 * PLANK).map_err(|error| SceneError::Water(error.into()))
}

/// The boat: its hull painted, keel below `waterline` (height in the hull's frame). With `open` its deck is left out, and
/// it has a sole, a console, a windscreen, a bench and an outboard engine in proportion to the hull.
pub fn boat_mesh(hull: &Hull, waterline: f32, open: bool) -> MeshData {
    let (low, high) = hull.bounds();
    let (length, beam) = (high.x - low.x, high.z - low.z);
    let mut mesh = hull.mesh().cloned().unwrap_or_default();
    if open {
        mesh = without_deck(&mesh, waterline);
    }
    let keel = waterline + 0.015 * length;
    let trim = keel + 0.02 * length;
    let mut data = hull_mesh(&mesh, &[keel, trim], |at, normal| {
        if normal.y > 0.8 && at.y > waterline {
            DECK
        } else if at.y < keel {
            KEEL
        } else if at.y < trim {
            TRIM
        } else {
            PAINT
        }
    });
    if !open {
        return data;
    }
    line(&mut data, &mesh);
    let sole = waterline - SOLE;
    lay_sole(&mut data, hull, sole);
    let deck = waterline + 0.75 * (high.y - waterline);
    let middle = 0.5 * (low.z + high.z);
    let at = |x: f32, y: f32, z: f32| Vec3::new(low.x + x * length, sole + y * beam, middle + z * beam);
    let half = |x: f32, y: f32, z: f32| Vec3::new(x * length, y * beam, z * beam);
    data.cuboid(at(0.45, 0.19, 0.0), half(0.05, 0.19, 0.17), PAINT);
    data.cuboid(at(0.43, 0.395, 0.0), half(0.055, 0.012, 0.18), DECK);
    data.cuboid(at(0.505, 0.46, 0.0), half(0.006, 0.09, 0.17), GLASS);
    data.cuboid(at(0.29, 0.1, 0.0), half(0.035, 0.1, 0.2), TRIM);
    data.cuboid(at(0.26, 0.24, 0.0), half(0.008, 0.09, 0.2), TRIM);
    let aft = |x: f32, y: f32, z: f32| at(x, y, z) + Vec3::Y * (deck - sole);
    data.cuboid(aft(-0.015, 0.14, 0.0), half(0.03, 0.13, 0.08), RUBBER);
    data.cuboid(aft(-0.02, -0.12, 0.0), half(0.012, 0.2, 0.03), RUBBER);
    data
}

fn normal(mesh: &TriMesh, t: &[u32]) -> Vec3 {
    let [a, b, c] = [t[0], t[1], t[2]].map(|k| mesh.vertices[k as usize]);
    (b - a).cross(c - a)
}

/// The hull less what looks up above the waterline.
fn without_deck(mesh: &TriMesh, waterline: f32) -> TriMesh {
    let deck = |t: &&[u32]| {
        let above = t.iter().all(|k| mesh.vertices[*k as usize].y > waterline);
        above && normal(mesh, t).normalize_or_zero().y > 0.8
    };
    let kept = mesh.indices.chunks_exact(3).filter(|t| !deck(t)).flatten().copied().collect();
    TriMesh { vertices: mesh.vertices.clone(), indices: kept }
}

/// Adds the inside of an open hull's planking, and a rail along its edge.
fn line(data: &mut MeshData, mesh: &TriMesh) {
    let mut normals: HashMap<u32, Vec3> = HashMap::new();
    for t in mesh.indices.chunks_exact(3) {
        for k in t {
            *normals.entry(*k).or_default() += normal(mesh, t);
        }
    }
    let outer = |k: u32| mesh.vertices[k as usize];
    let inner = |k: u32| {
        let n = normals.get(&k).map_or(Vec3::Y, |n| n.normalize_or_zero());
        outer(k) - PLANK * n
    };
    let inside = TriMesh {
        vertices: (0..mesh.vertices.len() as u32).map(inner).collect(),
        indices: mesh.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]]).collect(),
    };
    let lining = hull_mesh(&inside, &[], |_, _| LINING);
    data.indices.extend(lining.indices.iter().map(|k| k + data.vertices.len() as u32));
    data.vertices.extend(lining.vertices);
    let edges: HashSet<(u32, u32)> =
        mesh.indices.chunks_exact(3).flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
    let mut rim: Vec<_> = edges.iter().copied().filter(|(a, b)| !edges.contains(&(*b, *a))).collect();
    rim.sort_unstable();
    for (a, b) in rim {
        let up = Vec3::Y * 0.02;
        let [p, q, r, s] = [outer(a), outer(b), inner(b), inner(a)].map(|v| v + up);
        for (corners, color) in [([p, s, q], DECK), ([q, s, r], DECK)] {
            data.triangle(corners, color);
        }
        for (from, to) in [((outer(a), outer(b)), (p, q)), ((inner(b), inner(a)), (r, s))] {
            data.triangle([from.0, to.0, from.1], DECK);
            data.triangle([from.1, to.0, to.1], DECK);
        }
    }
}

/// Adds a floor at height `y` from plank to plank.
fn lay_sole(data: &mut MeshData, hull: &Hull, y: f32) {
    const STATIONS: u16 = 48;
    let Ok(inside) = hull.dry(0.0, 0.5 * PLANK) else { return };
    let (low, high) = hull.bounds();
    let reach = |station: u16| {
        let x = low.x + (high.x - low.x) * f32::from(station) / f32::from(STATIONS);
        let most =
            (0..200u16).map(|k| 0.005 * f32::from(k) * high.z).take_while(|z| inside.contains(Vec3::new(x, y, *z)));
        Vec3::new(x, y, most.last().unwrap_or(0.0))
    };
    for station in 0..STATIONS {
        let [a, b] = [reach(station), reach(station + 1)];
        if a.z > 0.0 || b.z > 0.0 {
            let port = |p: Vec3| p.with_z(-p.z);
            data.triangle([port(a), a, port(b)], DECK);
            data.triangle([port(b), a, b], DECK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn launch() -> Hull {
        let bytes = include_bytes!("../assets/hulls/launch.glb");
        let mesh = TriMesh::from_bytes("launch.glb", bytes).unwrap();
        Hull::from_mesh(&mesh, open_water::Closure::Cap).unwrap()
    }

    #[test]
    fn an_open_boat_has_a_sole_and_nothing_over_it_but_its_fittings() {
        let hull = launch();
        let boat = boat_mesh(&hull, 0.0, true);
        // Down the middle ahead of the console: a ray meets the sole first.
        let at = Vec3::new(1.53, 0.0, 0.1);
        let heights = boat.indices.chunks_exact(3).filter_map(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|k| Vec3::from(boat.vertices[k as usize].position));
            let side = |p: Vec3, q: Vec3| (q.x - p.x) * (at.z - p.z) - (q.z - p.z) * (at.x - p.x);
            let (u, v, w) = (side(b, c), side(c, a), side(a, b));
            let hit = (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
            hit.then(|| (u * a.y + v * b.y + w * c.y) / (u + v + w))
        });
        let first = heights.fold(f32::NEG_INFINITY, f32::max);
        assert!((first + SOLE).abs() < 1e-3, "{first}");
    }

    #[test]
    fn its_room_reaches_into_its_planking() {
        let hull = launch();
        let room = dry_room(&hull).unwrap();
        for corner in boat_mesh(&hull, 0.0, true).vertices {
            let p = Vec3::from(corner.position);
            let floor = (p.y + SOLE).abs() < 1e-6;
            assert!(!floor || p.z.abs() < 0.05 || room.contains(p + Vec3::Y * 0.02), "{p}");
        }
    }
}

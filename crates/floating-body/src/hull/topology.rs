//! From triangle soup to a closed, consistently wound surface: weld, find edges, wind, cap, wrap.
//!
//! Does not repair self-intersections, nor hollow shells nested in each other (each shell counts as solid).

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::TriMesh;
use crate::BodyError;

/// Most triangles of a hull.
pub(crate) const MAX_TRIANGLES: usize = 4_000_000;
/// Largest coordinate in m.
const MAX_COORDINATE: f32 = 1.0e4;
/// Vertices closer than this share of the bounding box's diagonal are one.
const WELD_SHARE: f64 = 1.0e-6;

/// What to do with a mesh that has open edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Closure {
    /// Refuse it, naming the count of open edges.
    #[default]
    Require,
    /// Close every boundary loop by a fan about its centroid: exact for flat openings such as a deck line, a smooth
    /// lid for gently curved ones (sheer).
    Cap,
    /// Replace the mesh by its convex hull, whatever its edges look like.
    ConvexHull,
}

/// A welded mesh with f64 vertices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Checks, welds, winds and closes `mesh`.
pub(crate) fn close(mesh: &TriMesh, closure: Closure) -> Result<Surface, BodyError> {
    check(mesh)?;
    let mut surface = weld(mesh);
    if surface.triangles.is_empty() {
        return Err(BodyError::EmptyMesh {
            vertices: mesh.vertices.len(),
            triangles: mesh.indices.len() / 3,
            degenerate: mesh.indices.len() / 3,
        });
    }
    if closure == Closure::ConvexHull {
        surface = super::convex::convex_hull(&surface.vertices)?;
    }
    wind(&mut surface)?;
    let open = open_edges(&surface);
    if !open.is_empty() {
        let loops = boundary_loops(&open);
        let count = loops.as_ref().map_or(0, Vec::len);
        match (closure, loops) {
            (Closure::Cap, Some(loops)) => loops.iter().for_each(|l| cap(&mut surface, l)),
            _ => return Err(BodyError::OpenMesh { open_edges: open.len(), loops: count }),
        }
    }
    face_outwards(&mut surface);
    Ok(surface)
}

fn check(mesh: &TriMesh) -> Result<(), BodyError> {
    let (vertices, triangles) = (mesh.vertices.len(), mesh.indices.len() / 3);
    let bad = |v: &&Vec3| !(v.is_finite() && v.abs().max_element() <= MAX_COORDINATE);
    let count = mesh.vertices.iter().filter(bad).count();
    if let Some(first) = mesh.vertices.iter().position(|v| bad(&v)) {
        return Err(BodyError::BadVertices { count, first });
    }
    if triangles > MAX_TRIANGLES {
        return Err(BodyError::TooManyTriangles { triangles, limit: MAX_TRIANGLES });
    }
    if !mesh.indices.len().is_multiple_of(3) {
        let index = mesh.indices.last().map_or(0, |i| *i as usize);
        return Err(BodyError::BadIndex { triangle: triangles, index, vertices });
    }
    if let Some(at) = mesh.indices.iter().position(|i| *i as usize >= vertices) {
        return Err(BodyError::BadIndex { triangle: at / 3, index: mesh.indices[at] as usize, vertices });
    }
    Ok(())
}

/// Joins equal vertices (STL repeats each corner) and drops triangles that collapse.
fn weld(mesh: &TriMesh) -> Surface {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for v in &mesh.vertices {
        (low, high) = (low.min(v.as_dvec3()), high.max(v.as_dvec3()));
    }
    let tolerance = ((high - low).length() * WELD_SHARE).max(1.0e-9);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(mesh.vertices.len());
    let mut surface = Surface::default();
    let cell_of = |v: DVec3| {
        let c = ((v - low) / (2.0 * tolerance)).floor();
        [c.x as i64, c.y as i64, c.z as i64]
    };
    let mut welded = Vec::with_capacity(mesh.vertices.len());
    for v in mesh.vertices.iter().map(|v| v.as_dvec3()) {
        let cell = cell_of(v);
        let near = (0..27).find_map(|n| {
            let key = [cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1];
            let list = cells.get(&key)?;
            list.iter().copied().find(|i| surface.vertices[*i as usize].distance(v) <= tolerance)
        });
        welded.push(near.unwrap_or_else(|| {
            let new = surface.vertices.len() as u32;
            surface.vertices.push(v);
            cells.entry(cell).or_default().push(new);
            new
        }));
    }
    for t in mesh.indices.chunks_exact(3) {
        let t = [welded[t[0] as usize], welded[t[1] as usize], welded[t[2] as usize]];
        if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
            surface.triangles.push(t);
        }
    }
    surface
}

/// The three directed edges of a triangle.
fn edges(t: &[u32; 3]) -> [(u32, u32); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}

fn undirected((a, b): (u32, u32)) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Gives neighbouring triangles the same winding, shell by shell.
fn wind(surface: &mut Surface) -> Result<(), BodyError> {
    let mut at_edge: HashMap<(u32, u32), Vec<u32>> = HashMap::with_capacity(surface.triangles.len() * 2);
    for (i, t) in surface.triangles.iter().enumerate() {
        for e in edges(t) {
            at_edge.entry(undirected(e)).or_default().push(i as u32);
        }
    }
    let crowded = at_edge.values().filter(|list| list.len() > 2).count();
    if crowded > 0 {
        return Err(BodyError::NonManifold { edges: crowded });
    }
    let (mut seen, mut stack) = (vec![false; surface.triangles.len()], Vec::new());
    let mut contradictions = 0;
    for seed in 0..surface.triangles.len() {
        if !std::mem::replace(&mut seen[seed], true) {
            stack.push(seed);
        }
        while let Some(i) = stack.pop() {
            for e in edges(&surface.triangles[i]) {
                let Some(&other) = at_edge[&undirected(e)].iter().find(|o| **o as usize != i) else { continue };
                let other = other as usize;
                let same_way = edges(&surface.triangles[other]).contains(&e);
                if !std::mem::replace(&mut seen[other], true) {
                    if same_way {
                        surface.triangles[other].swap(1, 2);
                    }
                    stack.push(other);
                } else if same_way {
                    contradictions += 1;
                }
            }
        }
    }
    if contradictions > 0 { Err(BodyError::NotOrientable { edges: contradictions }) } else { Ok(()) }
}

/// Edges with one triangle, in that triangle's direction.
fn open_edges(surface: &Surface) -> Vec<(u32, u32)> {
    let all: std::collections::HashSet<(u32, u32)> = surface.triangles.iter().flat_map(edges).collect();
    let lone = |&(a, b): &(u32, u32)| !all.contains(&(b, a));
    surface.triangles.iter().flat_map(edges).filter(lone).collect()
}

/// The closed chains that open edges form; `None` if some vertex has several ways on.
fn boundary_loops(open: &[(u32, u32)]) -> Option<Vec<Vec<u32>>> {
    let mut next = HashMap::with_capacity(open.len());
    if open.iter().any(|&(a, b)| next.insert(a, b).is_some()) {
        return None;
    }
    let mut loops = Vec::new();
    for &(start, _) in open {
        let (mut chain, mut at) = (Vec::new(), start);
        while let Some(to) = next.remove(&at) {
            chain.push(at);
            at = to;
        }
        match chain.len() {
            0 => {}
            _ if at == start => loops.push(chain),
            _ => return None,
        }
    }
    Some(loops)
}

/// A fan about the loop's centroid (weighted by edge length). Volume integrals of a flat loop are exact even where the
/// fan folds over itself, because the overlaps cancel.
fn cap(surface: &mut Surface, ring: &[u32]) {
    let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
    let pairs = || ring.iter().zip(ring.iter().cycle().skip(1));
    for (a, b) in pairs() {
        let (a, b) = (surface.vertices[*a as usize], surface.vertices[*b as usize]);
        sum += (a + b) * 0.5 * a.distance(b);
        weight += a.distance(b);
    }
    let center = surface.vertices.len() as u32;
    let middle = if weight > 0.0 { sum / weight } else { surface.vertices[ring[0] as usize] };
    // As exact as the mesh's own vertices, so that the closed mesh is the same hull.
    surface.vertices.push(middle.as_vec3().as_dvec3());
    surface.triangles.extend(pairs().map(|(a, b)| [*b, *a, center]));
}

/// Turns each shell so that it encloses a positive volume.
fn face_outwards(surface: &mut Surface) {
    let mut parent: Vec<u32> = (0..surface.vertices.len() as u32).collect();
    let find = |parent: &mut Vec<u32>, mut i: u32| {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    };
    for t in &surface.triangles {
        let root = find(&mut parent, t[0]);
        for v in &t[1..] {
            let other = find(&mut parent, *v);
            parent[other as usize] = root;
        }
    }
    let mut volume = vec![0.0_f64; surface.vertices.len()];
    let roots: Vec<u32> = surface.triangles.iter().map(|t| find(&mut parent, t[0])).collect();
    for (t, root) in surface.triangles.iter().zip(&roots) {
        let [a, b, c] = t.map(|i| surface.vertices[i as usize] - surface.vertices[*root as usize]);
        volume[*root as usize] += a.dot(b.cross(c));
    }
    for (t, root) in surface.triangles.iter_mut().zip(&roots) {
        if volume[*root as usize] < 0.0 {
            t.swap(1, 2);
        }
    }
}

//! A hull's triangles, eight by eight, and the depth of their corners under a plane or under several that are blended.

use glam::{Vec2, Vec3};

use crate::TriMesh;

/// Triangles or vertices side by side.
pub(crate) const LANES: usize = 8;
/// Planes that are blended at a vertex.
const NEAREST: usize = 4;

/// Eight numbers.
pub(crate) type Eight = [f32; LANES];

/// Eight triangles near each other. What is missing at the end has no area.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Corners, each as x, y, z.
    pub(crate) corners: [[Eight; 3]; 3],
    /// Area times outward normal.
    pub(crate) area: [Eight; 3],
    /// Corners as vertices.
    pub(crate) vertices: [[u32; LANES]; 3],
}

/// Eight vertices and the planes that are felt there.
#[derive(Clone, Debug)]
pub(crate) struct Spots {
    pub(crate) at: [Eight; 3],
    /// Which plane, and its weight at each; the weights of a vertex sum to 1.
    pub(crate) planes: Vec<(u32, Eight)>,
}

/// The triangles of a hull, relative to some centre.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panels {
    pub(crate) blocks: Vec<Block>,
    pub(crate) spots: Vec<Spots>,
}

impl Panels {
    /// The panels of a closed mesh about `center`. The water is told by one plane or, if `samples` (x, z, about the same
    /// centre) are several, by one each.
    pub(crate) fn new(mesh: &TriMesh, center: Vec3, samples: &[Vec2]) -> Self {
        let vertices: Vec<Vec3> = mesh.vertices.iter().map(|v| *v - center).collect();
        let corner = |i: u32| vertices.get(i as usize).copied().unwrap_or(Vec3::ZERO);
        let mut triangles: Vec<[u32; 3]> = mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        cluster(&mut triangles, &|t: &[u32; 3]| t.iter().map(|i| corner(*i)).sum::<Vec3>());
        let blocks = triangles.chunks(LANES).map(|list| {
            let last = list[list.len() - 1][0];
            let t: [[u32; 3]; LANES] = std::array::from_fn(|lane| list.get(lane).copied().unwrap_or([last; 3]));
            let area = t.map(|t| {
                let [a, b, c] = t.map(|i| corner(i).as_dvec3());
                ((b - a).cross(c - a) * 0.5).as_vec3()
            });
            Block {
                corners: std::array::from_fn(|k| transposed(t.map(|t| corner(t[k])))),
                area: transposed(area),
                vertices: std::array::from_fn(|k| t.map(|t| t[k])),
            }
        });
        let blocks = blocks.collect();
        let spots = if samples.len() > 1 { spots(&vertices, samples) } else { Vec::new() };
        Self { blocks, spots }
    }
}

fn transposed(v: [Vec3; LANES]) -> [Eight; 3] {
    [v.map(|v| v.x), v.map(|v| v.y), v.map(|v| v.z)]
}

/// Sorts so that each eight lie close together: halves along the longest side until eight are left.
fn cluster<T: Copy>(list: &mut [T], place: &dyn Fn(&T) -> Vec3) {
    if list.len() <= LANES {
        return;
    }
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for item in list.iter() {
        (low, high) = (low.min(place(item)), high.max(place(item)));
    }
    let axis = (high - low).max_position();
    let half = (list.len() / 2).next_multiple_of(LANES).min(list.len() - 1);
    list.select_nth_unstable_by(half, |a, b| place(a)[axis].total_cmp(&place(b)[axis]));
    let (first, second) = list.split_at_mut(half);
    cluster(first, place);
    cluster(second, place);
}

/// Blends the planes of the nearest samples at each vertex, with weights after Franke and Little, `((r - d)/(r d))^2`
/// with `r` the distance at which they end.
fn spots(vertices: &[Vec3], samples: &[Vec2]) -> Vec<Spots> {
    let weights = |v: Vec3| {
        let mut near: Vec<(f32, u32)> = (0..).zip(samples).map(|(i, s)| (s.distance(Vec2::new(v.x, v.z)), i)).collect();
        let count = near.len().min(NEAREST + 1);
        if count < near.len() {
            near.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        near.truncate(count);
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let end = near[count - 1].0 * 1.001 + 1.0e-6;
        let weight = |d: f32| ((end - d) / (end * d.max(1.0e-4 * end))) * ((end - d) / (end * d.max(1.0e-4 * end)));
        let sum: f32 = near.iter().map(|n| weight(n.0)).sum();
        near.into_iter().map(move |n| (n.1, weight(n.0) / sum)).collect::<Vec<_>>()
    };
    let blocks = vertices.chunks(LANES).map(|list| {
        let at = transposed(std::array::from_fn(|lane| list.get(lane).copied().unwrap_or(Vec3::ZERO)));
        let mut planes: Vec<(u32, Eight)> = Vec::new();
        for (lane, v) in list.iter().enumerate() {
            for (plane, weight) in weights(*v) {
                let entry = match planes.iter().position(|p| p.0 == plane) {
                    Some(entry) => entry,
                    None => {
                        planes.push((plane, [0.0; LANES]));
                        planes.len() - 1
                    }
                };
                planes[entry].1[lane] = weight;
            }
        }
        Spots { at, planes }
    });
    blocks.collect()
}

//! Where no water shows in a hull: a raster over its plan, from its skin up to its rim, made with vertical rays.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::lid;
use super::spans::{Hits, hits_of, ray_position, stretches};
use super::{Hull, Made};
use crate::BodyError;
use crate::error::check_range;
use crate::hull::topology::Surface;

/// Nodes along x and z; the outermost lie half a cell outside the bounding box.
pub(super) const NODES: [usize; 2] = [64, 48];
/// Rays a cell along each axis, odd: one stands at the node.
const FINE: usize = 5;

/// The room of a hull that is kept dry: over its plan, from its outer skin up to its rim. In the hull's frame, so it is
/// right for boats that heel. Shared: a clone is a pointer.
///
/// Its edge errs by less than a hundredth of the beam.
#[derive(Clone, Debug)]
pub struct DryHull(Arc<Raster>);

#[derive(Debug)]
struct Raster {
    corner: Vec2,
    cell: Vec2,
    bounds: (Vec3, Vec3),
    texels: Vec<[f32; 4]>,
}

/// Values at the nodes while they are made.
struct Nodes {
    /// Lowest point of the solid over the node; none beside the hull.
    low: Vec<Option<f64>>,
    /// Highest point of it within the node's cell, then of the lid over its wells; -inf beside the hull.
    high: Vec<f64>,
    /// Distance to the edge of the plan, m, negative outside.
    edge: Vec<f64>,
}

pub(super) fn index(at: [usize; 2]) -> usize {
    at[1] * NODES[0] + at[0]
}

/// The nodes up to `reach` steps away in the eight directions.
fn around(at: [usize; 2], reach: isize) -> impl Iterator<Item = Option<usize>> {
    let to = move |k: isize| {
        let step = |n: usize, d: isize, most: usize| n.checked_add_signed(d * reach).filter(|n| *n < most);
        Some(index([step(at[0], k % 3 - 1, NODES[0])?, step(at[1], k / 3 - 1, NODES[1])?]))
    };
    (0..9).filter(|k| *k != 4).map(to)
}

fn every() -> impl Iterator<Item = [usize; 2]> {
    (0..NODES[1]).flat_map(|j| (0..NODES[0]).map(move |i| [i, j]))
}

impl Nodes {
    /// From rays in the box `low` to `high`, of which each says where it enters and leaves the solid.
    fn new(rays: &[Option<(f64, f64)>], low: DVec3, high: DVec3, cell: DVec2) -> Self {
        let count = NODES.map(|n| (n - 2) * FINE);
        let ray = |i: usize, j: usize| rays[j * count[0] + i];
        let edges = edges(&ray, count, low, cell / FINE as f64);
        let mut nodes = Self { low: Vec::new(), high: Vec::new(), edge: Vec::new() };
        for [i, j] in every() {
            let inner = (1..NODES[0] - 1).contains(&i) && (1..NODES[1] - 1).contains(&j);
            let first = [i.saturating_sub(1) * FINE, j.saturating_sub(1) * FINE];
            let at_node = if inner { ray(first[0] + FINE / 2, first[1] + FINE / 2) } else { None };
            let cells =
                (0..if inner { FINE * FINE } else { 0 }).filter_map(|k| ray(first[0] + k % FINE, first[1] + k / FINE));
            nodes.high.push(cells.map(|r| r.1).fold(f64::NEG_INFINITY, f64::max));
            nodes.low.push(at_node.map(|r| r.0));
            let at = ray_position(low, cell, [i, j]) - cell;
            let off = edges.iter().map(|e| e.distance_squared(at)).fold(f64::INFINITY, f64::min).sqrt();
            nodes.edge.push(if at_node.is_some() { off } else { -off });
        }
        lid::close(&mut nodes.high, cell, high.y - low.y);
        nodes
    }

    /// Lower side of a node; beside the hull the skin goes on as steep as it ends.
    fn skin(&self, at: [usize; 2], low: f64, high: f64) -> f64 {
        if let Some(y) = self.low[index(at)] {
            return y;
        }
        let ends = around(at, 1).zip(around(at, 2)).filter_map(|(near, far)| {
            let near = self.low[near?]?;
            Some(far.and_then(|far| self.low[far]).map_or(near, |far| 2.0 * near - far))
        });
        let (sum, count) = ends.fold((0.0, 0.0), |(sum, count), y| (sum + y, count + 1.0));
        if count > 0.0 { (sum / count).clamp(low, high) } else { high }
    }

    fn top(&self, at: [usize; 2]) -> f64 {
        let own = self.high[index(at)];
        if own.is_finite() {
            return own;
        }
        around(at, 1).flatten().map(|n| self.high[n]).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Points on the edge of the plan: between a ray that meets the hull and its neighbour that does not.
fn edges(ray: &impl Fn(usize, usize) -> Option<(f64, f64)>, count: [usize; 2], low: DVec3, step: DVec2) -> Vec<DVec2> {
    let solid = |i: usize, j: usize| i.min(j) > 0 && i <= count[0] && j <= count[1] && ray(i - 1, j - 1).is_some();
    let mut found = Vec::new();
    for j in 0..=count[1] {
        for i in 0..=count[0] {
            let at = ray_position(low, step, [i, j]) - step;
            if solid(i, j) != solid(i + 1, j) {
                found.push(at + DVec2::new(0.5 * step.x, 0.0));
            }
            if solid(i, j) != solid(i, j + 1) {
                found.push(at + DVec2::new(0.0, 0.5 * step.y));
            }
        }
    }
    found
}

impl Hull {
    /// The room in this hull in which no water is to be seen: from its skin, `inset` m inside it (0 to 10), up to its rim and
    /// `rim` m higher (0 to 100), for spray rails. A mesh with an open top ([`Closure::Cap`](crate::Closure::Cap)) is dry up
    /// to its cap, one with a well in it up to a smooth lid over the well's edge. Made at load time, in some 20 ms.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] for a number out of its range.
    pub fn dry(&self, rim: f32, inset: f32) -> Result<DryHull, BodyError> {
        let rim = f64::from(check_range("rim", rim, 0.0, 100.0, "in [0, 100] m")?);
        let inset = f64::from(check_range("inset", inset, 0.0, 10.0, "in [0, 10] m")?);
        let (low, high) = (self.0.solid.low, self.0.solid.high);
        let cell = DVec2::new((high.x - low.x) / (NODES[0] - 2) as f64, (high.z - low.z) / (NODES[1] - 2) as f64);
        let nodes = Nodes::new(&self.rays(NODES.map(|n| (n - 2) * FINE)), low, high, cell);
        let skin: Vec<f64> = every().map(|at| nodes.skin(at, low.y, high.y)).collect();
        let texel = |at: [usize; 2]| {
            let slope = |axis: usize, step: f64| {
                let (mut a, mut b) = (at, at);
                (a[axis], b[axis]) = (at[axis].saturating_sub(1), (at[axis] + 1).min(NODES[axis] - 1));
                (skin[index(b)] - skin[index(a)]) / ((b[axis] - a[axis]) as f64 * step)
            };
            let raised = inset * (1.0 + slope(0, cell.x).powi(2) + slope(1, cell.y).powi(2)).sqrt();
            let edge = nodes.edge[index(at)] - inset;
            [(skin[index(at)] + raised) as f32, (nodes.top(at).max(low.y) + rim) as f32, edge as f32, 0.0]
        };
        let corner = DVec2::new(low.x, low.z) - 0.5 * cell;
        let bounds = (low.as_vec3(), (high + DVec3::Y * rim).as_vec3());
        let texels = every().map(texel).collect();
        Ok(DryHull(Arc::new(Raster { corner: corner.as_vec2(), cell: cell.as_vec2(), bounds, texels })))
    }

    /// Where vertical rays in the middles of so many cells of the bounding box first enter and last leave the solid.
    fn rays(&self, count: [usize; 2]) -> Vec<Option<(f64, f64)>> {
        let (low, high) = (self.0.solid.low, self.0.solid.high);
        let mesh = match &self.0.made {
            Made::Mesh(mesh) => mesh,
            Made::Shape(shape) => {
                let cell = DVec2::new((high.x - low.x) / count[0] as f64, (high.z - low.z) / count[1] as f64);
                let at = |k: usize| shape.half_height(ray_position(low, cell, [k % count[0], k / count[0]]));
                return (0..count[0] * count[1]).map(at).map(|h| (h > 0.0).then_some((-h, h))).collect();
            }
        };
        let vertices = mesh.vertices.iter().map(|v| v.as_dvec3()).collect();
        let triangles = mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let mut found = Vec::new();
        let ends = |hits: &mut Hits| {
            found.clear();
            stretches(hits, &mut found);
            Some((found.first()?.0, found.last()?.1))
        };
        hits_of(&Surface { vertices, triangles }, low, high, count).iter_mut().map(ends).collect()
    }
}

impl DryHull {
    /// Whether a point of the hull's frame, m, is in the dry room.
    pub fn contains(&self, point: Vec3) -> bool {
        let raster = &*self.0;
        let at = (Vec2::new(point.x, point.z) - raster.corner) / raster.cell;
        let last = Vec2::new((NODES[0] - 1) as f32, (NODES[1] - 1) as f32);
        if !(at.cmpge(Vec2::ZERO).all() && at.cmple(last).all()) {
            return false;
        }
        let base = at.floor().min(last - 1.0);
        let t = at - base;
        let first = index([base.x as usize, base.y as usize]);
        let read = |k: usize| Vec3::from_slice(&raster.texels[first + k]);
        let (near, far) = (read(0).lerp(read(1), t.x), read(NODES[0]).lerp(read(NODES[0] + 1), t.x));
        let [low, high, edge] = near.lerp(far, t.y).to_array();
        edge >= 0.0 && point.y >= low && point.y <= high
    }

    /// Nodes of the raster along x and z.
    pub fn nodes(&self) -> [u32; 2] {
        NODES.map(|n| n as u32)
    }

    /// Position (x, z) of the first node and distance of neighbouring ones, hull frame, m.
    pub fn place(&self) -> (Vec2, Vec2) {
        (self.0.corner, self.0.cell)
    }

    /// Lowest and highest corner of the box around the room, hull frame, m.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.0.bounds
    }

    /// The raster, row by row along x: lower side, upper side, distance inside the edge of the plan, 0, m.
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.0.texels
    }
}

//! The cut in f64: integrals over what is wet of each triangle, and the lines in which the surface meets the hull.

use std::collections::HashMap;

use glam::DVec3;

use super::Clip;

/// A corner of a wet piece: relative to the hull's origin (world axes), and its depth.
type Corner = (DVec3, f64);

/// Sums over wet triangles; `force` and what follows per unit of specific weight.
#[derive(Default)]
struct Sums {
    wetted: f64,
    force: DVec3,
    torque: DVec3,
    first: DVec3,
}

impl Sums {
    /// Depth is linear over the triangle, so its integrals are exact. The displaced volume and its first moments come by
    /// Gauss's theorem from fields along y that vanish on the surface: `-d`, `-x d`, `-(y d + d^2/2)`, `-z d`.
    fn add(&mut self, [(a, da), (b, db), (c, dc)]: [Corner; 3]) {
        let area = 0.5 * (b - a).cross(c - a);
        let (sum, depth) = (a + b + c, da + db + dc);
        // Integrals of d r and of d^2 over the area.
        let arm = (sum * depth + a * da + b * db + c * dc) / 12.0;
        let square = (depth * depth + da * da + db * db + dc * dc) / 12.0;
        self.wetted += area.length();
        self.force -= area * (depth / 3.0);
        self.torque -= arm.cross(area);
        self.first -= (arm + DVec3::Y * (0.5 * square)) * area.y;
    }
}

/// The cut of triangles whose vertices (relative to `origin`, world axes) lie `depths` under the surface.
pub(super) fn clip(indices: &[u32], vertices: &[DVec3], depths: &[f64], origin: DVec3) -> Clip {
    let mut sums = Sums::default();
    // From the edge where a line enters a triangle to the one where it leaves, and where it enters.
    let mut lines: HashMap<(u32, u32), ((u32, u32), DVec3)> = HashMap::new();
    for t in indices.chunks_exact(3) {
        let corner = |i: usize| (vertices[t[i % 3] as usize], depths[t[i % 3] as usize]);
        let wet = |i: usize| corner(i).1 > 0.0;
        let count = (0..3).filter(|i| wet(*i)).count();
        if count == 0 {
            continue;
        }
        if count == 3 {
            sums.add([corner(0), corner(1), corner(2)]);
            continue;
        }
        // The corner that is alone on its side, and the cuts of its edges.
        let lone = (0..3).find(|i| wet(*i) == (count == 1)).unwrap_or(0);
        let cut = |to: usize| {
            // From the wet end, so that both triangles of an edge find the same bits.
            let (dry, wet) = if count == 1 { (corner(to), corner(lone)) } else { (corner(lone), corner(to)) };
            (wet.0 + (dry.0 - wet.0) * (wet.1 / (wet.1 - dry.1)), 0.0)
        };
        let (next, last) = (cut(lone + 1), cut(lone + 2));
        let edge = |to: usize| {
            let (a, b) = (t[lone], t[(lone + to) % 3]);
            (a.min(b), a.max(b))
        };
        if count == 1 {
            sums.add([corner(lone), next, last]);
            lines.insert(edge(2), (edge(1), last.0));
        } else {
            sums.add([corner(lone + 1), corner(lone + 2), last]);
            sums.add([corner(lone + 1), last, next]);
            lines.insert(edge(1), (edge(2), next.0));
        }
    }
    let volume = sums.force.y.max(0.0);
    let center = if volume > 0.0 { sums.first / volume } else { DVec3::ZERO };
    let (waterline, waterplane) = loops(lines, origin);
    Clip {
        volume: volume as f32,
        center: (origin + center).as_vec3(),
        waterline,
        waterplane: waterplane as f32,
        wetted: sums.wetted as f32,
        force: sums.force.as_vec3(),
        torque: sums.torque.as_vec3(),
    }
}

/// Joins the lines of single triangles; their area seen from above.
fn loops(mut lines: HashMap<(u32, u32), ((u32, u32), DVec3)>, origin: DVec3) -> (Vec<Vec<glam::Vec3>>, f64) {
    let mut starts: Vec<(u32, u32)> = lines.keys().copied().collect();
    // The map's own order differs from run to run.
    starts.sort_unstable();
    let (mut found, mut area) = (Vec::new(), 0.0);
    for start in starts {
        let (mut line, mut at) = (Vec::new(), start);
        while let Some((to, point)) = lines.remove(&at) {
            line.push(point);
            at = to;
        }
        if line.len() < 3 {
            continue;
        }
        let pairs = line.iter().zip(line.iter().cycle().skip(1));
        // y is up, so from above x is right and z is down.
        area += pairs.map(|(a, b)| 0.5 * (a.z * b.x - a.x * b.z)).sum::<f64>();
        found.push(line.iter().map(|p| (origin + *p).as_vec3()).collect());
    }
    (found, area)
}

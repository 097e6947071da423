//! Force, torque and volume of what is wet of a hull's panels: eight triangles side by side, exact for each whether the
//! surface passes above, below or through it. No fused operations and a fixed order of sums: the bits are everywhere the
//! same.

use fearless_simd::{Level, Simd, dispatch, f32x8, mask32x8, prelude::*};
use glam::Vec3;

use super::panels::{Block, Eight, LANES, Panels, Spots};

/// A plane: the depth of a point `r` under it is `depth - slope.r`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Plane {
    pub(crate) depth: f32,
    pub(crate) slope: Vec3,
}

/// How a wave's pressure fades: head at depth `d > 0` is `d - wave (1 - exp(-k d))`, with `wave` the height of the
/// surface over still water (linear theory, as `forces::buoyancy`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fade {
    /// rad/m.
    pub(crate) wavenumber: f32,
    /// Depth of a point under the still water.
    pub(crate) still: Plane,
}

/// Over the specific weight, about the panels' centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum {
    /// m^3.
    pub(crate) force: Vec3,
    /// m^4.
    pub(crate) torque: Vec3,
    /// Integral of depth along the inward normal, m^3: its part along the vertical is the displaced volume.
    pub(crate) lift: Vec3,
}

/// The push on `panels` under `planes` (one, or one for each sample they were made for). `depths` is scratch.
pub(crate) fn push(level: Level, panels: &Panels, planes: &[Plane], fade: Option<Fade>, depths: &mut Vec<f32>) -> Sum {
    if panels.spots.is_empty() {
        let plane = planes.first().copied().unwrap_or_default();
        return dispatch!(level, simd => sweep(simd, &panels.blocks, &plane, fade));
    }
    depths.resize(panels.spots.len() * LANES, 0.0);
    dispatch!(level, simd => {
        sink(simd, &panels.spots, planes, depths);
        sweep(simd, &panels.blocks, depths, fade)
    })
}

/// Depths of all vertices.
#[inline(always)]
fn sink<S: Simd>(simd: S, spots: &[Spots], planes: &[Plane], depths: &mut [f32]) {
    for (spots, out) in spots.iter().zip(depths.chunks_exact_mut(LANES)) {
        let at = load(simd, &spots.at);
        let mut depth = f32x8::splat(simd, 0.0);
        for (plane, weight) in &spots.planes {
            let plane = planes.get(*plane as usize).copied().unwrap_or_default();
            depth += under(simd, &plane, at) * f32x8::load_array(simd, *weight);
        }
        depth.store_slice(out);
    }
}

type Three<S> = [f32x8<S>; 3];

#[inline(always)]
fn load<S: Simd>(simd: S, v: &[Eight; 3]) -> Three<S> {
    [f32x8::load_array(simd, v[0]), f32x8::load_array(simd, v[1]), f32x8::load_array(simd, v[2])]
}

#[inline(always)]
fn under<S: Simd>(simd: S, plane: &Plane, r: Three<S>) -> f32x8<S> {
    let along = r[0] * plane.slope.x + r[1] * plane.slope.y + r[2] * plane.slope.z;
    f32x8::splat(simd, plane.depth) - along
}

/// Where corners' depths come from.
trait Depths {
    fn of<S: Simd>(&self, simd: S, block: &Block, corner: usize, at: Three<S>) -> f32x8<S>;
}

impl Depths for Plane {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, _: &Block, _: usize, at: Three<S>) -> f32x8<S> {
        under(simd, self, at)
    }
}

impl Depths for Vec<f32> {
    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, block: &Block, corner: usize, _: Three<S>) -> f32x8<S> {
        let mut lanes = [0.0; LANES];
        for (lane, vertex) in lanes.iter_mut().zip(&block.vertices[corner]) {
            *lane = self[*vertex as usize];
        }
        f32x8::load_array(simd, lanes)
    }
}

/// Sums of eight lanes each.
struct Sums<S: Simd> {
    force: Three<S>,
    torque: Three<S>,
    lift: Three<S>,
}

impl<S: Simd> Sums<S> {
    /// Adds triangles of `area` over which the head's integral is `head`, with `r` `arm`, and that of the depth `depth`
    /// (per area).
    #[inline(always)]
    fn add(&mut self, area: Three<S>, head: f32x8<S>, arm: Three<S>, depth: f32x8<S>) {
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            self.force[axis] -= area[axis] * head;
            self.torque[axis] -= arm[next] * area[last] - arm[last] * area[next];
            self.lift[axis] -= area[axis] * depth;
        }
    }
}

#[inline(always)]
fn sweep<S: Simd, D: Depths>(simd: S, blocks: &[Block], depths: &D, fade: Option<Fade>) -> Sum {
    let zero = f32x8::splat(simd, 0.0);
    let mut sums = Sums { force: [zero; 3], torque: [zero; 3], lift: [zero; 3] };
    for block in blocks {
        let r = [load(simd, &block.corners[0]), load(simd, &block.corners[1]), load(simd, &block.corners[2])];
        let d = [depths.of(simd, block, 0, r[0]), depths.of(simd, block, 1, r[1]), depths.of(simd, block, 2, r[2])];
        let most = d[0].max(d[1]).max(d[2]);
        let wet = most.simd_gt(zero);
        if !wet.any_true() {
            continue;
        }
        let least = d[0].min(d[1]).min(d[2]);
        let cut = wet & least.simd_lt(zero);
        let positive = [d[0].max(zero), d[1].max(zero), d[2].max(zero)];
        let q = match &fade {
            None => positive,
            Some(fade) => [
                faded(simd, fade, r[0], d[0], positive[0]),
                faded(simd, fade, r[1], d[1], positive[1]),
                faded(simd, fade, r[2], d[2], positive[2]),
            ],
        };
        let area = load(simd, &block.area);
        let mut piece = whole(r, positive, q);
        if cut.any_true() {
            let through = part(simd, r, d, q);
            for (own, through) in piece.iter_mut().zip(through) {
                *own = cut.select(through, *own);
            }
        }
        let [head, x, y, z, depth] = piece;
        sums.add(area, head, [x, y, z], depth);
    }
    Sum { force: sum(sums.force), torque: sum(sums.torque), lift: sum(sums.lift) }
}

#[inline(always)]
fn sum<S: Simd>(v: Three<S>) -> Vec3 {
    let add = |v: f32x8<S>| {
        let mut lanes = [0.0; LANES];
        v.store_slice(&mut lanes);
        lanes.iter().sum::<f32>()
    };
    Vec3::new(add(v[0]), add(v[1]), add(v[2]))
}

/// Head where the depth is `d`.
#[inline(always)]
fn faded<S: Simd>(simd: S, fade: &Fade, r: Three<S>, d: f32x8<S>, positive: f32x8<S>) -> f32x8<S> {
    let wave = d - under(simd, &fade.still, r);
    // exp(-x) as the 32nd power of 1/exp(x/32) by its series; what is deeper than 16/k has faded.
    let x = (positive * (fade.wavenumber / 32.0)).min(f32x8::splat(simd, 0.5));
    let series = x * (x * (x * (x * (1.0 / 24.0) + 1.0 / 6.0) + 0.5) + 1.0) + 1.0;
    let (p2, one) = (series * series, f32x8::splat(simd, 1.0));
    let p4 = p2 * p2;
    let p8 = p4 * p4;
    let p16 = p8 * p8;
    let lost = wave * (one - one / (p16 * p16));
    (positive - lost).max(f32x8::splat(simd, 0.0))
}

/// Integrals over a triangle per area: of the head, of the head times `r`, of the depth. Dry triangles give zeros.
// No closures here: they are not inlined for certain into what the vectors need.
#[inline(always)]
fn whole<S: Simd>(r: [Three<S>; 3], d: Three<S>, q: Three<S>) -> [f32x8<S>; 5] {
    let (third, twelfth) = (1.0 / 3.0, 1.0 / 12.0);
    let sum = q[0] + q[1] + q[2];
    let mut out = [sum * third; 5];
    for axis in 0..3 {
        let (a, b, c) = (r[0][axis], r[1][axis], r[2][axis]);
        out[1 + axis] = (sum * (a + b + c) + (q[0] * a + q[1] * b + q[2] * c)) * twelfth;
    }
    out[4] = (d[0] + d[1] + d[2]) * third;
    out
}

/// Which corner is alone on its side of the surface: the first, the second, or neither.
#[derive(Clone, Copy)]
struct Lone<S: Simd> {
    first: mask32x8<S>,
    second: mask32x8<S>,
}

impl<S: Simd> Lone<S> {
    /// The corners turned so that the one alone comes first.
    #[inline(always)]
    fn turned(self, a: f32x8<S>, b: f32x8<S>, c: f32x8<S>) -> Three<S> {
        [
            self.first.select(a, self.second.select(b, c)),
            self.first.select(b, self.second.select(c, a)),
            self.first.select(c, self.second.select(a, b)),
        ]
    }
}

/// The same for triangles that the surface cuts.
#[inline(always)]
fn part<S: Simd>(simd: S, r: [Three<S>; 3], d: Three<S>, q: Three<S>) -> [f32x8<S>; 5] {
    let zero = f32x8::splat(simd, 0.0);
    let wet = [d[0].simd_gt(zero), d[1].simd_gt(zero), d[2].simd_gt(zero)];
    let lone = Lone { first: !(wet[1] ^ wet[2]), second: !(wet[0] ^ wet[2]) };
    let (d, q) = (lone.turned(d[0], d[1], d[2]), lone.turned(q[0], q[1], q[2]));
    let one = f32x8::splat(simd, 1.0);
    let (t1, t2) = (d[0] / (d[0] - d[1]), d[0] / (d[0] - d[2]));
    let above = d[0].simd_gt(zero);
    // Alone and wet: a small triangle whose head falls from q0 to 0. Alone and dry: two, 1-2-b and 1-b-a, with a on
    // 0-1 and b on 0-2.
    let small = t1 * t2;
    let (large, rest) = (one - t2, t2 * (one - t1));
    let both = q[1] + q[2];
    let (tip, wide, narrow) = (small * q[0], large * both, rest * q[1]);
    let (third, twelfth) = (1.0 / 3.0, 1.0 / 12.0);
    let mut out = [above.select(tip, wide + narrow) * third; 5];
    for axis in 0..3 {
        let v = lone.turned(r[0][axis], r[1][axis], r[2][axis]);
        let (a, b) = (v[0] + (v[1] - v[0]) * t1, v[0] + (v[2] - v[0]) * t2);
        let wet = tip * (v[0] + v[0] + a + b);
        let dry = wide * (v[1] + v[2] + b) + large * (q[1] * v[1] + q[2] * v[2]) + narrow * (v[1] + v[1] + a + b);
        out[1 + axis] = above.select(wet, dry) * twelfth;
    }
    out[4] = above.select(small * d[0], large * (d[1] + d[2]) + rest * d[1]) * third;
    out
}

//! Patterns: fixed shapes that are added to the heights and, with the same weights, read from them.
//!
//! What adds `q dz` and is pushed by the integral of `q z` exchanges energy with the water and makes none: a body's
//! radiation is such a pattern. Four layers share a table, so that all that a body exchanges is one pass.

use glam::{DVec2, Vec2};

use crate::source::HEIGHT_LIMIT;
use crate::{GridError, WaveGrid};

/// Layers of a [`Pattern`].
pub const PATTERN_LAYERS: usize = 4;

/// A part of a pattern: `weight * d / (2 pi (r^2 + d^2)^1.5) * (1 - (r/reach)^2)^2` around its place. Of a source at depth d
/// this reaches the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternKernel {
    /// Place in the pattern, metres.
    pub offset: Vec2,
    /// Depth d, metres, > 0.
    pub depth: f32,
    /// Its integral, but for what ends it.
    pub weight: f32,
}

/// Up to four sums of kernels around one place, tabulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Distance of the table's places, metres.
    spacing: f32,
    /// Places along x and z.
    count: [usize; 2],
    /// Row by row, x fastest.
    table: Vec<[f32; PATTERN_LAYERS]>,
    /// Largest weight of each layer.
    peaks: [f32; PATTERN_LAYERS],
}

/// Places in the shallowest kernel's depth: with 4 linear interpolation errs by 2 % of its peak and less elsewhere.
const FINE: f32 = 4.0;
/// Most places along a side.
const MOST: usize = 512;
/// Less than this, in metres, is not written.
const NOTHING: f32 = 1e-9;

impl Pattern {
    /// The sums of the kernels of each layer, which end `reach` metres from their places.
    ///
    /// # Errors
    /// [`GridError::InvalidValue`] for numbers that are not finite, a reach or depth that is not positive, and a pattern of
    /// no kernels or wider than 10 km.
    pub fn new(layers: [&[PatternKernel]; PATTERN_LAYERS], reach: f32) -> Result<Self, GridError> {
        let bad = |field, value: f32, bound| Err(GridError::InvalidValue { field, value: f64::from(value), bound });
        if !(reach > 0.0 && reach <= 1.0e4) {
            return bad("pattern: reach", reach, "0 to 10,000 m");
        }
        let (mut far, mut shallowest) = (Vec2::ZERO, f32::INFINITY);
        for kernel in layers.iter().copied().flatten() {
            if !(kernel.depth >= 1.0e-4 && kernel.depth <= 1.0e4) {
                return bad("pattern: depth", kernel.depth, "0.0001 to 10,000 m");
            }
            if !(kernel.offset.is_finite() && kernel.offset.abs().max_element() <= 1.0e4) {
                return bad("pattern: offset", kernel.offset.abs().max_element(), "within +-10,000 m");
            }
            if !kernel.weight.is_finite() {
                return bad("pattern: weight", kernel.weight, "finite");
            }
            far = far.max(kernel.offset.abs());
            shallowest = shallowest.min(kernel.depth);
        }
        if shallowest == f32::INFINITY {
            return bad("pattern: kernels", 0.0, "at least one");
        }
        let half = far + Vec2::splat(reach);
        let spacing = (shallowest / FINE).max(2.0 * half.max_element() / MOST as f32);
        // Zeros around it.
        let count = [half.x, half.y].map(|half| 2 * (half / spacing).ceil() as usize + 3);
        let mut table = vec![[0.0f32; PATTERN_LAYERS]; count[0] * count[1]];
        for (layer, kernels) in layers.iter().enumerate() {
            for kernel in *kernels {
                write(&mut table, count, spacing, layer, kernel, reach);
            }
        }
        let mut peaks = [0.0f32; PATTERN_LAYERS];
        for weights in &table {
            for (peak, weight) in peaks.iter_mut().zip(weights) {
                *peak = peak.max(weight.abs());
            }
        }
        Ok(Self { spacing, count, table, peaks })
    }

    /// Half its extent, metres.
    fn half(&self) -> DVec2 {
        let [x, z] = self.count.map(|n| 0.5 * (n - 1) as f64 * f64::from(self.spacing));
        DVec2::new(x, z)
    }

    /// The layers' weights at a place of the table's own units: between its places linear, outside zero.
    #[inline]
    fn at(&self, x: f32, z: f32) -> Option<[f32; PATTERN_LAYERS]> {
        let (i, j) = (x as usize, z as usize);
        if !(x >= 0.0 && z >= 0.0) || i + 1 >= self.count[0] || j + 1 >= self.count[1] {
            return None;
        }
        let (u, v) = (x - i as f32, z - j as f32);
        let first = j * self.count[0] + i;
        let (low, high) = (&self.table[first..first + 2], &self.table[first + self.count[0]..][..2]);
        let (a, b) = ((1.0 - u) * (1.0 - v), u * (1.0 - v));
        let (c, d) = ((1.0 - u) * v, u * v);
        Some(std::array::from_fn(|l| a * low[0][l] + b * low[1][l] + c * high[0][l] + d * high[1][l]))
    }
}

/// Adds a kernel to the table.
fn write(
    table: &mut [[f32; PATTERN_LAYERS]],
    count: [usize; 2],
    spacing: f32,
    layer: usize,
    kernel: &PatternKernel,
    reach: f32,
) {
    let share = kernel.weight * kernel.depth / std::f32::consts::TAU;
    let middle = count.map(|n| 0.5 * (n - 1) as f32 * spacing);
    for (j, row) in table.chunks_exact_mut(count[0]).enumerate() {
        let dz = j as f32 * spacing - middle[1] - kernel.offset.y;
        if dz.abs() >= reach {
            continue;
        }
        for (i, weights) in row.iter_mut().enumerate() {
            let dx = i as f32 * spacing - middle[0] - kernel.offset.x;
            let r2 = dx * dx + dz * dz;
            let left = (1.0 - r2 / (reach * reach)).max(0.0);
            let q = r2 + kernel.depth * kernel.depth;
            weights[layer] += share * left * left / (q * q.sqrt());
        }
    }
}

/// The cells that a pattern covers.
struct Footing {
    /// First and one past the last, per axis.
    range: [[usize; 2]; 2],
    /// Table place of cell (0, 0), and how it changes per cell along x and z.
    from: [f32; 2],
    along: [[f32; 2]; 2],
}

impl WaveGrid {
    /// Adds `amounts` (one a layer) times the pattern to the heights now and one sub-step ago, as a displacement; `at` is its
    /// place, local (x, z), and `heading` the direction of its x axis, radians from x towards z. Cells of the border layer, of
    /// walls and of held water are left out. What is not finite is dropped and counted.
    pub fn add_pattern(&mut self, pattern: &Pattern, at: Vec2, heading: f32, amounts: [f32; PATTERN_LAYERS]) {
        if !amounts.iter().all(|amount| amount.is_finite()) {
            self.dropped += 1;
            return;
        }
        let most: f32 = amounts.iter().zip(&pattern.peaks).map(|(amount, peak)| (amount * peak).abs()).sum();
        if most < NOTHING {
            return;
        }
        let Some(footing) = self.footing(pattern, at, heading) else { return };
        self.capture();
        self.keep_around(footing.range);
        self.tiles.touch(footing.range, most, 0.0);
        let ground = self.ground.clone();
        let cells = ground.as_ref().and_then(|ground| ground.cells.as_ref());
        let nx = self.state.nx;
        let (z, old) = (&mut self.state.z, &mut self.state.old);
        footing.each(pattern, |i, j, weights| {
            let cell = j * nx + i;
            if cells.is_some_and(|cells| !cells.is_open(cell)) {
                return;
            }
            let rise: f32 = weights.iter().zip(&amounts).map(|(weight, amount)| weight * amount).sum();
            z[cell] = (z[cell] + rise).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
            old[cell] = (old[cell] + rise).clamp(-HEIGHT_LIMIT, HEIGHT_LIMIT);
        });
    }

    /// The heights over the layers of a pattern, each the sum over the cells of weight times height times the cell's area:
    /// with the same weights in the same cells as [`Self::add_pattern`].
    pub fn read_pattern(&self, pattern: &Pattern, at: Vec2, heading: f32) -> [f32; PATTERN_LAYERS] {
        let mut sums = [0.0f64; PATTERN_LAYERS];
        if self.at_rest() {
            return [0.0; PATTERN_LAYERS];
        }
        let Some(footing) = self.footing(pattern, at, heading) else { return [0.0; PATTERN_LAYERS] };
        let cells = self.cells();
        footing.each(pattern, |i, j, weights| {
            let cell = j * self.state.nx + i;
            if cells.is_none_or(|cells| cells.is_open(cell)) {
                let z = self.state.z[cell];
                for (sum, weight) in sums.iter_mut().zip(&weights) {
                    *sum += f64::from(weight * z);
                }
            }
        });
        let h = self.place.window.h();
        sums.map(|sum| (sum * h.x * h.y) as f32)
    }

    fn footing(&self, pattern: &Pattern, at: Vec2, heading: f32) -> Option<Footing> {
        if !(at.is_finite() && heading.is_finite()) {
            return None;
        }
        let (window, half) = (&self.place.window, pattern.half());
        let (h, center) = (window.h(), window.cells_from_corner(at, self.origin));
        let (sin, cos) = libm::sincos(f64::from(heading));
        let wide = DVec2::new(cos.abs() * half.x + sin.abs() * half.y, sin.abs() * half.x + cos.abs() * half.y) / h;
        let rim = self.source_rim() as f64;
        let mut range = [[0; 2]; 2];
        for (k, range) in range.iter_mut().enumerate() {
            let low = (center[k] - wide[k]).max(rim).ceil();
            let high = (center[k] + wide[k]).min(f64::from(window.cells[k]) - rim).floor();
            if low >= high {
                return None;
            }
            *range = [low as usize, high as usize];
        }
        // Cell (i, j) is centred at i + 1/2.
        let to = (DVec2::splat(0.5) - center) * h;
        let per = 1.0 / f64::from(pattern.spacing);
        let place = |x: f64, z: f64| [(cos * x + sin * z) * per, (cos * z - sin * x) * per];
        let (first, x, z) = (place(to.x, to.y), place(h.x, 0.0), place(0.0, h.y));
        let middle = pattern.count.map(|n| 0.5 * (n - 1) as f64);
        let corner = [0, 1].map(|k| first[k] + middle[k] + x[k] * range[0][0] as f64 + z[k] * range[1][0] as f64);
        Some(Footing { range, from: corner.map(|v| v as f32), along: [x, z].map(|step| step.map(|v| v as f32)) })
    }
}

impl Footing {
    /// Calls for every cell under the pattern, row by row.
    fn each(&self, pattern: &Pattern, mut act: impl FnMut(usize, usize, [f32; PATTERN_LAYERS])) {
        let [[x0, x1], [z0, z1]] = self.range;
        let [x, z] = self.along;
        for j in z0..z1 {
            let b = (j - z0) as f32;
            let (u, v) = (self.from[0] + b * z[0], self.from[1] + b * z[1]);
            for i in x0..x1 {
                let a = (i - x0) as f32;
                if let Some(weights) = pattern.at(u + a * x[0], v + a * x[1]) {
                    act(i, j, weights);
                }
            }
        }
    }
}

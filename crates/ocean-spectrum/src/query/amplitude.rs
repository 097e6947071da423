//! Factors on the amplitudes of the cascades over the world: what depth, shelter and walls leave of the sea.

use std::sync::Arc;

use glam::{DVec2, Vec2};

use crate::OceanError;
use crate::error::check;

/// A factor for each cascade, longest first; those a sea does not have are not read.
pub type CascadeFactors = [f32; 8];

/// Factors on the amplitude of each cascade over a raster of the world: bilinear between texels, and outside as at the
/// nearest edge.
///
/// A wave's factor is that where its water rests: heights, displacements and their rates are scaled by it, and slopes
/// follow from the product, the factor's own slope included. Its own slope jumps at texels, so keep the factors smooth.
#[derive(Debug, Clone, PartialEq)]
pub struct AmplitudeMap {
    corner: DVec2,
    texel: f32,
    size: [u32; 2],
    factors: Vec<CascadeFactors>,
}

impl AmplitudeMap {
    /// A map whose texel (0, 0) lies at the world place `corner` (x, z; metres), with `size` texels along x and z, 2 to
    /// 4,096 each, `texel` metres apart (.01 to 10,000), row-major with x fastest. Factors are 0 to 4.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for the first value out of its bound.
    pub fn new(corner: DVec2, texel: f32, size: [u32; 2], factors: Vec<CascadeFactors>) -> Result<Self, OceanError> {
        for coordinate in corner.to_array() {
            check("map corner", coordinate, coordinate.abs() <= 1e9, "within 10^9 m")?;
        }
        check("map texel", texel.into(), (0.01..=10e3).contains(&texel), "0.01 to 10000 m")?;
        for side in size {
            check("map size", side.into(), (2..=4096).contains(&side), "2 to 4096 texels a side")?;
        }
        let texels = size[0] as usize * size[1] as usize;
        check("map factors", factors.len() as f64, factors.len() == texels, "one set for each texel")?;
        for &factor in factors.iter().flatten() {
            check("map factor", factor.into(), (0.0..=4.0).contains(&factor), "0 to 4")?;
        }
        Ok(Self { corner, texel, size, factors })
    }

    /// World place (x, z) of texel (0, 0), metres.
    pub fn corner(&self) -> DVec2 {
        self.corner
    }

    /// Distance of neighbouring texels, metres.
    pub fn texel(&self) -> f32 {
        self.texel
    }

    /// Texels along x and z.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The factors, row-major, x fastest.
    pub fn factors(&self) -> &[CascadeFactors] {
        &self.factors
    }
}

/// A map as queries read it: the twin of `wgsl/shared/land.wgsl` and `land_factors.wgsl`.
#[derive(Clone)]
pub(crate) struct Placed {
    pub(crate) map: Arc<AmplitudeMap>,
    /// Local place of texel (0, 0).
    corner: Vec2,
}

struct Place {
    /// First of the four texels around.
    at: usize,
    t: Vec2,
    /// 1 where the place is within the raster on this axis, else 0: the edge goes on without slope.
    inside: Vec2,
}

impl Placed {
    pub(crate) fn new(map: Arc<AmplitudeMap>, origin: DVec2) -> Self {
        let corner = (map.corner - origin).as_vec2();
        Self { map, corner }
    }

    #[inline]
    fn place(&self, rest: Vec2) -> Place {
        let [width, height] = self.map.size;
        let last = Vec2::new(width as f32, height as f32) - 1.0;
        let x = (rest - self.corner) / self.map.texel;
        let held = x.clamp(Vec2::ZERO, last);
        let base = held.floor().min(last - 1.0);
        let inside = Vec2::select(held.cmpeq(x), Vec2::ONE, Vec2::ZERO);
        Place { at: base.y as usize * width as usize + base.x as usize, t: held - base, inside }
    }

    #[inline]
    fn corners(&self, place: &Place) -> [&CascadeFactors; 4] {
        let (factors, width) = (&self.map.factors, self.map.size[0] as usize);
        let (low, high) = (&factors[place.at..place.at + 2], &factors[place.at + width..place.at + width + 2]);
        [&low[0], &low[1], &high[0], &high[1]]
    }

    /// The factors at a local rest point, which is finite.
    #[inline]
    pub(crate) fn values(&self, rest: Vec2) -> CascadeFactors {
        let place = self.place(rest);
        mix(self.corners(&place), place.t)
    }

    /// The largest factors between two local corners; those of everywhere if they are not numbers.
    pub(crate) fn largest(&self, low: Vec2, high: Vec2) -> CascadeFactors {
        let last = self.map.size.map(|n| n as usize - 1);
        let texels = |from: f32, to: f32, corner: f32, last: usize| {
            let at = |place: f32| (place - corner) / self.map.texel;
            let (from, to) = (at(from), at(to));
            if from.is_nan() || to.is_nan() {
                return 0..=last;
            }
            // From the texel before the first to the one after the last; outside the edge goes on.
            (from.min(to).floor() as usize).min(last)..=(from.max(to).ceil() as usize).min(last)
        };
        let columns = texels(low.x, high.x, self.corner.x, last[0]);
        let rows = texels(low.y, high.y, self.corner.y, last[1]);
        let mut largest = [0.0f32; 8];
        for row in rows {
            for factors in &self.map.factors[row * (last[0] + 1)..][columns.clone()] {
                for (most, factor) in largest.iter_mut().zip(factors) {
                    *most = most.max(*factor);
                }
            }
        }
        largest
    }

    /// The slopes of the factors there, by x and by z, 1/m.
    pub(crate) fn slopes(&self, rest: Vec2) -> [CascadeFactors; 2] {
        let place = self.place(rest);
        let [a, b, c, d] = self.corners(&place);
        let t = place.t;
        let scale = place.inside / self.map.texel;
        let along_x = |i: usize| ((b[i] - a[i]) + ((d[i] - c[i]) - (b[i] - a[i])) * t.y) * scale.x;
        let along_z = |i: usize| ((c[i] - a[i]) + ((d[i] - b[i]) - (c[i] - a[i])) * t.x) * scale.y;
        [std::array::from_fn(along_x), std::array::from_fn(along_z)]
    }
}

/// Bilinear; exactly the common value where all four are alike.
#[inline]
fn mix([a, b, c, d]: [&CascadeFactors; 4], t: Vec2) -> CascadeFactors {
    std::array::from_fn(|i| {
        let low = a[i] + (b[i] - a[i]) * t.x;
        let high = c[i] + (d[i] - c[i]) * t.x;
        low + (high - low) * t.y
    })
}

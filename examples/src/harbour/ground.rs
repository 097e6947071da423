//! The mesh of bed, beach and land, from the elevations of a depth map.

use glam::{Vec2, Vec3};
use water_view::{MeshData, MeshVertex};

use super::bed::{noise, smoothstep};
use super::plan::{QUAY_HIGH, QUAY_LOW};

/// The bed below this depth under the sea's level does not show.
const UNSEEN: f32 = 6.0;
/// Distances of the rows beyond the map's edge, metres: land goes on to the horizon's haze.
const BEYOND: [f32; 8] = [12.0, 40.0, 100.0, 220.0, 460.0, 950.0, 2000.0, 4200.0];
/// Highest hills beyond the map, metres.
const HILLS: f32 = 70.0;

/// The rectangle that a map covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Its first corner, local metres.
    pub low: Vec2,
    /// Its last corner.
    pub high: Vec2,
    /// Metres between samples.
    pub step: f32,
}

fn lines(low: f32, high: f32, step: f32) -> Vec<f32> {
    let count = ((high - low) / step).round().max(1.0) as usize;
    let inside = (0..=count).map(|i| low + (high - low) * i as f32 / count as f32);
    BEYOND.iter().rev().map(|b| low - b).chain(inside).chain(BEYOND.iter().map(|b| high + b)).collect()
}

/// Colour of the ground and its gloss.
fn paint(p: Vec2, height: f32, steep: f32, level: f32) -> [u8; 4] {
    let grain = 0.5 * noise(p / 2.3, 21) + 0.5 * noise(p / 9.0, 22);
    let above = height - level;
    let sand = Vec3::new(184.0, 162.0, 120.0) * (1.0 + 0.06 * grain);
    let rock = Vec3::new(98.0, 93.0, 86.0) * (1.0 + 0.22 * grain);
    let far = 0.6 * noise(p / 37.0, 23) + 0.4 * noise(p / 170.0, 24);
    let grass = Vec3::new(66.0, 76.0, 40.0) * (1.0 + 0.22 * grain) + Vec3::new(24.0, 12.0, 4.0) * far;
    let gravel = Vec3::new(150.0, 146.0, 138.0) * (1.0 + 0.07 * grain);
    let bare = sand.lerp(rock, smoothstep(0.16, 0.32, steep + 0.05 * grain));
    let green = smoothstep(2.3, 3.6, above + 0.6 * grain) * (1.0 - smoothstep(0.45, 0.8, steep));
    let out = (QUAY_LOW - Vec2::new(8.0, 40.0) - p).max(p - QUAY_HIGH).max(Vec2::ZERO).length();
    let yard = (1.0 - smoothstep(0.0, 6.0, out)) * smoothstep(1.5, 2.3, above);
    let dry = bare.lerp(grass, green).lerp(gravel, yard);
    // Wet below where the swash reaches, weed at the foot of the rocks.
    let wet = 1.0 - smoothstep(0.15, 0.75, above + 0.15 * grain);
    let weed = smoothstep(0.2, 0.4, steep) * (1.0 - smoothstep(-0.2, 0.5, above)) * 0.5;
    let color = (dry * (1.0 - 0.42 * wet)).lerp(Vec3::new(52.0, 58.0, 38.0), weed);
    let [r, g, b] = color.to_array().map(|c| c.clamp(0.0, 255.0) as u8);
    [r, g, b, (40.0 * wet) as u8]
}

/// Ground of the elevations in `extent`, and on beyond it, for water at `level`. Bed too deep to be seen is left out.
pub fn ground(extent: Extent, level: f32, elevation: impl Fn(Vec2) -> f32) -> MeshData {
    let xs = lines(extent.low.x, extent.high.x, extent.step);
    let zs = lines(extent.low.y, extent.high.y, extent.step);
    let height = |p: Vec2| {
        let held = p.clamp(extent.low, extent.high);
        let away = p.distance(held);
        // The map's last pixels go on, less and less rough.
        let inside = [-36.0, -12.0, 0.0, 12.0, 36.0]
            .map(|along: f32| {
                let off = smoothstep(0.0, 60.0, away) * along;
                elevation((held + Vec2::splat(off)).clamp(extent.low, extent.high))
            })
            .iter()
            .sum::<f32>()
            / 5.0;
        let land = smoothstep(level + 0.5, level + 4.0, inside);
        let hills = 0.6 + 0.4 * noise(p / 700.0, 31) + 0.3 * noise(p / 260.0, 32);
        inside
            + land
                * (HILLS * hills * smoothstep(0.0, 1500.0, away) + 3.0 * noise(p / 90.0, 33) * (away / 80.0).min(1.0))
    };
    let stride = xs.len();
    let heights: Vec<f32> = zs.iter().flat_map(|z| xs.iter().map(|x| height(Vec2::new(*x, *z)))).collect();
    let corner = |i: usize, j: usize| Vec3::new(xs[i], heights[j * stride + i], zs[j]);
    let mut data = MeshData::default();
    let mut slots = vec![u32::MAX; heights.len()];
    let mut slot = |data: &mut MeshData, i: usize, j: usize| {
        let slot = &mut slots[j * stride + i];
        if *slot == u32::MAX {
            *slot = data.vertices.len() as u32;
            let (w, e) = (corner(i.saturating_sub(1), j), corner((i + 1).min(stride - 1), j));
            let (n, s) = (corner(i, j.saturating_sub(1)), corner(i, (j + 1).min(zs.len() - 1)));
            let normal = (s - n).cross(e - w).normalize_or(Vec3::Y);
            let steep = Vec2::new(normal.x, normal.z).length() / normal.y.max(1e-3);
            let p = corner(i, j);
            let color = paint(Vec2::new(p.x, p.z), p.y, steep, level);
            data.vertices.push(MeshVertex { position: p.into(), normal: normal.into(), color });
        }
        *slot
    };
    for j in 0..zs.len() - 1 {
        for i in 0..stride - 1 {
            let quad = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
            if quad.iter().all(|(i, j)| heights[j * stride + i] < level - UNSEEN) {
                continue;
            }
            let [a, b, c, d] = quad.map(|(i, j)| slot(&mut data, i, j));
            data.indices.extend([a, c, b, b, c, d]);
        }
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_follows_the_map_goes_on_beyond_it_and_leaves_out_the_deep() {
        let extent = Extent { low: Vec2::splat(-20.0), high: Vec2::splat(20.0), step: 2.0 };
        let beach = |p: Vec2| 0.5 * p.x;
        let data = ground(extent, 0.0, beach);
        assert!(data.vertices.len() > 200 && data.indices.len() % 3 == 0);
        for v in &data.vertices {
            let p = Vec3::from(v.position);
            assert!(Vec3::from(v.normal).is_normalized() && v.normal[1] > 0.0);
            if p.x.abs() < 20.0 && p.z.abs() < 20.0 {
                assert!(p.y > -UNSEEN - 2.0, "{p}");
                assert!((p.y - 0.5 * p.x).abs() < 1e-4, "{p}");
            }
        }
        let high = data.vertices.iter().map(|v| v.position[1]).fold(0.0, f32::max);
        assert!(high > 30.0, "hills beyond the map: {high}");
        // Faces look up.
        for t in data.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(data.vertices[t[k] as usize].position));
            assert!((b - a).cross(c - a).y > 0.0);
        }
    }
}

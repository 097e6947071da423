//! The harbour's bed, from which its depth map is written. Only operations that every machine rounds alike.

use glam::Vec2;
use image::{ImageBuffer, Luma};

use super::plan::{
    MAP_CORNER, MAP_METRES_PER_LEVEL, MAP_SEA_LEVEL, MAP_SIZE, MAP_TEXEL, NORTH_ARM, QUAY_HIGH, QUAY_LOW, QUAY_TOP,
    SHORE, SOUTH_ARM, distance,
};

/// A number in [0, 1) for a lattice point.
fn hash(x: i32, z: i32, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b9) ^ (z as u32).wrapping_mul(0x85eb_ca6b) ^ seed;
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    ((h ^ (h >> 15)) >> 8) as f32 / (1 << 24) as f32
}

/// Smooth noise between -1 and 1 that varies over about a unit.
pub(crate) fn noise(p: Vec2, seed: u32) -> f32 {
    let base = p.floor();
    let f = p - base;
    let s = f * f * (Vec2::splat(3.0) - 2.0 * f);
    let (x, z) = (base.x as i32, base.y as i32);
    let row = |j: i32| {
        let (a, b) = (hash(x, z + j, seed), hash(x + 1, z + j, seed));
        a + s.x * (b - a)
    };
    let (a, b) = (row(0), row(1));
    2.0 * (a + s.y * (b - a)) - 1.0
}

pub(crate) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Distance to the shore, metres; negative on land.
fn offshore(p: Vec2) -> f32 {
    // West of the line, by crossings of a ray to the east.
    let crossings = SHORE
        .windows(2)
        .filter(|s| {
            let (a, b) = (s[0], s[1]);
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        })
        .count();
    let d = distance(&SHORE, p);
    if crossings % 2 == 1 { d } else { -d }
}

/// Elevation of the bed and the land at a place, metres above the sea's level.
pub fn elevation(p: Vec2) -> f32 {
    let warp =
        Vec2::new(noise(p / 31.0, 1), noise(p / 31.0, 2)) * 5.0 + Vec2::new(noise(p / 11.0, 3), noise(p / 11.0, 4));
    let d = offshore(p + warp);
    // A sandy beach in the east of the basin, rock elsewhere.
    let sand = smoothstep(60.0, 125.0, p.x) * (1.0 - smoothstep(118.0, 150.0, p.y)) * smoothstep(-140.0, -105.0, p.y);
    let rough = 0.5 * noise(p / 7.0, 5) + 0.3 * noise(p / 3.3, 6);
    let mut height = if d > 0.0 {
        let beach = -(d / 15.0).min(4.6 + (d - 69.0).max(0.0) / 60.0);
        let rock = -(d / 3.4 + 0.35).min(6.0 + (d - 19.0).max(0.0) / 40.0) + 0.8 * rough;
        rock + sand * (beach - rock)
    } else {
        let beach = -d / 11.0;
        let rock = 0.35 - d / 2.6 + rough;
        // Then meadows and hills, even towards the map's edge, where its last pixels go on.
        let edge = p.abs().max_element();
        let rolling = smoothstep(10.0, 70.0, -d) * (1.0 - smoothstep(200.0, 250.0, edge));
        let hills = 5.5 - d / 30.0 + (3.5 * noise(p / 58.0, 7) + 1.2 * noise(p / 21.0, 8)) * rolling;
        let low = rock + sand * (beach - rock);
        let level = 2.8 + 2.7 * (1.0 - sand);
        let t = smoothstep(0.6 * level, 2.2 * level, low);
        low.min(2.2 * level) + t * (hills.max(level) - low.min(2.2 * level))
    };
    // The sea bed falls to twelve metres.
    height = height.max(-11.2 - 0.8 * smoothstep(-120.0, -250.0, p.x) + 0.35 * noise(p / 40.0, 9));
    // Dredged along the quay.
    let dredged =
        smoothstep(-60.0, -40.0, p.x) * (1.0 - smoothstep(96.0, 118.0, p.x)) * (1.0 - smoothstep(-88.0, -68.0, p.y));
    let wet = smoothstep(-166.0, -150.0, p.y);
    height += dredged * wet * (height.min(-5.6) - height);
    // The yard.
    let out =
        (QUAY_LOW - Vec2::new(8.0, 40.0) - p).max(p - (QUAY_HIGH - Vec2::new(-8.0, 40.0))).max(Vec2::ZERO).length();
    let yard = 1.0 - smoothstep(2.0, 14.0, out);
    height += yard * (QUAY_TOP - 0.08 - height);
    // Rubble under the breakwaters.
    let arm = distance(&NORTH_ARM, p).min(distance(&SOUTH_ARM, p));
    let rubble = -7.0 - 0.35 * arm + 0.4 * rough;
    height.max(rubble)
}

/// The map as it is stored: 16-bit grey, a centimetre per level.
pub fn picture() -> ImageBuffer<Luma<u16>, Vec<u16>> {
    ImageBuffer::from_fn(MAP_SIZE, MAP_SIZE, |i, j| {
        let at = MAP_CORNER.as_vec2() + MAP_TEXEL * Vec2::new(i as f32, j as f32);
        let level = f32::from(MAP_SEA_LEVEL) + (elevation(at) / MAP_METRES_PER_LEVEL).round();
        Luma([level.clamp(0.0, 65535.0) as u16])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_map_is_what_is_generated() {
        let bytes = include_bytes!("../../assets/harbour/depth.png");
        let stored = image::load_from_memory(bytes).unwrap().into_luma16();
        assert!(stored == picture(), "assets/harbour/depth.png is out of date: run the example harbour-map");
    }

    #[test]
    fn it_is_a_harbour() {
        let sea = elevation(Vec2::new(-250.0, 0.0));
        assert!((-12.5..=-10.0).contains(&sea), "{sea}");
        let gap = elevation(0.5 * (NORTH_ARM[3] + SOUTH_ARM[3]));
        assert!((-12.0..=-7.0).contains(&gap), "{gap}");
        let berth = elevation(super::super::plan::BERTH + Vec2::Y * 4.0);
        assert!((-7.0..=-5.0).contains(&berth), "{berth}");
        // The beach shoals without a step.
        let mut last = elevation(Vec2::new(90.0, 0.0));
        assert!((-6.0..=-3.0).contains(&last), "{last}");
        for x in 91..170 {
            let here = elevation(Vec2::new(x as f32, 0.0));
            assert!((here - last).abs() < 0.35, "{here} after {last} at {x}");
            last = here;
        }
        assert!(last > 1.0, "{last}");
        for (x, z) in [(0.0, -240.0), (0.0, 240.0), (240.0, 0.0)] {
            assert!(elevation(Vec2::new(x, z)) > 2.0, "land at {x}, {z}");
        }
    }
}

//! Where everything of the harbour is: the shore, breakwaters, quay, jetty, berth. World metres, x east, z south; the sea
//! lies to the west, its level is 0.

use std::f32::consts::FRAC_1_SQRT_2;

use glam::{DVec2, Vec2};

/// Corner of the depth map, its texel, metres, and texels along a side.
pub const MAP_CORNER: DVec2 = DVec2::new(-256.0, -256.0);
/// Metres between pixels of the depth map.
pub const MAP_TEXEL: f32 = 2.0;
/// Pixels along a side of the depth map.
pub const MAP_SIZE: u32 = 256;
/// Metres per grey level of the depth map.
pub const MAP_METRES_PER_LEVEL: f32 = 0.01;
/// Grey level of the sea in the depth map.
pub const MAP_SEA_LEVEL: u16 = 32768;

/// The shoreline from north to south; the sea is on its right.
pub(crate) const SHORE: [Vec2; 12] = [
    Vec2::new(-112.0, -400.0),
    Vec2::new(-104.0, -210.0),
    Vec2::new(-96.0, -170.0),
    Vec2::new(-66.0, -152.0),
    Vec2::new(100.0, -152.0),
    Vec2::new(138.0, -128.0),
    Vec2::new(152.0, -40.0),
    Vec2::new(150.0, 70.0),
    Vec2::new(118.0, 142.0),
    Vec2::new(-52.0, 156.0),
    Vec2::new(-98.0, 190.0),
    Vec2::new(-108.0, 400.0),
];

/// Centre lines of the two breakwaters, each from the land to its head.
pub(crate) const NORTH_ARM: [Vec2; 4] =
    [Vec2::new(-70.0, -166.0), Vec2::new(-98.0, -120.0), Vec2::new(-108.0, -62.0), Vec2::new(-104.0, -6.0)];
/// The southern one.
pub(crate) const SOUTH_ARM: [Vec2; 4] =
    [Vec2::new(-60.0, 172.0), Vec2::new(-84.0, 122.0), Vec2::new(-92.0, 86.0), Vec2::new(-90.0, 50.0)];
/// Half the width of a breakwater at its crest, at the sea's level, and at its foot, with their heights, metres.
pub(crate) const ARM_PROFILE: [(f32, f32); 4] = [(2.6, 3.3), (5.4, 1.2), (7.4, -0.6), (14.0, -6.0)];
/// Half the width of the wall that waves meet.
pub(crate) const ARM_HALF_WIDTH: f32 = 5.8;

/// The quay: its corners, metres; its face looks south.
pub const QUAY_LOW: Vec2 = Vec2::new(-24.0, -175.0);
/// South-eastern corner of the quay.
pub const QUAY_HIGH: Vec2 = Vec2::new(98.0, -112.0);
/// Height of the quay and of the yard behind it.
pub const QUAY_TOP: f32 = 2.6;

/// The jetty's axis from the beach to its head, half its width and the height of its deck.
pub const JETTY: [Vec2; 2] = [Vec2::new(158.0, 36.0), Vec2::new(84.0, 36.0)];
/// Half the width of the jetty.
pub const JETTY_HALF_WIDTH: f32 = 2.2;
/// Height of the jetty's deck.
pub const JETTY_TOP: f32 = 2.1;
/// Metres between rows of piles, and the radius of one.
pub(crate) const PILES: (f32, f32) = (6.0, 0.22);

/// Where the moored boat lies, its bow to the east, starboard away from the quay.
pub const BERTH: Vec2 = Vec2::new(36.0, -108.9);

/// The outline of a breakwater as waves meet it, a simple polygon with a round head.
pub fn arm_outline(axis: &[Vec2], half_width: f32) -> Vec<Vec2> {
    let n = axis.len();
    let along = |i: usize| (axis[(i + 1).min(n - 1)] - axis[i.min(n - 2)]).normalize_or(Vec2::X);
    let side = |i: usize| {
        // Mitred at the bends.
        let (before, after) = (along(i.max(1) - 1), along(i));
        let mean = (before + after).normalize_or(after);
        mean.perp() * (half_width / mean.dot(after).max(0.5))
    };
    let mut outline: Vec<Vec2> = (0..n).map(|i| axis[i] + side(i)).collect();
    let (ahead, across) = (along(n - 1), along(n - 1).perp());
    // A half circle in eight steps; its cosines and sines by halving.
    for (c, s) in [(0.923_88, 0.382_683), (FRAC_1_SQRT_2, FRAC_1_SQRT_2), (0.382_683, 0.923_88), (0.0, 1.0)] {
        outline.push(axis[n - 1] + half_width * (c * across + s * ahead));
    }
    for (c, s) in [(0.382_683, 0.923_88), (FRAC_1_SQRT_2, FRAC_1_SQRT_2), (0.923_88, 0.382_683)] {
        outline.push(axis[n - 1] + half_width * (-c * across + s * ahead));
    }
    outline.extend((0..n).rev().map(|i| axis[i] - side(i)));
    outline
}

/// Outlines of all that waves cannot pass: both breakwaters and the quay, world (x, z).
pub fn walls() -> Vec<Vec<DVec2>> {
    let wide = |outline: Vec<Vec2>| outline.iter().map(|p| p.as_dvec2()).collect();
    vec![
        wide(arm_outline(&NORTH_ARM, ARM_HALF_WIDTH)),
        wide(arm_outline(&SOUTH_ARM, ARM_HALF_WIDTH)),
        wide(vec![QUAY_LOW, Vec2::new(QUAY_HIGH.x, QUAY_LOW.y), QUAY_HIGH, Vec2::new(QUAY_LOW.x, QUAY_HIGH.y)]),
    ]
}

/// Distance from `p` to a polyline, metres.
pub fn distance(line: &[Vec2], p: Vec2) -> f32 {
    let mut best = f32::INFINITY;
    for pair in line.windows(2) {
        let d = pair[1] - pair[0];
        let t = ((p - pair[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0);
        best = best.min((pair[0] + t * d - p).length());
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_stand_off_their_axis_and_keep_out_of_the_gap() {
        for axis in [&NORTH_ARM, &SOUTH_ARM] {
            let outline = arm_outline(axis, ARM_HALF_WIDTH);
            for p in &outline {
                let d = distance(axis, *p);
                assert!((d - ARM_HALF_WIDTH).abs() < 0.35, "{p} is {d} m off");
            }
            let area: f32 =
                (0..outline.len()).map(|i| 0.5 * outline[i].perp_dot(outline[(i + 1) % outline.len()])).sum();
            let length: f32 = axis.windows(2).map(|s| s[0].distance(s[1])).sum();
            let expected = 2.0 * ARM_HALF_WIDTH * length + 1.55 * ARM_HALF_WIDTH * ARM_HALF_WIDTH;
            assert!((area.abs() / expected - 1.0).abs() < 0.03, "{area} for {expected}");
        }
        let gap = NORTH_ARM[3].distance(SOUTH_ARM[3]) - 2.0 * ARM_HALF_WIDTH;
        assert!((40.0..60.0).contains(&gap), "{gap}");
    }
}

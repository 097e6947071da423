//! The breakwaters: a swept mound of rubble with a concrete crest, and blocks of rock on its slopes.

use glam::{Mat3, Quat, Vec2, Vec3};
use water_view::MeshData;

use super::plan::{ARM_PROFILE, NORTH_ARM, SOUTH_ARM, arm_outline};
use crate::Dice;

const CONCRETE: [u8; 4] = [176, 172, 162, 8];
const CORE: [u8; 4] = [74, 72, 68, 20];

/// Corners of an icosahedron, and its faces.
const GOLDEN: f32 = 1.618_034;
const CORNERS: [[f32; 3]; 12] = [
    [-1.0, GOLDEN, 0.0],
    [1.0, GOLDEN, 0.0],
    [-1.0, -GOLDEN, 0.0],
    [1.0, -GOLDEN, 0.0],
    [0.0, -1.0, GOLDEN],
    [0.0, 1.0, GOLDEN],
    [0.0, -1.0, -GOLDEN],
    [0.0, 1.0, -GOLDEN],
    [GOLDEN, 0.0, -1.0],
    [GOLDEN, 0.0, 1.0],
    [-GOLDEN, 0.0, -1.0],
    [-GOLDEN, 0.0, 1.0],
];
#[rustfmt::skip]
const FACES: [[usize; 3]; 20] = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
    [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
];

/// A block of rock about `size` metres wide.
pub(super) fn rock(data: &mut MeshData, at: Vec3, size: f32, dice: &mut Dice, wet: f32) {
    let turn =
        Mat3::from_quat(
            Quat::from_rotation_y(std::f32::consts::TAU * dice.roll())
                * Quat::from_rotation_x(std::f32::consts::TAU * dice.roll()),
        ) * Mat3::from_diagonal(Vec3::new(0.7 + 0.6 * dice.roll(), 0.6 + 0.3 * dice.roll(), 0.7 + 0.5 * dice.roll()));
    let corners = CORNERS.map(|c| at + turn * (Vec3::from(c) * (0.26 * size * (0.75 + 0.5 * dice.roll()))));
    let shade = 0.72 + 0.5 * dice.roll();
    for face in FACES {
        let triangle = face.map(|k| corners[k]);
        let low = (triangle[0].y + triangle[1].y + triangle[2].y) / 3.0;
        let dark = if low < wet { 0.55 } else { 1.0 };
        let c = |v: f32| (v * shade * dark).clamp(0.0, 255.0) as u8;
        data.triangle(triangle, [c(138.0), c(132.0), c(122.0), if low < wet { 70 } else { 6 }]);
    }
}

/// A lumpy ball of these half sizes, shaded smooth.
pub(super) fn blob(data: &mut MeshData, at: Vec3, half: Vec3, dice: &mut Dice, color: [u8; 4]) {
    let turn = Quat::from_rotation_y(std::f32::consts::TAU * dice.roll());
    let base = data.vertices.len() as u32;
    for c in CORNERS {
        let out = turn * Vec3::from(c).normalize();
        let position = (at + half * out * (0.85 + 0.3 * dice.roll())).into();
        data.vertices.push(water_view::MeshVertex { position, normal: out.into(), color });
    }
    data.indices.extend(FACES.iter().flatten().map(|k| base + *k as u32));
}

fn mound(data: &mut MeshData, axis: &[Vec2]) {
    let rings: Vec<Vec<Vec3>> = ARM_PROFILE
        .iter()
        .map(|&(half, y)| arm_outline(axis, half).iter().map(|p| Vec3::new(p.x, y, p.y)).collect())
        .collect();
    let n = rings[0].len();
    for (ring, pair) in rings.windows(2).enumerate() {
        for i in 0..n {
            let k = (i + 1) % n;
            let color = if ring == 0 { CONCRETE } else { CORE };
            data.triangle([pair[0][i], pair[1][i], pair[0][k]], color);
            data.triangle([pair[0][k], pair[1][i], pair[1][k]], color);
        }
    }
    // The crest: quads across the axis, then a fan over the head.
    let top = &rings[0];
    let across = axis.len();
    for i in 0..across - 1 {
        let (a, b, c, d) = (top[i], top[i + 1], top[n - 2 - i], top[n - 1 - i]);
        data.triangle([a, b, c], CONCRETE);
        data.triangle([a, c, d], CONCRETE);
    }
    for i in across - 1..n - across {
        data.triangle([top[across - 1], top[i], top[i + 1]], CONCRETE);
    }
}

/// A wall on the seaward side of the crest, and a light at the head.
fn crest(data: &mut MeshData, axis: &[Vec2], seaward: f32, light: [u8; 4]) {
    let top = ARM_PROFILE[0].1;
    for pair in axis.windows(2) {
        let along = (pair[1] - pair[0]).normalize();
        let count = (pair[1].distance(pair[0]) / 4.0).round() as usize;
        for i in 0..count {
            let p = pair[0].lerp(pair[1], (i as f32 + 0.5) / count as f32) + seaward * 2.1 * along.perp();
            let mut block = MeshData::default();
            block.cuboid(Vec3::Y * 0.45, Vec3::new(1.95, 0.55, 0.35), CONCRETE);
            let turn = Quat::from_rotation_y(-along.to_angle());
            place(data, &block, Vec3::new(p.x, top, p.y), turn);
        }
    }
    let head = axis[axis.len() - 1];
    let foot = Vec3::new(head.x, top, head.y);
    data.cylinder(foot, foot + Vec3::Y * 0.8, 1.3, 16, CONCRETE);
    for i in 0..6 {
        let color = if i % 2 == 0 { light } else { [232, 230, 222, 30] };
        let low = foot + Vec3::Y * (0.8 + 0.9 * i as f32);
        data.cylinder(low, low + Vec3::Y * 0.9, 0.62 - 0.03 * i as f32, 16, color);
    }
    let lamp = foot + Vec3::Y * 6.2;
    data.cylinder(lamp, lamp + Vec3::Y * 0.12, 0.8, 16, [60, 62, 64, 40]);
    data.cylinder(lamp, lamp + Vec3::Y * 0.8, 0.34, 12, light.map(|c| c.saturating_add(20)));
    data.cylinder(lamp + Vec3::Y * 0.8, lamp + Vec3::Y * 1.05, 0.42, 12, light);
}

/// Adds `part`, turned and moved.
pub(super) fn place(data: &mut MeshData, part: &MeshData, at: Vec3, turn: Quat) {
    let base = data.vertices.len() as u32;
    data.vertices.extend(part.vertices.iter().map(|v| {
        let position = (at + turn * Vec3::from(v.position)).into();
        water_view::MeshVertex { position, normal: (turn * Vec3::from(v.normal)).into(), ..*v }
    }));
    data.indices.extend(part.indices.iter().map(|i| base + i));
}

/// Both breakwaters.
pub fn breakwaters() -> MeshData {
    let mut data = MeshData::default();
    let mut dice = Dice(7);
    for (axis, seaward, light) in [(&NORTH_ARM, -1.0, [196, 34, 28, 120]), (&SOUTH_ARM, 1.0, [24, 128, 62, 120])] {
        mound(&mut data, axis);
        crest(&mut data, axis, seaward, light);
        // Rock on both slopes, from the crest to under water.
        for step in 0..9 {
            let t = step as f32 / 8.0;
            let half = ARM_PROFILE[0].0 + 0.7 + t * (ARM_PROFILE[2].0 + 0.4 - ARM_PROFILE[0].0);
            let y = 2.5 - 3.3 * t;
            let outline = arm_outline(axis, half);
            for pair in outline.windows(2) {
                let count = (pair[0].distance(pair[1]) / 1.35).ceil() as usize;
                for i in 0..count {
                    let jitter = Vec2::new(dice.roll() - 0.5, dice.roll() - 0.5) * 0.9;
                    let p = pair[0].lerp(pair[1], (i as f32 + dice.roll()) / count as f32) + jitter;
                    let size = 1.3 + 1.1 * dice.roll();
                    rock(&mut data, Vec3::new(p.x, y + 0.5 * (dice.roll() - 0.5), p.y), size, &mut dice, 0.45);
                }
            }
        }
    }
    data
}

//! Quay, sheds and jetty.

use glam::{Quat, Vec2, Vec3};
use water_view::MeshData;

use super::arms::place;
use super::plan::{JETTY, JETTY_HALF_WIDTH, JETTY_TOP, PILES, QUAY_HIGH, QUAY_LOW, QUAY_TOP};
use crate::Dice;

const STONE: [u8; 4] = [150, 145, 134, 8];
const WEEDY: [u8; 4] = [70, 74, 56, 60];
const COPING: [u8; 4] = [190, 186, 174, 10];
const PAVING: [u8; 4] = [164, 160, 150, 8];
const RUBBER: [u8; 4] = [34, 34, 36, 30];
const IRON: [u8; 4] = [46, 48, 52, 90];
const TIMBER: [u8; 4] = [126, 102, 74, 8];
const PILE: [u8; 4] = [86, 70, 54, 12];
const ROOFS: [[u8; 4]; 3] = [[150, 62, 44, 20], [88, 98, 108, 60], [116, 76, 52, 20]];
const SIDES: [[u8; 4]; 3] = [[214, 206, 186, 10], [150, 166, 170, 30], [190, 160, 120, 10]];

/// Places of the quay's bollards, on its edge: foot of each, local metres.
pub fn bollards() -> Vec<Vec3> {
    (0..12).map(|i| Vec3::new(QUAY_LOW.x + 6.0 + 10.0 * i as f32, QUAY_TOP, QUAY_HIGH.y - 0.9)).collect()
}

/// Places of the jetty's piles: top of each, local metres.
pub fn piles() -> Vec<Vec3> {
    let length = JETTY[0].distance(JETTY[1]);
    let count = (length / PILES.0).floor() as usize;
    let along = (JETTY[0] - JETTY[1]).normalize();
    (0..=count)
        .flat_map(|i| [-1.0, 1.0].map(|side| (i, side)))
        .map(|(i, side)| {
            let p = JETTY[1] + along * (0.4 + PILES.0 * i as f32) + side * JETTY_HALF_WIDTH * along.perp();
            let top = if i % 2 == 0 { JETTY_TOP + 1.0 } else { JETTY_TOP - 0.05 };
            Vec3::new(p.x, top, p.y)
        })
        .collect()
}

fn bollard(data: &mut MeshData, foot: Vec3) {
    data.cylinder(foot, foot + Vec3::Y * 0.5, 0.17, 10, IRON);
    data.cylinder(foot + Vec3::Y * 0.42, foot + Vec3::Y * 0.58, 0.27, 10, IRON);
}

/// A shed with a gabled roof, its ridge along x: size, colours by `kind`.
fn shed(size: Vec3, kind: usize) -> MeshData {
    let mut data = MeshData::default();
    let half = 0.5 * size;
    data.cuboid(Vec3::Y * half.y, half, SIDES[kind]);
    let (eave, rise) = (0.45, 0.34 * size.z);
    let corner = |x: f32, z: f32| Vec3::new(x * (half.x + eave), size.y - 0.12, z * (half.z + eave));
    let ridge = |x: f32| Vec3::new(x * (half.x + eave), size.y + rise, 0.0);
    for z in [-1.0, 1.0] {
        let quad = [corner(-1.0, z), corner(1.0, z), ridge(1.0), ridge(-1.0)];
        data.triangle([quad[0], quad[1], quad[2]], ROOFS[kind]);
        data.triangle([quad[0], quad[2], quad[3]], ROOFS[kind]);
    }
    for x in [-1.0, 1.0] {
        let gable = |z: f32| Vec3::new(x * half.x, size.y - 0.1, z * half.z);
        data.triangle([gable(-1.0), gable(1.0), Vec3::new(x * half.x, size.y + rise - 0.1, 0.0)], SIDES[kind]);
    }
    // Doors towards the water.
    for i in 0..3 {
        let x = half.x * (-0.6 + 0.6 * i as f32);
        data.cuboid(Vec3::new(x, 1.6, half.z + 0.03), Vec3::new(1.5, 1.6, 0.05), [70, 84, 96, 40]);
    }
    data
}

/// A small slewing crane.
fn crane() -> MeshData {
    let mut data = MeshData::default();
    let yellow = [212, 158, 32, 70];
    data.cuboid(Vec3::Y * 0.4, Vec3::new(1.6, 0.4, 1.6), STONE);
    data.cylinder(Vec3::Y * 0.8, Vec3::Y * 6.5, 0.5, 12, yellow);
    data.cuboid(Vec3::new(0.0, 7.0, -0.6), Vec3::new(1.1, 0.9, 1.5), yellow);
    data.cuboid(Vec3::new(0.4, 7.1, 0.95), Vec3::new(0.6, 0.6, 0.06), [60, 76, 84, 255]);
    let (foot, tip) = (Vec3::new(0.0, 7.4, 0.8), Vec3::new(0.0, 12.5, 9.5));
    for x in [-0.45, 0.45] {
        data.cylinder(foot + Vec3::X * x, tip + Vec3::X * 0.3 * x, 0.12, 6, yellow);
    }
    for i in 1..9 {
        let p = foot.lerp(tip, i as f32 / 9.0);
        data.cuboid(p, Vec3::new(0.4, 0.05, 0.05), yellow);
    }
    data.cylinder(tip, tip - Vec3::Y * 5.5, 0.03, 4, IRON);
    data.cuboid(tip - Vec3::Y * 5.7, Vec3::new(0.15, 0.25, 0.15), IRON);
    data
}

/// The quay and what stands on it.
pub fn quay() -> MeshData {
    let mut data = MeshData::default();
    let span = |low: Vec3, high: Vec3, data: &mut MeshData, color| {
        data.cuboid(0.5 * (low + high), 0.5 * (high - low), color);
    };
    let (low, high) = (QUAY_LOW, QUAY_HIGH);
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    // Courses of stone, dark where the water comes.
    let blocks = ((high.x - low.x) / 3.0).round() as usize;
    let width = (high.x - low.x) / blocks as f32;
    let mut dice = Dice(3);
    for row in 0..4 {
        for i in 0..blocks {
            let y = -1.2 + 0.9 * row as f32;
            let shift = 0.5 * width * (row % 2) as f32;
            let (a, b) =
                (low.x + width * i as f32 + shift, (low.x + width * (i + 1) as f32 + shift - 0.05).min(high.x));
            let shade = 0.9 + 0.2 * dice.roll();
            let base = if y < 0.3 { WEEDY } else { STONE };
            let color = std::array::from_fn(|k| if k < 3 { (f32::from(base[k]) * shade) as u8 } else { base[k] });
            span(at(a, y, high.y - 1.0), at(b, y + 0.86, high.y), &mut data, color);
        }
    }
    span(at(low.x, -9.0, low.y), at(high.x, QUAY_TOP - 0.3, high.y - 0.06), &mut data, [92, 90, 80, 10]);
    span(at(low.x, QUAY_TOP - 0.3, low.y), at(high.x, QUAY_TOP, high.y - 1.2), &mut data, PAVING);
    span(at(low.x, QUAY_TOP - 0.32, high.y - 1.2), at(high.x, QUAY_TOP + 0.04, high.y + 0.08), &mut data, COPING);
    for i in 0..(2 * blocks / 3) {
        let x = low.x + 3.0 + 4.5 * i as f32;
        if x < high.x - 1.0 {
            let rim = at(x, 0.9, high.y);
            data.cylinder(rim, rim + Vec3::Z * 0.28, 0.62, 14, RUBBER);
            data.cylinder(rim, rim + Vec3::Z * 0.29, 0.3, 10, WEEDY);
        }
    }
    for foot in bollards() {
        bollard(&mut data, foot);
    }
    for (i, x) in [(0, -8.0), (1, 16.0), (2, 66.0)] {
        place(
            &mut data,
            &shed(at(17.0 + 3.0 * i as f32, 4.6, 9.5), i as usize),
            at(x, QUAY_TOP, -136.0),
            Quat::IDENTITY,
        );
    }
    place(&mut data, &crane(), at(44.0, QUAY_TOP, -117.5), Quat::from_rotation_y(0.5));
    let paints = [[160, 60, 40, 60], [40, 84, 120, 60], [60, 110, 76, 60], [188, 150, 60, 60], [120, 120, 124, 60]];
    for i in 0..11 {
        let (column, layer) = (i % 6, i / 6);
        let center = at(44.0 + 2.9 * column as f32, QUAY_TOP + 1.3 + 2.62 * layer as f32, -134.0);
        data.cuboid(center, at(1.22, 1.3, 3.05), paints[(i * 7 + layer) % 5]);
    }
    for x in [-18.0, 12.0, 58.0, 90.0] {
        let foot = at(x, QUAY_TOP, -116.0);
        data.cylinder(foot, foot + Vec3::Y * 7.5, 0.09, 8, IRON);
        data.cuboid(foot + at(0.0, 7.5, 0.7), at(0.12, 0.06, 0.8), IRON);
    }
    data
}

/// The jetty.
pub fn jetty() -> MeshData {
    let mut data = MeshData::default();
    let length = JETTY[0].distance(JETTY[1]);
    let along = (JETTY[0] - JETTY[1]).normalize();
    let turn = Quat::from_rotation_y(-along.to_angle());
    let at = |s: f32, y: f32, side: f32| {
        let p: Vec2 = JETTY[1] + along * s + side * along.perp();
        Vec3::new(p.x, y, p.y)
    };
    let mut dice = Dice(5);
    let planks = (length / 0.45) as usize;
    for i in 0..planks {
        let mut plank = MeshData::default();
        let shade = 0.85 + 0.3 * dice.roll();
        let color = TIMBER.map(|c| (f32::from(c) * shade) as u8);
        plank.cuboid(Vec3::ZERO, Vec3::new(0.21, 0.05, JETTY_HALF_WIDTH), color);
        place(&mut data, &plank, at(0.22 + 0.45 * i as f32, JETTY_TOP - 0.05, 0.0), turn);
    }
    for side in [-0.8, 0.8] {
        let mut beam = MeshData::default();
        beam.cuboid(Vec3::ZERO, Vec3::new(0.5 * length, 0.18, 0.14), PILE);
        place(&mut data, &beam, at(0.5 * length, JETTY_TOP - 0.28, side * JETTY_HALF_WIDTH), turn);
    }
    for top in piles() {
        let wet = top.with_y(0.55);
        data.cylinder(top.with_y(-7.0), wet, PILES.1 + 0.01, 10, WEEDY);
        data.cylinder(wet, top, PILES.1, 10, PILE);
    }
    for (s, side) in [(1.2, 0.0), (14.0, 1.7), (26.0, -1.7), (38.0, 1.7)] {
        bollard(&mut data, at(s, JETTY_TOP, side));
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harbour::elevation;

    #[test]
    fn works_stand_where_they_should() {
        for foot in bollards() {
            assert!(foot.x > QUAY_LOW.x && foot.x < QUAY_HIGH.x && foot.z < QUAY_HIGH.y, "{foot}");
        }
        let tops = piles();
        let wet = tops.iter().filter(|p| elevation(Vec2::new(p.x, p.z)) < -1.0).count();
        assert!(wet >= 12 && wet < tops.len(), "{wet} of {} piles stand in water", tops.len());
        for mesh in [quay(), jetty(), super::super::breakwaters()] {
            assert!(mesh.indices.iter().all(|i| (*i as usize) < mesh.vertices.len()));
            assert!(mesh.vertices.iter().all(|v| Vec3::from(v.position).is_finite()));
        }
    }
}

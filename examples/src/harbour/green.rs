//! Trees and bushes on the land, where there is grass.

use glam::{Quat, Vec2, Vec3};
use water_view::MeshData;

use super::arms::blob;
use super::bed::noise;
use super::ground::Extent;
use super::plan::{QUAY_HIGH, QUAY_LOW};
use crate::Dice;

/// Tries to plant something.
const TRIES: u32 = 2600;

/// A tree whose foot is at `at`, about `size` metres high.
fn tree(data: &mut MeshData, at: Vec3, size: f32, dice: &mut Dice) {
    let trunk = at + Vec3::Y * (0.4 * size);
    data.cylinder(at - Vec3::Y * 0.4, trunk, 0.035 * size, 6, [78, 62, 46, 6]);
    let shade = 0.8 + 0.4 * dice.roll();
    let leaf = [44.0, 58.0, 28.0].map(|c: f32| (c * shade) as u8);
    for k in 0..3 {
        let turn = Quat::from_rotation_y(2.1 * k as f32 + dice.roll());
        let off = turn * Vec3::new(0.13 * size, 0.0, 0.0) + Vec3::Y * (0.52 + 0.12 * k as f32) * size;
        blob(
            data,
            at + off,
            Vec3::new(0.3, 0.24, 0.3) * size * (0.8 + 0.4 * dice.roll()),
            dice,
            [leaf[0], leaf[1], leaf[2], 4],
        );
    }
}

/// Plants the land of these elevations, for water at `level`.
pub fn green(extent: Extent, level: f32, elevation: impl Fn(Vec2) -> f32) -> MeshData {
    let mut data = MeshData::default();
    let mut dice = Dice(11);
    for _ in 0..TRIES {
        let p = extent.low + (extent.high - extent.low) * Vec2::new(dice.roll(), dice.roll());
        let height = elevation(p);
        let steep =
            Vec2::new(elevation(p + Vec2::X * 3.0) - height, elevation(p + Vec2::Y * 3.0) - height).length() / 3.0;
        let yard = p.x > QUAY_LOW.x - 14.0 && p.x < QUAY_HIGH.x + 10.0 && p.y > QUAY_LOW.y - 50.0 && p.y < QUAY_HIGH.y;
        if height < level + 4.5 || steep > 0.4 || yard {
            continue;
        }
        let foot = Vec3::new(p.x, height, p.y);
        let wood = noise(p / 45.0, 41);
        if wood > 0.12 {
            tree(&mut data, foot, 4.5 + 4.0 * dice.roll() + 3.0 * wood, &mut dice);
        } else if wood > -0.25 && dice.roll() < 0.5 {
            let size = 0.7 + 0.9 * dice.roll();
            blob(&mut data, foot, Vec3::new(size, 0.7 * size, size), &mut dice, [64, 72, 36, 4]);
        }
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn green_stands_on_high_ground_only() {
        let extent = Extent { low: Vec2::splat(-100.0), high: Vec2::splat(100.0), step: 2.0 };
        let data = green(extent, 1.0, |p| 0.2 * p.x);
        assert!(!data.indices.is_empty());
        for v in &data.vertices {
            let p = Vec3::from(v.position);
            assert!(p.y > 2.0 && 0.2 * p.x > 3.5, "{p}");
        }
    }
}

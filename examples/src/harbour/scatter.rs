//! Where flotsam lies at first, the stack of crates on the jetty, and the lines of the moored boat.

use glam::{Vec2, Vec3};

use super::courses::{ferry, near, round};
use super::plan::{BERTH, JETTY, JETTY_TOP, distance, walls};
use super::works::bollards;
use crate::{Dice, Kind};

/// Nothing floats closer to a course or a wall at first, metres.
const CLEAR: f32 = 7.0;
/// Where flotsam floats, and how many pieces: in the basin, outside.
const AREAS: [(Vec2, Vec2, u32); 2] = [
    (Vec2::new(-84.0, -104.0), Vec2::new(120.0, 126.0), 255),
    (Vec2::new(-225.0, -90.0), Vec2::new(-118.0, 110.0), 45),
];
/// Crates on the jetty.
const STACK: usize = 12;

/// Places of 300 pieces in water of more than a metre and a half, clear of walls, courses and the boat at `berth`; fewer
/// where a map has no room.
pub fn afloat(dice: &mut Dice, berth: Vec2, elevation: impl Fn(Vec2) -> f32) -> Vec<Vec2> {
    let (ferry, round) = (ferry(), round());
    let walls: Vec<Vec<Vec2>> =
        walls().iter().map(|wall| wall.iter().chain(wall.first()).map(|p| p.as_vec2()).collect()).collect();
    let free = |p: Vec2| {
        elevation(p) < -1.5
            && p.distance(berth) > 12.0
            && distance(&JETTY, p) > CLEAR
            && walls.iter().all(|wall| distance(wall, p) > CLEAR)
            && !near(&ferry, p, CLEAR)
            && !near(&round, p, CLEAR)
    };
    let mut places = Vec::new();
    for (low, high, count) in AREAS {
        for _ in 0..count {
            let mut tries = (0..400).map(|_| low + (high - low) * Vec2::new(dice.roll(), dice.roll()));
            places.extend(tries.find(|p| free(*p)));
        }
    }
    places
}

/// Crates on the jetty's head in three layers, one of them over the edge: what and where.
pub fn stack() -> [(Kind, Vec3); STACK] {
    std::array::from_fn(|k| {
        let kind = if k < 8 { Kind::Large } else { Kind::Small };
        let (row, layer) = (k % 4, k / 4);
        let over = if k == 8 { 1.9 } else { 0.0 };
        let lift = 0.02 + 2.02 * Kind::Large.half().y * layer as f32 + kind.half().y;
        let at = JETTY[1] + Vec2::new(3.0 + 2.6 * (row / 2) as f32, 1.2 * (row % 2) as f32 - 0.6 + over);
        (kind, Vec3::new(at.x, JETTY_TOP + lift, at.y))
    })
}

/// Bow and stern lines and two springs of a boat at the berth whose hull has these bounds and its deck at this height, hull
/// frame: where each is made fast on board, and on the quay.
pub fn lines((low, high): (Vec3, Vec3), deck: f32) -> [(Vec3, Vec3); 4] {
    [(0.88, 9.0), (0.1, -9.0), (0.75, -4.0), (0.25, 4.0)].map(|(along, reach)| {
        let point = Vec3::new(low.x + along * (high.x - low.x), deck, low.z * if along > 0.8 { 0.5 } else { 0.9 });
        let wanted = BERTH.x + 0.5 * (low.x + high.x) + reach;
        let near = |a: &Vec3, b: &Vec3| (a.x - wanted).abs().total_cmp(&(b.x - wanted).abs());
        let anchor = bollards().into_iter().min_by(near).unwrap_or(Vec3::ZERO);
        (point, anchor + Vec3::Y * 0.45)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harbour::elevation;

    #[test]
    fn three_hundred_pieces_have_room_and_a_dry_map_has_none() {
        let places = afloat(&mut Dice(1), BERTH, elevation);
        assert_eq!(places.len(), 300);
        assert!(places.iter().all(|p| elevation(*p) < -1.5 && p.distance(BERTH) > 12.0));
        assert!(afloat(&mut Dice(1), BERTH, |_| 1.0).is_empty());
    }

    #[test]
    fn lines_lead_to_different_bollards_and_crates_stand_on_the_jetty() {
        let lines = lines((Vec3::new(-4.0, -0.5, -1.2), Vec3::new(4.0, 1.0, 1.2)), 0.5);
        assert!(lines[0].1.x > lines[1].1.x + 10.0, "bow and stern lines lead apart");
        assert!(stack().iter().all(|(_, at)| at.y > JETTY_TOP && (at.z - JETTY[0].y).abs() < 2.6));
    }
}

//! Where the autopilots go: marks (x, z), metres, and the throttle towards each.

use glam::Vec2;

use super::plan::distance;

/// Out by the gap and in again.
pub fn ferry() -> Vec<(Vec2, f32)> {
    [
        (-97.0, 30.0, 0.38),
        (-66.0, 42.0, 0.34),
        (-42.0, 50.0, 0.32),
        (-27.0, 18.0, 0.32),
        (-30.0, -40.0, 0.34),
        (-58.0, -46.0, 0.32),
        (-74.0, -4.0, 0.32),
        (-97.0, 15.0, 0.36),
        (-140.0, 8.0, 0.42),
        (-186.0, -14.0, 0.36),
        (-212.0, 24.0, 0.38),
        (-180.0, 62.0, 0.38),
        (-140.0, 38.0, 0.38),
    ]
    .map(|(x, z, throttle)| (Vec2::new(x, z), throttle))
    .to_vec()
}

/// Round the basin.
pub fn round() -> Vec<(Vec2, f32)> {
    [
        (24.0, -76.0, 0.34),
        (72.0, -78.0, 0.32),
        (92.0, -44.0, 0.34),
        (62.0, 4.0, 0.38),
        (60.0, 64.0, 0.34),
        (40.0, 98.0, 0.32),
        (18.0, 66.0, 0.34),
        (16.0, -30.0, 0.38),
    ]
    .map(|(x, z, throttle)| (Vec2::new(x, z), throttle))
    .to_vec()
}

/// Whether a place is within `clear` metres of a course.
pub fn near(course: &[(Vec2, f32)], p: Vec2, clear: f32) -> bool {
    let line: Vec<Vec2> = course.iter().chain(course.first()).map(|mark| mark.0).collect();
    distance(&line, p) < clear
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harbour::{JETTY, JETTY_HALF_WIDTH, elevation, walls};

    #[test]
    fn courses_keep_clear_of_walls_shallows_and_each_other() {
        let close = |mut course: Vec<(Vec2, f32)>| {
            course.push(course[0]);
            course
        };
        let (ferry, round) = (close(ferry()), close(round()));
        for leg in ferry.windows(2).chain(round.windows(2)) {
            for k in 0..=20 {
                let p = leg[0].0.lerp(leg[1].0, k as f32 / 20.0);
                assert!(elevation(p) < -2.0, "{} m at {p}", elevation(p));
                for wall in walls() {
                    let line: Vec<Vec2> = wall.iter().chain(wall.first()).map(|c| c.as_vec2()).collect();
                    assert!(distance(&line, p) > 10.0, "{p} is {} m from a wall", distance(&line, p));
                }
                assert!(distance(&JETTY, p) > 10.0 + JETTY_HALF_WIDTH, "{p} is near the jetty");
            }
        }
        for (p, _) in &round {
            assert!(!near(&ferry, *p, 30.0), "the courses meet at {p}");
        }
    }
}

//! A boat with its wake, and the course that its autopilot keeps.

use glam::{DVec2, Vec2, Vec3};
use open_water::{BodyId, GridId, OpenWater, Pose};

use crate::strokes::{Stroke, sketch};
use crate::{Mark, Subject};

/// A boat as scenes draw it and as cameras follow it.
#[derive(Debug, Clone)]
pub struct Launch {
    /// Its body.
    pub body: BodyId,
    /// The grid that moves with it; none when moored.
    pub wake: Option<GridId>,
    /// The coarser grid that it lies in, if any.
    pub far: Option<GridId>,
    /// Corners of its hull's bounding box, hull frame, metres.
    pub bounds: (Vec3, Vec3),
    /// Drawn (height, foam) of both, for the view from above.
    cells: [Vec<[f32; 2]>; 2],
}

impl Launch {
    /// A boat.
    pub fn new(body: BodyId, wake: Option<GridId>, bounds: (Vec3, Vec3)) -> Self {
        Self { body, wake, far: None, bounds, cells: Default::default() }
    }

    /// What a camera follows when it is at `pose`.
    pub fn subject(&self, pose: Pose) -> Subject {
        let length = self.bounds.1.x - self.bounds.0.x;
        Subject { position: pose.position, orientation: pose.orientation, length }
    }

    /// Gets ready for [`Self::foam`].
    pub fn look_down(&mut self, water: &OpenWater) {
        for (grid, cells) in [self.wake, self.far].into_iter().zip(&mut self.cells) {
            if let Some(Ok(Some(grid))) = grid.map(|grid| water.grid(grid)) {
                let [nx, nz] = grid.desc().cells;
                cells.resize((nx * nz) as usize, [0.0; 2]);
                grid.draw(1.0, cells);
            }
        }
    }

    /// Foam of its wake at a place, 0 to 1.
    pub fn foam(&self, water: &OpenWater, at: Vec2) -> f32 {
        [self.wake, self.far].into_iter().zip(&self.cells).map(|(grid, cells)| foam(water, grid, cells, at)).sum()
    }

    /// What acts on it, as the last tick left it.
    pub fn strokes(&self, water: &OpenWater) -> Vec<Stroke> {
        let length = 0.5 * (self.bounds.1.x - self.bounds.0.x);
        water.explain(self.body).map_or(Vec::new(), |told| sketch(&told, length))
    }

    /// Its outline from above at `pose`.
    pub fn mark(&self, pose: Pose) -> Mark {
        let (low, high) = self.bounds;
        let side = |x: f32, z: f32| (low.x + x * (high.x - low.x), low.z + z * (high.z - low.z));
        let shape = [
            side(0.0, 0.0),
            side(0.6, 0.0),
            side(0.85, 0.2),
            side(1.0, 0.5),
            side(0.85, 0.8),
            side(0.6, 1.0),
            side(0.0, 1.0),
        ];
        Mark::of(pose, &shape, [235, 235, 230])
    }
}

/// Foam of a grid whose drawn cells are these, at a place, 0 to 1.
fn foam(water: &OpenWater, grid: Option<GridId>, cells: &[[f32; 2]], at: Vec2) -> f32 {
    let Some(Ok(Some(grid))) = grid.map(|grid| water.grid(grid)) else { return 0.0 };
    let desc = grid.desc();
    let cell = (at - grid.window().local_corner(DVec2::ZERO)) / Vec2::from(desc.cell_size);
    let inside = cell.cmpge(Vec2::ZERO).all() && cell.x < desc.cells[0] as f32 && cell.y < desc.cells[1] as f32;
    let index = cell.y as usize * desc.cells[0] as usize + cell.x as usize;
    if inside { cells.get(index).map_or(0.0, |cell| cell[1]) } else { 0.0 }
}

/// A closed course from mark to mark.
#[derive(Debug, Clone)]
pub struct Course {
    /// Marks (x, z), local metres, and the throttle towards each.
    marks: Vec<(Vec2, f32)>,
    next: usize,
}

impl Course {
    /// Starts along the leg that is nearest to `place`. There must be two marks at least; a course of fewer steers
    /// nowhere.
    pub fn new(marks: Vec<(Vec2, f32)>, place: Vec2) -> Self {
        let n = marks.len().max(1);
        let off = |next: usize| {
            let (from, to) = (marks[(next + n - 1) % n].0, marks[next].0);
            let along = ((place - from).dot(to - from) / (to - from).length_squared().max(1e-6)).clamp(0.0, 1.0);
            place.distance(from.lerp(to, along))
        };
        let next = (0..marks.len()).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(0);
        Self { marks, next }
    }

    /// Throttle and rudder, 0.6 of it at most, for a boat at `position` that points along `forward`. It aims at a point a little ahead on the
    /// leg, so it comes back onto it; a mark counts as passed half that distance before.
    pub fn steer(&mut self, position: Vec3, forward: Vec3) -> [f32; 2] {
        const AHEAD: f32 = 16.0;
        let n = self.marks.len();
        if n < 2 {
            return [0.0; 2];
        }
        let at = Vec2::new(position.x, position.z);
        let ahead = Vec2::new(forward.x, forward.z).normalize_or(Vec2::X);
        for _ in 0..n {
            let (from, to) = (self.marks[(self.next + n - 1) % n].0, self.marks[self.next].0);
            let leg = to - from;
            let left = leg.length() - (at - from).dot(leg.normalize_or(Vec2::X));
            if left > 0.5 * AHEAD {
                break;
            }
            self.next = (self.next + 1) % n;
        }
        let (from, (to, throttle)) = (self.marks[(self.next + n - 1) % n].0, self.marks[self.next]);
        let (leg, length) = ((to - from).normalize_or(Vec2::X), from.distance(to));
        let along = ((at - from).dot(leg) + AHEAD).min(length);
        let aim = (from + leg * along - at).normalize_or(leg);
        let turn = ahead.angle_to(aim);
        // Slower round the corners.
        let throttle = throttle * (1.0 - 0.35 * (turn.abs() / 1.2).min(1.0));
        [throttle, (1.1 * turn).clamp(-0.6, 0.6)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_boat_that_turns_with_its_rudder_rounds_the_marks() {
        let marks = [(0.0, 0.0), (80.0, 0.0), (80.0, 60.0), (0.0, 60.0)].map(|(x, z)| (Vec2::new(x, z), 0.5));
        let mut course = Course::new(marks.to_vec(), Vec2::new(2.0, -6.0));
        assert_eq!(course.next, 1);
        let (mut at, mut heading) = (Vec2::new(2.0, -6.0), 0.0f32);
        let mut far = 0.0f32;
        let mut passed = std::collections::BTreeSet::new();
        for _ in 0..2400 {
            let forward = Vec2::from_angle(heading);
            let [throttle, rudder] = course.steer(Vec3::new(at.x, 0.0, at.y), Vec3::new(forward.x, 0.0, forward.y));
            assert!((0.0..=0.5).contains(&throttle) && rudder.abs() <= 0.6);
            heading += 0.7 * rudder / 30.0;
            at += forward * (10.0 * throttle / 30.0);
            let out = (Vec2::new(40.0, 30.0) - at).abs() - Vec2::new(40.0, 30.0);
            far = far.max(out.max_element());
            passed.insert(course.next);
        }
        assert_eq!(passed.len(), 4, "every mark was steered for");
        assert!(far < 9.0, "{far} m outside of the course");
    }

    #[test]
    fn a_course_of_one_mark_goes_nowhere() {
        assert_eq!(Course::new(vec![(Vec2::ONE, 1.0)], Vec2::ZERO).steer(Vec3::ZERO, Vec3::X), [0.0; 2]);
        assert_eq!(Course::new(Vec::new(), Vec2::ZERO).steer(Vec3::ZERO, Vec3::X), [0.0; 2]);
    }
}

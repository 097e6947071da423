//! Hulls in a grid on the GPU: next to one that makes way the water is nearly steady as seen from it, however fast it
//! changes in a place.
//!
//! There heights are looked up where they were seen from the hull when they were copied, and the line through two copies
//! carries them on. What a hull has done since the copy is known to the tick, so turns and stops are in.

use std::collections::VecDeque;

use floating_body::Body;
use glam::{DVec2, Vec2, Vec3};

use super::carry::{belief, smoothstep};
use super::copies::{Field, Value};
use crate::BodyId;

/// Places of each hull that are kept: of the age from which nothing is carried on, and of the older copy.
const KEPT: usize = 64;
/// What a hull tells the water is spread over so many cells around it.
const AROUND: f32 = 4.0;
/// Share of the ellipse around a hull, beyond it, in which the steady water ends.
const ENDS: f32 = 0.5;
/// Most hulls with which water moves, the largest: every sample asks all of them.
const MOST: usize = 16;
/// Cells a second up to which a hull is so slow that the parabola follows in every place, and from which the water moves along.
const SLOW: f32 = 6.0;
const FAST: f32 = 12.0;

/// A hull after a tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hull {
    id: BodyId,
    /// Half its length and width, metres.
    half: Vec2,
    pose: Pose,
}

/// World place of a hull's middle, metres, and where its bow points.
#[derive(Debug, Clone, Copy)]
struct Pose {
    place: DVec2,
    heading: DVec2,
}

impl Hull {
    /// Of a body; `origin` is the world place of what is local.
    pub(crate) fn of(id: BodyId, body: &Body, origin: DVec2) -> Self {
        let (state, desc) = (body.state(), body.desc());
        let (low, high) = desc.hull.bounds();
        let middle = state.position + state.orientation * (0.5 * (low + high) - desc.center_of_mass);
        let plan = |v: Vec3| Vec2::new(v.x, v.z);
        let heading = plan(state.orientation * Vec3::X).as_dvec2().normalize_or(DVec2::X);
        let pose = Pose { place: origin + plan(middle).as_dvec2(), heading };
        Self { id, half: 0.5 * plan(high - low), pose }
    }
}

/// Where a hull was after the last ticks, one after the other.
#[derive(Debug)]
struct Path {
    hull: Hull,
    poses: VecDeque<Pose>,
}

impl Path {
    fn new(hull: Hull) -> Self {
        Self { hull, poses: VecDeque::with_capacity(KEPT) }
    }

    /// One that was put elsewhere has not gone there.
    fn go(&mut self, hull: Hull, at_once: bool) {
        let gone = |last: &Pose| {
            let near = last.place.distance(hull.pose.place) < f64::from(hull.half.max_element());
            at_once && near && last.heading.dot(hull.pose.heading) > 0.5
        };
        if !self.poses.back().is_some_and(gone) {
            self.poses.clear();
        }
        if self.poses.len() == KEPT {
            self.poses.pop_front();
        }
        self.poses.push_back(hull.pose);
        self.hull = hull;
    }

    fn ago(&self, ticks: u64) -> Option<&Pose> {
        let back = usize::try_from(ticks).ok()?.checked_add(1)?;
        self.poses.get(self.poses.len().checked_sub(back)?)
    }
}

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Hulls {
    /// In the order in which the hulls were told.
    paths: Vec<Path>,
    /// The tick that was told last.
    tick: u64,
    /// Around those that make way.
    frames: Vec<Frame>,
}

impl Hulls {
    /// The hulls in the grid after a tick.
    pub(super) fn go(&mut self, tick: u64, hulls: &[Hull]) {
        let at_once = tick == self.tick + 1;
        self.tick = tick;
        for (at, hull) in hulls.iter().enumerate() {
            // They come in the same order as a rule.
            let found = (at..self.paths.len()).find(|k| self.paths[*k].hull.id == hull.id);
            let from = found.unwrap_or_else(|| {
                self.paths.push(Path::new(*hull));
                self.paths.len() - 1
            });
            self.paths.swap(at, from);
            self.paths[at].go(*hull, at_once);
        }
        self.paths.truncate(hulls.len());
        self.frames.clear();
    }

    /// Carries on over `age` ticks of `dt` seconds from a copy with one that is `older` ticks older, of cells of these sizes.
    pub(super) fn carry(&mut self, age: u64, older: u64, dt: f32, cell_size: [f32; 2]) {
        let frames = self.paths.iter().filter_map(|path| Frame::new(path, age, older, dt, cell_size.into()));
        self.frames.extend(frames);
        if self.frames.len() > MOST {
            self.frames.sort_unstable_by(|a, b| b.axes.length_squared().total_cmp(&a.axes.length_squared()));
            self.frames.truncate(MOST);
        }
    }

    /// How much of the water at a world place moves along with a hull, and around which.
    pub(super) fn around(&self, place: DVec2) -> Option<(f32, &Frame)> {
        let shares = self.frames.iter().map(|frame| (frame.share(place), frame));
        shares.filter(|(share, _)| *share > 0.0).max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// What moves along with a hull.
#[derive(Debug)]
pub(super) struct Frame {
    now: Pose,
    /// Where it was when the copies were made, and how it had to turn to get there, as a complex number.
    then: [(DVec2, DVec2); 2],
    /// Factors on the heights of the copies.
    value: [f32; 2],
    rate: [f32; 2],
    /// Metres and radians a second.
    velocity: Vec2,
    spin: f32,
    /// Half axes of the ellipse in which the water moves along, metres.
    axes: Vec2,
    belief: f32,
}

impl Frame {
    fn new(path: &Path, age: u64, older: u64, dt: f32, cell_size: Vec2) -> Option<Self> {
        let [now, last] = [path.ago(0)?, path.ago(1)?];
        let way = (now.place - last.place).as_vec2();
        let belief = belief(age, dt) as f32 * smoothstep(((way / cell_size).length() / dt - SLOW) / (FAST - SLOW));
        if belief <= 0.0 {
            return None;
        }
        let then = |then: &Pose| (then.place, then.heading.rotate(conjugate(now.heading)));
        let (ahead, m) = (age as f32 / older as f32, older as f32 * dt);
        Some(Self {
            now: *now,
            then: [then(path.ago(age)?), then(path.ago(age.checked_add(older)?)?)],
            value: [1.0 + ahead, -ahead],
            rate: [1.0 / m, -1.0 / m],
            velocity: way / dt,
            spin: last.heading.perp_dot(now.heading) as f32 / dt,
            axes: path.hull.half + AROUND * cell_size.max_element(),
            belief,
        })
    }

    fn share(&self, place: DVec2) -> f32 {
        let seen = (place - self.now.place).rotate(conjugate(self.now.heading)).as_vec2();
        self.belief * smoothstep((1.0 + ENDS - (seen / self.axes).length()) / ENDS)
    }

    /// What is expected at a world place, of the newest field and the older one; `None` where one of them does not tell.
    pub(super) fn value(&self, place: DVec2, fields: [Field<'_>; 2]) -> Option<Value> {
        let from = place - self.now.place;
        let mut sum = Value::default();
        for (k, field) in fields.into_iter().enumerate() {
            let (then, turn) = self.then[k];
            let found = field.at(then + turn.rotate(from))?;
            sum.height += self.value[k] * found.height;
            sum.slope += self.value[k] * conjugate(turn).as_vec2().rotate(found.slope);
            sum.rate += self.rate[k] * found.height;
        }
        let velocity = self.velocity + self.spin * from.as_vec2().perp();
        sum.rate -= velocity.dot(sum.slope);
        Some(sum)
    }
}

fn conjugate(turn: DVec2) -> DVec2 {
    DVec2::new(turn.x, -turn.y)
}

#[cfg(test)]
mod tests;

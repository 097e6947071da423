//! Eight pieces, structure of arrays, and what a single one is when it moves from place to place.

use glam::{Quat, Vec2, Vec3};

use super::lanes::{LANES, Row};
use crate::BodyState;
use crate::forces::LocalWater;

/// A change of slope is believed that was seen over no longer than this, s, and up to so much of it, 1/s.
const TRUSTED: (f32, f32) = (0.15, 2.0);

/// The plane of water under a piece, as it was read `age` s ago.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Plane {
    pub(super) water: LocalWater,
    /// Slope of the height without the home grid's waves.
    pub(super) ambient: Vec2,
    /// How fast the slope changes under the piece, 1/s.
    pub(super) turning: Vec2,
    /// s.
    pub(super) age: f32,
}

/// What a piece has told the water.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Told {
    pub(super) at: Vec2,
    /// m^3; negative if it has told nothing.
    pub(super) volume: f32,
}

impl Told {
    const NOTHING: Self = Self { at: Vec2::ZERO, volume: -1.0 };
}

/// All that a piece is.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Piece {
    pub(super) state: BodyState,
    /// Pose at the tick before.
    pub(super) before: (Vec3, Quat),
    pub(super) plane: Plane,
    /// For how long it has hardly moved, s.
    pub(super) quiet: f32,
    /// Immersed volume, m^3.
    pub(super) immersed: f32,
    pub(super) told: Told,
    /// Told before that.
    pub(super) told_before: Told,
}

impl Piece {
    /// Just placed.
    pub(super) fn new(state: BodyState) -> Self {
        let before = (state.position, state.orientation);
        let (plane, told) = (Plane::default(), Told::NOTHING);
        Self { state, before, plane, quiet: 0.0, immersed: 0.0, told, told_before: told }
    }

    /// Moves with the local origin.
    pub(super) fn rebase(&mut self, offset: Vec2) {
        let shift = Vec3::new(offset.x, 0.0, offset.y);
        self.state.position -= shift;
        self.before.0 -= shift;
        for at in [&mut self.plane.water.at, &mut self.told.at, &mut self.told_before.at] {
            *at -= offset;
        }
    }

    /// Put elsewhere: far away it starts without a splash where it now is.
    pub(super) fn moved(&self, state: BodyState, far: f32) -> Self {
        let jumped = state.position.distance(self.state.position) > far;
        let told = if jumped { Told::NOTHING } else { self.told };
        let before = if jumped { (state.position, state.orientation) } else { self.before };
        Self { state, before, plane: Plane::default(), quiet: 0.0, told, ..*self }
    }
}

/// Eight pieces.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Pack {
    pub(super) position: [Row; 3],
    pub(super) orientation: [Row; 4],
    pub(super) velocity: [Row; 3],
    pub(super) spin: [Row; 3],
    /// Pose at the tick before: position, orientation.
    pub(super) before: ([Row; 3], [Row; 4]),
    /// Where the plane's height holds, x and z.
    pub(super) center: [Row; 2],
    /// Without and of the home grid, and of the still water.
    pub(super) height: Row,
    pub(super) own: Row,
    pub(super) level: Row,
    pub(super) ambient: [Row; 2],
    pub(super) slope: [Row; 2],
    pub(super) turning: [Row; 2],
    pub(super) flow: [Row; 3],
    pub(super) acceleration: Row,
    pub(super) decay: Row,
    pub(super) age: Row,
    pub(super) quiet: Row,
    pub(super) immersed: Row,
    /// Of what was told last, and before.
    pub(super) told: [[Row; 3]; 2],
    /// The plane is to be read before the next tick.
    pub(super) fresh: bool,
}

fn get3(rows: &[Row; 3], lane: usize) -> Vec3 {
    Vec3::new(rows[0][lane], rows[1][lane], rows[2][lane])
}

fn set3(rows: &mut [Row; 3], lane: usize, v: Vec3) {
    (rows[0][lane], rows[1][lane], rows[2][lane]) = (v.x, v.y, v.z);
}

fn get4(rows: &[Row; 4], lane: usize) -> Quat {
    Quat::from_xyzw(rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane])
}

fn set4(rows: &mut [Row; 4], lane: usize, q: Quat) {
    (rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]) = (q.x, q.y, q.z, q.w);
}

impl Pack {
    /// Eight pieces that nobody sees.
    pub(super) fn empty() -> Self {
        let zero = [0.0; LANES];
        let upright = [zero, zero, zero, [1.0; LANES]];
        Self {
            position: [zero; 3],
            orientation: upright,
            velocity: [zero; 3],
            spin: [zero; 3],
            before: ([zero; 3], upright),
            center: [zero; 2],
            height: zero,
            own: zero,
            level: zero,
            ambient: [zero; 2],
            slope: [zero; 2],
            turning: [zero; 2],
            flow: [zero; 3],
            acceleration: zero,
            decay: zero,
            age: zero,
            quiet: zero,
            immersed: zero,
            told: [[zero; 3]; 2],
            fresh: false,
        }
    }

    pub(super) fn state(&self, lane: usize) -> BodyState {
        BodyState {
            position: get3(&self.position, lane),
            orientation: get4(&self.orientation, lane),
            velocity: get3(&self.velocity, lane),
            angular_velocity: get3(&self.spin, lane),
        }
    }

    pub(super) fn set_state(&mut self, lane: usize, state: &BodyState) {
        set3(&mut self.position, lane, state.position);
        set4(&mut self.orientation, lane, state.orientation);
        set3(&mut self.velocity, lane, state.velocity);
        set3(&mut self.spin, lane, state.angular_velocity);
    }

    pub(super) fn before(&self, lane: usize) -> (Vec3, Quat) {
        (get3(&self.before.0, lane), get4(&self.before.1, lane))
    }

    pub(super) fn set_plane(&mut self, lane: usize, plane: &Plane) {
        let w = &plane.water;
        (self.center[0][lane], self.center[1][lane]) = (w.at.x, w.at.y);
        (self.height[lane], self.own[lane], self.level[lane]) = (w.height, w.own, w.level);
        (self.ambient[0][lane], self.ambient[1][lane]) = (plane.ambient.x, plane.ambient.y);
        (self.slope[0][lane], self.slope[1][lane]) = (w.slope.x, w.slope.y);
        (self.turning[0][lane], self.turning[1][lane]) = (plane.turning.x, plane.turning.y);
        set3(&mut self.flow, lane, w.velocity);
        (self.acceleration[lane], self.decay[lane], self.age[lane]) = (w.acceleration, w.decay, plane.age);
    }

    fn plane(&self, lane: usize) -> Plane {
        let pair = |rows: &[Row; 2]| Vec2::new(rows[0][lane], rows[1][lane]);
        let water = LocalWater {
            at: pair(&self.center),
            height: self.height[lane],
            own: self.own[lane],
            slope: pair(&self.slope),
            velocity: get3(&self.flow, lane),
            acceleration: self.acceleration[lane],
            decay: self.decay[lane],
            level: self.level[lane],
        };
        Plane { water, ambient: pair(&self.ambient), turning: pair(&self.turning), age: self.age[lane] }
    }

    /// Takes a new plane. The slope goes on changing as it has since the last reading, unless that is too long ago.
    pub(super) fn read_plane(&mut self, lane: usize, water: LocalWater, ambient: Vec2) {
        let age = self.age[lane];
        let old = Vec2::new(self.slope[0][lane], self.slope[1][lane]);
        let turning = if age > 0.0 && age <= TRUSTED.0 { (water.slope - old) / age } else { Vec2::ZERO };
        let turning = turning.clamp_length_max(TRUSTED.1);
        self.set_plane(lane, &Plane { water, ambient, turning, age: 0.0 });
    }

    fn told(&self, which: usize, lane: usize) -> Told {
        let v = get3(&self.told[which], lane);
        Told { at: Vec2::new(v.x, v.y), volume: v.z }
    }

    /// What is told now and what was told before.
    pub(super) fn tells(&self, lane: usize) -> (Told, Told) {
        (self.told(0, lane), self.told(1, lane))
    }

    pub(super) fn get(&self, lane: usize) -> Piece {
        let (told, told_before) = self.tells(lane);
        Piece {
            state: self.state(lane),
            before: self.before(lane),
            plane: self.plane(lane),
            quiet: self.quiet[lane],
            immersed: self.immersed[lane],
            told,
            told_before,
        }
    }

    pub(super) fn set(&mut self, lane: usize, piece: &Piece) {
        self.set_state(lane, &piece.state);
        set3(&mut self.before.0, lane, piece.before.0);
        set4(&mut self.before.1, lane, piece.before.1);
        self.set_plane(lane, &piece.plane);
        (self.quiet[lane], self.immersed[lane]) = (piece.quiet, piece.immersed);
        for (rows, told) in self.told.iter_mut().zip([piece.told, piece.told_before]) {
            set3(rows, lane, Vec3::new(told.at.x, told.at.y, told.volume));
        }
    }

    /// Moves with the local origin.
    pub(super) fn rebase(&mut self, offset: Vec2) {
        let [told, before] = &mut self.told;
        for rows in [&mut self.position, &mut self.before.0] {
            rows[0].iter_mut().for_each(|x| *x -= offset.x);
            rows[2].iter_mut().for_each(|z| *z -= offset.y);
        }
        for [x, z, _] in [told, before] {
            x.iter_mut().for_each(|x| *x -= offset.x);
            z.iter_mut().for_each(|z| *z -= offset.y);
        }
        self.center[0].iter_mut().for_each(|x| *x -= offset.x);
        self.center[1].iter_mut().for_each(|z| *z -= offset.y);
    }
}

//! Pieces that ride: seen too small for forces, they follow the water under them.
//!
//! A rider keeps its height over the water and its tilt against it as they were when it began, and drifts with the water. It
//! is a function of time between two readings of its plane, so that a tick costs nothing but the readings, far fewer than
//! those of a piece awake. A new plane takes over smoothly. No pose jumps, neither at a reading nor where riding begins or
//! ends.

use glam::{Quat, Vec2, Vec3};
use rayon::prelude::*;

use super::PieceId;
use super::pack::{Piece, Plane};
use crate::forces::read_plane;
use crate::rotation::{normalized, product};
use crate::{BodyState, GRAVITY, SurfacePatch, WaterSurface};

/// Ticks from one reading of a plane to the next, in those of a piece awake, and the most there may be.
const SELDOM: (usize, usize) = (8, 32);
/// Readings that a thread makes at once.
const BATCH: usize = 64;

/// Ticks between two readings of a rider's plane.
pub(super) fn refresh(awake: usize) -> usize {
    (SELDOM.0 * awake).min(SELDOM.1)
}

/// See the module.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Rider {
    pub(super) id: PieceId,
    /// As it was when it began, with what it has told the water.
    piece: Piece,
    /// From the water's axes to its own.
    relative: Quat,
    /// Of the centre of mass over the water, m.
    above: f32,
    /// Where it was when its plane was read.
    spot: Vec2,
    plane: Plane,
    /// When that was, s.
    since: f64,
    /// What the plane before would have said then: height in m and slope too much. It fades until the next reading.
    excess: (f32, Vec2),
}

/// The rotation that turns up into the normal of a slope, the shortest way.
fn tilt(slope: Vec2) -> Quat {
    let n = Vec3::new(-slope.x, 1.0, -slope.y).normalize();
    normalized([n.z, 0.0, -n.x, 1.0 + n.y])
}

/// Height in m and its rate of a plane that was read `age` s ago: the wave swings on as one of its wavenumber does.
fn swing(plane: &Plane, felt: bool, age: f32) -> (f32, f32) {
    let w = &plane.water;
    let height = if felt { w.height + w.own } else { w.height };
    let (wave, rise) = (height - w.level, w.rise());
    let omega = (GRAVITY * w.decay).sqrt();
    if omega < 0.05 {
        return (height + rise * age, rise);
    }
    let (sin, cos) = (libm::sinf(omega * age), libm::cosf(omega * age));
    (w.level + wave * cos + rise / omega * sin, rise * cos - wave * omega * sin)
}

impl Rider {
    /// Begins to ride at `now` s.
    pub(super) fn new(id: PieceId, piece: Piece, felt: bool, now: f64) -> Self {
        let spot = Vec2::new(piece.state.position.x, piece.state.position.z);
        let mut plane = piece.plane;
        // Where the piece is now, and as the plane is now.
        let w = &mut plane.water;
        let gradient = if felt { w.slope } else { plane.ambient };
        w.height += (w.rise() + 0.5 * w.acceleration * plane.age) * plane.age + gradient.dot(spot - w.at);
        w.velocity.y += w.acceleration * plane.age;
        w.slope += plane.turning * plane.age;
        (w.at, plane.age) = (spot, 0.0);
        let above = piece.state.position.y - swing(&plane, felt, 0.0).0;
        let t = tilt(plane.water.slope);
        let relative = product(Quat::from_xyzw(-t.x, -t.y, -t.z, t.w), piece.state.orientation);
        let excess = (0.0, Vec2::ZERO);
        Self { id, piece, relative, above, spot, plane, since: now, excess }
    }

    /// Where it is and how it moves at `now` s; planes are read every `every` s.
    pub(super) fn state(&self, now: f64, every: f32, felt: bool) -> BodyState {
        let age = (now - self.since) as f32;
        let (height, rate) = swing(&self.plane, felt, age);
        let left = (1.0 - age / every).clamp(0.0, 1.0);
        let flow = self.plane.water.velocity;
        let slope = self.plane.water.slope + self.excess.1 * left;
        let at = self.spot + Vec2::new(flow.x, flow.z) * age;
        let fading = if left > 0.0 { self.excess.0 / every } else { 0.0 };
        BodyState {
            position: Vec3::new(at.x, height + self.excess.0 * left + self.above, at.y),
            orientation: product(tilt(slope), self.relative),
            velocity: Vec3::new(flow.x, rate - fading, flow.z),
            angular_velocity: Vec3::ZERO,
        }
    }

    /// About where it is.
    pub(super) fn place(&self) -> Vec3 {
        Vec3::new(self.spot.x, self.plane.water.height, self.spot.y)
    }

    /// The piece, to be moved by forces again.
    pub(super) fn piece(&self, now: f64, dt: f32, every: f32, felt: bool, far: f32) -> Piece {
        let before = self.state(now - f64::from(dt), every, felt);
        let mut piece = self.piece.moved(self.state(now, every, felt), far);
        piece.before = (before.position, before.orientation);
        piece
    }

    fn read(&mut self, patch: SurfacePatch, now: f64, every: f32, felt: bool) {
        let age = (now - self.since) as f32;
        let left = (1.0 - age / every).clamp(0.0, 1.0);
        let (height, slope) = (swing(&self.plane, felt, age).0, self.plane.water.slope);
        let was = (height + self.excess.0 * left, slope + self.excess.1 * left);
        let flow = self.plane.water.velocity;
        self.spot += Vec2::new(flow.x, flow.z) * age;
        let (water, ambient) = read_plane(self.spot, &patch);
        self.plane = Plane { water, ambient, turning: Vec2::ZERO, age: 0.0 };
        self.since = now;
        self.excess = (was.0 - swing(&self.plane, felt, 0.0).0, was.1 - water.slope);
    }

    pub(super) fn rebase(&mut self, offset: Vec2) {
        self.piece.rebase(offset);
        self.spot -= offset;
        self.plane.water.at -= offset;
    }
}

/// What a tick is like for riders.
pub(super) struct Ride<'a> {
    pub(super) water: &'a dyn WaterSurface,
    /// Of the disc over which the water is averaged, m.
    pub(super) footprint: f32,
    pub(super) felt: bool,
    pub(super) tick: usize,
    /// Ticks from one reading to the next.
    pub(super) refresh: usize,
    pub(super) now: f64,
    /// Time from one reading to the next, s.
    pub(super) every: f32,
}

/// Reads the planes that are due.
pub(super) fn run(ride: &Ride, riders: &mut [Rider]) {
    let size = BATCH * ride.refresh;
    let first = (ride.refresh - ride.tick % ride.refresh) % ride.refresh;
    let one = |riders: &mut [Rider]| {
        let (mut centers, mut patches) = ([Vec2::ZERO; BATCH], [SurfacePatch::default(); BATCH]);
        let mut n = 0;
        for rider in riders.iter().skip(first).step_by(ride.refresh) {
            let flow = rider.plane.water.velocity;
            centers[n] = rider.spot + Vec2::new(flow.x, flow.z) * (ride.now - rider.since) as f32;
            n += 1;
        }
        ride.water.patches(&centers[..n], ride.footprint, &mut patches[..n]);
        for (rider, patch) in riders.iter_mut().skip(first).step_by(ride.refresh).zip(patches) {
            rider.read(patch, ride.now, ride.every, ride.felt);
        }
    };
    if riders.len() <= size {
        one(riders);
    } else {
        riders.par_chunks_mut(size).for_each(one);
    }
}

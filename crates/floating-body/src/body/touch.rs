//! Bed and quays: asked for once a tick, pushed against in every sub-step.

use glam::{Mat3, Vec3};

use super::moorings::Mobility;
use super::{Body, LIMITS};
use crate::contact::{Contact, Feeler, Spring, feelers, sane};
use crate::forces::Pose;
use crate::{BodyDesc, GRAVITY, Touch, WaterSurface};

/// Rounds over all contacts of a sub-step.
const ROUNDS: u32 = 8;

/// What a body touches.
#[derive(Clone, Debug, Default)]
pub(super) struct Solids {
    feelers: Vec<Feeler>,
    /// Where solids were asked for in this tick, and what was there: a plane for the tick.
    at: Vec<Vec3>,
    planes: Vec<Touch>,
    /// Of this sub-step.
    presses: Vec<Press>,
    /// Something is touched in this tick.
    pub(super) near: bool,
}

/// A contact within a sub-step.
#[derive(Clone, Copy, Debug)]
struct Press {
    normal: Vec3,
    arm: Vec3,
    spring: Spring,
    /// Mass felt along the normal, kg.
    mass: f32,
    /// Impulses along and across the normal, N s.
    push: f32,
    rub: Vec3,
}

/// Velocity and rotation, world axes.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    pub(super) velocity: Vec3,
    pub(super) spin: Vec3,
}

impl Motion {
    pub(super) fn at(&self, arm: Vec3) -> Vec3 {
        self.velocity + self.spin.cross(arm)
    }

    /// After an impulse at `arm`.
    fn pushed(self, impulse: Vec3, arm: Vec3, yields: &Mobility, rotation: Mat3) -> Self {
        let change = yields.change(impulse, arm, rotation);
        Self { velocity: self.velocity + change.velocity, spin: self.spin + change.spin }
    }

    /// Twice its kinetic energy, J.
    fn energy(&self, yields: &Mobility, rotation: Mat3) -> f32 {
        let (along, about) = (yields.axes.transpose() * self.velocity, rotation.transpose() * self.spin);
        (along * yields.whole).dot(along) + about.dot(yields.inertia * about)
    }
}

impl Mobility {
    /// What an impulse at `arm` changes.
    pub(super) fn change(&self, impulse: Vec3, arm: Vec3, rotation: Mat3) -> Motion {
        let velocity = self.axes * ((self.axes.transpose() * impulse) / self.whole);
        Motion { velocity, spin: rotation * (self.inverse * (rotation.transpose() * arm.cross(impulse))) }
    }

    /// Speed that a unit impulse along `direction` at `arm` makes there, 1/kg.
    fn yields(&self, direction: Vec3, arm: Vec3, rotation: Mat3) -> f32 {
        self.change(direction, arm, rotation).at(arm).dot(direction)
    }
}

impl Solids {
    pub(super) fn new(desc: &BodyDesc) -> Self {
        if desc.contact.is_none() {
            return Self::default();
        }
        let feelers = feelers(&desc.hull, desc.center_of_mass);
        let count = feelers.len();
        let (at, planes) = (vec![Vec3::ZERO; count], vec![Touch::NONE; count]);
        Self { feelers, at, planes, presses: Vec::with_capacity(count), near: false }
    }

    pub(super) fn ask(&mut self, water: &dyn WaterSurface, pose: &Pose) {
        self.near = false;
        if self.feelers.is_empty() {
            return;
        }
        for (at, feeler) in self.at.iter_mut().zip(&self.feelers) {
            *at = pose.position + feeler.asks(pose.rotation);
        }
        self.near = water.touch(&self.at, &mut self.planes);
    }

    pub(super) fn rebase(&mut self, shift: Vec3) {
        self.at.iter_mut().for_each(|at| *at -= shift);
    }

    /// Finds the contacts of a sub-step that may close within it.
    fn meet(&mut self, contact: &Contact, dt: f32, pose: &Pose, fastest: f32, motion: Motion, yields: &Mobility) {
        self.presses.clear();
        for ((feeler, plane), asked) in self.feelers.iter().zip(&self.planes).zip(&self.at) {
            let Touch { depth, normal } = sane(*plane);
            let Some(arm) = feeler.deepest(pose.rotation, normal).filter(|_| depth.is_finite()) else { continue };
            let depth = depth - normal.dot(pose.position + arm - *asked);
            let came = motion.at(arm).dot(normal);
            if depth <= 0.0 && depth - came * dt <= contact.sink {
                continue;
            }
            let mass = 1.0 / yields.yields(normal, arm, pose.rotation);
            let spring = contact.spring(depth, dt, fastest);
            if mass.is_finite() && came.is_finite() {
                self.presses.push(Press { normal, arm, spring, mass, push: 0.0, rub: Vec3::ZERO });
            }
        }
    }
}

impl Body {
    /// Pushes against what is touched and rubs along it: changes the velocity, and answers with the rotation (body axes)
    /// that comes of `spin`; `start` is how it moved when the sub-step began. Gives no energy but what the springs hold.
    pub(super) fn press(&mut self, dt: f32, pose: &Pose, yields: &Mobility, spin: Vec3, start: Motion) -> Vec3 {
        let Some(contact) = self.desc.contact else { return spin };
        let before = Motion { velocity: self.state.velocity, spin: pose.rotation * spin };
        let fastest = (GRAVITY * contact.sink.max(0.25 * self.reach)).sqrt();
        self.solids.meet(&contact, dt, pose, fastest, before, yields);
        let presses = &mut self.solids.presses;
        if presses.is_empty() {
            return spin;
        }
        let mut motion = before;
        for _ in 0..ROUNDS {
            for p in presses.iter_mut() {
                motion = p.push(motion, yields, pose.rotation);
                motion = p.rub(contact.friction, motion, yields, pose.rotation);
            }
        }
        // Slower than this an impact is a landing. What the weight adds in this sub-step does not bounce: a fall would
        // have it once more on its way down.
        let slow = (GRAVITY * contact.sink).sqrt() + GRAVITY * dt;
        for p in presses.iter_mut().filter(|p| p.push > 0.0) {
            let came = start.at(p.arm).dot(p.normal);
            if came < -slow {
                motion = p.bounce(contact.restitution * came, motion, yields, pose.rotation);
            }
        }
        let motion = keep(start, before, motion, presses, yields, pose.rotation);
        self.state.velocity = motion.velocity.clamp_length_max(LIMITS.0);
        (pose.rotation.transpose() * motion.spin).clamp_length_max(LIMITS.1)
    }
}

impl Press {
    fn push(&mut self, motion: Motion, yields: &Mobility, rotation: Mat3) -> Motion {
        let speed = motion.at(self.arm).dot(self.normal);
        let Spring { bias, mass, ease } = self.spring;
        let whole = (self.push - self.mass * mass * (speed + bias) - ease * self.push).max(0.0);
        let impulse = self.normal * (whole - self.push);
        self.push = whole;
        motion.pushed(impulse, self.arm, yields, rotation)
    }

    /// Coulomb friction: stops what slides, by at most so much of the push.
    fn rub(&mut self, friction: f32, motion: Motion, yields: &Mobility, rotation: Mat3) -> Motion {
        let velocity = motion.at(self.arm);
        let sliding = velocity - self.normal * velocity.dot(self.normal);
        let speed = sliding.length();
        if speed.is_nan() || speed < 1.0e-9 {
            return motion;
        }
        let stop = sliding / -(speed * yields.yields(sliding / speed, self.arm, rotation)) * speed;
        let whole = (self.rub + stop).clamp_length_max(friction * self.push);
        let impulse = whole - self.rub;
        self.rub = whole;
        motion.pushed(impulse, self.arm, yields, rotation)
    }

    /// Newton's rule of impact: `kept` is what is kept of the speed along the normal, m/s.
    fn bounce(&mut self, kept: f32, motion: Motion, yields: &Mobility, rotation: Mat3) -> Motion {
        let speed = motion.at(self.arm).dot(self.normal);
        let whole = (self.push - self.mass * (speed + kept)).max(0.0);
        let impulse = self.normal * (whole - self.push);
        self.push = whole;
        motion.pushed(impulse, self.arm, yields, rotation)
    }
}

/// The motion, held back where several contacts together would give more energy than their springs hold: so much may be the
/// impulses' work on the mean of the motions at the sub-step's `start`, and `before` and `after` them. With `before` alone
/// each bounce would gain what the weight did in its sub-step.
fn keep(start: Motion, before: Motion, after: Motion, presses: &[Press], yields: &Mobility, rotation: Mat3) -> Motion {
    let held: f32 = presses.iter().map(|p| p.mass * p.spring.bias.min(0.0).powi(2)).sum();
    let change = Motion { velocity: after.velocity - before.velocity, spin: after.spin - before.spin };
    let mid = Motion { velocity: 0.5 * (start.velocity + before.velocity), spin: 0.5 * (start.spin + before.spin) };
    let end = Motion { velocity: mid.velocity + change.velocity, spin: mid.spin + change.spin };
    let (whole, square) = (mid.energy(yields, rotation), change.energy(yields, rotation));
    let gain = end.energy(yields, rotation) - whole;
    // Twice the work is s linear + s^2 square at a share s of the change.
    if gain - held <= 1.0e-6 * whole || square <= 0.0 {
        return after;
    }
    let linear = gain - square;
    let share = 0.5 * ((linear * linear + 4.0 * square * held).sqrt() - linear) / square;
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    Motion { velocity: before.velocity + change.velocity * share, spin: before.spin + change.spin * share }
}

//! A tick: either the body moves itself, or it tells the wrench with which a physics engine will move it.

use super::{Body, FINEST, LIMITS, LONGEST_TICK, MOST_SUBSTEPS, Scheme, TELEPORT, Wrench};
use crate::forces::gravity;
use crate::rotation::matrix;
use crate::{Controls, WaterSurface};

impl Body {
    /// One tick of `dt` s on `water`, which is sampled once at the tick's start. Allocates nothing.
    ///
    /// A `dt` that is not positive does nothing; one above 1 s is cut. A state that is not finite is replaced by the
    /// last good one, at rest, and counted in [`Body::resets`].
    pub fn step(&mut self, dt: f32, water: &dyn WaterSurface, controls: &Controls) {
        let omega = (self.stiffness.max_element() + self.mooring_stiffness()).sqrt();
        let count = (dt * omega / FINEST).ceil().clamp(1.0, MOST_SUBSTEPS);
        self.advance(dt, count, Scheme::OWN, water, controls);
    }

    /// As [`Body::step`], but answers with the wrench, constant over the tick, that makes a plain rigid body of this
    /// mass and inertia move so under gravity; [`Body::state`] is then where it will be unless it touches something.
    /// Give the body the engine's state before each tick ([`Body::set_state`]).
    ///
    /// What added mass holds back is in the wrench: `M (M + A)^-1 F - M g` for a force `F` with weight. It is made for
    /// engines that solve a tick in four or more small steps, as Rapier does: forces are taken 0.4 of a tick ahead,
    /// without which the engine's motion would gain energy in every swing.
    pub fn step_wrench(&mut self, dt: f32, water: &dyn WaterSurface, controls: &Controls) -> Wrench {
        self.keep_sane();
        let (resets, velocity, momentum) = (self.resets, self.state.velocity, self.angular_momentum());
        let dt = self.advance(dt, 1.0, Scheme::ENGINE, water, controls);
        if dt <= 0.0 || self.resets != resets {
            return Wrench::default();
        }
        let mass = self.desc.mass;
        Wrench {
            force: (self.state.velocity - velocity) * (mass / dt) - gravity(mass),
            torque: (self.angular_momentum() - momentum) / dt,
        }
    }

    /// Without what the water adds, world axes.
    fn angular_momentum(&self) -> glam::Vec3 {
        let rotation = matrix(self.state.orientation);
        rotation * (self.inertia * (rotation.transpose() * self.state.angular_velocity))
    }

    /// A tick in `count` sub-steps. Returns its length in s, 0 if there was none.
    fn advance(&mut self, dt: f32, count: f32, scheme: Scheme, water: &dyn WaterSurface, controls: &Controls) -> f32 {
        if !(dt > 0.0 && dt.is_finite()) {
            return 0.0;
        }
        let (dt, controls) = (dt.min(LONGEST_TICK), controls.sane());
        self.keep_sane();
        self.read(water);
        // An engine has contacts of its own.
        if scheme.ahead == 0.0 {
            self.solids.ask(water, &self.pose());
        } else {
            self.solids.near = false;
        }
        if self.restart {
            self.memory.iter_mut().for_each(|memory| memory.forget());
            self.measure(0.0, true);
        }
        self.attend(dt);
        let start = self.state.position;
        let h = dt / count;
        let carried = scheme.ahead * h;
        if carried > 0.0 {
            self.carry_water(carried, h);
        }
        self.tensions.fill(0.0);
        for _ in 0..count as u32 {
            self.substep(h, 1.0 / count, scheme, &controls);
        }
        self.keep_sane();
        let jumped = self.state.position.distance(start) > TELEPORT * self.reach + LIMITS.0 * dt;
        self.measure(dt - carried, jumped);
        self.wash = self.propeller_wash(&controls);
        self.good = self.state;
        self.restart = false;
        dt
    }
}

//! A floating body: its state, and one tick of its motion.

mod query;
mod stiffness;

use glam::{Mat3, Quat, Vec2, Vec3};

use self::stiffness::stiffness;
use crate::desc::{Inertia, Radiation, Sampling};
use crate::drag::implicit;
use crate::forces::{LocalWater, Pose, gravity, immerse, read_patch, read_points, resistance_axes};
use crate::hull::Waterline;
use crate::rotation::{matrix, normalized, principal_moments, tumble, turned};
use crate::source::{Column, Displacement};
use crate::{BodyDesc, BodyError, Controls, ForcePoint, Home, SurfaceSample, WaterSurface};

/// Longest tick in s; what is longer is cut.
const LONGEST_TICK: f32 = 1.0;
/// Most sub-steps of one tick; beyond, stiffness is damped implicitly instead.
const MOST_SUBSTEPS: f32 = 32.0;
/// Sub-steps keep the body's highest frequency times their length below this (semi-implicit Euler is stable below 2).
const FINEST: f32 = 0.5;
/// Fastest a body may move (m/s), turn (rad/s) and farthest it may be from the local origin (m).
const LIMITS: (f32, f32, f32) = (200.0, 60.0, 1.0e6);
/// Immersed volume counts for drag and added mass up to this multiple of the volume at rest.
const DEEPEST: f32 = 2.0;
/// A step farther than this many body lengths was a teleport: it tells the water nothing.
const TELEPORT: f32 = 4.0;

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// Centre of mass, local world, m.
    pub position: Vec3,
    /// From hull axes to world axes, unit.
    pub orientation: Quat,
    /// Velocity of the centre of mass, m/s.
    pub velocity: Vec3,
    /// World axes, rad/s.
    pub angular_velocity: Vec3,
}

impl BodyState {
    /// At rest and upright with the centre of mass at `position`.
    pub fn at_rest(position: Vec3) -> Self {
        Self { position, orientation: Quat::IDENTITY, velocity: Vec3::ZERO, angular_velocity: Vec3::ZERO }
    }

    fn is_sane(&self) -> bool {
        let far = self.position.is_finite() && self.position.abs().max_element() <= LIMITS.2;
        let q = self.orientation.to_array();
        far && self.velocity.is_finite() && self.angular_velocity.is_finite() && q.iter().all(|c| c.is_finite())
    }
}

/// A body afloat. Made from a [`BodyDesc`], moved by [`Body::step`].
#[derive(Clone, Debug)]
pub struct Body {
    desc: BodyDesc,
    /// Relative to the centre of mass.
    points: Vec<ForcePoint>,
    inertia: Mat3,
    mismatch: f32,
    waterline: Waterline,
    /// Half the bounding box's diagonal, m.
    reach: f32,
    /// Bounds of the square of the frequencies in heave and in rotation when dry, rad^2/s^2.
    stiffness: Vec2,
    state: BodyState,
    good: BodyState,
    resets: u32,
    /// Positions of the force points and, last, the propeller.
    at: Vec<Vec2>,
    samples: Vec<SurfaceSample>,
    waters: Vec<LocalWater>,
    columns: Vec<Column>,
    /// The state was set from outside: the columns start anew.
    restart: bool,
    wash: Displacement,
    immersed: f32,
    /// The waves of its home grid act on it.
    feels_own: bool,
    /// The waves it makes take its energy away; otherwise its coefficients do.
    radiates: bool,
}

impl Body {
    /// A body floating upright at rest at (0, 0) on still water of height 0.
    ///
    /// # Errors
    /// [`BodyError::InvalidValue`] naming the field of the description that is out of its bounds.
    pub fn new(desc: BodyDesc) -> Result<Self, BodyError> {
        desc.check()?;
        let mut points = desc.force_points()?;
        points.iter_mut().for_each(|p| p.position -= desc.center_of_mass);
        let waterline = desc.hull.waterline(desc.displaced_volume());
        let full = desc.unit_inertia * desc.mass;
        let moments = principal_moments(full);
        let (least, most) =
            (moments.iter().fold(f32::MAX, |a, b| a.min(*b)), moments.iter().fold(0.0_f32, |a, b| a.max(*b)));
        let symmetric = (full - full.transpose()).abs_diff_eq(Mat3::ZERO, 1.0e-3 * most);
        if !(least > 0.0 && most.is_finite() && symmetric) {
            let bound = "symmetric with positive finite principal moments";
            return Err(BodyError::InvalidValue { field: "unit_inertia", value: f64::from(least), bound });
        }
        let mean = (moments[0] + moments[1] + moments[2]) / 3.0;
        let inertia = match desc.inertia {
            Inertia::Full => full,
            Inertia::PreRigid => Mat3::from_diagonal(Vec3::splat(mean)),
        };
        let stiffness = stiffness(&points, &desc, full);
        let (low, high) = desc.hull.bounds();
        let count = points.len() + usize::from(desc.engine.is_some());
        let state = BodyState::at_rest(Vec3::new(0.0, desc.center_of_mass.y - waterline.level, 0.0));
        Ok(Self {
            inertia,
            mismatch: (most - least) / mean,
            waterline,
            reach: 0.5 * (high - low).length(),
            stiffness,
            state,
            good: state,
            resets: 0,
            at: vec![Vec2::ZERO; count],
            samples: vec![SurfaceSample::CALM; count],
            waters: vec![LocalWater::default(); count],
            columns: vec![Column::default(); points.len()],
            restart: true,
            wash: Displacement::default(),
            immersed: 0.0,
            feels_own: false,
            radiates: false,
            points,
            desc,
        })
    }

    /// One tick of `dt` s on `water`, which is sampled once at the tick's start. Allocates nothing.
    ///
    /// A `dt` that is not positive does nothing; one above 1 s is cut. A state that is not finite is replaced by the
    /// last good one, at rest, and counted in [`Body::resets`].
    pub fn step(&mut self, dt: f32, water: &dyn WaterSurface, controls: &Controls) {
        if !(dt > 0.0 && dt.is_finite()) {
            return;
        }
        let (dt, controls) = (dt.min(LONGEST_TICK), controls.sane());
        self.keep_sane();
        self.read(water);
        if self.restart {
            self.measure(0.0, true);
        }
        let start = self.state.position;
        let omega = self.stiffness.max_element().sqrt();
        let count = (dt * omega / FINEST).ceil().clamp(1.0, MOST_SUBSTEPS);
        let h = dt / count;
        for _ in 0..count as u32 {
            self.substep(h, &controls);
        }
        self.keep_sane();
        let jumped = self.state.position.distance(start) > TELEPORT * self.reach + LIMITS.0 * dt;
        self.measure(dt, jumped);
        self.wash = self.propeller_wash(&controls);
        self.good = self.state;
        self.restart = false;
    }

    /// Replaces a broken state by the last good one and clamps speeds.
    fn keep_sane(&mut self) {
        if !self.state.is_sane() {
            self.state = BodyState::at_rest(self.good.position);
            self.state.orientation = self.good.orientation;
            self.resets = self.resets.saturating_add(1);
            self.restart = true;
        }
        self.state.velocity = self.state.velocity.clamp_length_max(LIMITS.0);
        self.state.angular_velocity = self.state.angular_velocity.clamp_length_max(LIMITS.1);
        self.state.orientation = normalized(self.state.orientation.to_array());
    }

    fn pose(&self) -> Pose {
        let BodyState { position, orientation, velocity, .. } = self.state;
        Pose { position, rotation: matrix(orientation), velocity }
    }

    fn read(&mut self, water: &dyn WaterSurface) {
        let (home, by_grid) = (water.home(), self.desc.radiation == Radiation::Grid);
        self.feels_own = home == Home::Shared || (home == Home::Own && by_grid);
        self.radiates = home != Home::None && by_grid;
        let pose = self.pose();
        let spots = self.points.iter().map(|p| p.position);
        let spots = spots.chain(self.desc.engine.map(|e| e.position - self.desc.center_of_mass));
        for (at, spot) in self.at.iter_mut().zip(spots) {
            let world = pose.position + pose.rotation * spot;
            *at = Vec2::new(world.x, world.z);
        }
        match self.desc.sampling {
            Sampling::Points => read_points(water, &self.at, &mut self.samples, &mut self.waters),
            Sampling::Patch => {
                let center = Vec2::new(pose.position.x, pose.position.z);
                read_patch(water, center, self.reach, &self.at, &mut self.waters);
            }
        }
    }

    /// Semi-implicit Euler: forces at the old pose change the velocities, these move the pose. Drag is implicit.
    fn substep(&mut self, dt: f32, controls: &Controls) {
        let (pose, desc) = (self.pose(), &self.desc);
        let own = self.feels_own;
        let wet = immerse(&self.points, &self.waters, &pose, own, desc.water_density);
        let share = (wet.volume / self.waterline.volume).min(DEEPEST);
        let to_body = pose.rotation.transpose();
        let coefficients = if self.radiates { Default::default() } else { desc.coefficients };
        let axes = resistance_axes(pose.rotation, wet.slope, desc.hull.is_blunt());
        let to_axes = axes.transpose();
        let water = to_axes * wet.velocity;
        let velocity = to_axes * self.state.velocity;

        let (engine_force, engine_torque) = self.engine(&pose, velocity - water, controls);
        let added = coefficients.added_mass * share;
        let whole = Vec3::splat(desc.mass) + added;
        let drive = to_axes * (wet.force + gravity(desc.mass) + controls.force + pose.rotation * engine_force)
            + added * (to_axes * Vec3::new(0.0, wet.acceleration, 0.0));
        // What the sub-steps cannot resolve is held back as an implicit step would.
        let held = 1.0 + (self.stiffness.x * dt * dt - FINEST * FINEST).max(0.0);
        let pushed = velocity + drive / (whole * held) * dt - water;
        let rates = (desc.drag.rates(pushed) + coefficients.damping) * share;
        let slowed = implicit(pushed, rates, whole, dt);
        let sideways = whole.z * (slowed.z - pushed.z) / dt;
        self.state.velocity = axes * (slowed + water);

        let lateral = desc.drag.lateral_center - desc.center_of_mass;
        let torque =
            to_body * (wet.torque + controls.torque) + engine_torque + lateral.cross(to_body * axes.z_axis * sideways);
        let inertia = self.inertia + Mat3::from_diagonal(coefficients.added_inertia * share);
        let held = 1.0 + (self.stiffness.y * dt * dt - FINEST * FINEST).max(0.0);
        let turning = to_body * self.state.angular_velocity + inertia.inverse() * torque * (dt / held);
        let spin = turning - wet.spin;
        let rates = (desc.drag.angular_rates(spin, slowed.length()) + coefficients.angular_damping) * share;
        let moments = Vec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
        let turning = (implicit(spin, rates, moments, dt) + wet.spin).clamp_length_max(LIMITS.1);
        let (turning, mean) = match desc.inertia {
            Inertia::Full => tumble(inertia, turning, dt),
            Inertia::PreRigid => (turning, turning),
        };
        self.state.orientation = turned(self.state.orientation, mean * dt);
        self.state.angular_velocity = matrix(self.state.orientation) * turning;
        self.state.position += self.state.velocity * dt;
        self.immersed = wet.volume;
    }

    /// Thrust and rudder in hull axes, and their torque about the centre of mass.
    fn engine(&self, pose: &Pose, through_water: Vec3, controls: &Controls) -> (Vec3, Vec3) {
        let (Some(engine), Some(water)) = (&self.desc.engine, self.waters.last()) else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        let arm = engine.position - self.desc.center_of_mass;
        let at = pose.position + pose.rotation * arm;
        let depth = water.ambient(Vec2::new(at.x, at.z)) - at.y;
        let force = engine.force(controls, through_water.x, depth, self.desc.water_density);
        (force, arm.cross(force))
    }

    /// Foam where the propeller stirs the surface, in proportion to its thrust's share.
    fn propeller_wash(&self, controls: &Controls) -> Displacement {
        let (Some(engine), Some(water)) = (&self.desc.engine, self.waters.last()) else {
            return Displacement::default();
        };
        let pose = self.pose();
        let at = pose.position + pose.rotation * (engine.position - self.desc.center_of_mass);
        let center = Vec2::new(at.x, at.z);
        let foam = controls.throttle.abs() * engine.immersion(water.ambient(center) - at.y);
        Displacement { center, radius: 2.0 * engine.radius, volume: 0.0, foam }
    }

    /// Compares the displaced columns with those last told.
    fn measure(&mut self, age: f32, restart: bool) {
        let pose = self.pose();
        for ((column, point), water) in self.columns.iter_mut().zip(&self.points).zip(&self.waters) {
            column.measure(point, water, &pose, age, self.reach, restart);
        }
    }

    /// Appends what the last step changed in the water: for each column the volume now displaced (+) and the one that
    /// was (-). The first step after [`Body::set_state`] or a teleport starts from the new place without a splash.
    pub fn displacements(&self, out: &mut Vec<Displacement>) {
        for (column, point) in self.columns.iter().zip(&self.points) {
            column.tell(point, out);
        }
        if self.wash.foam > 0.0 {
            out.push(self.wash);
        }
    }

    /// Where it is and how it moves.
    pub fn state(&self) -> BodyState {
        self.state
    }

    /// Places the body, for a spawn, a teleport or a host's own physics. A state that is not finite, or farther than
    /// 1000 km away, is ignored and counted.
    pub fn set_state(&mut self, state: BodyState) {
        if !state.is_sane() {
            self.resets = self.resets.saturating_add(1);
            return;
        }
        let moved = state.position.distance(self.state.position);
        self.restart |= moved > TELEPORT * self.reach;
        self.state = state;
        self.keep_sane();
        self.good = self.state;
    }

    /// Shifts the local origin by `offset` m (x, z) without disturbing anything: what was at `offset` is at 0.
    pub fn rebase(&mut self, offset: Vec2) {
        let shift = Vec3::new(offset.x, 0.0, offset.y);
        self.state.position -= shift;
        self.good.position -= shift;
        self.columns.iter_mut().for_each(|c| c.rebase(offset));
        self.wash.center -= offset;
    }
}

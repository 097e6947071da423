//! A sub-step: the water is read once a tick, forces are summed at a pose, velocities and pose follow.

use glam::{Mat3, Vec2, Vec3};

use super::moorings::Mobility;
use super::touch::Motion;
use super::{Body, BodyState, DEEPEST, FINEST, LIMITS, Scheme};
use crate::desc::{Inertia, Radiation, Sampling};
use crate::drag::implicit;
use crate::forces::{Pose, Wetness, gravity, immerse, read_patch, read_points, resistance_axes};
use crate::rotation::{matrix, tumble, turned};
use crate::source::Displacement;
use crate::wind::believed;
use crate::{Controls, Home, WaterSurface};

impl Body {
    pub(super) fn pose(&self) -> Pose {
        let BodyState { position, orientation, velocity, .. } = self.state;
        Pose { position, rotation: matrix(orientation), velocity }
    }

    /// Where the body is `time` s later with its present velocities.
    fn pose_after(&self, time: f32) -> Pose {
        let BodyState { position, orientation, velocity, angular_velocity } = self.state;
        let turning = matrix(orientation).transpose() * angular_velocity;
        Pose { position: position + velocity * time, rotation: matrix(turned(orientation, turning * time)), velocity }
    }

    pub(super) fn read(&mut self, water: &dyn WaterSurface) {
        let (home, by_grid) = (water.home(), self.desc.radiation == Radiation::Grid);
        let pose = self.pose();
        let by_textures = self.read_textures(water, home != Home::None && by_grid, &pose);
        self.feels_own = !by_textures && (home == Home::Shared || (home == Home::Own && by_grid));
        self.radiates = !by_textures && home != Home::None && by_grid;
        let spots = self.points.iter().map(|p| p.position);
        let spots = spots.chain(self.desc.engine.map(|e| e.position - self.desc.center_of_mass));
        for (at, spot) in self.at.iter_mut().zip(spots) {
            let world = pose.position + pose.rotation * spot;
            *at = Vec2::new(world.x, world.z);
        }
        self.wind = believed(water.wind()) * self.lull;
        match self.desc.sampling {
            Sampling::Points => {
                read_points(water, &self.at, &self.points, &mut self.samples, &mut self.waters);
            }
            Sampling::Patch => {
                let center = Vec2::new(pose.position.x, pose.position.z);
                read_patch(water, center, self.footprint, &self.at, &mut self.waters);
            }
        }
    }

    /// What the water at rest around the hull does to it at a pose.
    fn wetness(&mut self, pose: &Pose) -> Wetness {
        let mut wet = immerse(&self.points, &self.waters, pose, self.feels_own, self.desc.water_density);
        self.clip(&mut wet, pose);
        if self.desc.sampling == Sampling::Patch {
            // One flow does not turn.
            wet.spin = Vec3::ZERO;
        }
        wet
    }

    /// Carries the surface on by `time` s, its velocity by `whole` s: drag is implicit and meets the sub-step's end.
    pub(super) fn carry_water(&mut self, time: f32, whole: f32) {
        for water in &mut self.waters {
            water.height += water.rise() * time;
            water.velocity.y += water.acceleration * whole;
        }
    }

    /// Forces change the velocities, these move the pose as `scheme` says. Drag is implicit. `part` is the sub-step's
    /// share of the tick.
    pub(super) fn substep(&mut self, dt: f32, part: f32, scheme: Scheme, controls: &Controls) {
        let start = matrix(self.state.orientation).transpose();
        let pose = if scheme.ahead > 0.0 { self.pose_after(scheme.ahead * dt) } else { self.pose() };
        let before = self.state.velocity;
        let spun = start * self.state.angular_velocity;
        let wet = self.wetness(&pose);
        let desc = &self.desc;
        let share = (wet.volume / self.waterline.volume).min(DEEPEST);
        // What is far below the surface makes no waves.
        let radiating = ((self.volume - wet.volume) * self.sheds).clamp(0.0, 1.0);
        let to_body = pose.rotation.transpose();
        let (coefficients, push) = self.radiation(dt, share.min(1.0) * radiating);
        let axes = resistance_axes(pose.rotation, wet.slope, desc.hull.is_blunt());
        let to_axes = axes.transpose();
        let water = to_axes * wet.velocity;
        let added = coefficients.added_mass * share;
        let whole = Vec3::splat(desc.mass) + added;
        let inertia = self.inertia + Mat3::from_diagonal(coefficients.added_inertia * share);
        let mobility = Mobility { axes, whole, inertia, inverse: inertia.inverse() };
        if !self.moorings.is_empty() {
            self.pull(dt, part, &pose, &mobility);
        }
        if self.slam.is_some() {
            self.slam(&pose, &mobility);
        }
        let desc = &self.desc;
        let velocity = to_axes * self.state.velocity;

        let (engine_force, engine_torque) = self.engine(&pose, velocity - water, controls, dt);
        let drive = to_axes
            * (wet.force + Vec3::Y * push.x + gravity(desc.mass) + controls.force + pose.rotation * engine_force)
            + added * (to_axes * Vec3::new(0.0, wet.acceleration, 0.0));
        // What the sub-steps cannot resolve is held back as an implicit step would. Nothing holds what falls.
        let stiff = |k: f32| 1.0 + (k * dt * dt - FINEST * FINEST).max(0.0);
        let held = if wet.volume > 0.0 { [stiff(self.stiffness.x), stiff(self.stiffness.y)] } else { [1.0; 2] };
        let mut pushed = velocity + drive / (whole * held[0]) * dt - water;
        // A bottom that is wet is wet, however deep; sides are wet as far as they are immersed.
        let sides = Vec3::new(share, share.min(1.0), share);
        let mut linear = desc.drag.linear * share + coefficients.damping * (share * radiating);
        let blows = self.wind != Vec3::ZERO;
        let (wind, rates) = if blows { self.windage(to_axes, velocity, wet.volume) } else { Default::default() };
        if blows {
            pushed += rates / whole * (wind - water) * dt;
            linear += rates;
        }
        let mut quadratic = desc.drag.quadratic_rates(pushed) * sides;
        if let Some(skin) = &desc.skin {
            quadratic.x += skin.quadratic(pushed.x, desc.water_density) * pushed.x.abs() * sides.x;
        }
        let slowed = implicit(pushed, linear, quadratic, whole, dt);
        self.state.velocity = axes * (slowed + water);
        // What the wind pushes does not attack where the water resists.
        let blown = rates * (wind - water - slowed);
        let resisted = slowed.z + rates.z * slowed.z * dt / whole.z;
        let lateral = desc.drag.lateral_center - desc.center_of_mass;
        let sideways = sideways(resisted, pushed.z, whole.z, lateral, &inertia) / dt;

        let torque = to_body * (wet.torque + controls.torque)
            + self.texture_torque(push)
            + engine_torque
            + lateral.cross(to_body * axes.z_axis * sideways)
            + (desc.windage.center - desc.center_of_mass).cross(to_body * (axes * blown));
        let turning = start * self.state.angular_velocity + mobility.inverse * torque * (dt / held[1]);
        let spin = turning - wet.spin;
        let linear = (desc.drag.angular_linear + desc.drag.angular_forward * slowed.length()) * share
            + coefficients.angular_damping * (share * radiating);
        let rates = desc.drag.angular_quadratic * spin.abs() * share;
        let moments = Vec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
        let driven = (implicit(spin, linear, rates, moments, dt) + wet.spin).clamp_length_max(LIMITS.1);
        let through = driven - wet.spin;
        self.remember(Vec3::new(slowed.y, through.x, through.z), dt);
        let driven = if self.solids.near {
            let came = Motion { velocity: before, spin: pose.rotation * spun };
            self.press(dt, &pose, &mobility, driven, came)
        } else {
            driven
        };
        let (turning, mean) = match self.desc.inertia {
            Inertia::Full => tumble(inertia, driven, dt),
            Inertia::PreRigid => (driven, driven),
        };
        self.state.orientation = turned(self.state.orientation, (mean - (driven - spun) * scheme.late) * dt);
        self.state.angular_velocity = matrix(self.state.orientation) * turning;
        let change = self.state.velocity - before;
        self.state.position += (self.state.velocity - change * scheme.late) * dt;
        self.immersed = wet.volume;
    }

    /// The wind along the axes, and its decay rates (N s/m): by how much of the hull is dry.
    pub(super) fn windage(&self, to_axes: Mat3, velocity: Vec3, wet: f32) -> (Vec3, Vec3) {
        let wind = to_axes * self.wind;
        let dry = (0.5 * (self.volume - wet) * self.sheds).clamp(0.0, 100.0);
        (wind, self.desc.windage.rates(wind - velocity) * dry)
    }

    /// Thrust and rudder in hull axes, and their torque about the centre of mass.
    pub(super) fn engine(&self, pose: &Pose, through_water: Vec3, controls: &Controls, dt: f32) -> (Vec3, Vec3) {
        let (Some(engine), Some(water)) = (&self.desc.engine, self.waters.last()) else {
            return (Vec3::ZERO, Vec3::ZERO);
        };
        let arm = engine.position - self.desc.center_of_mass;
        let at = pose.position + pose.rotation * arm;
        let depth = water.ambient(Vec2::new(at.x, at.z)) - at.y;
        // No lift turns the flow by more than half a radian in a step.
        let yields = 1.0 / self.desc.mass + arm.x * arm.x / self.inertia.y_axis.y;
        let most = 0.5 * through_water.x.abs() / (yields * dt);
        let force = engine.force(controls, through_water.x, depth, self.desc.water_density, most);
        (force, arm.cross(force))
    }

    /// Foam where the propeller stirs the surface, in proportion to its thrust's share.
    pub(super) fn propeller_wash(&self, controls: &Controls) -> Displacement {
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
    pub(super) fn measure(&mut self, age: f32, restart: bool) {
        let pose = self.pose();
        for ((column, point), water) in self.columns.iter_mut().zip(&self.points).zip(&self.waters) {
            column.measure(point, water, &pose, age, self.reach, restart);
        }
        self.measure_textures(&pose, age, restart);
    }
}

/// Impulse that turns a hull whose sideways speed `from` was slowed `to`, N s, at the `lateral` centre. As far as that
/// centre yields to it, it is less than what stops the hull: an impact turns it with less energy than it takes.
fn sideways(to: f32, from: f32, mass: f32, lateral: Vec3, inertia: &Mat3) -> f32 {
    let lever = lateral.x * lateral.x / inertia.y_axis.y + lateral.y * lateral.y / inertia.x_axis.x;
    let stopped = if from == 0.0 { 0.0 } else { (1.0 - to / from).clamp(0.0, 1.0) };
    mass * (to - from) / (1.0 + stopped * mass * lever)
}

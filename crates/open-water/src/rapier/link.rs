//! What is known of a body that is a rigid body too: how to read it, and when the water may wake it.

use floating_body::{Body, BodyState, Wrench};
use glam::Vec3;
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};

use super::GRAVITY;
use super::RapierError;

/// Change of acceleration, at the farthest point of the hull, that wakes a body asleep and that is no rest for one awake,
/// m/s^2. A swing this small is some thousandths of the draft.
const STIR: (f32, f32) = (0.02, 0.005);
/// Speed of the farthest point of a hull afloat that is no rest, m/s.
const STILL: f32 = 0.01;
/// Ticks of rest before Rapier may begin to count its own half second: else a slow swing would freeze where it turns.
const PATIENCE: u32 = 180;
/// How far mass, centre of mass and inertia may be off, of their size.
const TOLERANCE: f32 = 0.01;

#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub(super) handle: RigidBodyHandle,
    /// Centre of mass, hull frame.
    center: Vec3,
    mass: f32,
    /// Least moment of inertia, kg m^2.
    moment: f32,
    /// Of the farthest point of the hull, m.
    reach: f32,
    /// The wrench in which it came to rest.
    rest: Wrench,
    /// Ticks since then.
    calm: u32,
    asleep: bool,
}

impl Link {
    pub(super) fn new(body: &Body, handle: RigidBodyHandle) -> Self {
        let inertia = body.inertia();
        Self {
            handle,
            center: body.desc().center_of_mass,
            mass: body.desc().mass,
            moment: inertia.x_axis.x.min(inertia.y_axis.y).min(inertia.z_axis.z),
            reach: body.bounding_radius(),
            rest: Wrench::default(),
            calm: 0,
            asleep: false,
        }
    }

    /// Refuses a rigid body that would move otherwise than the water reckons.
    pub(super) fn check(body: &Body, rigid: &RigidBody) -> Result<(), RapierError> {
        let desc = body.desc();
        let compare = |what, found: f32, expected: f32, size: f32| {
            let fits = (found - expected).abs() <= TOLERANCE * size;
            if fits { Ok(()) } else { Err(RapierError::Differs { what, found, expected }) }
        };
        compare("the mass (kg)", rigid.mass(), desc.mass, desc.mass)?;
        let (found, reach) = (rigid.local_center_of_mass(), body.bounding_radius());
        compare("the centre of mass (x in m)", found.x, desc.center_of_mass.x, reach)?;
        compare("the centre of mass (y in m)", found.y, desc.center_of_mass.y, reach)?;
        compare("the centre of mass (z in m)", found.z, desc.center_of_mass.z, reach)?;
        let (found, expected) = (rigid.mass_properties().local_mprops.reconstruct_inertia_matrix(), body.inertia());
        let size = expected.x_axis.x.max(expected.y_axis.y).max(expected.z_axis.z);
        compare("the inertia about x (kg m^2)", found.x_axis.x, expected.x_axis.x, size)?;
        compare("the inertia about y (kg m^2)", found.y_axis.y, expected.y_axis.y, size)?;
        compare("the inertia about z (kg m^2)", found.z_axis.z, expected.z_axis.z, size)?;
        compare("the gravity scale", rigid.gravity_scale(), 1.0, 1.0)
    }

    /// The body's state, `None` if it is disabled or broken.
    pub(super) fn read(&self, rigid: &RigidBody) -> Option<BodyState> {
        let pose = rigid.position();
        if !(rigid.is_enabled() && pose.is_finite() && rigid.vels().is_finite()) {
            return None;
        }
        let orientation = pose.rotation.normalize();
        let position = pose.translation + orientation * self.center;
        if rigid.is_fixed() {
            return Some(BodyState { orientation, ..BodyState::at_rest(position) });
        }
        // The same point, unless the game has added mass.
        let arm = orientation * (self.center - rigid.local_center_of_mass());
        let velocity = rigid.linvel() + rigid.angvel().cross(arm);
        Some(BodyState { position, orientation, velocity, angular_velocity: rigid.angvel() })
    }

    /// Whether a rigid body must be given this wrench; notes what rest is. `wake` is set if it may not sleep now.
    pub(super) fn weigh(&mut self, rigid: &RigidBody, wrench: &Wrench, wake: &mut bool) -> bool {
        let change = (wrench.force - self.rest.force).length() / self.mass
            + (wrench.torque - self.rest.torque).length() * self.reach / self.moment;
        if rigid.is_sleeping() {
            if !self.asleep {
                (self.asleep, self.rest, self.calm) = (true, *wrench, 0);
                return false;
            }
            *wake = change > STIR.0;
            self.asleep = !*wake;
            return *wake;
        }
        self.asleep = false;
        let afloat = wrench.force.length() > 1.0e-3 * self.mass * GRAVITY.length();
        let speed = rigid.linvel().length() + rigid.angvel().length() * self.reach;
        self.calm = self.calm.saturating_add(1);
        if change > STIR.1 || speed > STILL {
            (self.rest, self.calm) = (*wrench, 0);
        }
        *wake = afloat && self.calm < PATIENCE;
        true
    }

    /// Leaves the wrench on the rigid body for the step to come.
    pub(super) fn apply(&self, rigid: &mut RigidBody, wrench: &Wrench) {
        let arm = rigid.rotation() * (self.center - rigid.local_center_of_mass());
        release(rigid);
        rigid.add_force(wrench.force, false);
        rigid.add_torque(wrench.torque + arm.cross(wrench.force), false);
    }
}

/// Takes the water's hands off.
pub(super) fn release(rigid: &mut RigidBody) {
    rigid.reset_forces(false);
    rigid.reset_torques(false);
}

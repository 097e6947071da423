//! The store: which rigid body is which body of the water.

use std::collections::HashMap;

use floating_body::BodyState;
use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier3d::geometry::ColliderSet;
use slotmap::SecondaryMap;

use super::link::{Link, release};
use super::{RapierError, collider, rigid_body};
use crate::store::{BodyId, BodyMotion, BodyStore, Wants};
use crate::{OpenWater, Pose};

/// The bodies of a water that are rigid bodies of a Rapier world. Does not own the world.
#[derive(Debug, Clone, Default)]
pub struct RapierBodies {
    links: SecondaryMap<BodyId, Link>,
    handles: HashMap<RigidBodyHandle, BodyId>,
}

impl RapierBodies {
    /// Makes a rigid body for a body of the water, with one collider in its hull's shape.
    ///
    /// # Errors
    /// There is no such body.
    pub fn spawn(
        &mut self,
        water: &OpenWater,
        id: BodyId,
        state: BodyState,
        bodies: &mut RigidBodySet,
        colliders: &mut ColliderSet,
    ) -> Result<RigidBodyHandle, RapierError> {
        let body = water.body(id)?;
        let handle = bodies.insert(rigid_body(body, &state));
        colliders.insert_with_parent(collider(&body.desc().hull), handle, bodies);
        self.insert(water, id, handle, bodies, colliders)?;
        Ok(handle)
    }

    /// Lets the water act on a rigid body as body `id`; a rigid body that was `id` before is let go. Give it its
    /// colliders first: their mass is checked.
    ///
    /// # Errors
    /// There is no such body or rigid body, the rigid body is another body, or its mass, centre of mass, inertia or
    /// gravity scale are off.
    pub fn insert(
        &mut self,
        water: &OpenWater,
        id: BodyId,
        handle: RigidBodyHandle,
        bodies: &mut RigidBodySet,
        colliders: &ColliderSet,
    ) -> Result<(), RapierError> {
        let body = water.body(id)?;
        if let Some(other) = self.handles.get(&handle).filter(|other| **other != id) {
            return Err(RapierError::Taken { handle, body: *other });
        }
        let rigid = bodies.get_mut(handle).ok_or(RapierError::UnknownRigidBody(handle))?;
        rigid.recompute_mass_properties_from_colliders(colliders);
        Link::check(body, rigid)?;
        self.remove(id, bodies);
        self.links.insert(id, Link::new(body, handle));
        self.handles.insert(handle, id);
        Ok(())
    }

    /// The water no longer acts on the rigid body, which stays in its set and keeps no force of the water. Call it also
    /// for a body or a rigid body that was removed.
    pub fn remove(&mut self, id: BodyId, bodies: &mut RigidBodySet) -> Option<RigidBodyHandle> {
        let link = self.links.remove(id)?;
        self.handles.remove(&link.handle);
        if let Some(rigid) = bodies.get_mut(link.handle) {
            release(rigid);
        }
        Some(link.handle)
    }

    /// The rigid body of a body.
    pub fn handle(&self, id: BodyId) -> Option<RigidBodyHandle> {
        self.links.get(id).map(|link| link.handle)
    }

    /// The body of a rigid body, for example of one that a ray hit.
    pub fn body(&self, handle: RigidBodyHandle) -> Option<BodyId> {
        self.handles.get(&handle).copied()
    }

    /// The store for [`OpenWater::tick`].
    pub fn store<'a>(&'a mut self, bodies: &'a mut RigidBodySet) -> RapierStore<'a> {
        RapierStore { links: self, bodies }
    }

    /// Where to draw a body's mesh after the physics step: between its poses before and after the last tick, as far as
    /// `advance` left off. [`OpenWater::drawn_pose`] does not know of contacts. `None` without a rigid body.
    pub fn drawn_pose(&self, water: &OpenWater, bodies: &RigidBodySet, id: BodyId) -> Option<Pose> {
        let rigid = bodies.get(self.handle(id)?)?.position();
        let now = Pose { position: rigid.translation, orientation: rigid.rotation };
        let before = water.bodies.previous(id).unwrap_or(now);
        Some(before.between(&now, water.clock.alpha()))
    }
}

/// Reads a `RigidBodySet` and leaves the water's forces in it, for one tick.
pub struct RapierStore<'a> {
    links: &'a mut RapierBodies,
    bodies: &'a mut RigidBodySet,
}

impl BodyStore for RapierStore<'_> {
    fn read(&self, id: BodyId) -> Option<BodyState> {
        let link = self.links.links.get(id)?;
        link.read(self.bodies.get(link.handle)?)
    }

    fn wants(&self, _id: BodyId) -> Wants {
        Wants::Wrench
    }

    fn write(&mut self, id: BodyId, motion: BodyMotion) {
        let Some(link) = self.links.links.get_mut(id) else { return };
        let (BodyMotion::Wrench(wrench), Some(rigid)) = (motion, self.bodies.get(link.handle)) else { return };
        let mut wake = false;
        // A body asleep is not even touched: Rapier would look at it again.
        if !rigid.is_dynamic() || !link.weigh(rigid, &wrench, &mut wake) {
            return;
        }
        if let Some(rigid) = self.bodies.get_mut(link.handle) {
            link.apply(rigid, &wrench);
            if wake {
                rigid.wake_up(true);
            }
        }
    }
}

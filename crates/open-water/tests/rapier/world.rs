//! A water and a Rapier world on one clock, and things to put into them.

pub(crate) use glam::{DVec2, Vec3};
pub(crate) use open_water::rapier::rapier3d::prelude::*;
pub(crate) use open_water::rapier::{GRAVITY, RapierBodies, RapierError, rigid_body};
pub(crate) use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, CascadeDesc, Closure, Controls, Follow, GridDesc, Hull, Mooring,
    MooringId, MooringLine, OpenWater, OpenWaterDesc, Preset, Radiation, SeaState, Stores, TriMesh,
};

pub(crate) const DT: f32 = 1.0 / 60.0;

/// A water and a Rapier world on one clock.
pub(crate) struct World {
    pub(crate) water: OpenWater,
    pub(crate) floating: RapierBodies,
    pub(crate) physics: PhysicsWorld,
}

impl World {
    pub(crate) fn new(desc: OpenWaterDesc) -> Self {
        let mut physics = PhysicsWorld::new();
        (physics.gravity, physics.integration_parameters.dt) = (GRAVITY, DT);
        Self { water: OpenWater::headless(desc).unwrap(), floating: RapierBodies::default(), physics }
    }

    pub(crate) fn calm() -> Self {
        let mut desc = Preset::Low.water();
        desc.sea.partitions.clear();
        Self::new(desc)
    }

    pub(crate) fn spawn(&mut self, desc: BodyDesc, place: Vec3) -> (BodyId, RigidBodyHandle) {
        let id = self.water.add_body(desc).unwrap();
        let state = BodyState::at_rest(place);
        let World { water, floating, physics } = self;
        let handle = floating.spawn(water, id, state, &mut physics.bodies, &mut physics.colliders).unwrap();
        (id, handle)
    }

    pub(crate) fn step(&mut self) {
        for tick in self.water.advance(DT) {
            self.water.tick(tick, &mut self.floating.store(&mut self.physics.bodies)).unwrap();
            self.physics.step();
        }
    }

    pub(crate) fn rigid(&self, handle: RigidBodyHandle) -> &RigidBody {
        &self.physics.bodies[handle]
    }

    pub(crate) fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds / DT) as u32 {
            self.step();
        }
    }
}

/// Flat enough to float level, 0.3 m deep.
pub(crate) fn crate_desc() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(SIZE).unwrap(), MASS)
}

pub(crate) const SIZE: Vec3 = Vec3::new(1.2, 0.6, 1.0);
pub(crate) const MASS: f32 = 1025.0 * 0.36;
pub(crate) const DRAFT: f32 = 0.3;

/// A trough with a V section, 5 m long, 4 m wide, 1 m deep, keel at height 0.
pub(crate) fn trough() -> TriMesh {
    let section = [Vec3::new(0.0, 1.0, -2.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 2.0)];
    let vertices = [-2.5, 2.5].iter().flat_map(|x| section.map(|v| v + Vec3::X * *x)).collect();
    TriMesh { vertices, indices: vec![0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5, 0, 1, 2, 3, 5, 4] }
}

/// One small tile is enough to float on.
pub(crate) fn sea(height: f32, period: f32) -> OpenWaterDesc {
    let sea = SeaState::height_period(height, period, 0.0);
    OpenWaterDesc { sea, cascades: vec![CascadeDesc::new(64, 60.0)], ..Preset::Low.water() }
}

/// A sea of short steep waves, the kind that throws crates about.
pub(crate) fn choppy() -> World {
    World::new(sea(0.5, 3.0))
}

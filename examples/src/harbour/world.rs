//! The harbour as Rapier knows it: what stands fast, what floats, and the fenders between.

use glam::{Vec2, Vec3};
use open_water::rapier::rapier3d::parry::utils::Array2;
use open_water::rapier::rapier3d::prelude::{
    ColliderBuilder, MotorModel, PhysicsWorld, PrismaticJointBuilder, RigidBodyBuilder, RigidBodyHandle,
};
use open_water::rapier::{RapierBodies, RapierError};
use open_water::{BodyId, BodyState, OpenWater, Pose};

use crate::SceneError;

use super::ground::Extent;
use super::plan::{
    ARM_PROFILE, BERTH, JETTY, JETTY_HALF_WIDTH, JETTY_TOP, NORTH_ARM, PILES, QUAY_HIGH, QUAY_LOW, QUAY_TOP, SOUTH_ARM,
    arm_outline,
};
use super::works::piles;

/// How far a fender stands off the quay, metres, half its size, and its mass, kg.
const FENDER: (f32, Vec3, f32) = (0.45, Vec3::new(0.45, 0.6, 0.2), 120.0);
/// A fender's spring, N/m, and damper, N s/m.
const SPRING: (f32, f32) = (30_000.0, 6_000.0);
/// Fenders along the berth, and metres between them.
const FENDERS: (u32, f32) = (3, 2.4);

/// How far a fender's face stands off the quay, metres.
pub const FENDER_FACE: f32 = FENDER.0 + FENDER.1.z;

/// A refusal of the bridge to Rapier as the scene reports it.
pub fn refused(error: RapierError) -> SceneError {
    SceneError::Usage(error.to_string())
}

/// The Rapier world, and which of its bodies float.
pub struct World {
    physics: PhysicsWorld,
    floating: RapierBodies,
    fenders: Vec<RigidBodyHandle>,
}

impl World {
    /// What stands fast: the ground of these elevations, breakwaters, quay and jetty. Ticks of `dt` seconds.
    pub fn new(dt: f32, extent: Extent, elevation: impl Fn(Vec2) -> f32) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = open_water::rapier::GRAVITY;
        physics.integration_parameters.dt = dt;
        let size = extent.high - extent.low;
        let [nx, nz] = [size.x, size.y].map(|s| (s / extent.step).round().max(1.0) as usize + 1);
        let heights = Array2::from_fn(nz, nx, |j, i| {
            elevation(extent.low + size * Vec2::new(i as f32 / (nx - 1) as f32, j as f32 / (nz - 1) as f32))
        });
        let middle = 0.5 * (extent.low + extent.high);
        let ground = ColliderBuilder::heightfield(heights, Vec3::new(size.x, 1.0, size.y));
        physics.insert_collider(ground.translation(Vec3::new(middle.x, 0.0, middle.y)), None);
        let mut world = Self { physics, floating: RapierBodies::default(), fenders: Vec::new() };
        world.breakwater(&NORTH_ARM);
        world.breakwater(&SOUTH_ARM);
        world.block(Vec3::new(QUAY_LOW.x, -12.0, QUAY_LOW.y), Vec3::new(QUAY_HIGH.x, QUAY_TOP, QUAY_HIGH.y));
        let (low, high) = (JETTY[0].min(JETTY[1]), JETTY[0].max(JETTY[1]));
        world.block(
            Vec3::new(low.x, JETTY_TOP - 0.4, low.y - JETTY_HALF_WIDTH),
            Vec3::new(high.x, JETTY_TOP, high.y + JETTY_HALF_WIDTH),
        );
        for top in piles() {
            let pile = ColliderBuilder::cylinder(0.5 * (top.y + 9.0), PILES.1);
            world.physics.insert_collider(pile.translation(top.with_y(0.5 * (top.y - 9.0))), None);
        }
        world.fend();
        world
    }

    fn block(&mut self, low: Vec3, high: Vec3) {
        let half = 0.5 * (high - low);
        let block = ColliderBuilder::cuboid(half.x, half.y, half.z).friction(0.3);
        self.physics.insert_collider(block.translation(0.5 * (low + high)), None);
    }

    /// One convex piece for each straight part, one for the head.
    fn breakwater(&mut self, axis: &[Vec2]) {
        let n = axis.len();
        let rings: Vec<Vec<Vec3>> = ARM_PROFILE
            .iter()
            .map(|&(half, y)| arm_outline(axis, half).iter().map(|p| Vec3::new(p.x, y, p.y)).collect())
            .collect();
        let mut add = |corners: &dyn Fn(usize) -> bool| {
            let points: Vec<Vec3> = rings
                .iter()
                .flat_map(|ring| ring.iter().enumerate().filter(|(i, _)| corners(*i)).map(|(_, p)| *p))
                .collect();
            if let Some(piece) = ColliderBuilder::convex_hull(&points) {
                self.physics.insert_collider(piece, None);
            }
        };
        let last = rings_len(axis) - 1;
        for i in 0..n - 1 {
            add(&|k| k == i || k == i + 1 || k == last - i || k == last - i - 1);
        }
        add(&|k| k >= n - 1 && k <= last + 1 - n);
    }

    /// Fenders along the berth: blocks on rails across the quay's face, pushed out by a spring.
    fn fend(&mut self) {
        let anchor = self.physics.insert_body(RigidBodyBuilder::fixed());
        for i in 0..FENDERS.0 {
            let x = BERTH.x + FENDERS.1 * (i as f32 - 0.5 * (FENDERS.0 - 1) as f32);
            let at = Vec3::new(x, 0.55, QUAY_HIGH.y + FENDER.0);
            let half = FENDER.1;
            let block = ColliderBuilder::cuboid(half.x, half.y, half.z).mass(FENDER.2).friction(0.2);
            let (body, _) = self.physics.insert(RigidBodyBuilder::dynamic().translation(at), block);
            let rail = PrismaticJointBuilder::new(Vec3::Z)
                .local_anchor1(at)
                .local_anchor2(Vec3::ZERO)
                .limits([-(FENDER.0 - half.z), 0.0])
                .motor_model(MotorModel::ForceBased)
                .motor_position(0.0, SPRING.0, SPRING.1)
                .contacts_enabled(false);
            self.physics.insert_impulse_joint(anchor, body, rail.build());
            self.fenders.push(body);
        }
    }

    /// Lets a body of the water float in this world.
    ///
    /// # Errors
    /// There is no such body.
    pub fn spawn(&mut self, water: &OpenWater, body: BodyId, state: BodyState) -> Result<(), RapierError> {
        let physics = &mut self.physics;
        let handle = self.floating.spawn(water, body, state, &mut physics.bodies, &mut physics.colliders)?;
        if let Some(rigid) = physics.bodies.get(handle) {
            for collider in rigid.colliders().to_vec() {
                if let Some(collider) = physics.colliders.get_mut(collider) {
                    collider.set_friction(0.3);
                }
            }
        }
        Ok(())
    }

    /// Runs one tick of the water and one step of the world.
    ///
    /// # Errors
    /// The tick is out of order.
    pub fn tick(&mut self, water: &mut OpenWater, tick: open_water::Tick) -> Result<(), open_water::OpenWaterError> {
        water.tick(tick, &mut self.floating.store(&mut self.physics.bodies))?;
        self.physics.step();
        Ok(())
    }

    /// Where a body is drawn.
    pub fn pose(&self, water: &OpenWater, body: BodyId) -> Option<Pose> {
        self.floating.drawn_pose(water, &self.physics.bodies, body)
    }

    /// Where a body's hull is after the last step, and its velocity, m/s.
    pub fn motion(&self, body: BodyId) -> Option<(Pose, Vec3)> {
        let rigid = self.physics.bodies.get(self.floating.handle(body)?)?;
        let pose = Pose { position: rigid.translation(), orientation: *rigid.rotation() };
        Some((pose, rigid.linvel()))
    }

    /// The fenders' centres, and half their size.
    pub fn fenders(&self) -> (Vec<Vec3>, Vec3) {
        let at = self.fenders.iter().filter_map(|f| self.physics.bodies.get(*f)).map(|f| f.translation());
        (at.collect(), FENDER.1)
    }

    /// How far the fender that gives most is pushed in, metres.
    pub fn squeeze(&self) -> f32 {
        let rest = QUAY_HIGH.y + FENDER.0;
        self.fenders().0.iter().map(|at| rest - at.z).fold(0.0, f32::max)
    }
}

/// Corners of a breakwater's outline.
fn rings_len(axis: &[Vec2]) -> usize {
    arm_outline(axis, 1.0).len()
}

//! Cases `rapier_draft` (where bodies of a Rapier world come to rest) and `rapier_vs_own` (their motion against that of
//! bodies that the water moves itself).

use floating_body::{Closure, Hull, TriMesh, WATER_DENSITY};
use glam::{Quat, Vec3};
use open_water::rapier::{GRAVITY, RapierBodies};
use open_water::{BodyDesc, BodyId, BodyState, BodyStates, BodyStore, CascadeDesc, OpenWater, OpenWaterDesc, SeaState};
use rapier3d::prelude::{PhysicsWorld, Pose, RigidBodyHandle};

use crate::evidence::{Case, CaseError, Context, Row};

/// See the module.
pub(super) const DRAFT: Case = Case {
    name: "rapier_draft",
    about: "draft at rest of bodies that Rapier moves, against Archimedes",
    plots: &[],
    run: draft,
};

/// See the module.
pub(super) const VS_OWN: Case = Case {
    name: "rapier_vs_own",
    about: "heave in waves and swings in calm water of bodies that Rapier moves, against the water's own",
    plots: &[],
    run: vs_own,
};

const DT: f32 = 1.0 / 60.0;

/// One body in a Rapier world of its own.
struct World {
    water: OpenWater,
    floating: RapierBodies,
    id: BodyId,
    handle: RigidBodyHandle,
    physics: PhysicsWorld,
}

impl World {
    fn new(sea: &OpenWaterDesc, desc: &BodyDesc, change: impl Fn(&mut BodyState)) -> Result<Self, CaseError> {
        let mut water = OpenWater::headless(sea.clone())?;
        let id = water.add_body(desc.clone())?;
        let mut state = water.body(id)?.state();
        change(&mut state);
        let mut physics = PhysicsWorld::new();
        (physics.gravity, physics.integration_parameters.dt) = (GRAVITY, DT);
        let mut floating = RapierBodies::default();
        let handle = floating.spawn(&water, id, state, &mut physics.bodies, &mut physics.colliders)?;
        Ok(Self { water, floating, id, handle, physics })
    }

    /// A tick; the body's state after it.
    fn step(&mut self) -> Result<BodyState, CaseError> {
        for tick in self.water.advance(DT) {
            self.water.tick(tick, &mut self.floating.store(&mut self.physics.bodies))?;
            self.physics.step();
        }
        self.floating.store(&mut self.physics.bodies).read(self.id).ok_or_else(|| "the body is gone".into())
    }

    /// Puts the body into a state.
    fn set(&mut self, state: &BodyState) -> Result<(), CaseError> {
        let center = self.water.body(self.id)?.desc().center_of_mass;
        let rigid = &mut self.physics.bodies[self.handle];
        let place = state.position - state.orientation * center;
        rigid.set_position(Pose::from_parts(place, state.orientation), true);
        rigid.set_linvel(state.velocity, true);
        rigid.set_angvel(state.angular_velocity, true);
        Ok(())
    }
}

/// Takes surge, sway and yaw out, as of a model held in a tank: left free, two bodies soon meet other waves.
fn held(mut state: BodyState) -> BodyState {
    let ahead = state.orientation * Vec3::X;
    state.orientation = Quat::from_rotation_y(ahead.z.atan2(ahead.x)) * state.orientation;
    (state.position.x, state.position.z) = (0.0, 0.0);
    (state.velocity.x, state.velocity.z, state.angular_velocity.y) = (0.0, 0.0, 0.0);
    state
}

/// A body that the water moves.
struct Own {
    water: OpenWater,
    id: BodyId,
    states: BodyStates,
}

impl Own {
    fn new(sea: &OpenWaterDesc, desc: &BodyDesc, change: impl Fn(&mut BodyState)) -> Result<Self, CaseError> {
        let mut water = OpenWater::headless(sea.clone())?;
        let id = water.add_body(desc.clone())?;
        let mut state = water.body(id)?.state();
        change(&mut state);
        let mut states = BodyStates::default();
        states.insert(id, state);
        Ok(Self { water, id, states })
    }

    fn step(&mut self) -> Result<BodyState, CaseError> {
        for tick in self.water.advance(DT) {
            self.water.tick(tick, &mut self.states)?;
        }
        self.states.get(self.id).copied().ok_or_else(|| "the body is gone".into())
    }
}

fn calm() -> OpenWaterDesc {
    let mut desc = OpenWaterDesc::default();
    desc.sea.partitions.clear();
    desc
}

/// An open trough with a V section, 5 m long, 4 m wide, 1 m deep: what a boat's mesh is like.
fn vee() -> TriMesh {
    let section = [Vec3::new(0.0, 1.0, -2.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 2.0)];
    let vertices = [-2.5, 2.5].iter().flat_map(|x| section.map(|v| v + Vec3::X * *x)).collect();
    TriMesh { vertices, indices: vec![0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5, 0, 1, 2, 3, 5, 4] }
}

struct Shape {
    name: &'static str,
    desc: BodyDesc,
    draft: f64,
}

/// Bodies and their drafts by Archimedes.
fn shapes() -> Result<Vec<Shape>, CaseError> {
    let boxed = |name, size: Vec3, draft: f32| -> Result<Shape, CaseError> {
        let desc = BodyDesc::from_hull(&Hull::cuboid(size)?, size.x * size.z * draft * WATER_DENSITY);
        Ok(Shape { name, desc, draft: f64::from(draft) })
    };
    // Immersed section of depth d: a triangle 4 d wide, 5 m long.
    let (hull, draft) = (Hull::from_mesh(&vee(), Closure::Cap)?, 0.6f32);
    let mut boat = BodyDesc::from_hull(&hull, 10.0 * draft * draft * WATER_DENSITY);
    boat.center_of_mass.y = 0.5;
    boat.estimate();
    Ok(vec![
        boxed("crate", Vec3::new(1.2, 0.6, 1.0), 0.3)?,
        boxed("barge", Vec3::new(20.0, 3.0, 10.0), 1.5)?,
        Shape { name: "boat", desc: boat, draft: f64::from(draft) },
    ])
}

/// Three digits after the point.
fn milli(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

fn draft(_context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for shape in shapes()? {
        let mut world = World::new(&calm(), &shape.desc, |state| state.position.y += 0.1)?;
        for _ in 0..60 * 90 {
            world.step()?;
        }
        let rigid = &world.physics.bodies[world.handle];
        let draft = -f64::from(rigid.translation().y + shape.desc.hull.bounds().0.y);
        rows.push(
            Row::new("rapier_draft", shape.name)
                .param("draft_m", milli(shape.draft))
                .param("asleep", if rigid.is_sleeping() { "yes" } else { "no" })
                .error(100.0 * (draft / shape.draft - 1.0).abs(), "%", "Archimedes; 90 s after a drop of 0.1 m")
                .bound(1.0),
        );
    }
    Ok(rows)
}

fn vs_own(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for shape in shapes()? {
        let scale = f32::sqrt(shape.desc.hull.bounds().1.x / 2.5);
        let (height, period) = (0.4 * scale * scale, 5.0 * scale);
        let error = heave(&shape.desc, height, period, context.pick(60, 300))?;
        rows.push(
            Row::new("rapier_vs_own", format!("{}, heave", shape.name))
                .param("hs_m", milli(f64::from(height)))
                .param("tp_s", milli(f64::from(period)))
                .error(error, "% of the heave, rms", "the same body in the same sea, moved by the water; held in place")
                .bound(3.0),
        );
        for (name, axis) in [("roll", Vec3::X), ("pitch", Vec3::Z)] {
            rows.push(
                Row::new("rapier_vs_own", format!("{}, {name} decay", shape.name)).param("release_rad", 0.1).error(
                    swing(&shape.desc, axis)?,
                    "% of the angle, rms",
                    "the same body, moved by the water; 20 s",
                ),
            );
        }
    }
    Ok(rows)
}

/// Percent of the rms heave, after 10 s to swing in.
fn heave(desc: &BodyDesc, height: f32, period: f32, seconds: u32) -> Result<f64, CaseError> {
    let cascades = vec![CascadeDesc::new(128, 12.0 * period * period)];
    let sea = OpenWaterDesc { sea: SeaState::height_period(height, period, 0.3), cascades, ..OpenWaterDesc::default() };
    let mut driven = World::new(&sea, desc, |_| ())?;
    let mut own = Own::new(&sea, desc, |_| ())?;
    let rest = f64::from(own.water.body(own.id)?.rest_height());
    let (mut square, mut size) = (0.0, 0.0);
    for tick in 0..60 * seconds {
        let (a, b) = (held(driven.step()?), held(own.step()?));
        driven.set(&a)?;
        own.states.insert(own.id, b);
        let (a, b) = (f64::from(a.position.y), f64::from(b.position.y));
        if tick > 600 {
            square += (a - b) * (a - b);
            size += (b - rest) * (b - rest);
        }
    }
    Ok(100.0 * f64::sqrt(square / size))
}

/// Percent of the rms angle about `axis` in 20 s after a release at 0.1 rad.
fn swing(desc: &BodyDesc, axis: Vec3) -> Result<f64, CaseError> {
    let release = |state: &mut BodyState| state.orientation = Quat::from_axis_angle(axis, 0.1);
    let (mut driven, mut own) = (World::new(&calm(), desc, release)?, Own::new(&calm(), desc, release)?);
    let (mut square, mut size) = (0.0, 0.0);
    let angle = |state: BodyState| 2.0 * f64::from(state.orientation.xyz().dot(axis));
    for _ in 0..60 * 20 {
        let (a, b) = (angle(driven.step()?), angle(own.step()?));
        square += (a - b) * (a - b);
        size += b * b;
    }
    Ok(100.0 * f64::sqrt(square / size))
}

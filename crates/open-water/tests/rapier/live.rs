//! Contacts, and whatever a game does to its rigid bodies.

use crate::world::*;

#[test]
fn a_crate_driven_against_a_quay_stays_outside() {
    let mut world = choppy();
    world.physics.colliders.insert(ColliderBuilder::cuboid(1.0, 8.0, 60.0).translation(Vec3::new(6.0, 0.0, 0.0)));
    let (id, handle) = world.spawn(crate_desc(), Vec3::Y);
    // Wind and waves push it on to the quay, whose face is at x = 5.
    let wind = Controls { force: Vec3::X * 300.0, ..Controls::default() };
    world.water.set_controls(id, wind).unwrap();
    let (mut touching, mut tall) = (0, 0.0_f32);
    for tick in 0..60 * 40 {
        world.step();
        let pose = *world.rigid(handle).position();
        assert!(pose.is_finite());
        let corners = (0..8).map(|i| {
            let sign = |bit: u32| if i >> bit & 1 == 1 { 0.5 } else { -0.5 };
            pose.transform_point(SIZE * Vec3::new(sign(0), sign(1), sign(2)))
        });
        let reach = corners.fold(f32::MIN, |reach, corner| reach.max(corner.x));
        assert!(reach < 5.05, "tick {tick}: {reach}");
        touching += u32::from(reach > 4.97);
        tall = tall.max(pose.translation.y.abs());
        assert!(world.rigid(handle).linvel().length() < 6.0, "{:?}", world.rigid(handle).linvel());
    }
    assert!(touching > 500 && tall < 3.0, "{touching} ticks at the quay, {tall} m");
}

#[test]
fn whatever_becomes_of_a_rigid_body_the_water_goes_on() {
    let mut world = choppy();
    let spawned: Vec<_> = (0..6).map(|i| world.spawn(crate_desc(), Vec3::new(4.0 * i as f32, 0.5, 0.0))).collect();
    world.run(1.0);
    let handle = |i: usize| spawned[i].1;
    world.physics.bodies[handle(0)].set_enabled(false);
    world.physics.bodies[handle(1)].set_body_type(RigidBodyType::Fixed, true);
    world.physics.bodies[handle(2)].set_body_type(RigidBodyType::KinematicVelocityBased, true);
    world.physics.bodies[handle(2)].set_linvel(Vec3::new(0.0, 0.0, 2.0), true);
    world.physics.remove_body(handle(3)).unwrap();
    world.water.remove_body(spawned[4].0).unwrap();
    assert_eq!(world.floating.remove(spawned[4].0, &mut world.physics.bodies), Some(handle(4)));
    assert_eq!(world.rigid(handle(4)).user_force(), Vec3::ZERO);
    let (disabled, fixed) = (*world.rigid(handle(0)).position(), *world.rigid(handle(1)).position());
    world.run(5.0);
    assert_eq!(disabled, *world.rigid(handle(0)).position());
    assert_eq!(fixed.translation, world.rigid(handle(1)).translation());
    assert!((world.rigid(handle(2)).translation().z - 10.0).abs() < 0.2);
    assert!(world.water.drawn_pose(spawned[3].0).is_none());
    // It knows no water any more.
    assert!(world.rigid(handle(4)).translation().y < -50.0);
    world.physics.bodies[handle(0)].set_enabled(true);
    world.physics.bodies[handle(1)].set_body_type(RigidBodyType::Dynamic, true);
    world.run(10.0);
    for i in [0, 1, 5] {
        assert!(world.rigid(handle(i)).translation().y.abs() < 2.0, "{i}: {:?}", world.rigid(handle(i)).position());
    }
}

#[test]
fn rigid_bodies_that_are_not_the_body_are_refused() {
    let mut world = World::calm();
    let id = world.water.add_body(crate_desc()).unwrap();
    let (other, taken) = world.spawn(crate_desc(), Vec3::X * 9.0);
    let state = BodyState::at_rest(Vec3::ZERO);
    let mut insert = |builder: RigidBodyBuilder, density: f32| {
        let handle = world.physics.bodies.insert(builder);
        let collider = ColliderBuilder::cuboid(0.6, 0.3, 0.5).density(density);
        world.physics.colliders.insert_with_parent(collider, handle, &mut world.physics.bodies);
        world
            .floating
            .insert(&world.water, id, handle, &mut world.physics.bodies, &world.physics.colliders)
            .map(|()| handle)
    };
    let builder = rigid_body(world.water.body(id).unwrap(), &state);
    let error = insert(builder.clone(), 83.4).unwrap_err().to_string();
    assert!(error.contains("the mass (kg)") && error.contains("429") && error.contains("369"), "{error}");
    let fits = insert(RigidBodyBuilder::dynamic(), MASS / 0.72).unwrap();
    let refused = insert(builder.clone().gravity_scale(0.5), 0.0).unwrap_err().to_string();
    assert!(refused.contains("gravity scale") && refused.contains("0.5"), "{refused}");
    let off = MassProperties::new(Vec3::Y * 0.2, MASS, Vec3::splat(60.0));
    let refused = insert(builder.clone().additional_mass_properties(off), 0.0).unwrap_err().to_string();
    assert!(refused.contains("centre of mass (y in m)"), "{refused}");
    let turns = MassProperties::new(Vec3::ZERO, MASS, Vec3::splat(90.0));
    let refused = insert(builder.additional_mass_properties(turns), 0.0).unwrap_err().to_string();
    assert!(refused.contains("inertia about x"), "{refused}");
    let again = world.floating.insert(&world.water, id, taken, &mut world.physics.bodies, &world.physics.colliders);
    assert!(matches!(again, Err(RapierError::Taken { body, .. }) if body == other), "{again:?}");
    let gone = world.floating.insert(
        &world.water,
        id,
        RigidBodyHandle::invalid(),
        &mut world.physics.bodies,
        &world.physics.colliders,
    );
    assert!(matches!(gone, Err(RapierError::UnknownRigidBody(_))), "{gone:?}");
    assert_eq!(world.floating.handle(id), Some(fits));
    assert_eq!(world.floating.body(fits), Some(id));
}

#[test]
fn flotsam_may_live_in_a_store_of_its_own() {
    let mut world = choppy();
    let (_, boat) = world.spawn(crate_desc(), Vec3::X * 5.0);
    let id = world.water.add_body(crate_desc()).unwrap();
    let mut flotsam = BodyStates::default();
    flotsam.insert(id, BodyState::at_rest(Vec3::Y * 3.0));
    for _ in 0..120 {
        for tick in world.water.advance(DT) {
            let mut rigid = world.floating.store(&mut world.physics.bodies);
            world.water.tick(tick, &mut Stores(&mut [&mut rigid, &mut flotsam])).unwrap();
        }
    }
    assert!(flotsam.get(id).unwrap().position.y < 1.5);
    assert!(world.rigid(boat).user_force().y > 0.0);
}

#[test]
fn a_rebase_of_the_whole_world_is_no_teleport() {
    let (mut moved, mut stayed) = (choppy(), choppy());
    let offset = DVec2::new(64.0, -32.0);
    let shift = Vec3::new(64.0, 0.0, -32.0);
    let spawned = [&mut moved, &mut stayed].map(|world| world.spawn(crate_desc(), Vec3::new(70.0, 0.5, -30.0)));
    for _ in 0..3 {
        [&mut moved, &mut stayed].into_iter().for_each(|world| world.run(2.0));
        moved.water.rebase(offset).unwrap();
        for (_, body) in moved.physics.bodies.iter_mut() {
            let at = body.translation() - shift;
            body.set_translation(at, false);
        }
    }
    let [a, b] =
        [(&moved, spawned[0].1), (&stayed, spawned[1].1)].map(|(world, handle)| *world.rigid(handle).position());
    let off = (a.translation + 3.0 * shift).distance(b.translation);
    assert!(off < 2e-3 && moved.water.reports().teleports == 0, "{off} m");
    let pose = moved.floating.drawn_pose(&moved.water, &moved.physics.bodies, spawned[0].0).unwrap();
    assert!(pose.position.distance(a.translation) < 0.1, "{pose:?}");
}

#[test]
fn the_handle_of_a_body_that_is_gone_never_reaches_a_rigid_body() {
    let mut world = World::calm();
    let (old, handle) = world.spawn(crate_desc(), Vec3::ZERO);
    world.water.remove_body(old).unwrap();
    let new = world.water.add_body(crate_desc()).unwrap();
    assert_eq!((world.floating.handle(new), world.floating.handle(old)), (None, Some(handle)));
    world.run(0.5);
    assert!(world.water.drawn_pose(new).is_none());
    // The rigid body may be given to the new one once it is taken from the old.
    let World { water, floating, physics } = &mut world;
    let taken = floating.insert(water, new, handle, &mut physics.bodies, &physics.colliders);
    assert!(matches!(taken, Err(RapierError::Taken { body, .. }) if body == old), "{taken:?}");
    floating.remove(old, &mut physics.bodies);
    floating.insert(water, new, handle, &mut physics.bodies, &physics.colliders).unwrap();
    world.run(0.5);
    assert!(world.water.drawn_pose(new).is_some() && world.floating.handle(old).is_none());
}

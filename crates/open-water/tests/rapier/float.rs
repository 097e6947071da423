//! How bodies float and swing in a Rapier world.

use crate::world::*;

#[test]
fn a_cuboid_and_a_boat_float_at_their_draft() {
    let mut world = World::calm();
    let hull = Hull::from_mesh(&trough(), Closure::Cap).unwrap();
    // Immersed section of depth d: a triangle 4 d wide, 5 m long.
    let expected = 0.6_f32;
    let mut boat = BodyDesc::from_hull(&hull, 10.0 * expected * expected * 1025.0);
    boat.center_of_mass.y = 0.5;
    boat.estimate();
    let (_, boat) = world.spawn(boat, Vec3::new(20.0, 0.4, 0.0));
    let (_, cuboid) = world.spawn(crate_desc(), Vec3::Y);
    world.run(60.0);
    // The frame is the hull's: the keel is its origin.
    let draft = -world.rigid(boat).translation().y;
    assert!((draft / expected - 1.0).abs() < 0.01, "boat: {draft}");
    let draft = 0.3 - world.rigid(cuboid).translation().y;
    assert!((draft / DRAFT - 1.0).abs() < 0.01, "crate: {draft}");
}

/// Box barge 20 x 10 x 3 m, draft 1.5: its added mass in heave is twice its mass.
#[test]
fn a_barge_with_more_added_mass_than_mass_swings_in_its_period_and_comes_to_rest() {
    let mut world = World::calm();
    let desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(20.0, 3.0, 10.0)).unwrap(), 300.0 * 1025.0);
    assert!(desc.coefficients.added_mass.y / desc.mass > 1.8);
    let (_, barge) = world.spawn(desc, Vec3::Y * 0.5);
    let (mut crossings, mut before, mut late) = (Vec::new(), 0.5, 0.0_f32);
    for tick in 0..60 * 300 {
        world.step();
        let y = world.rigid(barge).translation().y;
        if before < 0.0 && y >= 0.0 && tick < 60 * 20 {
            crossings.push(tick as f32 * DT);
        }
        before = y;
        if tick > 60 * 200 {
            late = late.max(y.abs());
        }
    }
    let period = crossings[1] - crossings[0];
    // 2 pi sqrt((M + A)/(rho g Aw)) is 4.31 s; damping makes it a little longer.
    assert!((4.2..4.65).contains(&period), "{period} s");
    assert!(late < 2e-3, "{late} m");
}

#[test]
fn several_colliders_and_a_mass_centre_off_the_origin() {
    let hull = Hull::from_mesh(&trough(), Closure::Cap).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 3000.0);
    desc.center_of_mass = Vec3::new(0.3, 0.45, 0.0);
    desc.estimate();
    let mut world = World::calm();
    let id = world.water.add_body(desc).unwrap();
    let body = world.water.body(id).unwrap();
    let handle = world.physics.bodies.insert(rigid_body(body, &BodyState::at_rest(Vec3::new(1.0, 0.6, 0.0))));
    for x in [-1.5, 0.0, 1.5] {
        let part = ColliderBuilder::cuboid(0.7, 0.3, 1.0).translation(Vec3::new(x, 0.6, 0.0)).density(0.0);
        world.physics.colliders.insert_with_parent(part, handle, &mut world.physics.bodies);
    }
    world.floating.insert(&world.water, id, handle, &mut world.physics.bodies, &world.physics.colliders).unwrap();
    world.run(60.0);
    let (own, rigid) = (world.water.body(id).unwrap().state(), world.rigid(handle));
    assert!((rigid.center_of_mass() - own.position).length() < 1e-3, "{} {}", rigid.center_of_mass(), own.position);
    // Trimmed by the head, as its weight lies, and afloat.
    assert!((rigid.rotation() * Vec3::X).y < -0.01 && own.position.y.abs() < 1.0, "{:?}", rigid.position());
    let drawn = world.floating.drawn_pose(&world.water, &world.physics.bodies, id).unwrap();
    assert!((drawn.position - rigid.translation()).length() < 1e-2);
}

#[test]
fn a_blow_is_taken_up_by_the_water_and_the_game_can_add_forces() {
    let mut world = World::calm();
    let (_, handle) = world.spawn(crate_desc(), Vec3::Y * 0.1);
    world.run(10.0);
    world.physics.bodies[handle].apply_impulse(Vec3::X * MASS, true);
    assert!((world.rigid(handle).linvel().x - 1.0).abs() < 1e-3);
    world.run(20.0);
    let gone = world.rigid(handle).translation().x;
    assert!(world.rigid(handle).linvel().length() < 0.15 && (0.3..8.0).contains(&gone), "{gone} m");
    // A force between tick and step acts in that step and stays no longer.
    let before = world.rigid(handle).user_force();
    world.physics.bodies[handle].add_force(Vec3::X * 1.0e4, true);
    world.step();
    assert!((world.rigid(handle).user_force() - before).length() < 400.0, "{}", world.rigid(handle).user_force());
}

//! When bodies sleep, and what wakes them.

use crate::world::*;

#[test]
fn a_crate_at_rest_sleeps_until_a_wave_comes() {
    let mut world = World::calm();
    world.water.add_grid(GridDesc { follow: Follow::Fixed(DVec2::ZERO), ..GridDesc::default() }).unwrap();
    let (_, handle) = world.spawn(crate_desc(), Vec3::Y * 0.3);
    world.run(60.0);
    assert!(world.rigid(handle).is_sleeping());
    let draft = 0.3 - world.rigid(handle).translation().y;
    assert!((draft / DRAFT - 1.0).abs() < 0.01, "{draft}");
    let before = *world.rigid(handle).position();
    for _ in 0..600 {
        world.step();
        assert!(world.rigid(handle).is_sleeping());
    }
    assert_eq!(before, *world.rigid(handle).position());
    // Something heavy falls in near by.
    let desc = BodyDesc { radiation: Radiation::Grid, ..BodyDesc::from_hull(&Hull::sphere(1.0).unwrap(), 3000.0) };
    world.spawn(desc, Vec3::new(9.0, 3.0, 0.0));
    let (mut woken, mut moved) = (false, 0.0_f32);
    for _ in 0..600 {
        world.step();
        woken |= !world.rigid(handle).is_sleeping();
        moved = moved.max((world.rigid(handle).translation().y - before.translation.y).abs());
    }
    assert!(woken && moved > 0.02, "{woken}, {moved} m");
}

#[test]
fn bodies_in_small_waves_stay_awake_and_dry_ones_sleep() {
    let mut world = World::new(sea(0.06, 4.0));
    // On a jetty, above the water.
    world.physics.colliders.insert(ColliderBuilder::cuboid(3.0, 0.2, 3.0).translation(Vec3::new(30.0, 2.0, 0.0)));
    let (_, dry) = world.spawn(crate_desc(), Vec3::new(30.0, 2.8, 0.0));
    let (_, wet) = world.spawn(crate_desc(), Vec3::ZERO);
    for tick in 0..60 * 30 {
        world.step();
        assert!(!world.rigid(wet).is_sleeping(), "tick {tick}");
        assert!(tick < 150 || world.rigid(dry).is_sleeping(), "tick {tick}");
    }
    assert!((world.rigid(dry).translation().y - 2.5).abs() < 0.02);
}

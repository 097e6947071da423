//! Hulls that are kept dry, without a device.

use glam::{Quat, Vec3};
use open_water::{BodyDesc, BodyState, BodyStates, Hull, OpenWater, OpenWaterError, Preset};

/// A box of 4 x 1 x 2 m on calm water, turned and heeled, after a tick; the store and the body.
fn floating(dry: bool) -> (OpenWater, BodyStates, open_water::BodyId) {
    let mut desc = Preset::Low.water();
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc).unwrap();
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let body = water.add_body(BodyDesc::from_hull(&hull, 4_000.0)).unwrap();
    if dry {
        water.set_dry(body, Some(hull.dry(0.0, 0.0).unwrap())).unwrap();
    }
    let mut store = BodyStates::default();
    let orientation = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(0.6);
    store.insert(body, BodyState { orientation, ..BodyState::at_rest(Vec3::new(30.0, 0.1, -20.0)) });
    for tick in water.advance(1.0 / 60.0) {
        water.tick(tick, &mut store).unwrap();
    }
    (water, store, body)
}

#[test]
fn a_point_is_dry_in_the_hulls_own_frame() {
    let (water, store, body) = floating(true);
    let state = store.get(body).unwrap();
    let place = |p: Vec3| state.position + state.orientation * (p - water.body(body).unwrap().desc().center_of_mass);
    for (p, dry) in [
        (Vec3::ZERO, true),
        (Vec3::new(1.9, 0.4, 0.9), true),
        (Vec3::new(-1.9, -0.4, -0.9), true),
        (Vec3::new(2.1, 0.0, 0.0), false),
        (Vec3::new(0.0, 0.6, 0.0), false),
        (Vec3::new(0.0, 0.0, -1.1), false),
    ] {
        assert_eq!(water.is_dry(place(p)), dry, "{p}");
    }
    assert!(!water.is_dry(Vec3::NAN) && !water.is_dry(Vec3::INFINITY));
    // Where it is after the last tick, not before.
    let (mut water, mut store, body) = floating(true);
    store.insert(body, BodyState { velocity: Vec3::Y * 60.0, ..BodyState::at_rest(Vec3::Y * 10.0) });
    for _ in 0..2 {
        let tick = water.advance(1.0 / 60.0).next().unwrap();
        water.tick(tick, &mut store).unwrap();
    }
    let now = store.get(body).unwrap().position;
    assert!(now.y > 11.9 && water.is_dry(now) && !water.is_dry(now - Vec3::Y), "{now}");
}

#[test]
fn dryness_is_looks_alone_and_ends_with_its_body() {
    let (mut water, store, body) = floating(true);
    let (_, other, same) = floating(false);
    assert_eq!(store.get(body), other.get(same));
    let at = store.get(body).unwrap().position;
    water.set_dry(body, None).unwrap();
    assert!(!water.is_dry(at));
    let room = Hull::sphere(1.0).unwrap().dry(0.0, 0.0).unwrap();
    water.set_dry(body, Some(room.clone())).unwrap();
    assert!(water.is_dry(at));
    water.remove_body(body).unwrap();
    assert!(!water.is_dry(at));
    assert!(matches!(water.set_dry(body, Some(room)), Err(OpenWaterError::UnknownBody(_))));
}

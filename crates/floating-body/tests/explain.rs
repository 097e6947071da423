//! What `explain` tells of a body against what the body then does.

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Coefficients, Controls, Hull, LoadKind, MooringLine, Quality, WATER_DENSITY,
};
use glam::{Quat, Vec3};

fn boat(quality: Quality) -> Body {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.0)).unwrap();
    let mut desc = BodyDesc::boat(&hull, 0.4 * WATER_DENSITY * hull.volume(), 8.0);
    desc.coefficients = Coefficients::default();
    desc.quality = quality;
    Body::new(desc).unwrap()
}

#[test]
fn the_loads_are_what_accelerates_the_body() {
    let wave = AiryWave::new(0.3, 25.0, 0.4);
    let controls =
        Controls { throttle: 0.7, steering: 0.3, force: Vec3::new(200.0, 0.0, -100.0), ..Controls::default() };
    for quality in [Quality::Points, Quality::Clipped] {
        let mut body = boat(quality);
        let state = BodyState {
            orientation: Quat::from_euler(glam::EulerRot::XYZ, 0.1, 0.4, -0.05),
            velocity: Vec3::new(3.0, 0.2, 0.5),
            ..body.state()
        };
        body.set_state(state);
        // Two steps that move nothing: the first reads the water, the second shows the acceleration.
        let dt = 1.0e-4;
        body.step(dt, &wave, &controls);
        let told = body.explain(&controls);
        let before = body.state().velocity;
        body.step(dt, &wave, &controls);
        let force = (body.state().velocity - before) / dt * body.desc().mass;
        let sum: Vec3 = told.loads.iter().map(|l| l.force).sum();
        let weight = 9.81 * body.desc().mass;
        assert!((sum - force).length() < 0.02 * weight, "{quality:?}: {sum} against {force}, weight {weight}");
        for kind in
            [LoadKind::Weight, LoadKind::Buoyancy, LoadKind::Drag, LoadKind::Keel, LoadKind::Engine, LoadKind::Given]
        {
            assert!(told.loads.iter().any(|l| l.kind == kind), "{kind:?} is missing");
        }
        assert!((told.clip.volume / body.immersed_volume() - 1.0).abs() < 0.03, "{}", told.clip.volume);
    }
}

#[test]
fn a_body_at_rest_is_explained_by_weight_and_buoyancy_in_one_line() {
    let hull = Hull::cuboid(Vec3::new(3.0, 1.0, 2.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
    desc.center_of_mass = Vec3::new(0.0, -0.2, 0.0);
    let mut body = Body::new(desc).unwrap();
    let line = MooringLine::rope(Vec3::X * 1.5, Vec3::new(4.0, 0.0, 0.0), 2.0, 3000.0);
    body.set_moorings(&[line]).unwrap();
    for _ in 0..60 * 60 {
        body.step(1.0 / 60.0, &floating_body::FlatWater::default(), &Controls::default());
    }
    let told = body.explain(&Controls::default());
    let load = |kind| told.loads.iter().find(|l| l.kind == kind).copied().unwrap();
    let (weight, buoyancy) = (load(LoadKind::Weight), load(LoadKind::Buoyancy));
    assert!((weight.force + buoyancy.force).length() < 1e-3 * weight.force.length(), "{told:?}");
    assert!((buoyancy.at - told.clip.center).length() < 0.01, "{} {}", buoyancy.at, told.clip.center);
    assert!((told.clip.volume - 3.0).abs() < 0.01 && told.clip.waterline.len() == 1);
    // Pulled until the rope hangs: a line that does not pull is no load.
    assert!(told.loads.iter().all(|l| l.kind != LoadKind::Mooring || l.force.x >= 0.0));
    let heights = body.metacentric_heights();
    assert_eq!(told.metacentric_heights, heights);
}

#[test]
fn a_new_body_is_explained_on_still_water() {
    let body = boat(Quality::Points);
    let told = body.explain(&Controls::default());
    assert!(told.clip.volume > 0.0 && told.loads.iter().all(|l| l.force.is_finite() && l.at.is_finite()));
}

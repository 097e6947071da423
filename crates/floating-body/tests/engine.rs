//! The wrench for a physics engine: a plain rigid body under it moves as the body itself does.
//!
//! The engine here is eight lines: four semi-implicit steps a tick under a constant force, as Rapier's solver takes.

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Coefficients, Controls, Drag, FlatWater, ForcePoints, Hull, MooringLine,
    SurfacePatch, SurfaceSample, WATER_DENSITY, WaterSurface, Wrench,
};
use glam::{Mat3, Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;
const NONE: Controls = Controls { throttle: 0.0, steering: 0.0, force: Vec3::ZERO, torque: Vec3::ZERO };

/// Four small steps of a rigid body, which keeps its angular momentum.
fn engine(state: &mut BodyState, body: &Body, wrench: Wrench) {
    let turn = |q: Quat, inertia: Mat3, v: Vec3| q * (inertia * (q.inverse() * v));
    let mut momentum = turn(state.orientation, body.inertia(), state.angular_velocity);
    for _ in 0..4 {
        let h = DT / 4.0;
        state.velocity += (wrench.force / body.desc().mass - Vec3::Y * 9.81) * h;
        momentum += wrench.torque * h;
        state.angular_velocity = turn(state.orientation, body.inertia().inverse(), momentum);
        state.position += state.velocity * h;
        state.orientation = (Quat::from_scaled_axis(state.angular_velocity * h) * state.orientation).normalize();
    }
}

fn tick(state: &mut BodyState, body: &mut Body, water: &dyn WaterSurface) {
    body.set_state(*state);
    let wrench = body.step_wrench(DT, water, &NONE);
    engine(state, body, wrench);
}

/// A float that nothing damps, with a natural frequency of about `sqrt(g / draft)`.
fn undamped(draft: f32) -> Body {
    let hull = Hull::cuboid(Vec3::new(2.0, 4.0 * draft, 2.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 4.0 * draft * WATER_DENSITY);
    // Low, so that it stands.
    desc.center_of_mass.y = -1.75 * draft;
    (desc.drag, desc.coefficients) = (Drag::default(), Coefficients::default());
    Body::new(desc).unwrap()
}

#[test]
fn a_swing_neither_grows_nor_dies_in_an_engine() {
    // From well resolved to less than a tick per radian.
    for draft in [1.0, 0.25, 0.06, 0.01] {
        let mut body = undamped(draft);
        let release = 0.4 * draft;
        let mut state = body.state();
        state.position.y += release;
        let rest = body.rest_height();
        let (mut early, mut late) = (0.0_f32, 0.0_f32);
        for t in 0..3600 {
            tick(&mut state, &mut body, &FlatWater::default());
            let away = (state.position.y - rest).abs();
            if t < 600 {
                early = early.max(away);
            }
            if t >= 3000 {
                late = late.max(away);
            }
        }
        assert!(early < 1.3 * release && late < 1.02 * release, "draft {draft}: {early}, {late} of {release}");
        assert!(draft < 0.2 || late > 0.5 * release, "draft {draft}: {late} of {release}");
    }
}

#[test]
fn the_wrench_holds_back_what_the_added_mass_does() {
    let hull = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 300.0 * WATER_DENSITY);
    desc.drag = Drag::default();
    (desc.coefficients.damping, desc.coefficients.angular_damping) = (Vec3::ZERO, Vec3::ZERO);
    let (mass, added) = (desc.mass, desc.coefficients.added_mass.y);
    assert!(added / mass > 1.8, "{}", added / mass);
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.position.y -= 0.3;
    body.set_state(state);
    let wrench = body.step_wrench(DT, &FlatWater::default(), &NONE);
    // 60 m^3 more than its weight displaces, shared by the mass and 1.2 times the added mass.
    let expected = mass / (mass + added * 1.2) * 60.0 * WATER_DENSITY * 9.81 + mass * 9.81;
    assert!((wrench.force.y / expected - 1.0).abs() < 1e-3, "{} against {expected}", wrench.force.y);
    assert!(wrench.force.x.abs() + wrench.torque.length() < 1e-3 * expected, "{wrench:?}");
}

#[test]
fn at_rest_and_in_the_air_the_wrench_is_weight_and_nothing() {
    let mut body = undamped(0.5);
    let weight = body.desc().mass * 9.81;
    let wrench = body.step_wrench(DT, &FlatWater::default(), &NONE);
    assert!((wrench.force - Vec3::Y * weight).length() < 1e-4 * weight, "{wrench:?}");
    let mut state = BodyState::at_rest(Vec3::Y * 100.0);
    state.angular_velocity = Vec3::new(1.0, 4.0, -2.0);
    for _ in 0..60 {
        body.set_state(state);
        let wrench = body.step_wrench(DT, &FlatWater::default(), &NONE);
        assert!(wrench.force.length() < 1e-3 * weight, "{wrench:?}");
        assert!(wrench.torque.length() < 1e-3 * weight, "{wrench:?}");
        state = body.state();
    }
}

#[test]
fn an_engine_rides_waves_as_the_body_does() {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 3000.0);
    desc.points = ForcePoints::Count(32);
    let (mut own, mut driven) = (Body::new(desc.clone()).unwrap(), Body::new(desc).unwrap());
    let mut state = driven.state();
    let mut wave = AiryWave::new(0.4, 20.0, 0.4);
    let (mut square, mut size) = (0.0, 0.0);
    for t in 0..3600 {
        wave.time = f64::from(t) * f64::from(DT);
        own.step(DT, &wave, &NONE);
        tick(&mut state, &mut driven, &wave);
        let here = own.state();
        // Drift apart is no matter here: each against the surface where it is.
        let surface = |p: Vec3| wave.at(Vec2::new(p.x, p.z)).height;
        if t > 600 {
            let difference = (state.position.y - surface(state.position)) - (here.position.y - surface(here.position));
            square += difference * difference;
            size += here.position.y * here.position.y;
        }
        let level = |s: &BodyState| (s.orientation * Vec3::Y).y;
        assert!((level(&state) - level(&here)).abs() < 2e-2, "tick {t}: {} {}", level(&state), level(&here));
    }
    let error = f32::sqrt(square / size);
    assert!(error < 0.03, "{error}");
}

#[test]
fn whatever_comes_in_the_wrench_is_finite() {
    struct Wild(f32);
    impl WaterSurface for Wild {
        fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
            let wild = SurfaceSample { height: self.0, velocity: Vec3::splat(self.0), ..SurfaceSample::CALM };
            out[..points.len()].fill(wild);
        }
        fn patch(&self, _: Vec2, _: f32) -> SurfacePatch {
            SurfacePatch { height: self.0, gradient: Vec2::splat(self.0), ..SurfacePatch::default() }
        }
    }
    let bad = [f32::NAN, f32::INFINITY, -1.0e30, 1.0e30, 0.0];
    let rope = MooringLine {
        point: Vec3::X,
        anchor: Vec3::ZERO,
        length: 1.0,
        stiffness: 1.0e9,
        damping: 1.0e9,
        holds: f32::INFINITY,
    };
    let mut body = undamped(0.05);
    body.set_moorings(&[rope]).unwrap();
    for (water, value) in bad.iter().flat_map(|w| bad.map(|v| (Wild(*w), v))) {
        for dt in [DT, 0.0, -1.0, f32::NAN, 1.0e9] {
            let mut state = BodyState::at_rest(Vec3::new(3.0, value, 0.0));
            (state.velocity, state.angular_velocity) = (Vec3::splat(value), Vec3::splat(-value));
            body.set_state(state);
            body.set_state(BodyState { velocity: Vec3::splat(value), ..BodyState::at_rest(Vec3::X * 900.0) });
            let wrench = body.step_wrench(dt, &water, &NONE);
            assert!(wrench.force.is_finite() && wrench.torque.is_finite(), "{value}, {dt}: {wrench:?}");
            assert!(body.state().position.is_finite() && body.tensions()[0].is_finite(), "{:?}", body.state());
        }
    }
}

//! Motion: drag, slopes, waves, displaced volume, the launch under power.

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Controls, Displacement, Drag, FlatWater, Home, Hull, Inertia, Radiation,
    Sampling, SurfacePatch, SurfaceSample, WATER_DENSITY, WaterSurface,
};
use glam::{Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;
const NONE: Controls = Controls { throttle: 0.0, steering: 0.0, force: Vec3::ZERO, torque: Vec3::ZERO };

fn crate_of(density: f32) -> Body {
    let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
    Body::new(BodyDesc::from_hull(&hull, density * WATER_DENSITY)).unwrap()
}

fn run(body: &mut Body, seconds: f32, water: &dyn WaterSurface) {
    for _ in 0..(seconds / DT) as u32 {
        body.step(DT, water, &NONE);
    }
}

#[test]
fn a_tilted_crate_comes_to_float_level() {
    let hull = Hull::cuboid(Vec3::new(1.2, 0.5, 1.0)).unwrap();
    let mut body = Body::new(BodyDesc::from_hull(&hull, 200.0)).unwrap();
    let mut state = BodyState::at_rest(Vec3::new(0.0, 0.5, 0.0));
    state.orientation = Quat::from_rotation_x(0.6) * Quat::from_rotation_z(0.4);
    body.set_state(state);
    run(&mut body, 60.0, &FlatWater::default());
    let up = body.state().orientation * Vec3::Y;
    assert!(up.y > 0.9999, "{up}");
    let state = body.state();
    assert!(state.velocity.length() < 0.02 && state.angular_velocity.length() < 1e-3, "{state:?}");
}

#[test]
fn a_dense_crate_sinks_at_its_terminal_speed() {
    let hull = Hull::sphere(0.5).unwrap();
    let mass = 2.0 * WATER_DENSITY * hull.volume();
    let mut desc = BodyDesc::from_hull(&hull, mass);
    desc.drag = Drag { quadratic: Vec3::splat(0.5 * WATER_DENSITY * 0.47 * 0.785), ..Drag::default() };
    let mut body = Body::new(desc).unwrap();
    run(&mut body, 30.0, &FlatWater::default());
    // v = sqrt(2 |rho V - M| g / (rho Cd A)).
    let excess = mass - WATER_DENSITY * hull.volume();
    let expected = (2.0 * excess * 9.81 / (WATER_DENSITY * 0.47 * 0.785)).sqrt();
    let speed = -body.state().velocity.y;
    assert!((speed / expected - 1.0).abs() < 0.01, "{speed} against {expected}");
    assert!(body.state().position.y < -30.0);
}

/// A plane that slopes down towards +x.
struct Slope(f32);

impl WaterSurface for Slope {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (p, s) in points.iter().zip(out) {
            let normal = Vec3::new(self.0, 1.0, 0.0).normalize();
            *s = SurfaceSample { height: -self.0 * p.x, normal, ..SurfaceSample::CALM };
        }
    }

    fn patch(&self, center: Vec2, _radius: f32) -> SurfacePatch {
        SurfacePatch { height: -self.0 * center.x, gradient: Vec2::new(-self.0, 0.0), ..SurfacePatch::default() }
    }
}

#[test]
fn bodies_slide_down_a_slope() {
    for sampling in [Sampling::Patch, Sampling::Points] {
        let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
        let mut desc = BodyDesc::from_hull(&hull, 500.0);
        (desc.drag, desc.coefficients, desc.sampling) = (Drag::default(), Default::default(), sampling);
        let mut body = Body::new(desc).unwrap();
        run(&mut body, 2.0, &Slope(0.1));
        // Without drag the horizontal acceleration is g times the slope.
        let speed = body.state().velocity.x;
        assert!((speed / (2.0 * 0.981) - 1.0).abs() < 0.05, "{sampling:?}: {speed}");
    }
}

#[test]
fn a_small_body_follows_a_long_wave() {
    for sampling in [Sampling::Patch, Sampling::Points] {
        let hull = Hull::cuboid(Vec3::splat(0.6)).unwrap();
        let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
        desc.sampling = sampling;
        let mut body = Body::new(desc).unwrap();
        let mut wave = AiryWave::new(1.0, 60.0, 0.3);
        let (mut worst, mut highest) = (0.0_f32, 0.0_f32);
        for tick in 0..60 * 60 {
            wave.time = f64::from(tick) / 60.0;
            body.step(DT, &wave, &NONE);
            let p = body.state().position;
            wave.time = f64::from(tick + 1) / 60.0;
            if tick > 600 {
                worst = worst.max((p.y - wave.at(Vec2::new(p.x, p.z)).height).abs());
                highest = highest.max(p.y);
            }
        }
        assert!(worst < 0.04, "{sampling:?}: {worst}");
        assert!((highest - 1.0).abs() < 0.05, "{sampling:?}: {highest}");
    }
}

#[test]
fn a_current_carries_a_body_along() {
    let mut body = crate_of(0.5);
    run(&mut body, 120.0, &FlatWater { height: 0.3, current: Vec3::new(1.5, 0.0, -0.5) });
    let state = body.state();
    assert!((state.velocity - Vec3::new(1.5, 0.0, -0.5)).length() < 0.02, "{}", state.velocity);
    assert!((state.position.y - 0.3).abs() < 0.01);
}

fn sum(list: &[Displacement]) -> f32 {
    list.iter().map(|d| d.volume).sum()
}

#[test]
fn displacements_sum_to_the_displaced_volume() {
    let mut body = crate_of(0.5);
    body.set_state(BodyState::at_rest(Vec3::new(0.0, 3.0, 0.0)));
    let (mut list, mut total) = (Vec::new(), 0.0);
    for _ in 0..60 * 60 {
        body.step(DT, &FlatWater::default(), &NONE);
        list.clear();
        body.displacements(&mut list);
        total += sum(&list);
    }
    assert!((total - 0.5).abs() < 0.005, "{total}");
    assert!((total - body.told_volume()).abs() < 1e-3);
}

#[test]
fn a_body_that_moves_at_constant_draft_displaces_no_net_volume() {
    let mut body = crate_of(0.5);
    run(&mut body, 1.0, &FlatWater::default());
    let mut state = body.state();
    state.velocity = Vec3::new(3.0, 0.0, 1.0);
    body.set_state(state);
    let mut list = Vec::new();
    for _ in 0..30 {
        body.step(DT, &FlatWater::default(), &NONE);
        list.clear();
        body.displacements(&mut list);
        assert!(list.len() >= 8 && sum(&list).abs() < 2e-3, "{} {}", list.len(), sum(&list));
        let pushed: f32 = list.iter().map(|d| d.volume.max(0.0)).sum();
        assert!((pushed - 0.5).abs() < 0.05, "{pushed}");
    }
}

#[test]
fn riding_a_swell_tells_the_water_nothing() {
    let hull = Hull::cuboid(Vec3::splat(0.6)).unwrap();
    let mut body = Body::new(BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume())).unwrap();
    let mut wave = AiryWave::new(1.0, 120.0, 0.0);
    let (mut list, mut largest) = (Vec::new(), 0.0_f32);
    for tick in 0..60 * 40 {
        wave.time = f64::from(tick) / 60.0;
        body.step(DT, &wave, &NONE);
        list.clear();
        body.displacements(&mut list);
        if tick > 900 {
            largest = largest.max(sum(&list).abs());
        }
    }
    // The swell moves the surface by up to .7 m/s: the height alone would change the volume by 4e-3 m^3 a tick.
    assert!(largest < 5e-4, "{largest}");
}

#[test]
fn teleports_and_rebasing_make_no_splash() {
    let mut body = crate_of(0.5);
    run(&mut body, 2.0, &FlatWater::default());
    let mut state = body.state();
    state.position += Vec3::new(500.0, 0.0, 70.0);
    body.set_state(state);
    body.step(DT, &FlatWater::default(), &NONE);
    let mut list = Vec::new();
    body.displacements(&mut list);
    assert!(list.iter().all(|d| d.volume.abs() < 1e-4), "{list:?}");
    body.rebase(Vec2::new(500.0, 70.0));
    body.step(DT, &FlatWater::default(), &NONE);
    list.clear();
    body.displacements(&mut list);
    assert!(list.iter().all(|d| d.volume.abs() < 1e-4 && d.center.length() < 2.0), "{list:?}");
}

#[test]
fn the_own_grid_is_felt_with_radiation_grid_only() {
    struct Own;
    impl WaterSurface for Own {
        fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
            out[..points.len()].fill(SurfaceSample { own: 0.2, ..SurfaceSample::CALM });
        }
        fn patch(&self, _: Vec2, _: f32) -> SurfacePatch {
            SurfacePatch { own: 0.2, ..SurfacePatch::default() }
        }
        fn home(&self) -> Home {
            Home::Own
        }
    }
    for (radiation, expected) in [(Radiation::Coefficients, 0.0), (Radiation::Grid, 0.2)] {
        for sampling in [Sampling::Patch, Sampling::Points] {
            let hull = Hull::cuboid(Vec3::new(1.5, 1.0, 1.5)).unwrap();
            let mut desc = BodyDesc::from_hull(&hull, 2.25 * 512.5);
            (desc.radiation, desc.sampling) = (radiation, sampling);
            let mut body = Body::new(desc).unwrap();
            run(&mut body, 60.0, &Own);
            let y = body.state().position.y;
            assert!((y - expected).abs() < 0.01, "{radiation:?} {sampling:?}: {y}");
            // The source never includes it: raised by .2 m, the body displaces that much less ambient water.
            assert!((body.told_volume() - 2.25 * (0.5 - expected)).abs() < 0.02, "{}", body.told_volume());
        }
    }
}

#[test]
fn a_long_body_tumbles_freely_with_constant_energy() {
    for inertia in [Inertia::Full, Inertia::PreRigid] {
        let hull = Hull::cuboid(Vec3::new(4.0, 0.5, 1.0)).unwrap();
        let mut desc = BodyDesc::from_hull(&hull, 500.0);
        desc.inertia = inertia;
        let mut body = Body::new(desc).unwrap();
        let mut state = BodyState::at_rest(Vec3::new(0.0, 5.0e5, 0.0));
        state.angular_velocity = Vec3::new(0.1, 0.2, 3.0);
        body.set_state(state);
        let tensor = body.desc().unit_inertia;
        let energy = |s: &BodyState| {
            let w = s.orientation.inverse() * s.angular_velocity;
            w.dot(tensor * w)
        };
        let start = energy(&body.state());
        let hold = Controls { force: Vec3::Y * 500.0 * 9.81, ..NONE };
        for _ in 0..10_000 {
            body.step(DT, &FlatWater::default(), &hold);
        }
        if inertia == Inertia::Full {
            let now = energy(&body.state());
            assert!((now / start - 1.0).abs() < 0.01, "{now} of {start}");
        } else {
            assert!((body.state().angular_velocity - state.angular_velocity).length() < 1e-2);
        }
    }
}

#[cfg(feature = "mesh-files")]
mod launch {
    use floating_body::Closure;

    use super::*;

    fn launch(speed: f32) -> Body {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/assets/hulls/launch.stl");
        let hull = Hull::from_file(path, Closure::Cap).unwrap();
        Body::new(BodyDesc::boat(&hull, 2400.0, speed)).unwrap()
    }

    fn drive(body: &mut Body, seconds: f32, controls: &Controls, mut water: AiryWave) -> (f32, f32) {
        let (mut tilt, mut jump) = (1.0_f32, 0.0_f32);
        for tick in 0..(seconds / DT) as u32 {
            water.time = f64::from(tick) / 60.0;
            body.step(DT, &water, controls);
            tilt = tilt.min((body.state().orientation * Vec3::Y).y);
            let p = body.state().position;
            jump = jump.max((p.y - body.rest_height() - water.at(Vec2::new(p.x, p.z)).height).abs());
        }
        (tilt.clamp(-1.0, 1.0).acos(), jump)
    }

    const FULL: Controls = Controls { throttle: 1.0, ..NONE };

    #[test]
    fn it_floats_level_and_upright() {
        let mut body = launch(14.0);
        let (tilt, jump) = drive(&mut body, 30.0, &NONE, AiryWave::new(0.0, 10.0, 0.0));
        assert!(tilt < 0.01 && jump < 0.01, "{tilt} {jump}");
        let heights = body.metacentric_heights();
        assert!(heights.x > 0.4 && heights.x < 2.5 && heights.y > 3.0, "{heights}");
    }

    #[test]
    fn it_reaches_the_speed_that_drag_allows_and_keeps_its_course_and_trim() {
        let mut body = launch(14.0);
        let (tilt, jump) = drive(&mut body, 60.0, &FULL, AiryWave::new(0.0, 10.0, 0.0));
        let state = body.state();
        assert!((state.velocity.x - 14.0).abs() < 0.5 && state.velocity.z.abs() < 0.05, "{}", state.velocity);
        assert!(tilt < 0.12 && jump < 0.15, "{tilt} {jump}");
    }

    #[test]
    fn it_turns_to_starboard_steadily_with_bounded_heel() {
        let mut body = launch(14.0);
        drive(&mut body, 20.0, &FULL, AiryWave::new(0.0, 10.0, 0.0));
        let turn = Controls { steering: 0.7, ..FULL };
        let (tilt, jump) = drive(&mut body, 30.0, &turn, AiryWave::new(0.0, 10.0, 0.0));
        let state = body.state();
        let radius = state.velocity.length() / state.angular_velocity.y.abs();
        assert!(state.angular_velocity.y < -0.1, "{}", state.angular_velocity);
        assert!((8.0..80.0).contains(&radius), "{radius} m at {}", state.velocity.length());
        assert!(tilt < 0.5 && jump < 0.4, "{tilt} {jump}");
    }

    #[test]
    fn it_stays_sane_in_waves_at_full_speed() {
        for direction in [0.0, 1.0, 2.0, std::f32::consts::PI] {
            let mut body = launch(14.0);
            let (tilt, jump) = drive(&mut body, 60.0, &FULL, AiryWave::new(0.5, 25.0, direction));
            let speed = body.state().velocity.length();
            assert!(tilt < 0.5 && jump < 0.9, "{direction}: {tilt} {jump}");
            assert!((9.0..18.0).contains(&speed), "{direction}: {speed}");
            assert_eq!(body.resets(), 0);
        }
    }

    #[test]
    fn a_propeller_in_the_air_does_not_push() {
        let mut body = launch(14.0);
        body.set_state(BodyState::at_rest(Vec3::new(0.0, 30.0, 0.0)));
        drive(&mut body, 1.0, &FULL, AiryWave::new(0.0, 10.0, 0.0));
        assert!(body.state().velocity.x.abs() < 1e-6, "{}", body.state().velocity);
    }
}

//! Speeds and swings against closed forms.

use std::f64::consts::{PI, TAU};

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Controls, Drag, FlatWater, Hull, Sampling, WATER_DENSITY, WaterSurface,
};
use glam::{Quat, Vec3};

const DT: f32 = 1.0 / 60.0;

fn run(body: &mut Body, seconds: f32, water: &dyn WaterSurface) {
    for _ in 0..(seconds / DT) as u32 {
        body.step(DT, water, &Controls::default());
    }
}

#[test]
fn bodies_of_every_size_sink_and_rise_at_their_terminal_speed() {
    for size in [0.05_f32, 0.5, 5.0] {
        let sphere = Hull::sphere(size).unwrap();
        let cube = Hull::cuboid(Vec3::new(2.0, 1.2, 1.6) * size).unwrap();
        for (hull, density) in [(&sphere, 3.0), (&sphere, 0.5), (&sphere, 0.1), (&cube, 2.0), (&cube, 0.5)] {
            let mass = density * WATER_DENSITY * hull.volume();
            let mut desc = BodyDesc::from_hull(hull, mass);
            // Heavy to turn, so that it keeps upright.
            (desc.drag.linear, desc.drag.angular_linear) = (Vec3::ZERO, Vec3::splat(1.0e3 * mass * size));
            let quadratic = desc.drag.quadratic.y;
            let mut body = Body::new(desc).unwrap();
            body.set_state(BodyState::at_rest(Vec3::Y * if density < 1.0 { -3000.0 } else { -100.0 }));
            run(&mut body, 20.0 * size.max(1.0), &FlatWater::default());
            let excess = (WATER_DENSITY * hull.volume() - mass).abs() * 9.81;
            let expected = (excess / quadratic).sqrt();
            let speed = body.state().velocity.y.abs();
            assert!((speed / expected - 1.0).abs() < 0.01, "{size} m, {density}: {speed} against {expected}");
        }
    }
}

#[test]
fn moving_through_still_water_is_standing_in_a_current() {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    for sampling in [Sampling::Patch, Sampling::Points] {
        for speed in [Vec3::new(0.5, 0.0, 0.0), Vec3::new(1.5, 0.0, -1.5), Vec3::new(0.0, 0.0, 5.0)] {
            let body = |velocity| {
                // High, so that what is immersed has its centre off the body's.
                let mut desc = BodyDesc::from_hull(&hull, 2000.0);
                desc.sampling = sampling;
                let mut body = Body::new(desc).unwrap();
                let mut state = body.state();
                (state.velocity, state.orientation) = (velocity, Quat::from_rotation_x(0.1));
                body.set_state(state);
                body
            };
            let (mut moving, mut standing) = (body(speed), body(Vec3::ZERO));
            for _ in 0..240 {
                run(&mut moving, 1.5 * DT, &FlatWater::default());
                run(&mut standing, 1.5 * DT, &FlatWater { height: 0.0, current: -speed });
                let (a, b) = (moving.state(), standing.state());
                let apart = (a.velocity - speed - b.velocity).length() / speed.length();
                assert!(apart < 1e-4, "{sampling:?} {speed}: {apart}");
                assert!((a.angular_velocity - b.angular_velocity).length() < 1e-4, "{sampling:?} {speed}");
            }
        }
    }
}

/// Hulme (1982), table 1: ka, added mass and damping over omega in units of the displaced mass.
const HULME: [[f64; 3]; 12] = [
    [0.05, 0.8764, 0.1036],
    [0.1, 0.8627, 0.1816],
    [0.2, 0.7938, 0.2793],
    [0.3, 0.7157, 0.3254],
    [0.4, 0.6452, 0.3410],
    [0.6, 0.5381, 0.3271],
    [0.8, 0.4698, 0.2899],
    [1.0, 0.4284, 0.2484],
    [1.2, 0.4047, 0.2096],
    [2.0, 0.3884, 0.1031],
    [3.0, 0.4111, 0.0452],
    [4.0, 0.4322, 0.0219],
];

/// Amplitude of heave over the wave's amplitude by linear theory, the excitation by Haskind's relation.
fn heave_by_theory(radius: f64, [ka, added, damping]: [f64; 3]) -> f64 {
    let (mass, stiffness) = (2.0 / 3.0 * PI * radius.powi(3) * 1000.0, 9810.0 * PI * radius * radius);
    let (k, omega) = (ka / radius, (9.81 * ka / radius).sqrt());
    let damping = damping * mass * omega;
    let excitation = 9810.0 * (2.0 * damping / (1000.0 * omega * k)).sqrt();
    excitation / (stiffness - omega * omega * mass * (1.0 + added)).hypot(omega * damping)
}

/// The same of a body in a wave, by its first harmonic over ten periods.
fn heave_in_waves(desc: &BodyDesc, wavenumber: f64) -> f64 {
    let mut body = Body::new(desc.clone()).unwrap();
    let mut wave = AiryWave::new(0.02, (TAU / wavenumber) as f32, 0.0);
    let (omega, dt) = (f64::from(wave.frequency), f64::from(DT));
    let (mut cos, mut sin, mut count) = (0.0, 0.0, 0.0);
    for i in 0..(30.0 * TAU / omega / dt) as u32 {
        wave.time = f64::from(i) * dt;
        let mut state = body.state();
        (state.position.x, state.velocity.x) = (0.0, 0.0);
        body.set_state(state);
        body.step(DT, &wave, &Controls::default());
        let angle = omega * f64::from(i + 1) * dt;
        if angle > 20.0 * TAU {
            let height = f64::from(body.state().position.y);
            (cos, sin, count) = (cos + height * angle.cos(), sin + height * angle.sin(), count + 1.0);
        }
    }
    2.0 * f64::hypot(cos, sin) / count / 0.02
}

fn hemisphere(radius: f32) -> BodyDesc {
    let hull = Hull::sphere(radius).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 500.0 * hull.volume());
    desc.water_density = 1000.0;
    desc.estimate();
    desc.drag = Drag::default();
    desc
}

#[test]
fn a_hemisphere_heaves_in_waves_as_linear_theory_says() {
    for sampling in [Sampling::Patch, Sampling::Points] {
        for (memory, most, bound) in [(false, 1.0, 0.06), (true, 1.2, 0.1)] {
            for row in HULME.into_iter().filter(|row| (0.2..=most).contains(&row[0])) {
                let desc = BodyDesc { sampling, memory, ..hemisphere(5.0) };
                let (found, expected) = (heave_in_waves(&desc, row[0] / 5.0), heave_by_theory(5.0, row));
                let error = (found / expected - 1.0).abs();
                assert!(error < bound, "{sampling:?}, memory {memory}, ka {}: {found} of {expected}", row[0]);
            }
        }
    }
}

/// Share of the release of a hemisphere of 5 m that is left after `time` s: the Fourier integral of linear theory.
fn left(time: f64) -> f64 {
    let (mass, stiffness) = (2.0 / 3.0 * PI * 125e3, 9810.0 * PI * 25.0);
    let (width, mut sum) = (1e-3, 0.0);
    for i in 0..5000 {
        let omega = (f64::from(i) + 0.5) * width;
        let ka = omega * omega * 5.0 / 9.81;
        let rows = |k: usize, end: [f64; 2]| {
            let next = HULME.iter().position(|row| row[0] >= ka);
            let (low, high) = match next {
                Some(0) => ([0.0, end[0]], [HULME[0][0], HULME[0][k]]),
                Some(n) => ([HULME[n - 1][0], HULME[n - 1][k]], [HULME[n][0], HULME[n][k]]),
                None => ([4.0, HULME[11][k]], [12.0, end[1]]),
            };
            low[1] + ((ka - low[0]) / (high[0] - low[0])).min(1.0) * (high[1] - low[1])
        };
        let (whole, damping) = (mass * (1.0 + rows(1, [0.831, 0.5])), mass * omega * rows(2, [0.0, 0.0]));
        let (re, im) = (stiffness - omega * omega * whole, omega * damping);
        sum += width * (damping * re + omega * whole * im) / (re * re + im * im) * (omega * time).cos();
    }
    2.0 / PI * sum
}

#[test]
fn a_released_hemisphere_swings_to_rest_as_theory_with_memory_says() {
    // (memory, ticks a second, bound): ticks of any length serve, and so do those that are too long for memory.
    for (memory, rate, bound) in
        [(true, 60_u16, 0.015), (true, 240, 0.015), (true, 20, 0.03), (false, 60, 0.05), (true, 1, 0.4)]
    {
        let mut body = Body::new(BodyDesc { memory, ..hemisphere(5.0) }).unwrap();
        body.set_state(BodyState::at_rest(Vec3::Y * 0.1));
        let (mut square, mut count) = (0.0, 0.0);
        for tick in 1..=12 * rate {
            body.step(1.0 / f32::from(rate), &FlatWater::default(), &Controls::default());
            let error = f64::from(body.state().position.y) / 0.1 - left(f64::from(tick) / f64::from(rate));
            (square, count) = (square + error * error, count + 1.0);
        }
        let error = f64::sqrt(square / count);
        assert!(error < bound, "memory {memory}, {rate} Hz: {error}");
    }
}

#[test]
fn a_teleport_leaves_the_memory_behind() {
    let mut body = Body::new(BodyDesc { memory: true, ..hemisphere(5.0) }).unwrap();
    body.set_state(BodyState::at_rest(Vec3::Y));
    run(&mut body, 1.0, &FlatWater::default());
    body.set_state(BodyState::at_rest(Vec3::X * 1.0e4));
    run(&mut body, 1.0, &FlatWater::default());
    assert!(body.state().position.y.abs() < 1e-6 && body.state().velocity.length() < 1e-6, "{:?}", body.state());
}

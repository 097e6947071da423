//! Cases `hemisphere_response` (heave in regular waves), `terminal` (sinking and rising) and `current` (standing in one
//! against moving through still water).

use std::f64::consts::{PI, TAU};

use floating_body::{AiryWave, Body, BodyDesc, BodyState, Controls, Drag, FlatWater, Hull, Sampling, WATER_DENSITY};
use glam::{Quat, Vec3};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row},
    truth::{G, decay::HULME},
};

/// See the module.
pub(super) const RESPONSE: Case = Case {
    name: "hemisphere_response",
    about: "heave of a hemisphere in regular waves against linear theory, excitation by Haskind's relation",
    plots: &[Plot {
        file: "hemisphere_response",
        title: "Heave of a hemisphere in regular waves",
        x: Axis::Param("ka"),
        y: Axis::Param("heave_over_wave"),
        label: None,
    }],
    run: response,
};

/// See the module.
pub(super) const TERMINAL: Case = Case {
    name: "terminal",
    about: "speed of sinking and rising bodies against sqrt(2 |rho V - M| g / (rho Cd A))",
    plots: &[],
    run: terminal,
};

/// See the module.
pub(super) const CURRENT: Case = Case {
    name: "current",
    about: "a body that moves through still water against one that stands in a current",
    plots: &[],
    run: current,
};

const DT: f64 = 1.0 / 60.0;

fn step(body: &mut Body, water: &dyn floating_body::WaterSurface) {
    body.step(DT as f32, water, &Controls::default());
}

fn response(context: &Context) -> Result<Vec<Row>, CaseError> {
    const RADIUS: f64 = 5.0;
    let mass = 2.0 / 3.0 * PI * RADIUS.powi(3) * 1000.0;
    let stiffness = 1000.0 * G * PI * RADIUS * RADIUS;
    let mut rows = Vec::new();
    for [ka, added, damping] in HULME.into_iter().filter(|row| row[0] <= 2.0) {
        let (k, omega) = (ka / RADIUS, (G * ka / RADIUS).sqrt());
        let damping = damping * mass * omega;
        // Haskind's relation for a body of revolution.
        let excitation = 1000.0 * G * (2.0 * damping / (1000.0 * omega * k)).sqrt();
        let expected = excitation / (stiffness - omega * omega * mass * (1.0 + added)).hypot(omega * damping);
        rows.push(Row::new("hemisphere_response", "linear theory").param("ka", ka).param("heave_over_wave", expected));
        for (variant, memory, bounded) in [("constant coefficients", false, 1.0), ("memory", true, 1.2)] {
            let hull = Hull::sphere(RADIUS as f32)?;
            let mut desc = BodyDesc::from_hull(&hull, mass as f32);
            desc.water_density = 1000.0;
            desc.estimate();
            // Theory has no friction.
            (desc.drag, desc.memory) = (Drag::default(), memory);
            let found = heave(&desc, k, context.pick(10.0, 20.0))?;
            let row = Row::new("hemisphere_response", variant).param("ka", ka).param("heave_over_wave", found).error(
                100.0 * (found / expected - 1.0).abs(),
                "%",
                "linear theory: Hulme (1982) and Haskind",
            );
            rows.push(if ka <= bounded {
                row.bound(10.0)
            } else {
                row.note("no bound: beyond, the hull's own diffraction is missing, and theory's response is small")
            });
        }
    }
    Ok(rows)
}

/// Amplitude over the wave's, by the first harmonic over `periods` after 20 to settle. Held against drifting off.
fn heave(desc: &BodyDesc, wavenumber: f64, periods: f64) -> Result<f64, CaseError> {
    const AMPLITUDE: f32 = 0.02;
    let mut body = Body::new(desc.clone())?;
    let mut wave = AiryWave::new(AMPLITUDE, (TAU / wavenumber) as f32, 0.0);
    let omega = f64::from(wave.frequency);
    let (mut cos, mut sin, mut count) = (0.0, 0.0, 0.0);
    for i in 0..((20.0 + periods) * TAU / omega / DT) as u32 {
        wave.time = f64::from(i) * DT;
        let mut state = body.state();
        (state.position.x, state.velocity.x) = (0.0, 0.0);
        body.set_state(state);
        step(&mut body, &wave);
        let angle = omega * f64::from(i + 1) * DT;
        if angle > 20.0 * TAU {
            let height = f64::from(body.state().position.y);
            (cos, sin, count) = (cos + height * angle.cos(), sin + height * angle.sin(), count + 1.0);
        }
    }
    Ok(2.0 * f64::hypot(cos, sin) / count / f64::from(AMPLITUDE))
}

fn terminal(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, unit) in [
        ("sphere", Hull::sphere(0.5)?),
        ("box", Hull::cuboid(Vec3::new(1.0, 0.6, 0.8))?),
        ("log", Hull::cylinder(0.3, 2.0)?),
    ] {
        for (density, word) in [(0.1, "rising"), (0.5, "rising"), (1.5, "sinking"), (3.0, "sinking")] {
            let mass = density * WATER_DENSITY * unit.volume();
            let mut desc = BodyDesc::from_hull(&unit, mass);
            // Form drag alone, and heavy to turn: the drag area is that of its bottom.
            (desc.drag.linear, desc.drag.angular_linear) = (Vec3::ZERO, Vec3::splat(1.0e3 * mass));
            let quadratic = f64::from(desc.drag.quadratic.y);
            let mut body = Body::new(desc)?;
            body.set_state(BodyState::at_rest(Vec3::Y * if density < 1.0 { -3000.0 } else { -100.0 }));
            for _ in 0..30 * 60 {
                step(&mut body, &FlatWater::default());
            }
            let excess = (f64::from(WATER_DENSITY * unit.volume()) - f64::from(mass)).abs() * G;
            let (found, expected) = (f64::from(body.state().velocity.y.abs()), (excess / quadratic).sqrt());
            rows.push(
                Row::new("terminal", format!("{name}, {word}"))
                    .param("density", f64::from(density))
                    .param("speed", found)
                    .error(100.0 * (found / expected - 1.0).abs(), "%", "sqrt(2 |rho V - M| g / (rho Cd A))")
                    .bound(1.0),
            );
        }
    }
    Ok(rows)
}

fn current(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let launch = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
    for (name, desc) in [
        ("box", BodyDesc::from_hull(&Hull::cuboid(Vec3::new(4.0, 1.0, 2.0))?, 2000.0)),
        ("crate read by patch", BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0))?, 400.0)),
        ("boat under power", BodyDesc::boat(&launch, 3000.0, 8.0)),
    ] {
        for speed in [0.5_f32, 2.0, 5.0] {
            let stream = Vec3::new(0.8, 0.0, 0.6) * speed;
            let controls = Controls { throttle: if desc.engine.is_some() { 0.5 } else { 0.0 }, ..Controls::default() };
            let body = |velocity: Vec3| -> Result<Body, CaseError> {
                let mut body = Body::new(BodyDesc { sampling: desc.sampling, ..desc.clone() })?;
                let mut state = body.state();
                (state.velocity, state.orientation) = (velocity, Quat::from_rotation_x(0.1));
                body.set_state(state);
                Ok(body)
            };
            let (mut moving, mut standing) = (body(stream)?, body(Vec3::ZERO)?);
            let flow = FlatWater { height: 0.0, current: -stream };
            let mut worst = 0.0f64;
            for _ in 0..10 * 60 {
                moving.step(DT as f32, &FlatWater::default(), &controls);
                standing.step(DT as f32, &flow, &controls);
                let (a, b) = (moving.state(), standing.state());
                let turned = (a.angular_velocity - b.angular_velocity).length();
                worst = worst.max(f64::from((a.velocity - stream - b.velocity).length().max(turned) / speed));
            }
            let reads = if desc.sampling == Sampling::Patch { "patch" } else { "points" };
            rows.push(
                Row::new("current", name)
                    .param("speed", f64::from(speed))
                    .param("reads", reads)
                    .error(100.0 * worst, "% of the speed", "the same motion through still water; worst over 10 s")
                    .bound(5.0),
            );
        }
    }
    Ok(rows)
}

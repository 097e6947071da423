//! Cases `fleet_inertia` (what the pre-rigid body leaves out), `fleet_time` (the paper's Fig. 4: time per body by the way the
//! tensor is taken) and `tumble` (free rotation for 100,000 steps).

use std::hint::black_box;

use floating_body::{
    Body, BodyDesc, BodyState, Controls, FlatWater, Fleet, FleetDesc, Hull, Inertia, Sampling, WATER_DENSITY,
};
use glam::{DMat3, DQuat, DVec3, Mat3, Quat, Vec3};

use super::fleet_kernel::{
    DT, Field, crate_desc, fleet,
    plain::{Plain, Reads, Way},
    states,
};
use crate::evidence::{Axis, Case, CaseError, Context, Plot, Row, fastest};

/// See the module.
pub(super) const ERROR: Case = Case {
    name: "fleet_inertia",
    about: "free rotation of boxes and hollow cylinders by aspect ratio: pre-rigid and full tensor against Euler's equations",
    plots: &[Plot {
        file: "fleet_inertia",
        title: "Attitude after a second of free rotation, against Euler's equations",
        x: Axis::Param("length_over_width"),
        y: Axis::Error,
        label: None,
    }],
    run: error,
};

/// See the module.
pub(super) const TIME: Case = Case {
    name: "fleet_time",
    about: "time per body by the way the tensor is taken, 100 to 100,000 bodies, one thread (the paper's Fig. 4)",
    plots: &[Plot {
        file: "fleet_time",
        title: "A tick of one of many floating boxes on one thread",
        x: Axis::Param("bodies"),
        y: Axis::Time,
        label: None,
    }],
    run: time,
};

/// See the module.
pub(super) const TUMBLE: Case = Case {
    name: "tumble",
    about: "energy and angular momentum of free tumbling over 100,000 steps, bodies and fleets",
    plots: &[],
    run: tumble,
};

/// Water too far below to be felt.
const NOWHERE: FlatWater = FlatWater { height: -9000.0, current: Vec3::ZERO };

/// A body of 1000 kg with this tensor (per kg), whatever its hull.
fn desc(unit_inertia: Mat3, inertia: Inertia) -> Result<BodyDesc, CaseError> {
    let hull = Hull::cuboid(Vec3::ONE)?;
    let mut desc = BodyDesc::from_hull(&hull, 0.9 * WATER_DENSITY);
    (desc.unit_inertia, desc.inertia, desc.sampling) = (unit_inertia, inertia, Sampling::Patch);
    Ok(desc)
}

fn spinning(spin: Vec3) -> BodyState {
    BodyState { angular_velocity: spin, ..BodyState::at_rest(Vec3::ZERO) }
}

/// Euler's equations by Runge and Kutta in f64, 1 kHz: attitude after `seconds`.
fn euler(unit: Vec3, spin: Vec3, seconds: f64) -> DQuat {
    let (unit, mut q, mut w) = (unit.as_dvec3(), DQuat::IDENTITY, spin.as_dvec3());
    let h = 1.0e-3;
    let rate = |q: DQuat, w: DVec3| {
        let turn = q * DQuat::from_xyzw(0.5 * w.x, 0.5 * w.y, 0.5 * w.z, 0.0);
        (turn, -w.cross(unit * w) / unit)
    };
    for _ in 0..(seconds / h).round() as u32 {
        let (q1, w1) = rate(q, w);
        let (q2, w2) = rate(q + q1 * (0.5 * h), w + w1 * (0.5 * h));
        let (q3, w3) = rate(q + q2 * (0.5 * h), w + w2 * (0.5 * h));
        let (q4, w4) = rate(q + q3 * h, w + w3 * h);
        q = (q + (q1 + (q2 + q3) * 2.0 + q4) * (h / 6.0)).normalize();
        w += (w1 + (w2 + w3) * 2.0 + w4) * (h / 6.0);
    }
    q
}

/// Degrees between attitudes after a second, the worst of a few spins of 3 rad/s.
fn attitude_error(unit: Vec3, inertia: Inertia) -> Result<f64, CaseError> {
    let mut worst = 0.0f64;
    for axis in [Vec3::new(1.0, 1.0, 1.0), Vec3::new(0.2, 1.0, -0.4), Vec3::new(1.0, -0.3, 0.3)] {
        let spin = axis.normalize() * 3.0;
        let mut fleet = Fleet::new(FleetDesc::new(desc(Mat3::from_diagonal(unit), inertia)?))?;
        let id = fleet.add(spinning(spin))?;
        for _ in 0..60 {
            fleet.step(DT, &NOWHERE);
        }
        let found = fleet.state(id).ok_or("the piece is gone")?.orientation.as_dquat();
        worst = worst.max(found.angle_between(euler(unit, spin, 1.0)).to_degrees());
    }
    Ok(worst)
}

fn error(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let cuboid = |aspect: f32| {
        let (long, one) = (aspect * aspect, 1.0);
        Vec3::new(one + one, long + one, long + one) / 12.0
    };
    // Outer diameter 1, radius ratio .9 (the paper's Eqs. 9 and 10).
    let hollow = |aspect: f32| {
        let ring = 0.25 * (1.0 + 0.9 * 0.9);
        let across = aspect * aspect / 12.0 + ring / 4.0;
        Vec3::new(ring / 2.0, across, across)
    };
    // R^2 (1 + mu^2) = L^2 / 3.
    let round = (3.0 * 0.25 * (1.0 + 0.9f32 * 0.9)).sqrt();
    type Size<'a> = &'a dyn Fn(f32) -> Vec3;
    let shapes: [(&str, Size, f32); 2] = [("box", &cuboid, 1.0), ("hollow cylinder", &hollow, round)];
    for (name, unit, isotropic) in shapes {
        for aspect in [isotropic, 1.25, 1.5, 2.0, 3.0, 5.0, 8.0] {
            let unit = unit(aspect);
            let mismatch = (unit.max_element() - unit.min_element()) / (unit.element_sum() / 3.0);
            let body = Body::new(desc(Mat3::from_diagonal(unit), Inertia::PreRigid)?)?;
            for inertia in [Inertia::PreRigid, Inertia::Full] {
                let pre_rigid = inertia == Inertia::PreRigid;
                let row =
                    Row::new("fleet_inertia", format!("{name}, {}", if pre_rigid { "pre-rigid" } else { "full" }))
                        .param("length_over_width", (f64::from(aspect) * 1000.0).round() / 1000.0)
                        .param(
                            "mismatch_reported_%",
                            (100.0 * f64::from(body.inertia_mismatch()) * 10.0).round() / 10.0,
                        )
                        .error(
                            attitude_error(unit, inertia)?,
                            "degrees",
                            "Euler's equations in f64, a second at 3 rad/s",
                        );
                // Where all moments are equal there is nothing to leave out.
                let exact = !pre_rigid || mismatch < 1.0e-3;
                rows.push(if exact { row.bound(0.5) } else { row });
            }
            let reported = f64::from((body.inertia_mismatch() - mismatch).abs());
            rows.push(
                Row::new("fleet_inertia", format!("{name}, mismatch as reported"))
                    .param("aspect", f64::from(aspect))
                    .error(100.0 * reported, "%", "spread of the principal moments over their mean")
                    .bound(0.1),
            );
        }
    }
    Ok(rows)
}

fn time(context: &Context) -> Result<Vec<Row>, CaseError> {
    let field = Field::new();
    let one = super::fleet_kernel::pool(1)?;
    let mut rows = Vec::new();
    for count in context.pick::<&[usize]>(&[100, 10_000], &[100, 1_000, 10_000, 100_000]) {
        let (desc, start) = (crate_desc()?, states(*count));
        let rigid = BodyDesc { inertia: Inertia::PreRigid, ..desc.clone() };
        let template = Body::new(desc.clone())?;
        let mut fleets = [fleet(&rigid, 1, &start)?, fleet(&desc, 1, &start)?];
        let mut plains = [Way::PreRigid, Way::Full, Way::Inverted]
            .map(|way| Plain::new(&template, start.clone(), way, Reads::Plane));
        let mut bodies = Vec::new();
        for state in &start {
            let mut body = Body::new(BodyDesc { sampling: Sampling::Patch, ..desc.clone() })?;
            body.set_state(*state);
            bodies.push(body);
        }
        let ([a, b], [c, d, e]) = (&mut fleets, &mut plains);
        let effort = context.effort;
        let timings = one.install(|| {
            fastest(
                effort,
                [
                    &mut || a.step(DT, black_box(&field)),
                    &mut || b.step(DT, black_box(&field)),
                    &mut || c.tick(DT, black_box(&field)),
                    &mut || d.tick(DT, black_box(&field)),
                    &mut || e.tick(DT, black_box(&field)),
                    &mut || bodies.iter_mut().for_each(|body| body.step(DT, black_box(&field), &Controls::default())),
                ],
            )
        });
        let names = [
            "fleet, pre-rigid",
            "fleet, full tensor",
            "plain loop, pre-rigid",
            "plain loop, full tensor",
            "plain loop, tensor inverted in world axes",
            "bodies, full tensor",
        ];
        let per = timings.map(|t| t.per(*count as f64));
        for (name, timing) in names.iter().zip(&per) {
            rows.push(
                Row::new("fleet_time", *name).param("bodies", *count).time("a tick, per body", timing).baseline(
                    "a plain loop that inverts the tensor in world axes, as the paper compares with",
                    &per[4],
                ),
            );
        }
    }
    Ok(rows)
}

/// Largest share by which energy and angular momentum (its vector) were off within 100,000 steps.
fn drifts(unit: Mat3, fleet: bool, spin: Vec3, dt: f32) -> Result<f64, CaseError> {
    const STEPS: u32 = 100_000;
    let tensor = unit.as_dmat3();
    let holds = |s: &BodyState| {
        let rotation = DMat3::from_quat(s.orientation.as_dquat().normalize());
        let w = rotation.transpose() * s.angular_velocity.as_dvec3();
        (w.dot(tensor * w), rotation * (tensor * w))
    };
    let desc = desc(unit, Inertia::Full)?;
    let mut many = Fleet::new(FleetDesc::new(desc.clone()))?;
    let mut state = spinning(spin);
    let (id, mut body) = (many.add(state)?, Body::new(desc)?);
    body.set_state(state);
    let (energy, momentum) = holds(&state);
    let mut worst = 0.0f64;
    for step in 1..=STEPS {
        if fleet {
            many.step(dt, &NOWHERE);
        } else {
            body.step(dt, &NOWHERE, &Controls::default());
        }
        if step % 50 == 0 {
            state = if fleet { many.state(id).ok_or("the piece is gone")? } else { body.state() };
            let (e, l) = holds(&state);
            worst = worst.max((e / energy - 1.0).abs()).max((l - momentum).length() / momentum.length());
            // It falls; what turns is left alone.
            let back = BodyState { position: Vec3::ZERO, velocity: Vec3::ZERO, ..state };
            many.set_state(id, back);
            body.set_state(back);
        }
    }
    Ok(worst)
}

fn tumble(_: &Context) -> Result<Vec<Row>, CaseError> {
    let long = Vec3::new(2.0, 17.0, 17.0) / 12.0;
    let plank = Vec3::new(1.04, 16.04, 17.0) / 12.0;
    let turned = Mat3::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.5, 0.3, -0.8));
    let skew = turned * Mat3::from_diagonal(plank) * turned.transpose();
    let tensors =
        [("long box", Mat3::from_diagonal(long)), ("plank", Mat3::from_diagonal(plank)), ("plank, hull askew", skew)];
    let mut rows = Vec::new();
    for (name, unit) in tensors {
        for (kind, many) in [("fleet", true), ("body", false)] {
            let mut worst = 0.0f64;
            for (spin, dt) in [
                (Vec3::new(0.05, 3.0, 0.02), DT),
                (Vec3::new(2.0, 2.0, 2.0), DT),
                (Vec3::new(4.0, 1.0, -3.0), 1.0 / 30.0),
            ] {
                worst = worst.max(drifts(unit, many, spin, dt)?);
            }
            rows.push(
                Row::new("tumble", format!("{kind}, {name}"))
                    .param("steps", 100_000)
                    .error(
                        100.0 * worst,
                        "%",
                        "energy and angular momentum at the start, worst within the run of 3 spins",
                    )
                    .bound(1.0),
            );
        }
    }
    Ok(rows)
}

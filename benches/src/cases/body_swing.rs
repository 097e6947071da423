//! Cases `barge` (periods), `decay` (released over its rest) and `integrator` (ticks against the period).

use std::hint::black_box;

use floating_body::{Body, BodyDesc, BodyState, Coefficients, Controls, Drag, FlatWater, Hull, RadiationTable};
use glam::{Quat, Vec3};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure},
    truth::{G, decay::Memory},
};

/// See the module.
pub(super) const BARGE: Case = Case {
    name: "barge",
    about: "periods of a box barge in heave, roll and pitch, and its metacentric heights",
    plots: &[],
    run: barge,
};

/// See the module.
pub(super) const DECAY: Case = Case {
    name: "decay",
    about: "decay of a released sphere and box, with and without memory, against linear theory",
    plots: &[],
    run: decay,
};

/// See the module.
pub(super) const INTEGRATOR: Case = Case {
    name: "integrator",
    about: "error of a free swing's period by length of tick, and the time that a second takes",
    plots: &[
        Plot {
            file: "integrator",
            title: "A free swing in heave (beside the points: sub-steps a tick)",
            x: Axis::Param("tick_ms"),
            y: Axis::Error,
            label: Some("substeps"),
        },
        Plot {
            file: "integrator_time",
            title: "A free swing in heave (beside the points: tick, ms)",
            x: Axis::Time,
            y: Axis::Error,
            label: Some("tick_ms"),
        },
    ],
    run: integrator,
};

const DENSITY: f64 = 1000.0;
const DT: f64 = 1.0 / 60.0;

/// 20 x 10 x 3 m, draft 1.5 m, centre of mass at the waterline.
fn barge_desc() -> Result<BodyDesc, CaseError> {
    let mut desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(20.0, 3.0, 10.0))?, 300e3);
    desc.water_density = DENSITY as f32;
    desc.estimate();
    Ok(desc)
}

/// Mean distance of a series' first and last crossings of zero over two, times two: its period. None of fewer than three.
fn period(series: &[f64], dt: f64, most: usize) -> Option<f64> {
    let crossings: Vec<f64> = series
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| (pair[0] < 0.0) != (pair[1] < 0.0))
        .map(|(i, pair)| (i as f64 + pair[0] / (pair[0] - pair[1])) * dt)
        .take(most)
        .collect();
    let (first, last) = (crossings.first()?, crossings.last()?);
    (crossings.len() > 2).then(|| 2.0 * (last - first) / (crossings.len() - 1) as f64)
}

fn barge(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    // Boundary elements; without the water's mass they would be 2.46, 2.76 and 2.53.
    for (mode, expected) in [("heave", 4.31), ("roll", 3.84), ("pitch", 4.00)] {
        let mut body = Body::new(barge_desc()?)?;
        let rest = body.rest_height();
        let mut state = body.state();
        match mode {
            "heave" => state.position.y += 0.1,
            "roll" => state.orientation = Quat::from_rotation_x(0.02),
            _ => state.orientation = Quat::from_rotation_z(0.01),
        }
        body.set_state(state);
        let mut series = Vec::new();
        for _ in 0..20 * 60 {
            body.step(DT as f32, &FlatWater::default(), &Controls::default());
            let state = body.state();
            series.push(f64::from(match mode {
                "heave" => state.position.y - rest,
                "roll" => state.orientation.x,
                _ => state.orientation.z,
            }));
        }
        let found = period(&series, DT, 5).unwrap_or(f64::NAN);
        rows.push(
            Row::new("barge", format!("period of {mode}"))
                .param("period_s", found)
                .error(100.0 * (found / expected - 1.0).abs(), "%", "boundary elements at the body's own frequency")
                .bound(5.0),
        );
    }
    let body = Body::new(barge_desc()?)?;
    let heights = body.metacentric_heights();
    // KB + BM - KG: .75 + B^2/(12 T) - 1.5 and .75 + L^2/(12 T) - 1.5.
    for (mode, found, expected) in [("roll", heights.x, 0.75 + 100.0 / 18.0 - 1.5), ("pitch", heights.y, 21.4722)] {
        rows.push(
            Row::new("barge", format!("metacentric height, {mode}"))
                .param("height_m", f64::from(found))
                .error(100.0 * (f64::from(found) / expected - 1.0).abs(), "%", "closed form")
                .bound(1.0),
        );
    }
    Ok(rows)
}

fn decay(context: &Context) -> Result<Vec<Row>, CaseError> {
    const RELEASE: f32 = 0.05;
    const LONG: f64 = 12.0;
    let mut rows = Vec::new();
    let (mass, area) = (2.0 / 3.0 * std::f64::consts::PI * 125.0 * DENSITY, 25.0 * std::f64::consts::PI);
    let barge = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0))?;
    let bodies = [
        ("sphere", Hull::sphere(5.0)?, mass, area, Memory::hemisphere(5.0)),
        ("box", barge, 300e3, 200.0, Memory::barge()),
    ];
    for (name, hull, mass, area, theory) in bodies {
        for (memory, radiation) in [(false, "estimated"), (true, "estimated"), (true, "given table")] {
            if name == "sphere" && radiation == "given table" {
                continue;
            }
            let mut desc = BodyDesc::from_hull(&hull, mass as f32);
            desc.water_density = DENSITY as f32;
            desc.estimate();
            // Theory has no friction.
            (desc.drag, desc.memory) = (Drag::default(), memory);
            let column = |k: usize| theory.rows().iter().map(|row| row[k] as f32).collect();
            desc.tables.heave = (radiation == "given table").then(|| RadiationTable {
                omega: column(0),
                added: column(1),
                damping: column(2),
            });
            let mut body = Body::new(desc)?;
            let rest = body.rest_height();
            body.set_state(BodyState::at_rest(Vec3::Y * (rest + RELEASE)));
            let count = (LONG / DT) as u32;
            let times: Vec<f64> = (1..=count).map(|i| f64::from(i) * DT).collect();
            let expected = theory.decay(mass, DENSITY * G * area, &times);
            let mut square = 0.0;
            for left in &expected {
                body.step(DT as f32, &FlatWater::default(), &Controls::default());
                square += (f64::from((body.state().position.y - rest) / RELEASE) - left).powi(2);
            }
            let timing = measure(context.effort, || {
                body.step(DT as f32, black_box(&FlatWater::default()), &Controls::default());
            });
            let row = Row::new("decay", name)
                .param("memory", memory)
                .param("radiation", if name == "sphere" { "Hulme's table" } else { radiation })
                .error(100.0 * (square / f64::from(count)).sqrt(), "% of the release", "linear theory; RMS over 12 s")
                .bound(if memory { 5.0 } else { 8.0 })
                .time("a tick of the body", &timing);
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Sub-steps that a swing at `omega` (dry) is cut into.
fn substeps(tick: f64, omega: f64) -> f64 {
    (tick * omega / 0.5).ceil().clamp(1.0, 32.0)
}

fn integrator(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let crate_ = Hull::cuboid(Vec3::new(1.25, 0.8, 1.0))?;
    for (name, hull, mass) in [("barge", Hull::cuboid(Vec3::new(20.0, 3.0, 10.0))?, 300e3), ("crate", crate_, 400.0)] {
        for tick_ms in [1.0_f64, 4.0, 1000.0 / 60.0, 1000.0 / 30.0, 100.0, 250.0, 1000.0] {
            let mut desc = BodyDesc::from_hull(&hull, mass as f32);
            desc.water_density = DENSITY as f32;
            desc.estimate();
            // A swing for ever: neither friction nor waves.
            desc.drag = Drag::default();
            desc.coefficients = Coefficients { added_mass: desc.coefficients.added_mass, ..Coefficients::default() };
            let whole = mass + f64::from(desc.coefficients.added_mass.y);
            let mut body = Body::new(desc)?;
            let area = f64::from(body.waterline().area);
            let expected = std::f64::consts::TAU * (whole / (DENSITY * G * area)).sqrt();
            let dry = (DENSITY * G * area / mass).sqrt();
            let tick = tick_ms / 1000.0;
            if tick > expected / 3.0 {
                // Too few ticks to see a swing.
                continue;
            }
            let rest = body.rest_height();
            let release = 0.01 * body.waterline().draft;
            body.set_state(BodyState::at_rest(Vec3::Y * (rest + release)));
            let mut series = Vec::new();
            for _ in 0..(30.0 * expected / tick) as u32 {
                body.step(tick as f32, &FlatWater::default(), &Controls::default());
                series.push(f64::from(body.state().position.y - rest));
            }
            let found = period(&series, tick, usize::MAX).unwrap_or(f64::NAN);
            let end: f64 =
                series.iter().rev().take((2.0 * expected / tick) as usize + 2).fold(0.0, |m, y| m.max(y.abs()));
            let ticks = (1.0 / tick).max(1.0) as u32;
            let timing = measure(context.effort, || {
                for _ in 0..ticks {
                    body.step(tick as f32, black_box(&FlatWater::default()), &Controls::default());
                }
            });
            rows.push(
                Row::new("integrator", name)
                    .param("tick_ms", (tick_ms * 10.0).round() / 10.0)
                    .param("substeps", substeps(tick, dry))
                    .param("left_after_30_swings", end / f64::from(release))
                    .error(100.0 * (found / expected - 1.0).abs(), "%", "2 pi sqrt((M + A)/(rho g Aw))")
                    .time("a second of the body", &timing),
            );
        }
    }
    Ok(rows)
}

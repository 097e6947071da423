//! Cases `heave_decay`: a body released over its rest, radiating into a dispersive grid; `grid_on_off`: the same without
//! the grid.

use floating_body::{Body, BodyDesc, Controls, Drag, FlatWater, Hull, Radiation, RadiationTable};
use glam::Vec3;
use open_water::{BodyState, BodyStates, Follow, GridDesc, OpenWater, OpenWaterDesc, Preset, Scheme};
use wave_grid::Border;

use crate::{
    evidence::{Case, CaseError, Context, Row},
    truth::{G, decay::Memory},
};

/// See the module.
pub(super) const HEAVE: Case = Case {
    name: "heave_decay",
    about: "heave decay of bodies that radiate into a dispersive grid, against linear theory with memory",
    plots: &[],
    run: heave,
};

/// See the module.
pub(super) const ON_OFF: Case = Case {
    name: "grid_on_off",
    about: "heave decay with the home grid on against the same body without it",
    plots: &[],
    run: on_off,
};

const DENSITY: f64 = 1000.0;
/// Released so far over its rest, m.
const RELEASE: f32 = 0.05;
/// Compared so long, s.
const LONG: f64 = 12.0;

struct Float {
    name: &'static str,
    radiation: &'static str,
    hull: Hull,
    mass: f64,
    area: f64,
    theory: Memory,
    table: Option<RadiationTable>,
}

fn table(memory: &Memory) -> RadiationTable {
    let column = |k: usize| memory.rows().iter().map(|row| row[k] as f32).collect();
    RadiationTable { omega: column(0), added: column(1), damping: column(2) }
}

fn floats() -> Result<Vec<Float>, CaseError> {
    let barge = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0))?;
    let float =
        |name, radiation, hull, mass, area, theory, table| Float { name, radiation, hull, mass, area, theory, table };
    let (mass, area) = (2.0 / 3.0 * std::f64::consts::PI * 125.0 * DENSITY, 25.0 * std::f64::consts::PI);
    Ok(vec![
        float("barge", "given table", barge.clone(), 300e3, 200.0, Memory::barge(), Some(table(&Memory::barge()))),
        float("barge", "estimated", barge, 300e3, 200.0, Memory::barge(), None),
        float("hemisphere", "Hulme's table", Hull::sphere(5.0)?, mass, area, Memory::hemisphere(5.0), None),
    ])
}

fn heave(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for float in floats()? {
        let grids: &[(f32, u32)] = context.pick(&[(0.5, 60), (0.5, 120)], &[(0.5, 60), (0.5, 120), (1.0, 60)]);
        for &(cell, rate) in grids {
            if context.pick(rate == 120 && float.radiation == "estimated", false) {
                continue;
            }
            let found = released(&float, Scheme::Dispersive, cell, rate)?;
            let times: Vec<f64> = (0..found.len()).map(|i| i as f64 / f64::from(rate)).collect();
            let theory = float.theory.decay(float.mass, DENSITY * G * float.area, &times);
            let square: f64 = found.iter().zip(&theory).map(|(a, b)| (a - b) * (a - b)).sum();
            let error = 100.0 * (square / found.len() as f64).sqrt();
            let row = Row::new("heave_decay", float.name)
                .param("radiation", float.radiation)
                .param("cell", f64::from(cell))
                .param("rate", rate)
                .error(error, "% of the release", "linear theory with memory; RMS over 12 s");
            // An estimate is no measurement.
            rows.push(if float.radiation == "estimated" { row } else { row.bound(if rate == 60 { 5.0 } else { 2.5 }) });
        }
    }
    Ok(rows)
}

/// Without drag, which theory has not.
fn described(float: &Float) -> BodyDesc {
    let mut body = BodyDesc::from_hull(&float.hull, float.mass as f32);
    body.water_density = DENSITY as f32;
    body.estimate();
    body.drag = Drag::default();
    body.tables.heave = float.table.clone();
    body
}

/// By its coefficients, no grid.
fn alone(float: &Float, memory: bool, rate: u32) -> Result<Vec<f64>, CaseError> {
    let mut body = Body::new(BodyDesc { memory, ..described(float) })?;
    let rest = body.rest_height();
    body.set_state(BodyState::at_rest(Vec3::Y * (rest + RELEASE)));
    let mut found = vec![1.0];
    while (found.len() as f64) < LONG * f64::from(rate) {
        body.step(1.0 / rate as f32, &FlatWater::default(), &Controls::default());
        found.push(f64::from(body.state().position.y - rest) / f64::from(RELEASE));
    }
    Ok(found)
}

fn on_off(context: &Context) -> Result<Vec<Row>, CaseError> {
    const RATE: u32 = 60;
    let mut rows = Vec::new();
    for float in floats()?.into_iter().filter(|float| float.radiation != "estimated") {
        let cell = context.pick(1.0, 0.5);
        for (scheme, name) in [(Scheme::Dispersive, "dispersive"), (Scheme::NinePoint, "wave equation")] {
            let on = released(&float, scheme, cell, RATE)?;
            for memory in [false, true] {
                let off = alone(&float, memory, RATE)?;
                let square: f64 = on.iter().zip(&off).map(|(a, b)| (a - b) * (a - b)).sum();
                let error = 100.0 * (square / on.len() as f64).sqrt();
                let row = Row::new("grid_on_off", float.name)
                    .param("grid", name)
                    .param("off", if memory { "memory" } else { "constant coefficients" })
                    .param("cell", f64::from(cell))
                    .error(error, "% of the release", "the same body without a grid; RMS over 12 s");
                rows.push(if scheme == Scheme::Dispersive {
                    row.bound(10.0)
                } else {
                    row.note(
                        "no bound: all its waves have one speed, here that of the body's own; added mass is the grid's",
                    )
                });
            }
        }
    }
    Ok(rows)
}

/// Height over rest after each tick, as a share of the release.
fn released(float: &Float, scheme: Scheme, cell: f32, rate: u32) -> Result<Vec<f64>, CaseError> {
    let mut desc = OpenWaterDesc { tick: 1.0 / rate as f32, ..Preset::Low.water() };
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc)?;
    let body = water.add_body(BodyDesc { radiation: Radiation::Grid, ..described(float) })?;
    water.add_grid(GridDesc {
        follow: Follow::Body(body),
        cells: [(112.0 / cell) as u32; 2],
        cell_size: [cell; 2],
        scheme,
        // That of waves of 4.3 s, which is about the periods of these bodies.
        wave_speed: 6.7,
        border: Border::Absorbing { width: 16 },
        ..GridDesc::default()
    })?;
    let rest = water.body(body)?.rest_height();
    let mut store = BodyStates::default();
    store.insert(body, BodyState::at_rest(Vec3::Y * (rest + RELEASE)));
    let mut found = vec![1.0];
    while (found.len() as f64) < LONG * f64::from(rate) {
        for tick in water.advance(1.0 / rate as f32) {
            water.tick(tick, &mut store)?;
            let height = store.get(body).map_or(f32::NAN, |state| state.position.y);
            found.push(f64::from(height - rest) / f64::from(RELEASE));
        }
    }
    Ok(found)
}

//! Case `heave_decay`: a body released over its rest, radiating into a dispersive grid.

use floating_body::{BodyDesc, Drag, Hull, Radiation, RadiationTable};
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
            let found = released(&float, cell, rate)?;
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

/// Height over rest after each tick, as a share of the release.
fn released(float: &Float, cell: f32, rate: u32) -> Result<Vec<f64>, CaseError> {
    let mut desc = OpenWaterDesc { tick: 1.0 / rate as f32, ..Preset::Low.water() };
    desc.sea.partitions.clear();
    let mut water = OpenWater::headless(desc)?;
    let mut body = BodyDesc::from_hull(&float.hull, float.mass as f32);
    body.water_density = DENSITY as f32;
    body.estimate();
    (body.drag, body.radiation) = (Drag::default(), Radiation::Grid);
    body.tables.heave = float.table.clone();
    let body = water.add_body(body)?;
    water.add_grid(GridDesc {
        follow: Follow::Body(body),
        cells: [(112.0 / cell) as u32; 2],
        cell_size: [cell; 2],
        scheme: Scheme::Dispersive,
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

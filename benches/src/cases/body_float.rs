//! Cases `draft` (where a body comes to rest) and `body_tick` (time of a tick of many bodies).

use std::hint::black_box;

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Closure, Controls, FlatWater, ForcePoints, Hull, Quality, TriMesh,
    WATER_DENSITY, WaterSurface,
};
use glam::Vec3;
use rayon::prelude::*;

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure, measure_together},
    fixtures::{self, Random},
    truth,
};

/// See the module.
pub(super) const DRAFT: Case = Case {
    name: "draft",
    about: "draft of bodies at rest against closed forms, by shape and number of force points",
    plots: &[Plot {
        file: "draft",
        title: "Draft of a body at rest (beside the points: force points)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("force_points"),
    }],
    run: draft,
};

/// See the module.
pub(super) const TICK: Case = Case {
    name: "body_tick",
    about: "a tick of 1,000 bodies on a regular wave, all threads; their heave against the wave's",
    plots: &[],
    run: tick,
};

const DT: f32 = 1.0 / 60.0;
/// Share of the water's density.
const DENSITIES: [f64; 3] = [0.25, 0.5, 0.75];

struct Shape {
    name: &'static str,
    hull: Hull,
    /// Draft at a displaced volume.
    closed_form: Box<dyn Fn(f64) -> f64>,
}

fn shapes() -> Result<Vec<Shape>, CaseError> {
    let boat = fixtures::boat_hull()?;
    Ok(vec![
        Shape {
            name: "box",
            hull: Hull::cuboid(Vec3::new(4.0, 1.0, 2.0))?,
            closed_form: Box::new(|volume| volume / 8.0),
        },
        Shape {
            name: "sphere",
            hull: Hull::sphere(0.5)?,
            closed_form: Box::new(|volume| truth::sphere_draft(0.5, volume)),
        },
        Shape {
            name: "cylinder",
            hull: Hull::cylinder(0.4, 3.0)?,
            closed_form: Box::new(|volume| truth::cylinder_draft(0.4, volume / 3.0)),
        },
        Shape {
            name: "mesh hull",
            hull: Hull::from_mesh(&vee(), Closure::Cap)?,
            // Immersed section of depth d: a triangle 4 d wide, 5 m long.
            closed_form: Box::new(|volume| (volume / 10.0).sqrt()),
        },
        Shape { name: "boat hull", closed_form: super::body_hull::draft_of(&boat), hull: boat },
    ])
}

/// An open trough with a V section, 5 m long, 4 m wide, 1 m deep: what a boat's mesh is like.
pub(super) fn vee() -> TriMesh {
    let section = [Vec3::new(0.0, 1.0, -2.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 2.0)];
    let ends = [Vec3::X * -2.5, Vec3::X * 2.5];
    let vertices = ends.iter().flat_map(|end| section.map(|v| v + *end)).collect();
    // Two sides and two ends, normals outwards.
    let indices = vec![0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5, 0, 1, 2, 3, 5, 4];
    TriMesh { vertices, indices }
}

fn draft(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for shape in shapes()? {
        let counts: &[Option<u32>] = if shape.name == "sphere" {
            &[None]
        } else {
            context
                .pick(&[None, Some(4), Some(32), Some(256)], &[None, Some(4), Some(8), Some(16), Some(64), Some(256)])
        };
        let summed = counts.iter().map(|count| (*count, Quality::Points));
        for (count, quality) in summed.chain([(None, Quality::Clipped)]) {
            let mut worst = 0.0f64;
            for density in DENSITIES {
                worst = worst.max(draft_error(&shape, density, count, quality)?);
            }
            let mut body = floating(&shape.hull, 0.5, count, quality)?;
            let points = body.force_points().len();
            let water = FlatWater::default();
            let timing = measure(context.effort, || body.step(DT, black_box(&water), &Controls::default()));
            let clipped = quality == Quality::Clipped;
            let variant = if clipped { format!("{}, clipped", shape.name) } else { shape.name.into() };
            let row = Row::new("draft", variant)
                .param("force_points", points)
                .param("chosen", if count.is_some() { "by count" } else { "by default" })
                .error(
                    worst,
                    "%",
                    "closed form (boat hull: its triangles clipped as polygons); worst of densities .25, .5, .75",
                )
                .time("a tick of the body on flat water", &timing);
            rows.push(match count {
                _ if clipped => row.bound(0.2),
                None | Some(32) => row.bound(1.0),
                Some(_) => row,
            });
        }
    }
    Ok(rows)
}

fn floating(hull: &Hull, density: f64, count: Option<u32>, quality: Quality) -> Result<Body, CaseError> {
    let mass = density as f32 * WATER_DENSITY * hull.volume();
    let mut desc = BodyDesc::from_hull(hull, mass);
    if let Some(count) = count {
        desc.points = ForcePoints::Count(count);
    }
    desc.quality = quality;
    // Low, so that every shape floats upright.
    desc.center_of_mass.y = 0.75 * hull.bounds().0.y + 0.25 * hull.bounds().1.y;
    desc.estimate();
    Ok(Body::new(desc)?)
}

/// Percent of the draft, after a drop and a minute to come to rest.
fn draft_error(shape: &Shape, density: f64, count: Option<u32>, quality: Quality) -> Result<f64, CaseError> {
    let mut body = floating(&shape.hull, density, count, quality)?;
    let mut state = body.state();
    state.position.y += 0.05;
    body.set_state(state);
    for _ in 0..60 * 60 {
        body.step(DT, &FlatWater::default(), &Controls::default());
    }
    let (position, _) = body.hull_pose();
    let draft = -f64::from(position.y + shape.hull.bounds().0.y);
    let volume = density * f64::from(shape.hull.volume());
    Ok(100.0 * (draft / (shape.closed_form)(volume) - 1.0).abs())
}

fn tick(context: &Context) -> Result<Vec<Row>, CaseError> {
    const BODIES: usize = 1000;
    let mut rows = Vec::new();
    let hull = fixtures::crate_hull()?;
    // Far longer than the crate: it must ride up and down as the water does.
    let mut wave = AiryWave::new(0.5, 60.0, 0.3);
    let mut bodies = Vec::new();
    let mut random = Random::new(9);
    for _ in 0..BODIES {
        let mut body = Body::new(BodyDesc::from_hull(&hull, fixtures::CRATE_MASS))?;
        let place = Vec3::new(random.within(-200.0, 200.0) as f32, 0.0, random.within(-200.0, 200.0) as f32);
        body.set_state(BodyState::at_rest(place + Vec3::Y * body.rest_height()));
        bodies.push(body);
    }
    let (mut square, mut ticks) = (0.0, 0.0);
    for tick in 0..40 * 60 {
        wave.time = f64::from(tick) * f64::from(DT);
        step(&mut bodies, &wave);
        if tick > 20 * 60 {
            let body = &bodies[0];
            let position = body.state().position;
            let surface = wave.at(glam::Vec2::new(position.x, position.z)).height;
            square += f64::from(position.y - body.rest_height() - surface).powi(2);
            ticks += 1.0;
        }
    }
    let error = 100.0 * f64::sqrt(square / ticks) / 0.5;
    let points = bodies[0].force_points().len();
    let mut numbers = vec![0.0f32; BODIES];
    let [ours, water] = measure_together(
        context.effort,
        [&mut || step(&mut bodies, black_box(&wave)), &mut || {
            numbers.par_iter_mut().enumerate().with_min_len(64).for_each(|(i, number)| {
                *number = wave.patch(glam::Vec2::splat(i as f32), 0.5).height;
            });
        }],
    );
    rows.push(
        Row::new("body_tick", "crates")
            .param("bodies", BODIES)
            .param("force_points", points)
            .error(error, "% of the amplitude", "height of a wave 60 times as long as the body; RMS over 20 s")
            .bound(5.0)
            .time("a tick of all bodies, all threads", &ours)
            .baseline("evaluating the wave once a body, all threads", &water),
    );
    Ok(rows)
}

fn step(bodies: &mut [Body], water: &AiryWave) {
    bodies.par_iter_mut().with_min_len(16).for_each(|body| body.step(DT, water, &Controls::default()));
}

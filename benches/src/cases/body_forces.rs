//! Cases `skin` (friction along a hull), `wind` (drift), `slope` (sliding down a
//! wave's face) and `added_mass` (strips against boundary elements).

use std::f64::consts::PI;

use floating_body::{
    Body, BodyDesc, Closure, Coefficients, Controls, Drag, FlatWater, Hull, Sampling, Skin, SurfacePatch,
    SurfaceSample, TriMesh, WATER_DENSITY, WaterSurface,
};
use glam::{Vec2, Vec3};

use crate::{
    evidence::{Case, CaseError, Context, Row},
    truth::{
        G,
        decay::{HULME, Memory},
    },
};

/// See the module.
pub(super) const SKIN: Case = Case {
    name: "skin",
    about: "skin friction against the published values of the ITTC-1957 line, and a hull that it slows",
    plots: &[],
    run: skin,
};

/// See the module.
pub(super) const WIND: Case =
    Case { name: "wind", about: "drift of a box before the wind, by length of tick", plots: &[], run: wind };

/// See the module.
pub(super) const SLOPE: Case = Case {
    name: "slope",
    about: "acceleration of bodies down a wave's face against g times its slope",
    plots: &[],
    run: slope,
};

/// See the module.
pub(super) const ADDED_MASS: Case = Case {
    name: "added_mass",
    about: "estimated added mass in heave against boundary elements and Hulme's table",
    plots: &[],
    run: added_mass,
};

const DT: f32 = 1.0 / 60.0;

/// A plane through the origin that falls towards +x, under a wind.
struct Plane {
    slope: f32,
    wind: Vec3,
}

impl WaterSurface for Plane {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (p, s) in points.iter().zip(out) {
            let normal = Vec3::new(self.slope, 1.0, 0.0).normalize();
            *s = SurfaceSample { height: -self.slope * p.x, normal, ..SurfaceSample::CALM };
        }
    }
    fn patch(&self, center: Vec2, _: f32) -> SurfacePatch {
        let gradient = Vec2::new(-self.slope, 0.0);
        SurfacePatch { height: gradient.dot(center), gradient, ..SurfacePatch::default() }
    }
    fn wind(&self) -> Vec3 {
        self.wind
    }
}

fn skin(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (reynolds, thousandths) in [(1.0e5, 8.333), (1.0e6, 4.688), (1.0e7, 3.0), (1.0e8, 2.083), (1.0e9, 1.531)] {
        let found = 1e3 * f64::from(Skin::ittc_1957(reynolds));
        rows.push(
            Row::new("skin", "the line")
                .param("reynolds", f64::from(reynolds))
                .param("coefficient_thousandths", found)
                .error(100.0 * (found / thousandths - 1.0).abs(), "%", "ITTC (1957), published to four digits")
                .bound(0.1),
        );
    }
    let mut desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(10.0, 1.0, 2.0))?, 5000.0);
    (desc.drag, desc.coefficients) = (Drag::default(), Coefficients::default());
    desc.skin = Some(Skin { area: 26.0, length: 10.0, form: 1.2 });
    let mut body = Body::new(desc)?;
    let mut state = body.state();
    state.velocity.x = 6.0;
    body.set_state(state);
    for _ in 0..60 * 60 {
        body.step(DT, &FlatWater::default(), &Controls::default());
    }
    let mut speed = 6.0_f64;
    for _ in 0..60_000 {
        let powers = (speed * 10.0 / 1.1883e-6).log10() - 2.0;
        speed -= 1e-3 * 0.5 * 1025.0 * 26.0 * 1.2 * 0.075 / (powers * powers) * speed * speed / 5000.0;
    }
    let found = f64::from(body.state().velocity.x);
    rows.push(
        Row::new("skin", "a hull slows down")
            .param("speed_after_a_minute", found)
            .error(100.0 * (found / speed - 1.0).abs(), "%", "the same equation in steps of 1 ms, f64")
            .bound(1.0),
    );
    Ok(rows)
}

fn wind(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let hull = Hull::cuboid(Vec3::new(2.0, 1.0, 2.0))?;
    for (tick_ms, speed) in [(1.0_f64, 10.0_f32), (1000.0 / 60.0, 10.0), (1000.0 / 60.0, 30.0), (1000.0, 10.0)] {
        let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * 4.0);
        desc.drag.linear = Vec3::ZERO;
        let (air, water) = (0.5 * 1.225 * desc.windage.area.x, desc.drag.quadratic.x);
        let mut body = Body::new(desc)?;
        let dt = (tick_ms / 1000.0) as f32;
        for _ in 0..(120.0 / dt) as u32 {
            body.step(dt, &Plane { slope: 0.0, wind: Vec3::X * speed }, &Controls::default());
        }
        // a (w - v)^2 = q v^2, the wind a quarter metre over the water.
        let expected = f64::from(speed * 0.025_f32.powf(0.11) / (1.0 + (water / air).sqrt()));
        let found = f64::from(body.state().velocity.x);
        rows.push(
            Row::new("wind", "box, half afloat")
                .param("tick_ms", (10.0 * tick_ms).round() / 10.0)
                .param("wind", f64::from(speed))
                .param("drift", found)
                .error(100.0 * (found / expected - 1.0).abs(), "%", "balance of the quadratic drags of air and water")
                .bound(2.0),
        );
    }
    Ok(rows)
}

fn slope(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, hull) in [("crate", Hull::cuboid(Vec3::splat(1.0))?), ("sphere", Hull::sphere(0.5)?)] {
        for sampling in [Sampling::Patch, Sampling::Points] {
            for steep in [0.05_f32, 0.1, 0.2] {
                let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
                (desc.drag, desc.coefficients, desc.sampling) = (Drag::default(), Coefficients::default(), sampling);
                let mut body = Body::new(desc)?;
                // At rest on the face, as it would be carried there.
                for _ in 0..2 * 60 {
                    body.step(DT, &Plane { slope: steep, wind: Vec3::ZERO }, &Controls::default());
                }
                let along = f64::from(body.state().velocity.x) / 2.0;
                let expected = G * f64::from(steep) / (1.0 + f64::from(steep * steep));
                rows.push(
                    Row::new("slope", name)
                        .param("slope", (100.0 * f64::from(steep)).round() / 100.0)
                        .param("reads", if sampling == Sampling::Patch { "patch" } else { "points" })
                        .error(100.0 * (along / expected - 1.0).abs(), "%", "g s/(1 + s^2), without friction, over 2 s")
                        .bound(5.0),
                );
            }
        }
    }
    Ok(rows)
}

/// The barge of `truth::decay` as a mesh, keel at -1.5 m.
fn barge_mesh() -> Result<Hull, CaseError> {
    let mut mesh = TriMesh::default();
    for x in [-10.0, 10.0] {
        for (y, z) in [(-1.5, -5.0), (-1.5, 5.0), (1.5, 5.0), (1.5, -5.0)] {
            mesh.vertices.push(Vec3::new(x, y, z));
        }
    }
    for i in 0..4_u32 {
        let j = (i + 1) % 4;
        mesh.indices.extend([i, j, 4 + i, j, 4 + j, 4 + i]);
    }
    mesh.indices.extend([0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7]);
    Ok(Hull::from_mesh(&mesh, Closure::Require)?)
}

fn added_mass(_: &Context) -> Result<Vec<Row>, CaseError> {
    let barge = Memory::barge();
    let own = |rows: &[[f64; 3]], omega: f64| {
        let next = rows.partition_point(|row| row[0] < omega).clamp(1, rows.len() - 1);
        let (a, b) = (rows[next - 1], rows[next]);
        a[1] + (omega - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
    };
    // At the barge's own frequency, 2 pi / 4.31 s, and the hemisphere's, ka = 1.05.
    let barge_truth = own(barge.rows(), std::f64::consts::TAU / 4.31);
    let half = 2.0 / 3.0 * PI * 125e3;
    let hemisphere_truth = half * own(&HULME, 1.05);
    let box_ = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0))?;
    let mut rows = Vec::new();
    for (name, how, hull, mass, truth, source) in [
        ("barge", "box formula", box_, 300e3, barge_truth, "boundary elements at its own frequency"),
        ("barge", "Lewis sections", barge_mesh()?, 300e3, barge_truth, "boundary elements at its own frequency"),
        ("hemisphere", "formula", Hull::sphere(5.0)?, half, hemisphere_truth, "Hulme (1982) at its own frequency"),
    ] {
        let mut desc = BodyDesc::from_hull(&hull, mass as f32);
        desc.water_density = 1000.0;
        desc.estimate();
        let found = f64::from(desc.coefficients.added_mass.y);
        rows.push(
            Row::new("added_mass", name)
                .param("by", how)
                .param("tonnes", found / 1e3)
                .error(100.0 * (found / truth - 1.0).abs(), "%", source)
                .bound(10.0),
        );
    }
    Ok(rows)
}

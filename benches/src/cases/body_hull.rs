//! Cases `clip_speed`, `quality_pop`, `heeled` and `mass_properties`: hulls clipped at the water surface, their force
//! points, and what they weigh.

use std::hint::black_box;

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Clipper, Closure, Controls, FlatWater, ForcePoints, Hull, Quality,
    SurfacePatch, TriMesh, WATER_DENSITY,
};
use glam::{DMat3, DVec3, Mat3, Quat, Vec2, Vec3};
use rapier3d::parry::mass_properties::MassProperties;

use crate::evidence::{Case, CaseError, Context, Row, measure_together};
use crate::fixtures;

/// See the module.
pub(super) const SPEED: Case = Case {
    name: "clip_speed",
    about: "clipping a boat's hull at the water surface, against clipping every triangle one after the other",
    plots: &[],
    run: speed,
};

/// See the module.
pub(super) const POP: Case = Case {
    name: "quality_pop",
    about: "how far a boat jumps when it is clipped near the eye and summed over points beyond",
    plots: &[],
    run: pop,
};

/// See the module.
pub(super) const HEELED: Case = Case {
    name: "heeled",
    about: "force points of meshes, heeled and trimmed, against the mesh clipped exactly",
    plots: &[],
    run: heeled,
};

/// See the module.
pub(super) const MASS: Case = Case {
    name: "mass_properties",
    about: "volume, centre and inertia of meshes against closed forms, ours and parry's",
    plots: &[],
    run: mass,
};

const DT: f32 = 1.0 / 60.0;

/// The launch of the scenes, some 1,100 triangles.
fn launch() -> Result<Hull, CaseError> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/assets/hulls/launch.obj");
    Ok(Hull::from_file(path, Closure::Cap)?)
}

fn speed(context: &Context) -> Result<Vec<Row>, CaseError> {
    let hull = launch()?;
    let mesh = hull.mesh().cloned().unwrap_or_default();
    let clipper = Clipper::new(&hull);
    let mut rows = Vec::new();
    let level = hull.waterline(0.24 * hull.volume()).level;
    let wave =
        SurfacePatch { gradient: Vec2::new(0.1, 0.05), decay_wavenumber: 0.4, level: -0.2, ..SurfacePatch::default() };
    for (variant, water, rise, heel) in [
        ("afloat", SurfacePatch::default(), -level, 0.0),
        ("heeled 20 degrees", SurfacePatch::default(), -level, 0.35),
        ("wholly under water", SurfacePatch::default(), -3.0, 0.0),
        ("under a wave, fading pressure", wave, -level, 0.1),
    ] {
        let (at, turn) = (Vec3::new(0.0, rise, 0.0), Quat::from_rotation_x(heel));
        let found = clipper.push(at, turn, &water, Vec2::ZERO);
        let truth = plain(&mesh, at, turn, &water);
        // A volume needs no pressure, so it is the same with and without fading.
        let error = 100.0 * f64::from((found.volume - truth.0) / truth.0).abs();
        let [ours, baseline] = measure_together(
            context.effort,
            [
                &mut || {
                    for _ in 0..20 {
                        black_box(clipper.push(black_box(at), turn, &water, Vec2::ZERO));
                    }
                },
                &mut || {
                    for _ in 0..20 {
                        black_box(plain(&mesh, black_box(at), turn, &water));
                    }
                },
            ],
        );
        let millions = 20.0 * clipper.triangles() as f64 / ours.median_ns * 1.0e3;
        rows.push(
            Row::new("clip_speed", variant)
                .param("triangles", clipper.triangles())
                .param("million_triangles_per_s", (millions * 10.0).round() / 10.0)
                .error(error, "%", "displaced volume by a plain scalar clip")
                .bound(0.01)
                .time("20 clips of the hull, one thread", &ours)
                .baseline("clipping every triangle one after the other, without fading", &baseline)
                .note("the bound of 100 million triangles a second is for a core about twice as fast as a Zen 3"),
        );
    }
    Ok(rows)
}

/// What one would write first: each triangle clipped as a polygon. Volume, force and torque over the specific weight.
fn plain(mesh: &TriMesh, at: Vec3, turn: Quat, water: &SurfacePatch) -> (f32, Vec3, Vec3) {
    let rotation = Mat3::from_quat(turn);
    let depth = |p: Vec3| water.height + water.gradient.dot(Vec2::new(p.x, p.z)) - p.y;
    let vertices: Vec<(Vec3, f32)> = mesh
        .vertices
        .iter()
        .map(|v| {
            let p = at + rotation * *v;
            (p, depth(p))
        })
        .collect();
    let (mut force, mut torque) = (Vec3::ZERO, Vec3::ZERO);
    for t in mesh.indices.chunks_exact(3) {
        let corners = [vertices[t[0] as usize], vertices[t[1] as usize], vertices[t[2] as usize]];
        let mut kept = [(Vec3::ZERO, 0.0); 4];
        let mut count = 0;
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if a.1 > 0.0 {
                kept[count] = a;
                count += 1;
            }
            if (a.1 > 0.0) != (b.1 > 0.0) {
                kept[count] = (a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1)), 0.0);
                count += 1;
            }
        }
        for i in 2..count {
            let (a, b, c) = (kept[0], kept[i - 1], kept[i]);
            let area = 0.5 * (b.0 - a.0).cross(c.0 - a.0);
            let sum = a.1 + b.1 + c.1;
            let arm =
                ((a.0 + b.0 + c.0 - 3.0 * at) * sum + (a.0 - at) * a.1 + (b.0 - at) * b.1 + (c.0 - at) * c.1) / 12.0;
            force -= area * (sum / 3.0);
            torque -= arm.cross(area);
        }
    }
    (force.y, force, torque)
}

/// Draft at a displaced volume, by bisection on the triangles clipped as polygons.
pub(super) fn draft_of(hull: &Hull) -> Box<dyn Fn(f64) -> f64> {
    let (mesh, low) = (hull.mesh().cloned().unwrap_or_default(), hull.bounds().0.y);
    let reach = (hull.bounds().1 - hull.bounds().0).length();
    let below = move |h: f32| plain(&mesh, -Vec3::Y * h, Quat::IDENTITY, &SurfacePatch::default()).0;
    Box::new(move |volume| f64::from(level(volume as f32, reach, &below) - low))
}

/// A launch with its eye `distance` away as a function of time, on a wave; heights of its centre of mass.
fn ride(
    quality: Quality,
    water: &mut AiryWave,
    distance: impl Fn(f32) -> f32,
    seconds: u32,
) -> Result<Vec<f32>, CaseError> {
    let hull = fixtures::boat_hull()?;
    let mut desc = BodyDesc::boat(&hull, 0.24 * hull.volume() * WATER_DENSITY, 12.0);
    desc.quality = quality;
    let mut body = Body::new(desc)?;
    let mut heights = Vec::new();
    for tick in 0..seconds * 60 {
        let time = tick as f32 * DT;
        water.time = f64::from(time);
        body.set_distance(distance(time));
        body.step(DT, water, &Controls { throttle: 0.3, ..Controls::default() });
        heights.push(body.state().position.y);
    }
    Ok(heights)
}

fn pop(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (variant, mut wave) in [
        ("calm water", AiryWave::new(0.0, 0.0, 0.0)),
        ("waves of 40 m, .5 m high", AiryWave::new(0.25, 40.0, 0.7)),
        ("waves of 15 m, .3 m high", AiryWave::new(0.15, 15.0, 0.7)),
    ] {
        // The eye comes near at 20 s and goes away at 30 s, at once.
        let eye = |time: f32| if (20.0..30.0).contains(&time) { 5.0 } else { 200.0 };
        let switching = ride(Quality::Near(40.0), &mut wave, eye, 40)?;
        let points = ride(Quality::Points, &mut wave, eye, 40)?;
        let gap: Vec<f32> = switching.iter().zip(&points).map(|(a, b)| a - b).collect();
        // What the eye could take for a jump: the change within a quarter of a second, about the switches.
        let jump = |ticks: std::ops::Range<usize>| ticks.map(|i| (gap[i] - gap[i - 15]).abs()).fold(0.0f32, f32::max);
        let worst = jump(20 * 60..23 * 60).max(jump(30 * 60..33 * 60));
        let apart = gap[..].iter().fold(0.0f32, |a, b| a.max(b.abs()));
        rows.push(
            Row::new("quality_pop", variant)
                .param("apart_at_most_cm", f64::from((apart * 1.0e4).round() / 100.0))
                .error(
                    f64::from(worst) * 100.0,
                    "cm",
                    "change of height within .25 s against a boat that is not switched",
                )
                .bound(2.0),
        );
    }
    Ok(rows)
}

/// The height over the hull's origin at which a plane leaves `volume` below, by bisection.
fn level(volume: f32, reach: f32, mut below: impl FnMut(f32) -> f32) -> f32 {
    let (mut low, mut high) = (-reach, reach);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if below(middle) < volume { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn heeled(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let hulls = [
        ("launch", launch()?),
        ("boat of 22 triangles", fixtures::boat_hull()?),
        ("V trough", Hull::from_mesh(&super::body_float::vee(), Closure::Cap)?),
        ("box", Hull::cuboid(Vec3::new(4.0, 1.0, 2.0))?),
    ];
    for (name, hull) in hulls {
        let reach = (hull.bounds().1 - hull.bounds().0).length();
        for count in context.pick(&[32u32][..], &[8, 16, 32, 64]) {
            let (mut worst, mut used) = (0.0f32, 0);
            for density in [0.25f32, 0.5, 0.75] {
                let volume = density * hull.volume();
                let mut desc = BodyDesc::from_hull(&hull, volume * WATER_DENSITY);
                desc.points = ForcePoints::Count(*count);
                let center = desc.center_of_mass;
                let mut body = Body::new(desc)?;
                used = body.force_points().len();
                let clipped = |turn: Quat| level(volume, reach, |h| hull.clip(Vec3::ZERO, turn, |_| h).volume);
                let draft = clipped(Quat::IDENTITY) - hull.bounds().0.y;
                for (heel, trim) in [(0.0f32, 0.0f32), (10.0, 0.0), (20.0, 0.0), (0.0, 3.0), (20.0, 3.0)] {
                    let turn = Quat::from_rotation_x(heel.to_radians()) * Quat::from_rotation_z(trim.to_radians());
                    let summed = level(volume, reach, |h| {
                        body.set_state(BodyState {
                            orientation: turn,
                            ..BodyState::at_rest(turn * center - Vec3::Y * h)
                        });
                        body.step(1.0e-6, &FlatWater::default(), &Controls::default());
                        body.immersed_volume()
                    });
                    worst = worst.max((summed - clipped(turn)).abs() / draft);
                }
            }
            let row = Row::new("heeled", name).param("force_points", used).error(
                100.0 * f64::from(worst),
                "% of the draft",
                "the mesh clipped exactly; densities .25 to .75, heel to 20, trim to 3 degrees",
            );
            rows.push(match (name, count) {
                ("launch", 32) => row.bound(1.0),
                ("boat of 22 triangles", 32) => row.note("flat panels with sharp chines, which columns round off"),
                ("box", 32) => row.note("boxes of one size, which any attitude finds alike; not fitted"),
                ("V trough", 32) => row.note("sides of 26 degrees over the whole height: no column follows them"),
                _ => row,
            });
        }
    }
    Ok(rows)
}

/// A tetrahedron with its corners on the axes at `a`, `b` and `c`, moved: its products of inertia are not zero.
fn corner(sides: DVec3, at: DVec3) -> (TriMesh, f64, DVec3, DMat3) {
    let vertices =
        [DVec3::ZERO, DVec3::X * sides.x, DVec3::Y * sides.y, DVec3::Z * sides.z].map(|v| (v + at).as_vec3());
    let mesh = TriMesh { vertices: vertices.to_vec(), indices: vec![0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
    let s = sides;
    // About the centroid per mass: second moments 3/80 s_i^2, products -1/80 s_i s_j of position.
    let square = |i: usize, j: usize| if i == j { 3.0 * s[i] * s[i] / 80.0 } else { -s[i] * s[j] / 80.0 };
    let trace = square(0, 0) + square(1, 1) + square(2, 2);
    let entry = |i: usize, j: usize| if i == j { trace - square(i, j) } else { -square(i, j) };
    let inertia = DMat3::from_cols(
        DVec3::new(entry(0, 0), entry(1, 0), entry(2, 0)),
        DVec3::new(entry(0, 1), entry(1, 1), entry(2, 1)),
        DVec3::new(entry(0, 2), entry(1, 2), entry(2, 2)),
    );
    (mesh, s.x * s.y * s.z / 6.0, at + s / 4.0, inertia)
}

fn mass(_: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (name, sides, at) in [
        ("corner at the origin", DVec3::new(2.0, 1.0, 3.0), DVec3::ZERO),
        ("corner 20 m away", DVec3::new(2.0, 1.0, 3.0), DVec3::new(20.0, -5.0, 11.0)),
        ("flat corner 5 m away", DVec3::new(6.0, 0.1, 2.0), DVec3::new(5.0, 0.0, -1.0)),
    ] {
        let (mesh, volume, center, inertia) = corner(sides, at);
        let hull = Hull::from_mesh(&mesh, Closure::Require)?;
        let size = sides.length();
        let worst = |v: f64, c: DVec3, i: DMat3| {
            let off = (0..3).map(|k| (i.col(k) - inertia.col(k)).abs().max_element()).fold(0.0, f64::max);
            100.0
                * (v / volume - 1.0)
                    .abs()
                    .max(c.distance(center) / size)
                    .max(off / inertia.col(1).y.max(inertia.col(0).x))
        };
        let ours = worst(f64::from(hull.volume()), hull.centroid().as_dvec3(), hull.unit_inertia().as_dmat3());
        let points: Vec<_> = mesh.vertices.iter().map(|v| rapier3d::math::Vector::new(v.x, v.y, v.z)).collect();
        let triangles: Vec<[u32; 3]> = mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let p = MassProperties::from_trimesh(1.0, &points, &triangles);
        let tensor = p.reconstruct_inertia_matrix() * p.inv_mass;
        let columns = tensor.to_cols_array_2d().map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2])));
        let tensor = DMat3::from_cols(columns[0], columns[1], columns[2]);
        let center = DVec3::new(f64::from(p.local_com.x), f64::from(p.local_com.y), f64::from(p.local_com.z));
        let theirs = worst(f64::from(1.0 / p.inv_mass), center, tensor);
        let against = "closed form; worst of volume, centre over size, inertia over its largest";
        rows.push(Row::new("mass_properties", format!("{name}, ours")).error(ours, "%", against).bound(0.001));
        rows.push(Row::new("mass_properties", format!("{name}, parry")).error(theirs, "%", against));
    }
    Ok(rows)
}

//! Clipping at the water surface against closed forms, and bodies that float by it.

use floating_body::{
    Body, BodyDesc, BodyState, Closure, Controls, FlatWater, Hull, Quality, Sampling, TriMesh, WATER_DENSITY,
};
use glam::{Mat3, Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;

/// A prism along x, from -3 to 3 m, over a section of (z, y), clockwise seen from the bow.
fn prism(section: &[(f32, f32)]) -> Hull {
    let n = section.len() as u32;
    let mut mesh = TriMesh::default();
    for x in [-3.0, 3.0] {
        mesh.vertices.extend(section.iter().map(|(z, y)| Vec3::new(x, *y, *z)));
    }
    for i in 0..n {
        let j = (i + 1) % n;
        mesh.indices.extend([i, j, n + i, j, n + j, n + i]);
    }
    for i in 1..n - 1 {
        mesh.indices.extend([0, i + 1, i, n, n + i, n + i + 1]);
    }
    Hull::from_mesh(&mesh, Closure::Require).unwrap()
}

/// V bottom: keel at 0, chines at 1, sides up to 2, 2 m wide.
fn wedge() -> Hull {
    prism(&[(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (-1.0, 2.0), (-1.0, 1.0)])
}

/// A section's area and first moments below the line `height` over the origin along the unit vector (nz, ny), by
/// Sutherland's and Hodgman's clipping of the polygon, in f64.
fn section_below(section: &[(f64, f64)], n: (f64, f64), height: f64) -> (f64, f64, f64) {
    let depth = |p: (f64, f64)| height - n.0 * p.0 - n.1 * p.1;
    let mut kept = Vec::new();
    for (i, a) in section.iter().enumerate() {
        let b = section[(i + 1) % section.len()];
        let (da, db) = (depth(*a), depth(b));
        if da >= 0.0 {
            kept.push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            let t = da / (da - db);
            kept.push((a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1)));
        }
    }
    let (mut area, mut z, mut y) = (0.0, 0.0, 0.0);
    for (i, a) in kept.iter().enumerate() {
        let b = kept[(i + 1) % kept.len()];
        let cross = (a.0 * b.1 - b.0 * a.1) / 2.0;
        (area, z, y) = (area + cross, z + cross * (a.0 + b.0) / 3.0, y + cross * (a.1 + b.1) / 3.0);
    }
    (area, z / area, y / area)
}

#[test]
fn a_heeled_prism_displaces_what_its_section_does() {
    let section: [(f64, f64); 5] = [(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (-1.0, 2.0), (-1.0, 1.0)];
    let hull = wedge();
    for degrees in [-50.0_f32, -20.0, 0.0, 5.0, 35.0, 80.0, 140.0] {
        let heel = degrees.to_radians();
        let turn = Quat::from_rotation_x(heel);
        for rise in [-1.5_f32, -0.9, -0.3] {
            let clip = hull.clip(Vec3::new(7.0, rise, -4.0), turn, |_| 0.0);
            // World y of a hull point is rise + y cos(heel) + z sin(heel)... with z turned towards -y for x forward.
            let up = turn.inverse() * Vec3::Y;
            let n = (f64::from(up.z), f64::from(up.y));
            let (area, z, y) = section_below(&section, n, f64::from(-rise));
            let volume = 6.0 * area;
            if volume < 1e-9 {
                assert!(clip.volume.abs() < 1e-5, "{degrees} {rise}: {}", clip.volume);
                continue;
            }
            let center = Vec3::new(7.0, rise, -4.0) + turn * Vec3::new(0.0, y as f32, z as f32);
            assert!((f64::from(clip.volume) / volume - 1.0).abs() < 1e-5, "{degrees} {rise}: {} {volume}", clip.volume);
            assert!(clip.center.distance(center) < 1e-4, "{degrees} {rise}: {} {center}", clip.center);
            assert!(clip.force.abs_diff_eq(Vec3::Y * clip.volume, 1e-4), "{}", clip.force);
            let arm = clip.center - Vec3::new(7.0, rise, -4.0);
            assert!(clip.torque.abs_diff_eq(arm.cross(clip.force), 1e-3), "{}", clip.torque);
        }
    }
}

#[test]
fn the_waterline_of_a_box_is_its_outline() {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let clip = hull.clip(Vec3::new(0.0, 0.2, 0.0), Quat::IDENTITY, |_| 0.0);
    assert!((clip.volume - 8.0 * 0.3).abs() < 1e-5, "{}", clip.volume);
    assert!((clip.waterplane - 8.0).abs() < 1e-5, "{}", clip.waterplane);
    assert!((clip.wetted - (8.0 + 12.0 * 0.3)).abs() < 1e-5, "{}", clip.wetted);
    let [line] = clip.waterline.as_slice() else { panic!("{} lines", clip.waterline.len()) };
    assert!(line.iter().all(|p| p.y.abs() < 1e-6 && (p.x.abs() > 1.999 || p.z.abs() > 0.999)), "{line:?}");
    assert!(hull.clip(Vec3::Y, Quat::IDENTITY, |_| 0.0).waterline.is_empty());
}

#[test]
fn a_ring_encloses_less_than_its_outline() {
    // A moon pool: a square tube standing on end, 2 m outside and 1 m inside.
    let (mut mesh, corners) = (TriMesh::default(), [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]);
    for (scale, y) in [(1.0, -1.0), (1.0, 1.0), (0.5, -1.0), (0.5, 1.0)] {
        mesh.vertices.extend(corners.map(|(x, z)| Vec3::new(x * scale, y, z * scale)));
    }
    for i in 0..4_u32 {
        let j = (i + 1) % 4;
        for (a, b) in [(0, 4), (4, 12), (12, 8), (8, 0)] {
            mesh.indices.extend([a + i, b + i, a + j, a + j, b + i, b + j]);
        }
    }
    let hull = Hull::from_mesh(&mesh, Closure::Require).unwrap();
    let clip = hull.clip(Vec3::Y * 0.25, Quat::IDENTITY, |_| 0.0);
    assert_eq!(clip.waterline.len(), 2);
    assert!((clip.waterplane - 3.0).abs() < 1e-5 && (clip.volume - 2.25).abs() < 1e-5, "{clip:?}");
}

#[test]
fn pressure_under_a_slope_acts_along_its_normal() {
    let hull = Hull::sphere(1.0).unwrap();
    let clip = hull.clip(Vec3::ZERO, Quat::IDENTITY, |p: Vec2| 0.2 * p.x - 0.1 * p.y);
    let half = 0.5 * hull.volume();
    assert!((clip.volume / half - 1.0).abs() < 1e-4, "{}", clip.volume);
    assert!(clip.force.abs_diff_eq(Vec3::new(-0.2, 1.0, 0.1) * half, 1e-3), "{}", clip.force);
}

fn floating(hull: &Hull, density: f32, quality: Quality, sampling: Sampling) -> Body {
    let mut desc = BodyDesc::from_hull(hull, density * WATER_DENSITY * hull.volume());
    desc.center_of_mass.y = 0.75 * hull.bounds().0.y + 0.25 * hull.bounds().1.y;
    desc.estimate();
    (desc.quality, desc.sampling) = (quality, sampling);
    Body::new(desc).unwrap()
}

fn settled_draft(hull: &Hull, density: f32, sampling: Sampling) -> f32 {
    let mut body = floating(hull, density, Quality::Clipped, sampling);
    let mut state = body.state();
    state.position.y += 0.05;
    body.set_state(state);
    for _ in 0..120 * 60 {
        body.step(DT, &FlatWater::default(), &Controls::default());
    }
    -(body.hull_pose().0.y + hull.bounds().0.y)
}

fn draft_of(share: impl Fn(f64) -> f64, density: f64, height: f64) -> f32 {
    let (mut low, mut high) = (0.0, height);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if share(middle) < density { low = middle } else { high = middle }
    }
    low as f32
}

#[test]
fn clipped_bodies_float_at_closed_forms() {
    let segment = |d: f64| {
        let u = (0.3 - d) / 0.3;
        (u.acos() - u * (1.0 - u * u).sqrt()) / std::f64::consts::PI
    };
    for density in [0.25_f64, 0.5, 0.75] {
        for sampling in [Sampling::Patch, Sampling::Points] {
            // A polyhedron stands for what is round under several samples.
            let bound = if sampling == Sampling::Patch { 0.001 } else { 0.01 };
            let close = |hull: Hull, expected: f32, bound: f32| {
                let draft = settled_draft(&hull, density as f32, sampling);
                assert!((draft / expected - 1.0).abs() < bound, "{density} {sampling:?}: {draft} against {expected}");
            };
            close(Hull::cuboid(Vec3::new(3.0, 0.8, 2.0)).unwrap(), density as f32 * 0.8, 0.001);
            let cap = draft_of(|d| d * d * (1.5 - d) / (4.0 * 0.125), density, 1.0);
            close(Hull::sphere(0.5).unwrap(), cap, bound);
            close(Hull::cylinder(0.3, 4.0).unwrap(), draft_of(segment, density, 0.6), bound);
            let share = |d: f64| if d < 1.0 { d * d / 3.0 } else { (1.0 + 2.0 * (d - 1.0)) / 3.0 };
            close(wedge(), draft_of(share, density, 2.0), 0.001);
        }
    }
}

#[test]
fn clipping_keeps_the_energy_of_free_swinging() {
    for (hull, sampling) in [
        (wedge(), Sampling::Points),
        (wedge(), Sampling::Patch),
        (Hull::cylinder(0.4, 2.0).unwrap(), Sampling::Patch),
        (Hull::sphere(0.4).unwrap(), Sampling::Patch),
    ] {
        let mut desc = BodyDesc::from_hull(&hull, 0.3 * WATER_DENSITY * hull.volume());
        (desc.quality, desc.sampling) = (Quality::Clipped, sampling);
        desc.drag = floating_body::Drag::default();
        desc.coefficients.damping = Vec3::ZERO;
        desc.coefficients.angular_damping = Vec3::ZERO;
        desc.center_of_mass += Vec3::new(0.05, -0.1, 0.02);
        desc.coefficients.added_mass = Vec3::ZERO;
        desc.coefficients.added_inertia = Vec3::ZERO;
        let mut body = Body::new(desc).unwrap();
        let start = body.state();
        body.set_state(BodyState {
            position: start.position + Vec3::Y,
            orientation: Quat::from_euler(glam::EulerRot::XYZ, 0.9, 0.2, 0.4),
            ..start
        });
        // Of motion, of height and of the water that the hull holds down.
        let energy = |body: &Body| {
            let (state, mass) = (body.state(), body.desc().mass);
            let turn = Mat3::from_quat(state.orientation);
            let spin = turn.transpose() * state.angular_velocity;
            let (origin, orientation) = body.hull_pose();
            let clip = hull.clip(origin, orientation, |_| 0.0);
            let water = WATER_DENSITY * clip.volume * -clip.center.y;
            0.5 * mass * state.velocity.length_squared()
                + 0.5 * spin.dot(body.inertia() * spin)
                + 9.81 * (mass * state.position.y + water)
        };
        let first = energy(&body);
        let swing = 9.81 * body.desc().mass;
        let mut most = 0.0_f32;
        for tick in 0..60 * 240 {
            body.step(DT / 4.0, &FlatWater::default(), &Controls::default());
            if tick % 10 > 0 {
                continue;
            }
            most = most.max((energy(&body) - first).abs() / swing);
        }
        assert!(most < 0.03, "{sampling:?}: energy changed by {most} of a metre's fall");
    }
}

#[test]
fn a_near_body_fades_from_one_quality_to_the_other() {
    let hull = wedge();
    let mut body = floating(&hull, 0.3, Quality::Near(20.0), Sampling::Points);
    let step = |body: &mut Body, distance: f32, ticks: u32| {
        body.set_distance(distance);
        let mut steepest = 0.0_f32;
        for _ in 0..ticks {
            let before = body.clipped_share();
            body.step(DT, &FlatWater::default(), &Controls::default());
            steepest = steepest.max((body.clipped_share() - before).abs());
        }
        steepest
    };
    step(&mut body, 100.0, 5);
    assert_eq!(body.clipped_share(), 0.0);
    let steepest = step(&mut body, 5.0, 60);
    assert!(body.clipped_share() == 1.0 && steepest < 0.05, "{} {steepest}", body.clipped_share());
    step(&mut body, f32::NAN, 60);
    assert_eq!(body.clipped_share(), 1.0);
    step(&mut body, 22.5, 60);
    assert!((body.clipped_share() - 0.5).abs() < 0.01, "{}", body.clipped_share());
    let bad = BodyDesc { quality: Quality::Near(0.0), ..BodyDesc::from_hull(&hull, 1000.0) };
    assert!(Body::new(bad).unwrap_err().to_string().starts_with("quality is 0"));
}

//! Floatation against closed forms.

use floating_body::{
    Body, BodyDesc, BodyState, Controls, FlatWater, ForcePoints, Home, Hull, Radiation, Sampling, SurfacePatch,
    SurfaceSample, TriMesh, WATER_DENSITY, WaterSurface,
};
use glam::{Mat3, Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;

fn settle(body: &mut Body, seconds: f32) {
    let water = FlatWater::default();
    for _ in 0..(seconds / DT) as u32 {
        body.step(DT, &water, &Controls::default());
    }
}

/// Depth of the lowest point of a hull that floats upright at rest.
fn settled_draft(hull: &Hull, density: f32) -> f32 {
    let mut body = Body::new(BodyDesc::from_hull(hull, density * WATER_DENSITY * hull.volume())).unwrap();
    let mut state = body.state();
    state.position.y += 0.1 * hull.bounds().1.y;
    body.set_state(state);
    settle(&mut body, 120.0);
    -(body.state().position.y + hull.bounds().0.y)
}

/// Bisection in f64 on a closed form of the immersed share at a draft.
fn draft_of(share: impl Fn(f64) -> f64, density: f64, height: f64) -> f32 {
    let (mut low, mut high) = (0.0, height);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if share(middle) < density { low = middle } else { high = middle }
    }
    low as f32
}

#[test]
fn drafts_of_closed_shapes_match_closed_forms() {
    for density in [0.2, 0.5, 0.8] {
        let flat = settled_draft(&Hull::cuboid(Vec3::new(3.0, 0.8, 2.0)).unwrap(), density);
        assert!((flat / (density * 0.8) - 1.0).abs() < 0.01, "box {density}: {flat}");

        let ball = settled_draft(&Hull::sphere(0.5).unwrap(), density);
        let cap = draft_of(|d| d * d * (1.5 - d) / (4.0 * 0.125), f64::from(density), 1.0);
        assert!((ball / cap - 1.0).abs() < 0.01, "sphere {density}: {ball} against {cap}");

        let log = settled_draft(&Hull::cylinder(0.3, 4.0).unwrap(), density);
        let segment = |d: f64| {
            let u = (0.3 - d) / 0.3;
            (u.acos() - u * (1.0 - u * u).sqrt()) / std::f64::consts::PI
        };
        let expected = draft_of(segment, f64::from(density), 0.6);
        assert!((log / expected - 1.0).abs() < 0.01, "cylinder {density}: {log} against {expected}");
    }
}

#[test]
fn an_upright_cylinder_floats_by_its_length() {
    let hull = Hull::cylinder(0.6, 0.8).unwrap();
    let mut body = Body::new(BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume())).unwrap();
    let mut state = body.state();
    state.orientation = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    state.position.y = 0.02;
    body.set_state(state);
    settle(&mut body, 60.0);
    assert!(body.state().position.y.abs() < 0.008, "{}", body.state().position.y);
}

/// A prism with a V bottom: keel at 0, chines at height 1, sides up to 2, 6 m long, 2 m wide.
fn wedge() -> TriMesh {
    let section = [(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (-1.0, 2.0), (-1.0, 1.0)];
    let mut mesh = TriMesh::default();
    for x in [-3.0, 3.0] {
        mesh.vertices.extend(section.iter().map(|(z, y)| Vec3::new(x, *y, *z)));
    }
    for i in 0..5_u32 {
        let j = (i + 1) % 5;
        mesh.indices.extend([i, j, 5 + i, j, 5 + j, 5 + i]);
    }
    for i in 1..4 {
        mesh.indices.extend([0, i + 1, i, 5, 5 + i, 6 + i]);
    }
    mesh
}

#[test]
fn a_mesh_hull_floats_at_its_draft() {
    let hull = Hull::from_mesh(&wedge(), floating_body::Closure::Require).unwrap();
    assert!((hull.volume() - 18.0).abs() < 1e-3, "{}", hull.volume());
    for displaced in [1.5_f32, 2.5, 4.0, 6.0, 10.0] {
        let expected = if displaced < 6.0 { (displaced / 6.0).sqrt() } else { 1.0 + (displaced - 6.0) / 12.0 };
        let mut desc = BodyDesc::from_hull(&hull, displaced * WATER_DENSITY);
        desc.center_of_mass.y = 0.5;
        let mut body = Body::new(desc).unwrap();
        let mut state = body.state();
        state.position.y += 0.2;
        body.set_state(state);
        settle(&mut body, 90.0);
        let draft = 0.5 - body.state().position.y;
        assert!((draft / expected - 1.0).abs() < 0.01, "{displaced}: {draft} against {expected}");
        assert!(body.force_points().len() <= 40);
    }
}

#[test]
fn force_points_carry_the_whole_volume() {
    let wedge = Hull::from_mesh(&wedge(), floating_body::Closure::Require).unwrap();
    let tube = Hull::hollow_cylinder(6.0, 1.0, 0.9).unwrap();
    let box_ = Hull::cuboid(Vec3::new(2.0, 1.0, 1.5)).unwrap();
    for hull in [wedge, tube, box_, Hull::sphere(1.0).unwrap(), Hull::cylinder(0.5, 3.0).unwrap()] {
        for count in [4, 8, 32, 100] {
            let points = hull.force_points(count, hull.volume() * 0.4);
            let sum: f32 = points.iter().map(|p| p.volume).sum();
            assert!((sum / hull.volume() - 1.0).abs() < 1e-4, "{count}: {sum} of {}", hull.volume());
        }
    }
}

/// Box barge 20 x 10 x 3 m, draft 1.5, centre of mass at the waterline.
fn barge(radiation: Radiation) -> Body {
    let hull = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 300.0 * WATER_DENSITY);
    assert_eq!(desc.center_of_mass, Vec3::ZERO);
    assert_eq!(desc.sampling, Sampling::Points);
    desc.radiation = radiation;
    desc.coefficients.damping = Vec3::ZERO;
    desc.coefficients.angular_damping = Vec3::ZERO;
    desc.drag = floating_body::Drag::default();
    desc.points = ForcePoints::Count(50);
    Body::new(desc).unwrap()
}

#[test]
fn the_barge_has_its_metacentric_heights() {
    let body = barge(Radiation::Coefficients);
    let heights = body.metacentric_heights();
    assert!((heights.x / 4.806 - 1.0).abs() < 0.01 && (heights.y / 21.47 - 1.0).abs() < 0.01, "{heights}");
    assert!((body.waterline().center_of_buoyancy.y + 0.75).abs() < 0.0075);
}

/// Flat water with a grid that never answers.
struct Carried;

impl WaterSurface for Carried {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        FlatWater::default().sample(points, out);
    }
    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        FlatWater::default().patch(center, radius)
    }
    fn home(&self) -> Home {
        Home::Own
    }
}

/// Period in s from the zero crossings of a lightly excited mode.
fn period(body: &mut Body, mode: impl Fn(&BodyState) -> f32) -> f32 {
    let (mut before, mut crossings) = (mode(&body.state()), Vec::new());
    for tick in 0..4000 {
        body.step(DT / 2.0, &Carried, &Controls::default());
        let now = mode(&body.state());
        if before < 0.0 && now >= 0.0 {
            crossings.push((tick as f32 + before / (before - now)) * DT / 2.0);
        }
        before = now;
    }
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f32
}

fn released(radiation: Radiation, change: impl Fn(&mut BodyState)) -> Body {
    let mut body = barge(radiation);
    let mut state = body.state();
    change(&mut state);
    body.set_state(state);
    body
}

#[test]
fn the_barge_heaves_rolls_and_pitches_in_its_periods() {
    let heave = |s: &mut BodyState| s.position.y += 0.1;
    let roll = |s: &mut BodyState| s.orientation = Quat::from_rotation_x(0.02);
    let pitch = |s: &mut BodyState| s.orientation = Quat::from_rotation_z(0.01);
    for (radiation, expected) in [(Radiation::Coefficients, [4.31, 3.84, 4.00]), (Radiation::Grid, [2.457, 2.76, 2.53])]
    {
        let found = [
            period(&mut released(radiation, heave), |s| s.position.y),
            period(&mut released(radiation, roll), |s| s.orientation.x),
            period(&mut released(radiation, pitch), |s| s.orientation.z),
        ];
        for (f, e) in found.iter().zip(expected) {
            assert!((f / e - 1.0).abs() < 0.05, "{radiation:?}: {found:?} against {expected:?}");
        }
    }
}

#[test]
fn a_hemisphere_has_coefficients_near_hulmes() {
    // Hulme (1982) at ka = 1.05, the natural frequency: A = .42, B = .24 of the displaced mass (times omega).
    let hull = Hull::sphere(5.0).unwrap();
    let mass = 0.5 * WATER_DENSITY * hull.volume();
    let c = BodyDesc::from_hull(&hull, mass).coefficients;
    let omega = (1.05_f32 * 9.81 / 5.0).sqrt();
    assert!((c.added_mass.y / mass / 0.42 - 1.0).abs() < 0.12, "{}", c.added_mass.y / mass);
    assert!((c.damping.y / (mass * omega) / 0.24 - 1.0).abs() < 0.15, "{}", c.damping.y / (mass * omega));
}

#[test]
fn the_papers_cylinder_is_isotropic_at_the_corrected_radius_only() {
    let (length, ratio, mass) = (3.0_f32, 0.9_f32, 7.0_f32);
    let radius = Hull::isotropic_radius(length, ratio);
    let tensor = Hull::hollow_cylinder(length, radius, ratio).unwrap().unit_inertia() * mass;
    let expected = mass * length * length / 6.0;
    assert!(tensor.abs_diff_eq(Mat3::from_diagonal(Vec3::splat(expected)), 1e-4), "{tensor}");

    // R = L/2 at mu = .9, as printed: Izz = .905 M R^2, and 15 % beside the other two.
    let printed = Hull::hollow_cylinder(2.0, 1.0, 0.9).unwrap();
    let t = printed.unit_inertia();
    assert!((t.x_axis.x - 0.905).abs() < 1e-4 && (t.z_axis.z / t.x_axis.x - 0.868).abs() < 1e-2, "{t}");
    let mut desc = BodyDesc::from_hull(&printed, 1000.0);
    desc.inertia = floating_body::Inertia::PreRigid;
    assert!(Body::new(desc).unwrap().inertia_mismatch() > 0.14);
    let third = Hull::hollow_cylinder(2.0, 1.0, (1.0_f32 / 3.0).sqrt()).unwrap();
    assert!(Body::new(BodyDesc::from_hull(&third, 1000.0)).unwrap().inertia_mismatch() < 1e-3);
}

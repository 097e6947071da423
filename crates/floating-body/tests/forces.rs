//! Wind, friction and blows against closed forms.

use std::f64::consts::{FRAC_PI_2, PI};

use floating_body::{
    Body, BodyDesc, BodyState, Closure, Coefficients, Controls, Drag, FlatWater, ForcePoints, Hull, Skin, Slamming,
    SurfacePatch, SurfaceSample, TriMesh, WATER_DENSITY, WaterSurface,
};
use glam::{Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;

/// Flat water under a wind.
struct Windy(Vec3);

impl WaterSurface for Windy {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        out[..points.len()].fill(SurfaceSample::CALM);
    }
    fn patch(&self, _: Vec2, _: f32) -> SurfacePatch {
        SurfacePatch::default()
    }
    fn wind(&self) -> Vec3 {
        self.0
    }
}

fn run(body: &mut Body, seconds: f32, water: &dyn WaterSurface, controls: &Controls) {
    for _ in 0..(seconds / DT) as u32 {
        body.step(DT, water, controls);
    }
}

#[test]
fn a_box_drifts_where_wind_and_water_balance() {
    let hull = Hull::cuboid(Vec3::new(2.0, 1.0, 2.0)).unwrap();
    for (wind, sign) in [(10.0_f32, 1.0), (-25.0, -1.0)] {
        let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * 4.0);
        desc.drag.linear = Vec3::ZERO;
        let (air, water) = (0.5 * 1.225 * desc.windage.area.x, desc.drag.quadratic.x);
        // Area over the water: 2 m by .5 m, at .25 m of height, where the wind is (.025)^.11 of that at 10 m.
        assert!((desc.windage.area.x - 1.0).abs() < 1e-3, "{}", desc.windage.area);
        let mut body = Body::new(desc).unwrap();
        run(&mut body, 120.0, &Windy(Vec3::X * wind), &Controls::default());
        let felt = wind.abs() * 0.025_f32.powf(0.11);
        // a (w - v)^2 = q v^2.
        let expected = sign * felt / (1.0 + (water / air).sqrt());
        let speed = body.state().velocity.x;
        assert!((speed / expected - 1.0).abs() < 0.02, "{speed} against {expected}");
    }
}

#[test]
fn light_things_are_blown_along_at_any_step() {
    let hull = Hull::sphere(0.3).unwrap();
    for dt in [0.001_f32, 1.0 / 60.0, 1.0] {
        let mut body = Body::new(BodyDesc::from_hull(&hull, 0.05)).unwrap();
        for _ in 0..(20.0 / dt) as u32 {
            body.step(dt, &Windy(Vec3::new(20.0, 0.0, 0.0)), &Controls::default());
        }
        let speed = body.state().velocity.x;
        assert!(speed > 0.5 && speed < 20.0, "{dt}: {speed}");
    }
}

#[test]
fn a_side_wind_heels_a_boat() {
    let hull = Hull::cuboid(Vec3::new(8.0, 2.0, 2.5)).unwrap();
    let mut body = Body::new(BodyDesc::boat(&hull, 9000.0, 8.0)).unwrap();
    let mut lee = 0.0_f32;
    for _ in 0..10 {
        run(&mut body, 1.0, &Windy(Vec3::Z * 20.0), &Controls::default());
        lee = lee.min((body.state().orientation * Vec3::Z).y);
    }
    assert!(lee < -0.005 && lee > -0.3, "{lee}");
}

#[test]
fn a_plate_s_friction_is_that_of_the_line() {
    // The skin alone slows the hull: m dv/dt = -rho S Cf(v) (1 + k) v^2 / 2, here by small steps in f64.
    let hull = Hull::cuboid(Vec3::new(10.0, 1.0, 2.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 5000.0);
    (desc.drag, desc.coefficients) = (Drag::default(), Coefficients::default());
    let skin = Skin { area: 26.0, length: 10.0, form: 1.2 };
    desc.skin = Some(skin);
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.velocity.x = 6.0;
    body.set_state(state);
    run(&mut body, 60.0, &FlatWater::default(), &Controls::default());
    let mut speed = 6.0_f64;
    for _ in 0..60_000 {
        let powers = (speed * 10.0 / 1.1883e-6).log10() - 2.0;
        speed -= 1e-3 * 0.5 * 1025.0 * 26.0 * 1.2 * 0.075 / (powers * powers) * speed * speed / 5000.0;
    }
    let found = f64::from(body.state().velocity.x);
    assert!((found / speed - 1.0).abs() < 2e-3, "{found} against {speed}");
}

/// A wedge 10 m long with its keel at 0 and its chines 1 m out.
fn wedge(deadrise: f32) -> Hull {
    let rise = deadrise.tan();
    let section = [(0.0, 0.0), (1.0, rise), (1.0, rise + 1.0), (-1.0, rise + 1.0), (-1.0, rise)];
    let mut mesh = TriMesh::default();
    for x in [-5.0, 5.0] {
        mesh.vertices.extend(section.iter().map(|(z, y)| Vec3::new(x, *y, *z)));
    }
    for i in 0..5_u32 {
        let j = (i + 1) % 5;
        mesh.indices.extend([i, j, 5 + i, j, 5 + j, 5 + i]);
    }
    for i in 1..4 {
        mesh.indices.extend([0, i + 1, i, 5, 5 + i, 6 + i]);
    }
    Hull::from_mesh(&mesh, Closure::Require).unwrap()
}

/// A falling wedge has lost `m/(M + m)` of its speed to the mass `m` of the water that moves with it, which is a plate's of
/// the width that is wet.
#[test]
fn a_wedge_s_fall_is_broken_as_by_the_water_that_it_catches() {
    for degrees in [10.0_f32, 20.0, 30.0] {
        let deadrise = degrees.to_radians();
        let hull = wedge(deadrise);
        let mut desc = BodyDesc::from_hull(&hull, 1e6);
        (desc.drag, desc.coefficients, desc.skin) = (Drag::default(), Coefficients::default(), None);
        desc.points = ForcePoints::Count(256);
        desc.slamming = Some(Slamming { deadrise });
        desc.center_of_mass = Vec3::new(0.0, 0.5, 0.0);
        let mut body = Body::new(desc).unwrap();
        let keel = 0.5;
        let mut state = BodyState::at_rest(Vec3::Y * (keel + 0.3));
        body.set_state(state);
        body.step(1e-4, &FlatWater::default(), &Controls::default());
        state.velocity.y = -10.0;
        body.set_state(state);
        let rho = f64::from(WATER_DENSITY);
        // Pabst for a hull five times as long as wide; a wedge's share of a plate's mass.
        let finite = 5.0 / 26f64.sqrt() * (1.0 - 0.425 * 5.0 / 26.0);
        let blunt = (1.0 - f64::from(deadrise) / (2.0 * PI)).powi(2);
        let pile_up = FRAC_PI_2 - f64::from(deadrise) * (1.0 - 2.0 / PI);
        let (mut worst, mut fell) = (0.0f64, 0.0);
        loop {
            fell += 9.81 * 5e-4;
            body.step(5e-4, &FlatWater::default(), &Controls::default());
            let depth = f64::from(keel - body.state().position.y);
            let width = depth * pile_up / f64::from(deadrise.tan());
            if width > 1.0 {
                break;
            }
            if width > 0.15 {
                let caught = rho * FRAC_PI_2 * width * width * blunt * finite * 10.0;
                // But for its weight; buoyancy hardly counts at 10 m/s.
                let expected = 10.0 * 1e6 / (1e6 + caught);
                let lost = 10.0 + f64::from(body.state().velocity.y) + fell;
                worst = worst.max((lost - (10.0 - expected)).abs());
            }
        }
        let caught = rho * FRAC_PI_2 * blunt * finite * 10.0;
        let whole = 10.0 * caught / (1e6 + caught);
        let lost = (10.0 + f64::from(body.state().velocity.y) + fell) / whole;
        assert!(worst < 0.1 * whole, "{degrees} degrees: {worst} m/s of {whole} on the way");
        assert!((lost - 1.0).abs() < 0.08, "{degrees} degrees: {lost} of the whole blow");
    }
}

#[test]
fn blows_take_energy_and_teleports_make_none() {
    let hull = wedge(0.3);
    let mut desc = BodyDesc::from_hull(&hull, 8_000.0);
    desc.slamming = Some(Slamming { deadrise: 0.3 });
    for dt in [0.002_f32, 1.0 / 60.0, 0.2] {
        let mut body = Body::new(desc.clone()).unwrap();
        let mut state = body.state();
        state.position.y += 4.0;
        state.orientation = Quat::from_rotation_z(0.2) * Quat::from_rotation_x(0.1);
        body.set_state(state);
        let mut highest = f32::MAX;
        for tick in 0..(20.0 / dt) as u32 {
            body.step(dt, &FlatWater::default(), &Controls::default());
            let s = body.state();
            assert!(s.position.y < state.position.y + 1e-3, "{dt}");
            if tick as f32 * dt > 10.0 {
                highest = highest.min(s.position.y);
            }
        }
        assert!(body.state().velocity.length() < 0.1, "{dt}: {}", body.state().velocity);
    }
    // Put into the water under way, nothing is newly wet.
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.velocity.y = -1.0;
    state.position.x = 1.0e3;
    body.set_state(state);
    body.step(1e-4, &FlatWater::default(), &Controls::default());
    assert!((body.state().velocity.y + 1.0).abs() < 0.01, "{}", body.state().velocity.y);
}

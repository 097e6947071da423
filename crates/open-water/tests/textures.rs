//! Bodies that radiate into a dispersive grid.

use floating_body::{Body, Drag};
use glam::{DVec2, Quat, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, Closure, Follow, GridDesc, Hull, OpenWater, OpenWaterDesc, Preset,
    Radiation, Scheme, TriMesh,
};

const DT: f32 = 1.0 / 60.0;

struct Tank {
    water: OpenWater,
    store: BodyStates,
    body: BodyId,
}

/// A box barge of 10 x 5 m with a draft of 0.75 m.
fn barge() -> BodyDesc {
    let hull = Hull::cuboid(Vec3::new(10.0, 1.5, 5.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 37.5e3);
    desc.water_density = 1000.0;
    desc.estimate();
    BodyDesc { radiation: Radiation::Grid, drag: Drag::default(), ..desc }
}

fn tank(desc: BodyDesc, scheme: Scheme, state: impl Fn(&Body) -> BodyState) -> Tank {
    let mut water: OpenWaterDesc = Preset::Low.water();
    water.sea.partitions.clear();
    let mut water = OpenWater::headless(water).unwrap();
    let body = water.add_body(desc).unwrap();
    let grid = GridDesc {
        follow: Follow::Body(body),
        cells: [144; 2],
        cell_size: [0.5; 2],
        scheme,
        border: Border::Absorbing { width: 16 },
        ..GridDesc::default()
    };
    water.add_grid(grid).unwrap();
    let mut store = BodyStates::default();
    store.insert(body, state(water.body(body).unwrap()));
    Tank { water, store, body }
}

impl Tank {
    fn tick(&mut self) -> BodyState {
        for tick in self.water.advance(DT) {
            self.water.tick(tick, &mut self.store).unwrap();
        }
        *self.store.get(self.body).unwrap()
    }
}

/// Damped period in s and damping ratio from the first three half swings.
fn swings(values: &[f32]) -> (f32, f32) {
    let (mut peaks, mut crossings, mut most) = (vec![values[0].abs()], Vec::new(), 0.0f32);
    for (i, pair) in values.windows(2).enumerate() {
        most = most.max(pair[1].abs());
        if pair[0] * pair[1] < 0.0 {
            if !crossings.is_empty() {
                peaks.push(most);
            }
            crossings.push((i as f32 + pair[0] / (pair[0] - pair[1])) * DT);
            most = 0.0;
        }
    }
    let decrement = (peaks[0] / peaks[3]).ln() / 3.0;
    (crossings[2] - crossings[0], decrement / (std::f32::consts::PI.powi(2) + decrement * decrement).sqrt())
}

#[test]
fn roll_and_pitch_decay_as_their_damping_says() {
    let desc = barge();
    let c = desc.coefficients;
    let body = Body::new(desc.clone()).unwrap();
    let (heights, inertia) = (body.metacentric_heights(), body.inertia());
    let weight = 37.5e3 * 9.81;
    let cases = [
        (Vec3::X, weight * heights.x, inertia.x_axis.x + c.added_inertia.x, c.angular_damping.x),
        (Vec3::Z, weight * heights.y, inertia.z_axis.z + c.added_inertia.z, c.angular_damping.z),
    ];
    for (axis, stiffness, whole, damping) in cases {
        let mut tank = tank(desc.clone(), Scheme::Dispersive, |body| BodyState {
            orientation: Quat::from_axis_angle(axis, 0.03),
            ..BodyState::at_rest(Vec3::Y * body.rest_height())
        });
        let mut angles = vec![0.03];
        for _ in 0..60 * 7 {
            let q = tank.tick().orientation;
            angles.push(2.0 * (q.x * axis.x + q.z * axis.z));
        }
        let (period, ratio) = swings(&angles);
        let omega = (stiffness / whole).sqrt();
        let (expected, target) = (std::f32::consts::TAU / omega, damping / (2.0 * whole * omega));
        assert!((period / expected - 1.0).abs() < 0.06, "{axis}: period {period} against {expected}");
        // Memory alone takes a fifth: the added mass changes with the frequency.
        assert!((ratio / target - 0.85).abs() < 0.25, "{axis}: ratio {ratio} against {target}");
    }
}

#[test]
fn a_dispersive_home_takes_imprints_and_a_wave_equation_displacements() {
    for (scheme, told) in [(Scheme::Dispersive, false), (Scheme::NinePoint, true)] {
        let mut tank = tank(barge(), scheme, |body| BodyState::at_rest(Vec3::Y * (body.rest_height() + 0.1)));
        for _ in 0..30 {
            tank.tick();
        }
        let body = tank.water.body(tank.body).unwrap();
        let mut displaced = Vec::new();
        body.displacements(&mut displaced);
        assert_eq!((body.imprints().is_none(), !displaced.is_empty()), (told, told), "{scheme:?}");
        assert!(tank.water.home(tank.body).unwrap().is_some());
    }
}

#[test]
fn coefficients_write_discs_into_a_dispersive_grid() {
    let desc = BodyDesc { radiation: Radiation::Coefficients, ..barge() };
    let mut tank = tank(desc, Scheme::Dispersive, |body| BodyState::at_rest(Vec3::Y * (body.rest_height() + 0.1)));
    for _ in 0..30 {
        tank.tick();
    }
    let mut displaced = Vec::new();
    tank.water.body(tank.body).unwrap().displacements(&mut displaced);
    assert!(!displaced.is_empty());
}

#[test]
fn a_body_adrift_in_its_own_waves_comes_to_rest() {
    let mut tank = tank(barge(), Scheme::Dispersive, |body| BodyState {
        orientation: Quat::from_rotation_y(0.6) * Quat::from_rotation_x(0.1) * Quat::from_rotation_z(0.05),
        ..BodyState::at_rest(Vec3::new(1.3, body.rest_height() + 0.3, -2.1))
    });
    let rest = tank.water.body(tank.body).unwrap().rest_height();
    let (mut late, mut most) = (0.0f32, 0.0f32);
    for tick in 0..60 * 25 {
        let state = tank.tick();
        let off = (state.position.y - rest).abs() + 2.5 * (state.orientation * Vec3::Y - Vec3::Y).length();
        most = most.max(off);
        if tick > 60 * 20 {
            late = late.max(off);
        }
    }
    // Roll dies away last: by a factor of 20 or so in 20 s.
    assert!(most < 0.62 && late < 0.06, "{most} then {late}");
}

/// A hull of 10 x 3 m with parabolic waterlines and sections and walls above the water, 7.5 t.
fn launch() -> BodyDesc {
    let (along, across) = (12u32, 6u32);
    let mut vertices = Vec::new();
    for i in 0..=along {
        let x = 2.0 * i as f32 / along as f32 - 1.0;
        let half = (1.0 - x * x).max(0.02);
        for j in 0..=across {
            let z = 2.0 * j as f32 / across as f32 - 1.0;
            vertices.push(Vec3::new(5.0 * x, -0.75 * (1.0 - z * z) * half.sqrt(), 1.5 * z * half));
        }
        vertices.extend([-1.5, 1.5].map(|z| Vec3::new(5.0 * x, 0.75, z * half)));
    }
    let indices = (0..vertices.len() as u32 - 2).flat_map(|i| [i, i + 1, i + 2]).collect();
    let hull = Hull::from_mesh(&TriMesh { vertices, indices }, Closure::ConvexHull).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 7.5e3);
    desc.center_of_mass.y = 0.0;
    desc.estimate();
    BodyDesc { radiation: Radiation::Grid, ..desc }
}

#[test]
fn a_hull_under_way_sinks_and_its_wake_does_not_lift_the_stern() {
    let mut tank = tank(launch(), Scheme::Dispersive, |body| BodyState::at_rest(Vec3::Y * body.rest_height()));
    let rest = tank.water.body(tank.body).unwrap().rest_height();
    let (mut sinkage, mut bow) = (0.0f32, 0.0f32);
    for tick in 0..60 * 16 {
        let state = tank.store.get_mut(tank.body).unwrap();
        state.velocity.x = 4.0 * (tick as f32 / 180.0).min(1.0);
        state.velocity.z = 0.0;
        let state = tank.tick();
        if tick >= 60 * 12 {
            sinkage += (rest - state.position.y) / 240.0;
            bow += (state.orientation * Vec3::X).y / 240.0;
        }
    }
    assert!(sinkage > 0.005 && sinkage < 0.3, "{sinkage} m");
    assert!(bow > 0.0 && bow < 0.1, "{bow}");
}

#[test]
fn waves_between_walls_have_the_energy_that_a_raft_gave_them() {
    // Of two layers of force points, that meet at the waterline.
    let hull = Hull::cuboid(Vec3::new(6.0, 1.5, 3.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 13_837.5);
    desc.center_of_mass.y = -0.3;
    desc.estimate();
    (desc.radiation, desc.drag) = (Radiation::Grid, Drag::default());
    let mut water: OpenWaterDesc = Preset::Low.water();
    water.sea.partitions.clear();
    let mut water = OpenWater::headless(water).unwrap();
    let body = water.add_body(desc).unwrap();
    let grid = GridDesc {
        follow: Follow::Fixed(DVec2::ZERO),
        cells: [96; 2],
        cell_size: [0.5; 2],
        scheme: Scheme::Dispersive,
        border: Border::Reflecting,
        ..GridDesc::default()
    };
    let grid = water.add_grid(grid).unwrap();
    let mut store = BodyStates::default();
    let lifted = 0.05f32;
    let rest = water.body(body).unwrap().rest_height();
    store.insert(body, BodyState::at_rest(Vec3::Y * (rest + lifted)));
    let mut tank = Tank { water, store, body };
    for _ in 0..30 * 60 {
        tank.tick();
    }
    // m^5/s^2: of the weight that is lifted over its waterplane.
    let given = f64::from(0.5 * 9.81 * 18.0 * lifted * lifted);
    let held = tank.water.grid(grid).unwrap().unwrap().energy();
    assert!(held > 0.9 * given && held < 1.1 * given, "{held} of {given}");
}

//! Pieces of a fleet against bodies of their own, and what a fleet promises beside.

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Closure, Controls, FlatWater, Fleet, FleetDesc, Hull, Inertia, Radiation,
    Sampling, TriMesh, WATER_DENSITY, WaterSurface,
};
use glam::{Mat3, Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;

fn crate_desc() -> BodyDesc {
    let hull = Hull::cuboid(Vec3::new(1.2, 0.8, 1.0)).unwrap();
    BodyDesc::from_hull(&hull, 0.45 * WATER_DENSITY * hull.volume())
}

/// A wedge with unlike ends: columns of many sizes, products of inertia.
fn wedge() -> BodyDesc {
    let section = [Vec3::new(0.0, 0.6, -0.5), Vec3::ZERO, Vec3::new(0.0, 0.6, 0.5)];
    let ends = [Vec3::X * -0.9, Vec3::new(0.9, 0.1, 0.0)];
    let vertices = ends.iter().flat_map(|end| section.map(|v| v + *end)).collect();
    let indices = vec![0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5, 0, 1, 2, 3, 5, 4];
    let hull = Hull::from_mesh(&TriMesh { vertices, indices }, Closure::Cap).unwrap();
    BodyDesc::from_hull(&hull, 0.4 * WATER_DENSITY * hull.volume())
}

fn shapes() -> Vec<(&'static str, BodyDesc)> {
    let ball = Hull::sphere(0.4).unwrap();
    let log = Hull::cylinder(0.3, 2.0).unwrap();
    let mut skew = crate_desc();
    skew.unit_inertia +=
        Mat3::from_cols(Vec3::new(0.0, 0.02, 0.01), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.01, 0.0, 0.0));
    let mut rigid = crate_desc();
    rigid.inertia = Inertia::PreRigid;
    vec![
        ("crate", crate_desc()),
        ("ball", BodyDesc::from_hull(&ball, 0.3 * WATER_DENSITY * ball.volume())),
        ("log", BodyDesc::from_hull(&log, 0.6 * WATER_DENSITY * log.volume())),
        ("wedge", wedge()),
        ("skew", skew),
        ("pre-rigid", rigid),
    ]
}

fn start(i: u32) -> BodyState {
    let turn = Quat::from_rotation_y(i as f32 * 0.7) * Quat::from_rotation_x(0.4) * Quat::from_rotation_z(-0.2);
    BodyState {
        position: Vec3::new(3.0 * i as f32, 0.3 + 0.2 * (i % 3) as f32, -2.0 * (i % 5) as f32),
        orientation: turn,
        velocity: Vec3::new(0.5, 0.0, -0.3),
        angular_velocity: Vec3::new(0.3, 0.8, -0.5),
    }
}

/// Largest difference in m of the centres of mass, and of points a metre away from them.
fn apart(a: &BodyState, b: &BodyState) -> f32 {
    let spread = [Vec3::X, Vec3::Y, Vec3::Z].map(|v| (a.orientation * v - b.orientation * v).length());
    spread.into_iter().fold(a.position.distance(b.position), f32::max)
}

/// Worst difference of 11 pieces and bodies over `seconds`, refreshing the planes in every tick.
fn worst(desc: &BodyDesc, seconds: f32, mut water: impl FnMut(f64) -> Box<dyn WaterSurface>) -> f32 {
    let mut fleet = Fleet::new(FleetDesc { refresh: 1, sleeps: false, ..FleetDesc::new(desc.clone()) }).unwrap();
    let patch = BodyDesc { sampling: Sampling::Patch, ..desc.clone() };
    let mut twins = Vec::new();
    for i in 0..11 {
        let mut body = Body::new(patch.clone()).unwrap();
        body.set_state(start(i));
        twins.push((fleet.add(start(i)).unwrap(), body));
    }
    let mut worst = 0.0_f32;
    for tick in 0..(seconds / DT) as u32 {
        let water = water(f64::from(tick) * f64::from(DT));
        fleet.step(DT, &*water);
        for (id, body) in &mut twins {
            body.step(DT, &*water, &Controls::default());
            worst = worst.max(apart(&fleet.state(*id).unwrap(), &body.state()));
        }
    }
    worst
}

#[test]
fn pieces_move_as_bodies_on_a_wave() {
    for (name, desc) in shapes() {
        let wave = AiryWave::new(0.4, 15.0, 0.6);
        let found = worst(&desc, 10.0, |time| Box::new(AiryWave { time, ..wave }));
        assert!(found < 2e-3, "{name}: {found} m");
    }
}

#[test]
fn pieces_fall_and_come_to_rest_as_bodies() {
    for (name, desc) in shapes() {
        let found = worst(&desc, 10.0, |_| Box::new(FlatWater { height: 0.1, current: Vec3::new(0.2, 0.0, 0.1) }));
        assert!(found < 2e-3, "{name}: {found} m");
    }
}

#[test]
fn handles_name_their_pieces_whatever_comes_and_goes() {
    let mut fleet = Fleet::new(FleetDesc::new(crate_desc())).unwrap();
    let place = |i: u32| BodyState::at_rest(Vec3::new(10.0 * i as f32, 0.0, 0.0));
    let ids: Vec<_> = (0..50).map(|i| fleet.add(place(i)).unwrap()).collect();
    for i in (0..50).step_by(3) {
        assert_eq!(fleet.remove(ids[i]), Some(place(i as u32)));
        assert_eq!(fleet.remove(ids[i]), None);
    }
    let new = fleet.add(place(77)).unwrap();
    assert_eq!(fleet.len(), 34);
    for (i, id) in ids.iter().enumerate() {
        assert_eq!(fleet.state(*id), (i % 3 != 0).then(|| place(i as u32)), "{i}");
    }
    fleet.rebase(Vec2::new(5.0, 0.0));
    assert_eq!(fleet.state(new).unwrap().position.x, 765.0);
    assert_eq!(fleet.iter().count(), 34);
}

#[test]
fn bad_descriptions_and_states_are_refused() {
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let boat = FleetDesc::new(BodyDesc::boat(&hull, 2000.0, 8.0));
    assert!(Fleet::new(boat).unwrap_err().to_string().contains("engine"));
    for refresh in [0, 17] {
        let desc = FleetDesc { refresh, ..FleetDesc::new(crate_desc()) };
        assert!(Fleet::new(desc).unwrap_err().to_string().contains("refresh"));
    }
    let mut fleet = Fleet::new(FleetDesc::new(crate_desc())).unwrap();
    assert!(fleet.add(BodyState::at_rest(Vec3::NAN)).is_err());
    let id = fleet.add(BodyState::at_rest(Vec3::ZERO)).unwrap();
    assert!(!fleet.set_state(id, BodyState::at_rest(Vec3::splat(2e6))));
    assert_eq!(fleet.state(id).unwrap().position, Vec3::ZERO);
}
/// Volume told so far by a fleet.
fn told(fleet: &Fleet, sum: &mut f64) {
    let mut out = Vec::new();
    fleet.displacements(&mut out);
    *sum += out.iter().map(|d| f64::from(d.volume)).sum::<f64>();
}

#[test]
fn what_is_told_adds_up_to_the_change_of_the_displaced_volume() {
    let desc = BodyDesc { radiation: Radiation::Grid, ..crate_desc() };
    let rest = desc.displaced_volume();
    let mut fleet = Fleet::new(FleetDesc { sleeps: false, ..FleetDesc::new(desc) }).unwrap();
    for i in 0..11 {
        let height = fleet.template().rest_height();
        fleet.add(BodyState::at_rest(Vec3::new(3.0 * i as f32, height + 5.0, 0.0))).unwrap();
    }
    let water = FlatWater { height: 0.0, current: Vec3::new(0.3, 0.0, 0.0) };
    let mut sum = 0.0;
    for _ in 0..3600 {
        fleet.step(DT, &water);
        told(&fleet, &mut sum);
    }
    // From the air to rest, drifting.
    let whole = 11.0 * f64::from(rest);
    assert!((sum / whole - 1.0).abs() < 1e-3, "{sum} of {whole}");
}

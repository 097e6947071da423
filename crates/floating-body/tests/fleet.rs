//! Pieces of a fleet against bodies of their own, and what a fleet promises beside.

use std::sync::atomic::{AtomicUsize, Ordering};

use floating_body::{
    Activity, AiryWave, Body, BodyDesc, BodyState, Closure, Controls, FlatWater, Fleet, FleetDesc, Hull, Inertia,
    PieceId, Quality, Radiation, Sampling, SurfacePatch, SurfaceSample, TriMesh, WATER_DENSITY, WaterSurface,
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
    let memory = FleetDesc::new(BodyDesc { memory: true, ..crate_desc() });
    assert!(Fleet::new(memory).unwrap_err().to_string().contains("memory"));
    let clipped = FleetDesc::new(BodyDesc { quality: Quality::Clipped, ..crate_desc() });
    assert!(Fleet::new(clipped).unwrap_err().to_string().contains("quality"));
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
        fleet.add(BodyState::at_rest(Vec3::new(3.0 * i as f32, height + 2.0, 0.0))).unwrap();
    }
    let water = FlatWater { height: 0.0, current: Vec3::new(0.3, 0.0, 0.0) };
    let mut sum = 0.0;
    for _ in 0..9000 {
        fleet.step(DT, &water);
        told(&fleet, &mut sum);
    }
    // From the air to rest, drifting.
    let whole = 11.0 * f64::from(rest);
    assert!((sum / whole - 1.0).abs() < 1e-3, "{sum} of {whole}");
}

/// Still but for a bump that may be switched on and spreads with 3 m/s from the origin.
#[derive(Default)]
struct Pond {
    reach: f32,
    asked: AtomicUsize,
}

impl WaterSurface for Pond {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        out[..points.len()].fill(SurfaceSample::CALM);
    }

    fn patch(&self, center: Vec2, _radius: f32) -> SurfacePatch {
        let height = if (center.length() - self.reach).abs() < 3.0 { 0.05 } else { 0.0 };
        SurfacePatch { height, velocity: Vec3::Y * height, ..SurfacePatch::default() }
    }

    fn is_calm(&self, low: Vec2, high: Vec2) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed);
        let nearest = Vec2::ZERO.clamp(low, high).length();
        let farthest = low.abs().max(high.abs()).length();
        nearest > self.reach + 3.0 || farthest < self.reach - 3.0
    }
}

fn field(side: u32, apart: f32) -> (Fleet, Vec<PieceId>) {
    let mut fleet = Fleet::new(FleetDesc::new(crate_desc())).unwrap();
    let y = fleet.template().rest_height() + 0.05;
    let spot = |i: u32| Vec3::new((i % side) as f32 * apart, y, (i / side) as f32 * apart);
    let ids = (0..side * side).map(|i| fleet.add(BodyState::at_rest(spot(i))).unwrap()).collect();
    (fleet, ids)
}

fn count(fleet: &Fleet, ids: &[PieceId], what: Activity) -> usize {
    ids.iter().filter(|id| fleet.activity(**id) == Some(what)).count()
}

#[test]
fn pieces_sleep_on_calm_water_and_wake_for_a_wave() {
    let (mut fleet, ids) = field(20, 4.0);
    let mut pond = Pond { reach: -1.0e3, ..Pond::default() };
    for _ in 0..60 * 60 {
        fleet.step(DT, &pond);
    }
    assert_eq!(count(&fleet, &ids, Activity::Asleep), 400);
    let still: Vec<_> = ids.iter().map(|id| fleet.state(*id).unwrap()).collect();
    pond.asked = AtomicUsize::new(0);
    for _ in 0..100 {
        fleet.step(DT, &pond);
    }
    assert!(pond.asked.load(Ordering::Relaxed) <= 100 * 16, "{:?} questions", pond.asked);
    for (id, state) in ids.iter().zip(&still) {
        assert_eq!(fleet.state(*id), Some(*state));
    }
    // The wave has reached some.
    pond.reach = 20.0;
    for _ in 0..16 {
        fleet.step(DT, &pond);
    }
    for (id, state) in ids.iter().zip(&still) {
        let distance = Vec2::new(state.position.x, state.position.z).length();
        if (distance - 20.0).abs() < 2.0 {
            assert_eq!(fleet.activity(*id), Some(Activity::Awake), "{distance}");
            assert!(fleet.state(*id).unwrap().position.y > state.position.y);
        }
        if distance > 60.0 {
            assert_eq!(fleet.activity(*id), Some(Activity::Asleep), "{distance}");
        }
    }
    // One that is hit wakes alone; one that is removed is gone.
    let (hit, gone) = (ids[399], ids[398]);
    let before = count(&fleet, &ids, Activity::Asleep);
    assert!(fleet.set_state(hit, BodyState { velocity: Vec3::X, ..still[399] }));
    assert_eq!(fleet.activity(hit), Some(Activity::Awake));
    assert_eq!(fleet.remove(gone), Some(still[398]));
    assert_eq!(count(&fleet, &ids, Activity::Asleep), before - 2);
    for (id, state) in ids.iter().zip(&still).filter(|(id, _)| fleet.activity(**id) == Some(Activity::Asleep)) {
        assert_eq!(fleet.state(*id), Some(*state));
    }
}

#[test]
fn far_pieces_ride_the_waves_and_switch_without_a_jump() {
    let (mut fleet, ids) = field(10, 4.0);
    let mut wave = AiryWave::new(0.5, 40.0, 0.3);
    let near = Some(Vec3::new(0.0, 5.0, 0.0));
    let far = Some(Vec3::new(0.0, 5.0, 3000.0));
    let mut worst = 0.0_f32;
    let mut old: Vec<_> = ids.iter().map(|id| fleet.state(*id).unwrap()).collect();
    for tick in 0..60 * 60 {
        wave.time = f64::from(tick) * f64::from(DT);
        fleet.look(if tick / 600 % 2 == 1 { far } else { near });
        fleet.step(DT, &wave);
        if tick % 600 == 599 {
            let riding = count(&fleet, &ids, Activity::Riding);
            assert_eq!(riding, if tick / 600 % 2 == 1 { 100 } else { 0 }, "at {tick}");
        }
        for (id, old) in ids.iter().zip(&mut old) {
            let now = fleet.state(*id).unwrap();
            // How far from where the mean of the velocities before and after would have brought it.
            let on = old.position + (old.velocity + now.velocity) * (0.5 * DT);
            if tick > 300 {
                worst = worst.max(on.distance(now.position));
                let surface = wave.at(Vec2::new(now.position.x, now.position.z)).height;
                let above = now.position.y - fleet.template().rest_height() - surface;
                assert!(above.abs() < 0.12, "{above} m off the water at {tick}");
            }
            *old = now;
        }
    }
    assert!(worst < 0.02, "a jump of {worst} m");
}

#[test]
fn rebasing_disturbs_nothing_whatever_pieces_do() {
    let run = |offset: Vec2| {
        let (mut fleet, ids) = field(10, 4.0);
        let mut pond = Pond { reach: -1.0e3, ..Pond::default() };
        fleet.look(Some(Vec3::new(0.0, 3.0, 900.0)));
        for tick in 0..1200 {
            if tick == 1100 {
                fleet.rebase(offset);
                pond.reach = -1.0e6;
            }
            fleet.step(DT, &pond);
        }
        assert!(count(&fleet, &ids, Activity::Riding) > 10 && count(&fleet, &ids, Activity::Riding) < 90);
        let activities: Vec<_> = ids.iter().map(|id| fleet.activity(*id).unwrap()).collect();
        let places: Vec<_> = ids.iter().map(|id| fleet.state(*id).unwrap().position).collect();
        (activities, places)
    };
    let (still, moved) = (run(Vec2::ZERO), run(Vec2::new(64.0, -32.0)));
    assert_eq!(still.0, moved.0);
    for (a, b) in still.1.iter().zip(&moved.1) {
        assert!((*a - *b - Vec3::new(64.0, 0.0, -32.0)).length() < 1e-4, "{a} {b}");
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut fleet, ids) = field(30, 3.0);
            let mut wave = AiryWave::new(0.5, 20.0, 0.3);
            fleet.look(Some(Vec3::new(0.0, 3.0, -400.0)));
            for tick in 0..120 {
                wave.time = f64::from(tick) * f64::from(DT);
                fleet.step(DT, &wave);
            }
            ids.iter().map(|id| fleet.state(*id).unwrap()).collect::<Vec<_>>()
        })
    };
    assert!(run(1) == run(3));
}

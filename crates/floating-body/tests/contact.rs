//! Contact with bed and quay, against closed forms of rigid bodies on a plane; it gives no energy.

use std::f32::consts::TAU;

use floating_body::{
    Activity, Body, BodyDesc, BodyState, Contact, Controls, Drag, FlatWater, Fleet, FleetDesc, Hull, HullKind,
    SoftContact, SurfacePatch, SurfaceSample, Touch, WATER_DENSITY, WaterSurface,
};
use glam::{Quat, Vec2, Vec3, Vec3Swizzles};
use proptest::prelude::*;

const G: f32 = 9.81;
const DT: f32 = 1.0 / 60.0;
const NONE: Controls = Controls { throttle: 0.0, steering: 0.0, force: Vec3::ZERO, torque: Vec3::ZERO };

/// A half space through the origin and flat water at a height.
struct Ground {
    normal: Vec3,
    water: f32,
    /// Answers for points outside too, as a bed does.
    foresees: bool,
}

impl Ground {
    fn dry(slope: f32) -> Self {
        Self { normal: Vec3::new(libm::sinf(slope), libm::cosf(slope), 0.0), water: -1000.0, foresees: true }
    }
}

impl WaterSurface for Ground {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        FlatWater { height: self.water, current: Vec3::ZERO }.sample(points, out);
    }
    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        FlatWater { height: self.water, current: Vec3::ZERO }.patch(center, radius)
    }
    fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        let mut any = false;
        for (point, out) in points.iter().zip(out) {
            let depth = -self.normal.dot(*point);
            *out = if self.foresees || depth > 0.0 { Touch { depth, normal: self.normal } } else { Touch::NONE };
            any |= depth > -20.0;
        }
        any
    }
}

fn body(hull: &Hull, contact: Contact) -> Body {
    let mut desc = BodyDesc::from_hull(hull, 300.0);
    (desc.drag, desc.contact) = (Drag::default(), Some(contact));
    Body::new(desc).unwrap()
}

fn place(body: &mut Body, position: Vec3, orientation: Quat) {
    body.set_state(BodyState { orientation, ..BodyState::at_rest(position) });
}

/// Kinetic energy and weight times height, J; what is buried counts as if out of the ground. Steps of `dt` move with the
/// speed at their end: what is conserved by a fall has the height half a step before.
fn energy(body: &Body, ground: &Ground, dt: f32) -> f64 {
    let s = body.state();
    let spin = s.orientation.inverse() * s.angular_velocity;
    let mass = body.desc().mass;
    let moving = 0.5 * (mass * s.velocity.length_squared() + spin.dot(body.inertia() * spin));
    let normal = s.orientation.inverse() * ground.normal;
    let lowest = match body.desc().hull.kind() {
        HullKind::Cuboid { half } => (half * normal).abs().element_sum(),
        HullKind::Cylinder { radius, length } => radius * normal.yz().length() + 0.5 * length * normal.x.abs(),
        _ => 0.5,
    };
    let buried = (lowest - ground.normal.dot(s.position)).max(0.0);
    f64::from(moving)
        + f64::from(mass * G) * f64::from(s.position.y - 0.5 * dt * s.velocity.y + buried * ground.normal.y)
}

#[test]
fn a_box_stays_on_a_slope_that_friction_holds_and_slides_down_a_steeper_one() {
    let hull = Hull::cuboid(Vec3::new(1.0, 0.5, 0.8)).unwrap();
    let slope = 0.3_f32;
    for (friction, dt) in [(0.5, 1.0 / 60.0), (0.5, 0.1), (0.15, 1.0 / 60.0)] {
        let mut body = body(&hull, Contact { friction, ..Contact::default() });
        let ground = Ground::dry(slope);
        place(&mut body, ground.normal * 0.24, Quat::from_rotation_z(-slope));
        for _ in 0..(2.0 / dt) as u32 {
            body.step(dt, &ground, &NONE);
        }
        let (from, before) = (body.state().position, body.state().velocity);
        for _ in 0..(4.0 / dt) as u32 {
            body.step(dt, &ground, &NONE);
        }
        let (way, faster) = (body.state().position.distance(from), (body.state().velocity - before).length());
        if friction > libm::tanf(slope) {
            assert!(way < 1e-3, "{friction}, {dt} s: {way} m");
        } else {
            let expected = G * (libm::sinf(slope) - friction * libm::cosf(slope)) * 4.0;
            assert!((faster / expected - 1.0).abs() < 0.01, "{faster} against {expected}");
        }
    }
}

#[test]
fn a_ball_rolls_down_with_five_sevenths_of_what_slides() {
    let hull = Hull::sphere(0.5).unwrap();
    for foresees in [true, false] {
        let mut body = body(&hull, Contact::default());
        let ground = Ground { foresees, ..Ground::dry(0.2) };
        place(&mut body, ground.normal * 0.49, Quat::IDENTITY);
        for _ in 0..120 {
            body.step(1.0 / 60.0, &ground, &NONE);
        }
        let before = body.state().velocity;
        for _ in 0..180 {
            body.step(1.0 / 60.0, &ground, &NONE);
        }
        let faster = (body.state().velocity - before).length();
        let expected = 5.0 / 7.0 * G * libm::sinf(0.2) * 3.0;
        assert!((faster / expected - 1.0).abs() < 0.01, "{faster} against {expected}");
    }
}

#[test]
fn a_log_rolls_too_and_stands_on_its_end() {
    let hull = Hull::cylinder(0.3, 1.2).unwrap();
    let mut log = body(&hull, Contact::default());
    let ground = Ground::dry(0.2);
    // Its axis across the slope.
    place(&mut log, ground.normal * 0.29, Quat::from_rotation_y(TAU / 4.0));
    for _ in 0..300 {
        log.step(1.0 / 60.0, &ground, &NONE);
    }
    // Two thirds of what slides; from rest, so the first touch costs a little.
    let (speed, expected) = (log.state().velocity.length(), 2.0 / 3.0 * G * libm::sinf(0.2) * 5.0);
    assert!((speed / expected - 1.0).abs() < 0.02, "{speed} against {expected}");
    let flat = Ground::dry(0.0);
    place(&mut log, Vec3::Y * 0.62, Quat::from_rotation_z(TAU / 4.0));
    for _ in 0..600 {
        log.step(1.0 / 60.0, &flat, &NONE);
    }
    let s = log.state();
    assert!((s.position.y - 0.6).abs() < 0.02 && s.angular_velocity.length() < 1e-3, "{s:?}");
}

#[test]
fn a_bounce_keeps_the_share_of_speed_asked_for() {
    let hull = Hull::sphere(0.5).unwrap();
    for restitution in [0.0, 0.3, 0.8] {
        let mut body = body(&hull, Contact { restitution, ..Contact::default() });
        place(&mut body, Vec3::Y * 2.5, Quat::IDENTITY);
        let (mut down, mut top) = (0.0_f32, 0.5_f32);
        for _ in 0..4000 {
            body.step(0.0005, &Ground { foresees: false, ..Ground::dry(0.0) }, &NONE);
            down = down.min(body.state().velocity.y);
            if down < -6.0 && body.state().velocity.y > 0.0 {
                top = top.max(body.state().position.y);
            }
        }
        let expected = restitution * restitution * 2.0;
        assert!((top - 0.5 - expected).abs() < 0.03, "{restitution}: {} m against {expected}", top - 0.5);
    }
}

#[test]
fn a_ball_does_not_bounce_higher_at_long_ticks_and_comes_to_rest() {
    let hull = Hull::sphere(0.5).unwrap();
    for (restitution, foresees, dt) in
        [(1.0, false, 1.0 / 30.0), (1.0, true, 1.0 / 60.0), (0.9, false, 1.0 / 30.0), (0.9, true, 1.0 / 60.0)]
    {
        let mut body = body(&hull, Contact { restitution, ..Contact::default() });
        place(&mut body, Vec3::Y * 2.5, Quat::IDENTITY);
        let (mut top, ticks) = (0.0_f32, (60.0 / dt) as u32);
        for tick in 0..ticks {
            body.step(dt, &Ground { foresees, ..Ground::dry(0.0) }, &NONE);
            // Of the last seconds.
            top = if tick > ticks * 9 / 10 { top.max(body.state().position.y) } else { 0.0 };
        }
        let fits = if restitution == 1.0 { (2.3..2.7).contains(&top) } else { (top - 0.5).abs() < 0.02 };
        assert!(fits, "{restitution}, {foresees}, {dt} s: {top} m");
    }
}

#[test]
fn at_rest_it_has_sunk_in_as_far_as_its_weight_presses() {
    let hull = Hull::sphere(0.5).unwrap();
    for (sink, dt) in [(0.001, 1.0 / 60.0), (0.05, 1.0 / 60.0), (0.05, 0.25), (1.0, 1.0 / 60.0)] {
        let mut body = body(&hull, Contact { sink, ..Contact::default() });
        place(&mut body, Vec3::Y * 0.6, Quat::IDENTITY);
        for _ in 0..(20.0 / dt) as u32 {
            body.step(dt, &Ground::dry(0.0), &NONE);
        }
        let sunk = 0.5 - body.state().position.y;
        assert!((sunk / sink - 1.0).abs() < 0.02, "{sunk} m, {sink} m asked");
    }
}

#[test]
fn a_boat_is_stopped_by_a_quay_at_any_tick() {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    for dt in [0.01, 1.0 / 60.0, 0.1, 0.5, 1.0] {
        let mut boat = Body::new(BodyDesc::from_hull(&hull, 4000.0)).unwrap();
        let rest = boat.rest_height();
        let mut state = BodyState::at_rest(Vec3::new(-5.0, rest, 0.0));
        state.velocity.x = 4.0;
        boat.set_state(state);
        let quay = Ground { normal: Vec3::NEG_X, water: 0.0, foresees: true };
        let mut farthest = f32::MIN;
        for _ in 0..(20.0 / dt) as u32 {
            boat.step(dt, &quay, &NONE);
            farthest = farthest.max(boat.state().position.x + 3.0);
        }
        assert!(farthest < 0.05 && boat.state().position.x > -20.0, "{dt} s: {farthest} m");
    }
}

#[test]
fn without_contact_it_falls_through_and_a_bad_one_is_refused() {
    let hull = Hull::sphere(0.5).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 300.0);
    desc.contact = None;
    let mut body = Body::new(desc.clone()).unwrap();
    place(&mut body, Vec3::Y, Quat::IDENTITY);
    for _ in 0..60 {
        body.step(1.0 / 60.0, &Ground::dry(0.0), &NONE);
    }
    assert!(body.state().position.y < -2.0);
    for (contact, text) in [
        (Contact { sink: 0.0, ..Contact::default() }, "contact.sink is 0; it must be in [0.0001, 10] m"),
        (Contact { friction: -1.0, ..Contact::default() }, "contact.friction is -1; it must be in [0, 10]"),
        (Contact { restitution: f32::NAN, ..Contact::default() }, "contact.restitution is NaN; it must be in [0, 1]"),
    ] {
        desc.contact = Some(contact);
        assert_eq!(Body::new(desc.clone()).unwrap_err().to_string(), text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Thrown at the ground, dry or under water, buried or above.
    #[test]
    fn contact_gives_no_energy(
        kind in 0..3_u8,
        dt in prop::sample::select(vec![0.001_f32, 1.0 / 120.0, 1.0 / 60.0, 1.0 / 30.0]),
        (sink, friction, restitution) in (0.0001..0.5_f32, 0.0..2.0_f32, 0.0..=1.0_f32),
        slope in -0.8..0.8_f32,
        (foresees, wet) in (any::<bool>(), any::<bool>()),
        height in 0.0..3.0_f32,
        velocity in (-20.0..20.0_f32, -50.0..20.0_f32, -20.0..20.0_f32),
        spin in (-10.0..10.0_f32, -10.0..10.0_f32, -10.0..10.0_f32),
    ) {
        let hull = match kind {
            0 => Hull::cuboid(Vec3::new(1.0, 0.4, 0.7)).unwrap(),
            1 => Hull::sphere(0.5).unwrap(),
            _ => Hull::cylinder(0.2, 1.0).unwrap(),
        };
        let mut desc = BodyDesc::from_hull(&hull, 2.0 * WATER_DENSITY * hull.volume());
        desc.contact = Some(Contact { sink, friction, restitution });
        let mut body = Body::new(desc).unwrap();
        let ground = Ground { foresees, water: if wet { 1.0 } else { -1000.0 }, ..Ground::dry(slope) };
        let mut state = BodyState::at_rest(ground.normal * height);
        (state.velocity, state.angular_velocity) = (Vec3::from(velocity), Vec3::from(spin));
        body.set_state(state);
        let mass = body.desc().mass;
        let mut least = energy(&body, &ground, dt);
        for _ in 0..300 {
            let before = body.state();
            body.step(dt, &ground, &NONE);
            let now = energy(&body, &ground, dt);
            // Buried, it comes out at some speed, and a step digs as deep as it is long. Water bears half of the weight; an
            // impact may turn the energy of the water that is moved along, which is more one way than another.
            let speed = |s: &BodyState| s.velocity.length() + s.angular_velocity.length() * body.bounding_radius();
            let way = speed(&before).max(speed(&body.state())) * dt;
            let freed = G * (0.5 * body.bounding_radius() + sink + way);
            let buoyed = if wet { 0.5 * G * (way + 2.0) + speed(&before).powi(2) } else { 0.0 };
            let margin = f64::from(mass * (freed + buoyed)) + 1e-3 * least.abs();
            prop_assert!(now < least + margin, "{now} J after {least} J + {margin} J, {before:?} {:?}", body.state());
            // An impact in the water took from what moved along.
            least = if wet { now } else { least.min(now) };
        }
        prop_assert_eq!(body.resets(), 0);
    }
}

/// A fleet of balls on still water that push each other apart.
fn balls(at: &[Vec3], velocity: impl Fn(usize) -> Vec3) -> Fleet {
    let hull = Hull::sphere(0.5).unwrap();
    let mut body = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
    (body.drag, body.coefficients) = (Drag::default(), Default::default());
    let contact = Some(SoftContact::of(&hull));
    let mut fleet = Fleet::new(FleetDesc { contact, sleeps: false, ..FleetDesc::new(body) }).unwrap();
    for (i, position) in at.iter().enumerate() {
        fleet.add(BodyState { velocity: velocity(i), ..BodyState::at_rest(*position) }).unwrap();
    }
    fleet
}

fn momentum_and_energy(fleet: &Fleet) -> (Vec3, f32) {
    fleet.iter().fold((Vec3::ZERO, 0.0), |(p, e), (_, s)| (p + s.velocity, e + s.velocity.length_squared()))
}

#[test]
fn flotsam_keeps_apart_with_its_momentum_and_no_more_energy_whatever_the_order() {
    let mut random = 1_u32;
    let mut number = |low: f32, high: f32| {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        low + (high - low) * (random >> 8) as f32 / (1 << 24) as f32
    };
    let at: Vec<Vec3> = (0..400).map(|_| Vec3::new(number(-9.0, 9.0), 0.0, number(-9.0, 9.0))).collect();
    let speeds: Vec<Vec3> = at.iter().map(|p| Vec3::new(-0.1 * p.x + number(-0.3, 0.3), 0.0, -0.1 * p.z)).collect();
    let mut fleet = balls(&at, |i| speeds[i]);
    let mut most = momentum_and_energy(&fleet).1;
    let start = momentum_and_energy(&fleet).0;
    let closest = |fleet: &Fleet| {
        let all: Vec<Vec3> = fleet.iter().map(|(_, s)| s.position).collect();
        let pairs = all.iter().enumerate().flat_map(|(i, a)| all[..i].iter().map(move |b| a.distance(*b)));
        pairs.filter(|d| *d < 0.6).count()
    };
    let crowded = closest(&fleet);
    for tick in 0..600 {
        fleet.step(DT, &FlatWater::default());
        let (momentum, energy) = momentum_and_energy(&fleet);
        assert!((momentum - start).length() < 1e-2, "{momentum} after {start}");
        // In the first second what was put into each other comes apart.
        assert!(tick < 60 || energy <= most, "{tick}: {energy} after {most}");
        most = if tick < 60 { most.max(energy) } else { most };
    }
    assert!(crowded > 200 && closest(&fleet) == 0, "{crowded} pairs, then {}", closest(&fleet));

    // The same pieces in another order: the same motion, bit by bit where each has at most one contact.
    let two = [Vec3::ZERO, Vec3::new(0.9, 0.0, 0.1), Vec3::new(5.0, 0.0, 0.0)];
    let (mut here, mut there) = (balls(&two, |_| Vec3::ZERO), balls(&[two[2], two[1], two[0]], |_| Vec3::ZERO));
    for _ in 0..60 {
        here.step(DT, &FlatWater::default());
        there.step(DT, &FlatWater::default());
    }
    let of = |fleet: &Fleet| fleet.iter().map(|(_, s)| s.position).collect::<Vec<_>>();
    let (here, there) = (of(&here), of(&there));
    assert!(here[0] == there[2] && here[1] == there[1] && here[1].x > 0.95, "{here:?} {there:?}");
}

#[test]
fn ten_thousand_pieces_in_one_place_hold_up_nothing() {
    let at: Vec<Vec3> = (0..10_000).map(|i| Vec3::splat(1e-4 * (i % 7) as f32)).collect();
    let mut fleet = balls(&at, |_| Vec3::ZERO);
    for _ in 0..20 {
        fleet.step(DT, &FlatWater::default());
    }
    assert!(fleet.resets() == 0 && fleet.iter().all(|(_, s)| s.position.is_finite()));
}

#[test]
fn flotsam_meets_bed_and_quay_and_wakes_what_sleeps() {
    let mut fleet = balls(&[Vec3::new(-2.0, 0.0, 0.0)], |_| Vec3::X * 2.0);
    let quay = Ground { normal: Vec3::NEG_X, water: 0.0, foresees: true };
    for _ in 0..300 {
        fleet.step(DT, &quay);
    }
    let (_, state) = fleet.iter().next().unwrap();
    assert!(state.position.x < -0.45 && state.velocity.x <= 1e-3, "{state:?}");

    let hull = Hull::sphere(0.5).unwrap();
    let body = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
    let desc = FleetDesc { contact: Some(SoftContact::of(&hull)), ..FleetDesc::new(body) };
    let mut fleet = Fleet::new(desc).unwrap();
    let sleeper = fleet.add(BodyState::at_rest(Vec3::ZERO)).unwrap();
    for _ in 0..60 * 20 {
        fleet.step(DT, &FlatWater::default());
    }
    assert_eq!(fleet.activity(sleeper), Some(Activity::Asleep));
    let velocity = Vec3::X * 3.0;
    fleet.add(BodyState { velocity, ..BodyState::at_rest(Vec3::X * -2.0) }).unwrap();
    for _ in 0..60 {
        fleet.step(DT, &FlatWater::default());
    }
    assert_eq!(fleet.activity(sleeper), Some(Activity::Awake));
    assert!(fleet.state(sleeper).unwrap().velocity.x > 0.05, "{:?}", fleet.state(sleeper));
}

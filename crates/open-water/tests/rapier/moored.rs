//! Lines and fenders.

use crate::world::*;

/// A launch-sized box, 0.4 m deep.
fn boat() -> BodyDesc {
    BodyDesc::from_hull(&Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap(), 6.0 * 2.2 * 0.4 * 1025.0)
}

/// Stiffness in N/m, damping in N s/m, travel in m.
const FENDER: (f32, f32, f32) = (3.0e4, 6.0e3, 0.45);

/// A block on a rail across the quay's face, pushed out by a spring, that gives by force over stiffness.
fn fender(physics: &mut PhysicsWorld, face: Vec3) -> RigidBodyHandle {
    let anchor = physics.insert_body(RigidBodyBuilder::fixed());
    let block = ColliderBuilder::cuboid(0.4, 0.6, 0.2).mass(100.0).friction(0.2);
    let (body, _) = physics.insert(RigidBodyBuilder::dynamic().translation(face), block);
    let rail = PrismaticJointBuilder::new(Vec3::Z)
        .local_anchor1(face)
        .local_anchor2(Vec3::ZERO)
        .limits([-FENDER.2, 0.0])
        .motor_model(MotorModel::ForceBased)
        .motor_position(0.0, FENDER.0, FENDER.1)
        .contacts_enabled(false);
    physics.insert_impulse_joint(anchor, body, rail.build());
    body
}

/// A boat at a quay that fills z < 0, two fenders before it, bow and stern lines on to the quay.
struct Berth {
    world: World,
    boat: (BodyId, RigidBodyHandle),
    fenders: [RigidBodyHandle; 2],
    lines: [(MooringId, MooringLine); 2],
}

fn berth(desc: OpenWaterDesc) -> Berth {
    let mut world = World::new(desc);
    let quay = ColliderBuilder::cuboid(20.0, 6.0, 2.0).translation(Vec3::new(0.0, -4.0, -2.0));
    world.physics.insert_collider(quay, None);
    let fenders = [-2.0, 2.0].map(|x| fender(&mut world.physics, Vec3::new(x, 0.3, 0.7)));
    let boat = world.spawn(boat(), Vec3::new(0.0, 0.2, 2.1));
    let lines = [-1.0, 1.0].map(|side| {
        let (point, anchor) = (Vec3::new(2.8 * side, 0.6, -1.0), Vec3::new(6.0 * side, 2.0, -0.3));
        let line = MooringLine::rope(point, anchor, 4.4, 5400.0);
        (world.water.add_mooring(Mooring { body: boat.0, line }).unwrap(), line)
    });
    Berth { world, boat, fenders, lines }
}

#[test]
fn fenders_give_by_force_over_stiffness() {
    let mut desc = Preset::Low.water();
    desc.sea.partitions.clear();
    let Berth { mut world, boat: (id, _), fenders, .. } = berth(desc);
    let wind = Controls { force: Vec3::Z * -6000.0, ..Controls::default() };
    world.water.set_controls(id, wind).unwrap();
    world.run(40.0);
    // Rapier's contacts feel the mass only: of a force, what is not the added mass's share.
    let desc = boat();
    let felt = desc.mass / (desc.mass + desc.coefficients.added_mass.z);
    for fender in fenders {
        let given = 0.7 - world.rigid(fender).translation().z;
        assert!((given / (felt * 3000.0 / FENDER.0) - 1.0).abs() < 0.03, "{given} m");
    }
}

#[test]
fn a_boat_moored_between_lines_and_fenders_stays_at_its_berth() {
    let Berth { mut world, boat: (id, handle), fenders, lines } = berth(sea(0.5, 4.0));
    let (mut taut, mut pushed) = (0, 0.0_f32);
    for tick in 0..60 * 50 {
        // Wind off the quay, then on to it.
        let force = Vec3::Z * if tick < 60 * 25 { 1500.0 } else { -1500.0 };
        world.water.set_controls(id, Controls { force, ..Controls::default() }).unwrap();
        world.step();
        let pose = *world.rigid(handle).position();
        for (id, line) in lines {
            let tension = world.water.mooring_tension(id).unwrap();
            let span = (pose * line.point).distance(line.anchor);
            assert!(span < line.length + 1.0 && tension >= 0.0, "tick {tick}: {span} m, {tension} N");
            taut += u32::from(tension > 0.0);
        }
        let place = pose.translation;
        assert!(place.x.abs() < 2.0 && (1.1..5.0).contains(&place.z), "tick {tick}: {place}");
        assert!((pose.rotation * Vec3::Y).y > 0.8, "tick {tick}: {:?}", pose.rotation);
        for fender in fenders {
            pushed = pushed.max(0.7 - world.rigid(fender).translation().z);
        }
    }
    assert!(taut > 300 && (0.02..FENDER.2 + 0.05).contains(&pushed), "{taut} ticks, {pushed} m");
}

#[test]
fn a_line_like_a_rod_holds_in_rapier_without_a_tremor() {
    for stiffness in [1.0e5, 1.0e7, 1.0e9] {
        let mut desc = Preset::Low.water();
        desc.sea.partitions.clear();
        let mut world = World::new(desc);
        let (id, handle) = world.spawn(boat(), Vec3::Y * 0.2);
        let (point, anchor) = (Vec3::X * 3.0, Vec3::new(8.0, 0.2, 0.0));
        let line = MooringLine { point, anchor, length: 6.0, stiffness, damping: 3000.0, holds: f32::INFINITY };
        let mooring = world.water.add_mooring(Mooring { body: id, line }).unwrap();
        let pull = Controls { force: Vec3::X * -3000.0, ..Controls::default() };
        world.water.set_controls(id, pull).unwrap();
        world.run(60.0);
        let mut fastest = 0.0_f32;
        for _ in 0..600 {
            world.step();
            fastest = fastest.max(world.rigid(handle).linvel().length());
        }
        let tension = world.water.mooring_tension(mooring).unwrap();
        assert!((tension / 3000.0 - 1.0).abs() < 0.02 && fastest < 0.01, "{stiffness}: {tension} N, {fastest} m/s");
        let span = (*world.rigid(handle).position() * point).distance(anchor);
        assert!(span < 6.0 + 3000.0 / 1.0e5 + 0.01, "{stiffness}: {span}");
    }
}

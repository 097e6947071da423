//! Moorings by handle, on a water that moves its bodies itself.

use glam::Vec3;
use open_water::{
    BodyDesc, BodyId, BodyStates, CascadeDesc, Controls, Hull, Mooring, MooringLine, OpenWater, OpenWaterDesc,
    OpenWaterError, Preset, SeaState,
};

const DT: f32 = 1.0 / 60.0;

fn water(height: f32) -> OpenWater {
    let mut desc = OpenWaterDesc {
        sea: SeaState::height_period(height.max(0.1), 4.0, 0.0),
        cascades: vec![CascadeDesc::new(64, 80.0)],
        ..Preset::Low.water()
    };
    if height == 0.0 {
        desc.sea.partitions.clear();
    }
    OpenWater::headless(desc).unwrap()
}

fn boat(water: &mut OpenWater, states: &mut BodyStates) -> BodyId {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let id = water.add_body(BodyDesc::boat(&hull, 4000.0, 10.0)).unwrap();
    states.insert(id, water.body(id).unwrap().state());
    id
}

fn run(water: &mut OpenWater, states: &mut BodyStates, ticks: u32) {
    for _ in 0..ticks {
        for tick in water.advance(DT) {
            water.tick(tick, states).unwrap();
        }
    }
}

fn line(x: f32, length: f32) -> MooringLine {
    MooringLine::rope(Vec3::X * x.signum() * 2.8, Vec3::new(x, 1.5, 0.0), length, 4000.0)
}

#[test]
fn a_boat_moored_fore_and_aft_stays_in_a_sea() {
    let (mut water, mut states) = (water(0.6), BodyStates::default());
    let id = boat(&mut water, &mut states);
    let lines = [line(9.0, 7.0), line(-9.0, 7.0)];
    let ids = lines.map(|line| water.add_mooring(Mooring { body: id, line }).unwrap());
    let wind = Controls { force: Vec3::new(-900.0, 0.0, 500.0), ..Controls::default() };
    water.set_controls(id, wind).unwrap();
    let mut most = 0.0_f32;
    for _ in 0..60 * 40 {
        run(&mut water, &mut states, 1);
        let (origin, rotation) = water.body(id).unwrap().hull_pose();
        for (id, line) in ids.iter().zip(&lines) {
            let (span, tension) = ((origin + rotation * line.point).distance(line.anchor), water.mooring_tension(*id));
            let tension = tension.unwrap();
            assert!(span < line.length + 1.5 && tension >= 0.0, "{span} m, {tension} N");
            assert!(tension == 0.0 || span > line.length - 0.1, "{span} m, {tension} N");
            most = most.max(tension);
        }
    }
    assert!(most > 500.0, "{most} N");
    // Cast off, the wind takes it.
    ids.into_iter().for_each(|id| water.remove_mooring(id).unwrap());
    run(&mut water, &mut states, 60 * 40);
    assert!(states.get(id).unwrap().position.x < -10.0, "{:?}", states.get(id));
}

#[test]
fn tensions_belong_to_their_lines() {
    let (mut water, mut states) = (water(0.0), BodyStates::default());
    let id = boat(&mut water, &mut states);
    let other = boat(&mut water, &mut states);
    let slack = water.add_mooring(Mooring { body: id, line: line(-9.0, 30.0) }).unwrap();
    let elsewhere = water.add_mooring(Mooring { body: other, line: line(9.0, 30.0) }).unwrap();
    let taut = water.add_mooring(Mooring { body: id, line: line(9.0, 4.0) }).unwrap();
    run(&mut water, &mut states, 10);
    assert_eq!(water.mooring_tension(slack).unwrap(), 0.0);
    assert_eq!(water.mooring_tension(elsewhere).unwrap(), 0.0);
    assert!(water.mooring_tension(taut).unwrap() > 1000.0);
    water.remove_mooring(slack).unwrap();
    run(&mut water, &mut states, 1);
    assert!(water.mooring_tension(taut).unwrap() > 1000.0);
}

#[test]
fn moorings_go_with_their_bodies_and_bad_ones_leave_nothing() {
    let (mut water, mut states) = (water(0.0), BodyStates::default());
    let id = boat(&mut water, &mut states);
    let kept = water.add_mooring(Mooring { body: id, line: line(9.0, 7.0) }).unwrap();
    let bad = Mooring { body: id, line: MooringLine { length: f32::NAN, ..line(9.0, 7.0) } };
    let error = water.add_mooring(bad).unwrap_err().to_string();
    assert!(error.contains("mooring.length is NaN"), "{error}");
    assert_eq!(water.body(id).unwrap().moorings().len(), 1);
    let good = water.add_mooring(Mooring { body: id, line: line(-9.0, 7.0) }).unwrap();
    assert_eq!(water.body(id).unwrap().moorings().len(), 2);
    water.remove_mooring(good).unwrap();
    run(&mut water, &mut states, 1);
    assert!(water.mooring_tension(kept).is_ok());
    water.remove_body(id).unwrap();
    assert!(matches!(water.mooring_tension(kept), Err(OpenWaterError::UnknownMooring(_))));
    assert!(matches!(water.remove_mooring(kept), Err(OpenWaterError::UnknownMooring(_))));
    let gone = water.add_mooring(Mooring { body: id, line: line(9.0, 7.0) });
    assert!(matches!(gone, Err(OpenWaterError::UnknownBody(_))));
}

#[test]
fn an_anchor_that_dragged_stays_where_it_is_when_another_line_comes() {
    let (mut water, mut states) = (water(0.0), BodyStates::default());
    let id = boat(&mut water, &mut states);
    let line = MooringLine { holds: 500.0, ..line(9.0, 7.0) };
    water.add_mooring(Mooring { body: id, line }).unwrap();
    water.set_controls(id, Controls { force: Vec3::X * -2000.0, ..Controls::default() }).unwrap();
    run(&mut water, &mut states, 60 * 30);
    let dragged = water.body(id).unwrap().moorings()[0].anchor.x;
    assert!(dragged < 5.0, "{dragged} m");
    let other = water.add_mooring(Mooring { body: id, line: self::line(-90.0, 200.0) }).unwrap();
    assert_eq!(water.body(id).unwrap().moorings()[0].anchor.x, dragged);
    run(&mut water, &mut states, 60);
    let dragged = water.body(id).unwrap().moorings()[0].anchor.x;
    water.remove_mooring(other).unwrap();
    assert_eq!(water.body(id).unwrap().moorings()[0].anchor.x, dragged);
}

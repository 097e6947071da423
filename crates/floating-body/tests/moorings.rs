//! Mooring lines: they pull when taut, do nothing when slack, and give no energy, however stiff.

use floating_body::{
    AiryWave, Body, BodyDesc, BodyError, BodyState, Coefficients, Controls, Drag, FlatWater, Hull, MooringLine,
    WATER_DENSITY, WaterSurface,
};
use glam::{Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;
const NONE: Controls = Controls { throttle: 0.0, steering: 0.0, force: Vec3::ZERO, torque: Vec3::ZERO };

fn boat() -> Body {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    Body::new(BodyDesc::boat(&hull, 4000.0, 10.0)).unwrap()
}

fn line(length: f32, stiffness: f32) -> MooringLine {
    MooringLine {
        point: Vec3::X * 2.8,
        anchor: Vec3::new(9.0, 1.5, 0.0),
        length,
        stiffness,
        damping: 2000.0,
        holds: f32::INFINITY,
    }
}

/// Distance from where the line is made fast on board to its anchor.
fn span(body: &Body, line: &MooringLine) -> f32 {
    let (origin, rotation) = body.hull_pose();
    (origin + rotation * line.point).distance(line.anchor)
}

#[test]
fn a_slack_line_does_nothing() {
    let (mut free, mut tied) = (boat(), boat());
    tied.set_moorings(&[line(30.0, 1.0e5)]).unwrap();
    let mut wave = AiryWave::new(0.4, 20.0, 1.0);
    for t in 0..600 {
        wave.time = f64::from(t) / 60.0;
        free.step(DT, &wave, &NONE);
        tied.step(DT, &wave, &NONE);
        assert_eq!(tied.tensions(), [0.0]);
    }
    assert!((free.state().position - tied.state().position).length() < 1e-3);
}

#[test]
fn a_taut_line_holds_what_the_current_pulls() {
    let mut body = boat();
    let drag = 800.0;
    let mut desc = body.desc().clone();
    desc.drag = Drag { linear: Vec3::splat(drag), angular_linear: Vec3::splat(5000.0), ..Drag::default() };
    desc.skin = None;
    body = Body::new(desc).unwrap();
    // Level with the centre of mass, so that it pulls along x.
    let mut rope = line(6.0, 2.0e4);
    rope.point.y = body.desc().center_of_mass.y;
    rope.anchor.y = body.state().position.y;
    body.set_moorings(&[rope]).unwrap();
    let water = FlatWater { height: 0.0, current: Vec3::X * -1.5 };
    for _ in 0..60 * 60 {
        body.step(DT, &water, &NONE);
    }
    let tension = body.tensions()[0];
    assert!((tension / (drag * 1.5) - 1.0).abs() < 0.02, "{tension} N");
    let stretch = span(&body, &rope) - rope.length;
    assert!((stretch - tension / rope.stiffness).abs() < 2e-3, "{stretch} m");
    assert!(body.state().velocity.length() < 0.01, "{:?}", body.state());
}

#[test]
fn a_moored_boat_in_waves_and_current_stays_within_line_and_stretch() {
    let mut body = boat();
    let rope = MooringLine::rope(Vec3::X * 2.8, Vec3::new(9.0, 1.5, 0.0), 7.0, 4000.0);
    body.set_moorings(&[rope]).unwrap();
    struct Sea(AiryWave);
    impl WaterSurface for Sea {
        fn sample(&self, points: &[Vec2], out: &mut [floating_body::SurfaceSample]) {
            self.0.sample(points, out);
            out[..points.len()].iter_mut().for_each(|s| s.velocity.x -= 1.0);
        }
        fn patch(&self, center: Vec2, radius: f32) -> floating_body::SurfacePatch {
            let mut patch = self.0.patch(center, radius);
            patch.velocity.x -= 1.0;
            patch
        }
    }
    let (mut sea, mut taut, mut farthest, mut most) = (Sea(AiryWave::new(0.35, 18.0, 2.8)), 0, 0.0_f32, 0.0_f32);
    for t in 0..60 * 180 {
        sea.0.time = f64::from(t) / 60.0;
        body.step(DT, &sea, &NONE);
        let tension = body.tensions()[0];
        assert!(tension >= 0.0 && tension.is_finite());
        taut += u32::from(tension > 0.0);
        most = most.max(tension);
        farthest = farthest.max(span(&body, &rope));
    }
    assert!(taut > 1000 && farthest < rope.length + most / rope.stiffness + 0.05, "{taut} {farthest} {most}");
    assert!(farthest < rope.length + 1.5, "{farthest} m");
}

#[test]
fn stiff_lines_give_no_energy() {
    let hull = Hull::sphere(0.5).unwrap();
    for stiffness in [1.0e3, 1.0e5, 1.0e7, 1.0e9] {
        for (damping, count) in [(0.0, 1), (0.0, 4), (1.0e6, 2)] {
            for by_engine in [false, true] {
                let mut desc = BodyDesc::from_hull(&hull, 0.5 * WATER_DENSITY * hull.volume());
                (desc.drag, desc.coefficients) = (Drag::default(), Coefficients::default());
                let mut body = Body::new(desc).unwrap();
                let rope = MooringLine {
                    point: Vec3::ZERO,
                    anchor: Vec3::ZERO,
                    length: 3.0,
                    stiffness,
                    damping,
                    holds: f32::INFINITY,
                };
                body.set_moorings(&vec![rope; count]).unwrap();
                let mut state = BodyState::at_rest(Vec3::new(1.0, 0.0, 0.5));
                state.velocity = Vec3::new(2.0, 0.0, 1.0);
                body.set_state(state);
                let (start, mut fastest, mut farthest) = (state.velocity.length(), 0.0_f32, 0.0_f32);
                for _ in 0..60 * 60 {
                    if by_engine {
                        body.set_state(state);
                        let wrench = body.step_wrench(DT, &FlatWater::default(), &NONE);
                        for _ in 0..4 {
                            state.velocity += (wrench.force / body.desc().mass - Vec3::Y * 9.81) * (DT / 4.0);
                            state.position += state.velocity * (DT / 4.0);
                        }
                    } else {
                        body.step(DT, &FlatWater::default(), &NONE);
                        state = body.state();
                    }
                    fastest = fastest.max(state.velocity.length());
                    farthest = farthest.max(state.position.length());
                }
                let name = format!("{stiffness} N/m, {damping}, {count} lines, engine {by_engine}");
                assert!(fastest < 1.001 * start, "{name}: {fastest} m/s");
                // What turns it round in the line's own time, and a tick's overshoot or two.
                let swing = start * (body.desc().mass / (stiffness * count as f32)).sqrt();
                assert!(farthest < 3.0 + 1.02 * swing + 2.0 * start * DT, "{name}: {farthest} m");
            }
        }
    }
}

#[test]
fn bad_lines_are_refused_and_change_nothing() {
    let mut body = boat();
    body.set_moorings(&[line(6.0, 1.0e4)]).unwrap();
    let bad = [
        (MooringLine { length: -1.0, ..line(6.0, 1.0) }, "mooring.length is -1"),
        (MooringLine { stiffness: f32::NAN, ..line(6.0, 1.0) }, "mooring.stiffness is NaN"),
        (MooringLine { damping: 1.0e12, ..line(6.0, 1.0) }, "mooring.damping is 9"),
        (MooringLine { anchor: Vec3::splat(f32::INFINITY), ..line(6.0, 1.0) }, "mooring.anchor is inf"),
        (MooringLine { point: Vec3::splat(f32::NAN), ..line(6.0, 1.0) }, "mooring.point is NaN"),
        (MooringLine { holds: 0.0, ..line(6.0, 1.0) }, "mooring.holds is 0; it must be above 0 N"),
        (MooringLine { holds: f32::NAN, ..line(6.0, 1.0) }, "mooring.holds is NaN"),
    ];
    for (line, text) in bad {
        let error = body.set_moorings(&[line]).unwrap_err();
        assert!(matches!(error, BodyError::InvalidValue { .. }) && error.to_string().contains(text), "{error}");
        assert_eq!(body.moorings().len(), 1);
    }
}

#[test]
fn rebasing_moves_the_anchors() {
    let (mut here, mut there) = (boat(), boat());
    for body in [&mut here, &mut there] {
        body.set_moorings(&[line(5.0, 2.0e4)]).unwrap();
    }
    there.rebase(Vec2::new(100.0, -40.0));
    for _ in 0..300 {
        here.step(DT, &FlatWater::default(), &NONE);
        there.step(DT, &FlatWater::default(), &NONE);
    }
    let moved = there.state().position + Vec3::new(100.0, 0.0, -40.0);
    assert!((here.state().position - moved).length() < 2e-3, "{:?} {:?}", here.state(), there.state());
    assert!((here.tensions()[0] - there.tensions()[0]).abs() < 20.0);
}

/// A boat in a current that pulls with 800 N s/m, held from a point level with its anchor.
fn anchored(holds: f32, current: f32) -> (Body, Vec<f32>) {
    let mut body = boat();
    let mut desc = body.desc().clone();
    desc.drag = Drag { linear: Vec3::splat(800.0), angular_linear: Vec3::splat(5000.0), ..Drag::default() };
    desc.skin = None;
    body = Body::new(desc).unwrap();
    let rest = body.state().position.y;
    let point = Vec3::new(2.8, body.desc().center_of_mass.y, 0.0);
    let line = MooringLine::anchored(point, Vec3::new(9.0, rest, 0.0), 6.0, 4000.0, holds);
    body.set_moorings(&[line]).unwrap();
    let water = FlatWater { height: 0.0, current: Vec3::X * -current };
    let mut tensions = Vec::new();
    for _ in 0..60 * 120 {
        body.step(DT, &water, &NONE);
        tensions.push(body.tensions()[0]);
    }
    (body, tensions)
}

#[test]
fn an_anchor_holds_up_to_its_force_and_drags_beyond() {
    let (body, tensions) = anchored(6000.0, 1.5);
    assert_eq!(body.moorings()[0].anchor.x, 9.0);
    assert!((tensions.last().unwrap() - 1200.0).abs() < 12.0);
    // In three metres a second it is dragged along with what the current pulls beyond: (3 - v) 800 N = 1500 N.
    let (body, tensions) = anchored(1500.0, 3.0);
    let line = body.moorings()[0];
    assert!(tensions.iter().all(|t| *t <= 1500.1) && (tensions.last().unwrap() - 1500.0).abs() < 2.0);
    let (speed, expected) = (body.state().velocity.x, -(3.0 - 1500.0 / 800.0));
    assert!((speed / expected - 1.0).abs() < 0.02, "{speed} against {expected} m/s");
    // The anchor keeps up, level.
    assert!((span(&body, &line) - line.length - 1500.0 / line.stiffness).abs() < 0.05 && line.anchor.x < -50.0);
    assert!((line.anchor.y - body.state().position.y).abs() < 0.05, "{line:?}");
}

//! Nothing that a game passes at run time breaks a body, and what a description may not hold is refused.

use floating_body::{
    Body, BodyDesc, BodyError, BodyState, Controls, FlatWater, Fleet, FleetDesc, ForcePoints, Hull, Inertia, Quality,
    Radiation, Sampling, SoftContact, SurfacePatch, SurfaceSample, Touch, WaterSurface,
};
use glam::{Quat, Vec2, Vec3};
use proptest::prelude::*;

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -60.0..60.0_f32,
        1 => prop::sample::select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30, 0.0, 1e-30]),
    ]
}

fn any_vector() -> impl Strategy<Value = Vec3> {
    (any_number(), any_number(), any_number()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

fn hull(kind: u8, size: f32) -> Hull {
    match kind {
        0 => Hull::cuboid(Vec3::new(size, size * 0.4, size * 0.7)).unwrap(),
        1 => Hull::sphere(size * 0.5).unwrap(),
        2 => Hull::cylinder(size * 0.1, size).unwrap(),
        _ => Hull::hollow_cylinder(size, size * 0.3, 0.8).unwrap(),
    }
}

/// Water that answers nonsense.
struct Wild(f32);

impl WaterSurface for Wild {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        let v = Vec3::splat(self.0);
        let s = SurfaceSample {
            height: self.0,
            own: self.0,
            normal: v,
            velocity: v,
            acceleration: self.0,
            decay_wavenumber: self.0,
            level: self.0,
        };
        out[..points.len()].fill(s);
    }

    fn patch(&self, _: Vec2, _: f32) -> SurfacePatch {
        let (v, g) = (Vec3::splat(self.0), Vec2::splat(self.0));
        SurfacePatch {
            height: self.0,
            gradient: g,
            own: self.0,
            own_gradient: g,
            velocity: v,
            acceleration: self.0,
            decay_wavenumber: self.0,
            level: self.0,
        }
    }

    fn touch(&self, points: &[Vec3], out: &mut [Touch]) -> bool {
        out[..points.len()].fill(Touch { depth: self.0, normal: Vec3::new(self.0, 1.0, 0.5) });
        true
    }
}

fn assert_sane(body: &Body) -> Result<(), TestCaseError> {
    let s = body.state();
    prop_assert!(s.position.is_finite() && s.velocity.is_finite() && s.angular_velocity.is_finite(), "{s:?}");
    prop_assert!((s.orientation.length() - 1.0).abs() < 1e-3, "{s:?}");
    prop_assert!(s.velocity.length() < 201.0 && s.angular_velocity.length() < 61.0, "{s:?}");
    let mut list = Vec::new();
    body.displacements(&mut list);
    prop_assert!(list.iter().all(|d| d.volume.is_finite() && d.center.is_finite() && d.radius > 0.0));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn wild_inputs_leave_a_finite_body(
        kind in 0..4_u8,
        (position, velocity, spin) in (any_vector(), any_vector(), any_vector()),
        turn in (any_number(), any_number(), any_number(), any_number()),
        steps in proptest::collection::vec((any_number(), any_number(), any_vector(), any_number()), 1..12),
    ) {
        let mut body = Body::new(BodyDesc::from_hull(&hull(kind, 2.0), 300.0)).unwrap();
        let orientation = Quat::from_xyzw(turn.0, turn.1, turn.2, turn.3);
        body.set_state(BodyState { position, orientation, velocity, angular_velocity: spin });
        for (dt, throttle, force, water) in steps {
            let controls = Controls { throttle, steering: throttle, force, torque: force };
            body.step(dt, &Wild(water), &controls);
            assert_sane(&body)?;
        }
    }

    /// Pieces of fleets too, awake, asleep and riding, that push each other and what is solid.
    #[test]
    fn wild_inputs_leave_finite_pieces(
        kind in 0..4_u8,
        size in prop::sample::select(vec![0.05_f32, 1.0, 30.0]),
        density in prop::sample::select(vec![0.01_f32, 0.5, 3.0]),
        (refresh, near, by_grid) in (1..=16_u32, any::<bool>(), any::<bool>()),
        states in proptest::collection::vec((any_vector(), any_vector(), any_vector()), 1..20),
        steps in proptest::collection::vec((any_number(), any_number(), any_vector()), 1..12),
    ) {
        let hull = hull(kind, size);
        let mut body = BodyDesc::from_hull(&hull, density * 1025.0 * hull.volume());
        body.radiation = if by_grid { Radiation::Grid } else { Radiation::Coefficients };
        let contact = near.then(|| SoftContact::of(&hull));
        let mut fleet = Fleet::new(FleetDesc { refresh, contact, ..FleetDesc::new(body) }).unwrap();
        for (position, velocity, angular_velocity) in states {
            let state = BodyState { velocity, angular_velocity, ..BodyState::at_rest(position) };
            // What is no state is refused.
            let _ = fleet.add(state);
        }
        for (dt, water, eye) in steps {
            fleet.look(Some(eye));
            // Now and then of a size that moves something.
            fleet.step(if dt > 1.0 { dt / 60.0 } else { dt }, &Wild(water));
            for (id, s) in fleet.iter() {
                prop_assert!(s.position.is_finite() && s.velocity.is_finite() && s.angular_velocity.is_finite(), "{s:?}");
                prop_assert!((s.orientation.length() - 1.0).abs() < 1e-3, "{s:?}");
                prop_assert!(s.velocity.length() < 230.0 && s.angular_velocity.length() < 61.0, "{s:?}");
                let pose = fleet.hull_pose(id, 0.5).unwrap();
                prop_assert!(pose.0.is_finite() && pose.1.is_finite());
            }
            let mut list = Vec::new();
            fleet.displacements(&mut list);
            prop_assert!(list.iter().all(|d| d.volume.is_finite() && d.center.is_finite() && d.radius > 0.0));
        }
    }

    /// Densities of .01 to 3, masses from grams to thousands of tonnes, ticks of 1 ms to 1 s, impacts at 50 m/s.
    #[test]
    fn no_body_gains_energy_from_still_water(
        kind in 0..4_u8,
        size in prop::sample::select(vec![0.05_f32, 0.3, 1.0, 5.0, 30.0]),
        density in prop::sample::select(vec![0.01_f32, 0.1, 0.5, 0.95, 1.5, 3.0]),
        dt in prop::sample::select(vec![0.001_f32, 1.0 / 120.0, 1.0 / 60.0, 0.1, 1.0]),
        (full, grid, patch, clipped) in (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
        (velocity, spin) in ((-30.0..30.0_f32, -50.0..10.0_f32, -30.0..30.0_f32), (-5.0..5.0_f32, -5.0..5.0_f32, -5.0..5.0_f32)),
    ) {
        let hull = hull(kind, size);
        let mut desc = BodyDesc::from_hull(&hull, density * 1025.0 * hull.volume());
        desc.inertia = if full { Inertia::Full } else { Inertia::PreRigid };
        desc.radiation = if grid { Radiation::Grid } else { Radiation::Coefficients };
        desc.sampling = if patch { Sampling::Patch } else { Sampling::Points };
        desc.quality = if clipped { Quality::Clipped } else { Quality::Points };
        let mut body = Body::new(desc).unwrap();
        let mut state = BodyState::at_rest(Vec3::new(0.0, size, 0.0));
        state.velocity = Vec3::new(velocity.0, velocity.1, velocity.2);
        state.angular_velocity = Vec3::new(spin.0, spin.1, spin.2);
        body.set_state(state);
        // What it has at the start: fall and motion, per mass, and the buoyancy of being pushed under by one step.
        let spun = state.angular_velocity.length() * size;
        let under = size + 50.0 * dt;
        let bound = state.velocity.length_squared() + spun * spun + 2.0 * 9.81 * (2.0 * size + under / density.min(1.0));
        let mut fastest = 0.0_f32;
        let steps = (6.0 / dt).clamp(20.0, 400.0) as u32;
        for _ in 0..steps {
            body.step(dt, &FlatWater::default(), &Controls::default());
            assert_sane(&body)?;
            if density < 1.0 {
                fastest = fastest.max(body.state().velocity.length());
            }
        }
        prop_assert!(fastest * fastest < 1.2 * bound, "{fastest} m/s, bound {}", bound.sqrt());
        prop_assert_eq!(body.resets(), 0);
    }
}

#[test]
fn a_broken_state_is_refused_and_counted() {
    let mut body = Body::new(BodyDesc::from_hull(&hull(0, 1.0), 100.0)).unwrap();
    let before = body.state();
    body.set_state(BodyState { velocity: Vec3::NAN, ..before });
    assert_eq!((body.state(), body.resets()), (before, 1));
}

#[test]
fn bad_descriptions_are_refused_by_field_value_and_bound() {
    let refused = |change: &dyn Fn(&mut BodyDesc)| {
        let mut desc = BodyDesc::boat(&hull(0, 4.0), 900.0, 10.0);
        change(&mut desc);
        let error = Body::new(desc).unwrap_err();
        assert!(matches!(error, BodyError::InvalidValue { .. }));
        error.to_string()
    };
    assert_eq!(refused(&|d| d.mass = 0.0), "mass is 0; it must be in [1e-6, 1e9] kg");
    assert_eq!(refused(&|d| d.mass = f32::NAN), "mass is NaN; it must be in [1e-6, 1e9] kg");
    assert!(refused(&|d| d.center_of_mass.x = f32::INFINITY).starts_with("center_of_mass is inf"));
    assert!(refused(&|d| d.drag.quadratic.z = -1.0).starts_with("drag.quadratic is -1"));
    assert!(refused(&|d| d.points = ForcePoints::Count(0)).starts_with("points is 0"));
    assert!(refused(&|d| d.points = ForcePoints::Given(Vec::new())).starts_with("points is 0"));
    assert!(refused(&|d| d.unit_inertia *= 0.0).starts_with("unit_inertia is 0"));
    assert!(refused(&|d| d.engine.as_mut().unwrap().pitch_speed = 0.0).starts_with("engine.pitch_speed is 0"));
    let text = Hull::cuboid(Vec3::new(1.0, -2.0, 1.0)).unwrap_err().to_string();
    assert_eq!(text, "size is -2; it must be in [0.001, 1000] m");
}

#[test]
fn what_falls_falls_freely_however_stiff_it_is() {
    // Afloat it would swing far faster than its sub-steps resolve.
    let hull = hull(0, 0.1);
    let mut body = Body::new(BodyDesc::from_hull(&hull, 0.015 * 1025.0 * hull.volume())).unwrap();
    let mut state = BodyState::at_rest(Vec3::new(0.0, 3.0, 0.0));
    state.velocity.y = 30.0;
    body.set_state(state);
    for _ in 0..10 {
        body.step(0.4, &FlatWater::default(), &Controls::default());
    }
    let (s, fallen) = (body.state(), 3.0 + 30.0 * 4.0 - 0.5 * 9.81 * 16.0);
    assert!((s.velocity.y - (30.0 - 9.81 * 4.0)).abs() < 1e-2 && (s.position.y - fallen).abs() < 0.5, "{s:?}");
}

#[test]
fn an_impact_on_the_side_turns_a_hull_with_less_than_it_takes() {
    let hull = hull(0, 2.0);
    let mut desc = BodyDesc::from_hull(&hull, 0.5 * 1025.0 * hull.volume());
    // All sideways, far from the centre of mass.
    desc.drag.quadratic.z = 1.0e8;
    desc.drag.angular_linear = Vec3::ZERO;
    desc.drag.angular_quadratic = Vec3::ZERO;
    desc.drag.angular_forward = Vec3::ZERO;
    desc.drag.lateral_center = desc.center_of_mass + Vec3::X * 3.0;
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.velocity.z = 40.0;
    body.set_state(state);
    body.step(1.0 / 60.0, &FlatWater::default(), &Controls::default());
    let spin = body.state().angular_velocity;
    let whole = body.desc().mass + body.desc().coefficients.added_mass.z;
    let turning = 0.5 * spin.dot(body.inertia() * spin);
    assert!(turning < 0.25 * 0.5 * whole * 1600.0 && spin.y.abs() > 1.0, "{turning} J, {spin}");
}

#[test]
fn a_rudder_turns_no_boat_by_more_than_the_flow_has() {
    let hull = hull(0, 0.3);
    let mut desc = BodyDesc::boat(&hull, 0.5 * 1025.0 * hull.volume(), 10.0);
    if let Some(engine) = &mut desc.engine {
        engine.rudder_area = 1.0;
    }
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.velocity.x = 50.0;
    body.set_state(state);
    let controls = Controls { steering: 1.0, ..Controls::default() };
    for _ in 0..60 {
        body.step(1.0 / 60.0, &FlatWater::default(), &controls);
        assert!(body.state().velocity.length() < 50.0, "{:?}", body.state());
    }
}

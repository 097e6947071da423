//! Textures: what tables are refused, what the fit makes of good ones, what is told.

use floating_body::{
    Body, BodyDesc, BodyError, BodyState, Controls, Displacement, Drag, FlatWater, Home, Hull, Radiation,
    RadiationTable, SurfacePatch, SurfaceSample, TextureKernel, WaterSurface,
};
use glam::{Quat, Vec2, Vec3};

const DT: f32 = 1.0 / 60.0;

fn barge() -> BodyDesc {
    let hull = Hull::cuboid(Vec3::new(20.0, 3.0, 10.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 300e3);
    desc.water_density = 1000.0;
    desc.estimate();
    BodyDesc { radiation: Radiation::Grid, drag: Drag::default(), ..desc }
}

/// The barge's heave, roughly.
fn table() -> RadiationTable {
    RadiationTable {
        omega: vec![0.2, 0.6, 1.0, 1.4, 1.8, 2.4, 3.0],
        added: vec![1.25e6, 1.13e6, 8.2e5, 6.3e5, 5.8e5, 6.2e5, 6.6e5],
        damping: vec![1.5e4, 2.35e5, 4.42e5, 4.46e5, 3.1e5, 1.23e5, 3.5e4],
    }
}

fn refusal(change: impl Fn(&mut RadiationTable)) -> String {
    let mut desc = barge();
    let mut heave = table();
    change(&mut heave);
    desc.tables.heave = Some(heave);
    match Body::new(desc) {
        Err(error) => error.to_string(),
        Ok(_) => String::from("accepted"),
    }
}

#[test]
fn bad_tables_are_refused_in_words() {
    assert_eq!(refusal(|_| {}), "accepted");
    assert!(refusal(|t| t.omega.truncate(3)).contains("3 frequencies, 7 added masses and 7 dampings"));
    assert!(refusal(|t| *t = RadiationTable::default()).contains("at least 4"));
    assert!(refusal(|t| t.omega[3] = 1.0).contains("omega in row 3 is 1; it must be finite, positive and above"));
    assert!(refusal(|t| t.omega[0] = 0.0).contains("omega in row 0"));
    assert!(refusal(|t| t.added[2] = f32::NAN).contains("added in row 2 is NaN"));
    assert!(refusal(|t| t.damping[5] = -5e4).contains("damping in row 5 is -50000; it must be finite and >= 0"));
    assert!(refusal(|t| t.damping.fill(0.0)).contains("positive at some frequency"));
    // A little noise below zero is what programs tell.
    assert_eq!(refusal(|t| t.damping[6] = -2e3), "accepted");
    let short = refusal(|t| t.omega.iter_mut().for_each(|w| *w *= 0.3));
    assert!(short.contains("heave reaches from 0.06") && short.contains("the body's own frequency"), "{short}");
}

#[test]
fn a_given_roll_that_misses_the_body_is_an_error_of_roll() {
    let mut desc = barge();
    desc.tables.roll = Some(RadiationTable { omega: vec![5.0, 6.0, 7.0, 8.0], ..table4() });
    assert!(matches!(Body::new(desc), Err(BodyError::TableRange { mode: "roll", .. })));
}

fn table4() -> RadiationTable {
    RadiationTable { omega: vec![0.5, 1.0, 2.0, 3.0], added: vec![2e6; 4], damping: vec![1e5; 4] }
}

/// Mean square over directions of the kernels' transform, each `exp(-k d)`: right for kernels far shallower than the reach.
fn power(kernels: &[TextureKernel], k: f64) -> f64 {
    const DIRECTIONS: usize = 64;
    let turns = (0..DIRECTIONS).map(|i| (i as f64 + 0.5) * std::f64::consts::TAU / DIRECTIONS as f64);
    turns
        .map(|turn| {
            let (sin, cos) = turn.sin_cos();
            let (mut re, mut im) = (0.0, 0.0);
            for kernel in kernels {
                let phase = k * (f64::from(kernel.offset.x) * cos + f64::from(kernel.offset.y) * sin);
                let size = f64::from(kernel.weight) * (-k * f64::from(kernel.depth)).exp();
                (re, im) = (re + size * phase.cos(), im + size * phase.sin());
            }
            (re * re + im * im) / DIRECTIONS as f64
        })
        .sum()
}

/// Damping that a texture stands for at a frequency.
fn damping(kernels: &[TextureKernel], omega: f64) -> f64 {
    let k = omega * omega / 9.81;
    0.5 * 1000.0 * omega * k * power(kernels, k)
}

#[test]
fn textures_radiate_what_the_table_and_the_coefficients_say() {
    let mut desc = barge();
    desc.tables.heave = Some(table());
    let coefficients = desc.coefficients;
    let mut body = Body::new(desc).unwrap();
    assert!(body.textures().is_none() && body.fit_textures(0.5) && !body.fit_textures(0.5));
    let textures = body.textures().unwrap();
    // The reach takes a little of the deep kernels.
    for (omega, expected) in [(1.4, 4.46e5), (1.8, 3.1e5)] {
        let found = damping(&textures.heave, omega);
        assert!((found / expected - 1.0).abs() < 0.15, "{omega}: {found} against {expected}");
    }
    let about = [
        (&textures.roll, coefficients.angular_damping.x, 1.65),
        (&textures.pitch, coefficients.angular_damping.z, 1.6),
    ];
    for (kernels, expected, omega) in about {
        let found = damping(kernels, omega);
        assert!((found / f64::from(expected) - 1.0).abs() < 0.2, "{omega}: {found} against {expected}");
    }
    // Added mass in heave at high frequency by boundary elements: 738 t.
    assert!((textures.left[0] / 738e3 - 1.0).abs() < 0.05, "{:?}", textures.left);
    let volume: f32 = textures.hull.iter().map(|k| k.weight).sum();
    assert!((volume / 300.0 - 1.0).abs() < 0.02, "{volume}");
}

#[test]
fn a_sphere_takes_hulmes_table_and_neither_rolls_nor_pitches_the_water() {
    let mut desc = BodyDesc::from_hull(&Hull::sphere(5.0).unwrap(), 261.8e3);
    desc.water_density = 1000.0;
    desc.estimate();
    desc.radiation = Radiation::Grid;
    let mut body = Body::new(desc).unwrap();
    assert!(body.fit_textures(0.5));
    let textures = body.textures().unwrap();
    assert!(textures.roll.is_empty() && textures.pitch.is_empty());
    // At ka = 1: B = .2484 of 261.8 t times omega.
    let omega = (9.81f64 / 5.0).sqrt();
    let expected = 0.2484 * 261.8e3 * omega;
    let found = damping(&textures.heave, omega);
    assert!((found / expected - 1.0).abs() < 0.15, "{found} against {expected}");
    // High-frequency added mass: half the displaced mass.
    assert!((textures.left[0] / 130.9e3 - 1.0).abs() < 0.06, "{:?}", textures.left);
}

#[test]
fn bodies_with_coefficients_have_no_textures() {
    let mut body = Body::new(BodyDesc { radiation: Radiation::Coefficients, ..barge() }).unwrap();
    assert!(!body.fit_textures(0.5) && body.imprints().is_none());
    let mut body = Body::new(barge()).unwrap();
    assert!(!body.fit_textures(f32::NAN) && !body.fit_textures(0.0));
}

#[test]
fn a_sunk_body_has_no_textures() {
    let mut body = Body::new(BodyDesc { mass: 2.0e6, ..barge() }).unwrap();
    assert!(!body.fit_textures(0.5) && body.textures().is_none());
}

/// Flat water with a grid that answers with these heads.
struct Answer(Vec3);

impl WaterSurface for Answer {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        FlatWater::default().sample(points, out);
    }
    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        FlatWater::default().patch(center, radius)
    }
    fn home(&self) -> Home {
        Home::Own
    }
    fn radiated(&self, _: Vec2, _: f32) -> Option<[f32; 3]> {
        Some(self.0.to_array())
    }
}

#[test]
fn the_grids_answer_lifts_and_turns() {
    for (heads, axis) in [(Vec3::X, 0), (Vec3::Y, 1), (Vec3::Z, 2)] {
        let mut body = Body::new(barge()).unwrap();
        body.fit_textures(0.5);
        let left = body.textures().unwrap().left;
        body.step(DT, &Answer(heads), &Controls::default());
        let state = body.state();
        let rates = [state.velocity.y, state.angular_velocity.x, state.angular_velocity.z];
        let inertia = [300e3, body.inertia().x_axis.x, body.inertia().z_axis.z];
        for (mode, rate) in rates.iter().enumerate() {
            let expected = if mode == axis { 9810.0 * DT / (inertia[mode] + left[mode]) } else { 0.0 };
            assert!(
                (rate - expected).abs() < 0.02 * 9810.0 * DT / (inertia[mode] + left[mode]),
                "{axis} {mode} {rate}"
            );
        }
    }
}

#[test]
fn what_moves_is_told_and_a_spawn_is_not() {
    let water = Answer(Vec3::ZERO);
    let mut body = Body::new(barge()).unwrap();
    body.fit_textures(0.5);
    let mut state = BodyState::at_rest(Vec3::new(3.0, body.rest_height() + 0.05, -2.0));
    state.orientation = Quat::from_rotation_z(0.02);
    state.velocity.x = 2.0;
    body.set_state(state);
    body.step(DT, &water, &Controls::default());
    let mut told = Vec::<Displacement>::new();
    body.displacements(&mut told);
    assert!(told.is_empty());
    let (mut heave, mut pitch, mut hull) = (0.0, 0.0, 0.0);
    for tick in 0..20 {
        let [old, new] = body.imprints().unwrap();
        (heave, pitch, hull) = (heave + new.amounts[0], pitch + new.amounts[2], hull + old.amounts[3] + new.amounts[3]);
        assert!(tick == 0 || (new.at.x - old.at.x - 2.0 * DT).abs() < 1e-3, "{old:?} {new:?}");
        body.step(DT, &water, &Controls::default());
    }
    let [_, last] = body.imprints().unwrap();
    let end = body.state();
    // What was told is the way since the spawn, but for the last step; the hull as a whole keeps its volume.
    let fallen = state.position.y - end.position.y;
    assert!((heave + last.amounts[0] - fallen).abs() < 0.05 * fallen, "{heave} against {fallen}");
    assert!(pitch > 0.0 && hull.abs() < 5e-3, "{pitch} {hull}");
}

#[test]
fn a_body_thrown_out_of_the_water_takes_its_volume_along() {
    let water = Answer(Vec3::ZERO);
    let mut body = Body::new(barge()).unwrap();
    body.fit_textures(0.5);
    body.step(DT, &water, &Controls::default());
    let mut state = body.state();
    state.velocity.y = 12.0;
    body.set_state(state);
    let area = 200.0;
    let mut volume = 0.0;
    for _ in 0..40 {
        body.step(DT, &water, &Controls::default());
        for imprint in body.imprints().unwrap() {
            volume += imprint.amounts[0] * area + imprint.amounts[3] * 300.0;
        }
    }
    assert!(body.immersed_volume() == 0.0 && (volume / -300.0 - 1.0).abs() < 0.02, "{volume}");
}

#[test]
fn a_sphere_tells_all_of_its_heave() {
    // One point: that it tells no slope of the water is no tilt, nor is how it lies.
    let ball = Hull::sphere(5.0).unwrap();
    let mut body = Body::new(BodyDesc { radiation: Radiation::Grid, ..BodyDesc::from_hull(&ball, 261.8e3) }).unwrap();
    body.fit_textures(0.5);
    for turned in [0.0, 1.0, 3.0] {
        let orientation = Quat::from_rotation_x(turned);
        let start = BodyState { orientation, ..BodyState::at_rest(Vec3::Y * (body.rest_height() + 0.05)) };
        body.teleport(start).unwrap();
        let mut told = 0.0;
        for _ in 0..60 {
            body.step(1.0 / 60.0, &Answer(Vec3::ZERO), &Controls::default());
            told -= body.imprints().unwrap()[0].amounts[0];
        }
        let heave = body.state().position.y - start.position.y;
        assert!(heave < -0.03 && (told - heave).abs() < 1e-4, "{told} m of {heave} m, turned by {turned}");
    }
}

#[test]
fn what_a_led_body_has_told_depends_on_its_place_alone() {
    let water = Answer(Vec3::ZERO);
    let mut body = Body::new(barge()).unwrap();
    body.fit_textures(0.5);
    let (rest, still) = (body.rest_height(), BodyState::at_rest(Vec3::ZERO));
    let (mut sums, mut at) = ([0.0f32; 4], Vec::new());
    // Afloat, in the air, far below, heeled, bottom up; in one leap each, and the way down in small steps.
    let down = (0..200u8).map(|i| (-0.1 * f32::from(i), 0.0));
    let poses = [(0.0, 0.0), (6.0, 0.0), (-5.0, 0.0), (0.3, 0.5), (6.0, 0.9), (0.0, 2.5), (0.0, 0.0)];
    for (heave, roll) in poses.into_iter().cycle().take(69).chain(down).chain([(0.0, 0.0)]) {
        let orientation = Quat::from_rotation_x(roll);
        body.set_state(BodyState { position: Vec3::Y * (rest + heave), orientation, ..still });
        body.step(1e-4, &water, &Controls::default());
        for imprint in body.imprints().unwrap() {
            sums.iter_mut().zip(imprint.amounts).for_each(|(sum, amount)| *sum += amount);
        }
        let told = sums[0] * 200.0 + sums[3] * 300.0;
        let held = body.told_volume() - 300.0;
        assert!((told - held).abs() < 0.5, "{told} of {held} m^3 at {heave} m");
        at.push((heave, roll, sums));
    }
    let home: Vec<[f32; 4]> = at.iter().filter(|(heave, roll, _)| (*heave, *roll) == (0.0, 0.0)).map(|a| a.2).collect();
    assert!(home.len() > 8 && home.iter().flatten().all(|sum| sum.abs() < 2e-3), "{home:?}");
}

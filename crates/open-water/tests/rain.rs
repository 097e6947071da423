//! Rain on a tile that repeats over the sea, beside a boat's own grid.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyStates, Border, Follow, GridDesc, GridHome, Hull, Look, OpenWater, OpenWaterDesc, OpenWaterError,
    Preset, Rain, Scheme, WaterSample,
};

const RAIN: Rain = Rain { rate: 40.0, drop_radius: 0.002, seed: 3 };

fn shower() -> GridDesc {
    GridDesc {
        follow: Follow::Fixed(DVec2::new(40.0, -30.0)),
        cells: [98; 2],
        cell_size: [0.03; 2],
        scheme: Scheme::NinePoint,
        wave_speed: 0.6,
        border: Border::Periodic,
        damping: 1.0,
        rain: Some(RAIN),
        ..GridDesc::default()
    }
}

fn calm() -> OpenWater {
    let mut calm: OpenWaterDesc = Preset::Low.water();
    calm.sea.partitions.clear();
    OpenWater::headless(calm).unwrap()
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f32> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|sample| sample.height).collect()
}

fn most(heights: &[f32]) -> f32 {
    heights.iter().fold(0.0, |most, z| most.max(z.abs()))
}

#[test]
fn rain_ripples_around_the_eye_and_is_nobodys_home() {
    let mut water = calm();
    let tile = water.add_grid(shower()).unwrap();
    let hull = Hull::cuboid(Vec3::new(4.0, 1.0, 2.0)).unwrap();
    let boat = water.add_body(BodyDesc::boat(&hull, 2_000.0, 5.0)).unwrap();
    let own = water.add_grid(GridDesc { follow: Follow::Body(boat), cells: [128; 2], ..Preset::Low.grid() }).unwrap();
    let mut store = BodyStates::default();
    store.insert(boat, water.body(boat).unwrap().state());
    let eye = Vec3::new(200.0, 3.0, 100.0);
    water.look(Look { eye, direction: Vec3::X, fov_y: 0.8, aspect: 1.5 });
    for _ in 0..90 {
        for tick in water.advance(1.0 / 60.0) {
            water.tick(tick, &mut store).unwrap();
        }
    }
    assert_eq!(water.home(boat).unwrap(), Some(own));
    let around: Vec<_> = (0..60).map(|k| Vec2::new(eye.x + 0.21 * k as f32, eye.z - 0.13 * k as f32)).collect();
    let here = heights(&water, &around);
    assert!((2e-4..2e-2).contains(&most(&here)), "{} m", most(&here));
    // One period on it is the same, and as near the eye.
    let period = 96.0 * 0.03;
    let next = heights(&water, &around.iter().map(|p| *p + Vec2::new(period, -period)).collect::<Vec<_>>());
    let apart = here.iter().zip(&next).fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
    assert!(apart < 1e-3 * most(&here), "{apart} m");
    // Nothing where it has faded.
    let far: Vec<_> = around.iter().map(|p| *p + Vec2::new(0.0, 75.0)).collect();
    assert_eq!(most(&heights(&water, &far)), 0.0);
    assert!(water.grid(tile).unwrap().is_some_and(|grid| grid.is_finite()));
}

#[test]
fn bad_rain_is_refused() {
    let mut water = calm();
    let message = |desc: GridDesc, water: &mut OpenWater| match water.add_grid(desc) {
        Err(error @ OpenWaterError::InvalidValue { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let rain = |rain: Rain| GridDesc { rain: Some(rain), ..shower() };
    assert!(message(rain(Rain { rate: f32::NAN, ..RAIN }), &mut water).contains("rain: rate"));
    assert!(message(rain(Rain { drop_radius: 0.0, ..RAIN }), &mut water).contains("rain: drop_radius"));
    assert!(message(GridDesc { home: GridHome::Gpu, ..shower() }, &mut water).contains("rain: rate"));
}

//! Bodies that the game leads: their states are overwritten before every tick.

use std::f32::consts::TAU;

use glam::{EulerRot, Quat, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Border, Follow, GridDesc, Hull, OpenWater, OpenWaterDesc, Preset, Radiation,
    Scheme,
};

const DT: f32 = 1.0 / 60.0;

/// A cube of 1 m afloat on half its height.
fn cube(radiation: Radiation) -> BodyDesc {
    BodyDesc { radiation, ..BodyDesc::from_hull(&Hull::cuboid(Vec3::ONE).unwrap(), 512.5) }
}

/// The energy of the waves (m^5/s^2) and the highest of them (m) after each tick of a cube that `lead` moves, from rest.
fn led(desc: BodyDesc, grid: GridDesc, ticks: u16, mut lead: impl FnMut(f32) -> BodyState) -> Vec<(f64, f32)> {
    let mut water: OpenWaterDesc = Preset::Low.water();
    water.sea.partitions.clear();
    let mut water = OpenWater::headless(water).unwrap();
    let body = water.add_body(desc).unwrap();
    let rest = Vec3::Y * water.body(body).unwrap().rest_height();
    let grid = water.add_grid(GridDesc { follow: Follow::Body(body), cell_size: [0.25; 2], ..grid }).unwrap();
    let mut store = BodyStates::default();
    (0..ticks)
        .map(|tick| {
            let state = lead(f32::from(tick) * DT);
            store.insert(body, BodyState { position: state.position + rest, ..state });
            for tick in water.advance(DT) {
                water.tick(tick, &mut store).unwrap();
            }
            let waves = water.grid(grid).unwrap().unwrap();
            (waves.energy(), waves.heights().iter().fold(0.0, |most, height| height.abs().max(most)))
        })
        .collect()
}

#[test]
fn a_body_led_up_and_down_gives_the_power_of_its_waves() {
    // Linear theory: B w^2 a^2 / 2, with B of its own coefficients, and of a small source B = rho w k S^2 / 2.
    let body = cube(Radiation::Grid);
    let own = body.coefficients;
    let natural = (body.water_density * 9.81 / (body.mass + own.added_mass.y)).sqrt();
    let small = |omega: f32| 0.5 * omega.powi(3) / 9.81;
    // The discs that tell of a column are wider than it, which takes some of the shorter waves.
    let cases = [
        (Radiation::Coefficients, 2.0, small(2.0), 0.2),
        (Radiation::Grid, natural, own.damping.y / body.water_density, 0.05),
    ];
    for (radiation, omega, damping, within) in cases {
        let border = Border::Reflecting;
        let amplitude = 0.05f32;
        // Two swings to begin with, then three: waves that come back from the walls find them over.
        let [from, to] = [2.0, 5.0].map(|swings| (swings * TAU / (omega * DT)).round());
        let waves =
            led(cube(radiation), GridDesc { cells: [160; 2], border, ..GridDesc::default() }, to as u16 + 1, |t| {
                let (sin, cos) = (omega * t).sin_cos();
                BodyState {
                    velocity: Vec3::Y * (amplitude * omega * cos),
                    ..BodyState::at_rest(Vec3::Y * (amplitude * sin))
                }
            });
        let power = (waves[to as usize].0 - waves[from as usize].0) as f32 / ((to - from) * DT);
        let expected = 0.5 * damping * (omega * amplitude).powi(2);
        assert!((power / expected - 1.0).abs() < within, "{radiation:?}: {power} against {expected}");
    }
}

#[test]
fn a_body_led_at_random_raises_no_more_water_than_it_holds() {
    for radiation in [Radiation::Coefficients, Radiation::Grid] {
        for scheme in [Scheme::Dispersive, Scheme::NinePoint] {
            for turns in [0.0, 3.0] {
                let mut seed = 1u32;
                let mut random = |most: f32| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    most * ((seed >> 8) as f32 / (1 << 23) as f32 - 1.0)
                };
                let border = Border::Absorbing { width: 8 };
                let grid = GridDesc { cells: [96; 2], scheme, border, ..GridDesc::default() };
                // Leaps of up to 3.4 m: from 3.5 m on they are teleports.
                let waves = led(cube(radiation), grid, 600, |_| BodyState {
                    orientation: Quat::from_euler(EulerRot::XYZ, random(turns), random(turns), random(turns)),
                    ..BodyState::at_rest(Vec3::Y * random(1.7))
                });
                let highest = waves.iter().fold(0.0f32, |most, (_, height)| height.max(most));
                // A cube of water on the cube's footprint.
                assert!(highest < 1.0, "{radiation:?}, {scheme:?}, turns of {turns}: {highest} m");
            }
        }
    }
}

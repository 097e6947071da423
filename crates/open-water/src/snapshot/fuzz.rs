//! Bytes of somebody who means ill: changed at random, under a digest that is right. They are refused, or become a water that
//! goes on without a panic and answers with numbers.

use floating_body::{BodyDesc, BodyState, Controls, FleetDesc, Hull, MooringLine, Radiation};
use glam::{Vec2, Vec3};

use super::WaterSnapshot;
use super::bytes::{HEADER, digest};
use crate::{
    BodyId, BodyStates, Border, CascadeDesc, Follow, GridDesc, Look, Mooring, OpenWater, OpenWaterDesc, Preset,
    SeaState, WakesDesc, WaterSample,
};

const CASES: u64 = 600;
/// Bytes at the beginning and at the end that hold most of what is not numbers of grids.
const ENDS: usize = 16 << 10;

struct Dice(u64);

impl Dice {
    fn roll(&mut self, of: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % of
    }
}

fn small() -> OpenWaterDesc {
    OpenWaterDesc { cascades: vec![CascadeDesc::new(16, 120.0), CascadeDesc::new(16, 20.0)], ..Preset::Low.water() }
}

/// A little of everything, for some ticks.
fn lived() -> (OpenWater, BodyStates, Vec<BodyId>) {
    let mut water = OpenWater::headless(small()).unwrap();
    let (mut store, mut ids) = (BodyStates::default(), Vec::new());
    let boat = BodyDesc::boat(&Hull::cuboid(Vec3::new(4.0, 1.2, 1.6)).unwrap(), 2500.0, 8.0);
    let ball = BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8)).unwrap(), 200.0);
    for (x, desc) in [(0.0, boat), (6.0, BodyDesc { radiation: Radiation::Grid, ..ball.clone() })] {
        let id = water.add_body(desc).unwrap();
        store.insert(id, BodyState::at_rest(Vec3::new(x, 0.2, 0.0)));
        ids.push(id);
        water.set_controls(id, Controls { throttle: 0.8, steering: 0.2, ..Controls::default() }).unwrap();
        let line = MooringLine::anchored(Vec3::ZERO, Vec3::new(x + 9.0, -3.0, 3.0), 4.0, 400.0, 50.0);
        water.add_mooring(Mooring { body: id, line }).unwrap();
        let border = Border::Absorbing { width: 8 };
        water.add_grid(GridDesc { cells: [48; 2], follow: Follow::Body(id), border, ..Preset::Low.grid() }).unwrap();
    }
    let fleet = water.add_fleet(FleetDesc::new(ball)).unwrap();
    for i in 0..10u8 {
        let place = Vec3::new(3.0 * f32::from(i) - 15.0, 0.1, -8.0);
        water.fleet_mut(fleet).unwrap().add(BodyState::at_rest(place)).unwrap();
    }
    let grid = GridDesc { cells: [48; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
    water.set_wakes(Some(WakesDesc { cells: 3 * 48 * 48, grid, ..WakesDesc::default() })).unwrap();
    water.look(Look { eye: Vec3::Y * 4.0, direction: Vec3::X, fov_y: 0.8, aspect: 1.6 });
    water.change_sea(SeaState::wind(9.0, 50e3, 0.3), 2.0).unwrap();
    run(&mut water, &mut store, 40);
    (water, store, ids)
}

fn run(water: &mut OpenWater, store: &mut BodyStates, ticks: u64) {
    let end = water.ticks_until(water.last_tick().saturating_add(ticks));
    for tick in end {
        let _ = water.tick(tick, store);
    }
}

/// What somebody may do to bytes.
fn spoil(bytes: &mut Vec<u8>, dice: &mut Dice) {
    for _ in 0..=dice.roll(3) {
        // Grids are in the middle and large.
        let at = match (dice.roll(3), ENDS.min(bytes.len())) {
            (0, ends) => dice.roll(ends),
            (1, ends) => bytes.len() - 1 - dice.roll(ends),
            _ => dice.roll(bytes.len()),
        };
        match dice.roll(6) {
            0 => bytes[at] ^= 1 << dice.roll(8),
            1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][dice.roll(5)],
            2 => bytes.insert(at, dice.roll(256) as u8),
            3 => drop(bytes.remove(at)),
            // A float that is none, where one may stand.
            4 if at + 4 <= bytes.len() => {
                bytes[at..at + 4].copy_from_slice(&[f32::NAN, f32::INFINITY, 1e30, -1.0][dice.roll(4)].to_le_bytes());
            }
            _ => bytes[at] = dice.roll(256) as u8,
        }
    }
}

/// What a water made of these bytes comes to: whether they were read, and restored.
fn outcome(bytes: &[u8], store: &BodyStates, ids: &[BodyId]) -> [bool; 2] {
    let Ok(snapshot) = WaterSnapshot::from_bytes(bytes) else { return [false; 2] };
    let mut water = OpenWater::headless(small()).unwrap();
    if water.restore(&snapshot).is_err() {
        return [true, false];
    }
    let mut store = store.clone();
    run(&mut water, &mut store, 3);
    let points: Vec<Vec2> = (0..40u8).map(|i| Vec2::new(f32::from(i) - 20.0, 0.3 * f32::from(i))).collect();
    let mut samples = vec![WaterSample::default(); points.len()];
    water.sample(&points, &mut samples);
    assert!(samples.iter().all(|sample| sample.height.is_finite() && sample.velocity.is_finite()), "a height");
    assert!(ids.iter().all(|id| store.get(*id).is_none_or(|state| state.position.is_finite())), "a body");
    let _ = (water.hash(), water.snapshot().to_bytes());
    [true; 2]
}

#[test]
fn crafted_bytes_are_refused_or_become_a_water_that_goes_on() {
    let (water, store, ids) = lived();
    let bytes = water.snapshot().to_bytes();
    let mut count = [0; 2];
    for case in 0..CASES {
        let mut body = bytes[HEADER..].to_vec();
        spoil(&mut body, &mut Dice(case));
        let bytes: Vec<u8> = [&bytes[..8], &digest(&body).to_le_bytes(), &body].concat();
        let done = outcome(&bytes, &store, &ids);
        count = std::array::from_fn(|k| count[k] + usize::from(done[k]));
    }
    // Some are refused when they are read, others when they are restored; what is left was a water.
    let [read, restored] = count;
    assert!(read < CASES as usize && restored < read && restored > 100, "{count:?}");
}

//! Bodies that go from one grid to another.

use glam::{DVec2, Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Controls, Follow, GridDesc, Hull, OpenWater, OpenWaterDesc, Preset,
    Radiation, Scheme, WaterSample,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 9.81;

fn calm() -> OpenWater {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    OpenWater::headless(desc).unwrap()
}

/// Cells of .25 m around (x, 0).
fn grid(x: f64, cells: [u32; 2]) -> GridDesc {
    let follow = Follow::Fixed(DVec2::new(x, 0.0));
    let scheme = Scheme::NinePoint;
    GridDesc { follow, cells, cell_size: [0.25; 2], scheme, wave_speed: 6.2, ..GridDesc::default() }
}

fn tick(water: &mut OpenWater, store: &mut BodyStates) {
    for tick in water.advance(DT) {
        water.tick(tick, store).unwrap();
    }
}

/// A boat that goes along x through these grids; with `float`, something that bobs ahead of it.
struct Run {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
}

impl Run {
    fn new(grids: &[GridDesc], float: bool) -> Self {
        let mut water = calm();
        for desc in grids {
            water.add_grid(desc.clone()).unwrap();
        }
        let mut store = BodyStates::default();
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
        let desc = BodyDesc { radiation: Radiation::Grid, ..BodyDesc::boat(&hull, 4_000.0, 10.0) };
        let boat = water.add_body(desc).unwrap();
        water.set_controls(boat, Controls { throttle: 0.8, ..Controls::default() }).unwrap();
        let start = water.body(boat).unwrap().state();
        let state = BodyState { velocity: Vec3::X * 7.0, position: start.position - Vec3::X * 25.0, ..start };
        store.insert(boat, state);
        if float {
            let hull = Hull::cuboid(Vec3::splat(1.6)).unwrap();
            let desc = BodyDesc { radiation: Radiation::Grid, ..BodyDesc::from_hull(&hull, 2_000.0) };
            let id = water.add_body(desc).unwrap();
            store.insert(id, BodyState::at_rest(Vec3::new(34.0, 1.0, 5.0)));
        }
        Self { water, store, boat }
    }

    fn tick(&mut self) -> BodyState {
        tick(&mut self.water, &mut self.store);
        *self.store.get(self.boat).unwrap()
    }
}

fn two() -> [GridDesc; 2] {
    [grid(-12.0, [256, 192]), grid(20.0, [256, 192])]
}

fn one() -> [GridDesc; 1] {
    [grid(4.0, [512, 192])]
}

#[test]
fn a_boat_that_goes_over_to_another_grid_leaves_one_wake() {
    let (mut parts, mut whole) = (Run::new(&two(), false), Run::new(&one(), false));
    let (mut homes, mut after, mut worst) = (Vec::new(), 0, 0.0f32);
    let (mut rate, mut reference) = (0.0, 0.0);
    while after < 75 {
        let (p, w) = (parts.tick(), whole.tick());
        let home = parts.water.home(parts.boat).unwrap();
        if homes.last() != Some(&home) {
            homes.push(home);
        }
        let jump = ((p.velocity.y - rate) - (w.velocity.y - reference)) / DT;
        // Beyond, what is left of its waves fades with the first grid.
        if p.position.x < 13.0 {
            worst = worst.max(jump.abs() / GRAVITY);
        }
        (rate, reference) = (p.velocity.y, w.velocity.y);
        after += usize::from(homes.len() > 1);
    }
    assert_eq!(homes.len(), 2, "from the one to the other, once");
    let boat = parts.store.get(parts.boat).unwrap().position;
    assert!(boat.x > 12.0, "{boat}");
    // Where neither grid fades or absorbs.
    let points: Vec<Vec2> =
        (0..4000).map(|i| Vec2::new(-6.0 + 0.05 * (i % 400) as f32, -18.0 + 3.7 * (i / 400) as f32)).collect();
    let heights = |water: &OpenWater| {
        let mut out = vec![WaterSample::default(); points.len()];
        water.sample(&points, &mut out);
        out.iter().map(|sample| sample.height).collect::<Vec<_>>()
    };
    let (found, truth) = (heights(&parts.water), heights(&whole.water));
    let rms = |values: &mut dyn Iterator<Item = f32>| values.map(|v| v * v).sum::<f32>().sqrt();
    let size = rms(&mut truth.iter().copied());
    let error = rms(&mut found.iter().zip(&truth).map(|(a, b)| a - b)) / size;
    assert!(size / (points.len() as f32).sqrt() > 0.02 && error < 1e-3, "{error} of {size}");
    assert!(worst < 1e-4, "{worst} of the weight");
}

#[test]
fn forces_do_not_jump_where_others_make_waves() {
    let (mut parts, mut homes) = (Run::new(&two(), true), Vec::new());
    let mut whole = Run::new(&one(), true);
    let (mut last, mut rough) = ([Vec3::ZERO; 4], [0.0f32; 2]);
    for _ in 0..330 {
        for (k, run) in [&mut parts, &mut whole].into_iter().enumerate() {
            let velocity = run.tick().velocity;
            // Change of the force from tick to tick.
            let force = (velocity - last[2 * k]) / DT;
            rough[k] = rough[k].max((force.y - last[2 * k + 1].y).abs() / GRAVITY);
            (last[2 * k], last[2 * k + 1]) = (velocity, force);
        }
        let home = parts.water.home(parts.boat).unwrap();
        if homes.last() != Some(&home) {
            homes.push(home);
            rough = if homes.len() == 1 { [0.0; 2] } else { rough };
        }
    }
    assert_eq!(homes.len(), 2);
    assert!(rough[0] < 1.3 * rough[1], "{rough:?} of the weight in a tick, in two grids and in one");
}

#[test]
fn a_body_at_an_edge_does_not_go_to_and_fro() {
    let fine = GridDesc { cell_size: [0.125; 2], ..grid(20.0, [256; 2]) };
    let mut run = Run::new(&[grid(0.0, [512, 192]), fine], false);
    run.water.set_controls(run.boat, Controls::default()).unwrap();
    let start = run.water.body(run.boat).unwrap().state();
    let mut changes = 0;
    let mut home = None;
    for i in 0..600 {
        // In the finer grid, then to and fro over its edge at 9.3 m.
        let x = if i < 100 { 14.0 } else { 9.3 + 0.4 * (i as f32 * 0.9).sin() };
        run.store.insert(run.boat, BodyState { position: start.position + Vec3::X * x, ..start });
        run.tick();
        let now = run.water.home(run.boat).unwrap();
        changes += usize::from(now != home);
        home = now;
    }
    assert_eq!(changes, 2, "into the fine one, and out of it for good");
}

#[test]
fn grids_that_come_and_go_do_not_shake_the_bodies() {
    let mut run = Run::new(&one(), false);
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let guest = run.water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
    let state = BodyState { orientation: Quat::from_rotation_y(0.4), ..BodyState::at_rest(Vec3::new(0.0, -0.2, 5.0)) };
    run.store.insert(guest, state);
    let (mut rates, mut forces, mut worst) = ([0.0f32; 2], [0.0f32; 2], [0.0f32; 2]);
    let mut added = None;
    for i in 0..420 {
        match i {
            200 => {
                let follow = Follow::Body(run.boat);
                let wake = GridDesc { follow, cells: [128; 2], ..grid(0.0, [128; 2]) };
                added = Some(run.water.add_grid(wake).unwrap());
            }
            300 => run.water.remove_grid(added.unwrap()).unwrap(),
            _ => {}
        }
        run.tick();
        for (k, id) in [run.boat, guest].into_iter().enumerate() {
            let rate = run.store.get(id).unwrap().velocity.y;
            let force = (rate - rates[k]) / DT / GRAVITY;
            let jump = (force - forces[k]).abs();
            // Not while the first waves come.
            worst[k] = if i < 100 { 0.0 } else { worst[k].max(jump) };
            (rates[k], forces[k]) = (rate, force);
        }
    }
    assert!(worst[0] < 0.02 && worst[1] < 0.06, "{worst:?}");
}

//! Grids that come and go: both sides fade them alike.

use glam::{Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Consumers, Controls, GridDesc, Hull, Look, OpenWater, Wake, WakesDesc,
    WaterSample, Work,
};

use super::{DT, calm, points, probe, view};
use crate::context::Context;

#[test]
fn a_grid_that_fades_into_another_is_the_same_on_both_sides() {
    let context = Context::new();
    let mut water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
    let grid = GridDesc { cells: [160; 2], cell_size: [0.25; 2], ..GridDesc::default() };
    water.set_wakes(Some(WakesDesc { cells: 4 * 160 * 160, grid, fine: 50.0, ..WakesDesc::default() })).unwrap();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
    water.set_controls(boat, Controls { throttle: 0.8, ..Controls::default() }).unwrap();
    let mut store = BodyStates::default();
    let start = water.body(boat).unwrap().state();
    store.insert(boat, BodyState { velocity: Vec3::X * 8.0, ..start });
    let mut run = |water: &mut OpenWater, away: f32, ticks: usize| {
        for _ in 0..ticks {
            let at = store.get(boat).unwrap().position;
            water.look(Look { eye: at + Vec3::Y * away, direction: -Vec3::Y, fov_y: 0.8, aspect: 1.5 });
            for tick in water.advance(DT) {
                water.tick(tick, &mut store).unwrap();
            }
        }
        store.get(boat).unwrap().position
    };
    run(&mut water, 10.0, 100);
    let at = run(&mut water, 80.0, 40);
    assert!(matches!(water.wake(boat).unwrap(), Wake::Grid { cell_size: [0.5, _], .. }));
    let mut plan = water.plan(&view(), Consumers::NORMALS);
    assert_eq!(plan.work.iter().filter(|work| matches!(work, Work::GridUpload { .. })).count(), 2);
    plan.alpha = 1.0;
    context.submit(|encoder| water.encode(&plan, encoder));
    let points: Vec<Vec2> = points(at).into_iter().take(3000).collect();
    let found = probe(&context, &water, &points);
    let mut expected = vec![WaterSample::default(); points.len()];
    water.sample(&points, &mut expected);
    let mut highest = 0.0f32;
    for ((point, f), e) in points.iter().zip(&found).zip(&expected) {
        assert!((f[0] - e.height).abs() < 1e-4, "{point}: {f:?} against {e:?}");
        assert!(Vec3::new(f[1], f[2], f[3]).dot(e.normal) > 0.99999, "{point}: {f:?} against {e:?}");
        highest = highest.max(e.height.abs());
    }
    assert!(highest > 0.1, "{highest}");
    assert!(context.take_errors().is_empty());
}

//! Grids that come and go: both sides fade them alike. Grids that stand for the whole plane.

use glam::{Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Consumers, Controls, GridDesc, Hull, Look, OpenWater, Wake, WakesDesc,
    WaterSample, Work,
};

use open_water_shaders::surface::SurfaceGrid;

use super::{DT, calm, points, probe, probe_group, view};
use crate::context::Context;
use crate::view_stage::{Sea, Stage};

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

#[test]
fn a_tiled_grid_stands_for_the_whole_plane_and_fades_around_its_middle() {
    let context = Context::new();
    let cells = [66u32, 50];
    let (cell_size, middle, reach) = (Vec2::new(0.5, 0.25), Vec2::new(40.0, -30.0), 90.0);
    let corner = Vec2::new(-7.0, 3.0);
    // Two waves across the period along x and one along z; the outermost ring repeats what is on the other side.
    let period = Vec2::new(64.0, 48.0) * cell_size;
    let wave = |p: Vec2| {
        let turns = (p - corner) / period * std::f32::consts::TAU;
        0.3 * (2.0 * turns.x).sin() + 0.2 * turns.y.cos()
    };
    let texels = (0..cells[0] * cells[1])
        .map(|at| {
            let cell = Vec2::new((at % cells[0]) as f32, (at / cells[0]) as f32) + 0.5;
            [wave(corner + cell * cell_size), 0.0]
        })
        .collect();
    let grid = SurfaceGrid {
        corner: corner.into(),
        cell_size: cell_size.into(),
        cells,
        gain: 0.5,
        middle: middle.into(),
        reach,
        tiled: 1,
        ..SurfaceGrid::default()
    };
    let stage = Stage::new(&context, &Sea { grids: vec![(grid, texels)], ..Sea::flat() });
    let points: Vec<Vec2> =
        (0..4000u16).map(|i| middle + Vec2::from_angle(f32::from(i) * 2.399_963) * 1.6 * f32::from(i).sqrt()).collect();
    let found = probe_group(&context, &stage.layout, &stage.group, &points);
    let mut seen = [0.0f32; 2];
    for (point, f) in points.iter().zip(&found) {
        let t = ((point.distance(middle) / reach - 0.5) / 0.5).clamp(0.0, 1.0);
        let expected = 0.5 * wave(*point) * (1.0 - t * t * (3.0 - 2.0 * t));
        assert!((f[0] - expected).abs() < 1e-3, "{point}: {} against {expected}", f[0]);
        seen[usize::from(t == 1.0)] += f[0].abs();
    }
    assert!(seen[0] > 100.0 && seen[1] == 0.0, "{seen:?}");
    assert!(context.take_errors().is_empty());
}

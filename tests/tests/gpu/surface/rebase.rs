//! The local origin moves: what is drawn stands where it stood in the world, in the same frame.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, Border, Consumers, DepthMap, Follow, GridDesc, GridHome, Hull, Land, Preset, Scheme,
    WaterSample, Work,
};

use super::{DT, points, probe, scene};
use crate::context::Context;

const OFFSET: DVec2 = DVec2::new(96.0, -160.0);

#[test]
fn what_is_drawn_stays_where_it_is_in_the_world() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    // Factors of the sea that differ from place to place, and a grid of the device's own.
    let elevation = |i: usize| -1.0 - 0.25 * (i % 64) as f32;
    let bed = DepthMap::new(DVec2::splat(-128.0), 4.0, [64; 2], (0..64 * 64).map(elevation).collect()).unwrap();
    scene.water.set_land(Some(Land::new(bed))).unwrap();
    let float = scene.water.add_body(BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0)).unwrap(), 500.0)).unwrap();
    let (border, scheme) = (Border::Absorbing { width: 8 }, Scheme::NinePoint);
    let grid = GridDesc {
        follow: Follow::Body(float),
        home: GridHome::Gpu,
        cells: [96; 2],
        border,
        scheme,
        ..GridDesc::default()
    };
    let grid = scene.water.add_grid(grid).unwrap();
    scene.store.insert(float, BodyState::at_rest(Vec3::new(6.0, 1.5, 30.0)));
    let all = Consumers::NORMALS | Consumers::FOAM;
    for _ in 0..60 {
        scene.frame(Some(&context), DT, all);
    }
    scene.frame(Some(&context), 0.4 * DT, all);
    assert!(scene.water.grid_age(grid).unwrap().is_some());
    let boat = scene.store.get(scene.boat).unwrap().position;
    let mut before = points(boat);
    before.truncate(2000);
    before.extend(points(Vec3::new(6.0, 0.0, 30.0)).into_iter().take(2000));
    let after: Vec<Vec2> = before.iter().map(|point| *point - OFFSET.as_vec2()).collect();
    let sampled = |scene: &super::Scene, points: &[Vec2]| {
        let mut out = vec![WaterSample::default(); points.len()];
        scene.water.sample(points, &mut out);
        out.iter().map(|sample| sample.height).collect::<Vec<_>>()
    };
    let drawn = |scene: &super::Scene, points: &[Vec2]| {
        probe(&context, &scene.water, points).iter().map(|f| f[0]).collect::<Vec<_>>()
    };
    let was = [sampled(&scene, &before), drawn(&scene, &before)];
    // The game does not even run a tick: the same moment, from elsewhere.
    scene.water.rebase(OFFSET).unwrap();
    let plan = scene.frame(Some(&context), 0.0, all);
    assert!(
        plan.work.contains(&Work::Table) && !plan.work.iter().any(|work| matches!(work, Work::Ocean { .. })),
        "{plan}"
    );
    let is = [sampled(&scene, &after), drawn(&scene, &after)];
    for (was, is) in was.iter().zip(&is) {
        let off = was.iter().zip(is).fold(0.0_f32, |most, (a, b)| most.max((a - b).abs()));
        let waves = was.iter().fold(0.0_f32, |most, z| most.max(z.abs()));
        assert!(off < 2e-4 && waves > 0.1, "{off} m of {waves}");
    }
    assert!(context.take_errors().is_empty());
}

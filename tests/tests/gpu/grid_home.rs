//! Grids homed on the GPU as the CPU knows them: how old, how exact, and behind a device that is late.

use std::collections::VecDeque;

use glam::{Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, Consumers, Follow, GridDesc, GridHome, GridId, Hull, OpenWater,
    OpenWaterError, Scheme, WaterSample,
};

use open_water_shaders::pipeline::{Injected, inject};

use crate::context::Context;
use crate::surface::{DT, Scene, calm, view};

/// A float that is dropped, in a grid that follows it.
pub(crate) fn dropped(context: Option<&Context>, home: GridHome, scheme: Scheme) -> (Scene, GridId) {
    let water = match context {
        Some(context) => OpenWater::new(&context.device, &context.queue, calm()).unwrap(),
        None => OpenWater::headless(calm()).unwrap(),
    };
    let mut scene = Scene { water, store: BodyStates::default(), boat: BodyId::default(), floats: Vec::new() };
    let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
    scene.boat = scene.water.add_body(BodyDesc::from_hull(&hull, 500.0)).unwrap();
    let follow = Follow::Body(scene.boat);
    let desc = GridDesc {
        follow,
        home,
        cells: [96; 2],
        border: Border::Absorbing { width: 8 },
        scheme,
        ..GridDesc::default()
    };
    let grid = scene.water.add_grid(desc).unwrap();
    scene.store.insert(scene.boat, BodyState::at_rest(Vec3::new(0.0, 0.8, 0.0)));
    (scene, grid)
}

pub(crate) fn places() -> Vec<Vec2> {
    (0..400).map(|i| Vec2::from_angle(i as f32 * 2.399_963) * 0.25 * (i as f32).sqrt()).collect()
}

pub(crate) fn sampled(water: &OpenWater, places: &[Vec2]) -> Vec<WaterSample> {
    let mut out = vec![WaterSample::default(); places.len()];
    water.sample(places, &mut out);
    out
}

/// A frame whose commands wait with those before it.
fn record(scene: &mut Scene, context: &Context, waiting: &mut VecDeque<wgpu::CommandBuffer>) {
    for tick in scene.water.advance(DT) {
        scene.water.tick(tick, &mut scene.store).unwrap();
    }
    let plan = scene.water.plan(&view(), Consumers::empty());
    let mut encoder = context.device.create_command_encoder(&Default::default());
    scene.water.encode(&plan, &mut encoder);
    waiting.push_back(encoder.finish());
}

fn rms(values: impl Iterator<Item = f32> + Clone) -> f32 {
    let count = values.clone().count() as f32;
    (values.map(|v| v * v).sum::<f32>() / count).sqrt()
}

#[test]
fn a_late_device_makes_answers_older_and_carried_on() {
    let context = Context::new();
    let points = places();
    for scheme in [Scheme::NinePoint, Scheme::Dispersive] {
        for late in 1..=4usize {
            let (mut far, grid) = dropped(Some(&context), GridHome::Gpu, scheme);
            let (mut near, _) = dropped(None, GridHome::Cpu, scheme);
            let mut waiting = VecDeque::new();
            let mut past: VecDeque<Vec<WaterSample>> = VecDeque::new();
            let mut errors = [0.0f32; 5];
            for frame in 0..80 {
                record(&mut far, &context, &mut waiting);
                near.frame(None, DT, Consumers::empty());
                past.push_front(sampled(&near.water, &points));
                let found = sampled(&far.water, &points);
                if frame > 35 {
                    // Whatever the device does, each frame's copy arrives.
                    assert_eq!(far.water.grid_age(grid).unwrap(), Some(late as u64), "{scheme:?}");
                    for (i, found) in found.iter().enumerate() {
                        assert!((found.age - late as f32 * DT).abs() < 1e-6 && found.error.is_finite());
                        let (truth, stale) = (past[0][i], past[late][i]);
                        let rates = found.velocity.y - truth.velocity.y;
                        let heights = [found.height - truth.height, stale.height - truth.height];
                        let all = [heights[0], heights[1], found.error, rates, truth.velocity.y];
                        errors.iter_mut().zip(all).for_each(|(sum, error)| *sum += error * error);
                    }
                }
                if waiting.len() >= late {
                    context.queue.submit(waiting.pop_front());
                    context.wait();
                }
            }
            context.queue.submit(waiting);
            let [carried, stale, expected, rates, moving] = errors.map(f32::sqrt);
            assert!(rates < (0.3 + 0.2 * late as f32) * moving, "{scheme:?}, {late}: {rates} of {moving}");
            assert!(
                carried < if late < 4 { 0.25 } else { 0.4 } * stale,
                "{scheme:?}, {late} frames: {carried} of {stale}"
            );
            assert!((0.5..2.0).contains(&(expected / carried)), "{scheme:?}, {late}: {expected} for {carried}");
        }
    }
}

#[test]
fn a_device_that_stalls_holds_up_nothing() {
    let context = Context::new();
    let (mut scene, grid) = dropped(Some(&context), GridHome::Gpu, Scheme::NinePoint);
    let points = places();
    let mut waiting = VecDeque::new();
    let mut last = 0;
    for frame in 0..160 {
        record(&mut scene, &context, &mut waiting);
        let found = sampled(&scene.water, &points);
        assert!(found.iter().all(|s| s.height.abs() < 1.0 && s.velocity.is_finite() && !s.error.is_nan()), "{frame}");
        let age = scene.water.grid_age(grid).unwrap();
        if (80..120).contains(&frame) {
            // Nothing is submitted: answers get older, tick by tick, up to what they were last.
            assert!(frame == 80 || age == Some(last + 1), "{frame}: {age:?}");
        } else {
            context.queue.submit(waiting.drain(..));
            context.wait();
            assert!(frame < 30 || (120..122).contains(&frame) || age == Some(1), "{frame}: {age:?}");
        }
        last = age.unwrap_or(0);
        if frame == 119 {
            let moving = rms(found.iter().map(|s| s.velocity.y));
            assert_eq!(moving, 0.0, "what is half a second old is not carried on");
        }
    }
    assert!(scene.water.reports().behind > 0);
}

#[test]
fn a_grid_changes_its_home_without_a_step() {
    let context = Context::new();
    let points = places();
    for (scheme, homes) in [
        (Scheme::Dispersive, [GridHome::Cpu, GridHome::Gpu]),
        (Scheme::Dispersive, [GridHome::Gpu, GridHome::Cpu]),
        (Scheme::NinePoint, [GridHome::Cpu, GridHome::Gpu]),
    ] {
        let (mut scene, grid) = dropped(Some(&context), homes[0], scheme);
        let (mut twin, _) = dropped(None, GridHome::Cpu, scheme);
        let mut worst = 0.0f32;
        let mut largest = 0.0f32;
        for frame in 0..110 {
            if frame == 40 {
                scene.water.set_grid_home(grid, homes[1]).unwrap();
                scene.water.set_grid_home(grid, homes[1]).unwrap();
                assert_eq!(scene.water.grid_count(), 1);
            }
            scene.frame(None, DT, Consumers::empty());
            twin.frame(None, DT, Consumers::empty());
            // The twin answers for the last tick.
            let mut plan = scene.water.plan(&view(), Consumers::empty());
            plan.alpha = 1.0;
            context.submit(|encoder| scene.water.encode(&plan, encoder));
            if (36..50).contains(&frame) || frame % 12 == 0 {
                let drawn = crate::surface::probe(&context, &scene.water, &points);
                for (drawn, truth) in drawn.iter().zip(sampled(&twin.water, &points)) {
                    worst = worst.max((drawn[0] - truth.height).abs());
                    largest = largest.max(truth.height.abs());
                }
            }
        }
        assert!(largest > 0.01, "{largest}");
        assert!(worst < 1e-3, "{scheme:?} {homes:?}: {worst} of {largest}");
        assert_eq!(scene.water.grid(grid).unwrap().is_some(), homes[1] == GridHome::Cpu);
        // Both bodies moved alike.
        let [a, b] = [&scene, &twin].map(|scene| scene.store.get(scene.boat).unwrap().position);
        assert!(a.distance(b) < 1e-3, "{a} {b}");
        scene.water.remove_grid(grid).unwrap();
    }
}

#[test]
fn a_home_that_cannot_be_is_refused() {
    let context = Context::new();
    let (mut scene, grid) = dropped(Some(&context), GridHome::Cpu, Scheme::NinePoint);
    let inner = GridDesc { within: Some(grid), cells: [64; 2], cell_size: [0.1; 2], ..near() };
    let inner = scene.water.add_grid(inner).unwrap();
    let spectral = scene.water.add_grid(GridDesc { scheme: Scheme::Spectral, ..near() }).unwrap();
    let walled = scene.water.add_grid(GridDesc { border: Border::Reflecting, ..near() }).unwrap();
    let count = scene.water.grid_count();
    for id in [grid, inner, spectral, walled] {
        assert!(scene.water.set_grid_home(id, GridHome::Gpu).is_err());
        assert!(scene.water.grid(id).unwrap().is_some());
    }
    assert_eq!(scene.water.grid_count(), count);
    let (mut headless, grid) = dropped(None, GridHome::Cpu, Scheme::NinePoint);
    assert!(matches!(headless.water.set_grid_home(grid, GridHome::Gpu), Err(OpenWaterError::NoGpu)));
    assert!(headless.water.set_grid_home(GridId::default(), GridHome::Gpu).is_err());
}

fn near() -> GridDesc {
    GridDesc {
        follow: Follow::Point,
        cells: [96; 2],
        border: Border::Absorbing { width: 8 },
        scheme: Scheme::NinePoint,
        ..GridDesc::default()
    }
}

#[test]
fn pipelines_that_were_compiled_beside_are_used() {
    let context = Context::new();
    let (mut scene, grid) = dropped(Some(&context), GridHome::Cpu, Scheme::Dispersive);
    for asked in 0.. {
        if scene.water.prepare_gpu_grids() {
            break;
        }
        assert!(asked < 10_000);
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    for shader in ["grid_step", "grid_water_step"] {
        // Were anything compiled in the call, it would be refused.
        inject(Some(Injected::Shader(shader)));
        let moved = scene.water.set_grid_home(grid, GridHome::Gpu);
        inject(None);
        moved.unwrap();
        scene.frame(Some(&context), DT, Consumers::empty());
        scene.water.set_grid_home(grid, GridHome::Cpu).unwrap();
    }
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

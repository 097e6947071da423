//! The façade on a device: the composite surface against its CPU twin, and what a frame runs.

mod dry;
mod fade;
mod include;
mod land;
mod rebase;
mod restore;
mod uploads;

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Border, Consumers, Controls, Encoded, Follow, FramePlan, GridDesc,
    GridHome, Hull, OpenWater, OpenWaterDesc, Preset, Reason, Scheme, SkippedWork, View, WaterSample, Work,
};
use open_water_shaders::pipeline::{Slot, bind_group, compute_pipeline, group_layout};
use open_water_shaders::surface;

use crate::context::Context;

pub(crate) const DT: f32 = 1.0 / 60.0;
const SENTINEL: f32 = -12345.0;

pub(crate) fn view() -> [View; 1] {
    [View { eye: Vec3::new(0.0, 5.0, 0.0), pixel_angle: 1e-3 }]
}

pub(crate) fn calm() -> OpenWaterDesc {
    let mut desc = Preset::Low.water();
    desc.sea.partitions.clear();
    desc
}

pub(crate) struct Scene {
    pub(crate) water: OpenWater,
    pub(crate) store: BodyStates,
    pub(crate) boat: BodyId,
    pub(crate) floats: Vec<BodyId>,
}

/// A boat with its grid and a few floats.
pub(crate) fn scene(context: Option<&Context>, desc: OpenWaterDesc) -> Scene {
    let mut water = match context {
        Some(c) => OpenWater::new(&c.device, &c.queue, desc).unwrap(),
        None => OpenWater::headless(desc).unwrap(),
    };
    let mut store = BodyStates::default();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0)).unwrap();
    store.insert(boat, water.body(boat).unwrap().state());
    water.set_controls(boat, Controls { throttle: 0.8, steering: 0.5, ..Controls::default() }).unwrap();
    water
        .add_grid(GridDesc {
            follow: Follow::Body(boat),
            cells: [128; 2],
            border: Border::Absorbing { width: 8 },
            ..GridDesc::default()
        })
        .unwrap();
    let float = Hull::cuboid(Vec3::splat(0.6)).unwrap();
    let floats = (0..8).map(|i| {
        let id = water.add_body(BodyDesc::from_hull(&float, 100.0)).unwrap();
        let at = Vec3::new(i as f32 * 1.5 - 4.0, 0.0, 3.0);
        store.insert(id, BodyState::at_rest(at));
        id
    });
    let floats = floats.collect();
    Scene { water, store, boat, floats }
}

impl Scene {
    pub(crate) fn states(&self) -> Vec<BodyState> {
        [&self.boat].into_iter().chain(&self.floats).filter_map(|id| self.store.get(*id).copied()).collect()
    }

    pub(crate) fn frame(&mut self, context: Option<&Context>, dt: f32, consumers: Consumers) -> FramePlan {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.store).unwrap();
        }
        let plan = self.water.plan(&view(), consumers);
        if let Some(c) = context {
            c.submit(|encoder| self.water.encode(&plan, encoder));
        }
        plan
    }
}

/// `surface_at` of the device at these points: height and normal.
pub(crate) fn probe(context: &Context, water: &OpenWater, points: &[Vec2]) -> Vec<[f32; 4]> {
    probe_group(context, water.surface_layout().unwrap(), water.surface_bind_group().unwrap(), points)
}

fn probe_group(
    context: &Context,
    surface_layout: &wgpu::BindGroupLayout,
    surface_group: &wgpu::BindGroup,
    points: &[Vec2],
) -> Vec<[f32; 4]> {
    let device = &context.device;
    let pass = &surface::PASSES[0];
    let layout = group_layout(device, "probe", wgpu::ShaderStages::COMPUTE, &[Slot::Read, Slot::ReadWrite]);
    let pipeline = compute_pipeline(device, pass, "surface_probe", &[surface_layout, &layout], &[]);
    let input = context.buffer(points);
    let output = context.buffer(&vec![[SENTINEL; 4]; points.len()]);
    let group = bind_group(device, "probe", &layout, &[input.as_entire_binding(), output.as_entire_binding()]);
    context.submit(|encoder| {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, surface_group, &[]);
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
    });
    context.read(&output)
}

pub(crate) fn points(around: Vec3) -> Vec<Vec2> {
    // The golden ratio's spiral: spread evenly, on no lattice.
    let spiral = |i: u32| Vec2::from_angle(i as f32 * 2.399_963) * 0.4 * (i as f32).sqrt();
    (0..10_000).map(|i| Vec2::new(around.x, around.z) + spiral(i)).collect()
}

#[test]
fn surface_at_is_the_same_on_both_sides() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    for _ in 0..90 {
        scene.frame(None, DT, Consumers::NORMALS);
    }
    // The CPU answers for the last tick, so draw just that moment.
    let mut plan = scene.water.plan(&view(), Consumers::NORMALS);
    (plan.time, plan.alpha) = (scene.water.time(), 1.0);
    context.submit(|encoder| scene.water.encode(&plan, encoder));
    let points = points(scene.store.get(scene.boat).unwrap().position);
    let found = probe(&context, &scene.water, &points);
    let mut expected = vec![WaterSample::default(); points.len()];
    scene.water.sample(&points, &mut expected);
    let bound = (1e-3 * scene.water.ocean().unwrap().significant_height()).max(1e-3);
    let mut waves = 0.0f32;
    for ((point, f), e) in points.iter().zip(&found).zip(&expected) {
        assert!((f[0] - e.height).abs() <= bound, "{point}: {f:?} against {e:?}");
        assert!(e.folded || Vec3::new(f[1], f[2], f[3]).dot(e.normal) > 0.9999, "{point}: {f:?} against {e:?}");
        waves = waves.max(e.height.abs());
    }
    assert!(waves > 0.2, "the sea is flat: {waves} m");
    assert!(context.take_errors().is_empty());
}

#[test]
fn drawing_does_not_change_the_bodies() {
    let context = Context::new();
    let mut drawn = scene(Some(&context), Preset::Low.water());
    let mut alone = scene(None, Preset::Low.water());
    for _ in 0..45 {
        drawn.frame(Some(&context), DT, Consumers::NORMALS | Consumers::FOAM);
        alone.frame(None, DT, Consumers::empty());
    }
    assert_eq!(drawn.store.get(drawn.boat), alone.store.get(alone.boat));
}

#[test]
fn an_empty_scene_runs_nothing() {
    let context = Context::new();
    let mut water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
    let mut store = BodyStates::default();
    for _ in 0..3 {
        for tick in water.advance(DT) {
            water.tick(tick, &mut store).unwrap();
        }
        let plan = water.plan(&view(), Consumers::NORMALS | Consumers::FOAM);
        assert_eq!((plan.work.len(), plan.dispatches(), plan.upload_bytes()), (0, 0, 0), "{plan}");
        assert_eq!(plan.skipped[0].reason, Reason::Calm);
        context.submit(|encoder| water.encode(&plan, encoder));
        assert_eq!(water.encoded(), Encoded::default());
    }
    let found = probe(&context, &water, &[Vec2::ZERO, Vec2::new(1e4, -3.0)]);
    assert!(found.iter().all(|f| f[..2] == [0.0, 0.0] && f[2] == 1.0), "{found:?}");
}

#[test]
fn what_nobody_reads_is_not_run() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    let plan = scene.frame(Some(&context), DT, Consumers::empty());
    assert!(plan.work.contains(&Work::Ocean { cascades: 3 }), "{plan}");
    assert!(plan.skipped.iter().any(|s| s.work == SkippedWork::OceanLooks && s.reason == Reason::NotAskedFor));
    // Paused: the same moment is not made again.
    let plan = scene.frame(Some(&context), 0.0, Consumers::empty());
    assert_eq!(plan.dispatches() + plan.work.len() as u32, 0, "{plan}");
    let plan = scene.water.plan(&[], Consumers::empty());
    assert!(plan.work.is_empty() && plan.skipped.iter().all(|s| s.reason == Reason::NobodyLooks), "{plan}");
}

#[test]
fn a_grid_that_sleeps_is_neither_sent_nor_listed() {
    let context = Context::new();
    let mut water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
    let grid = GridDesc {
        follow: Follow::Fixed(DVec2::ZERO),
        cells: [64; 2],
        border: Border::Absorbing { width: 8 },
        ..GridDesc::default()
    };
    water.add_grid(grid).unwrap();
    for tick in water.advance(DT) {
        water.tick(tick, &mut BodyStates::default()).unwrap();
    }
    let plan = water.plan(&view(), Consumers::NORMALS);
    assert!(plan.work.is_empty(), "{plan}");
    assert!(plan.skipped.iter().any(|s| s.reason == Reason::Asleep), "{plan}");
    assert!(context.take_errors().is_empty());
}

#[test]
fn wild_frames_leave_no_validation_error() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    let all = Consumers::NORMALS | Consumers::FOAM;
    for (i, dt) in [DT, 5.0, f32::NAN, 0.3 * DT, -1.0, 2.5 * DT].into_iter().enumerate() {
        scene.frame(Some(&context), dt, all);
        if i == 2 {
            let mut state = *scene.store.get(scene.boat).unwrap();
            state.position += Vec3::new(3_000.0, 0.0, -2_000.0);
            scene.store.insert(scene.boat, state);
            let extra = GridDesc { cells: [96, 64], border: Border::Absorbing { width: 8 }, ..GridDesc::default() };
            scene.water.add_grid(extra).unwrap();
        }
    }
    let around = scene.store.get(scene.boat).unwrap().position;
    assert!(around.is_finite());
    let found = probe(&context, &scene.water, &points(around)[..500]);
    assert!(found.iter().flatten().all(|v| v.is_finite() && *v != SENTINEL));
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn a_grid_homed_on_the_gpu_comes_back_with_its_age() {
    let context = Context::new();
    let run = |home: GridHome| {
        let water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
        let mut scene = Scene { water, store: BodyStates::default(), boat: BodyId::default(), floats: Vec::new() };
        let hull = Hull::cuboid(Vec3::splat(1.0)).unwrap();
        let dropped = scene.water.add_body(BodyDesc::from_hull(&hull, 500.0)).unwrap();
        let follow = Follow::Body(dropped);
        let (border, scheme) = (Border::Absorbing { width: 8 }, Scheme::NinePoint);
        let desc = GridDesc { follow, home, cells: [96; 2], border, scheme, ..GridDesc::default() };
        let grid = scene.water.add_grid(desc).unwrap();
        scene.store.insert(dropped, BodyState::at_rest(Vec3::new(0.0, 0.8, 0.0)));
        for _ in 0..40 {
            scene.frame(Some(&context), DT, Consumers::empty());
        }
        let age = scene.water.grid_age(grid).unwrap();
        scene.frame(None, DT, Consumers::empty());
        let mut plan = scene.water.plan(&view(), Consumers::empty());
        plan.alpha = 1.0;
        context.submit(|encoder| scene.water.encode(&plan, encoder));
        let points: Vec<Vec2> = (0..200).map(|i| Vec2::from_angle(i as f32) * (0.6 + 0.015 * i as f32)).collect();
        let drawn: Vec<f32> = probe(&context, &scene.water, &points).iter().map(|f| f[0]).collect();
        // Lets the last copy arrive.
        for tick in scene.water.advance(DT) {
            scene.water.tick(tick, &mut scene.store).unwrap();
        }
        let mut sampled = vec![WaterSample::default(); points.len()];
        scene.water.sample(&points, &mut sampled);
        scene.water.remove_grid(grid).unwrap();
        scene.frame(Some(&context), DT, Consumers::empty());
        (age, drawn, sampled.iter().map(|s| s.height).collect::<Vec<_>>())
    };
    let rms =
        |a: &[f32], b: &[f32]| (a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f32>() / a.len() as f32).sqrt();
    let (age, on_cpu, truth) = run(GridHome::Cpu);
    assert_eq!(age, Some(0));
    let (age, on_gpu, back) = run(GridHome::Gpu);
    assert!(matches!(age, Some(1..=4)), "{age:?}");
    let size = rms(&on_cpu, &vec![0.0; on_cpu.len()]);
    assert!(size > 0.002, "no waves: {size} m");
    // The float does not feel its own waves, so it moves alike and makes the same ones.
    assert!(rms(&on_gpu, &on_cpu) < 1e-3 * size, "{} of {size}", rms(&on_gpu, &on_cpu));
    // Carried on over a tick.
    assert!(rms(&back, &truth) < 0.02 * size, "{} of {size}", rms(&back, &truth));
}

//! The rules by which a frame leaves work out: what is drawn with each against what is drawn without, and plans that are old.

mod exact;
mod seen;

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    Border, Consumers, Follow, FramePlan, GridDesc, GridHome, OpenWater, Preset, Reason, Rules, SkippedWork, View, Work,
};
use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};
use open_water_shaders::surface;

use crate::context::Context;
use crate::surface::{DT, Scene, probe, scene};

const ALL: Consumers = Consumers::all();

fn high(eye: Vec3) -> [View; 1] {
    [View { eye, pixel_angle: 1e-3 }]
}

/// Points on no lattice within some metres of the origin.
fn points(reach: f32) -> Vec<Vec2> {
    (0..4000).map(|i| Vec2::from_angle(i as f32 * 2.399_963) * reach * (i as f32 / 4000.0).sqrt()).collect()
}

fn tick(scene: &mut Scene, frames: usize) {
    for _ in 0..frames {
        for tick in scene.water.advance(DT) {
            scene.water.tick(tick, &mut scene.store).unwrap();
        }
    }
}

/// Draws for these views by these rules; the dispatches of the plan are those that are recorded.
fn draw(context: &Context, water: &mut OpenWater, rules: Rules, views: &[View], consumers: Consumers) -> FramePlan {
    water.set_rules(rules);
    let plan = water.plan(views, consumers);
    context.submit(|encoder| water.encode(&plan, encoder));
    assert_eq!(water.encoded().dispatches, plan.dispatches(), "{plan}");
    plan
}

fn skips(plan: &FramePlan, work: SkippedWork, reason: Reason) -> bool {
    plan.skipped.iter().any(|skipped| (skipped.work, skipped.reason) == (work, reason))
}

/// What `surface_vertex` and `surface_shading` answer for a pixel of that width: place, roughness, normal, foam.
fn looks(context: &Context, water: &OpenWater, points: &[Vec2], pixel: f32) -> Vec<[f32; 8]> {
    const SHADER: &str = "
        override PIXEL: f32;
        @group(1) @binding(0) var<storage, read> points: array<vec2<f32>>;
        @group(1) @binding(1) var<storage, read_write> answers: array<vec4<f32>>;
        @compute @workgroup_size(64) fn ask(@builtin(global_invocation_id) id: vec3<u32>) {
            if id.x < arrayLength(&points) {
                let look = surface_shading(points[id.x], PIXEL);
                answers[2u * id.x] = vec4<f32>(surface_vertex(points[id.x], PIXEL), look.roughness);
                answers[2u * id.x + 1u] = vec4<f32>(look.normal, look.foam);
            }
        }";
    let device = &context.device;
    let own = group_layout(device, "looks", wgpu::ShaderStages::COMPUTE, &[Slot::Read, Slot::ReadWrite]);
    let layout = pipeline_layout(device, "looks", &[water.surface_layout().unwrap(), &own]);
    let source = wgpu::ShaderSource::Wgsl((surface::wgsl(0) + SHADER).into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let constants = [("PIXEL", f64::from(pixel))];
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&layout),
        module: &module,
        entry_point: Some("ask"),
        compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
        cache: None,
    });
    let (input, output) = (context.buffer(points), context.buffer(&vec![[f32::NAN; 8]; points.len()]));
    let group = bind_group(device, "looks", &own, &[input.as_entire_binding(), output.as_entire_binding()]);
    context.submit(|encoder| {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, water.surface_bind_group().unwrap(), &[]);
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
    });
    context.read(&output)
}

/// Largest and rms difference of heights.
fn apart(found: &[[f32; 4]], expected: &[[f32; 4]]) -> (f32, f32) {
    let all = || found.iter().zip(expected).map(|(a, b)| (a[0] - b[0]).abs());
    (all().fold(0.0, f32::max), (all().map(|d| d * d).sum::<f32>() / found.len() as f32).sqrt())
}

fn small_grid(home: GridHome, at: DVec2) -> GridDesc {
    let border = Border::Absorbing { width: 8 };
    GridDesc { follow: Follow::Fixed(at), home, cells: [64; 2], border, ..GridDesc::default() }
}

/// A scene with a grid on the device, too.
fn both_homes(context: &Context) -> Scene {
    let mut scene = scene(Some(context), Preset::Low.water());
    let follow = Follow::Body(scene.floats[0]);
    scene.water.add_grid(GridDesc { follow, ..small_grid(GridHome::Gpu, DVec2::ZERO) }).unwrap();
    scene
}

#[test]
fn what_is_planned_is_what_is_recorded() {
    let context = Context::new();
    let mut scene = both_homes(&context);
    let eyes = [5.0, 400.0, 900.0, 2_000.0, 50_000.0, f32::NAN].map(|y| high(Vec3::new(0.0, y, 0.0)));
    let (mut dispatches, mut steps) = (Vec::new(), 0);
    for (i, consumers) in [Consumers::empty(), ALL, Consumers::NORMALS].into_iter().cycle().take(12).enumerate() {
        tick(&mut scene, 1 + i % 2);
        let rules = if i % 3 == 0 { Rules::empty() } else { Rules::all() };
        let views: &[View] = if i == 4 { &[] } else { &eyes[i % 6] };
        let plan = draw(&context, &mut scene.water, rules, views, consumers);
        dispatches.push(plan.dispatches());
        steps += usize::from(plan.work.iter().any(|work| matches!(work, Work::GridSteps { .. })));
    }
    dispatches.sort_unstable();
    dispatches.dedup();
    assert!(dispatches.len() >= 3 && steps >= 6, "all frames are alike: {dispatches:?}, {steps} with steps");
    assert!(context.take_errors().is_empty());
}

#[test]
fn an_old_plan_does_no_harm() {
    let context = Context::new();
    let mut scene = both_homes(&context);
    let extra = scene.water.add_grid(small_grid(GridHome::Cpu, DVec2::splat(9.0))).unwrap();
    let remote = scene.water.add_grid(small_grid(GridHome::Gpu, DVec2::splat(-9.0))).unwrap();
    tick(&mut scene, 30);
    scene.water.set_rules(Rules::empty());
    let old = scene.water.plan(&high(Vec3::Y * 5.0), ALL);
    scene.water.remove_grid(extra).unwrap();
    scene.water.remove_grid(remote).unwrap();
    scene.water.remove_body(scene.boat).unwrap();
    tick(&mut scene, 90);
    scene.water.add_grid(small_grid(GridHome::Cpu, DVec2::splat(20.0))).unwrap();
    for plan in [&old, &old] {
        context.submit(|encoder| scene.water.encode(plan, encoder));
    }
    // Of other cascades, and by nobody's hand.
    let mut wild = old.clone();
    (wild.time, wild.alpha, wild.tick) = (f64::NAN, f32::NAN, 1 << 40);
    scene.water.set_cascades(Preset::High.water().cascades, 0.1).unwrap();
    tick(&mut scene, 60);
    for plan in [&wild, &old] {
        context.submit(|encoder| scene.water.encode(plan, encoder));
        assert!(probe(&context, &scene.water, &points(30.0)).iter().flatten().all(|v| v.is_finite()));
    }
    scene.water.set_rules(Rules::all());
    let (new, before) = (scene.water.plan(&high(Vec3::Y * 5.0), ALL), old.time);
    assert!(new.time > before && new.work.len() >= 3, "{new}");
    assert!(context.take_errors().is_empty());
}

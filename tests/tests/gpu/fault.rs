//! Devices that are lost, full, too small or wrong: errors as values, and the water goes on.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    Border, Consumers, DepthMap, Follow, GridDesc, GridHome, Land, OpenWater, OpenWaterDesc, OpenWaterError, Preset,
    Reason, Scheme, View, WakesDesc, WaterSample,
};
use open_water_shaders::pipeline::{Injected, inject};

use crate::context::Context;
use crate::surface::{DT, Scene, points, probe, scene, view};

const ALL: Consumers = Consumers::all();

/// A grid on the device, far from everything.
fn remote() -> GridDesc {
    GridDesc {
        follow: Follow::Point,
        home: GridHome::Gpu,
        cells: [64; 2],
        border: Border::Absorbing { width: 8 },
        scheme: Scheme::NinePoint,
        ..GridDesc::default()
    }
}

fn land(size: [u32; 2]) -> Land {
    let bed = DepthMap::new(DVec2::splat(4000.0), 4.0, size, vec![-12.0; (size[0] * size[1]) as usize]);
    Land::new(bed.unwrap())
}

/// A frame on a device that may be lost.
fn frame(scene: &mut Scene, context: &Context) {
    for tick in scene.water.advance(DT) {
        scene.water.tick(tick, &mut scene.store).unwrap();
    }
    let plan = scene.water.plan(&view(), ALL);
    let mut encoder = context.device.create_command_encoder(&Default::default());
    scene.water.encode(&plan, &mut encoder);
    context.queue.submit([encoder.finish()]);
    let _ = context.device.poll(wgpu::PollType::wait_indefinitely());
}

#[test]
fn a_lost_device_is_replaced_and_nothing_of_the_cpu_is_lost() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    let mut twin = crate::surface::scene(None, Preset::Low.water());
    scene.water.set_land(Some(land([16; 2]))).unwrap();
    twin.water.set_land(Some(land([16; 2]))).unwrap();
    let far = scene.water.add_grid(remote()).unwrap();
    for _ in 0..20 {
        frame(&mut scene, &context);
        twin.frame(None, DT, ALL);
    }
    assert!(!scene.water.is_device_lost());
    context.device.destroy();
    let _ = context.device.poll(wgpu::PollType::wait_indefinitely());
    for i in 0..100 {
        frame(&mut scene, &context);
        twin.frame(None, DT, ALL);
        if i == 10 {
            // What needs no device goes on.
            let extra = GridDesc { home: GridHome::Cpu, ..remote() };
            assert!(matches!(scene.water.add_grid(remote()), Err(OpenWaterError::DeviceLost)));
            for water in [&mut scene.water, &mut twin.water] {
                let id = water.add_grid(extra.clone()).unwrap();
                water.set_land(Some(land([24; 2]))).unwrap();
                water.remove_grid(id).unwrap();
            }
        }
    }
    assert!(scene.water.is_device_lost());
    let plan = scene.water.plan(&view(), ALL);
    assert!(plan.work.is_empty() && plan.dispatches() == 0, "{plan}");
    assert!(plan.skipped.iter().all(|skipped| skipped.reason == Reason::DeviceLost), "{plan}");
    assert_eq!(scene.store.get(scene.boat), twin.store.get(twin.boat));

    let other = Context::new();
    let loss = scene.water.replace_device(&other.device, &other.queue).unwrap();
    assert_eq!((loss.calmed.as_slice(), loss.foam), ([far].as_slice(), true));
    assert!(!scene.water.is_device_lost());
    // From here on it is as if it had never been on another device.
    let third = Context::new();
    let twin_loss = twin.water.replace_device(&third.device, &third.queue).unwrap();
    assert_eq!((twin_loss.calmed.len(), twin_loss.foam), (0, false));
    frame(&mut scene, &other);
    frame(&mut twin, &third);
    let around = scene.store.get(scene.boat).unwrap().position;
    let points = points(around);
    let (found, fresh) = (probe(&other, &scene.water, &points), probe(&third, &twin.water, &points));
    assert_eq!(found, fresh);
    assert!(found.iter().any(|f| f[0].abs() > 0.05), "the sea is flat");
    let mut sampled = vec![WaterSample::default(); 1];
    scene.water.sample(&[Vec2::new(around.x, around.z)], &mut sampled);
    assert!(sampled[0].height.is_finite());
    for context in [&context, &other, &third] {
        assert_eq!(context.take_errors(), Vec::<String>::new());
    }
}

#[test]
fn a_host_may_say_so_itself() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    scene.water.lose_device();
    let plan = scene.frame(Some(&context), DT, ALL);
    assert!(plan.work.is_empty() && plan.to_string().contains("the device is lost"), "{plan}");
    // The same device will do, if it is there after all.
    scene.water.replace_device(&context.device, &context.queue).unwrap();
    assert!(!scene.frame(Some(&context), DT, ALL).work.is_empty());
}

#[test]
fn a_full_device_refuses_and_the_water_stays_as_it_was() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    scene.frame(Some(&context), DT, ALL);
    let full = |result: Result<(), OpenWaterError>| {
        assert!(
            matches!(&result, Err(error @ OpenWaterError::OutOfMemory { .. }) if error.to_string().contains("fewer"))
        );
    };
    let grids = scene.water.grid_count();
    inject(Some(Injected::OutOfMemory));
    full(OpenWater::new(&context.device, &context.queue, Preset::Low.water()).map(|_| ()));
    full(scene.water.add_grid(remote()).map(|_| ()));
    full(scene.water.add_grid(GridDesc { home: GridHome::Cpu, ..remote() }).map(|_| ()));
    full(scene.water.set_land(Some(land([16; 2]))));
    full(scene.water.replace_device(&context.device, &context.queue).map(|_| ()));
    inject(None);
    assert_eq!(scene.water.grid_count(), grids);
    assert!(scene.water.land().is_none() && !scene.water.is_device_lost());
    let plan = scene.frame(Some(&context), DT, ALL);
    assert!(!plan.work.is_empty(), "{plan}");
    // With memory, all of it is there again.
    scene.water.add_grid(remote()).unwrap();
    scene.water.set_land(Some(land([16; 2]))).unwrap();
    scene.frame(Some(&context), DT, ALL);
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn a_device_without_memory_says_so() {
    let Some(context) = Context::starved() else { return };
    let result = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).map(|_| ());
    assert!(matches!(result, Err(OpenWaterError::OutOfMemory { .. })), "{result:?}");
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn a_shader_that_does_not_compile_is_named() {
    let context = Context::new();
    let named = |error: OpenWaterError, name: &str| {
        let text = error.to_string();
        assert!(matches!(error, OpenWaterError::Device { .. }), "{name}: {text}");
        assert!(text.contains(name) && text.contains("no_such_name") && text.contains("headless"), "{name}: {text}");
    };
    for name in ["ocean_looks", "ocean_mips"] {
        inject(Some(Injected::Shader(name)));
        let broken = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).map(|_| ());
        inject(None);
        named(broken.unwrap_err(), name);
    }
    let mut water = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).unwrap();
    let waves = ["grid_medium", "grid_schedule", "grid_prepare", "grid_step", "grid_draw"];
    let dispersive = ["grid_water_medium", "grid_water_prepare", "grid_water_step"];
    for (scheme, names) in [(Scheme::NinePoint, &waves[..]), (Scheme::Dispersive, &dispersive)] {
        let grid = GridDesc { scheme, ..remote() };
        for name in names {
            inject(Some(Injected::Shader(name)));
            let broken = water.add_grid(grid.clone()).map(|_| ());
            inject(None);
            named(broken.unwrap_err(), name);
            assert_eq!(water.grid_count(), usize::from(scheme == Scheme::Dispersive));
        }
        water.add_grid(grid).unwrap();
    }
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

/// A water that uses everything there is.
fn everything(context: &Context) -> Scene {
    let mut scene = scene(Some(context), Preset::Low.water());
    let drop = open_water::Hull::cuboid(Vec3::splat(1.0)).unwrap();
    for scheme in [Scheme::NinePoint, Scheme::FivePoint, Scheme::Dispersive] {
        let id = scene.water.add_body(open_water::BodyDesc::from_hull(&drop, 500.0)).unwrap();
        scene.store.insert(id, open_water::BodyState::at_rest(Vec3::new(30.0, 1.0, 20.0)));
        let wave_speed = if scheme == Scheme::FivePoint { 5.0 } else { 6.2 };
        let follow = Follow::Body(id);
        scene.water.add_grid(GridDesc { follow, scheme, wave_speed, ..remote() }).unwrap();
    }
    scene.water.set_land(Some(land([16; 2]))).unwrap();
    scene
}

#[test]
fn the_least_limits_do() {
    let context = Context::with_limits(OpenWater::least_limits());
    let mut scene = everything(&context);
    for _ in 0..8 {
        scene.frame(Some(&context), DT, ALL);
    }
    let sea = open_water::SeaState::height_period(1.0, 6.0, 1.0);
    scene.water.change_sea(sea, 0.1).unwrap();
    for _ in 0..60 {
        scene.frame(Some(&context), DT, ALL);
    }
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn less_than_the_least_limits_is_refused_by_name() {
    let refused = |limits: wgpu::Limits| {
        let context = Context::with_limits(limits);
        let error = OpenWater::new(&context.device, &context.queue, Preset::Low.water()).map(|_| ()).unwrap_err();
        assert_eq!(context.take_errors(), Vec::<String>::new());
        let text = error.to_string();
        assert!(text.contains("required_limits") && text.contains("headless"), "{text}");
        match error {
            OpenWaterError::DeviceLimit { limit, found, needed } if found < needed => limit,
            _ => panic!("{text}"),
        }
    };
    macro_rules! each {
        ($($limit:ident)*) => {
            $(
                let mut limits = OpenWater::least_limits();
                limits.$limit -= 1;
                assert_eq!(refused(limits), stringify!($limit));
            )*
        };
    }
    each! {
        max_bind_groups max_bindings_per_bind_group max_dynamic_uniform_buffers_per_pipeline_layout
        max_uniform_buffers_per_shader_stage max_sampled_textures_per_shader_stage max_samplers_per_shader_stage
        max_storage_buffers_per_shader_stage max_buffers_and_acceleration_structures_per_shader_stage
        max_storage_textures_per_shader_stage max_uniform_buffer_binding_size max_storage_buffer_binding_size
        max_buffer_size max_compute_workgroup_storage_size max_compute_invocations_per_workgroup
        max_compute_workgroup_size_x max_compute_workgroup_size_y max_compute_workgroup_size_z
        max_compute_workgroups_per_dimension
    }
    assert_eq!(refused(wgpu::Limits::downlevel_defaults()), "max_storage_buffers_per_shader_stage");
    refused(wgpu::Limits::downlevel_webgl2_defaults());
}

#[test]
fn maps_and_pools_beyond_the_device_are_refused() {
    let context = Context::with_limits(wgpu::Limits { max_texture_dimension_2d: 512, ..OpenWater::least_limits() });
    let mut scene = scene(Some(&context), Preset::Low.water());
    let too_large = |result: Result<(), OpenWaterError>, name: &str| {
        assert!(matches!(&result, Err(OpenWaterError::DeviceLimit { limit, .. }) if *limit == name), "{result:?}");
    };
    too_large(scene.water.set_land(Some(land([513, 2]))), "max_texture_dimension_2d");
    assert!(scene.water.land().is_none());
    let wakes = WakesDesc { cells: 1 << 33, ..WakesDesc::default() };
    too_large(scene.water.set_wakes(Some(wakes)), "max_storage_buffer_binding_size");
    let desc = OpenWaterDesc { cascades: vec![open_water::CascadeDesc::new(1024, 400.0)], ..Preset::Low.water() };
    let result = OpenWater::new(&context.device, &context.queue, desc).map(|_| ());
    assert!(matches!(&result, Err(OpenWaterError::OceanGpu(_))), "{result:?}");
    scene.frame(Some(&context), DT, ALL);
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn wild_views_draw_nothing_wild() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    let wild = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e30];
    for a in wild {
        for tick in scene.water.advance(DT) {
            scene.water.tick(tick, &mut scene.store).unwrap();
        }
        let views = wild.map(|b| View { eye: Vec3::new(a, b, a), pixel_angle: b });
        let plan = scene.water.plan(&views, ALL);
        context.submit(|encoder| scene.water.encode(&plan, encoder));
    }
    let around = scene.store.get(scene.boat).unwrap().position;
    let found = probe(&context, &scene.water, &points(around)[..500]);
    assert!(found.iter().flatten().all(|v| v.is_finite()));
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

#[test]
fn quality_changes_on_the_device_while_it_draws() {
    let context = Context::new();
    let mut scene = scene(Some(&context), Preset::Low.water());
    for preset in [Preset::Medium, Preset::Low] {
        for _ in 0..5 {
            scene.frame(Some(&context), DT, ALL);
        }
        scene.water.set_quality(preset).unwrap();
        for _ in 0..170 {
            scene.frame(Some(&context), DT, Consumers::empty());
        }
        // What it takes to be drawn is made beside the frames.
        for _ in 0..200 {
            std::thread::sleep(std::time::Duration::from_millis(10));
            scene.frame(Some(&context), 0.3 * DT, Consumers::empty());
        }
        // A moment that was not drawn yet: that of the CPU's answers.
        scene.frame(None, DT, ALL);
        let mut plan = scene.water.plan(&view(), Consumers::NORMALS);
        (plan.time, plan.alpha) = (scene.water.time(), 1.0);
        context.submit(|encoder| scene.water.encode(&plan, encoder));
        let points = points(scene.store.get(scene.boat).unwrap().position);
        let found = probe(&context, &scene.water, &points[..2000]);
        let mut expected = vec![WaterSample::default(); 2000];
        scene.water.sample(&points[..2000], &mut expected);
        let bound = (1e-3 * scene.water.ocean().unwrap().significant_height()).max(1e-3);
        for (f, e) in found.iter().zip(&expected) {
            assert!((f[0] - e.height).abs() <= bound, "{preset:?}: {f:?} against {e:?}");
        }
    }
    assert_eq!(context.take_errors(), Vec::<String>::new());
}

//! Cases of the whole: `gpu_vs_cpu`, `bodies_equal`, `empty_scene`, `tick`.

use glam::Vec2;
use ocean_spectrum::SeaState;
use open_water::{BodyStates, Consumers, GridDesc, OpenWater, OpenWaterDesc, View, WaterSample};
use open_water_shaders::{pipeline, surface};

use crate::{
    evidence::{Case, CaseError, Context, Gpu, Row, measure, measure_together},
    fixtures::{FRAME, Random, Scene, SceneDesc},
};

/// See the module.
pub(super) const GPU_VS_CPU: Case = Case {
    name: "gpu_vs_cpu",
    about: "the drawn surface through surface_at on the GPU against the CPU's answer, sea and wake",
    plots: &[],
    run: gpu_vs_cpu,
};

/// See the module.
pub(super) const BODIES_EQUAL: Case = Case {
    name: "bodies_equal",
    about: "bodies of a run that is drawn on the GPU and of a headless one",
    plots: &[],
    run: bodies_equal,
};

/// See the module.
pub(super) const EMPTY: Case = Case {
    name: "empty_scene",
    about: "dispatches and uploads of a frame of calm water with a grid and nothing in it",
    plots: &[],
    run: empty,
};

/// See the module.
pub(super) const TICK: Case = Case {
    name: "tick",
    about: "a whole tick: sea, boat, 200 pieces of flotsam, wake; the same on one thread",
    plots: &[],
    run: tick,
};

pub(super) fn view() -> [View; 1] {
    [View { eye: glam::Vec3::new(0.0, 10.0, 0.0), pixel_angle: 1e-3 }]
}

/// Plans, encodes, submits and waits for a frame.
pub(super) fn draw(gpu: &Gpu, water: &mut OpenWater) -> Result<u32, CaseError> {
    let plan = water.plan(&view(), Consumers::NORMALS | Consumers::FOAM);
    gpu.run(|encoder| water.encode(&plan, encoder))?;
    Ok(plan.dispatches())
}

fn gpu_vs_cpu(context: &Context) -> Result<Vec<Row>, CaseError> {
    const POINTS: usize = 10_000;
    let gpu = context.gpu()?;
    // A window that stays, so that its fade is the same a tick later.
    let mut scene = Scene::new(Some(gpu), &SceneDesc { follow: false, flotsam: 0, ..SceneDesc::default() })?;
    for _ in 0..context.pick(240, 1200) {
        scene.tick()?;
    }
    let mut random = Random::new(6);
    // Half of the points where the wake is, half far away.
    let points: Vec<Vec2> = (0..POINTS)
        .map(|i| {
            let reach = if i % 2 == 0 { 30.0 } else { 2000.0 };
            Vec2::new(random.within(-reach, reach) as f32, random.within(-reach, reach) as f32)
        })
        .collect();
    let mut truth = vec![WaterSample::default(); POINTS];
    scene.water.sample(&points, &mut truth);
    // With nothing left over, a frame draws the tick before its last one: that of the answers.
    scene.tick()?;
    draw(gpu, &mut scene.water)?;
    let made = probe(gpu, &scene.water, &points)?;
    let hs = f64::from(scene.water.ocean().map_or(0.0, |ocean| ocean.significant_height()));
    let folded = truth.iter().filter(|sample| sample.folded).count();
    let (mut worst, mut square, mut worst_normal) = (0.0f64, 0.0, 0.0f64);
    for (made, truth) in made.iter().zip(&truth).filter(|(_, truth)| !truth.folded) {
        let difference = f64::from(made[0] - truth.height).abs();
        worst = if difference.is_nan() { f64::NAN } else { worst.max(difference) };
        square += difference * difference;
        worst_normal = worst_normal.max(f64::from(glam::Vec3::from_slice(&made[1..]).distance(truth.normal)));
    }
    let timing = measure(context.effort, || {
        // A new moment each time, or there would be nothing to draw.
        let _ = scene.water.advance(FRAME / 16.0);
        let _ = draw(gpu, &mut scene.water);
    });
    Ok(vec![
        Row::new("gpu_vs_cpu", gpu.adapter.kind.clone())
            .param("points", POINTS)
            .param("folded_points_left_out", folded)
            .param("hs_m", (hs * 1e3).round() / 1e3)
            .param("rms_mm", ((square / POINTS as f64).sqrt() * 1e6).round() / 1e3)
            .param("worst_normal", (worst_normal * 1e5).round() / 1e5)
            .error(worst * 1e3, "mm", "the CPU's answers from the same modes and grid; worst point")
            .bound(f64::max(1.0, hs))
            .time("a drawn frame of sea, foam and wake: plan, encode, submit, wait", &timing),
    ])
}

/// Answers of `surface_at` on the GPU: height and normal.
pub(super) fn probe(gpu: &Gpu, water: &OpenWater, points: &[Vec2]) -> Result<Vec<[f32; 4]>, CaseError> {
    let (Some(group), Some(layout)) = (water.surface_bind_group(), water.surface_layout()) else {
        return Err("no bind group of the surface".into());
    };
    let pass = surface::PASSES.iter().find(|pass| pass.name == "surface_probe").ok_or("no pass surface_probe")?;
    let slots = [pipeline::Slot::Read, pipeline::Slot::ReadWrite];
    let own = pipeline::group_layout(&gpu.device, "probe", wgpu::ShaderStages::COMPUTE, &slots);
    let probe = pipeline::compute_pipeline(&gpu.device, pass, "surface_probe", &[layout, &own], &[]);
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let buffer = |size: usize| {
        let descriptor =
            wgpu::BufferDescriptor { label: Some("probe"), size: size as u64, usage, mapped_at_creation: false };
        gpu.device.create_buffer(&descriptor)
    };
    let (asked, answers) = (buffer(points.len() * 8), buffer(points.len() * 16));
    let bytes: Vec<u8> = points.iter().flat_map(|point| point.to_array()).flat_map(f32::to_le_bytes).collect();
    gpu.queue.write_buffer(&asked, 0, &bytes);
    let bound = [asked.as_entire_binding(), answers.as_entire_binding()];
    let own_group = pipeline::bind_group(&gpu.device, "probe", &own, &bound);
    gpu.run(|encoder| {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&probe);
        pass.set_bind_group(0, group, &[]);
        pass.set_bind_group(1, &own_group, &[]);
        pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
    })?;
    Ok(gpu.read_buffer(&answers)?.as_chunks::<4>().0.to_vec())
}

fn bodies_equal(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let desc = SceneDesc { flotsam: 20, ..SceneDesc::default() };
    let (mut drawn, mut headless) = (Scene::new(Some(gpu), &desc)?, Scene::new(None, &desc)?);
    let ticks = context.pick(120, 1200);
    let mut worst = 0.0f64;
    for tick in 0..ticks {
        drawn.tick()?;
        headless.tick()?;
        if tick % context.pick(6, 1) == 0 {
            draw(gpu, &mut drawn.water)?;
        }
        let distance = drawn.distance(&headless);
        worst = if distance.is_nan() { distance } else { worst.max(distance) };
    }
    Ok(vec![
        Row::new("bodies_equal", "grid on the CPU")
            .param("ticks", ticks)
            .param("bodies", desc.flotsam + 1)
            .error(worst, "m", "the same bodies without a device; worst body and tick")
            .bound(0.0),
    ])
}

fn empty(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let calm = SeaState { partitions: Vec::new(), depth: None };
    let mut water = OpenWater::new(&gpu.device, &gpu.queue, OpenWaterDesc { sea: calm, ..OpenWaterDesc::default() })?;
    water.add_grid(GridDesc::default())?;
    let mut bodies = BodyStates::default();
    let (mut dispatches, mut bytes) = (0, 0);
    let mut frame = |water: &mut OpenWater| -> Result<(), CaseError> {
        for tick in water.advance(FRAME) {
            water.tick(tick, &mut bodies)?;
        }
        let plan = water.plan(&view(), Consumers::all());
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        water.encode(&plan, &mut encoder);
        (dispatches, bytes) = (dispatches + plan.dispatches(), bytes + plan.upload_bytes());
        Ok(())
    };
    for _ in 0..60 {
        frame(&mut water)?;
    }
    let timing = measure(context.effort, || {
        let _ = frame(&mut water);
    });
    let row = |variant: &str, error: f64, unit: &str| {
        Row::new("empty_scene", variant).error(error, unit, "nothing to do; sum over all frames").bound(0.0)
    };
    Ok(vec![
        row("dispatches", f64::from(dispatches), "dispatches").time("tick, plan and encode of a frame", &timing),
        row("uploads", bytes as f64, "bytes"),
    ])
}

fn tick(context: &Context) -> Result<Vec<Row>, CaseError> {
    let desc = SceneDesc::default();
    let (mut scene, mut alone) = (Scene::new(None, &desc)?, Scene::new(None, &desc)?);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let ticks = context.pick(60, 600);
    for _ in 0..ticks {
        scene.tick()?;
        one_thread.install(|| alone.tick())?;
    }
    let distance = scene.distance(&alone);
    let mut sea = ocean_spectrum::Ocean::new(crate::fixtures::ocean(256))?;
    let mut time = 0.0;
    let mut failed = None;
    let [ours, single, sea_alone] = measure_together(
        context.effort,
        [
            &mut || failed = scene.tick().err().or(failed.take()),
            &mut || {
                let _ = one_thread.install(|| alone.tick());
            },
            &mut || {
                time += 1.0 / 60.0;
                sea.set_time(time);
                sea.prepare(ocean_spectrum::Outputs::ALL);
            },
        ],
    );
    if let Some(error) = failed {
        return Err(error.into());
    }
    let row = |variant: &str| {
        Row::new("tick", variant).param("bodies", desc.flotsam + 1).param("preset", "medium").param("ticks", ticks)
    };
    Ok(vec![
        row("all threads")
            .error(distance, "m", "the same bodies on one thread; worst body after all ticks")
            .bound(0.0)
            .time("a tick", &ours)
            .baseline("the synthesis of the sea alone, all threads", &sea_alone),
        row("one thread").time("a tick", &single).baseline("the same on all threads", &ours),
    ])
}

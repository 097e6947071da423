//! Case `scene`: what a frame costs against what is in it, from nothing to a full scene.

use std::time::Instant;

use floating_body::{BodyDesc, BodyState, Controls, FleetDesc};
use glam::{DVec2, Vec3};
use open_water::{
    BodyId, BodyStates, Consumers, Follow, FramePlan, GridDesc, GridHome, OpenWater, OpenWaterDesc, Preset, SeaState,
    View,
};

use crate::evidence::{Case, CaseError, Context, Gpu, Row, allocations};
use crate::fixtures::{CRATE_MASS, FRAME, Random, boat_hull, crate_hull};

/// See the module.
pub(super) const SCENE: Case = Case {
    name: "scene",
    about: "a frame against what is in it, each row with all of the ones before: ticks, plan, encode, device, bytes",
    plots: &[],
    run,
};

/// What is added, row by row.
const STEPS: [&str; 8] = [
    "calm water",
    "a grid that sleeps",
    "the default sea",
    "looks: normals and foam",
    "a boat under way",
    "its wake on a grid",
    "1,000 pieces of flotsam",
    "a second boat, its wake on the device",
];

struct Scene {
    water: OpenWater,
    bodies: BodyStates,
    consumers: Consumers,
}

impl Scene {
    /// With the first `count` steps.
    fn new(gpu: &Gpu, count: usize) -> Result<Self, CaseError> {
        let has = |step: usize| count > step;
        let mut desc = OpenWaterDesc::default();
        if !has(2) {
            desc.sea = SeaState { partitions: Vec::new(), depth: None };
        }
        let mut water = OpenWater::new(&gpu.device, &gpu.queue, desc)?;
        let mut bodies = BodyStates::default();
        if has(1) {
            water.add_grid(GridDesc { follow: Follow::Fixed(DVec2::splat(500.0)), ..GridDesc::default() })?;
        }
        let mut boat = |water: &mut OpenWater, x: f32| -> Result<BodyId, CaseError> {
            let boat = water.add_body(BodyDesc::boat(&boat_hull()?, 1500.0, 8.0))?;
            water.set_controls(boat, Controls { throttle: 1.0, steering: 0.2, ..Controls::default() })?;
            let rest = water.body(boat)?.rest_height();
            bodies.insert(boat, BodyState::at_rest(Vec3::new(x, rest, 0.0)));
            Ok(boat)
        };
        if has(4) {
            let boat = boat(&mut water, 0.0)?;
            if has(5) {
                water.add_grid(GridDesc { follow: Follow::Body(boat), ..Preset::Medium.grid() })?;
            }
        }
        if has(7) {
            let boat = boat(&mut water, 200.0)?;
            let home = GridHome::Gpu;
            water.add_grid(GridDesc { follow: Follow::Body(boat), home, cells: [512; 2], ..Preset::Medium.grid() })?;
        }
        if has(6) {
            let fleet = water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&crate_hull()?, CRATE_MASS)))?;
            let mut random = Random::new(3);
            for _ in 0..1000 {
                let at = Vec3::new(random.within(-60.0, 60.0) as f32, 0.0, random.within(-60.0, 60.0) as f32);
                water.fleet_mut(fleet)?.add(BodyState::at_rest(at))?;
            }
        }
        let consumers = if has(3) { Consumers::NORMALS | Consumers::FOAM } else { Consumers::empty() };
        Ok(Self { water, bodies, consumers })
    }

    /// A frame of one tick; what was planned, and the times of tick, plan, encode and device in ms.
    fn frame(&mut self, gpu: &Gpu) -> Result<(FramePlan, [f64; 4]), CaseError> {
        let mut times = [0.0; 4];
        let start = Instant::now();
        for tick in self.water.advance(FRAME) {
            self.water.tick(tick, &mut self.bodies)?;
        }
        times[0] = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        let plan = self.water.plan(&[View { eye: Vec3::new(-20.0, 6.0, 0.0), pixel_angle: 1e-3 }], self.consumers);
        times[1] = start.elapsed().as_secs_f64() * 1e3;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let start = Instant::now();
        self.water.encode(&plan, &mut encoder);
        times[2] = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        gpu.queue.submit([encoder.finish()]);
        gpu.wait()?;
        times[3] = start.elapsed().as_secs_f64() * 1e3;
        Ok((plan, times))
    }
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let round = |x: f64| (x * 1e3).round() / 1e3;
    let mut rows = Vec::new();
    for (step, name) in STEPS.iter().enumerate() {
        let mut scene = Scene::new(gpu, step + 1)?;
        for _ in 0..context.pick(20, 600) {
            scene.frame(gpu)?;
        }
        let mut all = Vec::new();
        for _ in 0..context.pick(9, 120) {
            all.push(scene.frame(gpu)?);
        }
        let median = |k: usize| {
            let mut times: Vec<f64> = all.iter().map(|(_, times)| times[k]).collect();
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        let [tick, plan, encode, device] = std::array::from_fn(median);
        let (bytes, dispatches) = all.last().map_or((0, 0), |(plan, _)| (plan.upload_bytes(), plan.dispatches()));
        let asked = allocations(|| {
            let _ = scene.frame(gpu);
        });
        rows.push(
            Row::new("scene", *name)
                .param("dispatches", dispatches)
                .param("upload_KiB", round(bytes as f64 / 1024.0))
                .param("tick_ms", round(tick))
                .param("plan_us", round(1e3 * plan))
                .param("encode_ms", round(encode))
                .param("device_ms", round(device))
                .param("allocations_of_the_host_too", asked)
                .error(tick + plan + encode + device, "ms a frame", "the rows before it"),
        );
    }
    Ok(rows)
}

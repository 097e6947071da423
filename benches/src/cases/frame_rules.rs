//! Cases `frame_plan` and `frame_rules`: what a plan costs, and what each of its rules saves and misses.

use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyState, BodyStates, Border, CascadeDesc, Consumers, Follow, GridDesc, OpenWater, OpenWaterDesc,
    Preset, Rules, View,
};

use super::facade::probe;
use crate::evidence::{Case, CaseError, Context, Gpu, Row, allocations, measure, measure_together};
use crate::fixtures::{CRATE_MASS, FRAME, Scene, SceneDesc, boat_hull, crate_hull};

/// See the module.
pub(super) const PLAN: Case = Case {
    name: "frame_plan",
    about: "a plan for 16 grids with waves, 8 cascades and 1,000 bodies, 100 of them kept dry; and its allocations",
    plots: &[],
    run: plan,
};

/// See the module.
pub(super) const RULES: Case = Case {
    name: "frame_rules",
    about: "a frame (tick, plan, encode, submit, wait) with each rule against one without it, and how heights differ",
    plots: &[],
    run: rules,
};

fn plan(context: &Context) -> Result<Vec<Row>, CaseError> {
    const TILES: [f32; 8] = [800.0, 400.0, 200.0, 100.0, 50.0, 25.0, 12.0, 6.0];
    let gpu = context.gpu()?;
    let cascades = TILES.map(|tile| CascadeDesc::new(16, tile)).to_vec();
    let desc = OpenWaterDesc { cascades, ..OpenWaterDesc::default() };
    let mut water = OpenWater::new(&gpu.device, &gpu.queue, desc)?;
    let (mut bodies, hull, boat) = (BodyStates::default(), crate_hull()?, boat_hull()?);
    for i in 0..1000u16 {
        let place = Vec3::new(f32::from(i % 40) * 8.0, 0.5, f32::from(i / 40) * 8.0);
        let id = water.add_body(BodyDesc::from_hull(&hull, CRATE_MASS))?;
        bodies.insert(id, BodyState::at_rest(place));
        if i % 10 == 0 {
            water.set_dry(id, Some(boat.dry(0.1, 0.1)?))?;
        }
        if i < 16 {
            let border = Border::Absorbing { width: 8 };
            water.add_grid(GridDesc { follow: Follow::Body(id), cells: [64; 2], border, ..GridDesc::default() })?;
        }
    }
    for _ in 0..8 {
        for tick in water.advance(FRAME) {
            water.tick(tick, &mut bodies)?;
        }
    }
    let view = View { eye: Vec3::Y * 5.0, pixel_angle: 1e-3 };
    let views = [view, View { eye: Vec3::Y * 800.0, ..view }];
    let uploads = water.plan(&views, Consumers::all()).work.len();
    let asked = allocations(|| {
        std::hint::black_box(water.plan(&views, Consumers::all()));
    });
    let timing = measure(context.effort, || {
        std::hint::black_box(water.plan(&views, Consumers::all()));
    });
    let row = Row::new("frame_plan", "two views").param("work", uploads as u64).param("target_us", 20);
    Ok(vec![row.error(asked as f64, "allocations", "none").bound(0.0).time("a plan", &timing)])
}

/// A rule, from which height it is judged, and who reads.
struct Trial {
    name: &'static str,
    rule: Rules,
    /// Those that would hide it.
    others: Rules,
    eye: Vec3,
    consumers: Consumers,
    frame: f32,
    views: usize,
    /// Largest error, pixels.
    bound: f64,
}

fn trials() -> [Trial; 8] {
    let near = Trial {
        name: "",
        rule: Rules::empty(),
        others: Rules::empty(),
        eye: Vec3::Y * 6.0,
        consumers: Consumers::all(),
        frame: FRAME,
        views: 1,
        bound: 0.0,
    };
    let (short, still, far) = (Rules::SHORT, Rules::STILL, Rules::FAR);
    [
        Trial { name: "nobody looks", rule: Rules::UNSEEN, views: 0, consumers: Consumers::empty(), ..near },
        Trial { name: "heights alone", rule: Rules::UNASKED, consumers: Consumers::empty(), ..near },
        Trial { name: "grids asleep", rule: Rules::ASLEEP, ..near },
        Trial { name: "the same moment", rule: Rules::UNCHANGED, frame: 0.0, ..near },
        Trial { name: "1.5 km up", rule: short, others: still | far, eye: Vec3::Y * 1500.0, bound: 1.0, ..near },
        Trial { name: "4 km up", rule: still, others: short | far, eye: Vec3::Y * 4e3, bound: 0.1, ..near },
        Trial { name: "a wake 20 km off", rule: far, eye: Vec3::new(20e3, 6.0, 0.0), bound: 1.0, ..near },
        Trial { name: "no bodies", rule: Rules::UNREAD, ..near },
    ]
}

fn water_of(gpu: &Gpu, trial: &Trial) -> Result<Scene, CaseError> {
    let mut scene = Scene::new(Some(gpu), &SceneDesc { preset: Preset::Low, flotsam: 0, ..SceneDesc::default() })?;
    if trial.rule == Rules::ASLEEP {
        for k in 1..4 {
            let follow = Follow::Fixed(DVec2::splat(1000.0 * f64::from(k)));
            scene.water.add_grid(GridDesc { follow, ..GridDesc::default() })?;
        }
    }
    if trial.rule == Rules::UNREAD {
        scene.water.remove_body(scene.boat)?;
    }
    for _ in 0..60 {
        scene.tick()?;
    }
    Ok(scene)
}

fn frame(gpu: &Gpu, scene: &mut Scene, trial: &Trial, rules: Rules) -> Result<(u32, u64), CaseError> {
    scene.water.set_rules(rules);
    for tick in scene.water.advance(trial.frame) {
        scene.water.tick(tick, &mut scene.bodies)?;
    }
    let views = [View { eye: trial.eye, pixel_angle: 1e-3 }];
    let plan = scene.water.plan(&views[..trial.views], trial.consumers);
    gpu.run(|encoder| scene.water.encode(&plan, encoder))?;
    Ok((plan.dispatches(), plan.upload_bytes()))
}

fn rules(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let points: Vec<Vec2> =
        (0..2000).map(|i| Vec2::from_angle(i as f32 * 2.399_963) * 5.0 * (i as f32).sqrt()).collect();
    let mut rows = Vec::new();
    for trial in &trials() {
        let mut scenes = [water_of(gpu, trial)?, water_of(gpu, trial)?];
        let with = Rules::all() - trial.others;
        let rules = [with, with - trial.rule];
        let (mut worst, mut square, mut counted) = (0.0f64, 0.0, 0u32);
        let mut sums = [(0u64, 0u64); 2];
        let frames = context.pick(8, 60);
        for _ in 0..frames {
            for ((scene, rules), sum) in scenes.iter_mut().zip(rules).zip(&mut sums) {
                let (dispatches, bytes) = frame(gpu, scene, trial, rules)?;
                *sum = (sum.0 + u64::from(dispatches), sum.1 + bytes);
            }
            if trial.views == 0 {
                continue;
            }
            let [a, b] = [probe(gpu, &scenes[0].water, &points)?, probe(gpu, &scenes[1].water, &points)?];
            for (a, b) in a.iter().zip(&b) {
                let off = f64::from(a[0] - b[0]).abs();
                worst = if off.is_nan() { f64::NAN } else { worst.max(off) };
                square += off * off;
                counted += 1;
            }
        }
        let off = trial.eye.length();
        let pixel = 1e-3 * f64::from(off);
        let rms = (square / f64::from(counted.max(1))).sqrt();
        // The sea that stands is bounded in the mean, all else at its worst.
        let error = if trial.rule == Rules::STILL { rms } else { worst } / pixel;
        let [a, b] = &mut scenes;
        let [saved, full] = measure_together(
            context.effort,
            [
                &mut || {
                    let _ = frame(gpu, a, trial, rules[0]);
                },
                &mut || {
                    let _ = frame(gpu, b, trial, rules[1]);
                },
            ],
        );
        let per = |sum: u64| (10 * sum / frames) as f64 / 10.0;
        rows.push(
            Row::new("frame_rules", trial.name)
                .param("rule", format!("{:?}", trial.rule))
                .param("dispatches", per(sums[0].0))
                .param("dispatches_without", per(sums[1].0))
                .param("upload_KiB", per(sums[0].1 / 1024))
                .param("upload_KiB_without", per(sums[1].1 / 1024))
                .param("rms_mm", (rms * 1e6).round() / 1e3)
                .error(error, "pixels", "the same frames without the rule: heights at 2,000 points")
                .bound(trial.bound)
                .time("a frame: tick, plan, encode, submit, wait", &saved)
                .baseline("the same without the rule", &full),
        );
    }
    Ok(rows)
}

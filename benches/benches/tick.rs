//! A whole tick of the scene, and of waters with less in them.

use criterion::{Criterion, criterion_group, criterion_main};
use open_water::{BodyStates, OpenWater, OpenWaterDesc, Preset, SeaState};
use open_water_benches::fixtures::{FRAME, Scene, SceneDesc};

fn ticks(c: &mut Criterion) {
    let mut group = c.benchmark_group("tick");
    for (name, preset, flotsam) in [
        ("medium, boat", Preset::Medium, 0),
        ("medium, boat and 200 crates", Preset::Medium, 200),
        ("low, boat and 200 crates", Preset::Low, 200),
    ] {
        let desc = SceneDesc { preset, flotsam, ..SceneDesc::default() };
        let mut scene = Scene::new(None, &desc).expect("the fixture is in bounds");
        group.bench_function(name, |b| b.iter(|| scene.tick().expect("ticks come in order")));
    }
    let calm = SeaState { partitions: Vec::new(), depth: None };
    let mut water =
        OpenWater::headless(OpenWaterDesc { sea: calm, ..OpenWaterDesc::default() }).expect("the fixture is in bounds");
    let mut bodies = BodyStates::default();
    group.bench_function("empty", |b| {
        b.iter(|| {
            for tick in water.advance(FRAME) {
                water.tick(tick, &mut bodies).expect("ticks come in order");
            }
        });
    });
    group.finish();
}

criterion_group!(benches, ticks);
criterion_main!(benches);

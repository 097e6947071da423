//! Time stamps of the water's compute pass.

use open_water::{Consumers, OpenWater, Preset};

use crate::context::Context;
use crate::surface::{DT, calm, scene, view};

const ALL: Consumers = Consumers::all();

#[test]
fn stamps_come_back_where_the_device_has_them() {
    let wanted = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES;
    let features = Context::features() & wanted;
    let context = Context::with_features(features);
    let mut scene = scene(Some(&context), Preset::Low.water());
    assert_eq!(scene.water.gpu_times(), None);
    let mut ticks = Vec::new();
    for _ in 0..6 {
        scene.frame(Some(&context), DT, ALL);
        ticks.extend(scene.water.gpu_times().map(|times| times.tick));
    }
    if !features.contains(wgpu::Features::TIMESTAMP_QUERY) {
        assert!(ticks.is_empty());
        return;
    }
    // Each frame was waited for, so the next one has its times.
    assert_eq!(ticks, [1, 2, 3, 4, 5]);
    let times = scene.water.gpu_times().unwrap();
    assert!(times.pass > 0.0 && times.pass < 10.0, "{times:?}");
    let inside = features.contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES);
    assert_eq!(times.sea.is_some(), inside);
    assert!(times.sea.is_none_or(|sea| sea > 0.0 && sea <= times.pass), "{times:?}");
    // A paused frame runs nothing, and leaves the last times.
    scene.frame(Some(&context), 0.0, ALL);
    scene.frame(Some(&context), 0.0, ALL);
    assert_eq!(scene.water.gpu_times().map(|times| times.tick), Some(6));
}

#[test]
fn nothing_run_and_nothing_asked_for_is_no_time() {
    let context = Context::with_features(Context::features() & wgpu::Features::TIMESTAMP_QUERY);
    let mut water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
    for _ in 0..3 {
        let plan = water.plan(&view(), ALL);
        context.submit(|encoder| water.encode(&plan, encoder));
    }
    assert_eq!(water.gpu_times(), None);
    let without = Context::new();
    let mut scene = scene(Some(&without), Preset::Low.water());
    (0..3).for_each(|_| drop(scene.frame(Some(&without), DT, ALL)));
    assert_eq!(scene.water.gpu_times(), None);
}

//! Back to a snapshot: the device draws again what it drew then, and another device does from bytes.

use std::time::Duration;

use glam::Vec2;
use open_water::{Consumers, GridDesc, GridHome, OpenWater, Preset, Scheme, WaterSnapshot};

use super::{DT, Scene, points, probe, scene};
use crate::context::Context;

/// Heights around the boat at the end of the last tick, drawn anew.
fn drawn(context: &Context, scene: &mut Scene, points: &[Vec2]) -> Vec<[f32; 4]> {
    scene.frame(Some(context), 0.0, Consumers::all());
    probe(context, &scene.water, points)
}

fn largest(found: &[[f32; 4]], other: &[[f32; 4]]) -> f32 {
    found.iter().zip(other).fold(0.0, |most, (a, b)| most.max((a[0] - b[0]).abs()))
}

#[test]
fn what_was_drawn_is_drawn_again() {
    let [context, other] = [Context::new(), Context::new()];
    let mut scene = scene(Some(&context), Preset::Low.water());
    let run = |scene: &mut Scene| {
        for _ in 0..60 {
            scene.frame(Some(&context), DT, Consumers::all());
        }
    };
    run(&mut scene);
    let points = points(scene.store.get(scene.boat).unwrap().position);
    let before = drawn(&context, &mut scene, &points);
    let (snapshot, store) = (scene.water.snapshot(), scene.store.clone());
    // Grids come after it, one on the device: they are gone again.
    for home in [GridHome::Cpu, GridHome::Gpu] {
        scene.water.add_grid(GridDesc { home, scheme: Scheme::NinePoint, ..Preset::Low.grid() }).unwrap();
    }
    run(&mut scene);
    assert!(largest(&drawn(&context, &mut scene, &points), &before) > 0.05);
    scene.water.restore(&snapshot).unwrap();
    scene.store = store;
    let again = drawn(&context, &mut scene, &points);
    assert!(largest(&again, &before) < 1e-4, "{}", largest(&again, &before));

    // Of another quality, until it is told.
    let mut water = OpenWater::new(&other.device, &other.queue, Preset::High.water()).unwrap();
    water.restore(&WaterSnapshot::from_bytes(&snapshot.to_bytes()).unwrap()).unwrap();
    assert_eq!(water.hash(), scene.water.hash());
    let mut joined = Scene { water, store: scene.store.clone(), boat: scene.boat, floats: scene.floats.clone() };
    for scene in [&mut scene, &mut joined] {
        let tick = scene.water.last_tick() + 30;
        for tick in scene.water.ticks_until(tick) {
            scene.water.tick(tick, &mut scene.store).unwrap();
        }
    }
    assert_eq!(joined.water.hash(), scene.water.hash());
    assert_eq!(joined.states(), scene.states());
    scene.frame(Some(&context), 0.5 * DT, Consumers::all());
    joined.water.advance(0.5 * DT);
    let here = probe(&context, &scene.water, &points);
    // The textures of its new sea are made beside the frames.
    let mut off = f32::INFINITY;
    for _ in 0..500 {
        off = largest(&drawn(&other, &mut joined, &points), &here);
        if off < 1e-4 {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(off < 1e-4, "{off}");
}

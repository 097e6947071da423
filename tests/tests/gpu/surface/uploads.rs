//! Uploads of what has changed against those of a device that has nothing yet, and gets all.

use glam::{DVec2, Vec2, Vec3};
use open_water::{BodyDesc, BodyState, Border, Consumers, Follow, GridDesc, Hull, Scheme, Work};

use super::{DT, Scene, calm, points, probe, scene, view};
use crate::context::Context;

/// The device's heights around the boat and the largest of them, after a whole upload to another device.
fn check(scene: &mut Scene, old: &Context, new: &Context, when: u32) -> f32 {
    let around = scene.store.get(scene.boat).unwrap().position;
    let mut points = points(around);
    // Where another grid is.
    points
        .extend((0..2000).map(|i| Vec2::new(12.0, 14.0) + Vec2::from_angle(i as f32 * 2.4) * 0.4 * (i as f32).sqrt()));
    let found = probe(old, &scene.water, &points);
    scene.water.replace_device(&new.device, &new.queue).unwrap();
    let plan = scene.water.plan(&view(), Consumers::empty());
    assert!(plan.upload_bytes() >= 8 * 128 * 128, "{plan}");
    new.submit(|encoder| scene.water.encode(&plan, encoder));
    assert_eq!(probe(new, &scene.water, &points), found, "frame {when}");
    found.iter().fold(0.0, |most, found| most.max(found[0].abs()))
}

#[test]
fn parts_add_up_to_the_whole() {
    let contexts = [Context::new(), Context::new()];
    let mut scene = scene(Some(&contexts[0]), calm());
    // A float that falls in far from the sides of a wide grid: there rows go up in part.
    let float = scene.water.add_body(BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(0.8)).unwrap(), 200.0)).unwrap();
    scene.store.insert(float, BodyState::at_rest(Vec3::new(12.0, 1.0, 14.0)));
    let wide = GridDesc {
        follow: Follow::Body(float),
        cells: [400, 120],
        border: Border::Absorbing { width: 8 },
        scheme: Scheme::NinePoint,
        ..GridDesc::default()
    };
    let first = scene.water.add_grid(GridDesc { follow: Follow::Fixed(DVec2::ZERO), ..wide.clone() }).unwrap();
    scene.water.add_grid(wide.clone()).unwrap();
    let (mut least, mut checks, mut on) = (u64::MAX, 0, 0);
    for frame in 0..240 {
        // Frame rates above and below that of the ticks; encoders that are lost.
        for tick in scene.water.advance(if frame % 7 == 0 { 2.0 * DT } else { 0.7 * DT }) {
            scene.water.tick(tick, &mut scene.store).unwrap();
        }
        match frame {
            60 => drop(scene.water.add_grid(GridDesc { follow: Follow::Point, ..wide.clone() }).unwrap()),
            // Those behind it move up in the pool.
            150 => scene.water.remove_grid(first).unwrap(),
            100 => {
                let state = *scene.store.get(scene.boat).unwrap();
                let position = state.position + Vec3::new(60.0, 0.0, 20.0);
                scene.store.insert(scene.boat, BodyState { position, ..state });
            }
            _ => {}
        }
        let plan = scene.water.plan(&view(), Consumers::empty());
        let mut encoder = contexts[on].device.create_command_encoder(&Default::default());
        scene.water.encode(&plan, &mut encoder);
        if frame % 31 == 30 {
            drop(encoder);
            continue;
        }
        contexts[on].queue.submit([encoder.finish()]);
        contexts[on].wait();
        if plan.work.iter().any(|work| matches!(work, Work::GridUpload { .. })) {
            least = least.min(plan.upload_bytes());
        }
        if frame % 24 == 20 {
            let most = check(&mut scene, &contexts[on], &contexts[1 - on], frame);
            assert!(most > 1e-3, "no waves: {most} m");
            on = 1 - on;
            checks += 1;
        }
    }
    assert_eq!(checks, 9);
    assert!(least < 8 * 128 * 128, "{least} bytes at least");
}

//! The level of the still water: a raised sea moves a body as the sea at 0 does, that much higher.

use floating_body::{AiryWave, Body, BodyDesc, BodyState, Controls, Hull, Sampling, WATER_DENSITY};
use glam::Vec3;

const DT: f32 = 1.0 / 60.0;
const LEVEL: f32 = 5.0;

/// States of a body on a wave as steep as pressure decay matters, over still water at `level`.
fn track(level: f32, sampling: Sampling) -> Vec<BodyState> {
    let hull = Hull::cuboid(Vec3::new(3.0, 2.0, 2.0)).unwrap();
    let mut desc = BodyDesc::from_hull(&hull, 0.6 * WATER_DENSITY * hull.volume());
    desc.sampling = sampling;
    let mut body = Body::new(desc).unwrap();
    let mut state = body.state();
    state.position.y += level;
    body.set_state(state);
    let mut wave = AiryWave::new(0.4, 12.0, 0.7);
    wave.level = level;
    let tick = |tick: u32| {
        wave.time = f64::from(tick) * f64::from(DT);
        body.step(DT, &wave, &Controls::default());
        body.state()
    };
    (0..1200).map(tick).collect()
}

#[test]
fn raised_water_moves_a_body_alike() {
    for sampling in [Sampling::Points, Sampling::Patch] {
        let (low, high) = (track(0.0, sampling), track(LEVEL, sampling));
        let heave = low.iter().map(|s| s.position.y.abs()).fold(0.0, f32::max);
        assert!(heave > 0.1, "{sampling:?}: {heave}");
        for (tick, (a, b)) in low.iter().zip(&high).enumerate() {
            let moved = (b.position - a.position - Vec3::Y * LEVEL).length();
            let turned = a.orientation.dot(b.orientation).abs();
            assert!(moved < 2e-3 && turned > 1.0 - 1e-5, "{sampling:?}, tick {tick}: {moved} m, {turned}");
        }
    }
}

//! Case `frame_age`: what the CPU knows of a grid on the GPU, against how late the device is.

use std::collections::VecDeque;

use floating_body::{BodyDesc, BodyState, Controls, Hull};
use glam::{Vec2, Vec3};
use open_water::{BodyId, BodyStates, Border, Consumers, Follow, GridDesc, GridHome, OpenWater, Preset, WaterSample};

use super::facade::view;
use crate::evidence::{Axis, Case, CaseError, Context, Gpu, Plot, Row};
use crate::fixtures::{FRAME, boat_hull};

/// See the module.
pub(super) const AGE: Case = Case {
    name: "frame_age",
    about: "samples of a grid on the GPU that is so many frames late, against a grid on the CPU with the same waves",
    plots: &[Plot {
        file: "frame_age",
        title: "Error of a sample against its age: carried on in its place and along with the hull (stale heights: 100 %)",
        x: Axis::Param("age_ms"),
        y: Axis::Error,
        label: None,
    }],
    run,
};

/// What makes waves.
#[derive(Clone, Copy, PartialEq)]
enum Waves {
    /// A boat's, 4 m and more from its place.
    Wake,
    /// The same with what is next to the hull.
    Hull,
    Ring,
}

struct Scene {
    water: OpenWater,
    store: BodyStates,
    body: BodyId,
}

impl Scene {
    fn new(gpu: Option<&Gpu>, waves: Waves) -> Result<Self, CaseError> {
        let mut desc = Preset::Low.water();
        desc.sea.partitions.clear();
        let mut water = match gpu {
            Some(gpu) => OpenWater::new(&gpu.device, &gpu.queue, desc)?,
            None => OpenWater::headless(desc)?,
        };
        let mut store = BodyStates::default();
        let body = if waves == Waves::Ring {
            let stone = water.add_body(BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0))?, 900.0))?;
            store.insert(stone, BodyState::at_rest(Vec3::new(0.0, 2.0, 0.0)));
            stone
        } else {
            let boat = water.add_body(BodyDesc::boat(&boat_hull()?, 1500.0, 8.0))?;
            water.set_controls(boat, Controls { throttle: 1.0, steering: 0.1, ..Controls::default() })?;
            let state = BodyState::at_rest(Vec3::new(-6.0, water.body(boat)?.rest_height(), 0.0));
            store.insert(boat, BodyState { velocity: Vec3::X * 6.0, ..state });
            boat
        };
        let follow = Follow::Body(body);
        let home = if gpu.is_some() { GridHome::Gpu } else { GridHome::Cpu };
        let border = Border::Absorbing { width: 12 };
        water.add_grid(GridDesc {
            follow,
            home,
            cells: [192; 2],
            cell_size: [0.25; 2],
            border,
            ..Preset::Low.grid()
        })?;
        Ok(Self { water, store, body })
    }

    /// Runs the ticks of a frame; after each `then` is called.
    fn ticks(&mut self, dt: f32, mut then: impl FnMut(&OpenWater)) -> Result<(), CaseError> {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.store)?;
            then(&self.water);
        }
        Ok(())
    }
}

/// Sums of squares of errors: carried on, of the straight line, stale, expected; of heights; how many; and of ages.
#[derive(Default)]
struct Sums {
    errors: [f64; 4],
    height: f64,
    count: f64,
    age: f64,
}

/// A device that is `late` frames late.
fn measured(gpu: &Gpu, waves: Waves, fps: f32, late: usize, seconds: f32) -> Result<Sums, CaseError> {
    let (mut far, mut near) = (Scene::new(Some(gpu), waves)?, Scene::new(None, waves)?);
    let points: Vec<Vec2> =
        (0..600u16).map(|i| Vec2::from_angle(f32::from(i) * 2.399_963) * 0.5 * f32::from(i).sqrt()).collect();
    let mut samples = vec![WaterSample::default(); points.len()];
    // Heights of the CPU's grid after the last ticks, the newest last.
    let mut past: VecDeque<Vec<f32>> = VecDeque::new();
    let mut waiting = VecDeque::new();
    let mut sums = Sums::default();
    let frames = (seconds * fps) as usize;
    for frame in 0..frames {
        far.ticks(1.0 / fps, |_| {})?;
        near.ticks(1.0 / fps, |water| {
            water.sample(&points, &mut samples);
            past.push_back(samples.iter().map(|sample| sample.height).collect());
        })?;
        far.water.sample(&points, &mut samples);
        let hull = near.store.get(near.body).map_or(Vec2::ZERO, |state| Vec2::new(state.position.x, state.position.z));
        // Once the stone has sunk or floats, and the boat makes way.
        if frame as f32 > 1.5 * fps {
            for (i, sample) in samples.iter().enumerate() {
                if waves == Waves::Wake && points[i].distance(hull) < 4.0 {
                    continue;
                }
                let ago = (sample.age / FRAME).round() as usize;
                let at = |ago: usize| past.len().checked_sub(1 + ago).and_then(|at| Some(past.get(at)?[i]));
                let (Some(truth), Some(stale), Some(before)) = (at(0), at(ago), at(ago + 1)) else { continue };
                if !sample.error.is_finite() {
                    continue;
                }
                let line = stale + ago as f32 * (stale - before);
                let errors = [sample.height - truth, line - truth, stale - truth, sample.error];
                sums.errors.iter_mut().zip(errors).for_each(|(sum, error)| *sum += f64::from(error).powi(2));
                sums.height += f64::from(truth).powi(2);
                sums.age += f64::from(sample.age);
                sums.count += 1.0;
            }
        }
        let plan = far.water.plan(&view(), Consumers::empty());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        far.water.encode(&plan, &mut encoder);
        waiting.push_back(encoder.finish());
        // The next frame's ticks find what was submitted by then.
        if waiting.len() >= late {
            gpu.queue.submit(waiting.pop_front());
            gpu.wait()?;
        }
        past.drain(..past.len().saturating_sub(64));
    }
    gpu.queue.submit(waiting);
    gpu.wait()?;
    Ok(sums)
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let round = |x: f64| (x * 1e3).round() / 1e3;
    let mut rows = Vec::new();
    let lates: &[usize] = context.pick(&[3], &[1, 2, 3, 4, 5, 6, 7, 8]);
    let rates: &[f32] = context.pick(&[30.0], &[30.0, 60.0]);
    for (name, waves) in [("boat's wake", Waves::Wake), ("stone's ring", Waves::Ring), ("wake and hull", Waves::Hull)] {
        for &fps in rates {
            for &late in lates {
                let sums = measured(gpu, waves, fps, late, context.pick(2.5, 6.0))?;
                let rms = |sum: f64| (sum / sums.count.max(1.0)).sqrt();
                let [carried, line, stale, expected] = sums.errors.map(rms);
                let row = Row::new("frame_age", format!("{name}, {fps} fps, {late} frames late"))
                    .param("age_ms", round(1e3 * sums.age / sums.count.max(1.0)))
                    .param("waves_rms_mm", round(1e3 * rms(sums.height)))
                    .param("stale_mm", round(1e3 * stale))
                    .param("line_percent", round(100.0 * line / stale))
                    .param("carried_on_mm", round(1e3 * carried))
                    .param("expected_over_found", round(expected / carried))
                    .error(100.0 * carried / stale, "% of the stale error", "a grid on the CPU; rms over rms");
                rows.push(if late == 3 && fps == 30.0 { row.bound(25.0) } else { row });
            }
        }
    }
    Ok(rows)
}

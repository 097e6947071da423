//! Case `frame_home`: the frame in which a grid changes its home, and those after it.

use std::time::Instant;

use open_water::{GridHome, Preset};

use super::facade::draw;
use crate::evidence::{Case, CaseError, Context, Gpu, Row};
use crate::fixtures::{Scene, SceneDesc};

/// See the module.
pub(super) const HOME: Case = Case {
    name: "frame_home",
    about: "a boat's grid moves to the GPU and back while it makes way: the call, and the worst frame (tick, encode, device)",
    plots: &[],
    run,
};

/// Frames: the first, the median and the worst, ms.
fn frames(gpu: &Gpu, scene: &mut Scene, count: usize) -> Result<[f64; 3], CaseError> {
    let mut times = Vec::new();
    for _ in 0..count {
        let start = Instant::now();
        scene.tick()?;
        draw(gpu, &mut scene.water)?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let first = times[0];
    times.sort_by(f64::total_cmp);
    Ok([first, times[times.len() / 2], times[times.len() - 1]])
}

/// The frames in which the pipelines are compiled beside.
fn beside(gpu: &Gpu, scene: &mut Scene) -> Result<Row, CaseError> {
    let start = Instant::now();
    let mut times = Vec::new();
    while !scene.water.prepare_gpu_grids() {
        if times.len() == 10_000 {
            return Err("the pipelines of grids on the GPU do not get compiled".into());
        }
        times.extend(frames(gpu, scene, 1)?.first());
    }
    let worst = times.iter().fold(0.0f64, |worst, time| worst.max(*time));
    Ok(Row::new("frame_home", "while pipelines are compiled beside")
        .param("frames", times.len())
        .param("compiled_after_ms", (start.elapsed().as_secs_f64() * 1e3).round())
        .error(worst, "ms", "the worst frame meanwhile"))
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let round = |x: f64| (x * 1e3).round() / 1e3;
    let span = context.pick(40, 240);
    let mut rows = Vec::new();
    for prepared in [false, true] {
        let desc = SceneDesc { preset: Preset::Low, flotsam: 0, ..SceneDesc::default() };
        let mut scene = Scene::new(Some(gpu), &desc)?;
        frames(gpu, &mut scene, 10)?;
        if prepared {
            rows.push(beside(gpu, &mut scene)?);
        }
        let mut usual = 0.0f64;
        for (name, home) in [
            ("as it is: CPU", GridHome::Cpu),
            ("first to the GPU", GridHome::Gpu),
            ("back to the CPU", GridHome::Cpu),
            ("to the GPU again", GridHome::Gpu),
        ] {
            let start = Instant::now();
            scene.water.set_grid_home(scene.grid, home)?;
            let call = start.elapsed().as_secs_f64() * 1e3;
            let [first, median, worst] = frames(gpu, &mut scene, span)?;
            if usual == 0.0 {
                usual = median;
            }
            let how = if prepared { "pipelines compiled beside" } else { "pipelines compiled in the call" };
            rows.push(
                Row::new("frame_home", format!("{name}, {how}"))
                    .param("call_ms", round(call))
                    .param("first_frame_ms", round(first))
                    .param("median_frame_ms", round(median))
                    .param("worst_frame_ms", round(worst))
                    .error(call + first - usual, "ms", "a usual frame on the CPU; the call and the frame after it"),
            );
        }
    }
    Ok(rows)
}

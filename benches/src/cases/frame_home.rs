//! Case `frame_home`: the frame in which a grid changes its home, and those after it.

use std::time::Instant;

use open_water::{GridHome, Preset};

use super::facade::draw;
use crate::evidence::{Case, CaseError, Context, Row};
use crate::fixtures::{Scene, SceneDesc};

/// See the module.
pub(super) const HOME: Case = Case {
    name: "frame_home",
    about: "a boat's grid moves to the GPU and back while it makes way: the call, and the worst frame (tick, encode, device)",
    plots: &[],
    run,
};

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let round = |x: f64| (x * 1e3).round() / 1e3;
    let mut scene = Scene::new(Some(gpu), &SceneDesc { preset: Preset::Low, flotsam: 0, ..SceneDesc::default() })?;
    let span = context.pick(40, 240);
    let mut rows = Vec::new();
    let mut usual = 0.0f64;
    for (name, home) in [
        ("as it is: CPU", GridHome::Cpu),
        ("first to the GPU, pipelines compiled", GridHome::Gpu),
        ("back to the CPU", GridHome::Cpu),
        ("to the GPU again", GridHome::Gpu),
    ] {
        let start = Instant::now();
        scene.water.set_grid_home(scene.grid, home)?;
        let call = start.elapsed().as_secs_f64() * 1e3;
        let mut times = Vec::new();
        for _ in 0..span {
            let start = Instant::now();
            scene.tick()?;
            draw(gpu, &mut scene.water)?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let first = times[0];
        times.sort_by(f64::total_cmp);
        let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
        if rows.is_empty() {
            usual = median;
        }
        rows.push(
            Row::new("frame_home", name)
                .param("call_ms", round(call))
                .param("first_frame_ms", round(first))
                .param("median_frame_ms", round(median))
                .param("worst_frame_ms", round(worst))
                .error(call + first - usual, "ms", "a usual frame on the CPU; the call and the frame after it"),
        );
    }
    Ok(rows)
}

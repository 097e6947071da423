//! Cases `frame_presets` and `frame_change`: what each quality costs and holds, and what a change from one to another does
//! to a frame.

use std::time::Instant;

use glam::{Vec2, Vec3};
use open_water::{BodyDesc, BodyStates, Controls, Follow, GridDesc, Hull, Ocean, OpenWater, Preset, WaterSample};

use super::facade::draw;
use crate::evidence::{Case, CaseError, Context, Row, measure};
use crate::fixtures::FRAME;

/// See the module.
pub(super) const PRESETS: Case = Case {
    name: "frame_presets",
    about: "a boat in its grid on the sea of each preset: tick, drawn frame, memory; what of the sea its cascades leave out",
    plots: &[],
    run: presets,
};

/// See the module.
pub(super) const CHANGE: Case = Case {
    name: "frame_change",
    about: "the sea and the quality change live: worst tick and frame, and the largest step of a height, against usual ones",
    plots: &[],
    run: change,
};

/// The presets of one row of costs.
const LADDER: [Preset; 4] = [Preset::Low, Preset::Medium, Preset::High, Preset::Ultra];

struct Boat {
    water: OpenWater,
    store: BodyStates,
}

impl Boat {
    fn new(context: &Context, preset: Preset) -> Result<Self, CaseError> {
        let gpu = context.gpu()?;
        let mut water = OpenWater::new(&gpu.device, &gpu.queue, preset.water())?;
        let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
        let body = water.add_body(preset.body(BodyDesc::boat(&hull, 4_000.0, 10.0)))?;
        let mut store = BodyStates::default();
        store.insert(body, water.body(body)?.state());
        water.set_controls(body, Controls { throttle: 0.8, steering: 0.2, ..Controls::default() })?;
        water.add_grid(GridDesc { follow: Follow::Body(body), ..preset.grid() })?;
        Ok(Self { water, store })
    }

    fn tick(&mut self) -> Result<(), CaseError> {
        for tick in self.water.advance(FRAME) {
            self.water.tick(tick, &mut self.store)?;
        }
        Ok(())
    }
}

/// Mean square slope of the modes.
fn slopes(ocean: &Ocean) -> f64 {
    let of = |modes: &ocean_spectrum::CascadeModes| {
        let cells = modes.amp.iter().enumerate().map(|(cell, amp)| {
            let [i, j] = [cell as u32 % modes.size, cell as u32 / modes.size].map(|n| f64::from(modes.signed(n)));
            (i * i + j * j) * (f64::from(amp[0]).powi(2) + f64::from(amp[1]).powi(2))
        });
        2.0 * modes.step().powi(2) * cells.sum::<f64>()
    };
    ocean.modes().iter().map(of).sum()
}

/// MiB of textures and buffers on the device, sea and grid, by their sizes.
fn device_mib(preset: Preset) -> f64 {
    let (water, grid) = (preset.water(), preset.grid());
    let size = water.cascades.iter().map(|cascade| cascade.size).max().unwrap_or(0);
    let texels = water.cascades.len() as f64 * f64::from(size).powi(2);
    // Fields and half done transforms, looks with mips, foam, modes of two seas; drawn heights.
    let sea = texels * (2.0 * 2.0 * 16.0 + 2.0 * 8.0 * 4.0 / 3.0 + 4.0 + 2.0 * 20.0);
    (sea + 8.0 * f64::from(grid.cells[0]) * f64::from(grid.cells[1])) / f64::from(1 << 20)
}

fn round(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

fn presets(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    let mut before = None;
    for preset in LADDER {
        let mut boat = Boat::new(context, preset)?;
        for _ in 0..context.pick(60, 240) {
            boat.tick()?;
        }
        let tick = measure(context.effort, || {
            let _ = boat.tick();
        });
        let water = &mut boat.water;
        let frame = measure(context.effort, || {
            let _ = water.advance(FRAME / 16.0);
            let _ = draw(gpu, water);
        });
        let (grid, desc) = (preset.grid(), preset.water());
        let ocean = water.ocean().ok_or("a calm sea")?;
        let spectrum = ocean.spectrum();
        let variance = f64::from(ocean.significant_height() / 4.0).powi(2);
        let lost = 100.0 * (1.0 - variance / spectrum.variance()).max(0.0);
        // Waves down to 2 mm, where capillaries begin.
        let all = spectrum.hidden_slope(1e6) - spectrum.hidden_slope(1e-3);
        let slope = 100.0 * (1.0 - slopes(ocean) / all).max(0.0);
        let cost = tick.median_ns + frame.median_ns;
        let step = before.replace(cost).map_or(1.0, |before: f64| cost / before);
        rows.push(
            Row::new("frame_presets", format!("{preset:?}"))
                .param("cascades", desc.cascades.len())
                .param("size", desc.cascades[0].size)
                .param("tile_m", f64::from(desc.cascades[0].tile))
                .param("grid_cells", grid.cells[0])
                .param("cell_m", f64::from(grid.cell_size[0]))
                .param("shortest_wave_m", round(6.0 * f64::from(grid.cell_size[0])))
                .param("tick_ms", round(tick.median_ns * 1e-6))
                .param("frame_ms", round(frame.median_ns * 1e-6))
                .param("times_the_one_before", round(step))
                .param("device_mib", round(device_mib(preset)))
                .param("height_variance_left_out_percent", round(lost))
                .error(slope, "%", "mean square slope of the sea's waves from 2 mm on: left to roughness")
                .bound(100.0)
                .time("a tick: sea, boat, grid", &tick)
                .note(format!("drawn on {}", gpu.adapter.kind)),
        );
    }
    Ok(rows)
}

fn change(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let at: Vec<Vec2> = (0..256).map(|i| Vec2::new(1.7 * (i % 16) as f32, 1.9 * (i / 16) as f32 + 60.0)).collect();
    let mut rows = Vec::new();
    for name in ["change_sea", "set_choppiness", "set_quality to High", "set_quality back"] {
        let start = if name.ends_with("back") { Preset::High } else { Preset::Medium };
        let mut boat = Boat::new(context, start)?;
        let mut heights = vec![WaterSample::default(); at.len()];
        let mut last: Option<Vec<f32>> = None;
        // Worst tick, worst plan and encode in milliseconds, largest step in metres; before and during.
        let mut worst = [[0.0f64; 3]; 2];
        let mut call = 0.0;
        for frame in 0..300 {
            if frame == 100 {
                let now = Instant::now();
                match name {
                    "change_sea" => {
                        boat.water.change_sea(ocean_spectrum::SeaState::height_period(2.4, 8.0, 0.5), 2.0)?
                    }
                    "set_choppiness" => boat.water.set_choppiness(0.5, 2.0)?,
                    "set_quality back" => boat.water.set_quality(Preset::Medium)?,
                    _ => boat.water.set_quality(Preset::High)?,
                }
                call = now.elapsed().as_secs_f64() * 1e3;
            }
            let begin = Instant::now();
            boat.tick()?;
            let ticked = begin.elapsed().as_secs_f64() * 1e3;
            let water = &mut boat.water;
            let begin = Instant::now();
            let plan = water.plan(&super::facade::view(), open_water::Consumers::NORMALS);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            water.encode(&plan, &mut encoder);
            let encoded = begin.elapsed().as_secs_f64() * 1e3;
            gpu.queue.submit([encoder.finish()]);
            gpu.wait()?;
            water.sample(&at, &mut heights);
            let now: Vec<f32> = heights.iter().map(|sample| sample.height).collect();
            let step = last.iter().flatten().zip(&now).fold(0.0f64, |m, (a, b)| m.max(f64::from((a - b).abs())));
            last = Some(now);
            if frame >= 20 {
                let worst = &mut worst[usize::from(frame >= 100)];
                for (worst, now) in worst.iter_mut().zip([ticked, encoded, step]) {
                    *worst = worst.max(now);
                }
            }
        }
        let [usual, during] = worst;
        rows.push(
            Row::new("frame_change", name)
                .param("call_ms", round(call))
                .param("worst_tick_ms", round(during[0]))
                .param("usual_worst_tick_ms", round(usual[0]))
                .param("worst_encode_ms", round(during[1]))
                .param("usual_worst_encode_ms", round(usual[1]))
                .error(
                    during[2] / usual[2],
                    "of the usual",
                    "largest step of a height from tick to tick before the change",
                )
                .bound(2.0),
        );
    }
    Ok(rows)
}

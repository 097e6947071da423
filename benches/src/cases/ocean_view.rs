//! Cases `gpu_vs_cpu_seas` (what is drawn against what is felt, calm to storm) and `view_vs_query` (filtered half-float
//! looks against the exact surface).

use glam::Vec2;
use ocean_spectrum::gpu::{GpuOcean, surface_layout};
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, OceanSample, SeaState};
use open_water::{BodyStates, OpenWater, OpenWaterDesc, WaterSample};
use open_water_shaders::{ocean::SURFACE_PROBE, pipeline};

use super::facade::{draw, probe};
use crate::{
    evidence::{Axis, Case, CaseError, Context, Gpu, Plot, Row},
    fixtures::{self, FRAME, Random},
};

/// See the module.
pub(super) const SEAS: Case = Case {
    name: "gpu_vs_cpu_seas",
    about: "surface_at on the GPU against the CPU's answer at 100,000 points, from calm to storm",
    plots: &[],
    run: seas,
};

/// See the module.
pub(super) const VIEW: Case = Case {
    name: "view_vs_query",
    about: "half-float looks against the exact heights and slopes, by the footprint they are filtered to",
    plots: &[Plot {
        file: "view_vs_query",
        title: "Heights of the looks against the exact surface",
        x: Axis::Param("footprint_m"),
        y: Axis::Error,
        label: Some("level_of_cascade_2"),
    }],
    run: view,
};

fn scattered(count: usize, reach: f64) -> Vec<Vec2> {
    let mut random = Random::new(8);
    let mut place = || random.within(-reach, reach) as f32;
    (0..count).map(|_| Vec2::new(place(), place())).collect()
}

fn seas(context: &Context) -> Result<Vec<Row>, CaseError> {
    const POINTS: usize = 100_000;
    let gpu = context.gpu()?;
    let points = scattered(POINTS, 2000.0);
    let mut rows = Vec::new();
    let states = [
        ("light air", 2.5, 20e3),
        ("breeze", 6.0, 80e3),
        ("fresh breeze", 10.0, 100e3),
        ("near gale", 16.0, 300e3),
        ("storm", 25.0, 500e3),
    ];
    for (name, wind, fetch) in states {
        let desc = OpenWaterDesc { sea: SeaState::wind(wind, fetch, 0.4), seed: 3, ..OpenWaterDesc::default() };
        let mut water = OpenWater::new(&gpu.device, &gpu.queue, desc)?;
        let mut bodies = BodyStates::default();
        let mut tick = |water: &mut OpenWater| -> Result<(), CaseError> {
            for tick in water.advance(FRAME) {
                water.tick(tick, &mut bodies)?;
            }
            Ok(())
        };
        for _ in 0..10 {
            tick(&mut water)?;
        }
        let mut truth = vec![WaterSample::default(); POINTS];
        water.sample(&points, &mut truth);
        // With nothing left over, a frame draws the tick before its last one: that of the answers.
        tick(&mut water)?;
        draw(gpu, &mut water)?;
        let made = probe(gpu, &water, &points)?;
        let hs = f64::from(water.ocean().map_or(0.0, Ocean::significant_height));
        let (mut worst, mut square, mut folded) = (0.0f64, 0.0, 0usize);
        for (made, truth) in made.iter().zip(&truth) {
            if truth.folded {
                folded += 1;
                continue;
            }
            let difference = f64::from(made[0] - truth.height).abs();
            worst = if difference.is_nan() { f64::NAN } else { worst.max(difference) };
            square += difference * difference;
        }
        rows.push(
            Row::new("gpu_vs_cpu_seas", name)
                .param("points", POINTS)
                .param("wind_m_s", wind)
                .param("hs_m", (hs * 1e3).round() / 1e3)
                .param("folded_points_left_out", folded)
                .param("rms_mm", ((square / POINTS as f64).sqrt() * 1e6).round() / 1e3)
                .error(worst * 1e3, "mm", "the CPU's answers from the same modes; worst point")
                .bound(f64::max(1.0, hs)),
        );
    }
    Ok(rows)
}

/// Height, and slopes along x and z, of the looks at rest points, filtered to a footprint.
fn looks(gpu: &Gpu, ocean: &Ocean, time: f64, points: &[Vec2], footprint: f32) -> Result<Vec<[f64; 3]>, CaseError> {
    let device = &gpu.device;
    let mut gpu_ocean = GpuOcean::new(device, ocean)?;
    let layout = surface_layout(device);
    let group = gpu_ocean.surface_bind_group(device, &layout);
    let slots = [pipeline::Slot::Read, pipeline::Slot::ReadWrite];
    let own = pipeline::group_layout(device, "probe", wgpu::ShaderStages::COMPUTE, &slots);
    let probe = pipeline::compute_pipeline(device, &SURFACE_PROBE, "ocean_surface_probe", &[&layout, &own], &[]);
    let buffer = |bytes: usize| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("probe"),
            size: bytes as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    };
    let (asked, answers) = (buffer(16 * points.len()), buffer(32 * points.len()));
    let bytes: Vec<u8> = points.iter().flat_map(|p| [p.x, p.y, footprint, 0.0]).flat_map(f32::to_le_bytes).collect();
    gpu.queue.write_buffer(&asked, 0, &bytes);
    let own_group =
        pipeline::bind_group(device, "probe", &own, &[asked.as_entire_binding(), answers.as_entire_binding()]);
    gpu.frame(|frame| {
        gpu_ocean.encode(frame, ocean, time, 0.0);
        let mut pass = frame.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&probe);
        pass.set_bind_group(0, &group, &[]);
        pass.set_bind_group(1, &own_group, &[]);
        pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
    })?;
    let answer = |[_, height, _, _, x, y, z, _]: &[f32; 8]| {
        // What keeps normals from lying down: s / sqrt(1 + s^2 / 1.44), undone.
        let slope = [-x / y, -z / y].map(f64::from);
        let undo = 1.0 / (1.0 - (slope[0] * slope[0] + slope[1] * slope[1]) / 1.44).max(1e-6).sqrt();
        [f64::from(*height), slope[0] * undo, slope[1] * undo]
    };
    Ok(gpu.read_buffer(&answers)?.as_chunks::<8>().0.iter().map(answer).collect())
}

fn view(context: &Context) -> Result<Vec<Row>, CaseError> {
    const TIME: f64 = 100.0;
    let gpu = context.gpu()?;
    // Without horizontal displacement a rest point is a world point, and the gradient the slope.
    let flat = |cascades: &[f32]| OceanDesc {
        cascades: cascades.iter().map(|&tile| CascadeDesc::new(256, tile)).collect(),
        choppiness: 0.0,
        ..fixtures::ocean(256)
    };
    let mut rows = Vec::new();
    let mut compare = |variant: &str, desc: OceanDesc, points: &[Vec2], footprint: f32| -> Result<(), CaseError> {
        let mut ocean = Ocean::new(desc)?;
        ocean.set_time(TIME);
        let hs = f64::from(ocean.significant_height());
        let mut truth = vec![OceanSample::default(); points.len()];
        ocean.sample(points, &mut truth);
        let made = looks(gpu, &ocean, TIME, points, footprint)?;
        let mut sums = [0.0; 3];
        let mut most = [0.0f64; 2];
        for (made, truth) in made.iter().zip(&truth) {
            let n = truth.normal;
            let slope = [-n.x / n.y, -n.z / n.y].map(f64::from);
            let height = (made[0] - f64::from(truth.height)).abs();
            let off = (made[1] - slope[0]).hypot(made[2] - slope[1]);
            sums[0] += height * height;
            sums[1] += off * off;
            sums[2] += slope[0] * slope[0] + slope[1] * slope[1];
            most = [most[0].max(height), most[1].max(off)];
        }
        let percent = |value: f64| (value * 1e6).round() / 1e4;
        let level = (footprint * 256.0 / 72.4).log2().max(0.0);
        rows.push(
            Row::new("view_vs_query", variant)
                .param("points", points.len())
                .param("footprint_m", (f64::from(footprint) * 1e4).round() / 1e4)
                .param("level_of_cascade_2", (f64::from(level) * 10.0).round() / 10.0)
                .param("largest_height_percent", percent(most[0] / hs))
                .param("slope_rms_percent", percent((sums[1] / sums[2]).sqrt()))
                .param("largest_slope_error", percent(most[1]) / 100.0)
                .error(100.0 * (sums[0] / points.len() as f64).sqrt() / hs, "% of Hs", "the CPU's heights; rms"),
        );
        Ok(())
    };
    // At texels nothing is interpolated.
    let texels: Vec<Vec2> =
        (0..65_536).step_by(7).map(|i| Vec2::new((i % 256) as f32, (i / 256) as f32) * (72.4 / 256.0)).collect();
    compare("half floats alone, at texels", flat(&[72.4]), &texels, 0.0)?;
    let points = scattered(context.pick(5_000, 50_000), 500.0);
    let footprints: &[f32] =
        context.pick(&[0.02, 0.1, 0.3, 1.0, 3.0], &[0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.5, 3.0, 6.0]);
    for &footprint in footprints {
        compare("bilinear and filtered", flat(&[485.0, 72.4, 10.8]), &points, footprint)?;
    }
    Ok(rows)
}

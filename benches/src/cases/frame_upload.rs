//! Case `frame_upload`: what of a boat's grid goes to the device in a frame, against all of it.

use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::SeaState;
use open_water::{
    BodyDesc, BodyState, BodyStates, Consumers, Controls, Follow, GridDesc, GridId, OpenWater, OpenWaterDesc, Preset,
    Rain,
};
use wave_grid::WaveGrid;

use super::facade::{draw, probe, view};
use crate::evidence::{Case, CaseError, Context, Gpu, Row, measure_together};
use crate::fixtures::{FRAME, boat_hull};

/// See the module.
pub(super) const UPLOAD: Case = Case {
    name: "frame_upload",
    about: "a frame of a grid of 384 x 384 cells: bytes and time of what has changed against all of it, and the difference",
    plots: &[],
    run,
};

const CELLS: u32 = 384;
/// Cells of a row that goes up in part, to see what a copy costs.
const PART: usize = 64;

struct Scene {
    water: OpenWater,
    bodies: BodyStates,
    grid: GridId,
}

impl Scene {
    /// A boat under power or at rest on calm water, or rain.
    fn new(gpu: &Gpu, throttle: f32, rain: bool) -> Result<Self, CaseError> {
        let sea = SeaState { partitions: Vec::new(), depth: None };
        let mut water = OpenWater::new(&gpu.device, &gpu.queue, OpenWaterDesc { sea, ..OpenWaterDesc::default() })?;
        let mut bodies = BodyStates::default();
        let boat = water.add_body(BodyDesc::boat(&boat_hull()?, 1500.0, 8.0))?;
        water.set_controls(boat, Controls { throttle, steering: 0.3, ..Controls::default() })?;
        bodies.insert(boat, BodyState::at_rest(Vec3::Y * (water.body(boat)?.rest_height() + 0.1)));
        let follow = if rain { Follow::Fixed(DVec2::ZERO) } else { Follow::Body(boat) };
        let rain = rain.then_some(Rain { rate: 20.0, drop_radius: 5e-3, seed: 1 });
        let grid = water.add_grid(GridDesc { follow, rain, cells: [CELLS; 2], ..Preset::Medium.grid() })?;
        Ok(Self { water, bodies, grid })
    }

    /// Runs and draws frames; returns the mean of the bytes that went up.
    fn frames(&mut self, gpu: &Gpu, count: usize, drawn: usize) -> Result<f64, CaseError> {
        let mut bytes = 0;
        for frame in 0..count {
            for tick in self.water.advance(FRAME) {
                self.water.tick(tick, &mut self.bodies)?;
            }
            if frame + drawn >= count {
                bytes += self.water.plan(&view(), Consumers::empty()).upload_bytes();
                draw(gpu, &mut self.water)?;
            }
        }
        Ok(bytes as f64 / drawn as f64)
    }

    /// Largest difference of the drawn heights from those after an upload of all to the device made anew, m.
    fn error(&mut self, gpu: &Gpu) -> Result<f64, CaseError> {
        let window = self.water.grid(self.grid)?.ok_or("a grid on the device")?.window();
        let corner = window.local_corner(DVec2::ZERO);
        let points: Vec<Vec2> = (0..20_000)
            .map(|i| {
                corner
                    + CELLS as f32 * window.cell_size[0] * Vec2::new(i as f32 * 0.618_034, i as f32 * 0.414_214).fract()
            })
            .collect();
        let parts = probe(gpu, &self.water, &points)?;
        self.water.replace_device(&gpu.device, &gpu.queue)?;
        draw(gpu, &mut self.water)?;
        let whole = probe(gpu, &self.water, &points)?;
        let apart = parts.iter().flatten().zip(whole.iter().flatten()).map(|(a, b)| f64::from((a - b).abs()));
        Ok(apart.fold(0.0, |most, apart| if apart > most || apart.is_nan() { apart } else { most }))
    }
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let target = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("heights"),
        size: u64::from(CELLS * CELLS) * 8,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut cells = vec![[0.0f32; 2]; (CELLS * CELLS) as usize];
    let mut rows = Vec::new();
    for (name, throttle, rain) in
        [("a boat at rest in calm water", 0.0, false), ("its wake", 1.0, false), ("rain everywhere", 0.0, true)]
    {
        let mut scene = Scene::new(gpu, throttle, rain)?;
        let bytes = scene.frames(gpu, context.pick(150, 600), 40)?;
        let error = scene.error(gpu)?;
        scene.frames(gpu, 2, 2)?;
        let waves = scene.water.grid(scene.grid)?.ok_or("a grid on the device")?.clone();
        let mut parts = || {
            // A new moment each time, or there would be nothing to upload.
            let _ = scene.water.advance(FRAME / 64.0);
            let _ = draw(gpu, &mut scene.water);
        };
        let mut whole = || {
            let _ = gpu.frame(|frame| {
                waves.draw(0.5, &mut cells);
                frame.write(&target, 0, bytemuck::cast_slice(&cells));
            });
        };
        let [parts, whole] = measure_together(context.effort, [&mut parts, &mut whole]);
        rows.push(
            Row::new("frame_upload", name)
                .param("KiB_a_frame", (bytes / 10.24).round() / 100.0)
                .param("KiB_of_the_whole", f64::from(CELLS * CELLS) / 128.0)
                .error(error, "m or 1", "heights and normals after an upload of all, 20,000 points")
                .bound(0.0)
                .time("plan, encode, submit, wait", &parts)
                .baseline("all drawn and uploaded by hand in one copy", &whole),
        );
    }
    rows.push(copies(context, gpu, &target, &mut cells)?);
    Ok(rows)
}

/// What a copy costs, in cells that could be uploaded in that time.
fn copies(context: &Context, gpu: &Gpu, target: &wgpu::Buffer, cells: &mut [[f32; 2]]) -> Result<Row, CaseError> {
    let waves = WaveGrid::new(wave_grid::GridDesc { cells: [CELLS; 2], ..Default::default() })?;
    let upload = |cells: &mut [[f32; 2]], count: usize, copies: usize| {
        let _ = gpu.frame(|frame| {
            waves.draw(0.5, &mut cells[..count]);
            let Some(room) = frame.room(8 * count as u64) else { return };
            frame.fill(room, 0, bytemuck::cast_slice(&cells[..count]));
            let bytes = 8 * (count / copies) as u64;
            // Gaps between them, as between rows.
            (0..copies as u64).for_each(|k| frame.copy(room, [k * bytes, bytes], target, k * u64::from(CELLS) * 8));
        });
    };
    let (few, all, rows) = (PART * CELLS as usize, cells.len(), CELLS as usize);
    let others = &mut [cells.to_vec(), cells.to_vec()];
    let [second, third] = others;
    let timings = measure_together(
        context.effort,
        [&mut || upload(cells, few, rows), &mut || upload(second, few, 1), &mut || upload(third, all, 1)],
    );
    let [many, one, whole] = timings.each_ref().map(|timing| timing.median_ns);
    let cell = (whole - one) / (all - few) as f64;
    Ok(Row::new("frame_upload", "a copy for each row")
        .param("copies", rows)
        .param("cells_of_each", PART)
        .param("ns_a_copy", ((many - one) / rows as f64).round())
        .param("ns_a_cell", (cell * 1e3).round() / 1e3)
        .param("cells_a_copy_is_worth", ((many - one) / rows as f64 / cell).round())
        .time("384 copies of 64 cells, drawn, uploaded, waited for", &timings[0])
        .baseline("one copy of as many", &timings[1]))
}

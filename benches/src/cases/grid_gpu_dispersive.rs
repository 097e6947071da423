//! Cases `grid_gpu_dispersive_error` (the dispersive scheme on the GPU against the CPU's) and `grid_gpu_dispersive` (its
//! sub-steps and ticks beside the wave equation's).

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::gpu::{GpuGridId, GpuGrids};
use wave_grid::{CellKind, GridDesc, GridSample, Medium, MediumCell, Scheme, Source, WaveGrid};

use crate::evidence::{Case, CaseError, Context, Gpu, Row, Timing, fastest};

/// See the module.
pub(super) const ERROR: Case = Case {
    name: "grid_gpu_dispersive_error",
    about: "a dispersive grid on the GPU against one on the CPU: open water, walls over a slope, a window that moves",
    plots: &[],
    run: error,
};

/// See the module.
pub(super) const COST: Case = Case {
    name: "grid_gpu_dispersive",
    about: "the dispersive scheme on the GPU beside the wave equation: sub-steps, ticks, dispatches, memory",
    plots: &[],
    run: cost,
};

/// Pillars over a slope east of x = 10 m.
struct Slope;

impl Medium for Slope {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let cell = (place / 5.0).floor();
        let pillar = place.x > 10.0 && (cell.x + 2.0 * cell.y).rem_euclid(5.0) == 0.0;
        let depth = if place.x > 10.0 { 40.0 * (-0.15 * (place.x as f32 - 10.0)).exp() + 0.3 } else { f32::INFINITY };
        let kind = if pillar { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, depth, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 10.0
    }

    fn is_deep(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 10.0
    }
}

fn error(context: &Context) -> Result<Vec<Row>, CaseError> {
    const TICKS: usize = 600;
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for (variant, walls, speed) in
        [("open water", false, 0.0), ("walls over a slope", true, 0.0), ("a window that moves", false, 6.0)]
    {
        let desc = GridDesc { cells: [128, 112], scheme: Scheme::Dispersive, ..GridDesc::default() };
        let medium = walls.then(|| Arc::new(Slope) as Arc<dyn Medium>);
        let mut cpu = WaveGrid::new(desc)?;
        cpu.set_medium(medium.clone());
        let mut grids = GpuGrids::new(&gpu.device);
        grids.set_medium(medium);
        let id = grids.insert(desc)?;
        let points: Vec<Vec2> = (0..4096).map(|k| Vec2::new((k % 64) as f32 * 1.4, (k / 64) as f32) - 32.0).collect();
        let mut samples = vec![GridSample::default(); points.len()];
        let [mut worst, mut most] = [0.0f32; 2];
        for t in 0..TICKS {
            let time = t as f64 / 60.0;
            // To and fro.
            let middle = DVec2::new(2.0 * speed * (0.5 * time).sin(), speed * (0.3 * time).sin());
            cpu.center_on(middle);
            grids.center_on(id, middle);
            let center = middle.as_vec2() + Vec2::from_angle(3.0 * time as f32) * 4.0;
            let volume = 0.4 * (14.0 * time as f32).sin();
            let pressure = Source::Pressure { center: -center, radius: 2.0, pressure: 1500.0 };
            for source in [Source::Displacement { center, radius: 1.2, volume }, pressure] {
                cpu.add(source);
                grids.add(id, source);
            }
            cpu.tick();
            grids.tick();
            let asked = t % 50 == 49;
            gpu.frame(|frame| {
                grids.encode(frame);
                if asked {
                    grids.encode_query(frame, &points);
                }
            })?;
            if asked {
                let answer = grids.poll_query(&gpu.device).ok_or("the query did not come back")?;
                cpu.sample(&points, &mut samples);
                for (ours, theirs) in answer.samples.iter().zip(&samples) {
                    // NaN counts as worst.
                    let difference = (ours.height - theirs.height).abs();
                    worst = if difference <= worst { worst } else { difference };
                    most = most.max(theirs.height.abs());
                }
            }
        }
        rows.push(
            Row::new(ERROR.name, variant)
                .param("ticks", TICKS)
                .param("highest_m", f64::from(most))
                .error(f64::from(worst / most), "of the highest wave", "the CPU's grid, 4096 points every 50 ticks")
                .bound(1e-5),
        );
    }
    Ok(rows)
}

/// A grid with waves everywhere, in ticks so short that they stay so.
fn awake(gpu: &Gpu, cells: u32, scheme: Scheme, substeps: u32) -> Result<(GpuGrids, GpuGridId), CaseError> {
    let (tick, substeps) = (0.0005, Some(substeps));
    let desc = GridDesc { cells: [cells; 2], scheme, tick, substeps, ..GridDesc::default() };
    let mut grids = GpuGrids::new(&gpu.device);
    let id = grids.insert(desc)?;
    let tiles = cells / 16;
    for k in 0..tiles * tiles {
        // Clear of the border.
        let middle = |tile: u32| ((16 * tile) as f32 + 8.0).clamp(24.0, cells as f32 - 24.0);
        let center = 0.5 * (Vec2::new(middle(k % tiles), middle(k / tiles)) - cells as f32 / 2.0);
        grids.add(id, Source::Displacement { center, radius: 3.5, volume: 5.0 });
    }
    for _ in 0..4 {
        run_ticks(gpu, &mut grids, 1)?;
    }
    Ok((grids, id))
}

fn run_ticks(gpu: &Gpu, grids: &mut GpuGrids, ticks: usize) -> Result<(), CaseError> {
    for _ in 0..ticks {
        grids.tick();
    }
    gpu.frame(|frame| grids.encode(frame))
}

fn cost(context: &Context) -> Result<Vec<Row>, CaseError> {
    /// More sub-steps in one submission than in the other, so that what submitting costs can be taken off.
    const MORE: u32 = 8;
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for &cells in context.pick(&[256u32, 512][..], &[256, 512, 1024]) {
        let (mut one, id) = awake(gpu, cells, Scheme::Dispersive, 1)?;
        let (mut many, _) = awake(gpu, cells, Scheme::Dispersive, 1 + MORE)?;
        let (mut wave, wave_id) = awake(gpu, cells, Scheme::NinePoint, 1)?;
        let (mut wave_many, _) = awake(gpu, cells, Scheme::NinePoint, 1 + MORE)?;
        let dispatches = |grids: &mut GpuGrids| -> Result<f64, CaseError> {
            grids.tick();
            let count = grids.pending_dispatches();
            run_ticks(gpu, grids, 0)?;
            Ok(count as f64)
        };
        let [few, all] = [dispatches(&mut one)?, dispatches(&mut many)?];
        let [of_wave, all_of_wave] = [dispatches(&mut wave)?, dispatches(&mut wave_many)?];
        let found = fastest(
            context.effort,
            [
                &mut || drop(run_ticks(gpu, &mut one, 1)),
                &mut || drop(run_ticks(gpu, &mut many, 1)),
                &mut || drop(run_ticks(gpu, &mut wave, 1)),
                &mut || drop(run_ticks(gpu, &mut wave_many, 1)),
            ],
        )
        .map(|timing| timing.median_ns);
        let share =
            |grids: &GpuGrids, id| f64::from(grids.active_tiles(id).unwrap_or(0)) / f64::from(cells * cells / 256);
        let per_cell = |grids: &GpuGrids, id| grids.bytes(id) as f64 / f64::from(cells * cells);
        let timing = |ns: f64| Timing { median_ns: ns.max(1.0), spread_ns: 0.0, repeats: 1 };
        let [ours, theirs] = [found[1] - found[0], found[3] - found[2]].map(|ns| ns / f64::from(MORE));
        let row = |variant: &str, ours: f64, theirs: f64| {
            Row::new(COST.name, format!("{variant}, {cells} x {cells}"))
                .param("cells", cells)
                .param("adapter", gpu.adapter.kind.clone())
                .param("stepped_share", share(&one, id))
                .param("stepped_share_wave_equation", share(&wave, wave_id))
                .error(ours / theirs, "of the wave equation's time", "its 9-point sub-step, all tiles, the same border")
                .time("all tiles stepped; fastest", &timing(ours))
                .baseline("the 9-point wave equation's on the same device; fastest", &timing(theirs))
        };
        rows.push(
            row("one sub-step", ours, theirs)
                .param("dispatches_a_substep", (all - few) / f64::from(MORE))
                .param("dispatches_a_substep_wave_equation", (all_of_wave - of_wave) / f64::from(MORE))
                .param("bytes_a_cell", per_cell(&one, id))
                .param("bytes_a_cell_wave_equation", per_cell(&wave, wave_id)),
        );
        rows.push(row("a tick of one sub-step, list, encode, submit, wait", found[0], found[2]));
    }
    Ok(rows)
}

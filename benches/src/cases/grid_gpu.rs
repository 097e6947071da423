//! Cases `grid_gpu_step` (a sub-step on the GPU against plain loops there and on the CPU), `grid_gpu_tick` (whole ticks)
//! and `grid_gpu_active` (a tick against the share of tiles that hold waves).

use glam::Vec2;
use wave_grid::gpu::{GpuGridId, GpuGrids};
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use super::grid_gpu_plain::{Plain, PlainKernel};
use crate::{
    evidence::{Axis, Case, CaseError, Context, Gpu, Plot, Row, Timing, fastest},
    fixtures,
};

/// See the module.
pub(super) const STEP: Case = Case {
    name: "grid_gpu_step",
    about: "a sub-step on the GPU against a plain kernel there and a plain loop on the CPU",
    plots: &[],
    run: step,
};

/// See the module.
pub(super) const TICK: Case = Case {
    name: "grid_gpu_tick",
    about: "whole ticks of one and of eight grids on the GPU: dispatches and time",
    plots: &[],
    run: tick,
};

/// See the module.
pub(super) const ACTIVE: Case = Case {
    name: "grid_gpu_active",
    about: "a tick on the GPU against the share of tiles that are stepped",
    plots: &[Plot {
        file: "grid_gpu_active",
        title: "A tick on the GPU: time against stepped tiles",
        x: Axis::Param("tiles"),
        y: Axis::Time,
        label: Some("cells"),
    }],
    run: active,
};

/// Waves so slow that they stay where they are during a measurement, and the thinnest border.
fn slow(cells: u32, scheme: Scheme, substeps: u32) -> GridDesc {
    let (wave_speed, substeps) = (0.05, Some(substeps));
    GridDesc {
        cells: [cells; 2],
        scheme,
        wave_speed,
        substeps,
        border: Border::Absorbing { width: 4 },
        ..fixtures::grid()
    }
}

/// A grid with waves in the tiles of a square with `share` of its area, from a corner on.
fn awake(gpu: &Gpu, desc: GridDesc, share: f64) -> Result<(GpuGrids, GpuGridId), CaseError> {
    let mut grids = GpuGrids::new(&gpu.device);
    let id = grids.insert(desc)?;
    let tiles = desc.cells[0] / 16;
    let [x, z] = desc.cell_size;
    let across = (share.sqrt() * f64::from(tiles)).round() as u32;
    for k in 0..across * across {
        // Clear of the border.
        let middle = |tile: u32| ((16 * tile) as f32 + 8.0).clamp(18.0, desc.cells[0] as f32 - 18.0);
        let at = Vec2::new(middle(k % across), middle(k / across)) - desc.cells[0] as f32 / 2.0;
        let center = at * Vec2::new(x, z);
        grids.add(id, Source::Displacement { center, radius: 6.0 * x, volume: 0.1 * x * z });
    }
    for _ in 0..3 {
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

fn timing(ns: f64) -> Timing {
    Timing { median_ns: ns.max(1.0), spread_ns: 0.0, repeats: 1 }
}

fn step(context: &Context) -> Result<Vec<Row>, CaseError> {
    /// More sub-steps in one submission than in the other, so that what submitting costs can be taken off.
    const MORE: u32 = 8;
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for &cells in context.pick(&[512u32][..], &[512, 1024]) {
        for (variant, scheme) in [("5-point", Scheme::FivePoint), ("9-point", Scheme::NinePoint)] {
            let (mut one, _) = awake(gpu, slow(cells, scheme, 1), 1.0)?;
            let (mut many, id) = awake(gpu, slow(cells, scheme, 1 + MORE), 1.0)?;
            let stepped = f64::from(many.active_tiles(id).unwrap_or(0)) / f64::from(cells * cells / 256);
            let kernel = PlainKernel::new(gpu, cells);
            let mut plain = Plain::new(cells as usize, scheme);
            let found = fastest(
                context.effort,
                [
                    &mut || drop(run_ticks(gpu, &mut one, 1)),
                    &mut || drop(run_ticks(gpu, &mut many, 1)),
                    &mut || drop(kernel.run(gpu, 1)),
                    &mut || drop(kernel.run(gpu, 1 + MORE)),
                    &mut || plain.step(),
                ],
            );
            let [ours, ours_more, theirs, theirs_more, cpu] = found.map(|timing| timing.median_ns);
            let [ours, theirs] = [ours_more - ours, theirs_more - theirs].map(|ns| ns / f64::from(MORE));
            let ratio = ours / theirs;
            let row = Row::new("grid_gpu_step", variant)
                .param("cells", cells)
                .param("adapter", gpu.adapter.kind.clone())
                .param("stepped_share", stepped)
                .param("plain_kernel_times_the_cpu_loop", (theirs / cpu * 100.0).round() / 100.0)
                .error(ratio, "of a plain kernel's time", "WGSL, 5-point, a vec4 and 8 rows a thread, no border")
                .time("one sub-step of all tiles, border of 4 cells included; fastest", &timing(ours))
                .baseline("a plain f32 loop over the interior on one CPU thread; fastest", &timing(cpu));
            rows.push(row);
        }
    }
    Ok(rows)
}

fn tick(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for count in [1usize, 8] {
        let desc = fixtures::grid();
        let mut grids = GpuGrids::new(&gpu.device);
        let ids = (0..count).map(|_| grids.insert(desc)).collect::<Result<Vec<_>, _>>()?;
        let mut cpu = vec![WaveGrid::new(desc)?; count];
        let mut time = 0.0f32;
        let mut stir = |add: &mut dyn FnMut(Source)| {
            time += desc.tick;
            let center = Vec2::from_angle(0.4 * time) * 12.0;
            add(Source::Displacement { center, radius: 2.0, volume: 0.3 * (3.0 * time).sin() });
        };
        let mut on_gpu = || {
            stir(&mut |source| ids.iter().for_each(|id| _ = grids.add(*id, source)));
            grids.tick();
            let dispatches = grids.pending_dispatches();
            let _ = gpu.frame(|frame| grids.encode(frame));
            dispatches
        };
        // Until the wake fills what it will.
        let dispatches = (0..240).map(|_| on_gpu()).last().unwrap_or(0);
        let mut time = 0.0f32;
        let mut on_cpu = || {
            time += desc.tick;
            let center = Vec2::from_angle(0.4 * time) * 12.0;
            for grid in &mut cpu {
                grid.add(Source::Displacement { center, radius: 2.0, volume: 0.3 * (3.0 * time).sin() });
                grid.tick();
            }
        };
        (0..240).for_each(|_| on_cpu());
        let [ours, theirs] = fastest(context.effort, [&mut || _ = on_gpu(), &mut || on_cpu()]);
        let stepped: u32 = ids.iter().filter_map(|id| grids.active_tiles(*id)).sum();
        rows.push(
            Row::new("grid_gpu_tick", if count == 1 { "1 grid" } else { "8 grids" })
                .param("cells", desc.cells[0])
                .param("adapter", gpu.adapter.kind.clone())
                .param("dispatches", dispatches)
                .param("stepped_tiles", stepped)
                .time("a tick of all: list, encode, submit, wait; fastest", &ours)
                .baseline("the CPU's grids, the same sources; fastest", &theirs),
        );
    }
    Ok(rows)
}

fn active(context: &Context) -> Result<Vec<Row>, CaseError> {
    const MORE: usize = 8;
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for &cells in context.pick(&[512u32][..], &[256, 512, 1024]) {
        for share in [0.001, 0.05, 0.25, 0.5, 1.0] {
            let (mut grids, id) = awake(gpu, slow(cells, Scheme::NinePoint, 1), share)?;
            let grids = std::cell::RefCell::new(&mut grids);
            let run = |ticks| drop(run_ticks(gpu, &mut grids.borrow_mut(), ticks));
            let [one, more] =
                fastest(context.effort, [&mut || run(1), &mut || run(1 + MORE)]).map(|timing| timing.median_ns);
            let tiles = grids.borrow().active_tiles(id).unwrap_or(0);
            rows.push(
                Row::new("grid_gpu_active", format!("{cells} x {cells}"))
                    .param("cells", cells)
                    .param("tiles", tiles)
                    .param("of", cells * cells / 256)
                    .time(
                        "a tick of one sub-step, what submitting costs taken off",
                        &timing((more - one) / MORE as f64),
                    ),
            );
        }
    }
    Ok(rows)
}

//! `grid_prepare` and `grid_step` against the CPU grid: many ticks, moving windows, sources, several grids at once.

use glam::{DVec2, Vec2};
use wave_grid::gpu::{GpuGridId, GpuGrids};
use wave_grid::{Border, GridDesc, Scheme, Source, WaveGrid};

use crate::context::Context;

const SENTINEL: [f32; 2] = [1234.5, -4321.0];

/// A grid on both sides.
pub(crate) struct Pair {
    pub(crate) cpu: WaveGrid,
    pub(crate) id: GpuGridId,
    /// Where it is drawn in the pool; cells around it must stay the sentinel.
    base: u32,
}

pub(crate) struct Twins {
    pub(crate) gpu: GpuGrids,
    pub(crate) pairs: Vec<Pair>,
    pool: wgpu::Buffer,
}

const GAP: u32 = 5;

pub(crate) fn twins(context: &Context, descs: &[GridDesc]) -> Twins {
    let mut gpu = GpuGrids::new(&context.device);
    let mut base = GAP;
    let pairs: Vec<Pair> = descs
        .iter()
        .map(|desc| {
            let mut cpu = WaveGrid::new(*desc).unwrap();
            // Shaders make the gentler layer.
            cpu.set_matched_motion(false);
            let pair = Pair { cpu, id: gpu.insert(*desc).unwrap(), base };
            base += desc.cells[0] * desc.cells[1] + GAP;
            pair
        })
        .collect();
    Twins { gpu, pairs, pool: context.buffer(&vec![SENTINEL; base as usize]) }
}

impl Twins {
    pub(crate) fn add(&mut self, k: usize, source: Source) {
        assert_eq!(self.pairs[k].cpu.add(source), self.gpu.add(self.pairs[k].id, source));
    }

    pub(crate) fn center_on(&mut self, k: usize, target: DVec2) {
        self.pairs[k].cpu.center_on(target);
        self.gpu.center_on(self.pairs[k].id, target);
        assert_eq!(self.pairs[k].cpu.window(), self.gpu.window(self.pairs[k].id));
    }

    pub(crate) fn tick(&mut self) {
        for pair in &mut self.pairs {
            pair.cpu.tick();
        }
        assert!(self.gpu.tick());
    }

    pub(crate) fn encode(&mut self, context: &Context) {
        context.frame(|frame| self.gpu.encode(frame));
    }

    /// Largest difference of each grid's drawn heights and foam, and the largest height.
    pub(crate) fn compare(&mut self, context: &Context, alpha: f32) -> Vec<[f32; 3]> {
        let cells: u32 = (self.pool.size() / 8) as u32;
        context.queue.write_buffer(&self.pool, 0, bytemuck::cast_slice(&vec![SENTINEL; cells as usize]));
        let draws: Vec<_> = self.pairs.iter().map(|p| (p.id, p.base)).collect();
        context.frame(|frame| {
            self.gpu.encode_draw(frame, &self.pool, &draws, alpha);
        });
        let pool: Vec<[f32; 2]> = context.read(&self.pool);
        let mut expected = vec![SENTINEL; pool.len()];
        let mut worst = Vec::new();
        for pair in &self.pairs {
            let count = pair.cpu.heights().len();
            let range = pair.base as usize..pair.base as usize + count;
            pair.cpu.draw(alpha, &mut expected[range.clone()]);
            let mut most = [0.0f32; 3];
            for (gpu, cpu) in pool[range.clone()].iter().zip(&expected[range]) {
                assert!(gpu[0].is_finite() && (0.0..=1.0).contains(&gpu[1]), "{gpu:?}");
                most[0] = most[0].max((gpu[0] - cpu[0]).abs());
                most[1] = most[1].max((gpu[1] - cpu[1]).abs());
                most[2] = most[2].max(cpu[0].abs());
            }
            worst.push(most);
        }
        for gap in std::iter::once(0).chain(self.pairs.iter().map(|p| p.base as usize + p.cpu.heights().len())) {
            assert_eq!(pool[gap..gap + GAP as usize], [SENTINEL; GAP as usize], "cells beside a grid were written");
        }
        worst
    }
}

pub(crate) fn stone(x: f32, z: f32, radius: f32, volume: f32) -> Source {
    Source::Displacement { center: Vec2::new(x, z), radius, volume }
}

#[test]
fn a_thousand_ticks_equal_the_cpu() {
    let context = Context::new();
    let descs = [
        GridDesc { cells: [128, 128], wave_speed: 25.0, ..Default::default() },
        // Not a multiple of 16, a damped 5-point scheme with several sub-steps, the widest layer.
        GridDesc {
            cells: [150, 101],
            wave_speed: 40.0,
            scheme: Scheme::FivePoint,
            border: Border::Absorbing { width: 16 },
            damping: 0.1,
            ..Default::default()
        },
        GridDesc {
            cells: [96, 112],
            cell_size: [0.5, 0.8],
            wave_speed: 45.0,
            border: Border::Absorbing { width: 8 },
            ..Default::default()
        },
    ];
    let mut twins = twins(&context, &descs);
    let mut peak = [0.0f32; 3];
    for t in 0..1000 {
        let time = f64::from(t) / 60.0;
        // The second stands still, so its static profile is compared too; the third rushes about, with a teleport.
        twins.center_on(0, DVec2::new(9.0 * time, 20.0 * (0.3 * time).sin()));
        if t == 500 {
            twins.center_on(2, DVec2::new(1e5, 1e5));
        }
        twins.center_on(2, DVec2::new(if t < 500 { -80.0 } else { 60.0 } * time, 40.0 * time));
        for (k, desc) in descs.iter().enumerate() {
            let middle = twins.pairs[k].cpu.window().world_corner()
                + DVec2::new(f64::from(desc.cells[0]), f64::from(desc.cells[1])) * 0.25;
            let [x, z] = middle.as_vec2().to_array();
            let wobble = (t as f32 * 0.1).sin();
            twins.add(k, stone(x + 3.0 * wobble, z, 1.0 + 0.5 * wobble, 0.4 * (t as f32 * 0.23).sin()));
            if t % 7 == 0 {
                twins.add(k, Source::Turbulence { center: Vec2::new(x - 4.0, z + 1.0), radius: 1.5, foam: 0.3 });
            }
        }
        twins.tick();
        if t % 4 == 3 {
            twins.encode(&context);
        }
        if t % 100 == 99 {
            for (k, [height, foam, most]) in
                twins.compare(&context, if t == 999 { 1.0 } else { 0.3 }).iter().enumerate()
            {
                peak[k] = peak[k].max(*most);
                println!("tick {t} grid {k}: height {height:e} of {most}, foam {foam:e}");
                assert!(*height <= 2e-5 * peak[k] && *foam < 1e-3, "tick {t} grid {k}: {height} of {most}, {foam}");
            }
        }
    }
    assert!(peak.iter().all(|p| *p > 0.05), "{peak:?}");
}

#[test]
fn growing_keeps_the_waves() {
    let context = Context::new();
    let small = GridDesc { cells: [64, 64], wave_speed: 20.0, cell_size: [2.0; 2], tick: 0.25, ..Default::default() };
    let mut twins = twins(&context, &[small]);
    twins.add(0, stone(0.0, 0.0, 8.0, 500.0));
    for _ in 0..2 {
        twins.tick();
    }
    twins.encode(&context);
    let other = twins.gpu.insert(small).unwrap();
    twins.tick();
    twins.encode(&context);
    let [height, _, most] = twins.compare(&context, 1.0)[0];
    assert!(most > 0.01 && height <= 1e-5 * most, "{height} of {most}");
    assert!(twins.gpu.is_asleep(other));
}

#[test]
fn quiet_tiles_are_not_stepped_and_a_calm_grid_sleeps() {
    let context = Context::new();
    let desc = GridDesc { cells: [112, 96], wave_speed: 20.0, cell_size: [2.0; 2], tick: 0.25, ..Default::default() };
    let mut twins = twins(&context, &[desc]);
    let id = twins.pairs[0].id;
    twins.add(0, stone(-30.0, 0.0, 8.0, 0.5));
    let (mut ticks, mut stepped) = (0, Vec::new());
    while !twins.gpu.is_asleep(id) {
        twins.tick();
        stepped.push(twins.pairs[0].cpu.active_tiles() as u32);
        twins.encode(&context);
        // What comes back with a call is of the call before. The ends of a torus are neighbours, those of a window not.
        if ticks > 0 {
            let [gpu, cpu] = [twins.gpu.active_tiles(id).unwrap(), stepped[ticks - 1]];
            assert!(gpu <= 42 && gpu.abs_diff(cpu.min(42)) <= 6, "tick {ticks}: {gpu} tiles, the CPU {cpu}");
            assert!(ticks > 1 || (9..=20).contains(&gpu), "{gpu}");
        }
        if ticks == 6 {
            let [height, _, most] = twins.compare(&context, 1.0)[0];
            assert!(most > 1e-5 && height <= 1e-5, "{height} of {most}");
        }
        ticks += 1;
        assert!(ticks < 400);
    }
    assert!(twins.pairs[0].cpu.is_asleep());
    twins.tick();
    assert_eq!(twins.gpu.pending_dispatches(), 0, "a sleeping grid encodes nothing");
    let [height, foam, most] = twins.compare(&context, 0.5)[0];
    assert_eq!([height, foam, most], [0.0; 3], "what sleeps is zero");
    println!("asleep after {ticks} ticks: {stepped:?}");
    twins.add(0, stone(30.0, 0.0, 8.0, 500.0));
    twins.tick();
    twins.encode(&context);
    let [height, _, most] = twins.compare(&context, 1.0)[0];
    assert!(most > 0.01 && height <= 1e-5 * most && !twins.gpu.is_asleep(id), "{height} of {most}");
}

#[test]
fn ticks_survive_an_encoder_that_is_dropped() {
    let context = Context::new();
    let desc = GridDesc { cells: [80, 64], wave_speed: 20.0, cell_size: [2.0; 2], tick: 0.25, ..Default::default() };
    let mut twins = twins(&context, &[desc]);
    for t in 0..12 {
        twins.add(0, stone(t as f32, 0.0, 8.0, 50.0));
        twins.tick();
        // The first is dropped when the buffers grow to the grid's size, one is dropped after another.
        if [0, 4, 5, 9].contains(&t) {
            let mut encoder = context.device.create_command_encoder(&Default::default());
            context.upload(&mut encoder, |frame| twins.gpu.encode(frame));
            let finished = (t > 4).then(|| encoder.finish());
            drop(finished);
        } else if t != 2 {
            twins.encode(&context);
        }
        if t == 6 {
            // Grows again, in an encoder that is dropped.
            let _ = twins.gpu.insert(desc).unwrap();
            twins.tick();
            let mut encoder = context.device.create_command_encoder(&Default::default());
            context.upload(&mut encoder, |frame| twins.gpu.encode(frame));
        }
    }
    let [height, _, most] = twins.compare(&context, 1.0)[0];
    assert!(most > 0.1 && height <= 1e-5 * most, "{height} of {most}");
}

#[test]
fn bad_input_stays_bounded() {
    let context = Context::new();
    let descs = [
        GridDesc { cells: [64, 80], wave_speed: 20.0, ..Default::default() },
        GridDesc { cells: [48, 48], wave_speed: 14.0, scheme: Scheme::FivePoint, ..Default::default() },
    ];
    let mut twins = twins(&context, &descs);
    let bad = [f32::NAN, f32::INFINITY, f32::MAX, -f32::MAX, -1.0, 0.0, 1e-40, 1e9];
    let mut most = 0.0f32;
    for t in 0..240 {
        for k in 0..2 {
            let value = |n: usize| if n.is_multiple_of(3) { bad[n / 3 % 8] } else { (n % 5) as f32 - 2.0 };
            twins.add(k, stone(value(t + k), value(t / 2), value(t / 3 + 1), value(t * 7 + 2)));
            let center = Vec2::new(value(t / 5), value(t));
            twins.add(k, Source::Turbulence { center, radius: value(t * 3 + 1), foam: value(t * 5) });
            twins.center_on(k, DVec2::new(f64::from(value(t / 7)), f64::from(value(t / 11 + 4))));
        }
        twins.tick();
        twins.encode(&context);
        if t % 24 == 23 {
            // Comparing looks for what is not finite.
            most = twins.compare(&context, 1.0).iter().fold(most, |most, of| most.max(of[2]));
        }
    }
    assert!(most > 0.01 && most < 2000.0, "{most}");
}

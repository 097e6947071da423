//! The passes of dispersive grids against the CPU grid: many ticks, moving windows, walls and beds, sources, several grids at
//! once, one of the wave equation among them.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{Border, CellKind, GridDesc, GridError, Medium, MediumCell, Scheme, Source};

use crate::context::Context;
use crate::grid_step::{Twins, stone, twins};

fn dispersive(cells: [u32; 2]) -> GridDesc {
    GridDesc { cells, scheme: Scheme::Dispersive, ..Default::default() }
}

/// Two in deep and in shallow water, one of the wave equation between them.
fn descs() -> [GridDesc; 3] {
    [
        dispersive([96, 112]),
        GridDesc { cells: [64, 64], ..Default::default() },
        // Not a multiple of 16, damped, two sub-steps, the widest layer.
        GridDesc {
            depth: 2.0,
            damping: 0.1,
            substeps: Some(2),
            border: Border::Absorbing { width: 20 },
            ..dispersive([150, 101])
        },
    ]
}

/// Stirs the water in the middle of each window in tick `t`.
fn stir(twins: &mut Twins, descs: &[GridDesc], t: u32) {
    for (k, desc) in descs.iter().enumerate() {
        let middle = twins.pairs[k].cpu.window().world_corner()
            + DVec2::new(f64::from(desc.cells[0]), f64::from(desc.cells[1])) * 0.25;
        let [x, z] = middle.as_vec2().to_array();
        let wobble = (t as f32 * 0.1).sin();
        twins.add(k, stone(x + 3.0 * wobble, z, 1.0 + 0.5 * wobble, 0.8 * (t as f32 * 0.23).sin()));
        if desc.scheme == Scheme::Dispersive {
            let pressure = 2000.0 * (t as f32 * 0.05).cos();
            twins.add(k, Source::Pressure { center: Vec2::new(x, z - 3.0), radius: 2.0, pressure });
        }
        if t.is_multiple_of(7) {
            twins.add(k, Source::Turbulence { center: Vec2::new(x - 4.0, z + 1.0), radius: 1.5, foam: 0.3 });
        }
    }
}

/// Ticks, encodes now and then, compares.
fn tick_and_compare(context: &Context, twins: &mut Twins, t: u32, every: u32, peaks: &mut [f32], bound: f32) {
    twins.tick();
    if t % 4 == 3 {
        twins.encode(context);
    }
    if t % every == every - 1 {
        for (k, [height, foam, most]) in twins.compare(context, 0.3).iter().enumerate() {
            peaks[k] = peaks[k].max(*most);
            println!("tick {t} grid {k}: height {height:e} of {most}, foam {foam:e}");
            assert!(*height <= bound * peaks[k] && *foam < 2e-3, "tick {t} grid {k}: {height} of {most}, {foam}");
        }
    }
}

#[test]
fn still_windows_equal_the_cpu() {
    let context = Context::new();
    let descs = descs();
    let mut twins = twins(&context, &descs);
    let mut peaks = [0.0f32; 3];
    for t in 0..320 {
        stir(&mut twins, &descs, t);
        tick_and_compare(&context, &mut twins, t, 40, &mut peaks, 1e-5);
    }
    assert!(peaks.iter().all(|p| *p > 0.05), "{peaks:?}");
}

#[test]
fn moving_windows_equal_the_cpu() {
    let context = Context::new();
    let descs = descs();
    let mut twins = twins(&context, &descs);
    let mut peaks = [0.0f32; 3];
    for t in 0..480u32 {
        let time = f64::from(t) / 60.0;
        // The first starts, stops and turns, the last rushes about, with a teleport.
        twins.center_on(0, DVec2::new(14.0 * (0.5 * time).sin(), 9.0 * (0.31 * time).sin()));
        twins.center_on(2, DVec2::new(if t < 300 { 12.0 } else { -5.0 } * time, 3.0 * time));
        if t == 400 {
            twins.center_on(2, DVec2::new(1e5, 1e5));
        }
        stir(&mut twins, &descs, t);
        tick_and_compare(&context, &mut twins, t, 40, &mut peaks, 1e-5);
    }
    assert!(peaks.iter().all(|p| *p > 0.05), "{peaks:?}");
}

/// Pillars of wall and of held water over a slope, from x = 20 m on; `salt` decides where.
struct Shoal {
    salt: u64,
}

impl Medium for Shoal {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let [x, z] = [place.x, place.y].map(|x| (x / 4.3).floor() as i64);
        let mut h = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (z as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        h = (h ^ self.salt ^ (h >> 31)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        let h = (h >> 40) as f32 / (1u64 << 24) as f32;
        let kind = match h {
            h if place.x < 20.0 || h > 0.3 => CellKind::Open,
            h if h < 0.08 => CellKind::Fixed,
            _ => CellKind::Wall,
        };
        let damping = if place.x >= 20.0 && h > 0.7 { h } else { 0.0 };
        let depth = if place.x < 20.0 { f32::INFINITY } else { 45.0 * (-0.12 * (place.x as f32 - 20.0)).exp() + 0.2 };
        MediumCell { speed: deep_speed, damping, kind, depth, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 20.0
    }

    fn is_deep(&self, _: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 20.0
    }
}

#[test]
fn walls_and_beds_equal_the_cpu() {
    let context = Context::new();
    let descs = descs();
    let mut twins = twins(&context, &descs);
    let mut peaks = [0.0f32; 3];
    for t in 0..500u32 {
        let time = f64::from(t) / 60.0;
        let shoal = |salt| Some(Arc::new(Shoal { salt }) as Arc<dyn Medium>);
        if let 20 | 260 | 420 | 440 = t {
            let medium =
                [shoal(1), shoal(5), None, shoal(1)][[20, 260, 420, 440].partition_point(|change| *change < t)].clone();
            for pair in &mut twins.pairs {
                pair.cpu.set_medium(medium.clone());
            }
            twins.gpu.set_medium(medium);
        }
        // The first enters and leaves, the last stands among the pillars.
        twins.center_on(0, DVec2::new(10.0 + 30.0 * (0.7 * time).sin(), 8.0 * (0.3 * time).sin()));
        twins.center_on(2, DVec2::new(45.0, 3.0));
        stir(&mut twins, &descs, t);
        tick_and_compare(&context, &mut twins, t, 20, &mut peaks, 1e-5);
    }
    assert!(peaks.iter().all(|p| *p > 0.05), "{peaks:?}");
}

#[test]
fn a_calm_grid_sleeps_and_wakes_without_a_memory() {
    let context = Context::new();
    // Coarse, so that it takes seconds.
    let desc = GridDesc { cell_size: [2.0; 2], tick: 1.0 / 32.0, damping: 1.0, ..dispersive([80, 64]) };
    let mut twins = twins(&context, &[desc]);
    let id = twins.pairs[0].id;
    // Beside the layer.
    twins.add(0, stone(-38.0, 0.0, 6.0, 3.0));
    let mut ticks = 0;
    while ticks == 0 || !twins.gpu.is_asleep(id) {
        twins.tick();
        twins.encode(&context);
        ticks += 1;
        if ticks == 40 {
            let [height, _, most] = twins.compare(&context, 1.0)[0];
            assert!(most > 1e-3 && height <= 2e-5 + 3e-5 * most, "{height} of {most}");
        }
        assert!(ticks < 4000);
    }
    println!("asleep after {ticks} ticks");
    for _ in 0..400 {
        twins.pairs[0].cpu.tick();
    }
    assert!(twins.pairs[0].cpu.is_asleep());
    assert_eq!(twins.compare(&context, 0.5)[0], [0.0; 3], "what sleeps is zero");
    // An encoder that is dropped and one that is not.
    for t in 0..160 {
        twins.add(0, stone(-38.0 + 0.2 * t as f32, 0.0, 6.0, 30.0));
        twins.tick();
        if t % 5 == 2 {
            let mut encoder = context.device.create_command_encoder(&Default::default());
            context.upload(&mut encoder, |frame| twins.gpu.encode(frame));
        } else {
            twins.encode(&context);
        }
    }
    let [height, _, most] = twins.compare(&context, 1.0)[0];
    assert!(most > 0.01 && height <= 3e-5 * most && !twins.gpu.is_asleep(id), "{height} of {most}");
    // The next one of its size takes its place, and finds it calm.
    twins.gpu.remove(id);
    let next = twins.gpu.insert(desc).unwrap();
    assert_eq!(next, id);
    twins.pairs[0].cpu.clear();
    for _ in 0..100 {
        twins.add(0, stone(-40.0, 10.0, 6.0, 3.0));
        twins.tick();
        twins.encode(&context);
    }
    let [height, _, most] = twins.compare(&context, 1.0)[0];
    assert!(most > 0.01 && height <= 3e-5 * most, "{height} of {most}");
}

#[test]
fn bad_input_stays_bounded_and_bad_descriptions_are_named() {
    let context = Context::new();
    let descs = [dispersive([64, 80]), GridDesc { depth: 0.05, ..dispersive([48, 48]) }];
    let mut twins = twins(&context, &descs);
    let field = |result: Result<_, GridError>| match result {
        Err(GridError::InvalidValue { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    let spectral = GridDesc { scheme: Scheme::Spectral, ..Default::default() };
    assert!(field(twins.gpu.insert(spectral)).starts_with("scheme"));
    let sponge = GridDesc { border: Border::Sponge { width: 12 }, ..descs[0] };
    assert!(field(twins.gpu.insert(sponge)).starts_with("border"));
    assert_eq!(field(twins.gpu.insert(dispersive([2304, 2304]))), "cells");
    assert!(field(twins.gpu.insert(GridDesc { substeps: Some(1), tick: 0.1, ..descs[0] })).starts_with("tick"));
    let bad = [f32::NAN, f32::INFINITY, f32::MAX, -f32::MAX, -1.0, 0.0, 1e-40, 1e9];
    let mut most = 0.0f32;
    for t in 0..240 {
        for k in 0..2 {
            let value = |n: usize| if n.is_multiple_of(3) { bad[n / 3 % 8] } else { (n % 5) as f32 - 2.0 };
            twins.add(k, stone(value(t + k), value(t / 2), value(t / 3 + 1), value(t * 7 + 2)));
            let center = Vec2::new(value(t / 5), value(t));
            twins.add(k, Source::Turbulence { center, radius: value(t * 3 + 1), foam: value(t * 5) });
            twins.add(k, Source::Pressure { center, radius: value(t * 3 + 2), pressure: value(t * 11 + 1) * 1e4 });
            twins.center_on(k, DVec2::new(f64::from(value(t / 7)), f64::from(value(t / 11 + 4))));
        }
        twins.tick();
        twins.encode(&context);
        if t % 24 == 23 {
            // Comparing looks for what is not finite.
            most = twins.compare(&context, 1.0).iter().fold(most, |most, of| most.max(of[2]));
        }
    }
    assert!(most > 0.01 && most < 20_000.0, "{most}");
}

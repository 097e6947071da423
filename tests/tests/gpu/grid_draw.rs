//! `grid_draw` against a closed form: the fade of a still field, and what it must leave alone.

use glam::{DVec2, Vec2};
use wave_grid::gpu::GpuGrids;
use wave_grid::{GridDesc, Source};

use crate::context::Context;
use crate::grid_step::{stone, twins};

#[test]
fn a_source_is_drawn_where_it_stands_with_its_volume() {
    let context = Context::new();
    let mut grids = GpuGrids::new(&context.device);
    let desc = GridDesc { cells: [100, 70], wave_speed: 0.001, ..Default::default() };
    let id = grids.insert(desc).unwrap();
    grids.center_on(id, DVec2::new(12_345.3, -777.7));
    grids.set_origin(DVec2::new(12_345.0, -777.0));
    let (at, radius, volume) = (Vec2::new(2.2, -1.4), 2.0f32, 3.0f32);
    assert!(grids.add(id, Source::Displacement { center: at, radius, volume }));
    grids.tick();
    let pool = context.buffer(&vec![[f32::NAN; 2]; 100 * 70 + 8]);
    context.frame(|frame| {
        grids.encode(frame);
        grids.encode_draw(frame, &pool, &[(id, 4)], 1.0);
    });
    let drawn: Vec<[f32; 2]> = context.read(&pool);
    assert!(drawn[..4].iter().chain(&drawn[7004..]).all(|d| d[0].is_nan()), "cells beside the grid were written");
    let window = grids.window(id);
    let corner = window.local_corner(DVec2::new(12_345.0, -777.0));
    let (mut sum, mut moment) = (0.0f64, [0.0f64; 2]);
    for j in 0..70 {
        for i in 0..100 {
            let [height, foam] = drawn[4 + j * 100 + i];
            let cell = corner + Vec2::new(i as f32 + 0.5, j as f32 + 0.5) * 0.5;
            assert!(height.is_finite() && foam == 0.0);
            assert!(height.abs() < 1e-6 || cell.distance(at) < radius + 0.75 + 1e-3);
            sum += f64::from(height) * 0.25;
            moment[0] += f64::from(height * cell.x) * 0.25;
            moment[1] += f64::from(height * cell.y) * 0.25;
        }
    }
    assert!((sum - 3.0).abs() < 1e-4, "{sum}");
    assert!((moment[0] / sum - 2.2).abs() < 0.01 && (moment[1] / sum + 1.4).abs() < 0.01, "{moment:?}");
}

#[test]
fn finer_grids_are_cut_out_on_both_sides() {
    let context = Context::new();
    let coarse = GridDesc { cells: [112, 96], ..Default::default() };
    let fine = GridDesc { cells: [128, 112], cell_size: [0.25; 2], ..Default::default() };
    let mut twins = twins(&context, &[coarse, fine, GridDesc { cells: [72, 64], ..fine }]);
    for (k, place) in [(0, DVec2::new(3.2, 1.0)), (1, DVec2::new(-4.3, 2.1)), (2, DVec2::new(-0.6, 3.4))] {
        twins.center_on(k, place);
        twins.add(k, stone(-4.3, 2.1, 3.0, 2.0));
    }
    let mut last = 0.0;
    for gain in [0.0f32, 0.6, 1.0] {
        let (cpu, gpu): (Vec<_>, Vec<_>) = (1..3)
            .map(|k| {
                let pair = &mut twins.pairs[k];
                pair.cpu.set_nested(true);
                twins.gpu.set_nested(pair.id, true);
                (pair.cpu.hole(gain), twins.gpu.hole(pair.id, gain))
            })
            .unzip();
        assert_eq!(cpu, gpu);
        twins.pairs[0].cpu.set_holes(&cpu);
        twins.gpu.set_holes(twins.pairs[0].id, &gpu);
        (0..12).for_each(|_| twins.tick());
        twins.encode(&context);
        let worst = twins.compare(&context, 0.4);
        assert!(worst.iter().all(|w| w[0] < 1e-5 && w[1] < 1e-5), "{worst:?}");
        let most = worst[0][2];
        assert!(gain != 1.0 || most < 0.5 * last, "{most} of {last}");
        last = most;
    }
}

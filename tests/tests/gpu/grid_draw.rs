//! `grid_draw` against a closed form: the fade of a still field, and what it must leave alone.

use glam::{DVec2, Vec2};
use wave_grid::gpu::GpuGrids;
use wave_grid::{GridDesc, Source};

use crate::context::Context;

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
    context.submit(|encoder| {
        grids.encode(&context.device, &context.queue, encoder);
        grids.encode_draw(&context.device, &context.queue, encoder, &pool, &[(id, 4)], 1.0);
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

//! `grid_query` against the CPU grids' samples: overlapping windows, walls, points everywhere.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, GridSample, Medium, MediumCell};

use crate::context::Context;
use crate::grid_step::{stone, twins};

/// A wall with a gap.
struct Pier;

impl Medium for Pier {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let wall = (6.0..9.0).contains(&place.x) && place.y.abs() > 3.0;
        let kind = if wall { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, low: DVec2, high: DVec2, _: f32) -> bool {
        high.x < 5.0 || low.x > 10.0
    }
}

#[test]
fn queries_answer_what_the_cpu_does_and_say_how_old_it_is() {
    let context = Context::new();
    let origin = DVec2::new(50_000.0, -20_000.0);
    let descs = [
        GridDesc { cells: [96, 80], ..Default::default() },
        GridDesc { cells: [64, 64], cell_size: [0.4, 0.6], wave_speed: 8.0, ..Default::default() },
    ];
    for medium in [None, Some(Arc::new(Pier) as Arc<dyn Medium>)] {
        // The pier stands at the world's origin.
        let origin = if medium.is_some() { DVec2::new(1.0, 2.0) } else { origin };
        let mut twins = twins(&context, &descs);
        for pair in &mut twins.pairs {
            pair.cpu.set_medium(medium.clone());
            pair.cpu.set_origin(origin);
        }
        twins.gpu.set_medium(medium);
        twins.gpu.set_origin(origin);
        twins.center_on(0, origin + DVec2::new(3.3, 1.2));
        twins.center_on(1, origin + DVec2::new(8.1, -2.0));
        for k in [0, 1] {
            twins.add(k, stone(2.0 + k as f32, -1.0, 1.5, 2.0));
        }
        let points: Vec<Vec2> = (0..3000)
            .map(|k| Vec2::new((k % 60) as f32 * 0.83 - 25.0, (k / 60) as f32 * 0.81 - 20.0))
            .chain([Vec2::NAN, Vec2::new(f32::INFINITY, 0.0), Vec2::splat(-1e9)])
            .collect();
        assert!(twins.gpu.poll_query(&context.device).is_none());
        for _ in 0..40 {
            twins.tick();
        }
        twins.encode(&context);
        context.frame(|frame| {
            assert!(twins.gpu.encode_query(frame, &points));
            assert!(!twins.gpu.encode_query(frame, &[]));
        });
        let mut expected = vec![GridSample::default(); points.len()];
        for pair in &twins.pairs {
            let mut own = expected.clone();
            pair.cpu.sample(&points, &mut own);
            for (sum, own) in expected.iter_mut().zip(own) {
                sum.height += own.height;
                sum.slope += own.slope;
                sum.vertical_velocity += own.vertical_velocity;
            }
        }
        for _ in 0..3 {
            twins.tick();
        }
        let answer = twins.gpu.poll_query(&context.device).expect("it has come after waiting");
        assert_eq!((answer.samples.len(), answer.age), (points.len(), 3));
        let [mut worst, mut most] = [[0.0f32; 3]; 2];
        for (gpu, cpu) in answer.samples.iter().zip(&expected) {
            let difference =
                [gpu.height - cpu.height, gpu.slope.distance(cpu.slope), gpu.vertical_velocity - cpu.vertical_velocity];
            let size = [cpu.height, cpu.slope.length(), cpu.vertical_velocity];
            for k in 0..3 {
                worst[k] = worst[k].max(difference[k].abs());
                most[k] = most[k].max(size[k].abs());
                assert!(difference[k].is_finite());
            }
        }
        println!("{worst:?} of {most:?}");
        assert!((0..3).all(|k| most[k] > 0.02 && worst[k] <= 1e-4 * most[k]), "{worst:?} of {most:?}");
        assert_eq!(answer.samples[3000..], [GridSample::default(); 3]);
    }
}

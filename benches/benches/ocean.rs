//! The ambient sea on the CPU: synthesis, point queries, patches.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::Vec2;
use ocean_spectrum::{Ocean, OceanSample};
use open_water_benches::fixtures::{self, Random};

fn ocean(size: u32) -> Ocean {
    Ocean::new(fixtures::ocean(size)).expect("the fixture is in bounds")
}

fn synthesis(c: &mut Criterion) {
    let mut group = c.benchmark_group("ocean/set_time");
    for size in [128, 256, 512] {
        let mut ocean = ocean(size);
        let mut time = 0.0;
        group.bench_function(BenchmarkId::from_parameter(size), |b| {
            b.iter(|| {
                time += 1.0 / 60.0;
                ocean.set_time(black_box(time));
            });
        });
    }
    group.finish();
}

fn queries(c: &mut Criterion) {
    let ocean = ocean(256);
    let mut random = Random::new(1);
    let points: Vec<Vec2> = (0..1000)
        .map(|_| Vec2::new(random.within(-300.0, 300.0) as f32, random.within(-300.0, 300.0) as f32))
        .collect();
    let mut answers = vec![OceanSample::default(); points.len()];
    c.bench_function("ocean/sample/1000", |b| b.iter(|| ocean.sample(black_box(&points), &mut answers)));
    c.bench_function("ocean/patch", |b| {
        let mut i = 0;
        b.iter(|| {
            i = (i + 1) % points.len();
            ocean.patch(black_box(points[i]), 0.5)
        });
    });
}

criterion_group!(benches, synthesis, queries);
criterion_main!(benches);

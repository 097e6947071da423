//! The ambient sea on the CPU: synthesis, point queries, patches, feeds.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec2, Vec2};
use ocean_spectrum::{AmplitudeMap, EdgeDesc, EdgeFeed, Ocean, OceanDesc, OceanSample, Outputs, SeaState};
use open_water_benches::fixtures::{self, Random};

fn ocean(size: u32) -> Ocean {
    Ocean::new(fixtures::ocean(size)).expect("the fixture is in bounds")
}

fn synthesis(c: &mut Criterion) {
    let wanted = [
        ("displacement", Outputs::default()),
        ("slopes", Outputs { slopes: true, motion: false }),
        ("all", Outputs::ALL),
    ];
    for (name, outputs) in wanted {
        let mut group = c.benchmark_group(format!("ocean/prepare/{name}"));
        for size in [128, 256, 512] {
            let mut ocean = ocean(size);
            let mut time = 0.0;
            group.bench_function(BenchmarkId::from_parameter(size), |b| {
                b.iter(|| {
                    time += 1.0 / 60.0;
                    ocean.set_time(black_box(time));
                    ocean.prepare(outputs);
                });
            });
        }
        group.finish();
    }
    let mut ocean = ocean(256);
    let windy = OceanDesc { sea: SeaState::wind(14.0, 200e3, 0.3), ..ocean.desc().clone() };
    ocean.change_to(windy, 0.0, 3600.0).expect("the same cascades");
    let mut time = 0.0;
    c.bench_function("ocean/prepare/all/changing", |b| {
        b.iter(|| {
            time += 1e-3;
            ocean.set_time(black_box(time));
            ocean.prepare(Outputs::ALL);
        });
    });
}

fn queries(c: &mut Criterion) {
    let mut ocean = ocean(256);
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
    let factors = (0..128 * 128).map(|_| [random.within(0.0, 1.0) as f32; 8]).collect();
    let map = AmplitudeMap::new(DVec2::splat(-320.0), 5.0, [128; 2], factors).expect("in bounds");
    ocean.set_amplitudes(Some(Arc::new(map)));
    c.bench_function("ocean/sample_map/1000", |b| b.iter(|| ocean.sample(black_box(&points), &mut answers)));
}

fn feeds(c: &mut Criterion) {
    let ocean = ocean(256);
    let edge = EdgeDesc {
        along_x: false,
        across: [0.0, 0.5],
        inward: 1.0,
        first: 0.0,
        step: 0.5,
        count: 300,
        wave_speed: 7.0,
        cascades: 2,
    };
    let mut feed = EdgeFeed::new(&ocean, edge).expect("in bounds");
    let (mut outside, mut inside) = (vec![0.0; 300], vec![0.0; 300]);
    let mut time = 0.0;
    c.bench_function("ocean/edge_feed/300", |b| {
        b.iter(|| {
            time += 0.25;
            feed.rows(ocean.moment_at(black_box(time)), [&mut outside, &mut inside]);
        });
    });
}

criterion_group!(benches, synthesis, queries, feeds);
criterion_main!(benches);

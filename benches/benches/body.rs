//! Bodies: a tick on flat water and on a wave, by the number of force points.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use floating_body::{AiryWave, Body, BodyDesc, Controls, FlatWater, ForcePoints, Sampling};
use open_water_benches::fixtures;

fn ticks(c: &mut Criterion) {
    let hull = fixtures::crate_hull().expect("the fixture is in bounds");
    let desc = BodyDesc::from_hull(&hull, fixtures::CRATE_MASS);
    let wave = AiryWave::new(0.5, 20.0, 0.0);
    let mut group = c.benchmark_group("body/step");
    for (name, sampling) in [("patch", Sampling::Patch), ("points", Sampling::Points)] {
        for count in [8, 32, 128] {
            let desc = BodyDesc { sampling, points: ForcePoints::Count(count), ..desc.clone() };
            let mut body = Body::new(desc).expect("the fixture is in bounds");
            group.bench_function(BenchmarkId::new(name, count), |b| {
                b.iter(|| body.step(1.0 / 60.0, black_box(&wave), &Controls::default()));
            });
        }
    }
    let mut body = Body::new(desc).expect("the fixture is in bounds");
    let flat = FlatWater::default();
    group.bench_function("flat water", |b| b.iter(|| body.step(1.0 / 60.0, black_box(&flat), &Controls::default())));
    group.finish();
    let mut sources = Vec::new();
    c.bench_function("body/displacements", |b| {
        b.iter(|| {
            sources.clear();
            body.displacements(black_box(&mut sources));
        });
    });
}

criterion_group!(benches, ticks);
criterion_main!(benches);

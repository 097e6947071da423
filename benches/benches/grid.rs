//! A grid on the CPU: ticks, shifts, sources, samples, what is drawn.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec2, Vec2};
use open_water_benches::fixtures::{self, Random};
use wave_grid::{GridDesc, GridSample, Scheme, Source, WaveGrid};

/// A window full of waves.
fn grid(desc: GridDesc) -> WaveGrid {
    let mut grid = WaveGrid::new(desc).expect("the fixture is in bounds");
    let mut random = Random::new(1);
    let cells = (desc.cells[0] * desc.cells[1]) as usize;
    let rough: Vec<f32> = (0..cells).map(|_| random.within(-0.1, 0.1) as f32).collect();
    grid.impose(&rough, &rough).expect("one value a cell");
    grid.set_tile_skipping(false);
    grid
}

fn ticks(c: &mut Criterion) {
    let mut group = c.benchmark_group("grid/tick");
    for (name, scene) in [("9-point", fixtures::grid()), ("5-point", fixtures::paper_grid())] {
        for cells in [256, 512] {
            let mut grid = grid(GridDesc { cells: [cells; 2], ..scene });
            group.bench_function(BenchmarkId::new(name, cells), |b| b.iter(|| grid.tick()));
        }
    }
    for cells in [256, 512] {
        let mut grid = grid(GridDesc { cells: [cells; 2], scheme: Scheme::Dispersive, ..GridDesc::default() });
        group.bench_function(BenchmarkId::new("dispersive", cells), |b| b.iter(|| grid.tick()));
    }
    let mut asleep = WaveGrid::new(fixtures::grid()).expect("the fixture is in bounds");
    group.bench_function("asleep", |b| b.iter(|| asleep.tick()));
    group.finish();
}

fn the_rest(c: &mut Criterion) {
    let mut grid = grid(fixtures::grid());
    let h = f64::from(grid.desc().cell_size[0]);
    let mut step = 0;
    c.bench_function("grid/shift by a cell", |b| {
        b.iter(|| {
            step += 1;
            // To and fro past the dead-band.
            grid.center_on(DVec2::new(if step % 2 == 0 { 2.5 } else { -2.5 } * h, 0.0));
        });
    });
    c.bench_function("grid/source", |b| {
        b.iter(|| grid.add(black_box(Source::Displacement { center: Vec2::ONE, radius: 0.5, volume: 1e-6 })));
    });
    let mut random = Random::new(2);
    let points: Vec<Vec2> =
        (0..1000).map(|_| Vec2::new(random.within(-20.0, 20.0) as f32, random.within(-20.0, 20.0) as f32)).collect();
    let mut answers = vec![GridSample::default(); points.len()];
    c.bench_function("grid/sample/1000", |b| b.iter(|| grid.sample(black_box(&points), &mut answers)));
    let mut drawn = vec![[0.0f32; 2]; grid.heights().len()];
    c.bench_function("grid/draw", |b| b.iter(|| grid.draw(0.5, black_box(&mut drawn))));
}

criterion_group!(benches, ticks, the_rest);
criterion_main!(benches);

//! Prints how long a tick takes for flotsam, which reads one patch, and for a boat with 32 columns.

use std::hint::black_box;
use std::time::Instant;

use floating_body::{AiryWave, Body, BodyDesc, BodyError, Controls, Hull, TriMesh};
use glam::Vec3;

fn time(name: &str, desc: BodyDesc) -> Result<(), BodyError> {
    let mut bodies = vec![Body::new(desc)?; 200];
    let controls = Controls { throttle: 0.5, steering: 0.1, ..Controls::default() };
    let mut wave = AiryWave::new(0.5, 40.0, 0.4);
    let mut told = Vec::with_capacity(10_000);
    let mut best = f64::INFINITY;
    for round in 0..20 {
        let start = Instant::now();
        for tick in 0..30 {
            wave.time = f64::from(round * 30 + tick) / 60.0;
            for body in &mut bodies {
                told.clear();
                body.step(1.0 / 60.0, &wave, &controls);
                body.displacements(&mut told);
            }
        }
        best = best.min(start.elapsed().as_secs_f64() / (30.0 * bodies.len() as f64));
    }
    black_box(&told);
    println!("{name}: {:.2} us a tick, {} force points", best * 1e6, bodies[0].force_points().len());
    Ok(())
}

fn main() -> Result<(), BodyError> {
    time("crate", BodyDesc::from_hull(&Hull::cuboid(Vec3::splat(1.0))?, 400.0))?;
    time("ball", BodyDesc::from_hull(&Hull::sphere(0.5)?, 200.0))?;
    time("log", BodyDesc::from_hull(&Hull::cylinder(0.2, 2.0)?, 150.0))?;
    let section = [(0.0, -0.5), (1.0, 0.0), (1.2, 0.7), (-1.2, 0.7), (-1.0, 0.0)];
    let mut mesh = TriMesh::default();
    for x in [-4.0, 4.0] {
        mesh.vertices.extend(section.iter().map(|(z, y)| Vec3::new(x, *y, *z)));
    }
    mesh.indices.extend((0..5).flat_map(|i| [i, (i + 1) % 5, 5 + i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i]));
    mesh.indices.extend((1..4).flat_map(|i| [0, i + 1, i, 5, 5 + i, 6 + i]));
    time("boat", BodyDesc::boat(&Hull::from_mesh(&mesh, floating_body::Closure::Require)?, 4000.0, 12.0))
}

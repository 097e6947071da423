//! Arrays are made when they are read, and are the same however they are made.

use std::hash::{DefaultHasher, Hasher};

use glam::Vec2;
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, OceanSample, Outputs};
use rayon::prelude::*;

fn sea() -> Ocean {
    let cascades = vec![CascadeDesc::new(128, 485.0), CascadeDesc::new(64, 60.0), CascadeDesc::new(32, 9.0)];
    Ocean::new(OceanDesc { cascades, seed: 4, ..Default::default() }).unwrap()
}

fn hash(ocean: &Ocean) -> u64 {
    let mut hash = DefaultHasher::new();
    for c in 0..ocean.modes().len() {
        let f = ocean.fields(c);
        for value in [f.displacement, f.derivative, f.velocity].into_iter().flatten().flatten() {
            hash.write_u32(value.to_bits());
        }
    }
    hash.finish()
}

#[test]
fn prepared_or_not_the_bits_are_equal() {
    let mut ocean = sea();
    for t in [0.0, 3.5, -8.25, 1e7] {
        let mut lazy = sea();
        lazy.set_time(t);
        let wanted = hash(&lazy);
        for slopes in [false, true] {
            for motion in [false, true] {
                ocean.set_time(99.0);
                assert_ne!(hash(&ocean), wanted);
                ocean.set_time(t);
                ocean.prepare(Outputs { slopes, motion });
                ocean.prepare(Outputs { slopes: true, motion: false });
                assert_eq!(hash(&ocean), wanted);
            }
        }
    }
}

#[test]
fn the_arrays_stay_in_place_from_time_to_time() {
    // Their memory is used again.
    let mut ocean = sea();
    let places =
        |ocean: &Ocean| [0, 1, 2].map(|c| (ocean.fields(c).displacement.as_ptr(), ocean.fields(c).velocity.as_ptr()));
    let before = places(&ocean);
    for t in [1.0, 2.0, 3.0] {
        ocean.set_time(t);
        ocean.prepare(Outputs::ALL);
        assert_eq!(places(&ocean), before);
    }
}

#[test]
fn tasks_of_rayon_may_be_the_first_to_read() {
    let points: Vec<Vec2> = (0..4000).map(|i| Vec2::new(i as f32 * 1.7, i as f32 * -0.9)).collect();
    let answer = |ocean: &Ocean, parts: usize| {
        let mut out = vec![OceanSample::default(); points.len()];
        points.par_chunks(parts).zip(out.par_chunks_mut(parts)).for_each(|(points, out)| ocean.sample(points, out));
        out
    };
    let mut prepared = sea();
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        for i in 1..8 {
            let t = f64::from(i) * 0.4;
            prepared.set_time(t);
            prepared.prepare(Outputs::ALL);
            let mut lazy = prepared.clone();
            lazy.set_time(t + 1.0);
            lazy.set_time(t);
            // Small parts are answered by the task itself, large ones by tasks of their own.
            for parts in [50, 1000] {
                assert_eq!(pool.install(|| answer(&lazy, parts)), answer(&prepared, parts));
            }
        }
    }
}

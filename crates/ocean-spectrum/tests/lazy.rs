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

/// A sea whose longest cascade is made ten times a second, and the same sea made exactly.
fn slow_and_exact() -> [Ocean; 2] {
    let mut desc = sea().desc().clone();
    let exact = Ocean::new(desc.clone()).unwrap();
    desc.cascades[0].interval = 0.1;
    [Ocean::new(desc).unwrap(), exact]
}

#[test]
fn a_slow_cascade_is_near_the_exact_one_and_exact_at_its_states() {
    let [mut slow, mut exact] = slow_and_exact();
    let count = (1024.0f64 / f64::from(0.1f32)).ceil();
    for i in [0.0, 7.0, 100.5, 1234.25, 9999.75, count - 0.5] {
        let t = i / count * 1024.0;
        slow.set_time(t);
        exact.set_time(t);
        let rms = |f: &dyn Fn(usize) -> f32| ((0..128 * 128).map(|i| f(i).powi(2)).sum::<f32>() / 128.0 / 128.0).sqrt();
        for field in 0..4 {
            for (a, b, bound) in [
                (slow.fields(0).displacement, exact.fields(0).displacement, 3e-3),
                (slow.fields(0).derivative, exact.fields(0).derivative, 1e-2),
                (slow.fields(0).velocity, exact.fields(0).velocity, 1e-2),
            ] {
                let off = rms(&|i| a[i][field] - b[i][field]) / rms(&|i| b[i][field]);
                // A state's phase is rounded to 2^-32 of the loop.
                let bound = if field == 1 { bound } else { 1e-2 };
                let (least, most) = if i.fract() == 0.0 { (0.0, 1e-5) } else { (1e-5, bound) };
                assert!((least..most).contains(&off), "{i}, field {field}: {off:e}");
            }
        }
        assert_eq!(slow.fields(1).displacement, exact.fields(1).displacement);
    }
}

#[test]
fn a_slow_cascade_knows_no_history() {
    let [mut ocean, exact] = slow_and_exact();
    let windy = OceanDesc { sea: ocean_spectrum::SeaState::wind(15.0, 200e3, 0.0), ..ocean.desc().clone() };
    // Forwards, on, backwards, far away, over the end of the loop.
    for (i, t) in [0.03, 0.05, 0.13, 0.29, 0.18, 0.11, -0.07, 500.0, 0.04, 1023.99, 1024.01].into_iter().enumerate() {
        ocean.set_time(t);
        if i % 2 == 0 {
            ocean.prepare(Outputs::ALL);
        }
        let mut fresh = Ocean::new(ocean.desc().clone()).unwrap();
        fresh.set_time(t);
        assert_eq!(hash(&ocean), hash(&fresh), "{t}");
    }
    ocean.change_to(windy.clone(), 2000.0, 60.0).unwrap();
    let mut new = Ocean::new(windy).unwrap();
    for t in [1999.97, 2060.0, 2060.03] {
        ocean.set_time(t);
        new.set_time(t);
        assert_eq!(hash(&ocean) == hash(&new), t >= 2060.0);
    }
    let mut exact = exact;
    exact.change_to(OceanDesc { cascades: exact.desc().cascades.clone(), ..new.desc().clone() }, 2000.0, 60.0).unwrap();
    ocean.set_time(2030.02);
    exact.set_time(2030.02);
    assert_eq!(hash(&ocean), hash(&exact), "while the sea changes every time is exact");
}

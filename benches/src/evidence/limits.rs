//! Limits of the machine, measured in the same run as what they bound.

use std::hint::black_box;

use rayon::prelude::*;

use super::{Effort, measure};

/// Nanoseconds that moving one byte takes in `a[i] = b[i] + s c[i]` over three arrays of f32 that fill
/// `working_set` bytes together, on all threads of the pool or on one.
///
/// A method that must move n bytes within such a working set cannot be faster than n times this.
pub fn triad_ns_per_byte(effort: Effort, working_set: usize, all_threads: bool) -> f64 {
    let length = (working_set / 12).max(1024);
    let (b, c) = (vec![1.0f32; length], vec![2.0f32; length]);
    let mut a = vec![0.0f32; length];
    let chunk = if all_threads { length.div_ceil(rayon::current_num_threads()).max(1024) } else { length };
    let triad = |a: &mut [f32], b: &[f32], c: &[f32], s: f32| {
        for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
            *a = *b + s * *c;
        }
    };
    let timing = measure(effort, || {
        let s = black_box(3.0);
        if chunk == length {
            triad(black_box(&mut a), &b, &c, s);
        } else {
            a.par_chunks_mut(chunk)
                .zip(b.par_chunks(chunk))
                .zip(c.par_chunks(chunk))
                .for_each(|((a, b), c)| triad(black_box(a), b, c, s));
        }
    });
    timing.median_ns / (length * 12) as f64
}

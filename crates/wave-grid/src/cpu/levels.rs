//! The inner loops on every vector unit that this machine has.

use fearless_simd::{Level, Simd};

#[path = "../../tests/scenario/mod.rs"]
mod scenario;

/// Every level that this machine can run, widest first.
fn all() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![best];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_avx2().map(Simd::level));
        levels.extend(best.as_sse4_2().map(Simd::level));
        levels.extend(best.as_sse2().map(Simd::level));
    }
    levels
}

#[test]
fn bits_do_not_depend_on_the_vector_unit() {
    let hashes = |level: Level| -> Vec<u64> {
        let run = |mut grid: crate::WaveGrid| {
            grid.level = level;
            scenario::run(&mut grid, 0..100);
            grid.hash()
        };
        scenario::grids().into_iter().map(run).collect()
    };
    let levels = all();
    let expected = hashes(levels[0]);
    for level in levels {
        assert_eq!(hashes(level), expected, "{level:?}");
    }
}

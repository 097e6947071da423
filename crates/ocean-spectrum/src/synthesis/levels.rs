//! Which vector units the machine has.

use fearless_simd::{Level, Simd, dispatch, prelude::*};

/// Lanes of a level's vectors.
pub(crate) fn lanes(level: Level) -> usize {
    #[inline(always)]
    fn of<S: Simd>(_: S) -> usize {
        S::f32s::LEN
    }
    dispatch!(level, simd => of(simd))
}

/// Every level that this machine can run, widest first.
#[cfg(test)]
pub(crate) fn all() -> Vec<Level> {
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

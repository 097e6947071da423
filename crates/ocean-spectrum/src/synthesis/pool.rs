//! Work memory that is handed out again and again, the one returned last first, since it is in the cache.

use std::sync::{Mutex, PoisonError};

use crate::synthesis::lanes::Aligned;

/// Pieces of memory of one size or more.
pub(crate) struct Pool {
    free: Mutex<Vec<Aligned<f32>>>,
}

impl Pool {
    /// With `count` pieces. Memory that is never used is never touched.
    pub(crate) fn new(count: usize, floats: usize) -> Self {
        Self { free: Mutex::new((0..count).map(|_| Aligned::new(floats)).collect()) }
    }

    /// A piece of at least so many floats, with anything in it. Allocates only where more are out than ever before.
    pub(crate) fn take(&self, floats: usize) -> Aligned<f32> {
        let piece = self.free.lock().unwrap_or_else(PoisonError::into_inner).pop();
        piece.filter(|piece| piece.len() >= floats).unwrap_or_else(|| Aligned::new(floats))
    }

    pub(crate) fn give(&self, piece: Aligned<f32>) {
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(piece);
    }
}

/// The work memory of a sea's cascades.
pub(crate) struct Pools {
    /// Half done transforms of an array.
    pub(crate) halves: Pool,
    /// Lines in work.
    pub(crate) lines: Pool,
}

impl Pools {
    pub(crate) fn new(halves: usize, half_floats: usize, lines: usize, line_floats: usize) -> Self {
        Self { halves: Pool::new(halves, half_floats), lines: Pool::new(lines, line_floats) }
    }
}

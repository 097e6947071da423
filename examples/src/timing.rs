//! How long things take.

use std::time::Instant;

/// Durations of one kind, milliseconds.
#[derive(Debug, Clone, Default)]
pub(crate) struct Timing {
    all: Vec<f32>,
}

impl Timing {
    /// Runs and measures.
    pub(crate) fn of<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.push(start);
        result
    }

    /// Notes the time since `start`.
    pub(crate) fn push(&mut self, start: Instant) {
        // A window may stay open for days.
        if self.all.len() >= 100_000 {
            self.all.drain(..50_000);
        }
        self.all.push(start.elapsed().as_secs_f32() * 1e3);
    }

    /// Mean of the last second's worth of frames.
    pub(crate) fn recent(&self) -> f32 {
        let last = &self.all[self.all.len().saturating_sub(60)..];
        last.iter().sum::<f32>() / last.len().max(1) as f32
    }

    /// Median and largest.
    pub(crate) fn summary(&self) -> String {
        let mut sorted = self.all.clone();
        sorted.sort_by(f32::total_cmp);
        match sorted.last() {
            None => "none".into(),
            Some(max) => format!("median {:.2} ms, longest {max:.2} ms", sorted[sorted.len() / 2]),
        }
    }
}

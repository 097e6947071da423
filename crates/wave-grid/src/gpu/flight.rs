//! Whether an encoder was submitted, or dropped with what it should have done.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

const UNDER_WAY: u8 = 0;
const LANDED: u8 = 1;
const LOST: u8 = 2;

/// Watches an encoder.
#[derive(Debug)]
pub(super) struct Flight(Arc<AtomicU8>);

/// Goes with the encoder, and is dropped with it.
struct Passenger(Arc<AtomicU8>);

impl Drop for Passenger {
    fn drop(&mut self) {
        // Only what did not land is still under way here.
        let _ = self.0.compare_exchange(UNDER_WAY, LOST, Ordering::AcqRel, Ordering::Acquire);
    }
}

impl Flight {
    pub(super) fn board(encoder: &wgpu::CommandEncoder) -> Self {
        let state = Arc::new(AtomicU8::new(UNDER_WAY));
        let passenger = Passenger(state.clone());
        encoder.on_submitted_work_done(move || passenger.0.store(LANDED, Ordering::Release));
        Self(state)
    }

    pub(super) fn is_lost(&self) -> bool {
        self.0.load(Ordering::Acquire) == LOST
    }

    pub(super) fn has_landed(&self) -> bool {
        self.0.load(Ordering::Acquire) == LANDED
    }
}

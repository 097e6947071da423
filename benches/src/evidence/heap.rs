//! What the heap holds and how often it is asked. The binary `evidence` counts; elsewhere both stay 0.

use stats_alloc::INSTRUMENTED_SYSTEM;

/// Bytes of the heap in use.
pub fn heap_bytes() -> usize {
    let stats = INSTRUMENTED_SYSTEM.stats();
    stats.bytes_allocated.saturating_sub(stats.bytes_deallocated)
}

/// How many times `f` asks the heap for memory, on all threads.
pub fn allocations(f: impl FnOnce()) -> usize {
    let before = INSTRUMENTED_SYSTEM.stats();
    f();
    let change = INSTRUMENTED_SYSTEM.stats() - before;
    change.allocations + change.reallocations
}

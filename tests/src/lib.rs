//! Tests that cross crates or need an adapter, and the xtask.

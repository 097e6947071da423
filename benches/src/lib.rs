//! Benchmarks and evidence of Open Water.

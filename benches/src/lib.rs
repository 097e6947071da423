//! Benchmarks and evidence of Open Water.
//!
//! [`evidence`] holds what every case uses: rows, timing, the machine's limits, plots. [`cases`] holds the cases,
//! one file a topic; each compares the library, through its public API only, with something that shares no code
//! with it: [`truth`]. [`fixtures`] holds the inputs that the cases share with the criterion benches. [`fit`] makes the numbers
//! that the dispersive scheme ships with.

pub mod cases;
pub mod evidence;
pub mod fit;
pub mod fixtures;
pub mod truth;

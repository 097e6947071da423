//! Tests that cross crates or need an adapter, and the xtask.
//!
//! The library itself holds nothing but the README's code blocks, which run as doc tests.

/// The README: its Rust blocks are compiled and run by `cargo test --doc`.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;

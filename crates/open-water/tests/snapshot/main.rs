//! Snapshots: rollback, late joiners, and what tells two waters apart.
#![cfg(feature = "serde")]

mod joiner;
mod rollback;
mod scene;
mod shore;

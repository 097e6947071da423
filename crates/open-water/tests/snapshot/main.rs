//! Snapshots: rollback, late joiners, and what tells two waters apart.
#![cfg(feature = "serde")]

mod joiner;
mod record;
mod rollback;
mod scene;
mod shore;

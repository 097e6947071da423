//! Runnable scenes of Open Water.

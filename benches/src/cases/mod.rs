//! The cases of the evidence, one file a topic.

mod grid_border;
mod grid_phase;
mod grid_step;

use crate::evidence::Case;

/// Every case, in the order of the report.
pub const CASES: &[Case] = &[grid_phase::PHASE, grid_border::PML, grid_border::SHIFT, grid_step::STEP];

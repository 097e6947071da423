//! The cases of the evidence.

use crate::evidence::Case;

/// Every case, in the order of the report.
pub const CASES: &[Case] = &[];

//! Passes of the ocean.

use crate::Pass;

/// The passes of this area.
pub const PASSES: &[Pass] = &[];

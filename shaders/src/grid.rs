//! Passes of the grid.

use crate::Pass;

/// The passes of this area.
pub const PASSES: &[Pass] = &[];

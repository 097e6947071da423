//! Passes of the view.

use crate::Pass;

/// The passes of this area.
pub const PASSES: &[Pass] = &[];

//! How a mode set is made: enough to make it again elsewhere, with the same bits.

use std::sync::Arc;

use fearless_simd::Level;

use crate::modes::change::Segment;
use crate::modes::set::ModeSet;
use crate::{OceanDesc, OceanError};

/// Most moments on the way between two seas that one sea may have been made from.
const MOST: usize = 256;

/// A mode set: that of a description, or of a moment on the way from it to another, and from there to a third.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Recipe {
    first: OceanDesc,
    mixes: Vec<Mix>,
}

/// A change that was left at a time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Mix {
    after: OceanDesc,
    start: f64,
    seconds: f64,
    left: f64,
}

impl Recipe {
    pub(crate) fn new(desc: OceanDesc) -> Self {
        Self { first: desc, mixes: Vec::new() }
    }

    /// The sea at time `left` of a change from this one.
    pub(crate) fn mixed(&self, segment: &Segment, left: f64) -> Self {
        let Segment { after, start, seconds, .. } = segment;
        let mut mixed = self.clone();
        mixed.mixes.push(Mix { after: after.recipe.first.clone(), start: *start, seconds: *seconds, left });
        mixed
    }

    /// Makes it.
    pub(crate) fn make(&self, level: Level) -> Result<ModeSet, OceanError> {
        let count = self.mixes.len();
        crate::error::check("changes left half way", count as f64, count <= MOST, "at most 256")?;
        let mut set = ModeSet::new(self.first.clone(), level)?;
        for Mix { after, start, seconds, left } in &self.mixes {
            let after = ModeSet::new(after.clone(), level)?;
            set = Arc::new(Segment::new(Arc::new(set), Arc::new(after), *start, *seconds)?).mixed(*left)?;
        }
        Ok(set)
    }
}

//! A sea at a moment, to go back to and to hand on: its descriptions, the changes under way and the time.
//!
//! In memory a snapshot shares the modes. Made from bytes it has none: whoever restores it makes them again, with the same bits.

use std::fmt;
use std::sync::Arc;

use fearless_simd::Level;
use glam::DVec2;

use crate::modes::change::Segment;
use crate::modes::recipe::Recipe;
use crate::modes::set::ModeSet;
use crate::query::amplitude::AmplitudeMap;
use crate::{Ocean, OceanError};

/// Most changes that a snapshot may hold.
const MOST: usize = 64;

/// A moment of an [`Ocean`], without the map of amplitudes if it was read from bytes.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OceanSnapshot {
    base: Recipe,
    changes: Vec<Change>,
    time: f64,
    origin: DVec2,
    #[cfg_attr(feature = "serde", serde(skip))]
    made: Option<Made>,
}

/// A change under way or to come.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Change {
    before: Recipe,
    after: Recipe,
    start: f64,
    seconds: f64,
}

/// What the sea and its snapshots share.
#[derive(Clone)]
struct Made {
    base: Arc<ModeSet>,
    segments: Vec<Arc<Segment>>,
    map: Option<Arc<AmplitudeMap>>,
}

impl fmt::Debug for OceanSnapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { base, changes, time, origin, made: _ } = self;
        f.debug_struct("OceanSnapshot")
            .field("base", base)
            .field("changes", changes)
            .field("time", time)
            .field("origin", origin)
            .finish_non_exhaustive()
    }
}

/// Mode sets, each made once.
struct Kitchen {
    level: Level,
    known: Vec<Arc<ModeSet>>,
}

impl Kitchen {
    fn make(&mut self, recipe: &Recipe) -> Result<Arc<ModeSet>, OceanError> {
        if let Some(known) = self.known.iter().find(|set| set.recipe == *recipe) {
            return Ok(Arc::clone(known));
        }
        let made = Arc::new(recipe.make(self.level)?);
        self.known.push(Arc::clone(&made));
        Ok(made)
    }
}

impl OceanSnapshot {
    fn make(&self, mut kitchen: Kitchen) -> Result<Made, OceanError> {
        if let Some(made) = &self.made {
            return Ok(made.clone());
        }
        let check = crate::error::check;
        check("changes", self.changes.len() as f64, self.changes.len() <= MOST, "at most 64")?;
        check("time", self.time, self.time.is_finite() && self.origin.is_finite(), "finite, as is the origin")?;
        let base = kitchen.make(&self.base)?;
        let mut segments = Vec::with_capacity(self.changes.len());
        for Change { before, after, start, seconds } in &self.changes {
            check("seconds", *seconds, start.is_finite() && (0.0..=86_400.0).contains(seconds), "0 to 86400 s")?;
            let (before, after) = (kitchen.make(before)?, kitchen.make(after)?);
            segments.push(Arc::new(Segment::new(before, after, *start, *seconds)?));
        }
        Ok(Made { base, segments, map: None })
    }
}

impl Ocean {
    /// This moment. Shares the modes.
    pub fn snapshot(&self) -> OceanSnapshot {
        let change = |segment: &Arc<Segment>| Change {
            before: segment.before.recipe.clone(),
            after: segment.after.recipe.clone(),
            start: segment.start,
            seconds: segment.seconds,
        };
        OceanSnapshot {
            base: self.base.recipe.clone(),
            changes: self.segments.iter().map(change).collect(),
            time: self.time_set,
            origin: self.origin,
            made: Some(Made {
                base: Arc::clone(&self.base),
                segments: self.segments.clone(),
                map: self.amplitudes().cloned(),
            }),
        }
    }

    /// Goes back to a moment. Modes are made where the snapshot was read from bytes and the sea has none of that description;
    /// then it takes as long as [`Self::new`]. Without a map of amplitudes in the snapshot there is none afterwards.
    ///
    /// # Errors
    /// [`OceanError::InvalidValue`] for a snapshot that does not hold together; the sea is as it was then.
    pub fn restore(&mut self, snapshot: &OceanSnapshot) -> Result<(), OceanError> {
        let mut known = vec![Arc::clone(&self.base)];
        known.extend(self.segments.iter().flat_map(|segment| [&segment.before, &segment.after].map(Arc::clone)));
        let Made { base, segments, map } = snapshot.make(Kitchen { level: self.base.level, known })?;
        (self.base, self.segments) = (base, segments);
        self.origin = snapshot.origin;
        self.set_amplitudes(map);
        self.set_time(snapshot.time);
        Ok(())
    }

    /// A sea at a moment of another.
    ///
    /// # Errors
    /// As [`Self::restore`].
    pub fn from_snapshot(snapshot: &OceanSnapshot) -> Result<Self, OceanError> {
        let made = snapshot.make(Kitchen { level: Level::new(), known: Vec::new() })?;
        let mut ocean = Self::of_modes(Arc::clone(&made.base));
        ocean.restore(&OceanSnapshot { made: Some(made), ..snapshot.clone() })?;
        Ok(ocean)
    }
}

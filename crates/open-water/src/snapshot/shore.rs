//! Land and level of a snapshot: the land itself is the game's, and only told.

use std::sync::Arc;

use glam::DVec2;

use crate::OpenWaterError;
use crate::land::{Baked, Shore, Terrain, Turning};

/// The maps of the land.
#[derive(Clone)]
pub(super) struct Maps(pub(super) Arc<Baked>);

/// Which land.
#[derive(Clone)]
pub(super) enum LandMark {
    /// This one.
    Here(Terrain),
    /// One of this digest, with its maps made for this level in metres.
    #[cfg(feature = "serde")]
    Told(u64, f32),
}

/// Land and level at a moment.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct ShoreMoment {
    level: f32,
    found: f32,
    /// World place of the local origin, metres.
    origin: DVec2,
    land: Option<LandMark>,
    pub(super) baked: Maps,
    turning: Option<TurningMoment>,
    places: Option<Vec<[Option<usize>; 2]>>,
}

#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct TurningMoment {
    from: Maps,
    to: Maps,
    after: Option<Maps>,
    start: f64,
    seconds: f64,
    shown: f32,
}

impl ShoreMoment {
    pub(super) fn of(shore: &Shore) -> Self {
        let maps = |maps: &Arc<Baked>| Maps(Arc::clone(maps));
        let turning = |turning: &Turning| TurningMoment {
            from: maps(&turning.from),
            to: maps(&turning.to),
            after: turning.after.as_ref().map(maps),
            start: turning.start,
            seconds: turning.seconds,
            shown: turning.shown,
        };
        Self {
            level: shore.level,
            found: shore.found,
            origin: shore.origin,
            land: shore.terrain.clone().map(LandMark::Here),
            baked: maps(&shore.baked),
            turning: shore.turning.as_ref().map(turning),
            places: shore.places.clone(),
        }
    }

    /// The shore as it was, on the land of `now`.
    pub(super) fn restored(&self, now: &Shore, sea: bool) -> Result<Shore, OpenWaterError> {
        if !(self.level.abs() <= 1000.0 && self.found.abs() <= 1000.0 && self.origin.is_finite()) {
            let value = self.level.into();
            return Err(OpenWaterError::InvalidValue { field: "snapshot: level", value, bound: "within 1000 m" });
        }
        let terrain = match (&self.land, &now.terrain) {
            (None, None) => None,
            (Some(LandMark::Here(was)), Some(own)) if was.is_of_land(own) => Some(was.clone()),
            #[cfg(feature = "serde")]
            (Some(LandMark::Told(digest, level)), Some(own)) if own.digest() == *digest && level.abs() <= 1000.0 => {
                Some(own.at_level(*level))
            }
            _ => return Err(OpenWaterError::OtherLand),
        };
        let maps = self.turning.iter().flat_map(|t| [Some(&t.from), Some(&t.to), t.after.as_ref()]).flatten();
        let pixels = terrain.as_ref().map_or(0, |terrain| terrain.bed().elevations().len());
        if let Some(Maps(odd)) = maps.chain([&self.baked]).find(|Maps(maps)| sea && !maps.is_of(pixels)) {
            let (field, value) = ("snapshot: pixels of the land's maps", odd.factors.len() as f64);
            return Err(OpenWaterError::InvalidValue { field, value, bound: "those of the bed" });
        }
        let ready =
            |Maps(maps): &Maps| terrain.as_ref().map_or(Arc::clone(maps), |terrain| Baked::whole(maps, terrain));
        let turning = |t: &TurningMoment| Turning {
            from: ready(&t.from),
            to: ready(&t.to),
            after: t.after.as_ref().map(ready),
            start: t.start,
            seconds: t.seconds,
            shown: t.shown,
        };
        Ok(Shore {
            level: self.level,
            found: self.found,
            origin: self.origin,
            baked: ready(&self.baked),
            turning: self.turning.as_ref().map(turning),
            places: self.places.clone(),
            revision: now.revision + 1,
            fed_revision: now.fed_revision,
            terrain,
        })
    }

    /// What of it is hashed: the maps follow from the rest.
    #[cfg(feature = "serde")]
    pub(super) fn gist(shore: &Shore) -> impl serde::Serialize {
        let land = shore.terrain.as_ref().map(|terrain| (terrain.digest(), terrain.level));
        let turning = shore.turning.as_ref().map(|turning| (turning.start, turning.seconds, turning.shown));
        (shore.level, shore.found, shore.origin, land, turning, shore.places.clone())
    }
}

#[cfg(feature = "serde")]
mod values {
    use std::sync::Arc;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{LandMark, Maps};
    use crate::land::Baked;

    impl Serialize for LandMark {
        fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
            match self {
                Self::Here(terrain) => (terrain.digest(), terrain.level),
                Self::Told(digest, level) => (*digest, *level),
            }
            .serialize(to)
        }
    }

    impl<'de> Deserialize<'de> for LandMark {
        fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            Deserialize::deserialize(from).map(|(digest, level)| Self::Told(digest, level))
        }
    }

    impl Serialize for Maps {
        fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
            (&self.0.factors, &self.0.incoming).serialize(to)
        }
    }

    impl<'de> Deserialize<'de> for Maps {
        fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            let mut baked = Baked::default();
            (baked.factors, baked.incoming) = Deserialize::deserialize(from)?;
            Ok(Self(Arc::new(baked)))
        }
    }
}

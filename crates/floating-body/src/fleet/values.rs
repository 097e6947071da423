//! A fleet as a `serde` value: its description and its pieces, checked when they are read.

use glam::Vec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::lanes::LANES;
use super::pack::Piece;
use super::ride::Rider;
use super::sleep::Sleepers;
use super::{Fleet, FleetDesc, PieceId, Place};
use crate::Arena;

/// What a fleet counts: ticks, time in s, the last tick's length in s, resets.
type Counts = (u64, f64, f32, u32);

/// Pieces that are awake, one after the other, and which packs are fresh.
struct Awake<'a>(&'a Fleet);

impl Serialize for Awake<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let crew = &self.0.awake;
        to.collect_seq((0..crew.len()).map(|i| (crew.ids[i], crew.get(i), crew.packs[i / LANES].fresh)))
    }
}

impl Serialize for Fleet {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let counts: Counts = (self.ticks as u64, self.now, self.dt, self.resets);
        let pieces = (&self.index, Awake(self), &self.riders, &self.sleepers);
        (&*self.desc, pieces, self.eye, self.felt, counts).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Fleet {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        type Pieces = (Arena<PieceId, Place>, Vec<(PieceId, Piece, bool)>, Vec<Rider>, Sleepers);
        type Whole = (FleetDesc, Pieces, Option<Vec3>, bool, Counts);
        let (desc, (index, awake, riders, sleepers), eye, felt, counts) = Whole::deserialize(from)?;
        let mut fleet = Self::new(desc).map_err(D::Error::custom)?;
        for (i, (id, piece, fresh)) in awake.into_iter().enumerate() {
            fleet.awake.push(id, &piece);
            fleet.awake.packs[i / LANES].fresh = fresh;
        }
        (fleet.index, fleet.riders, fleet.sleepers) = (index, riders, sleepers);
        (fleet.felt, fleet.dt, fleet.now, fleet.resets) = (felt, counts.2, counts.1, counts.3);
        fleet.ticks = counts.0 as usize;
        fleet.look(eye);
        if !fleet.holds_together() {
            return Err(D::Error::custom("pieces that are not where their handles say"));
        }
        Ok(fleet)
    }
}

impl Fleet {
    /// Whether each piece is in its one place.
    fn holds_together(&self) -> bool {
        let kept = self.awake.len() + self.riders.len() + self.sleepers.len();
        let there = |(id, place): (PieceId, &Place)| match *place {
            Place::Awake(at) => self.awake.ids.get(at) == Some(&id),
            Place::Riding(at) => self.riders.get(at).is_some_and(|rider| rider.id == id),
            Place::Asleep { block, at } => {
                self.sleepers.blocks.get(block).is_some_and(|block| block.ids.get(at) == Some(&id))
            }
        };
        let sane = self.now.is_finite() && (0.0..=crate::body::LONGEST_TICK).contains(&self.dt);
        sane && self.sleepers.hold_together() && kept == self.index.len() && self.index.iter().all(there)
    }
}

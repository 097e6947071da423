//! Tells whether two waters are the same: a digest of all that the next ticks depend on.
//!
//! It is taken of the same values that bytes are made of, so what one holds the other does.

use postcard::ser_flavors::Flavor;
use serde::Serialize;
use wave_grid::WaveGrid;

use super::grids::GridMoment;
use super::shore::ShoreMoment;
use crate::grids::Sim;
use crate::water::OpenWater;

/// Odd numbers without a pattern (of splitmix64).
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;
const FACTOR: u64 = 0xBF58_476D_1CE4_E5B9;

/// A 64-bit digest of bytes, the same on every machine. Finds differences, but is no defence against who wants to hide one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Digest {
    state: u64,
    /// Bytes that do not fill a word yet.
    word: u64,
    count: u64,
}

impl Digest {
    pub(crate) fn new() -> Self {
        Self { state: SEED, word: 0, count: 0 }
    }

    /// Of one value.
    pub(crate) fn of(value: &impl Serialize) -> u64 {
        let mut digest = Self::new();
        digest.add(value);
        digest.finish()
    }

    pub(crate) fn add(&mut self, value: &impl Serialize) {
        // Only a value without a length could fail, and there is none.
        let _ = postcard::serialize_with_flavor(value, Sink(self));
    }

    pub(crate) fn floats(&mut self, values: &[f32]) {
        values.iter().for_each(|value| self.bytes(&value.to_bits().to_le_bytes()));
    }

    fn mix(&mut self, word: u64) {
        let product = u128::from(self.state ^ word) * u128::from(FACTOR);
        self.state = (product as u64 ^ (product >> 64) as u64).wrapping_add(SEED);
    }

    pub(crate) fn bytes(&mut self, mut bytes: &[u8]) {
        while !self.count.is_multiple_of(8)
            && let Some((byte, rest)) = bytes.split_first()
        {
            self.byte(*byte);
            bytes = rest;
        }
        let (words, rest) = bytes.as_chunks::<8>();
        for word in words {
            self.mix(u64::from_le_bytes(*word));
            self.count += 8;
        }
        rest.iter().for_each(|byte| self.byte(*byte));
    }

    fn byte(&mut self, byte: u8) {
        self.word |= u64::from(byte) << (8 * (self.count % 8));
        self.count += 1;
        if self.count.is_multiple_of(8) {
            let word = std::mem::take(&mut self.word);
            self.mix(word);
        }
    }

    pub(crate) fn finish(mut self) -> u64 {
        self.mix(self.word);
        self.mix(self.count);
        self.state ^ self.state >> 31
    }
}

struct Sink<'a>(&'a mut Digest);

impl Flavor for Sink<'_> {
    type Output = ();

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0.byte(byte);
        Ok(())
    }

    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.0.bytes(bytes);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

impl OpenWater {
    /// A digest of all that the next ticks depend on, equal on all machines that ran the same: compare it between peers to find out
    /// that they have come apart. Looks and [`Self::reports`] are not in it, nor waves of grids homed on the GPU, nor what the game
    /// changed in its own store since the last tick. Takes about as long as reading what it is of; needs feature `serde`.
    pub fn hash(&self) -> u64 {
        let mut digest = Digest::new();
        let order = self.coming.as_ref().map(|coming| coming.order);
        digest.add(&(self.tick, &self.desc, self.ocean.as_ref().map(|ocean| ocean.snapshot()), order, self.looking));
        digest.add(&(ShoreMoment::gist(&self.shore), &self.moorings, &self.wakes, &self.fleets.list));
        digest.add(&(&self.grids.ids, self.bodies.index()));
        for grid in self.grids.iter() {
            digest.add(&GridMoment::of(grid, WaveGrid::outline));
            match &grid.sim {
                Sim::Cpu(waves) => waves.for_numbers(&mut |numbers| digest.floats(numbers)),
                #[cfg(feature = "gpu")]
                Sim::Gpu(_) => {}
            }
        }
        self.bodies.each_moment(|kind, moment| {
            let kind = *kind.digest.get_or_init(|| Digest::of(&kind.desc));
            digest.add(&(kind, moment));
        });
        digest.finish()
    }
}

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
        if cfg!(target_endian = "little") {
            return self.bytes(bytemuck::cast_slice(values));
        }
        values.iter().for_each(|value| self.bytes(&value.to_bits().to_le_bytes()));
    }

    fn mix(&mut self, word: u64) {
        let product = u128::from(self.state ^ word) * u128::from(FACTOR);
        self.state = (product as u64 ^ (product >> 64) as u64).wrapping_add(SEED);
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks::<8>();
        words.iter().for_each(|word| self.part(u64::from_le_bytes(*word), 8));
        if !rest.is_empty() {
            let word = rest.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
            self.part(word, rest.len() as u64);
        }
    }

    /// The lowest `len` bytes of a word, 1 to 8; the others are 0.
    fn part(&mut self, part: u64, len: u64) {
        let filled = self.count % 8;
        self.word |= part << (8 * filled);
        self.count += len;
        if filled + len >= 8 {
            let word = std::mem::replace(&mut self.word, if filled == 0 { 0 } else { part >> (64 - 8 * filled) });
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
        self.0.part(byte.into(), 1);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_does_not_depend_on_how_bytes_come() {
        let bytes: Vec<u8> = (0..1000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
        let digest = |sizes: &[usize]| {
            let (mut digest, mut left) = (Digest::new(), &bytes[..]);
            for size in sizes.iter().cycle() {
                let (now, rest) = left.split_at((*size).min(left.len()));
                digest.bytes(now);
                left = rest;
                if left.is_empty() {
                    return digest.finish();
                }
            }
            0
        };
        let whole = digest(&[1000]);
        for sizes in [&[1][..], &[8], &[4], &[3, 8, 1, 17, 5], &[7, 64]] {
            assert_eq!(digest(sizes), whole);
        }
        // The same on every machine.
        assert_eq!(whole, KNOWN);
        let mut one = Digest::new();
        one.bytes(&bytes[..999]);
        assert_ne!(one.finish(), whole);
    }

    #[test]
    fn where_a_cells_height_stands_is_in_the_hash() {
        let hash = |x: f32| {
            let mut water = OpenWater::headless(Default::default()).unwrap();
            let id = water.add_grid(crate::GridDesc { cell_size: [0.5; 2], ..Default::default() }).unwrap();
            let (center, radius) = (glam::Vec2::new(x, 3.25), 0.6);
            // Of the same tiles, by so much.
            water.grids.get_mut(id).unwrap().add(wave_grid::Source::Displacement { center, radius, volume: 0.1 });
            water.hash()
        };
        assert_eq!(hash(3.25), hash(3.25));
        assert_ne!(hash(3.25), hash(3.75));
    }

    /// By a program of its own.
    const KNOWN: u64 = 0xC7C4_CC99_86C6_1853;
}

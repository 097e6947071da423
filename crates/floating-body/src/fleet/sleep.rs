//! Pieces asleep, in blocks of neighbours: a block on calm water costs one question.
//!
//! A block wakes as a whole, when the water over it is no longer calm and the plane under one of its pieces has moved.

use glam::Vec2;

use super::PieceId;
use super::pack::Piece;
use crate::forces::read_plane;
use crate::{SurfacePatch, WaterSurface};

/// Most pieces of a block.
const BLOCK: usize = 64;
/// A plane has moved that is so much higher (m), steeper, or faster (m/s) than when its piece fell asleep.
const MOVED: (f32, f32, f32) = (0.01, 0.01, 0.02);

/// Neighbours.
#[derive(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Block {
    pub(super) ids: Vec<PieceId>,
    pub(super) pieces: Vec<Piece>,
}

/// See the module.
#[derive(Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Sleepers {
    /// Corners of the blocks: all that a tick on calm water reads.
    bounds: Vec<[Vec2; 2]>,
    pub(super) blocks: Vec<Block>,
    count: usize,
}

type Sleeper = (PieceId, Piece);

fn spot((_, piece): &Sleeper) -> Vec2 {
    Vec2::new(piece.state.position.x, piece.state.position.z)
}

/// Corners of what they cover.
fn span(of: &[Sleeper]) -> (Vec2, Vec2) {
    of.iter().fold((Vec2::MAX, Vec2::MIN), |(low, high), s| (low.min(spot(s)), high.max(spot(s))))
}

impl Block {
    fn new(of: &[Sleeper]) -> Self {
        Self { ids: of.iter().map(|s| s.0).collect(), pieces: of.iter().map(|s| s.1).collect() }
    }

    /// Whether the water has moved under a piece whose turn it is.
    fn stirs(&self, water: &dyn WaterSurface, footprint: f32, tick: usize, refresh: usize) -> bool {
        let (mut centers, mut patches) = ([Vec2::ZERO; BLOCK], [SurfacePatch::default(); BLOCK]);
        let first = (refresh - tick % refresh) % refresh;
        let due = || self.pieces.iter().skip(first).step_by(refresh);
        let mut n = 0;
        for piece in due() {
            centers[n] = Vec2::new(piece.state.position.x, piece.state.position.z);
            n += 1;
        }
        water.patches(&centers[..n], footprint, &mut patches[..n]);
        due().zip(&centers).zip(&patches).any(|((piece, center), patch)| {
            let (now, then) = (read_plane(*center, patch).0, &piece.plane.water);
            (now.height + now.own - then.height - then.own).abs() > MOVED.0
                || now.slope.distance(then.slope) > MOVED.1
                || now.velocity.length() > MOVED.2
        })
    }
}

impl Sleepers {
    #[cfg(feature = "serde")]
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Whether blocks and what is known of them fit.
    #[cfg(feature = "serde")]
    pub(super) fn hold_together(&self) -> bool {
        let whole = |block: &Block| block.ids.len() == block.pieces.len() && block.ids.len() <= BLOCK;
        self.bounds.len() == self.blocks.len()
            && self.blocks.iter().all(whole)
            && self.blocks.iter().map(|block| block.ids.len()).sum::<usize>() == self.count
    }

    /// Takes those in who fell asleep. Returns the number of the first block that is new.
    pub(super) fn lay(&mut self, mut new: Vec<Sleeper>, reach: f32) -> usize {
        self.count += new.len();
        // Those who came one by one are put together with all others.
        let scattered = self.blocks.len() + new.len().div_ceil(BLOCK) > 2 * self.count.div_ceil(BLOCK) + 8;
        if scattered {
            self.bounds.clear();
            for block in self.blocks.drain(..) {
                new.extend(block.ids.into_iter().zip(block.pieces));
            }
        }
        let first = self.blocks.len();
        self.split(&mut new, reach);
        first
    }

    /// Halves neighbours along the longer side of what they cover until they fit into blocks.
    fn split(&mut self, of: &mut [Sleeper], reach: f32) {
        if of.len() <= BLOCK {
            if !of.is_empty() {
                let (low, high) = span(of);
                self.bounds.push([low - reach, high + reach]);
                self.blocks.push(Block::new(of));
            }
            return;
        }
        let (low, high) = span(of);
        let size = high - low;
        // Whole blocks on one side.
        let middle = of.len().div_ceil(BLOCK) / 2 * BLOCK;
        of.select_nth_unstable_by(middle, |a, b| {
            let (p, q) = if size.x >= size.y { (spot(a).x, spot(b).x) } else { (spot(a).y, spot(b).y) };
            p.total_cmp(&q).then(a.0.cmp(&b.0))
        });
        let (left, right) = of.split_at_mut(middle);
        self.split(left, reach);
        self.split(right, reach);
    }

    /// Takes one out of a block. The last of the block takes its place.
    pub(super) fn take(&mut self, block: usize, at: usize) -> Piece {
        self.count -= 1;
        let block = &mut self.blocks[block];
        block.ids.swap_remove(at);
        block.pieces.swap_remove(at)
    }

    /// The first block, from `from` on, whose water is no longer calm and stirs, or that is empty.
    pub(super) fn next_to_wake(
        &self,
        from: usize,
        water: &dyn WaterSurface,
        footprint: f32,
        tick: usize,
        refresh: usize,
    ) -> Option<usize> {
        (from..self.blocks.len()).find(|&i| {
            let [low, high] = self.bounds[i];
            !water.is_calm(low, high)
                && (self.blocks[i].ids.is_empty() || self.blocks[i].stirs(water, footprint, tick, refresh))
        })
    }

    /// Takes a block out. The last takes its place.
    pub(super) fn wake(&mut self, block: usize) -> Block {
        self.bounds.swap_remove(block);
        let block = self.blocks.swap_remove(block);
        self.count -= block.ids.len();
        block
    }

    pub(super) fn rebase(&mut self, offset: Vec2) {
        self.bounds.as_flattened_mut().iter_mut().for_each(|corner| *corner -= offset);
        for block in &mut self.blocks {
            block.pieces.iter_mut().for_each(|p| p.rebase(offset));
        }
    }
}

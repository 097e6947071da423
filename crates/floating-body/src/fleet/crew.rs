//! Pieces that are awake: packs without gaps, and whose they are.

use glam::{Quat, Vec3};

use super::PieceId;
use super::lanes::LANES;
use super::pack::{Pack, Piece};
use crate::BodyState;

/// See the module.
#[derive(Clone, Default)]
pub(super) struct Crew {
    pub(super) packs: Vec<Pack>,
    /// Of each piece; its lane is `i % 8` of pack `i / 8`.
    pub(super) ids: Vec<PieceId>,
}

impl Crew {
    pub(super) fn len(&self) -> usize {
        self.ids.len()
    }

    pub(super) fn get(&self, i: usize) -> Piece {
        self.packs[i / LANES].get(i % LANES)
    }

    pub(super) fn state(&self, i: usize) -> BodyState {
        self.packs[i / LANES].state(i % LANES)
    }

    /// Before the last tick and after it.
    pub(super) fn poses(&self, i: usize) -> [(Vec3, Quat); 2] {
        let BodyState { position, orientation, .. } = self.state(i);
        [self.packs[i / LANES].before(i % LANES), (position, orientation)]
    }

    pub(super) fn set(&mut self, i: usize, piece: &Piece) {
        self.packs[i / LANES].set(i % LANES, piece);
    }

    /// Its plane is read before it moves.
    pub(super) fn refresh(&mut self, i: usize) {
        self.packs[i / LANES].fresh = true;
    }

    /// Returns where it is.
    pub(super) fn push(&mut self, id: PieceId, piece: &Piece) -> usize {
        let i = self.ids.len();
        self.ids.push(id);
        if i.is_multiple_of(LANES) {
            self.packs.push(Pack::empty());
        }
        self.set(i, piece);
        self.refresh(i);
        i
    }

    /// Takes one out. The last takes its place.
    pub(super) fn swap_remove(&mut self, i: usize) -> Piece {
        let (piece, last) = (self.get(i), self.ids.len() - 1);
        if i < last {
            let fresh = self.packs[last / LANES].fresh;
            let moved = self.get(last);
            self.set(i, &moved);
            self.packs[i / LANES].fresh |= fresh;
        }
        self.ids.swap_remove(i);
        if last.is_multiple_of(LANES) {
            self.packs.pop();
        } else {
            self.packs[last / LANES].set(last % LANES, &Piece::new(BodyState::at_rest(Vec3::ZERO)));
        }
        piece
    }
}

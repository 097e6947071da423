//! Which grid a body disturbs, its home, and how one home follows another.
//!
//! What a body displaces is measured against the water without its own waves, and a body alone in its grid does not feel
//! them. So each grid counts with a share as the body's own, the rest as others'. A grid that is to become the home first
//! rises to a share of 1, while the old home still takes the body's waves; a former one falls to 0 once it takes none. So
//! sources and forces stay continuous, no wave of the body's is ever part of what it is measured against, and the body's
//! waves go to one grid at a time, each wave once.

use floating_body::{BodyState, Radiation};
use glam::Vec2;

use crate::OpenWaterError;
use crate::grids::{Grid, Grids};
use crate::store::{BodyId, GridId};
use crate::water::OpenWater;

/// Seconds in which a grid becomes a home, and in which waves left behind in a former one become others'.
const RISE: f32 = 0.5;
const FALL: f32 = 3.0;
/// A home's share; above 1 it counts as 1. So the fall begins 6 s after the body has gone: until then much of what is
/// around the hull is its own, whose motion others' forces and sources would take for theirs.
const HELD: f32 = 3.0;
/// Cells that a body must be farther inside a grid that is to become its home than in one that is: at an edge nothing flips.
const MARGIN: f64 = 6.0;

/// A body's home, the one to come, and the shares of grids that count as its own.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Homes {
    now: Option<GridId>,
    next: Option<GridId>,
    /// By root: what lies in one another holds the same waves.
    shares: Vec<(GridId, f32)>,
}

/// What of a body decides its home.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settler {
    pub(crate) id: BodyId,
    pub(crate) state: BodyState,
    pub(crate) reach: f32,
    pub(crate) radiation: Radiation,
}

impl Settler {
    /// Makes waves in a grid: always in one that follows it; in others only when it asks to, as it would feel its own waves
    /// there.
    fn disturbs(&self, grid: &Grid) -> bool {
        grid.follows(self.id) || self.radiation == Radiation::Grid
    }

    fn is_in(&self, grid: &Grid, ahead: f32, margin: f64) -> bool {
        let place = self.state.position + ahead * self.state.velocity;
        grid.covers(Vec2::new(place.x, place.z), self.reach, margin)
    }
}

impl Homes {
    /// The grid that takes the body's waves.
    pub(crate) fn now(&self) -> Option<GridId> {
        self.now
    }

    /// How much of a grid's waves counts as the body's own, 0 to 1. A grid that fades into another holds the same waves.
    pub(crate) fn share(&self, grid: &Grid) -> f32 {
        let of =
            |id: GridId| self.shares.iter().find(|(other, _)| *other == id).map_or(0.0, |(_, share)| share.min(1.0));
        grid.into.map_or(0.0, of).max(of(grid.root))
    }

    /// Whether any grid holds waves of the body.
    pub(crate) fn any(&self) -> bool {
        !self.shares.is_empty()
    }

    /// Decides for a tick of `dt` seconds.
    pub(crate) fn settle(&mut self, grids: &Grids, body: Settler, dt: f32, jumped: bool) {
        let root = |id: GridId| grids.get(id).map_or(id, |grid| grid.root);
        self.shares.retain(|(id, _)| grids.get(*id).is_ok());
        if jumped {
            *self = Self::default();
        }
        // A home that fades into another hands over at once: that one holds the same waves.
        if let Some(next) = self.now.and_then(|id| grids.get(id).ok()?.into) {
            self.now = Some(next);
            self.hold(root(next));
        }
        let now = self.now.and_then(|id| grids.get(id).ok()).filter(|grid| body.is_in(grid, 0.0, 0.0));
        let best = self.best(grids, body, now);
        self.next = best.map(|grid| grid.id);
        if let Some(grid) = best {
            let at = self.shares.iter().position(|(id, _)| *id == grid.root).unwrap_or_else(|| {
                self.shares.push((grid.root, 0.0));
                self.shares.len() - 1
            });
            let share = &mut self.shares[at].1;
            // Where nobody else's waves are, or where the old home ends, there is nothing to wait for.
            let at_once = grid.follows(body.id) || !grid.is_awake() || (now.is_none() && self.now.is_some());
            *share = if at_once { 1.0 } else { (*share + dt / RISE).min(1.0) };
            if *share >= 1.0 {
                (self.now, self.next) = (Some(grid.id), None);
            } else if now.is_none() {
                self.now = None;
            }
        } else {
            self.now = now.map(|grid| grid.id);
        }
        let [now, next] = [self.now, self.next].map(|id| id.map(root));
        for (_, share) in self.shares.iter_mut().filter(|(id, _)| now != Some(*id) && next != Some(*id)) {
            *share -= dt / FALL;
        }
        self.shares.retain(|(_, share)| *share > 0.0);
        if let Some(now) = now {
            self.hold(now);
        }
    }

    /// All waves of the grids of this root are the body's own.
    fn hold(&mut self, root: GridId) {
        match self.shares.iter_mut().find(|(id, _)| *id == root) {
            Some((_, share)) => *share = HELD,
            None => self.shares.push((root, HELD)),
        }
    }

    /// The grid that should become the home instead of `now`, if any.
    fn best<'a>(&self, grids: &'a Grids, body: Settler, now: Option<&Grid>) -> Option<&'a Grid> {
        let rank = |grid: &Grid| grid.rank(body.id);
        // One that follows it comes along.
        let leaving = now.is_some_and(|grid| !grid.follows(body.id) && !body.is_in(grid, RISE, 0.0));
        let other = |grid: &&Grid| now.is_none_or(|now| now.id != grid.id) && !grid.leaving && body.disturbs(grid);
        let others = grids.iter().filter(other);
        let better = |grid: &&Grid| match now {
            // One that is no better is taken when the body is about to leave.
            Some(now) => (leaving && body.is_in(grid, RISE, MARGIN)) || rank(grid) < rank(now),
            None => true,
        };
        let margin = |grid: &Grid| if self.next == Some(grid.id) || now.is_none() { 0.0 } else { MARGIN };
        let fits = others.filter(|grid| body.is_in(grid, 0.0, margin(grid))).filter(better);
        fits.min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal))
    }
}

impl OpenWater {
    /// The grid that takes a body's waves, after the last tick: the one that follows it, else, with
    /// [`Radiation::Grid`], the finest that covers it.
    ///
    /// # Errors
    /// There is no such body.
    pub fn home(&self, body: BodyId) -> Result<Option<GridId>, OpenWaterError> {
        self.bodies.home(body)
    }
}

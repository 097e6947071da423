//! Moorings: lines that hold bodies, by handle.
//!
//! The pull itself is `floating-body`'s, in every sub-step of the body. A mooring goes with its body.

use floating_body::{Arena, MooringLine};
use glam::Vec2;

use crate::OpenWaterError;
use crate::bodies::Bodies;
use crate::rebase::lifted;
use crate::store::{BodyId, MooringId};

/// A body made fast with a line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mooring {
    /// Which body.
    pub body: BodyId,
    /// How.
    pub line: MooringLine,
}

#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Moorings(Arena<MooringId, Mooring>);

impl Moorings {
    pub(crate) fn add(&mut self, mooring: Mooring, bodies: &mut Bodies) -> Result<MooringId, OpenWaterError> {
        self.follow(mooring.body, bodies);
        let id = self.0.insert(mooring);
        if let Err(error) = self.tie(mooring.body, bodies) {
            self.0.remove(id);
            return Err(error);
        }
        Ok(id)
    }

    pub(crate) fn remove(&mut self, id: MooringId, bodies: &mut Bodies) -> Result<(), OpenWaterError> {
        let body = self.0.get(id).ok_or(OpenWaterError::UnknownMooring(id))?.body;
        self.follow(body, bodies);
        self.0.remove(id);
        self.tie(body, bodies)
    }

    /// Lets go of a body that is gone.
    pub(crate) fn forget(&mut self, body: BodyId) {
        self.0.retain(|_, mooring| mooring.body != body);
    }

    pub(crate) fn tension(&self, id: MooringId, bodies: &Bodies) -> Result<f32, OpenWaterError> {
        let mooring = self.0.get(id).ok_or(OpenWaterError::UnknownMooring(id))?;
        let at = self.of(mooring.body).take_while(|(other, _)| *other != id).count();
        Ok(bodies.body(mooring.body)?.tensions().get(at).copied().unwrap_or(0.0))
    }

    /// Takes over where anchors have dragged to.
    fn follow(&mut self, body: BodyId, bodies: &Bodies) {
        let Ok(found) = bodies.body(body) else { return };
        let mine = self.0.iter_mut().map(|(_, mooring)| mooring).filter(|mooring| mooring.body == body);
        for (mooring, line) in mine.zip(found.moorings()) {
            mooring.line.anchor = line.anchor;
        }
    }

    /// Anchors stay where they are in the world, the local origin moves by `offset`.
    pub(crate) fn rebase(&mut self, offset: Vec2) {
        self.0.iter_mut().for_each(|(_, mooring)| mooring.line.anchor -= lifted(offset));
    }

    fn of(&self, body: BodyId) -> impl Iterator<Item = (MooringId, MooringLine)> {
        self.0.iter().filter(move |(_, mooring)| mooring.body == body).map(|(id, mooring)| (id, mooring.line))
    }

    fn tie(&self, body: BodyId, bodies: &mut Bodies) -> Result<(), OpenWaterError> {
        let lines: Vec<MooringLine> = self.of(body).map(|(_, line)| line).collect();
        bodies.set_moorings(body, &lines)
    }
}

//! Fleets: many bodies of one description, which the water keeps itself and moves after its other bodies.
//!
//! The hydrodynamics are `floating-body`'s. Here a fleet is given the water that it sees, and what its pieces displaced is
//! handed to the grids that they are in.

use floating_body::{Arena, Displacement, Fleet, FleetDesc, PieceId, Radiation};
use glam::{Vec2, Vec3};
use wave_grid::Source;

use crate::bodies::Pose;
use crate::cpu::body_water::FleetWater;
use crate::cpu::surface::Composite;
use crate::grids::Grids;
use crate::store::FleetId;
use crate::water::OpenWater;
use crate::{GridId, OpenWaterError};

#[derive(Default)]
pub(crate) struct Fleets {
    pub(crate) list: Arena<FleetId, Fleet>,
    /// Scratch.
    displaced: Vec<Displacement>,
}

impl Fleets {
    /// Radius of the smallest pieces, metres; `None` without pieces.
    pub(crate) fn smallest(&self) -> Option<f32> {
        let with_pieces = self.list.iter().map(|(_, fleet)| fleet).filter(|fleet| !fleet.is_empty());
        with_pieces.map(|fleet| fleet.template().bounding_radius()).min_by(f32::total_cmp)
    }

    /// Moves all pieces by one tick.
    pub(crate) fn step(&mut self, dt: f32, eye: Option<Vec3>, water: Composite) {
        for (_, fleet) in self.list.iter_mut() {
            fleet.look(eye);
            fleet.step(dt, &FleetWater { water, by_grid: by_grid(fleet) });
        }
    }

    pub(crate) fn rebase(&mut self, offset: Vec2) {
        self.list.iter_mut().for_each(|(_, fleet)| fleet.rebase(offset));
    }

    /// Hands what the pieces displaced to the finest grid that each is in, in a fixed order.
    pub(crate) fn disturb(&mut self, grids: &mut Grids) {
        for (_, fleet) in self.list.iter().filter(|(_, fleet)| by_grid(fleet)) {
            self.displaced.clear();
            fleet.displacements(&mut self.displaced);
            for d in &self.displaced {
                let Some(home) = home(grids, d.center, d.radius) else { continue };
                for grid in grids.taking(home) {
                    grid.add(Source::Displacement { center: d.center, radius: d.radius, volume: d.volume });
                }
            }
        }
    }
}

fn by_grid(fleet: &Fleet) -> bool {
    fleet.template().desc().radiation == Radiation::Grid
}

/// The finest grid that covers a place.
fn home(grids: &Grids, place: Vec2, reach: f32) -> Option<GridId> {
    let size = |cell: [f32; 2]| cell[0].max(cell[1]);
    let around = grids.iter().filter(|grid| !grid.leaving && grid.covers(place, reach, 0.0));
    around.min_by(|a, b| size(a.desc.cell_size).total_cmp(&size(b.desc.cell_size))).map(|grid| grid.id)
}

impl OpenWater {
    /// Adds a fleet without pieces: many bodies of one description that the water keeps itself, such as flotsam. Its pieces
    /// are moved after the bodies in each tick, from the same water, at a small part of a body's cost; they are no bodies of
    /// a [`BodyStore`](crate::BodyStore), and no grid follows them. With [`Radiation::Grid`] each makes waves in the finest
    /// grid that it is in, and the whole fleet does without coefficients: for pieces that stay in one.
    ///
    /// # Errors
    /// A value of the description is out of its range.
    pub fn add_fleet(&mut self, desc: FleetDesc) -> Result<FleetId, OpenWaterError> {
        let fleet = Fleet::new(desc)?;
        note!(self, Input::Fleet(Box::new(fleet.clone())));
        Ok(self.fleets.list.insert(fleet))
    }

    /// Removes a fleet with its pieces.
    ///
    /// # Errors
    /// There is no such fleet.
    pub fn remove_fleet(&mut self, id: FleetId) -> Result<(), OpenWaterError> {
        self.fleets.list.remove(id).ok_or(OpenWaterError::UnknownFleet(id))?;
        note!(self, Input::RemoveFleet(id));
        Ok(())
    }

    /// A fleet as it stands after the last tick.
    ///
    /// # Errors
    /// There is no such fleet.
    pub fn fleet(&self, id: FleetId) -> Result<&Fleet, OpenWaterError> {
        self.fleets.list.get(id).ok_or(OpenWaterError::UnknownFleet(id))
    }

    /// A fleet, for adding, moving and removing pieces between ticks. Where it is seen from it is told in each tick
    /// ([`OpenWater::look`]).
    ///
    /// # Errors
    /// There is no such fleet.
    pub fn fleet_mut(&mut self, id: FleetId) -> Result<&mut Fleet, OpenWaterError> {
        #[cfg(feature = "serde")]
        if let Some(recorder) = &mut self.recorder {
            recorder.touch(id);
        }
        self.fleets.list.get_mut(id).ok_or(OpenWaterError::UnknownFleet(id))
    }

    /// Where a piece is drawn: between its last two states, as far as [`Self::advance`] left off. `None` if there is no such
    /// piece.
    pub fn drawn_piece(&self, fleet: FleetId, piece: PieceId) -> Option<Pose> {
        let (position, orientation) = self.fleets.list.get(fleet)?.hull_pose(piece, self.clock.alpha())?;
        Some(Pose { position, orientation })
    }
}

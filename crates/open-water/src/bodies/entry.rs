//! One body among the water's, and its pose.

use std::sync::Arc;

use floating_body::{Body, BodyState, Controls, Displacement, Radiation, TextureKernel, Textures, Wrench};
use glam::{Quat, Vec3};
use wave_grid::{Pattern, PatternKernel, Scheme};

use super::Kind;
use crate::grids::{Grid, Grids, Sim};
use crate::handover::{Homes, Settler};
use crate::store::{BodyId, Wants};

/// Where a hull's mesh is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Local position of the hull's own origin (not of the centre of mass), metres.
    pub position: Vec3,
    /// Attitude.
    pub orientation: Quat,
}

impl Pose {
    pub(super) fn at(body: &Body, state: &BodyState) -> Self {
        let position = state.position - state.orientation * body.desc().center_of_mass;
        Self { position, orientation: state.orientation }
    }

    pub(super) fn of(body: &Body) -> Self {
        Self::at(body, &body.state())
    }

    /// The pose a share `alpha` on the way to another.
    pub(crate) fn between(&self, next: &Self, alpha: f32) -> Self {
        Self {
            position: self.position.lerp(next.position, alpha),
            orientation: self.orientation.slerp(next.orientation, alpha),
        }
    }
}

pub(super) struct Entry {
    pub(super) id: BodyId,
    /// What it was made from.
    pub(super) kind: Arc<Kind>,
    pub(super) body: Body,
    pub(super) controls: Controls,
    /// The grid that it makes waves in.
    pub(super) homes: Homes,
    /// Takes part in this tick.
    pub(super) active: bool,
    pub(super) wants: Wants,
    /// Of the last tick, for a store that wants it.
    pub(super) wrench: Wrench,
    pub(super) previous: Option<Pose>,
    pub(super) displaced: Vec<Displacement>,
    /// Its textures, if it radiates into a grid that carries them.
    pub(super) pattern: Option<Box<Pattern>>,
}

/// Cells of a grid that carries the textures of bodies, metres: waves of each length need their own speed.
pub(crate) fn carries(grid: &Grid) -> Option<f32> {
    let fits = matches!(grid.sim, Sim::Cpu(_)) && matches!(grid.desc.scheme, Scheme::Dispersive | Scheme::Spectral);
    fits.then_some(grid.desc.cell_size[0])
}

pub(super) fn pattern(textures: &Textures) -> Option<Box<Pattern>> {
    let kernels = |of: &[TextureKernel]| -> Vec<PatternKernel> {
        of.iter().map(|k| PatternKernel { offset: k.offset, depth: k.depth, weight: k.weight }).collect()
    };
    let layers = [&textures.heave, &textures.roll, &textures.pitch, &textures.hull].map(|of| kernels(of));
    Pattern::new([&layers[0], &layers[1], &layers[2], &layers[3]], textures.reach).ok().map(Box::new)
}

impl Entry {
    pub(super) fn new(id: BodyId, body: Body, kind: Arc<Kind>) -> Self {
        Self {
            id,
            kind,
            body,
            controls: Controls::default(),
            homes: Homes::default(),
            active: false,
            wants: Wants::State,
            wrench: Wrench::default(),
            previous: None,
            displaced: Vec::new(),
            pattern: None,
        }
    }

    /// Has its textures fit the grid that is its home, if that carries any.
    pub(super) fn fit(&mut self, grids: &Grids) {
        if !self.radiates() {
            return;
        }
        let cell = self.homes.now().and_then(|home| carries(grids.get(home).ok()?));
        if cell.is_some_and(|cell| self.body.fit_textures(cell)) {
            self.pattern = self.body.textures().and_then(pattern);
        }
    }

    /// The waves it makes take its energy away.
    pub(super) fn radiates(&self) -> bool {
        self.body.desc().radiation == Radiation::Grid
    }

    pub(super) fn settler(&self, state: BodyState) -> Settler {
        let Self { id, body, .. } = self;
        Settler { id: *id, state, reach: body.bounding_radius(), radiation: body.desc().radiation }
    }
}

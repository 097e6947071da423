//! The bodies: their handles, and one tick of all of them.
//!
//! The hydrodynamics are `floating-body`'s. Here each body is given the water it sees, and what it displaced is handed
//! to the grid it disturbs. Bodies do not see each other: collisions are the physics engine's.

mod entry;
mod moments;

use std::sync::Arc;

use floating_body::{Arena, Body, BodyState, Controls, Explanation, MooringLine, Sampling};
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use wave_grid::Source;

use crate::cpu::body_water::BodyWater;
use crate::cpu::surface::Composite;
#[cfg(feature = "gpu")]
use crate::gpu::hulls::Hull;
use crate::grids::{Grids, Sim};
use crate::rebase::lifted;
use crate::store::{BodyId, BodyMotion, BodyStore, GridId, Wants};
use crate::{OpenWaterError, Reports};
use entry::Entry;
pub use entry::Pose;
pub(crate) use entry::carries;
#[cfg(feature = "serde")]
pub(crate) use moments::BodyMoment;
pub(crate) use moments::{BodiesMoment, Kind};

/// Bodies per task: a tick of a small body is well below a microsecond.
const CHUNK: usize = 16;
/// Change of position within a tick, on top of the body's own motion, that counts as a teleport, metres.
const TELEPORT: f32 = 5.0;

/// What bodies read of the sea.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reads {
    Samples,
    /// Of bodies of this radius or larger, metres.
    Patches(f32),
}

#[derive(Default)]
pub(crate) struct Bodies {
    index: Arena<BodyId, usize>,
    list: Vec<Entry>,
}

impl Bodies {
    pub(crate) fn insert(&mut self, body: Body) -> BodyId {
        let id = self.index.insert(self.list.len());
        let kind = Arc::new(Kind::new(body.desc().clone()));
        self.list.push(Entry::new(id, body, kind));
        id
    }

    pub(crate) fn remove(&mut self, id: BodyId) -> Result<(), OpenWaterError> {
        let at = self.index.remove(id).ok_or(OpenWaterError::UnknownBody(id))?;
        self.list.swap_remove(at);
        if let Some(moved) = self.list.get(at) {
            self.index[moved.id] = at;
        }
        Ok(())
    }

    fn get(&self, id: BodyId) -> Option<&Entry> {
        self.index.get(id).map(|&at| &self.list[at])
    }

    pub(crate) fn body(&self, id: BodyId) -> Result<&Body, OpenWaterError> {
        self.get(id).map(|entry| &entry.body).ok_or(OpenWaterError::UnknownBody(id))
    }

    pub(crate) fn home(&self, id: BodyId) -> Result<Option<GridId>, OpenWaterError> {
        self.get(id).map(|entry| entry.homes.now()).ok_or(OpenWaterError::UnknownBody(id))
    }

    pub(crate) fn set_controls(&mut self, id: BodyId, controls: Controls) -> Result<(), OpenWaterError> {
        let at = *self.index.get(id).ok_or(OpenWaterError::UnknownBody(id))?;
        self.list[at].controls = controls;
        Ok(())
    }

    /// Puts a body elsewhere: it has not gone there.
    pub(crate) fn teleport(&mut self, id: BodyId, state: BodyState) -> Result<(), OpenWaterError> {
        let at = *self.index.get(id).ok_or(OpenWaterError::UnknownBody(id))?;
        self.list[at].body.teleport(state)?;
        self.list[at].previous = None;
        Ok(())
    }

    /// Moves the local origin by `offset`, metres.
    pub(crate) fn rebase(&mut self, offset: Vec2) {
        for entry in &mut self.list {
            entry.body.rebase(offset);
            if let Some(pose) = &mut entry.previous {
                pose.position -= lifted(offset);
            }
        }
    }

    pub(crate) fn explain(&self, id: BodyId) -> Result<Explanation, OpenWaterError> {
        let at = *self.index.get(id).ok_or(OpenWaterError::UnknownBody(id))?;
        Ok(self.list[at].body.explain(&self.list[at].controls))
    }

    pub(crate) fn set_moorings(&mut self, id: BodyId, lines: &[MooringLine]) -> Result<(), OpenWaterError> {
        let at = *self.index.get(id).ok_or(OpenWaterError::UnknownBody(id))?;
        Ok(self.list[at].body.set_moorings(lines)?)
    }

    /// Pose at the start of the last tick, if it took part in it.
    #[cfg(feature = "rapier")]
    pub(crate) fn previous(&self, id: BodyId) -> Option<Pose> {
        self.get(id).filter(|entry| entry.active)?.previous
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Those that take part, in a fixed order.
    pub(crate) fn active(&self) -> impl Iterator<Item = (BodyId, &Body)> {
        self.list.iter().filter(|entry| entry.active).map(|entry| (entry.id, &entry.body))
    }

    /// What those that take part read of the sea: samples, or patches under bodies of this radius (metres) or larger.
    pub(crate) fn reads(&self) -> Option<Reads> {
        let patches = |entry: &Entry| entry.body.desc().sampling == Sampling::Patch;
        let mut active = self.list.iter().filter(|entry| entry.active).peekable();
        active.peek()?;
        let radius =
            |least: Option<f32>, entry: &Entry| patches(entry).then_some(least?.min(entry.body.bounding_radius()));
        Some(active.fold(Some(f32::INFINITY), radius).map_or(Reads::Samples, Reads::Patches))
    }

    pub(crate) fn place_of(&self, id: BodyId) -> Option<Vec3> {
        self.get(id).filter(|entry| entry.active).map(|entry| entry.body.state().position)
    }

    pub(crate) fn drawn(&self, id: BodyId, alpha: f32) -> Option<Pose> {
        let entry = self.get(id).filter(|entry| entry.active)?;
        let now = Pose::of(&entry.body);
        let before = entry.previous.unwrap_or(now);
        Some(before.between(&now, alpha))
    }

    /// What the water takes each body's store to say if nobody has changed it since the last tick.
    #[cfg(feature = "serde")]
    pub(crate) fn given(&self) -> impl Iterator<Item = (BodyId, crate::record::Given)> + '_ {
        self.list.iter().map(|entry| (entry.id, entry.active.then(|| (entry.body.state(), entry.wants))))
    }

    /// What the store says else.
    #[cfg(feature = "serde")]
    pub(crate) fn news(&self, store: &dyn BodyStore) -> Vec<(BodyId, crate::record::Given)> {
        let told = |id: BodyId| store.read(id).map(|state| (state, store.wants(id)));
        self.given()
            .map(|(id, given)| (id, told(id), given))
            .filter(|(_, told, given)| told != given)
            .map(|(id, told, _)| (id, told))
            .collect()
    }

    /// Takes over the store's states. Returns whether any body takes part in the tick.
    pub(crate) fn read(&mut self, store: &dyn BodyStore, dt: f32, reports: &mut Reports) -> bool {
        for entry in &mut self.list {
            let Some(state) = store.read(entry.id) else {
                entry.active = false;
                entry.previous = None;
                continue;
            };
            let last = entry.body.state();
            let reach = TELEPORT + (last.velocity.length() + state.velocity.length()) * dt;
            let teleported = !entry.active || state.position.distance(last.position) > reach;
            if state != last {
                entry.body.set_state(state);
            }
            if teleported {
                entry.previous = None;
                reports.teleports += u64::from(entry.active);
            }
            entry.active = true;
            entry.wants = store.wants(entry.id);
        }
        self.list.iter().any(|entry| entry.active)
    }

    /// Moves every active body by one tick, as `eye` sees it, and gathers what it displaced.
    pub(crate) fn step(&mut self, dt: f32, eye: Option<Vec3>, water: Composite) {
        let grids = water.grids;
        self.list.par_chunks_mut(CHUNK).for_each(|entries| {
            for entry in entries.iter_mut().filter(|entry| entry.active) {
                let before = entry.body.state();
                let jumped = entry.previous.is_none();
                if let Some(eye) = eye {
                    entry.body.set_distance(eye.distance(before.position));
                }
                entry.homes.settle(grids, entry.settler(before), dt, jumped);
                entry.fit(grids);
                let (by_grid, pattern) = (entry.radiates(), entry.pattern.as_deref());
                let water = BodyWater { water, body: entry.id, homes: &entry.homes, by_grid, pattern };
                match entry.wants {
                    Wants::State => entry.body.step(dt, &water, &entry.controls),
                    Wants::Wrench => entry.wrench = entry.body.step_wrench(dt, &water, &entry.controls),
                }
                entry.displaced.clear();
                if entry.homes.now().is_some() {
                    // All that a tick may tell of: so it never grows.
                    entry.displaced.reserve(2 * entry.body.force_points().len() + 1);
                    entry.body.displacements(&mut entry.displaced);
                }
                entry.previous = Some(if jumped { Pose::of(&entry.body) } else { Pose::at(&entry.body, &before) });
            }
        });
    }

    /// Hands what the bodies displaced to their home grids, in a fixed order.
    pub(crate) fn disturb(&self, grids: &mut Grids) {
        for entry in self.list.iter().filter(|entry| entry.active) {
            let Some(home) = entry.homes.now() else { continue };
            for grid in grids.taking(home) {
                if let (Some(imprints), Some(pattern), Sim::Cpu(sim)) =
                    (entry.body.imprints(), &entry.pattern, &mut grid.sim)
                {
                    for imprint in imprints {
                        sim.add_pattern(pattern, imprint.at, imprint.heading, imprint.amounts);
                    }
                }
                #[cfg(feature = "gpu")]
                if let Sim::Gpu(sim) = &mut grid.sim
                    && entry.body.immersed_volume() > 0.0
                {
                    sim.meet(Hull::of(entry.id, &entry.body, grid.origin));
                }
                for d in &entry.displaced {
                    let center = Vec2::new(d.center.x, d.center.y);
                    if d.volume != 0.0 {
                        grid.add(Source::Displacement { center, radius: d.radius, volume: d.volume });
                    }
                    if d.foam > 0.0 {
                        grid.add(Source::Turbulence { center, radius: d.radius, foam: d.foam });
                    }
                }
            }
        }
    }

    pub(crate) fn write(&self, store: &mut dyn BodyStore) {
        for entry in self.list.iter().filter(|entry| entry.active) {
            let motion = match entry.wants {
                Wants::State => BodyMotion::State(entry.body.state()),
                Wants::Wrench => BodyMotion::Wrench(entry.wrench),
            };
            store.write(entry.id, motion);
        }
    }
}

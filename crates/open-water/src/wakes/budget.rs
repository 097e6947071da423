//! Who has a grid: decided anew every few ticks.

use floating_body::{Body, GRAVITY};
use glam::{DVec2, Vec2, Vec3};

use super::{Kept, LONGEST, Wake, Wakes, WakesDesc, cells_of};
use crate::grids::{MAX_GRIDS, Sim};
use crate::store::{BodyId, GridId};
use crate::water::OpenWater;
use crate::{Follow, GridDesc};

/// Ticks between decisions.
const BEAT: u64 = 15;
/// A body must matter so much more than the one whose grid it takes.
const STRONGER: f32 = 1.5;
/// Froude numbers below which a body needs no grid, and above which more speed does not count.
const STILL: f32 = 0.04;
const FAST: f32 = 0.4;
/// Seconds over which a body's way is averaged: bobbing is none.
const AVERAGE: f32 = 2.0;
/// A body that outruns its waves has them behind it: from the first of these shares of their speed on its grid trails, from
/// the second on by this share of the window. So does one that makes water waves, of which those that stay with it carry their
/// energy at half its speed, from these Froude numbers on.
const SLOWER: [f32; 2] = [0.7, 1.2];
const WAKING: [f32; 2] = [0.1, 0.25];
const TRAIL: f32 = 0.2;
/// Grids made in one decision: each takes a moment.
const AT_ONCE: usize = 4;

/// A body that asks for a grid.
#[derive(Debug, Clone)]
pub(super) struct Asking {
    body: BodyId,
    weight: f32,
    distance: f32,
    /// How often its cells are doubled for the hull's sake.
    size: u32,
    still: bool,
    place: Vec3,
}

fn froude(way: Vec2, length: f32) -> f32 {
    way.length() / (GRAVITY * length).sqrt()
}

fn length(body: &Body) -> f32 {
    let (low, high) = body.desc().hull.bounds();
    (high - low).x.max((high - low).z)
}

impl OpenWater {
    /// Counts the bodies whose hulls are too long for the cells that they make waves in.
    pub(crate) fn note_hulls(&mut self) {
        if !self.tick.is_multiple_of(BEAT) {
            return;
        }
        let too_long = |(id, body): &(BodyId, &Body)| {
            let home = self.bodies.home(*id).ok().flatten().and_then(|home| self.grids.get(home).ok());
            home.is_some_and(|grid| {
                let [x, z] = grid.desc.cell_size;
                !grid.desc.scheme.is_wave_equation() && length(body) > LONGEST * x.max(z)
            })
        };
        self.reports.long_hulls = self.bodies.active().filter(too_long).count() as u32;
    }

    /// Decides who has a grid in the tick to come.
    pub(crate) fn keep_wakes(&mut self, dt: f32) {
        let mut wakes = std::mem::take(&mut self.wakes);
        if let Some(desc) = wakes.desc.take() {
            let share = (dt / AVERAGE).min(1.0);
            for body in self.bodies.active() {
                let velocity = body.1.state().velocity;
                let velocity = Vec2::new(velocity.x, velocity.z);
                let way = wakes.way(body.0).unwrap_or(velocity);
                wakes.known().ways.insert(body.0, way + (velocity - way) * share);
            }
            if self.tick.is_multiple_of(BEAT) {
                self.share_out(&mut wakes, &desc);
            }
            for kept in &wakes.kept {
                let way = wakes.way(kept.body).unwrap_or_default();
                let length = self.bodies.body(kept.body).map_or(1.0, length);
                if let Some(grid) = self.grids.get_mut(kept.grid) {
                    let (faster, [low, high]) = match grid.desc.scheme.is_wave_equation() {
                        true => (way.length() / grid.desc.wave_speed, SLOWER),
                        false => (froude(way, length), WAKING),
                    };
                    let share = TRAIL * ((faster - low) / (high - low)).clamp(0.0, 1.0);
                    grid.trail = -way.normalize_or_zero().as_dvec2() * grid.room().min_element() * f64::from(share);
                }
            }
            wakes.desc = Some(desc);
        }
        self.wakes = wakes;
    }

    fn share_out(&mut self, wakes: &mut Wakes, desc: &WakesDesc) {
        let grids = &self.grids;
        wakes.fading.retain(|(id, _)| grids.get(*id).is_ok());
        wakes.kept.retain(|kept| grids.present(kept.grid).is_ok());
        wakes.known().told.clear();
        let mut asking = std::mem::take(&mut wakes.asking);
        self.ask(wakes, desc, &mut asking);
        for at in (0..wakes.kept.len()).rev() {
            let of = asking.iter().find(|asking| asking.body == wakes.kept[at].body);
            let kept = &mut wakes.kept[at];
            kept.weight = of.map_or(0.0, |of| of.weight);
            let idle = of.is_none_or(|of| of.still && self.grids.get(kept.grid).is_ok_and(|grid| !grid.is_awake()));
            if idle {
                let kept = wakes.kept.remove(at);
                self.let_go(wakes, &kept);
            }
        }
        // All that may still be made in this decision.
        let mut left = AT_ONCE;
        self.change_levels(wakes, desc, &asking, &mut left);
        asking.retain(|asking| wakes.kept.iter().all(|kept| kept.body != asking.body));
        asking.sort_unstable_by(|a, b| b.weight.total_cmp(&a.weight).then(a.body.cmp(&b.body)));
        let mut claimed = 0;
        for asking in &asking {
            let why = if asking.still { Wake::Still } else { Wake::NoRoom };
            wakes.known().told.insert(asking.body, why);
            if !asking.still && left > 0 {
                self.give(wakes, desc, asking, &mut claimed, &mut left);
            }
        }
        wakes.asking = asking;
        let Wakes { kept, known, .. } = wakes;
        for kept in kept.iter() {
            let cell_size = desc.level(kept.level, kept.size).cell_size;
            known.get_or_insert_default().told.insert(kept.body, Wake::Grid { grid: kept.grid, cell_size });
        }
    }

    /// Finds the bodies that may have a grid of ours; the others are told why not.
    fn ask(&self, wakes: &mut Wakes, desc: &WakesDesc, asking: &mut Vec<Asking>) {
        asking.clear();
        for (id, body) in self.bodies.active() {
            let length = length(body);
            let ours = wakes.kept.iter().any(|kept| kept.body == id);
            if !ours && self.grids.iter().any(|grid| !grid.leaving && grid.follows(id)) {
                wakes.known().told.insert(id, Wake::OwnGrid);
                continue;
            }
            if length < desc.least_length {
                wakes.known().told.insert(id, Wake::Short);
                continue;
            }
            let place = body.state().position;
            let distance = self.looking.map_or(0.0, |look| look.eye.distance(place));
            let froude = wakes.way(id).map_or(0.0, |way| froude(way, length));
            let near = if self.looking.is_some() { distance.max(length) } else { 1.0 };
            let weight = length * (froude / FAST).min(1.0) / near;
            let size = desc.size(length);
            asking.push(Asking { body: id, weight, distance, size, still: froude < STILL, place });
        }
    }

    /// Gives grids whose body came nearer or went away other cells.
    fn change_levels(&mut self, wakes: &mut Wakes, desc: &WakesDesc, asking: &[Asking], left: &mut usize) {
        for at in 0..wakes.kept.len() {
            let Kept { body, grid, level, .. } = wakes.kept[at];
            let Some(of) = asking.iter().find(|asking| asking.body == body) else { continue };
            let wanted = desc.wanted(of.distance, of.size, Some(level));
            let settled = self.grids.get(grid).is_ok_and(|grid| grid.gain == 1.0);
            // Larger cells may always come: else a full budget could never get more room.
            let room = if wanted > level { desc.cells + desc.cells / 4 } else { desc.cells };
            if wanted == level || !settled || *left == 0 || !self.fits(wakes, desc, wanted, room) {
                continue;
            }
            let Some(new) = self.make(desc, wanted, of, Some(grid)) else { continue };
            *left -= 1;
            self.pass_on(wakes, grid, new, cells_of(&desc.level(level, of.size)));
            (wakes.kept[at].grid, wakes.kept[at].level) = (new, wanted);
        }
    }

    /// Lets `new` take over the waves of `old`.
    fn pass_on(&mut self, wakes: &mut Wakes, old: GridId, new: GridId, cells: u64) {
        let waves = match self.grids.get(old).map(|grid| &grid.sim) {
            Ok(Sim::Cpu(waves)) if !waves.is_asleep() => waves.clone(),
            _ => return self.end(wakes, old, cells),
        };
        if let Some(grid) = self.grids.get_mut(new)
            && let Sim::Cpu(sim) = &mut grid.sim
        {
            sim.resample(&waves);
            grid.gain = 0.0;
        }
        if let Some(grid) = self.grids.get_mut(old) {
            grid.into = Some(new);
        }
        self.end(wakes, old, cells);
    }

    /// Gives a body a grid, if need be at the cost of one that matters less.
    fn give(&mut self, wakes: &mut Wakes, desc: &WakesDesc, asking: &Asking, claimed: &mut u64, left: &mut usize) {
        let wanted = desc.wanted(asking.distance, asking.size, None);
        let level = (wanted..=desc.coarsest())
            .find(|level| self.fits(wakes, desc, *level, desc.cells.saturating_sub(*claimed)));
        if let Some(level) = level {
            if let Some(grid) = self.make(desc, level, asking, None) {
                *left -= 1;
                let Asking { body, weight, size, .. } = *asking;
                wakes.kept.push(Kept { body, grid, level, size, weight });
            }
            return;
        }
        let needed = cells_of(&desc.level(wanted, asking.size));
        let fading = |wakes: &Wakes| wakes.fading.iter().map(|(_, cells)| cells).sum::<u64>();
        // What fades now will do; else who matters least.
        while used(wakes, desc).saturating_sub(fading(wakes)) + *claimed + needed > desc.cells
            || (wakes.fading.is_empty() && self.grids.iter().len() >= MAX_GRIDS)
        {
            let least = (0..wakes.kept.len()).min_by(|a, b| wakes.kept[*a].weight.total_cmp(&wakes.kept[*b].weight));
            let Some(at) = least.filter(|at| STRONGER * wakes.kept[*at].weight < asking.weight) else { return };
            let kept = wakes.kept.remove(at);
            wakes.known().told.insert(kept.body, Wake::NoRoom);
            self.let_go(wakes, &kept);
        }
        *claimed += needed;
    }

    /// Whether one more grid fits into `room` cells.
    fn fits(&self, wakes: &Wakes, desc: &WakesDesc, level: u32, room: u64) -> bool {
        let needed = cells_of(&desc.level(level, 0));
        self.grids.iter().len() < MAX_GRIDS && used(wakes, desc) + needed <= room
    }

    /// A grid around a body, instead of `old` if there is one.
    fn make(&mut self, desc: &WakesDesc, level: u32, asking: &Asking, old: Option<GridId>) -> Option<GridId> {
        let desc = GridDesc { follow: Follow::Body(asking.body), ..desc.level(level, asking.size) };
        let id = self.new_grid(desc).ok()?;
        let place = self.shore.world(Vec2::new(asking.place.x, asking.place.z));
        let trail = old.and_then(|old| self.grids.get(old).ok()).map_or(DVec2::ZERO, |old| old.trail);
        if let Some(grid) = self.grids.get_mut(id) {
            grid.trail = trail;
            grid.center_on(place + trail);
        }
        Some(id)
    }

    pub(super) fn let_go(&mut self, wakes: &mut Wakes, kept: &Kept) {
        let cells = self.grids.get(kept.grid).map_or(0, |grid| cells_of(&grid.desc));
        self.end(wakes, kept.grid, cells);
    }

    fn end(&mut self, wakes: &mut Wakes, grid: GridId, cells: u64) {
        if self.end_grid(grid).is_ok() && self.grids.get(grid).is_ok() {
            wakes.fading.push((grid, cells));
        }
    }
}

/// Cells of all grids that are kept or still fade.
fn used(wakes: &Wakes, desc: &WakesDesc) -> u64 {
    let kept = wakes.kept.iter().map(|kept| cells_of(&desc.level(kept.level, kept.size)));
    kept.chain(wakes.fading.iter().map(|(_, cells)| *cells)).sum()
}

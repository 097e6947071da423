//! A tick of a fleet: pieces fall asleep and wake, begin and end to ride, and those awake are moved.

use glam::Vec3;

use super::awake::{self, Tick};
use super::lanes::LANES;
use super::ride::{self, Ride, Rider};
use super::{Fleet, PieceId, Place};
use crate::body::LONGEST_TICK;
use crate::{Coefficients, Home, Radiation, WaterSurface};

/// Slower than this (m/s, rad/s) a piece is quiet.
pub(super) const QUIET: f32 = 0.01;
/// For how long a piece is quiet before it asks whether the water is calm, s, and after which it asks again.
const DROWSY: (f32, f32) = (1.0, 0.5);
/// One in so many riders and packs is looked at in a tick, whether it is seen.
const LOOKS: usize = 16;
/// A piece that rides ends to when seen larger by this factor than where it begins.
const MARGIN: f32 = 1.15;
/// A piece begins to ride when it swims as it does at rest: immersed by at least and at most so much of that, and rising
/// no faster than the water by so many m/s.
const SWIMS: (f32, f32, f32) = (0.3, 1.5, 1.0);

impl Fleet {
    /// One tick of `dt` s on `water`. Allocates only where pieces fall asleep, wake, begin or end to ride.
    ///
    /// A `dt` that is not positive does nothing; one above 1 s is cut.
    pub fn step(&mut self, dt: f32, water: &dyn WaterSurface) {
        if !(dt > 0.0 && dt.is_finite()) || self.is_empty() {
            return;
        }
        let (home, by_grid) = (water.home(), self.desc.body.radiation == Radiation::Grid);
        let dt = dt.min(LONGEST_TICK);
        self.felt = home == Home::Shared || (home == Home::Own && by_grid);
        self.dt = dt;
        self.wake(water);
        self.watch();
        let none = Coefficients::default();
        let tick = Tick {
            template: &self.template,
            coefficients: if home != Home::None && by_grid { &none } else { &self.template.coefficients },
            pace: self.template.pace(dt),
            water,
            felt: self.felt,
            tells: by_grid,
            number: self.ticks,
            refresh: self.desc.refresh as usize,
            level: self.level,
        };
        let count = self.awake.len();
        let done = awake::run(&tick, &mut self.awake.packs, count);
        self.resets = self.resets.saturating_add(done.resets);
        self.collide(dt, water);
        self.ride(water);
        self.now += f64::from(dt);
        if self.desc.sleeps && done.quiet >= DROWSY.0 {
            self.fall_asleep(water);
        }
        self.ticks = self.ticks.wrapping_add(1);
    }

    /// Wakes the blocks whose water moves.
    fn wake(&mut self, water: &dyn WaterSurface) {
        let (footprint, refresh) = (self.template.footprint, self.desc.refresh as usize);
        let mut from = 0;
        while let Some(block) = self.sleepers.next_to_wake(from, water, footprint, self.ticks, refresh) {
            let woken = self.sleepers.wake(block);
            for (id, piece) in woken.ids.into_iter().zip(&woken.pieces) {
                self.index[id] = Place::Awake(self.awake.len());
                self.awake.push(id, piece);
            }
            self.number_blocks(block, block + 1);
            from = block;
        }
    }

    /// Notes where the pieces of some blocks are.
    fn number_blocks(&mut self, first: usize, end: usize) {
        for (block, of) in self.sleepers.blocks.iter().enumerate().take(end).skip(first) {
            for (at, id) in of.ids.iter().enumerate() {
                self.index[*id] = Place::Asleep { block, at };
            }
        }
    }

    /// Lays down those who have been quiet for long on calm water.
    fn fall_asleep(&mut self, water: &dyn WaterSurface) {
        let reach = self.template.reach;
        let mut new = Vec::new();
        for i in (0..self.awake.len()).rev() {
            let (pack, lane) = (&mut self.awake.packs[i / LANES], i % LANES);
            if pack.quiet[lane] < DROWSY.0 {
                continue;
            }
            let (x, z) = (pack.position[0][lane], pack.position[2][lane]);
            let (low, high) = (glam::Vec2::new(x - reach, z - reach), glam::Vec2::new(x + reach, z + reach));
            if !water.is_calm(low, high) {
                pack.quiet[lane] -= DROWSY.1;
                continue;
            }
            let id = self.awake.ids[i];
            let mut piece = self.take(Place::Awake(i));
            piece.quiet = 0.0;
            new.push((id, piece));
        }
        if !new.is_empty() {
            let first = self.sleepers.lay(new, reach);
            let end = self.sleepers.blocks.len();
            self.number_blocks(first, end);
        }
    }

    /// Lets pieces ride that are seen too small, and wakes riders that are not.
    fn watch(&mut self) {
        let limit = self.desc.ride_below;
        let eye = self.eye.filter(|_| limit > 0.0);
        if eye.is_none() && self.riders.is_empty() {
            return;
        }
        // Distance beyond which a piece rides.
        let far = 2.0 * self.template.reach / limit.max(1.0e-9);
        let seen = |at: Vec3, from: f32| eye.is_none_or(|eye| eye.distance_squared(at) < from * from);
        let ticks = self.ticks;
        let turn = |i: usize| (i + ticks).is_multiple_of(LOOKS);
        for i in (0..self.riders.len()).rev().filter(|i| eye.is_none() || turn(*i)) {
            if seen(self.riders[i].place(), far / MARGIN) {
                let id = self.riders[i].id;
                let piece = self.take(Place::Riding(i));
                self.index[id] = Place::Awake(self.awake.len());
                self.awake.push(id, &piece);
            }
        }
        if eye.is_none() {
            return;
        }
        for pack in (0..self.awake.packs.len()).rev().filter(|pack| turn(*pack)) {
            for i in (pack * LANES..self.awake.len().min((pack + 1) * LANES)).rev() {
                if !seen(self.awake.state(i).position, far) && self.swims(i) {
                    self.begin_to_ride(i);
                }
            }
        }
    }

    fn swims(&self, i: usize) -> bool {
        let (piece, rest) = (self.awake.get(i), self.template.volume);
        let steady = (piece.state.velocity.y - piece.plane.water.rise()).abs() < SWIMS.2;
        steady && piece.immersed > SWIMS.0 * rest && piece.immersed < SWIMS.1 * rest
    }

    fn begin_to_ride(&mut self, i: usize) {
        let id: PieceId = self.awake.ids[i];
        let piece = self.take(Place::Awake(i));
        self.index[id] = Place::Riding(self.riders.len());
        self.riders.push(Rider::new(id, piece, self.felt, self.now));
    }

    fn ride(&mut self, water: &dyn WaterSurface) {
        let ride = Ride {
            water,
            footprint: self.template.footprint,
            felt: self.felt,
            tick: self.ticks,
            refresh: ride::refresh(self.desc.refresh as usize),
            now: self.now,
            every: self.every(),
        };
        ride::run(&ride, &mut self.riders);
    }
}

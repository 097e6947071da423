//! Contact of flotsam: with bed and quays, and, if asked for, soft contact among pieces, found by a hashed grid.
//!
//! Pieces are balls here. Among them neither friction nor spin comes of it, and what is faster than a piece a tick passes through. All pairs are pushed at
//! once from what was before, so that no order matters: each piece is shared among its contacts, pushed as so many
//! parts, and the parts' mean is its motion (mass splitting: Tonge et al., "Mass splitting for jitter-free parallel rigid
//! body simulation", 2012). That keeps momentum, and the energy never grows but by what springs held.

use glam::Vec3;
use rayon::prelude::*;

use super::lanes::LANES;
use super::pack::Pack;
use super::tick::QUIET;
use super::{Fleet, Place};
use crate::contact::{Contact, sane};
use crate::error::check_range;
use crate::{BodyError, GRAVITY, Hull, Touch, WaterSurface};

/// How the pieces of a fleet keep apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SoftContact {
    /// Of the ball that a piece is to the others, m, 0.001 to 1000.
    pub radius: f32,
    /// How deep two press into each other under a piece's weight, m, 0.0001 to 10.
    pub sink: f32,
}

impl SoftContact {
    /// For pieces of this shape: a ball of its volume, a tenth of it soft.
    pub fn of(hull: &Hull) -> Self {
        let radius = libm::cbrtf(hull.volume() * (0.75 / std::f32::consts::PI)).clamp(0.001, 1000.0);
        Self { radius, sink: (0.1 * radius).clamp(1.0e-4, 10.0) }
    }

    pub(super) fn check(&self) -> Result<(), BodyError> {
        check_range("contact.radius", self.radius, 0.001, 1000.0, "in [0.001, 1000] m")?;
        check_range("contact.sink", self.sink, 1.0e-4, 10.0, "in [0.0001, 10] m").map(drop)
    }
}

/// Most pieces of a bucket that take part: more do not fit unless they were put into one place, and they must not hold up
/// everything.
const CROWDED: usize = 16;
/// Pieces per task.
const CHUNK: usize = 256;
/// Between rows of cells, buckets. Odd.
const ROW: u32 = 0x9E37_79B1;

/// A piece in the grid's order.
#[derive(Clone, Copy, Debug, Default)]
struct Ball {
    at: Vec3,
    velocity: Vec3,
    row: i32,
    /// In the order of the pieces.
    index: u32,
}

/// Where all pieces are: cells as wide as a ball, in buckets.
#[derive(Clone, Debug, Default)]
pub(super) struct Crowd {
    /// First of each bucket in `balls`; one more than there are buckets.
    starts: Vec<u32>,
    /// Place and velocity of each piece: first those awake, then those asleep.
    pub(super) pieces: Vec<(Vec3, Vec3)>,
    /// What is to be added to the velocities.
    pub(super) pushes: Vec<Vec3>,
    balls: Vec<Ball>,
    /// In the order of `balls`.
    touching: Vec<u32>,
    changes: Vec<Vec3>,
}

impl Crowd {
    /// Finds the pushes over `dt` s. Those asleep, all but the first `awake`, are not pushed by each other.
    pub(super) fn part(&mut self, contact: &SoftContact, dt: f32, awake: usize) {
        self.fill(2.0 * contact.radius);
        let Self { starts, balls, touching, changes, pushes, .. } = self;
        let near = Near { starts, balls, apart: 2.0 * contact.radius, awake };
        touching.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, counts)| {
            for (k, count) in counts.iter_mut().enumerate() {
                *count = 0;
                near.each(chunk * CHUNK + k, |_, _, _| *count += 1);
            }
        });
        let spring = Contact { sink: contact.sink, friction: 0.0, restitution: 0.0 };
        let fastest = (GRAVITY * contact.sink.max(0.25 * contact.radius)).sqrt();
        changes.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, changes)| {
            for (k, change) in changes.iter_mut().enumerate() {
                let i = chunk * CHUNK + k;
                *change = Vec3::ZERO;
                if touching[i] == 0 {
                    continue;
                }
                near.each(i, |j, normal, depth| {
                    let spring = spring.spring(depth, dt, fastest);
                    let speed = (balls[i].velocity - balls[j].velocity).dot(normal);
                    // The parts' masses are a piece's over its contacts.
                    let mass = 1.0 / (touching[i] + touching[j]) as f32;
                    *change += normal * (mass * -(spring.mass * (speed + spring.bias)).min(0.0));
                });
            }
        });
        for (ball, change) in balls.iter().zip(changes) {
            pushes[ball.index as usize] = *change;
        }
    }

    /// Sorts the pieces by bucket, in each by their order.
    fn fill(&mut self, cell: f32) {
        let pieces = &self.pieces;
        let buckets = (2 * pieces.len()).next_power_of_two().max(8);
        let mask = buckets as u32 - 1;
        let place = |at: &Vec3| {
            let cells = (*at / cell).floor();
            // Far away the cells are as wide as numbers are coarse.
            (cells.x as i32, cells.z as i32)
        };
        self.starts.clear();
        self.starts.resize(buckets + 1, 0);
        self.balls.resize(pieces.len(), Ball::default());
        self.touching.resize(pieces.len(), 0);
        self.changes.resize(pieces.len(), Vec3::ZERO);
        self.pushes.resize(pieces.len(), Vec3::ZERO);
        for (at, _) in pieces {
            let (column, row) = place(at);
            self.starts[(bucket(column, row) & mask) as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        for (index, (at, velocity)) in pieces.iter().enumerate().rev() {
            let (column, row) = place(at);
            let start = &mut self.starts[(bucket(column, row) & mask) as usize];
            *start -= 1;
            self.balls[*start as usize] = Ball { at: *at, velocity: *velocity, row, index: index as u32 };
        }
    }
}

/// Neighbours along a row are in neighbouring buckets.
fn bucket(column: i32, row: i32) -> u32 {
    (column as u32).wrapping_add((row as u32).wrapping_mul(ROW))
}

struct Near<'a> {
    starts: &'a [u32],
    balls: &'a [Ball],
    /// Distance at which two touch, m.
    apart: f32,
    awake: usize,
}

impl Near<'_> {
    /// Calls for all that touch a ball, in a fixed order, with the direction away from them and the depth.
    fn each(&self, i: usize, mut found: impl FnMut(usize, Vec3, f32)) {
        let ball = self.balls[i];
        let mask = self.starts.len() as u32 - 2;
        let column = (ball.at.x / self.apart).floor() as i32;
        let own = (bucket(column, ball.row) & mask) as usize;
        if i >= self.starts[own] as usize + CROWDED {
            return;
        }
        for row in ball.row.saturating_sub(1)..=ball.row.saturating_add(1) {
            for k in [u32::MAX, 0, 1] {
                let bucket = (bucket(column, row).wrapping_add(k) & mask) as usize;
                let (first, end) = (self.starts[bucket] as usize, self.starts[bucket + 1] as usize);
                for j in first..end.min(first + CROWDED) {
                    let other = &self.balls[j];
                    let away = ball.at - other.at;
                    let square = away.length_squared();
                    let both_sleep = ball.index.min(other.index) as usize >= self.awake;
                    // Rows may share a bucket.
                    if other.row != row || j == i || both_sleep || square >= self.apart * self.apart {
                        continue;
                    }
                    let distance = square.sqrt();
                    let aside = if i < j { Vec3::X } else { Vec3::NEG_X };
                    let normal = if distance > 1.0e-6 * self.apart { away / distance } else { aside };
                    found(j, normal, self.apart - distance);
                }
            }
        }
    }
}

impl Fleet {
    /// Contacts of a tick, after it: they change velocities.
    pub(super) fn collide(&mut self, dt: f32, water: &dyn WaterSurface) {
        if let Some(contact) = self.desc.contact {
            self.keep_apart(&contact, dt);
        }
        if let Some(contact) = self.desc.body.contact {
            let count = self.awake.len();
            for (k, pack) in self.awake.packs.iter_mut().enumerate() {
                press(pack, LANES.min(count - k * LANES), &contact, self.radius, dt, water);
            }
        }
    }

    fn keep_apart(&mut self, contact: &SoftContact, dt: f32) {
        let awake = self.awake.len();
        if awake == 0 {
            return;
        }
        let pieces = &mut self.crowd.pieces;
        pieces.clear();
        pieces.extend((0..awake).map(|i| self.awake.state(i)).map(|s| (s.position, s.velocity)));
        let sleeping = self.sleepers.blocks.iter().flat_map(|block| &block.pieces);
        pieces.extend(sleeping.map(|piece| (piece.state.position, Vec3::ZERO)));
        self.crowd.part(contact, dt, awake);
        for (i, push) in self.crowd.pushes[..awake].iter().enumerate() {
            let (pack, lane) = (&mut self.awake.packs[i / LANES], i % LANES);
            for (row, push) in pack.velocity.iter_mut().zip(push.to_array()) {
                row[lane] += push;
            }
        }
        // What is hit wakes.
        let ids = self.sleepers.blocks.iter().flat_map(|block| &block.ids);
        let hit = ids.zip(&self.crowd.pushes[awake..]).filter(|(_, push)| push.length_squared() > QUIET * QUIET);
        let hit: Vec<_> = hit.map(|(id, push)| (*id, *push)).collect();
        for (id, push) in hit {
            let Some(&place) = self.index.get(id) else { continue };
            let mut piece = self.take(place);
            piece.state.velocity += push;
            self.index[id] = Place::Awake(self.awake.len());
            self.awake.push(id, &piece);
        }
    }
}

/// Pushes the first `count` pieces of a pack out of what is solid, as balls.
fn press(pack: &mut Pack, count: usize, contact: &Contact, radius: f32, dt: f32, water: &dyn WaterSurface) {
    let (mut at, mut touches) = ([Vec3::ZERO; LANES], [Touch::NONE; LANES]);
    for (lane, at) in at.iter_mut().enumerate() {
        *at = Vec3::new(pack.position[0][lane], pack.position[1][lane], pack.position[2][lane]);
    }
    if !water.touch(&at[..count], &mut touches[..count]) {
        return;
    }
    let fastest = (GRAVITY * contact.sink.max(0.25 * radius)).sqrt();
    for (lane, touch) in touches[..count].iter().enumerate() {
        let Touch { depth, normal } = sane(*touch);
        let mut velocity = Vec3::new(pack.velocity[0][lane], pack.velocity[1][lane], pack.velocity[2][lane]);
        let (depth, speed) = (depth + radius, velocity.dot(normal));
        if depth.is_infinite() || depth - speed.min(0.0) * dt <= contact.sink.min(0.0) {
            continue;
        }
        let spring = contact.spring(depth, dt, fastest);
        let push = -(spring.mass * (speed + spring.bias)).min(0.0);
        let sliding = velocity - normal * speed;
        let slide = sliding.length();
        let rub = if slide > 0.0 { (contact.friction * push / slide).min(1.0) } else { 0.0 };
        velocity += normal * push - sliding * rub;
        (pack.velocity[0][lane], pack.velocity[1][lane], pack.velocity[2][lane]) = (velocity.x, velocity.y, velocity.z);
    }
}

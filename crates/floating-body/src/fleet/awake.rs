//! A tick of pieces that are awake: planes are read where they are due, then eight pieces at a time are moved.

use fearless_simd::{Level, Simd, dispatch, f32x8, prelude::*};
use glam::Vec2;
use rayon::prelude::*;

use super::kernel::{Motion, substep};
use super::lanes::{LANES, Turn, V3, load, pair};
use super::pack::Pack;
use super::tell::measure;
use super::template::{Pace, Template};
use super::tick::QUIET;
use super::wet::Surface;
use crate::body::LIMITS;
use crate::forces::read_plane;
use crate::{Coefficients, GRAVITY, SurfacePatch, WaterSurface};

/// Packs that a thread takes at once: with more, two threads finish too far apart. Fixed, and pieces do not see each
/// other, so that results do not depend on threads.
const CHUNK: usize = 8;

/// What a tick is like for all pieces.
pub(super) struct Tick<'a> {
    pub(super) template: &'a Template,
    pub(super) coefficients: &'a Coefficients,
    pub(super) pace: Pace,
    pub(super) water: &'a dyn WaterSurface,
    /// The home grid's waves act.
    pub(super) felt: bool,
    /// What pieces displace is told.
    pub(super) tells: bool,
    pub(super) number: usize,
    /// Ticks from one reading of a plane to the next.
    pub(super) refresh: usize,
    /// Instructions.
    pub(super) level: Level,
}

/// What came of a tick.
#[derive(Clone, Copy, Default)]
pub(super) struct Done {
    /// Pieces that had to be put back to where they were.
    pub(super) resets: u32,
    /// For how long the quietest piece has been so, s.
    pub(super) quiet: f32,
}

impl Done {
    fn with(self, other: Self) -> Self {
        Self { resets: self.resets + other.resets, quiet: self.quiet.max(other.quiet) }
    }
}

/// Moves `count` pieces on.
pub(super) fn run(tick: &Tick, packs: &mut [Pack], count: usize) -> Done {
    let one = |(i, packs): (usize, &mut [Pack])| {
        let first = i * CHUNK;
        read(tick, packs, first, count - first * LANES);
        dispatch!(tick.level, simd => advance(simd, tick, packs, count - first * LANES))
    };
    if packs.len() <= CHUNK {
        return one((0, packs));
    }
    packs.par_chunks_mut(CHUNK).enumerate().map(one).reduce(Done::default, Done::with)
}

/// Reads the planes that are due, of `count` pieces at most; `first` is the number of the first pack.
fn read(tick: &Tick, packs: &mut [Pack], first: usize, count: usize) {
    let mut centers = [Vec2::ZERO; CHUNK * LANES];
    let mut patches = [SurfacePatch::default(); CHUNK * LANES];
    let due = |i: usize, pack: &Pack| pack.fresh || (first + i + tick.number).is_multiple_of(tick.refresh);
    let mut n = 0;
    for (i, pack) in packs.iter().enumerate().filter(|(i, p)| due(*i, p)) {
        for lane in 0..LANES.min(count - i * LANES) {
            centers[n] = Vec2::new(pack.position[0][lane], pack.position[2][lane]);
            n += 1;
        }
    }
    tick.water.patches(&centers[..n], tick.template.footprint, &mut patches[..n]);
    let mut n = 0;
    for (i, pack) in packs.iter_mut().enumerate() {
        if !due(i, pack) {
            continue;
        }
        pack.fresh = false;
        for lane in 0..LANES.min(count - i * LANES) {
            let (water, ambient) = read_plane(centers[n], &patches[n]);
            pack.read_plane(lane, water, ambient);
            n += 1;
        }
    }
}

#[inline(always)]
fn advance<S: Simd>(simd: S, tick: &Tick, packs: &mut [Pack], count: usize) -> Done {
    // No closures from here on: they would not be inlined for certain, and without the machine's vectors.
    let mut done = Done::default();
    for (i, pack) in packs.iter_mut().enumerate() {
        done.resets += step(simd, tick, pack);
        for quiet in pack.quiet.iter().take(count - i * LANES) {
            done.quiet = done.quiet.max(*quiet);
        }
    }
    done
}

/// The plane as it has moved on since it was read.
#[inline(always)]
fn surface<S: Simd>(simd: S, pack: &Pack, felt: bool) -> Surface<S> {
    let (slope, ambient) = (pair(simd, &pack.slope), pair(simd, &pack.ambient));
    let flow = V3::load(simd, &pack.flow);
    let (age, acceleration) = (load(simd, &pack.age), load(simd, &pack.acceleration));
    let rise = flow.y - (slope[0] * flow.x + slope[1] * flow.z);
    let carried = (rise + acceleration * age * 0.5) * age;
    let height = load(simd, &pack.height) + carried;
    let turned = pair(simd, &pack.turning);
    let turned = [turned[0] * age, turned[1] * age];
    // As far as driven by the mean slope.
    let driven = [slope[0] + turned[0] * 0.5, slope[1] + turned[1] * 0.5];
    let slope = [slope[0] + turned[0], slope[1] + turned[1]];
    let ambient = [ambient[0] + turned[0], ambient[1] + turned[1]];
    let decay = load(simd, &pack.decay);
    Surface {
        center: pair(simd, &pack.center),
        height: if felt { height + load(simd, &pack.own) } else { height },
        gradient: if felt { slope } else { ambient },
        slope,
        // Water is driven down the slope of the surface that it makes.
        flow: V3::new(
            flow.x - driven[0] * age * GRAVITY,
            flow.y + acceleration * age,
            flow.z - driven[1] * age * GRAVITY,
        ),
        acceleration,
        decay,
        wave: height - load(simd, &pack.level),
        still: load(simd, &pack.level),
        ambient,
        fades: decay.simd_gt(f32x8::splat(simd, 0.0)).any_true(),
    }
}

#[inline(always)]
fn step<S: Simd>(simd: S, tick: &Tick, pack: &mut Pack) -> u32 {
    let surface = surface(simd, pack, tick.felt);
    pack.before = (pack.position, pack.orientation);
    let mut motion = Motion {
        position: V3::load(simd, &pack.position),
        turn: Turn::load(simd, &pack.orientation),
        velocity: V3::load(simd, &pack.velocity),
        spin: V3::load(simd, &pack.spin),
    };
    let mut immersed = f32x8::splat(simd, 0.0);
    for _ in 0..tick.pace.count {
        immersed = substep(simd, tick.template, tick.coefficients, &tick.pace, &surface, &mut motion);
    }
    if tick.tells {
        measure(simd, tick.template, tick.pace.tick, &surface, &motion, pack);
    }
    let far = f32x8::splat(simd, LIMITS.2);
    let V3 { x, y, z } = motion.position;
    // A comparison with NaN is false.
    let near = x.abs().simd_le(far) & y.abs().simd_le(far) & z.abs().simd_le(far);
    let moving = motion.velocity.dot(motion.velocity) + motion.spin.dot(motion.spin);
    let sane = near & moving.simd_le(f32x8::splat(simd, f32::MAX));
    let sane = sane & motion.turn.w.abs().simd_le(f32x8::splat(simd, 2.0));
    motion.velocity = motion.velocity.shortened(simd, LIMITS.0);
    motion.spin = motion.spin.shortened(simd, LIMITS.1);
    motion.position.store(&mut pack.position);
    motion.turn.store(&mut pack.orientation);
    motion.velocity.store(&mut pack.velocity);
    motion.spin.store(&mut pack.spin);
    immersed.store_slice(&mut pack.immersed);
    let still = moving.simd_lt(f32x8::splat(simd, QUIET * QUIET));
    let quiet = still.select(load(simd, &pack.quiet) + tick.pace.tick, f32x8::splat(simd, 0.0));
    quiet.store_slice(&mut pack.quiet);
    (load(simd, &pack.age) + tick.pace.tick).store_slice(&mut pack.age);
    if sane.all_true() { 0 } else { put_back(pack, !(sane.to_bitmask() as u32) & 0xff) }
}

/// Pieces whose state is none (a bit each) go back to where they were, at rest.
#[cold]
fn put_back(pack: &mut Pack, lanes: u32) -> u32 {
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
        let (position, orientation) = pack.before(lane);
        pack.set_state(lane, &crate::BodyState { orientation, ..crate::BodyState::at_rest(position) });
        (pack.immersed[lane], pack.quiet[lane], pack.fresh) = (0.0, 0.0, true);
        pack.told[0][2][lane] = -1.0;
    }
    lanes.count_ones()
}

//! The end of a tick: how high each tile's waves are, and the foam they leave.
//!
//! Water breaks where its crest falls too fast: foam grows with the downward acceleration -(c/h)^2 lap z above [`ONSET`]
//! g and decays with time constant [`DECAY`]. Real crests break below 1 g; here all waves travel at one speed c, and
//! c^2 k of the short ones is many times the g of real ones, so the onset is chosen by eye. Over a bed water also breaks
//! where it is higher than [`SHALLOW`] of the depth (taken from c^2 = g depth), and at walls where it rises or falls
//! faster than [`SPLASH`]. Only for looks.

use crate::cpu::kernels::note;
use crate::cpu::tiles::{Class, Mode, Tiles};
use crate::desc::TILE;
use crate::ground::Cells;
use crate::state::State;
use crate::{GridDesc, Stepping};

/// Downward acceleration where foam begins, in g.
pub(crate) const ONSET: f32 = 5.0;
/// Acceleration above the onset, in g, at which foam grows at the full rate.
pub(crate) const RANGE: f32 = 10.0;
/// The same for water waves, whose crests break at 0.4 to 0.5 g: where foam begins, and the acceleration above that.
const CREST: [f32; 2] = [0.35, 0.5];
/// Wavenumber times cell size of the crests that break: the acceleration is taken from their Laplacian.
const CREST_NUMBER: f32 = 0.6;
/// Foam per second at the full rate.
pub(crate) const RATE: f32 = 4.0;
/// Time constant of the decay, seconds.
pub(crate) const DECAY: f32 = 5.0;
/// Height over depth where waves begin to break; they do fully at half as much again.
const SHALLOW: f32 = 0.4;
/// Rate of the height at a wall where foam begins, m/s; it grows at the full rate at twice that.
const SPLASH: f32 = 0.6;
/// Waves below this break over no bed, metres.
const FLAT: f32 = 2e-3;
const GRAVITY: f32 = 9.81;

/// Numbers of the foam's update.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FoamLaw {
    /// Excess per metre of Laplacian (sum of neighbours minus 4 z, those along z times the aspect): (c/h)^2 / (g RANGE).
    pub(crate) scale: f32,
    /// ONSET / RANGE.
    pub(crate) onset: f32,
    /// Growth in a tick at full rate.
    pub(crate) growth: f32,
    /// Factor left after a tick.
    pub(crate) keep: f32,
    /// Height where waves of the deep water's speed begin to break by depth, metres.
    pub(crate) depth: f32,
    /// a of deep water along x.
    pub(crate) deep: f32,
    /// a along z over a along x.
    pub(crate) aspect: f32,
    /// 1 / [`SPLASH`] per metre of rise in a sub-step.
    pub(crate) splash: f32,
}

impl FoamLaw {
    pub(crate) fn new(desc: &GridDesc, stepping: &Stepping) -> Self {
        let tick = desc.tick;
        let speed = desc.wave_speed / desc.cell_size[0];
        let (scale, onset, depth) = if desc.scheme.is_wave_equation() {
            let depth = SHALLOW * desc.wave_speed * desc.wave_speed / GRAVITY;
            (speed * speed / (GRAVITY * RANGE), ONSET / RANGE, depth)
        } else {
            // g k z of crests, k that of the shortest waves that a boat makes.
            (1.0 / (CREST_NUMBER * desc.cell_size[0] * CREST[1]), CREST[0] / CREST[1], SHALLOW * desc.cell_size[0])
        };
        Self {
            depth,
            deep: stepping.a[0] as f32,
            aspect: stepping.aspect(),
            splash: 1.0 / (SPLASH * stepping.dt as f32),
            scale,
            onset,
            growth: RATE * tick,
            keep: 1.0 / (1.0 + tick / DECAY),
        }
    }
}

/// Notes how high the waves of each active tile are, of all or of those with a current.
pub(crate) fn measure(state: &State, tiles: &mut Tiles, all: bool) {
    let [count_x, count_z] = tiles.count;
    for tz in 0..count_z {
        for tx in 0..count_x {
            let at = tz * count_x + tx;
            if tiles.tiles[at].mode == Mode::Active && (all || tiles.tiles[at].carried) {
                let (x, z) = (tiles.span(0, tx), tiles.span(1, tz));
                let [top, before] = [&state.z, &state.old].map(|array| largest(array, state.nx, x.clone(), z.clone()));
                let tile = &mut tiles.tiles[at];
                (tile.top, tile.height) = (top, top.max(before));
            }
        }
    }
}

/// Updates the foam of the active tiles from z as the last sub-step found it.
pub(crate) fn settle(state: &mut State, tiles: &mut Tiles, cells: Option<&Cells>, law: FoamLaw) {
    let [count_x, count_z] = tiles.count;
    for tz in 0..count_z {
        for tx in 0..count_x {
            let tile = tiles.tiles[tz * count_x + tx];
            if tile.mode != Mode::Active {
                continue;
            }
            // No crest of the neighbourhood is high enough to break: the Laplacian is at most eight times the height
            // where cells are square.
            let around = (tz.saturating_sub(1)..(tz + 2).min(count_z))
                .flat_map(|z| &tiles.row(z)[tx.saturating_sub(1)..(tx + 2).min(count_x)])
                .fold(0.0f32, |most, t| most.max(t.height));
            let mixed = cells.filter(|_| tile.class == Class::Mixed);
            // Nor high enough against any depth, nor fast enough at any wall.
            let shore = mixed.is_some() && (around > FLAT || 2.0 * around * law.splash > 1.0);
            if tile.foam > 0.0 || shore || 4.0 * (1.0 + law.aspect) * around * law.scale > law.onset {
                let (x, z) = (tiles.span(0, tx), tiles.span(1, tz));
                let foam = match mixed {
                    Some(cells) => mixed_tile_foam(state, cells, x, z, law),
                    None => tile_foam(state, x, z, law),
                };
                tiles.tiles[tz * count_x + tx].foam = foam;
            }
        }
    }
}

type Span = std::ops::Range<usize>;

fn largest(array: &[f32], nx: usize, x: Span, z: Span) -> f32 {
    let mut most = [0.0f32; TILE];
    for j in z {
        for (m, v) in most.iter_mut().zip(&array[j * nx + x.start..j * nx + x.end]) {
            note(m, *v);
        }
    }
    most.into_iter().fold(0.0, f32::max)
}

/// A tile whose medium varies.
fn mixed_tile_foam(state: &mut State, cells: &Cells, x: Span, z: Span, law: FoamLaw) -> f32 {
    let State { nx, nz, z: next, old, foam, .. } = state;
    let (nx, nz) = (*nx, *nz);
    let (from, to) = (x.start.max(1), x.end.min(nx - 1));
    let mut most = [0.0f32; TILE];
    if from >= to {
        return 0.0;
    }
    for j in z.start.max(1)..z.end.min(nz - 1) {
        let own = j * nx + from..j * nx + to;
        let around = [j - 1, j, j + 1].map(|j| j * nx + from - 1..j * nx + to + 1);
        let row = MixedRow {
            old: around.clone().map(|row| &old[row]),
            a: around.map(|row| &cells.a[row]),
            r: &cells.r[own.clone()],
            next: &next[own.clone()],
        };
        mixed_foam_row(&mut foam[own], &row, law, &mut most);
    }
    most.into_iter().fold(0.0, f32::max)
}

/// What a row of at most 16 cells reads: rows below, here and above with one more cell at each end, and its own cells.
struct MixedRow<'a> {
    old: [&'a [f32]; 3],
    a: [&'a [f32]; 3],
    r: &'a [f32],
    next: &'a [f32],
}

#[inline(never)]
fn mixed_foam_row(foam: &mut [f32], row: &MixedRow, law: FoamLaw, most: &mut [f32; TILE]) {
    let n = foam.len().min(TILE);
    let foam = &mut foam[..n];
    let [south, here, north] = row.old.map(|z| &z[..n + 2]);
    let [a_south, a_here, a_north] = row.a.map(|a| &a[..n + 2]);
    let (r, next) = (&row.r[..n], &row.next[..n]);
    let limit = law.depth / law.deep;
    let lesser = |a: f32, b: f32| if a < b { a } else { b };
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    for i in 0..n {
        let (z, a) = (here[i + 1], a_here[i + 1]);
        let around = [(a_here[i], here[i]), (a_here[i + 2], here[i + 2])];
        let across = [(a_south[i + 1], south[i + 1]), (a_north[i + 1], north[i + 1])];
        let jump = |(a, other): (f32, f32)| if a > 0.0 { other - z } else { 0.0 };
        let lap = (jump(around[0]) + jump(around[1])) + law.aspect * (jump(across[0]) + jump(across[1]));
        let steep = -lap * law.scale - law.onset;
        let high = 2.0 * z / (limit * greater(a, 1e-20)) - 2.0;
        let least = lesser(lesser(around[0].0, around[1].0), lesser(across[0].0, across[1].0));
        let rise = (next[i] - z).abs() * law.splash - 1.0;
        let rise = if least > 0.0 { 0.0 } else { rise };
        let excess = lesser(greater(greater(steep, greater(high, rise)), 0.0), 1.0);
        let f = lesser(foam[i] * law.keep + excess * law.growth, 1.0);
        // None on walls and held water.
        let f = if r[i] > 0.0 { f } else { 0.0 };
        foam[i] = f;
        most[i] = greater(f, most[i]);
    }
}

fn tile_foam(state: &mut State, x: Span, z: Span, law: FoamLaw) -> f32 {
    let State { nx, nz, old, foam, .. } = state;
    let (nx, nz) = (*nx, *nz);
    let (from, to) = (x.start.max(1), x.end.min(nx - 1));
    let mut most = [0.0f32; TILE];
    if from >= to {
        return 0.0;
    }
    for j in z.start.max(1)..z.end.min(nz - 1) {
        let around = |row: usize| &old[row * nx + from - 1..row * nx + to + 1];
        let foam = &mut foam[j * nx + from..j * nx + to];
        foam_row(foam, around(j - 1), around(j), around(j + 1), law, &mut most);
    }
    most.into_iter().fold(0.0, f32::max)
}

/// At most 16 cells of one row; the rows around have one more cell at each end.
#[inline(never)]
fn foam_row(foam: &mut [f32], south: &[f32], row: &[f32], north: &[f32], law: FoamLaw, most: &mut [f32; TILE]) {
    let n = foam.len().min(TILE);
    let (west, centre, east) = (&row[..n], &row[1..n + 1], &row[2..n + 2]);
    let (south, north, foam) = (&south[1..n + 1], &north[1..n + 1], &mut foam[..n]);
    for i in 0..n {
        let (along_x, along_z) =
            ((west[i] - centre[i]) + (east[i] - centre[i]), (south[i] - centre[i]) + (north[i] - centre[i]));
        let lap = along_x + law.aspect * along_z;
        let excess = (-lap * law.scale - law.onset).clamp(0.0, 1.0);
        let f = foam[i] * law.keep + excess * law.growth;
        let f = if f > 1.0 { 1.0 } else { f };
        foam[i] = f;
        most[i] = if f > most[i] { f } else { most[i] };
    }
}

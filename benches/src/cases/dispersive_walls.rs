//! Cases `wall`, `gap` and `dispersive_energy`: water waves between walls, over the dispersive scheme.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use rustfft::num_complex::Complex;
use wave_grid::{Border, CellKind, GridDesc, Medium, MediumCell, Scheme, Source, WaveGrid};

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures::Random,
    truth::diffraction::Slit,
};

/// See the module.
pub(super) const WALL: Case = Case {
    name: "wall",
    about: "water waves against a wall, and a domain of twice the size with mirrored sources",
    plots: &[],
    run: wall,
};

/// See the module.
pub(super) const GAP: Case = Case {
    name: "gap",
    about: "height of steady water waves behind a gap in a wall against the exact solution",
    plots: &[],
    run: gap,
};

/// See the module.
pub(super) const ENERGY: Case = Case {
    name: "dispersive_energy",
    about: "energy of water waves between walls at random over a bed at random, in a long run",
    plots: &[],
    run: energy,
};

/// A medium as a function of the place in world cells.
pub(super) struct Water<F> {
    pub(super) cell: f64,
    pub(super) at: F,
}

impl<F: Fn(DVec2) -> MediumCell + Send + Sync> Medium for Water<F> {
    fn at(&self, place: DVec2, _: f32) -> MediumCell {
        (self.at)(place / self.cell)
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

/// G = .00545.
pub(super) fn desc(cells: [u32; 2], border: Border) -> GridDesc {
    GridDesc { cells, border, scheme: Scheme::Dispersive, substeps: Some(1), ..GridDesc::default() }
}

pub(super) const WALLED: MediumCell =
    MediumCell { speed: 0.0, depth: 0.0, damping: 0.0, kind: CellKind::Wall, current: Vec2::ZERO };

fn wall(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(1_000, 20_000);
    let mut rows = Vec::new();
    for (variant, border) in [("basin", Border::Reflecting), ("through the border", Border::default())] {
        let desc = desc([160, 96], border);
        let [mut half, mut whole] = [WaveGrid::new(desc)?, WaveGrid::new(desc)?];
        let at = |place: DVec2| if place.x > 0.0 { WALLED } else { MediumCell::default() };
        half.set_medium(Some(Arc::new(Water { cell: 0.5, at })));
        // All tiles of both: what is quiet enough to be skipped is larger than the difference.
        half.set_tile_skipping(false);
        whole.set_tile_skipping(false);
        let (mut worst, mut most) = (0.0f32, 0.0f32);
        for tick in 0..ticks {
            if tick < 120 {
                let volume = (0.05 * tick as f32).sin();
                for center in [Vec2::new(-9.0, 0.3), Vec2::new(-6.25, -8.0)] {
                    let source = |center| Source::Displacement { center, radius: 1.5, volume };
                    half.add(source(center));
                    whole.add(source(center));
                    whole.add(source(center * Vec2::new(-1.0, 1.0)));
                }
            }
            half.tick();
            whole.tick();
            for row in 0..96 {
                for at in row * 160..row * 160 + 80 {
                    worst = worst.max((half.heights()[at] - whole.heights()[at]).abs());
                    most = most.max(whole.heights()[at].abs());
                }
            }
        }
        rows.push(
            Row::new("wall", variant)
                .param("ticks", ticks)
                .error(f64::from(worst / most), "of the largest height", "the mirrored domain")
                .bound(1e-5),
        );
    }
    Ok(rows)
}

/// Cells of wall along the sides of a channel: a paddle from wall to wall is even all along, and fits into the window.
pub(super) const SIDE: usize = 6;

/// A paddle across a channel, at a face x (cells from the window's corner).
pub(super) fn paddle(grid: &mut WaveGrid, x: usize, flow: f64) -> Result<(), CaseError> {
    let [nx, nz] = grid.desc().cells.map(|n| n as f32);
    let cell = grid.desc().cell_size[0];
    let (x, z) = (cell * (x as f32 - 0.5 * nx), cell * (0.5 * nz - SIDE as f32));
    let done = grid.add(Source::Paddle { from: Vec2::new(x, -z), to: Vec2::new(x, z), flow: flow as f32 });
    if done { Ok(()) } else { Err("the paddle does not fit".into()) }
}

/// Damping that grows to `most` (1/s) at `width` cells into a beach that absorbs.
pub(super) fn beach(into: f64, width: f64, most: f64) -> f32 {
    (most * (into / width).clamp(0.0, 1.0).powi(3)) as f32
}

fn gap(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    // Ticks a period: 12, 16, 24 and 32 cells a wave.
    for &period in context.pick(&[118usize][..], &[118, 136, 167, 193]) {
        for widths in [1.0, 2.0] {
            rows.push(behind_gap(period, widths)?);
        }
    }
    Ok(rows)
}

/// Looked at: from one to so many wavelengths behind the wall, and to so many from the gap's middle.
const REACH: f64 = 5.0;

/// The half of the water on one side of the gap's middle, which is a mirror: beach, wave maker, wall with a gap, what is
/// looked at, beach. In front the far side is a mirror too; what the gap sends there returns too late to be seen.
fn behind_gap(period: usize, widths: f64) -> Result<Row, CaseError> {
    let omega = TAU / period as f64;
    let g = desc([48; 2], Border::Reflecting).stepping()?.a[0];
    let k = omega * omega / g;
    let wavelength = TAU / k;
    let cells = |waves: f64| (waves * wavelength).round() as usize;
    let (maker, wall, end) = (cells(4.0), cells(6.5), cells(11.5));
    let [nx, nz] = [cells(15.5), (cells(9.0) + 2 * SIDE).next_multiple_of(2)];
    let nx = nx.next_multiple_of(2);
    let half_gap = cells(0.5 * widths);
    let damping = 0.5 * omega * 60.0;
    // Waves in a channel without the wall first: how high they come.
    let (mut incoming, mut sums) = (0.0, Vec::new());
    for with_wall in [false, true] {
        let nz = if with_wall { nz } else { 48 };
        let mut grid = WaveGrid::new(desc([nx as u32, nz as u32], Border::Reflecting))?;
        let [low_x, low_z] = grid.window().corner;
        let cell = f64::from(grid.desc().cell_size[0]);
        let at = move |place: DVec2| {
            let (i, j) = (place.x.floor() - low_x as f64, place.y.floor() - low_z as f64);
            let j = j - SIDE as f64;
            let beside = j < 0.0 || j >= (nz - 2 * SIDE) as f64;
            if beside || (with_wall && i == wall as f64 && j >= half_gap as f64) {
                return WALLED;
            }
            let width = 4.0 * wavelength;
            let ends = beach(maker as f64 - i, width, damping).max(beach(i - end as f64, width, damping));
            let behind = with_wall && i > wall as f64;
            let side = if behind { beach(j - REACH * wavelength, width, damping) } else { 0.0 };
            MediumCell { damping: ends.max(side), ..MediumCell::default() }
        };
        grid.set_medium(Some(Arc::new(Water { cell, at })));
        grid.set_tile_skipping(false);
        let ticks = 30 * period;
        sums = vec![Complex::<f64>::default(); nx * nz];
        for tick in 0..ticks {
            let phase = omega * tick as f64;
            let grown = (phase / (4.0 * TAU)).min(1.0);
            paddle(&mut grid, maker, 1e-3 * phase.sin() * grown * grown * (3.0 - 2.0 * grown))?;
            grid.tick();
            if tick + period >= ticks {
                let turn = Complex::from_polar(2.0 / period as f64, phase);
                for (sum, z) in sums.iter_mut().zip(grid.heights()) {
                    *sum += turn * f64::from(*z);
                }
            }
        }
        if !with_wall {
            let looked = wall..end;
            let count = looked.len() as f64;
            incoming = looked.map(|i| sums[24 * nx + i].norm()).sum::<f64>() / count;
        }
    }
    let slit = Slit::new(k, half_gap as f64);
    let (mut worst, mut place, mut squares) = (0.0f64, [0.0; 2], [0.0; 2]);
    for i in (wall + cells(1.0)..end).step_by(2) {
        for j in (0..cells(REACH)).step_by(2) {
            let from_gap = [(i - wall) as f64, j as f64 + 0.5];
            let truth = slit.at(from_gap[0], from_gap[1]).norm();
            let error = sums[(j + SIDE) * nx + i].norm() / incoming - truth;
            squares[0] += error * error;
            squares[1] += truth * truth;
            if error.abs() > worst {
                (worst, place) = (error.abs(), from_gap.map(|x| (x / wavelength * 10.0).round() / 10.0));
            }
        }
    }
    let rounded = |x: f64| (x * 100.0).round() / 100.0;
    Ok(Row::new("gap", format!("about {widths} wavelengths wide"))
        .param("cells_per_wavelength", rounded(wavelength))
        .param("gap_cells", 2 * half_gap)
        .param("rms_percent", rounded(100.0 * (squares[0] / squares[1]).sqrt()))
        .param("worst_at_wavelengths", format!("{place:?}"))
        .error(100.0 * worst, "%", "of the incoming height: slit by its integral equation")
        .bound(5.0))
}

/// A bed of .3 to 100 cells and walls in every tenth cell, each cell by its own chance.
fn rubble(place: DVec2) -> MediumCell {
    let [i, j] = [place.x, place.y].map(|x| x.floor() as i64 as u64);
    let mut chance = Random::new(i.wrapping_mul(0x9e37_79b9) ^ j.wrapping_mul(0x85eb_ca6b_0000) ^ 7);
    chance.within(0.0, 1.0);
    if chance.within(0.0, 1.0) < 0.1 {
        return WALLED;
    }
    let depth = 0.5 * 0.3 * (100.0f64 / 0.3).powf(chance.within(0.0, 1.0));
    MediumCell { depth: depth as f32, ..MediumCell::default() }
}

fn energy(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    let mut random = Random::new(4);
    let ticks = context.pick(4_000, 1_000_000);
    for (variant, bed) in [("basin, deep", false), ("basin, rubble", true)] {
        let mut grid = WaveGrid::new(desc([64; 2], Border::Reflecting))?;
        if bed {
            grid.set_medium(Some(Arc::new(Water { cell: 0.5, at: rubble })));
        }
        grid.set_tile_skipping(false);
        let noise: Vec<f32> = (0..64 * 64).map(|_| random.within(-0.1, 0.1) as f32).collect();
        grid.impose(&noise, &noise)?;
        grid.tick();
        let first = grid.energy();
        let (mut least, mut most) = (first, first);
        for tick in 0..ticks {
            grid.tick();
            if tick % 100 == 99 {
                let energy = grid.energy();
                least = least.min(energy);
                // An energy that is not a number stays so.
                most = if energy > most || energy.is_nan() { energy } else { most };
            }
        }
        let percent = |energy: f64| (energy / first - 1.0) * 100.0;
        rows.push(
            Row::new("dispersive_energy", variant)
                .param("ticks", ticks)
                .param("lost_percent", (percent(least) * 1e4).round() / 1e4)
                .error(percent(most), "%", "growth over the energy at the start, noise of a cell's length")
                .bound(0.5),
        );
    }
    rows.push(wandering(ticks)?);
    Ok(rows)
}

/// A window that runs to and fro over rubble with an absorbing border.
fn wandering(ticks: usize) -> Result<Row, CaseError> {
    let mut grid = WaveGrid::new(desc([96; 2], Border::default()))?;
    grid.set_medium(Some(Arc::new(Water { cell: 0.5, at: rubble })));
    let mut random = Random::new(8);
    let (mut place, mut velocity) = (DVec2::ZERO, DVec2::ZERO);
    let mut peaks = [0.0f64; 2];
    for tick in 0..ticks {
        if tick % 60 == 0 {
            velocity = DVec2::from_angle(random.within(0.0, TAU)) * random.within(0.0, 10.0);
        }
        place += velocity / 60.0;
        grid.center_on(place);
        let volume = if tick % 2 == 0 { 0.01 } else { -0.01 };
        let center = (place + DVec2::new(random.within(-8.0, 8.0), random.within(-8.0, 8.0))).as_vec2();
        grid.add(Source::Displacement { center, radius: 0.4, volume });
        grid.tick();
        let energy = grid.heights().iter().map(|z| f64::from(*z).powi(2)).sum::<f64>();
        let peak = &mut peaks[usize::from(tick >= ticks / 2)];
        *peak = if energy.is_finite() { peak.max(energy) } else { f64::NAN };
    }
    Ok(Row::new("dispersive_energy", "window at random over rubble, absorbing border")
        .param("ticks", ticks)
        .error(peaks[1] / peaks[0], "ratio", "sum of squared heights: peak of the run's second half over the first's")
        .bound(4.0))
}

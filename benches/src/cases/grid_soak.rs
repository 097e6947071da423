//! Case `soak`: a long run of everything at random holds no more energy than was put in.

use std::sync::Arc;
use std::time::Instant;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, Medium, MediumCell, Source, WaveGrid};

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures::{self, Random},
};

/// See the module.
pub(super) const SOAK: Case = Case {
    name: "soak",
    about: "steps under random moves, maps and sources: energy against what was put in, time late against early",
    plots: &[],
    run,
};

/// Ticks over which what was put in is summed: whatever is older has left through the border or been damped.
const MEMORY: usize = 2_000;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(6_000, 1_000_000);
    let nine = GridDesc { cells: [96, 80], ..fixtures::grid() };
    let five = GridDesc { cells: [96, 80], ..fixtures::paper_grid() };
    let oblong = GridDesc { cell_size: [nine.cell_size[0], 1.5 * nine.cell_size[1]], ..nine };
    let mut rows = Vec::new();
    for (variant, desc) in [("9-point", nine), ("5-point", five), ("9-point, oblong cells", oblong)] {
        let soaked = Soak::new(desc, 5)?.run(ticks)?;
        let row = |variant: String| {
            Row::new("soak", variant)
                .param("steps", ticks * desc.stepping().map_or(0, |stepping| stepping.substeps as usize))
                .param("cells", "96 x 80")
        };
        rows.push(
            row(variant.to_owned())
                .param("peak_m", f64::from((soaked.peak * 1e3).round()) / 1e3)
                .error(soaked.energy, "ratio", "energy put in by sources and maps over the last 2,000 ticks")
                .bound(1.0),
        );
        let early = "time of a tick after 2,000";
        rows.push(row(format!("{variant}, time at the end")).error(soaked.late, "ratio", early).bound(2.0));
        let waves = "time of a tick with waves";
        rows.push(row(format!("{variant}, time of dying waves")).error(soaked.calm, "ratio", waves).bound(2.0));
    }
    Ok(rows)
}

/// What a run found.
struct Soaked {
    /// Largest energy over what was put in lately.
    energy: f64,
    /// Largest height, m.
    peak: f32,
    /// Time of a tick at the end of the run over that near its beginning.
    late: f64,
    /// Time of a tick once all has died down over that before.
    calm: f64,
}

struct Soak {
    grid: WaveGrid,
    random: Random,
    place: DVec2,
    velocity: DVec2,
    /// Energy put in, by tick modulo [`MEMORY`].
    put: Vec<f64>,
}

impl Soak {
    fn new(desc: GridDesc, seed: u64) -> Result<Self, CaseError> {
        let (place, velocity) = (DVec2::ZERO, DVec2::ZERO);
        Ok(Self { grid: WaveGrid::new(desc)?, random: Random::new(seed), place, velocity, put: vec![0.0; MEMORY] })
    }

    fn run(mut self, ticks: usize) -> Result<Soaked, CaseError> {
        let (mut worst, mut peak) = (0.0f64, 0.0f32);
        let mut early = None;
        for tick in 0..ticks {
            self.put[tick % MEMORY] = 0.0;
            self.wander(tick);
            if tick % 4 == 0 {
                self.put[tick % MEMORY] = self.disturb(tick);
                let put: f64 = self.put.iter().sum();
                let share = self.grid.energy() / put;
                // What is not a number is to be seen.
                if tick >= MEMORY && (share > worst || share.is_nan()) {
                    worst = share;
                }
            }
            self.grid.tick();
            if tick == MEMORY {
                early = Some(self.grid.clone());
            }
            if tick % 100 == 0 {
                peak = self.grid.heights().iter().fold(peak, |peak, z| peak.max(z.abs()));
                if !self.grid.is_finite() {
                    return Err(format!("not finite after {tick} ticks").into());
                }
            }
        }
        let late = early.map_or(f64::NAN, |early| time_ratio(&self.grid, &early));
        Ok(Soaked { energy: worst, peak, late, calm: calm(&self.grid) })
    }

    /// Moves the window: at times it stands, at times it is faster than the waves, seldom it is elsewhere.
    fn wander(&mut self, tick: usize) {
        let random = &mut self.random;
        if tick.is_multiple_of(40) {
            let speed = random.within(-0.5, 2.0).max(0.0) * f64::from(self.grid.desc().wave_speed);
            self.velocity = DVec2::from_angle(random.within(0.0, std::f64::consts::TAU)) * speed;
            if random.within(0.0, 1.0) < 0.01 {
                self.place = DVec2::new(random.within(-1e5, 1e5), random.within(-1e5, 1e5));
            }
        }
        self.place += self.velocity * f64::from(self.grid.desc().tick);
        self.grid.center_on(self.place);
        self.grid.set_origin(self.place);
    }

    /// Sources, and now and then another map. Returns the energy put in: what each of them adds, not what it takes away.
    fn disturb(&mut self, tick: usize) -> f64 {
        let mut put = 0.0;
        let mut energy = self.grid.energy();
        let mut count = |grid: &WaveGrid| {
            let now = grid.energy();
            put += (now - energy).max(0.0);
            energy = now;
        };
        if tick.is_multiple_of(300) {
            let bed = Bed { kind: (tick / 300) % 4, seed: tick as i64, cell: f64::from(self.grid.desc().cell_size[0]) };
            self.grid.set_medium((bed.kind > 0).then(|| Arc::new(bed) as Arc<dyn Medium>));
            count(&self.grid);
        }
        let random = &mut self.random;
        let center = Vec2::new(random.within(-2.5, 2.5) as f32, random.within(-2.5, 2.5) as f32);
        let radius = random.within(0.0, 0.8) as f32;
        let source = if tick.is_multiple_of(16) {
            Source::Turbulence { center, radius, foam: 0.5 }
        } else {
            Source::Displacement { center, radius, volume: random.within(-0.05, 0.05) as f32 }
        };
        self.grid.add(source);
        count(&self.grid);
        put
    }
}

/// Time of a tick when all has died down, to numbers below the normal ones and to zero, over that of the waves before.
fn calm(grid: &WaveGrid) -> f64 {
    let mut waves = grid.clone();
    waves.set_medium(Some(Arc::new(Bed { kind: MUD, seed: 0, cell: f64::from(grid.desc().cell_size[0]) })));
    waves.set_tile_skipping(false);
    let mut calm = waves.clone();
    let mut slowest = 0.0f64;
    for _ in 0..12 {
        for _ in 0..400 {
            calm.tick();
        }
        slowest = slowest.max(time_ratio(&calm, &waves));
    }
    slowest
}

/// Time of the next ticks of one grid over those of another, every cell stepped: in turns, the least of many.
fn time_ratio(one: &WaveGrid, other: &WaveGrid) -> f64 {
    let mut least = [f64::INFINITY; 2];
    for _ in 0..40 {
        for (grid, least) in [one, other].into_iter().zip(&mut least) {
            let mut grid = grid.clone();
            grid.set_tile_skipping(false);
            grid.tick();
            let start = Instant::now();
            for _ in 0..3 {
                grid.tick();
            }
            *least = least.min(start.elapsed().as_secs_f64());
        }
    }
    least[0] / least[1]
}

/// A [`Bed`] that damps everywhere, with posts that hold the level, which no border does.
const MUD: usize = 4;

/// Waving depths (1); scattered rocks (2); rocks, held water, mud and speeds that jump (3); [`MUD`].
struct Bed {
    kind: usize,
    seed: i64,
    cell: f64,
}

impl Medium for Bed {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let mut cell = MediumCell { speed: deep_speed, ..MediumCell::default() };
        if self.kind == MUD {
            let posts = [place.x, place.y].map(|p| (p / self.cell).floor() as i64 % 6 == 0);
            cell.damping = 4.0;
            cell.kind = if posts == [true; 2] { CellKind::Fixed } else { CellKind::Open };
            return cell;
        }
        if self.kind == 1 {
            cell.speed *= (0.65 + 0.35 * (1.7 * place.x).sin() * (1.1 * place.y).cos()) as f32;
            return cell;
        }
        let [x, z] = [place.x, place.y].map(|p| (p / (3.0 * self.cell)).floor() as i64);
        let mut random = Random::new((x.wrapping_mul(7919) ^ z.wrapping_mul(104_729) ^ self.seed) as u64);
        random.within(0.0, 1.0);
        let lot = random.within(0.0, 1.0);
        match (self.kind, lot) {
            (_, 0.0..0.12) => cell.kind = CellKind::Wall,
            (3, 0.12..0.18) => cell.kind = CellKind::Fixed,
            (3, 0.18..0.3) => cell.damping = 5.0,
            (3, _) => cell.speed *= random.within(0.2, 1.0) as f32,
            _ => {}
        }
        cell
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

//! Case `bound_energy`: nothing grows over ten minutes of ticks.

use floating_body::Radiation;
use glam::{DVec2, Vec2};
use open_water::{Preset, SeaState, WaterSample};
use wave_grid::{GridDesc, Source, WaveGrid};

use crate::{
    evidence::{Case, CaseError, Context, Row},
    fixtures::{self, Random, Scene, SceneDesc},
};

/// See the module.
pub(super) const ENERGY: Case = Case {
    name: "bound_energy",
    about: "energy of the waves on a grid late in a long run against early in it",
    plots: &[],
    run,
};

/// An instability grows by orders of magnitude; wave groups of a sea and a boat's turns make a factor of two or three.
const BOUND: f64 = 4.0;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(3_600, 36_000);
    let row = |variant: &str, peaks: &Peaks| {
        Row::new("bound_energy", variant)
            .param("ticks", peaks.ticks)
            .param("peak_m4_per_s2", (peaks.early * 1e3).round() / 1e3)
            .error(peaks.late / peaks.early, "ratio", "peak of the run's second half over that of its first")
            .bound(BOUND)
    };
    let mut rows = vec![row("window at random, up to 1.5 c", &wandering(ticks)?)];
    let calm = || SeaState { partitions: Vec::new(), depth: None };
    for (variant, sea, radiation, ticks) in [
        ("boat in circles, calm, coefficients", Some(calm()), Radiation::Coefficients, ticks),
        ("boat in circles, calm, grid felt", Some(calm()), Radiation::Grid, ticks),
        ("boat in circles, sea, coefficients", None, Radiation::Coefficients, context.pick(1_800, ticks)),
    ] {
        let (peaks, height) = circling(sea, radiation, ticks)?;
        rows.push(row(variant, &peaks).param("boat_off_water_m", (f64::from(height) * 1e2).round() / 1e2));
    }
    Ok(rows)
}

/// Peaks of a run's two halves. An energy that is not finite stays so.
struct Peaks {
    ticks: usize,
    early: f64,
    late: f64,
}

impl Peaks {
    fn of(ticks: usize) -> Self {
        Self { ticks, early: 0.0, late: 0.0 }
    }

    fn take(&mut self, tick: usize, energy: f64) {
        let peak = if tick < self.ticks / 2 { &mut self.early } else { &mut self.late };
        *peak = if energy.is_finite() { peak.max(energy) } else { f64::NAN };
    }
}

/// A window that runs to and fro under waves, at times faster than they are.
fn wandering(ticks: usize) -> Result<Peaks, CaseError> {
    let desc = GridDesc { cells: [256; 2], ..fixtures::grid() };
    let mut grid = WaveGrid::new(desc)?;
    let mut random = Random::new(8);
    let mut peaks = Peaks::of(ticks);
    let (mut place, mut velocity) = (DVec2::ZERO, DVec2::ZERO);
    for tick in 0..ticks {
        if tick % 60 == 0 {
            let speed = random.within(0.0, 1.5) * f64::from(desc.wave_speed);
            velocity = DVec2::from_angle(random.within(0.0, std::f64::consts::TAU)) * speed;
        }
        place += velocity * f64::from(desc.tick);
        grid.center_on(place);
        // Sources of both signs, so that no volume gathers.
        let volume = if tick % 2 == 0 { 0.01 } else { -0.01 };
        let center = (place + DVec2::new(random.within(-8.0, 8.0), random.within(-8.0, 8.0))).as_vec2();
        grid.add(Source::Displacement { center, radius: 0.4, volume });
        grid.tick();
        peaks.take(tick, grid.energy());
    }
    Ok(peaks)
}

/// A boat at full throttle that crosses its own wake again and again; also how far it got from the water under it.
fn circling(sea: Option<SeaState>, radiation: Radiation, ticks: usize) -> Result<(Peaks, f32), CaseError> {
    let desc = SceneDesc { preset: Preset::Low, sea, flotsam: 0, radiation, ..SceneDesc::default() };
    let mut scene = Scene::new(None, &desc)?;
    let mut peaks = Peaks::of(ticks);
    let mut height = 0.0f32;
    for tick in 0..ticks {
        scene.tick()?;
        let grid = scene.water.grid(scene.grid)?.ok_or("the grid is not on the CPU")?;
        peaks.take(tick, grid.energy());
        if let Some(state) = scene.bodies.get(scene.boat) {
            let mut under = [WaterSample::default()];
            scene.water.sample(&[Vec2::new(state.position.x, state.position.z)], &mut under);
            height = height.max((state.position.y - under[0].height).abs());
        }
    }
    Ok((peaks, height))
}

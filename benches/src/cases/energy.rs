//! Case `bound_energy`: nothing grows over ten minutes of ticks.

use floating_body::Radiation;
use glam::DVec2;
use open_water::Preset;
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

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(3_600, 36_000);
    let row = |variant: &str, (early, late): (f64, f64)| {
        Row::new("bound_energy", variant)
            .param("ticks", ticks)
            .param("peak_m4_per_s2", (early * 1e3).round() / 1e3)
            .error(late / early, "ratio", "peak energy of the first half, after a tenth to settle; peak of the second")
            .bound(2.0)
    };
    Ok(vec![
        row("window at random, up to 1.5 c", wandering(ticks)?),
        row("boat in circles, coefficients", circling(ticks, Radiation::Coefficients)?),
        row("boat in circles, grid felt", circling(ticks, Radiation::Grid)?),
    ])
}

/// Peaks of a run's two halves, the first tenth left out. An energy that is not finite stays so.
struct Peaks {
    ticks: usize,
    peaks: (f64, f64),
}

impl Peaks {
    fn take(&mut self, tick: usize, energy: f64) {
        let peak = if tick < self.ticks / 10 {
            return;
        } else if tick < self.ticks / 2 {
            &mut self.peaks.0
        } else {
            &mut self.peaks.1
        };
        *peak = if energy.is_finite() { peak.max(energy) } else { f64::NAN };
    }
}

/// A window that runs to and fro under waves, at times faster than they are.
fn wandering(ticks: usize) -> Result<(f64, f64), CaseError> {
    let desc = GridDesc { cells: [256; 2], ..fixtures::grid() };
    let mut grid = WaveGrid::new(desc)?;
    let mut random = Random::new(8);
    let mut peaks = Peaks { ticks, peaks: (0.0, 0.0) };
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
    Ok(peaks.peaks)
}

/// A boat at full throttle that crosses its own wake again and again.
fn circling(ticks: usize, radiation: Radiation) -> Result<(f64, f64), CaseError> {
    let mut scene = Scene::new(None, &SceneDesc { preset: Preset::Low, flotsam: 0, radiation, follow: true })?;
    let mut peaks = Peaks { ticks, peaks: (0.0, 0.0) };
    for tick in 0..ticks {
        scene.tick()?;
        let grid = scene.water.grid(scene.grid)?.ok_or("the grid is not on the CPU")?;
        peaks.take(tick, grid.energy());
    }
    Ok(peaks.peaks)
}

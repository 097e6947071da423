//! Cases of grids that come, go and follow one another: `handover`, `wakes`.

use floating_body::{BodyDesc, Controls, Hull, Radiation};
use glam::{DVec2, Vec2, Vec3};
use open_water::{
    BodyId, BodyState, BodyStates, Follow, GridDesc, Look, OpenWater, OpenWaterDesc, Preset, Scheme, Wake, WakesDesc,
    WaterSample, WaveGrid,
};
use wave_grid::{GridSample, Source};

use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure, measure_together},
    fixtures::FRAME,
};

/// See the module.
pub(super) const HANDOVER: Case = Case {
    name: "handover",
    about: "a boat that goes from one grid into another: waves and force against one large grid",
    plots: &[],
    run: handover,
};

/// See the module.
pub(super) const WAKES: Case = Case {
    name: "wakes",
    about: "boats with automatic grids: a tick against what the budget leaves out",
    plots: &[Plot {
        file: "wakes",
        title: "Automatic wakes: time of a tick against error (beside the points: near grids that the budget holds)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("budget_grids"),
    }],
    run: wakes,
};

const GRAVITY: f32 = 9.81;

fn calm() -> Result<OpenWater, CaseError> {
    let mut desc: OpenWaterDesc = Preset::Low.water();
    desc.sea.partitions.clear();
    Ok(OpenWater::headless(desc)?)
}

fn boat(radiation: Radiation) -> Result<BodyDesc, CaseError> {
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
    Ok(BodyDesc { radiation, ..BodyDesc::boat(&hull, 4_000.0, 10.0) })
}

fn tick(water: &mut OpenWater, store: &mut BodyStates) -> Result<(), CaseError> {
    for tick in water.advance(FRAME) {
        water.tick(tick, store)?;
    }
    Ok(())
}

fn heights(water: &OpenWater, points: &[Vec2]) -> Vec<f64> {
    let mut out = vec![WaterSample::default(); points.len()];
    water.sample(points, &mut out);
    out.iter().map(|sample| f64::from(sample.height)).collect()
}

fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|v| v * v).sum::<f64>() / count).sqrt()
}

/// A boat that runs along x from -25 m.
struct Crossing {
    water: OpenWater,
    store: BodyStates,
    boat: BodyId,
    rate: f32,
}

impl Crossing {
    fn new(grids: &[(f64, u32)]) -> Result<Self, CaseError> {
        let mut water = calm()?;
        for &(x, cells) in grids {
            let follow = Follow::Fixed(DVec2::new(x, 0.0));
            let (cells, scheme) = ([cells, 192], Scheme::NinePoint);
            water.add_grid(GridDesc { follow, cells, cell_size: [0.25; 2], scheme, ..GridDesc::default() })?;
        }
        let boat = water.add_body(boat(Radiation::Grid)?)?;
        water.set_controls(boat, Controls { throttle: 0.8, ..Controls::default() })?;
        let start = water.body(boat)?.state();
        let mut store = BodyStates::default();
        let position = start.position - Vec3::X * 25.0;
        store.insert(boat, BodyState { velocity: Vec3::X * 7.0, position, ..start });
        Ok(Self { water, store, boat, rate: 0.0 })
    }

    /// Vertical force over the weight in one tick, and where the boat is.
    fn tick(&mut self) -> Result<(f32, f32), CaseError> {
        tick(&mut self.water, &mut self.store)?;
        let state = self.store.get(self.boat).copied().ok_or("no boat")?;
        let force = (state.velocity.y - self.rate) / FRAME / GRAVITY;
        self.rate = state.velocity.y;
        Ok((force, state.position.x))
    }
}

fn handover(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut parts = Crossing::new(&[(-12.0, 256), (20.0, 256)])?;
    let mut whole = Crossing::new(&[(4.0, 512)])?;
    let first = loop {
        let _ = (parts.tick()?, whole.tick()?);
        if let Some(home) = parts.water.home(parts.boat)? {
            break home;
        }
    };
    let (mut worst, mut after) = (0.0f32, 0);
    while after < 75 {
        let ((found, x), (truth, _)) = (parts.tick()?, whole.tick()?);
        // Beyond, what is left in the first grid fades with its window.
        if x < 13.0 {
            worst = worst.max((found - truth).abs());
        }
        after += usize::from(parts.water.home(parts.boat)? != Some(first));
    }
    // Where neither grid fades or absorbs.
    let points: Vec<Vec2> =
        (0..4000u16).map(|i| Vec2::new(-6.0 + 0.05 * f32::from(i % 400), -18.0 + 3.7 * f32::from(i / 400))).collect();
    let (found, truth) = (heights(&parts.water, &points), heights(&whole.water, &points));
    let error = rms(found.iter().zip(&truth).map(|(a, b)| a - b).collect::<Vec<_>>().into_iter());
    let size = rms(truth.iter().copied());
    let row =
        |variant: &str| Row::new("handover", variant).param("ticks_after", after).param("rms_mm", (size * 1e3).round());
    Ok(vec![
        row("waves of both grids").error(100.0 * error / size, "%", "one large grid; rms over rms").bound(0.1),
        resampling(context)?,
        row("vertical force").error(f64::from(worst) * 100.0, "% of weight", "one large grid; worst tick").bound(0.01),
    ])
}

/// A ring that goes over to cells twice as large.
fn resampling(context: &Context) -> Result<Row, CaseError> {
    let fine = wave_grid::GridDesc { cells: [512; 2], cell_size: [0.125; 2], wave_speed: 6.2, ..Default::default() };
    let coarse = wave_grid::GridDesc { cells: [256; 2], cell_size: [0.25; 2], ..fine };
    let (mut from, mut to) = (WaveGrid::new(fine)?, WaveGrid::new(coarse)?);
    from.add(Source::Displacement { center: Vec2::new(1.3, -2.1), radius: 1.5, volume: 1.0 });
    for _ in 0..120 {
        from.tick();
    }
    to.resample(&from);
    let points: Vec<Vec2> =
        (0..4000u16).map(|i| Vec2::from_angle(f32::from(i) * 2.399_963) * 0.3 * f32::from(i).sqrt()).collect();
    let read = |grid: &WaveGrid| {
        let mut out = vec![GridSample::default(); points.len()];
        grid.sample(&points, &mut out);
        out
    };
    let (before, after) = (read(&from), read(&to));
    let most = |values: &mut dyn Iterator<Item = f32>| values.fold(0.0f32, |most, v| most.max(v.abs()));
    let highest = most(&mut before.iter().map(|sample| sample.height));
    let step = most(&mut before.iter().zip(&after).map(|(a, b)| a.height - b.height)) / highest;
    from.set_tile_skipping(false);
    let mut other = from.clone();
    let [taken, ticked] = measure_together(context.effort, [&mut || to.resample(&from), &mut || other.tick()]);
    Ok(Row::new("handover", "to cells twice as large")
        .param("cells", 512)
        .param("volume_kept_ppm", ((to.volume() / from.volume() - 1.0) * 1e8).round() / 100.0)
        .error(f64::from(step) * 100.0, "% of highest", "the heights before; worst point")
        .bound(1.0)
        .time("a 256^2 grid takes over a 512^2 one", &taken)
        .baseline("a tick of the whole 512^2 grid", &ticked))
}

/// Boats in a square of rows 30 m apart that all run along x, seen from beside the first.
struct Fleet {
    water: OpenWater,
    store: BodyStates,
    boats: Vec<BodyId>,
}

impl Fleet {
    fn new(count: u32, wakes: WakesDesc) -> Result<Self, CaseError> {
        let mut water = calm()?;
        water.set_wakes(Some(wakes))?;
        let mut store = BodyStates::default();
        let mut boats = Vec::new();
        for i in 0..count {
            let id = water.add_body(boat(Radiation::default())?)?;
            water.set_controls(id, Controls { throttle: 0.9, ..Controls::default() })?;
            let start = water.body(id)?.state();
            let place = 30.0 * Vec3::new((i % 4) as f32, 0.0, (i / 4) as f32);
            store.insert(id, BodyState { position: start.position + place, velocity: Vec3::X * 8.0, ..start });
            boats.push(id);
        }
        Ok(Self { water, store, boats })
    }

    fn tick(&mut self) -> Result<(), CaseError> {
        let at = self.store.get(self.boats[0]).ok_or("no boat")?.position;
        let eye = at + Vec3::new(0.0, 4.0, -14.0);
        self.water.look(Look { eye, direction: at - eye, fov_y: 0.9, aspect: 1.6 });
        tick(&mut self.water, &mut self.store)
    }

    /// Boats with a grid.
    fn with(&self) -> usize {
        let wake = |id: &&BodyId| matches!(self.water.wake(**id), Ok(Wake::Grid { .. }));
        self.boats.iter().filter(wake).count()
    }

    /// Heights around the boats, each over the boat's distance from the first: what an eye sees of them.
    fn seen(&self, points: &[(Vec2, f64)]) -> Vec<f64> {
        let places: Vec<Vec2> = points.iter().map(|(place, _)| *place).collect();
        heights(&self.water, &places).iter().zip(points).map(|(z, (_, away))| z / away).collect()
    }
}

fn wakes(context: &Context) -> Result<Vec<Row>, CaseError> {
    let wave = GridDesc { scheme: Scheme::NinePoint, wave_speed: 6.2, ..GridDesc::default() };
    let grid = GridDesc { cells: [256; 2], cell_size: [0.15; 2], ..wave };
    let near = 256 * 256;
    let mut rows = Vec::new();
    for count in [8u32, 32] {
        let desc =
            |grids: u64, fine: f32| WakesDesc { grid: grid.clone(), cells: grids * near, fine, ..WakesDesc::default() };
        let ticks = context.pick(150, 300);
        // All that a water may hold, none with larger cells.
        let mut full = Fleet::new(count, desc(32, 1e6))?;
        for _ in 0..ticks {
            full.tick()?;
        }
        let first = full.store.get(full.boats[0]).ok_or("no boat")?.position;
        let points: Vec<(Vec2, f64)> = full
            .boats
            .iter()
            .filter_map(|id| Some(full.store.get(*id)?.position))
            .flat_map(|at| {
                let away = f64::from(at.distance(first)).max(15.0);
                (0..400u16).map(move |i| {
                    let around = Vec2::from_angle(f32::from(i) * 2.399_963) * (0.5 * f32::from(i).sqrt());
                    (Vec2::new(at.x - 4.0, at.z) + around, away)
                })
            })
            .collect();
        let truth = full.seen(&points);
        let size = rms(truth.iter().copied());
        let timing = measure(context.effort, || {
            let _ = full.tick();
        });
        let row = |variant: String, boats: usize, budget: u64| {
            Row::new("wakes", variant)
                .param("boats", count)
                .param("boats_with_grid", boats)
                .param("budget_grids", budget)
        };
        for budget in [1, 2, 4, 8] {
            let mut fleet = Fleet::new(count, desc(budget, 50.0))?;
            for _ in 0..ticks {
                fleet.tick()?;
            }
            let with = fleet.with();
            let found = fleet.seen(&points);
            let error = rms(found.iter().zip(&truth).map(|(a, b)| a - b).collect::<Vec<_>>().into_iter()) / size;
            let timed = measure(context.effort, || {
                let _ = fleet.tick();
            });
            rows.push(
                row(format!("{count} boats"), with, budget)
                    .error(100.0 * error, "%", "a fine grid for each boat; heights over distance, rms over rms")
                    .time("a tick", &timed)
                    .baseline("a tick with a fine grid for each boat", &timing),
            );
        }
        rows.push(row(format!("{count} boats, a fine grid each"), full.with(), 32).time("a tick", &timing));
    }
    Ok(rows)
}

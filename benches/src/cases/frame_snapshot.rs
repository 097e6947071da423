//! Case `snapshot`: the whole water as a value, for rollback, late joiners and recordings: how large, how long, and whether
//! what comes of it is the same water.

use std::hint::black_box;

use glam::Vec3;
use open_water::{
    BodyDesc, BodyState, BodyStates, Controls, FleetDesc, Follow, GridDesc, Hull, OpenWater, Preset, Replay,
    WaterSnapshot,
};

use crate::evidence::{Case, CaseError, Context, Row, heap_bytes, measure, measure_together};

/// See the module.
pub(super) const SNAPSHOT: Case = Case {
    name: "snapshot",
    about: "snapshot, restore, hash and bytes of the whole water; rollback and replay of 8 ticks, a late joiner, a recording",
    plots: &[],
    run,
};

/// Ticks that are rolled back.
const BACK: u64 = 8;
/// For rollback and replay in a frame of 60 a second, ms.
const BUDGET_MS: f64 = 16.0;

struct Scene {
    water: OpenWater,
    bodies: BodyStates,
}

/// The scenes of the table, at the quality of a busy server.
const SCENES: [&str; 4] = ["empty sea", "a boat in its grid", "100 bodies", "10,000 pieces of flotsam"];

impl Scene {
    fn new(which: usize) -> Result<Self, CaseError> {
        let mut water = OpenWater::headless(Preset::Low.water())?;
        let mut bodies = BodyStates::default();
        let crate_hull = Hull::cuboid(Vec3::splat(0.8))?;
        match which {
            1 => {
                let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?;
                let boat = water.add_body(BodyDesc::boat(&hull, 4_000.0, 10.0))?;
                bodies.insert(boat, water.body(boat)?.state());
                water.set_controls(boat, Controls { throttle: 0.8, steering: 0.2, ..Controls::default() })?;
                water.add_grid(GridDesc { follow: Follow::Body(boat), ..Preset::Low.grid() })?;
            }
            2 => {
                for i in 0..100 {
                    let id = water.add_body(BodyDesc::from_hull(&crate_hull, 250.0))?;
                    let place = Vec3::new(3.0 * (i % 10) as f32, 0.2, 3.0 * (i / 10) as f32);
                    bodies.insert(id, BodyState::at_rest(place));
                }
            }
            3 => {
                let fleet = water.add_fleet(FleetDesc::new(BodyDesc::from_hull(&crate_hull, 250.0)))?;
                for i in 0..10_000 {
                    let place = Vec3::new(2.0 * (i % 100) as f32, 0.2, 2.0 * (i / 100) as f32);
                    water.fleet_mut(fleet)?.add(BodyState::at_rest(place))?;
                }
            }
            _ => {}
        }
        Ok(Self { water, bodies })
    }

    /// Runs on; the hash after each tick, if they are asked for.
    fn run(&mut self, ticks: u64, hashes: Option<&mut Vec<u64>>) -> Result<(), CaseError> {
        let mut all = Vec::new();
        let last = self.water.last_tick() + ticks;
        for tick in self.water.ticks_until(last) {
            self.water.tick(tick, &mut self.bodies)?;
            if hashes.is_some() {
                all.push(self.water.hash());
            }
        }
        if let Some(hashes) = hashes {
            *hashes = all;
        }
        Ok(())
    }

    fn hashes(&mut self, ticks: u64) -> Result<Vec<u64>, CaseError> {
        let mut hashes = Vec::new();
        self.run(ticks, Some(&mut hashes))?;
        Ok(hashes)
    }
}

fn differ(a: &[u64], b: &[u64]) -> f64 {
    a.iter().zip(b).filter(|(a, b)| a != b).count() as f64 + a.len().abs_diff(b.len()) as f64
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let mut rows = Vec::new();
    for (which, name) in SCENES.iter().enumerate() {
        let mut scene = Scene::new(which)?;
        scene.run(context.pick(60, 600), None)?;
        rows.extend(cost(context, &mut scene, name)?);
        rows.push(same(context, scene, name)?);
    }
    Ok(rows)
}

/// What each costs.
fn cost(context: &Context, scene: &mut Scene, name: &str) -> Result<[Row; 2], CaseError> {
    let held = heap_bytes();
    let snapshot = scene.water.snapshot();
    let memory = heap_bytes().saturating_sub(held);
    let bytes = snapshot.to_bytes();
    let us = |ns: f64| (ns / 10.0).round() / 100.0;
    let kib = |bytes: usize| (bytes as f64 / 102.4).round() / 10.0;
    let take = measure(context.effort, || drop(black_box(scene.water.snapshot())));
    let hash = measure(context.effort, || {
        black_box(scene.water.hash());
    });
    let write = measure(context.effort, || drop(black_box(snapshot.to_bytes())));
    let read = measure(context.effort, || drop(black_box(WaterSnapshot::from_bytes(&bytes))));
    let mut other = OpenWater::headless(Preset::Low.water())?;
    let told = WaterSnapshot::from_bytes(&bytes)?;
    let mut trouble = Ok(());
    let join = measure(context.effort, || trouble = other.restore(&told));
    trouble?;
    let saved = scene.bodies.clone();
    let mut plain = Scene { water: OpenWater::headless(Preset::Low.water())?, bodies: saved.clone() };
    plain.water.restore(&told)?;
    let (mut trouble, mut more) = (Ok(()), Ok(()));
    let restore = measure(context.effort, || trouble = scene.water.restore(&snapshot));
    trouble?;
    let mut trouble = Ok(());
    let mut back = || {
        let restored = scene.water.restore(&snapshot).map_err(CaseError::from);
        scene.bodies.clone_from(&saved);
        trouble = restored.and_then(|()| scene.run(BACK, None));
    };
    let mut on = || more = plain.run(BACK, None);
    let [back, on] = measure_together(context.effort, [&mut back, &mut on]);
    trouble?;
    more?;
    scene.water.restore(&snapshot)?;
    scene.bodies = saved;
    let sizes = Row::new("snapshot", format!("{name}: one moment"))
        .param("in_memory_KiB", kib(memory))
        .param("as_bytes_KiB", kib(bytes.len()))
        .param("restore_us", us(restore.median_ns))
        .param("hash_us", us(hash.median_ns))
        .param("to_bytes_us", us(write.median_ns))
        .param("from_bytes_us", us(read.median_ns))
        .param("joiner_restores_ms", us(join.median_ns / 1e3))
        .time("a snapshot", &take);
    let rollback = Row::new("snapshot", format!("{name}: back and on"))
        .param("ticks", BACK)
        .param("target_ms", BUDGET_MS)
        .time("restore and 8 ticks", &back)
        .baseline("8 ticks alone", &on);
    Ok([sizes, rollback])
}

/// Whether they are the same water.
fn same(context: &Context, mut scene: Scene, name: &str) -> Result<Row, CaseError> {
    let ticks = context.pick(12, 240);
    let (mut wrong, bytes, saved) = (0.0, scene.water.snapshot().to_bytes(), scene.bodies.clone());
    scene.water.start_recording();
    let first = scene.hashes(ticks)?;
    let mut file = Vec::new();
    scene.water.stop_recording(&mut file)?;
    // Rolled back again and again, to eight ticks before.
    let mut water = OpenWater::headless(Preset::Low.water())?;
    water.restore(&WaterSnapshot::from_bytes(&bytes)?)?;
    let mut joined = Scene { water, bodies: saved };
    let mut hashes = Vec::new();
    while (hashes.len() as u64) < ticks {
        let before = (joined.water.snapshot(), joined.bodies.clone());
        joined.run(BACK, None)?;
        joined.water.restore(&before.0)?;
        joined.bodies = before.1;
        hashes.extend(joined.hashes(BACK.min(ticks - hashes.len() as u64))?);
    }
    wrong += differ(&first, &hashes);
    let mut replay = Replay::new(&file[..])?;
    let mut replayed = Vec::new();
    while replay.tick()? {
        replayed.push(replay.water().hash());
    }
    wrong += differ(&first, &replayed);
    Ok(Row::new("snapshot", format!("{name}: the same water"))
        .param("ticks", ticks)
        .param("recording_KiB", (file.len() as f64 / 102.4).round() / 10.0)
        .note("a late joiner from bytes, which rolls back every 8 ticks, and a recording, against the straight run")
        .error(wrong, "hashes that differ", "the straight run")
        .bound(0.0))
}

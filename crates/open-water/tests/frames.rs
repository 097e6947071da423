//! The frame rate decides what is drawn when, and nothing of what happens.

use glam::{Quat, Vec2, Vec3};
use ocean_spectrum::{Ocean, OceanSample};
use open_water::{
    BodyDesc, BodyId, BodyStates, Border, CascadeDesc, Controls, Follow, GridDesc, GridId, Hull, OpenWater,
    OpenWaterDesc, Pose, Preset, SeaState,
};

const DT: f32 = 1.0 / 60.0;
const SECS: f32 = 8.0;

/// A boat under way in its grid, and crates on the open sea.
struct Scene {
    water: OpenWater,
    store: BodyStates,
    bodies: Vec<BodyId>,
    grid: GridId,
}

/// What one frame shows.
struct Frame {
    /// Seconds since the start of the moment that is drawn.
    time: f64,
    poses: Vec<Pose>,
    /// How far the crates stand above the drawn sea, metres.
    above: Vec<f32>,
    /// Drawn heights of the grid's cells, and where its window stands.
    cells: Vec<[f32; 2]>,
    corner: [i64; 2],
}

impl Scene {
    fn new() -> Self {
        let sea = SeaState::height_period(1.0, 4.0, 0.0);
        let cascades = vec![CascadeDesc::new(128, 120.0)];
        let mut water = OpenWater::headless(OpenWaterDesc { sea, cascades, ..Preset::Low.water() }).unwrap();
        let boat = BodyDesc::boat(&Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap(), 4_000.0, 10.0);
        let crate_desc = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(1.2, 0.6, 1.0)).unwrap(), 370.0);
        let mut store = BodyStates::default();
        let bodies: Vec<_> = [boat, crate_desc.clone(), crate_desc]
            .into_iter()
            .enumerate()
            .map(|(i, desc)| {
                let id = water.add_body(desc).unwrap();
                let state = water.body(id).unwrap().state();
                let position = state.position + Vec3::new(70.0 * i as f32, 0.0, 3.0);
                store.insert(id, open_water::BodyState { position, ..state });
                id
            })
            .collect();
        water.set_controls(bodies[0], Controls { throttle: 0.8, steering: 0.2, ..Controls::default() }).unwrap();
        let grid = GridDesc { cells: [96; 2], border: Border::Absorbing { width: 8 }, ..Preset::Low.grid() };
        let grid = water.add_grid(GridDesc { follow: Follow::Body(bodies[0]), ..grid }).unwrap();
        Self { water, store, bodies, grid }
    }

    /// Runs a frame and looks at what it draws.
    fn frame(&mut self, dt: f32, sea: &mut Ocean) -> Frame {
        let ticks = self.water.advance(dt);
        let alpha = ticks.alpha;
        for tick in ticks {
            self.water.tick(tick, &mut self.store).unwrap();
        }
        let time = self.water.drawn_time();
        let poses: Vec<_> = self.bodies.iter().filter_map(|id| self.water.drawn_pose(*id)).collect();
        sea.set_time(time);
        let above = |pose: &Pose| {
            let mut sample = [OceanSample::default()];
            sea.sample(&[Vec2::new(pose.position.x, pose.position.z)], &mut sample);
            pose.position.y - sample[0].height
        };
        let above = poses.iter().skip(1).map(above).collect();
        let grid = self.water.grid(self.grid).unwrap().unwrap();
        let mut cells = vec![[0.0; 2]; 96 * 96];
        grid.draw(alpha, &mut cells);
        Frame { time, poses, above, cells, corner: grid.window().corner }
    }

    fn run(frame_dts: impl Iterator<Item = f32>) -> Vec<Frame> {
        let mut scene = Self::new();
        let mut sea = scene.water.ocean().unwrap().clone();
        frame_dts.map(|dt| scene.frame(dt, &mut sea)).filter(|frame| frame.poses.len() == 3).collect()
    }
}

fn steady(fps: f32) -> impl Iterator<Item = f32> {
    (0..(SECS * fps) as usize).map(move |_| 1.0 / fps)
}

/// Frames of 2 to 60 ms, as they come.
fn jitter() -> impl Iterator<Item = f32> {
    let mut state = 9u32;
    let mut left = SECS;
    std::iter::from_fn(move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let dt = 0.002 + 0.058 * (state >> 8) as f32 / 16_777_216.0;
        left -= dt;
        (left > 0.0).then_some(dt)
    })
}

/// A smooth curve through the positions of a run of one tick a frame, at `time`: Catmull and Rom's, which shares nothing
/// with how poses are mixed.
fn curve(of: &[Frame], body: usize, time: f64) -> Option<Vec3> {
    let at = (time - of[0].time) / f64::from(DT);
    let (i, t) = (at.floor() as usize, at.fract() as f32);
    let p = |k: usize| of.get(k).map(|frame| frame.poses[body].position);
    let [a, b, c, d] = [p(i.checked_sub(1)?)?, p(i)?, p(i + 1)?, p(i + 2)?];
    let (m, n) = ((c - a) * 0.5, (d - b) * 0.5);
    let (t2, t3) = (t * t, t * t * t);
    Some(b * (2.0 * t3 - 3.0 * t2 + 1.0) + m * (t3 - 2.0 * t2 + t) + c * (3.0 * t2 - 2.0 * t3) + n * (t3 - t2))
}

/// Attitude between those of two ticks: the sum of both, weighed.
fn attitude(of: &[Frame], body: usize, time: f64) -> Quat {
    let at = (time - of[0].time) / f64::from(DT);
    let (i, t) = (at.floor() as usize, at.fract() as f32);
    let [a, b] = [i, i + 1].map(|k| of[k].poses[body].orientation);
    (a * (1.0 - t) + b * t).normalize()
}

/// What other frame rates show.
fn rates() -> Vec<(String, Vec<Frame>)> {
    let steady = [15.0, 30.0, 144.0, 240.0].map(|fps| (format!("{fps} fps"), Scene::run(steady(fps))));
    steady.into_iter().chain([("jitter".to_owned(), Scene::run(jitter()))]).collect()
}

#[test]
fn all_frame_rates_draw_the_same_way_and_the_same_sea() {
    let sixty = Scene::run(steady(60.0));
    let depth = |frames: &[Frame], at: usize| {
        frames.iter().map(|frame| frame.above[at]).fold((f32::MAX, f32::MIN), |(a, b), d| (a.min(d), b.max(d)))
    };
    for (name, frames) in rates() {
        for body in 0..3 {
            let mean = sixty.iter().map(|f| f.poses[body].position).sum::<Vec3>() / sixty.len() as f32;
            let (mut off, mut way, mut turned, mut count) = (0.0, 0.0, 0.0f32, 0);
            for frame in &frames {
                let Some(truth) = curve(&sixty, body, frame.time) else { continue };
                off += frame.poses[body].position.distance_squared(truth);
                way += truth.distance_squared(mean);
                turned = turned.max((attitude(&sixty, body, frame.time) - frame.poses[body].orientation).length());
                count += 1;
            }
            let share = (off / way).sqrt();
            assert!(turned < 1e-4, "{name}, body {body}: {turned} half radians off");
            assert!(count > 100 && share < 1e-3, "{name}, body {body}: {share} of the way in {count} frames");
        }
        for at in 0..2 {
            let (usual, found) = (depth(&sixty, at), depth(&frames, at));
            assert!(found.0 > usual.0 - 2e-3 && found.1 < usual.1 + 2e-3, "{name}: {found:?} m, {usual:?} at 60 fps");
        }
        // Cells are drawn between those of two ticks, where the window stands still.
        let mut seen = 0;
        for frame in &frames {
            let at = (frame.time - sixty[0].time) / f64::from(DT);
            let (i, t) = ((at + 1e-4).floor() as usize, (at - (at + 1e-4).floor()) as f32);
            let (Some(from), Some(to)) = (sixty.get(i), sixty.get(i + 1)) else { continue };
            if from.corner != frame.corner || to.corner != frame.corner {
                continue;
            }
            seen += 1;
            // The border fades with the window's place between cells; the middle is whole.
            let middle = (32 * 96..64 * 96).filter(|cell| (32..64).contains(&(cell % 96)));
            let off = |cell: usize| {
                let mixed = from.cells[cell][0] + (to.cells[cell][0] - from.cells[cell][0]) * t;
                (frame.cells[cell][0] - mixed).abs()
            };
            let off = middle.map(off).fold(0.0, f32::max);
            assert!(off < 1e-4, "{name}: {off} m at {} s", frame.time);
        }
        assert!(seen > 30, "{name}: {seen} frames");
    }
}

#[test]
fn a_hitch_drops_time_says_so_and_leaves_no_mark() {
    let (mut hitched, mut steady) = (Scene::new(), Scene::new());
    let mut sea = hitched.water.ocean().unwrap().clone();
    let (mut ticks, mut last, mut worst) = (0, None::<Frame>, 0.0_f32);
    for k in 0..300 {
        let before = hitched.water.reports();
        let frame = hitched.frame(if k == 150 { 5.0 } else { DT }, &mut sea);
        let after = hitched.water.reports();
        let ran = after.ticks - before.ticks;
        if k == 150 {
            // 5 s are 300 ticks, of which a frame may run 8.
            assert_eq!(ran, 8);
            assert!((after.dropped_secs - 292.0 / 60.0).abs() < 0.02, "{}", after.dropped_secs);
        } else {
            assert!(ran <= 2 && after.dropped_secs == before.dropped_secs);
        }
        ticks += ran;
        if let Some(last) = last.filter(|last| last.poses.len() == 3 && frame.poses.len() == 3) {
            let step = |i: usize| frame.poses[i].position.distance(last.poses[i].position) / ran.max(1) as f32;
            worst = (0..3).map(step).fold(worst, f32::max);
        }
        assert!(frame.poses.iter().all(|pose| pose.position.is_finite()));
        last = Some(frame);
    }
    // No tick carries a body farther than its speed does: 6 m/s.
    assert!(worst < 0.1, "{worst} m in a tick");
    let mut sea = steady.water.ocean().unwrap().clone();
    (0..ticks).for_each(|_| drop(steady.frame(DT, &mut sea)));
    assert_eq!(steady.water.reports().dropped_secs, 0.0);
    for id in &hitched.bodies {
        assert_eq!(hitched.store.get(*id), steady.store.get(*id));
    }
}

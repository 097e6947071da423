//! Case `frame_rates`: what other frame rates draw, against 60 fps; and a hitch.

use floating_body::{BodyDesc, BodyState, Controls, Hull};
use glam::{Vec2, Vec3};
use ocean_spectrum::{Ocean, OceanSample};
use open_water::{BodyId, BodyStates, CascadeDesc, Follow, GridDesc, OpenWater, OpenWaterDesc, Preset, SeaState};

use crate::evidence::{Case, CaseError, Context, Row};
use crate::fixtures::{FRAME, Random};

/// See the module.
pub(super) const RATES: Case = Case {
    name: "frame_rates",
    about: "drawn poses of a boat and crates in a sea, and how deep the crates stand in the drawn sea, by frame rate; a hitch",
    plots: &[],
    run,
};

const CRATES: usize = 6;

struct Scene {
    water: OpenWater,
    store: BodyStates,
    bodies: Vec<BodyId>,
    /// The sea, at the drawn time.
    sea: Ocean,
}

/// What a frame draws.
struct Frame {
    time: f64,
    places: Vec<Vec3>,
    /// Of the crates over the drawn sea, metres.
    above: Vec<f32>,
}

impl Scene {
    fn new() -> Result<Self, CaseError> {
        let (sea, cascades) = (SeaState::height_period(1.0, 4.0, 0.0), vec![CascadeDesc::new(128, 120.0)]);
        let mut water = OpenWater::headless(OpenWaterDesc { sea, cascades, ..Preset::Low.water() })?;
        let mut store = BodyStates::default();
        let boat = BodyDesc::boat(&Hull::cuboid(Vec3::new(6.0, 1.2, 2.2))?, 4_000.0, 10.0);
        let crates = BodyDesc::from_hull(&Hull::cuboid(Vec3::new(1.2, 0.6, 1.0))?, 370.0);
        let mut bodies = Vec::new();
        for i in 0..=CRATES {
            let id = water.add_body(if i == 0 { boat.clone() } else { crates.clone() })?;
            let state = water.body(id)?.state();
            let place = Vec3::new(if i == 0 { 0.0 } else { 60.0 + 9.0 * i as f32 }, 0.0, 3.0);
            store.insert(id, BodyState { position: state.position + place, ..state });
            bodies.push(id);
        }
        water.set_controls(bodies[0], Controls { throttle: 0.8, steering: 0.3, ..Controls::default() })?;
        water.add_grid(GridDesc { follow: Follow::Body(bodies[0]), cells: [128; 2], ..Preset::Low.grid() })?;
        let sea = water.ocean().ok_or("a calm sea")?.clone();
        Ok(Self { water, store, bodies, sea })
    }

    fn frame(&mut self, dt: f32) -> Result<Frame, CaseError> {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.store)?;
        }
        let time = self.water.drawn_time();
        let places: Vec<Vec3> =
            self.bodies.iter().filter_map(|id| self.water.drawn_pose(*id)).map(|pose| pose.position).collect();
        self.sea.set_time(time);
        let above = |place: &Vec3| {
            let mut sample = [OceanSample::default()];
            self.sea.sample(&[Vec2::new(place.x, place.z)], &mut sample);
            place.y - sample[0].height
        };
        let above = places.iter().skip(1).map(above).collect();
        Ok(Frame { time, places, above })
    }

    fn run(dts: &[f32]) -> Result<Vec<Frame>, CaseError> {
        let mut scene = Self::new()?;
        let frames: Vec<Frame> = dts.iter().map(|dt| scene.frame(*dt)).collect::<Result<_, _>>()?;
        Ok(frames.into_iter().filter(|frame| frame.places.len() == CRATES + 1).collect())
    }
}

/// The smooth curve of Catmull and Rom through a body's places at 60 fps; nothing of how poses are mixed is in it.
fn curve(of: &[Frame], body: usize, time: f64) -> Option<Vec3> {
    let at = (time - of.first()?.time) / f64::from(FRAME);
    let (i, t) = (at.floor() as usize, at.fract() as f32);
    let place = |k: usize| of.get(k).map(|frame| frame.places[body]);
    let [a, b, c, d] = [place(i.checked_sub(1)?)?, place(i)?, place(i + 1)?, place(i + 2)?];
    let (from, to, t2, t3) = ((c - a) * 0.5, (d - b) * 0.5, t * t, t * t * t);
    Some(b * (2.0 * t3 - 3.0 * t2 + 1.0) + from * (t3 - 2.0 * t2 + t) + c * (3.0 * t2 - 2.0 * t3) + to * (t3 - t2))
}

/// Rms distance over the rms way, of the body where that is most, percent.
fn share(frames: &[Frame], sixty: &[Frame]) -> f64 {
    let of = |body: usize| {
        let mean = sixty.iter().map(|frame| frame.places[body]).sum::<Vec3>() / sixty.len() as f32;
        let truths = frames.iter().filter_map(|f| Some((f.places[body], curve(sixty, body, f.time)?)));
        let (off, way) = truths.fold((0.0, 0.0), |(off, way), (found, truth)| {
            (off + found.distance_squared(truth), way + truth.distance_squared(mean))
        });
        f64::from(100.0 * (off / way).sqrt())
    };
    (0..=CRATES).map(of).fold(0.0, f64::max)
}

/// Lowest and highest that a crate stands over the drawn sea, metres.
fn stands(frames: &[Frame]) -> [f64; 2] {
    let all = frames.iter().flat_map(|frame| &frame.above).map(|a| f64::from(*a));
    all.fold([f64::MAX, f64::MIN], |[low, high], a| [low.min(a), high.max(a)])
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let secs = context.pick(10.0, 60.0);
    let steady = |fps: f32| vec![1.0 / fps; (secs * fps) as usize];
    let sixty = Scene::run(&steady(60.0))?;
    let [lowest, highest] = stands(&sixty);
    let mut random = Random::new(8);
    let jitter: Vec<f32> = (0..(secs * 32.0) as usize).map(|_| random.within(0.002, 0.06) as f32).collect();
    let mut rows = Vec::new();
    for (name, dts) in [15.0, 30.0, 144.0, 240.0]
        .map(|fps: f32| (format!("{fps} fps"), steady(fps)))
        .into_iter()
        .chain([("2 to 60 ms, at random".to_owned(), jitter)])
    {
        let frames = Scene::run(&dts)?;
        let [low, high] = stands(&frames);
        rows.push(
            Row::new("frame_rates", name.clone())
                .param("frames", frames.len())
                .error(share(&frames, &sixty), "% of the rms way", "a smooth curve through what 60 fps draw")
                .bound(1.0),
        );
        rows.push(
            Row::new("frame_rates", format!("{name}: crates in the drawn sea"))
                .param("deepest_m", low)
                .param("highest_m", high)
                .param("deepest_at_60_fps_m", lowest)
                .param("highest_at_60_fps_m", highest)
                .error((lowest - low).max(high - highest).max(0.0), "m deeper or higher", "60 fps")
                .bound(2e-3),
        );
    }
    rows.push(hitch()?);
    Ok(rows)
}

/// A frame of 5 s among frames of one tick: the same ticks follow, fewer of them.
fn hitch() -> Result<Row, CaseError> {
    let [mut hitched, mut steady] = [Scene::new()?, Scene::new()?];
    for frame in 0..240 {
        hitched.frame(if frame == 120 { 5.0 } else { FRAME })?;
    }
    let reports = hitched.water.reports();
    for _ in 0..reports.ticks {
        steady.frame(FRAME)?;
    }
    let places = |scene: &Scene| {
        let of = scene.bodies.iter().filter_map(|id| scene.store.get(*id));
        of.map(|state| state.position).collect::<Vec<_>>()
    };
    let off = places(&hitched).iter().zip(places(&steady)).fold(0.0_f32, |most, (a, b)| most.max(a.distance(b)));
    Ok(Row::new("frame_rates", "a hitch of 5 s")
        .param("ticks_in_it", hitched.water.desc().max_ticks_per_frame)
        .param("dropped_secs", reports.dropped_secs)
        .error(off.into(), "m after as many ticks", "no hitch")
        .bound(0.0))
}

//! Case `fleet_kernel`: 10,000 crates of eight force points on a bare height field in memory, forces and integration,
//! against the plain loop of `plain.rs`.

pub(super) mod plain;

use std::f32::consts::TAU;
use std::hint::black_box;

use floating_body::{
    Body, BodyDesc, BodyState, Fleet, FleetDesc, ForcePoints, SurfacePatch, SurfaceSample, WaterSurface,
};
use glam::{Quat, Vec2, Vec3};

use self::plain::{Plain, Reads, Way};
use crate::evidence::{Case, CaseError, Context, Row, Timing, fastest, limits::triad_ns_per_byte};
use crate::fixtures::{CRATE_MASS, Random, crate_hull};

/// See the module.
pub(super) const KERNEL: Case = Case {
    name: "fleet_kernel",
    about: "10,000 crates x 8 force points on a bare height field: a fleet against a plain loop, one thread and two",
    plots: &[],
    run,
};

pub(super) const DT: f32 = 1.0 / 60.0;
const BODIES: usize = 10_000;
/// Numbers of a piece that a tick reads and writes.
const NUMBERS: usize = 36 + 24;

/// Heights on a periodic grid, read bilinearly.
pub(super) struct Field {
    heights: Vec<f32>,
}

impl Field {
    const SIZE: usize = 1024;
    /// m.
    const CELL: f32 = 0.25;

    pub(super) fn new() -> Self {
        let waves = [(3.0, 1.0, 0.3), (11.0, -7.0, 0.1), (2.0, 23.0, 0.04)];
        let height = |i: usize| {
            let (x, z) = ((i % Self::SIZE) as f32, (i / Self::SIZE) as f32);
            let wave = |(kx, kz, a): &(f32, f32, f32)| a * (TAU / Self::SIZE as f32 * (kx * x + kz * z)).sin();
            waves.iter().map(wave).sum()
        };
        Self { heights: (0..Self::SIZE * Self::SIZE).map(height).collect() }
    }
}

impl WaterSurface for Field {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (point, out) in points.iter().zip(out) {
            let p = self.patch(*point, 0.0);
            let normal = Vec3::new(-p.gradient.x, 1.0, -p.gradient.y).normalize();
            *out = SurfaceSample { height: p.height, normal, ..SurfaceSample::CALM };
        }
    }

    fn patch(&self, center: Vec2, _radius: f32) -> SurfacePatch {
        const MASK: i32 = Field::SIZE as i32 - 1;
        let at = center / Self::CELL;
        let whole = at.floor();
        let (u, v) = (at.x - whole.x, at.y - whole.y);
        let (x, z) = (whole.x as i32, whole.y as i32);
        let texel = |x: i32, z: i32| self.heights[((z & MASK) as usize) * Self::SIZE + (x & MASK) as usize];
        let [a, b, c, d] = [texel(x, z), texel(x + 1, z), texel(x, z + 1), texel(x + 1, z + 1)];
        let (low, high) = (a + (b - a) * u, c + (d - c) * u);
        let gradient = Vec2::new((b - a) + ((d - c) - (b - a)) * v, high - low) / Self::CELL;
        SurfacePatch { height: low + (high - low) * v, gradient, ..SurfacePatch::default() }
    }
}

/// A crate on eight points.
pub(super) fn crate_desc() -> Result<BodyDesc, CaseError> {
    let mut desc = BodyDesc::from_hull(&crate_hull()?, CRATE_MASS);
    desc.points = ForcePoints::Count(8);
    Ok(desc)
}

/// Crates all over the field, some turned, in no order.
pub(super) fn states(count: usize) -> Vec<BodyState> {
    let mut random = Random::new(5);
    let mut number = |low: f64, high: f64| random.within(low, high) as f32;
    let one = |_| BodyState {
        position: Vec3::new(number(0.0, 256.0), number(-0.1, 0.3), number(0.0, 256.0)),
        orientation: Quat::from_rotation_y(number(0.0, 6.0)) * Quat::from_rotation_x(number(-0.3, 0.3)),
        velocity: Vec3::new(number(-0.5, 0.5), 0.0, number(-0.5, 0.5)),
        angular_velocity: Vec3::new(number(-0.5, 0.5), number(-0.5, 0.5), number(-0.5, 0.5)),
    };
    (0..count).map(one).collect()
}

pub(super) fn fleet(desc: &BodyDesc, refresh: u32, states: &[BodyState]) -> Result<Fleet, CaseError> {
    let mut fleet = Fleet::new(FleetDesc { refresh, sleeps: false, ..FleetDesc::new(desc.clone()) })?;
    states.iter().try_for_each(|state| fleet.add(*state).map(drop))?;
    Ok(fleet)
}

pub(super) fn pool(threads: usize) -> Result<rayon::ThreadPool, CaseError> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?)
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let (desc, field, start) = (crate_desc()?, Field::new(), states(BODIES));
    let template = Body::new(desc.clone())?;
    let (one, two) = (pool(1)?, pool(2)?);
    let mut fleets = [fleet(&desc, 1, &start)?, fleet(&desc, 1, &start)?, fleet(&desc, 4, &start)?];
    let mut plain = Plain::new(&template, start.clone(), Way::Full, Reads::Plane);
    let mut each = Plain::new(&template, start.clone(), Way::Full, Reads::Points);
    for _ in 0..64 {
        fleets.iter_mut().for_each(|fleet| fleet.step(DT, &field));
        plain.tick(DT, &field);
        each.tick(DT, &field);
    }
    let square: f32 =
        fleets[0].iter().zip(&plain.pieces).map(|((_, a), b)| a.position.distance_squared(b.position)).sum();
    let error = f64::from(square / BODIES as f32).sqrt();

    let [every, both, fourth] = &mut fleets;
    let bytes = triad_ns_per_byte(context.effort, 12 << 20, false) * (4 * NUMBERS * BODIES) as f64;
    let effort = context.effort;
    let [single, double, seldom, plain, each] = fastest(
        effort,
        [
            &mut || one.install(|| every.step(DT, black_box(&field))),
            &mut || two.install(|| both.step(DT, black_box(&field))),
            &mut || one.install(|| fourth.step(DT, black_box(&field))),
            &mut || plain.tick(DT, black_box(&field)),
            &mut || each.tick(DT, black_box(&field)),
        ],
    );
    let row = |variant: &str, threads: usize, refresh: usize| {
        Row::new("fleet_kernel", variant)
            .param("bodies", BODIES)
            .param("force_points", 8)
            .param("threads", threads)
            .param("ticks_between_readings", refresh)
    };
    let timed = "a tick of all bodies";
    let loop_name = "a plain loop with the same operations, one thread";
    let moving = "moving a piece's numbers once in and out of memory, one thread";
    let ratio = |a: &Timing, b: &Timing| a.median_ns / b.median_ns;
    Ok(vec![
        row("against the plain loop", 1, 1)
            .error(ratio(&single, &plain), "of its time", "a plain loop with the same operations")
            .param("target", 0.4)
            .time(timed, &single)
            .baseline(loop_name, &plain)
            .limit(moving, bytes),
        row("on two threads", 2, 1)
            .error(ratio(&double, &single), "of the time of one", "itself on one thread")
            .param("target", 0.588)
            .time(timed, &double)
            .baseline(loop_name, &plain)
            .note("needs two cores of its own"),
        row("planes read by turns", 1, 4).time(timed, &seldom).baseline(loop_name, &plain).limit(moving, bytes),
        row("against a plain loop that reads each point", 1, 1)
            .time(timed, &single)
            .baseline("a plain loop that reads the height under each point, one thread", &each),
        row("agreement", 1, 1).error(error, "m", "the plain loop after 64 ticks, RMS of the places").bound(1.0e-3),
    ])
}

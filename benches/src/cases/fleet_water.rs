//! Cases `fleet_against_body` (pieces of a fleet against bodies of their own) and `refresh` (what reading the water by turns
//! costs in exactness and saves in time).

use std::hint::black_box;

use floating_body::{
    AiryWave, Body, BodyDesc, BodyState, Controls, Hull, Sampling, SurfacePatch, SurfaceSample, WATER_DENSITY,
    WaterSurface,
};
use glam::{Quat, Vec2, Vec3};

use super::fleet_kernel::{DT, crate_desc, fleet, pool, states};
use crate::evidence::{Axis, Case, CaseError, Context, Plot, Row, fastest};

/// See the module.
pub(super) const AGAINST_BODY: Case = Case {
    name: "fleet_against_body",
    about: "pieces of a fleet against bodies of their own: on a regular wave and dropped, by shape",
    plots: &[],
    run: against_body,
};

/// See the module.
pub(super) const REFRESH: Case = Case {
    name: "refresh",
    about: "ticks between two readings of the water under a piece: error on a sea of twelve waves, and time",
    plots: &[Plot {
        file: "refresh",
        title: "Reading the water by turns (beside the points: ticks between readings)",
        x: Axis::Time,
        y: Axis::Error,
        label: Some("ticks_between_readings"),
    }],
    run: refresh,
};

/// Regular waves on each other.
#[derive(Clone)]
pub(super) struct Sea(pub(super) Vec<AiryWave>);

impl Sea {
    /// Twelve waves of 6 to 60 m about one direction, each as steep as the others; significant height about 1.2 m.
    pub(super) fn new() -> Self {
        let one = |i: i32| {
            let length = 6.0 * 10.0f32.powf(i as f32 / 11.0);
            let mut wave = AiryWave::new(0.0065 * length, length, 0.4 + 0.5 * (i as f32 * 2.4).sin());
            wave.phase = 1.7 * (i * i) as f32;
            wave
        };
        Self((0..12).map(one).collect())
    }

    pub(super) fn at(mut self, time: f64) -> Self {
        self.0.iter_mut().for_each(|wave| wave.time = time);
        self
    }
}

impl WaterSurface for Sea {
    fn sample(&self, points: &[Vec2], out: &mut [SurfaceSample]) {
        for (point, out) in points.iter().zip(out) {
            let p = self.patch(*point, 0.0);
            *out = SurfaceSample {
                height: p.height,
                normal: Vec3::new(-p.gradient.x, 1.0, -p.gradient.y).normalize(),
                velocity: p.velocity,
                acceleration: p.acceleration,
                decay_wavenumber: p.decay_wavenumber,
                ..SurfaceSample::CALM
            };
        }
    }

    fn patch(&self, center: Vec2, radius: f32) -> SurfacePatch {
        let mut sum = SurfacePatch::default();
        let mut weight = 0.0;
        for wave in &self.0 {
            let p = wave.patch(center, radius);
            sum.height += p.height;
            sum.gradient += p.gradient;
            sum.velocity += p.velocity;
            sum.acceleration += p.acceleration;
            sum.decay_wavenumber += p.decay_wavenumber * wave.amplitude;
            weight += wave.amplitude;
        }
        sum.decay_wavenumber /= weight;
        sum
    }
}

fn shapes() -> Result<Vec<(&'static str, BodyDesc)>, CaseError> {
    let (ball, barrel) = (Hull::sphere(0.4)?, Hull::cylinder(0.3, 0.9)?);
    let floating = |hull: &Hull, density: f32| BodyDesc::from_hull(hull, density * WATER_DENSITY * hull.volume());
    Ok(vec![("crate", crate_desc()?), ("ball", floating(&ball, 0.3)), ("barrel", floating(&barrel, 0.6))])
}

/// Largest distance of a piece, or of a place a metre from its middle, from its twin's, m.
fn apart(a: &BodyState, b: &BodyState) -> f32 {
    let turned = [Vec3::X, Vec3::Y, Vec3::Z].map(|v| (a.orientation * v).distance(b.orientation * v));
    turned.into_iter().fold(a.position.distance(b.position), f32::max)
}

fn start(i: usize, height: f32) -> BodyState {
    BodyState {
        orientation: Quat::from_rotation_y(i as f32 * 0.7) * Quat::from_rotation_x(0.2) * Quat::from_rotation_z(-0.15),
        angular_velocity: Vec3::new(0.2, 0.4, -0.2),
        ..BodyState::at_rest(Vec3::new(4.0 * i as f32, height, -3.0 * (i % 5) as f32))
    }
}

fn against_body(context: &Context) -> Result<Vec<Row>, CaseError> {
    let seconds = context.pick(10.0, 20.0);
    let mut rows = Vec::new();
    for (name, desc) in shapes()? {
        for (what, wave, height) in
            [("regular wave", AiryWave::new(0.4, 20.0, 0.6), 0.2), ("dropped 1 m", AiryWave::new(0.0, 20.0, 0.0), 1.0)]
        {
            let alone = BodyDesc { sampling: Sampling::Patch, ..desc.clone() };
            let spots: Vec<_> = (0..12).map(|i| start(i, height)).collect();
            let mut many = fleet(&desc, 1, &spots)?;
            let mut bodies = Vec::new();
            for spot in &spots {
                let mut body = Body::new(alone.clone())?;
                body.set_state(*spot);
                bodies.push(body);
            }
            let mut worst = 0.0f32;
            for tick in 0..(seconds / f64::from(DT)) as u32 {
                let water = AiryWave { time: f64::from(tick) * f64::from(DT), ..wave };
                many.step(DT, &water);
                bodies.iter_mut().for_each(|body| body.step(DT, &water, &Controls::default()));
                for ((_, piece), body) in many.iter().zip(&bodies) {
                    worst = worst.max(apart(&piece, &body.state()));
                }
            }
            rows.push(
                Row::new("fleet_against_body", format!("{name}, {what}"))
                    .param("seconds", seconds)
                    .error(
                        f64::from(worst),
                        "m",
                        "bodies that read a patch a tick; worst place of 12, a metre off the middle",
                    )
                    .bound(5.0e-3),
            );
        }
    }
    Ok(rows)
}

fn refresh(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ticks = context.pick(600, 1800);
    let (desc, sea) = (crate_desc()?, Sea::new());
    let spots: Vec<_> = (0..48).map(|i| start(i, 0.1)).collect();
    let many = states(context.pick(2_000, 10_000));
    let one = pool(1)?;
    let (mut fleets, mut heavy) = (Vec::new(), Vec::new());
    for refresh in [1, 2, 4, 8, 16] {
        fleets.push(fleet(&desc, refresh, &spots)?);
        heavy.push(fleet(&desc, refresh, &many)?);
    }
    let (mut place, mut tilt, mut waves) = ([0.0f64; 5], [0.0f64; 5], 0.0);
    for tick in 0..ticks {
        let water = sea.clone().at(f64::from(tick) * f64::from(DT));
        fleets.iter_mut().for_each(|fleet| fleet.step(DT, &water));
        let truth: Vec<_> = fleets[0].iter().collect();
        for (i, fleet) in fleets.iter().enumerate() {
            for ((_, a), (_, b)) in fleet.iter().zip(&truth) {
                place[i] += f64::from((a.position.y - b.position.y).powi(2));
                tilt[i] += f64::from((a.orientation * Vec3::Y).distance_squared(b.orientation * Vec3::Y));
                waves += f64::from(b.position.y.powi(2)) / 5.0;
            }
        }
    }
    let water = sea.at(3.0);
    let [a, b, c, d, e] = heavy.as_mut_slice() else { return Err("five fleets".into()) };
    let timings = fastest(
        context.effort,
        [a, b, c, d, e]
            .map(|fleet| {
                let (one, water) = (&one, &water);
                move || one.install(|| fleet.step(DT, black_box(water)))
            })
            .each_mut()
            .map(|f| f as &mut dyn FnMut()),
    );
    let number = f64::from(ticks) * spots.len() as f64;
    let mut rows = Vec::new();
    for (i, refresh) in [1, 2, 4, 8, 16].into_iter().enumerate() {
        let row = Row::new("refresh", "twelve waves")
            .param("ticks_between_readings", refresh)
            .param("tilt_rms_degrees", (tilt[i] / number).sqrt().to_degrees())
            .error(100.0 * (place[i] / waves).sqrt(), "% of the heave", "reading in every tick, RMS of heights")
            .time("a tick of a piece, one thread", &timings[i].per(many.len() as f64))
            .baseline("reading in every tick", &timings[0].per(many.len() as f64));
        rows.push(if refresh == 4 { row.bound(3.0) } else { row });
    }
    Ok(rows)
}

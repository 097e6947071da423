//! Cases `query` (the sea at any point) and `patches` (the sea under a body), on one core.

use std::hint::black_box;

use glam::Vec2;
use ocean_spectrum::{Ocean, OceanDesc, OceanPatch, OceanSample};
use open_water_shaders::cubic::weights;
use rayon::prelude::*;

use crate::{
    evidence::{Case, CaseError, Context, Row, measure_together},
    fixtures::{self, Random},
    truth::Waves,
};

/// See the module.
pub(super) const QUERY: Case = Case {
    name: "query",
    about: "height, normal, motion and folds at points with the chop inverted, on one core",
    plots: &[],
    run: query,
};

/// See the module.
pub(super) const PATCHES: Case =
    Case { name: "patches", about: "the sea under small bodies, on one core", plots: &[], run: patches };

const POINTS: usize = 10_000;
/// The time of all these rows, in loops.
const TIME: f64 = 0.125;

fn sea(choppiness: f32) -> Result<Ocean, CaseError> {
    let mut ocean = Ocean::new(OceanDesc { choppiness, ..fixtures::ocean(256) })?;
    ocean.set_time(ocean.desc().loop_time * TIME);
    Ok(ocean)
}

fn scattered(side: f64) -> Vec<Vec2> {
    let mut random = Random::new(2);
    let mut within = || random.within(-0.5 * side, 0.5 * side) as f32;
    (0..POINTS).map(|_| Vec2::new(37.0 + within(), 59.0 + within())).collect()
}

fn samples(ocean: &Ocean, points: &[Vec2]) -> Vec<OceanSample> {
    let mut answers = vec![OceanSample::default(); points.len()];
    ocean.sample(points, &mut answers);
    answers
}

fn one_core() -> Result<rayon::ThreadPool, CaseError> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(1).build()?)
}

fn query(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ocean = sea(1.0)?;
    let time = ocean.desc().loop_time * TIME;
    let points = scattered(1000.0);
    let answered = samples(&ocean, &points);
    let hs = f64::from(ocean.significant_height());
    let waves = Waves::of(ocean.modes(), ocean.desc().choppiness, ocean.desc().loop_time);
    let checked = context.pick(48, 400);
    let square: f64 = points[..checked]
        .par_iter()
        .zip(&answered)
        .map(|(p, answer)| {
            let truth = waves.height_over(f64::from(p.x), f64::from(p.y), time);
            (f64::from(answer.height) - truth).powi(2)
        })
        .sum();
    let error = 100.0 * (square / checked as f64).sqrt() / hs;

    let effort = context.effort;
    let near = scattered(30.0);
    let (mut answers, mut more) = (answered.clone(), answered);
    let [mut first, mut second, mut third] = [(); 3].map(|()| vec![0.0f32; POINTS]);
    let mut again = ocean.clone();
    again.heights(&points, time, &mut first);
    let [ours, plain, ours_near, plain_near, heights] = one_core()?.install(|| {
        measure_together(
            effort,
            [
                &mut || ocean.sample(black_box(&points), &mut answers),
                &mut || bilinear(&ocean, black_box(&points), &mut first),
                &mut || ocean.sample(black_box(&near), &mut more),
                &mut || bilinear(&ocean, black_box(&near), &mut second),
                &mut || again.heights(black_box(&points), time, &mut third),
            ],
        )
    });
    let plainly = "bilinear heights at the same points, chop ignored";
    let mut rows = vec![
        Row::new("query", "points scattered over 1 km")
            .param("points", POINTS)
            .param("checked", checked)
            .error(error, "% of Hs", "direct sum in f64 with the chop inverted by Newton's method; RMS")
            .bound(0.1)
            .time("10,000 samples", &ours)
            .baseline(plainly, &plain),
        Row::new("query", "points within 30 m")
            .param("points", POINTS)
            .time("10,000 samples", &ours_near)
            .baseline(plainly, &plain_near),
        Row::new("query", "heights alone, points scattered over 1 km")
            .param("points", POINTS)
            .time("10,000 heights", &heights)
            .baseline(plainly, &plain),
    ];
    for choppiness in [1.0, 1.5, 2.0] {
        let ocean = sea(choppiness)?;
        let answers = samples(&ocean, &points);
        let whole = points.iter().zip(&answers).filter(|(_, answer)| !answer.folded);
        let worst = whole.clone().map(|(point, answer)| missed(&ocean, *point, answer.rest)).fold(0.0, f64::max);
        rows.push(
            Row::new("query", "residual where the surface does not fold")
                .param("choppiness", choppiness)
                .param("points", whole.count())
                .error(1e3 * worst, "mm", "the arrays read again at the rest points in f64; worst")
                .bound(1.0),
        );
    }
    Ok(rows)
}

/// Distance by which the particle that rests at a place misses the point, m.
fn missed(ocean: &Ocean, point: Vec2, rest: Vec2) -> f64 {
    let (mut x, mut z) = (f64::from(rest.x) - f64::from(point.x), f64::from(rest.y) - f64::from(point.y));
    for c in 0..ocean.modes().len() {
        let fields = ocean.fields(c);
        let size = fields.size as usize;
        let at = rest.as_dvec2() * f64::from(fields.size) / f64::from(fields.tile);
        let base = at.floor();
        let t = (at - base).as_vec2();
        let (wx, wz) = (weights(t.x).map(f64::from), weights(t.y).map(f64::from));
        for (j, wz) in wz.iter().enumerate() {
            for (i, wx) in wx.iter().enumerate() {
                let wrapped = |base: f64, i: usize| (base as i64 + i as i64 - 1).rem_euclid(size as i64) as usize;
                let texel = fields.displacement[wrapped(base.y, j) * size + wrapped(base.x, i)];
                x += wx * wz * f64::from(texel[0]);
                z += wx * wz * f64::from(texel[2]);
            }
        }
    }
    x.hypot(z)
}

fn patches(context: &Context) -> Result<Vec<Row>, CaseError> {
    let ocean = sea(1.0)?;
    let hs = f64::from(ocean.significant_height());
    let effort = context.effort;
    let (points, near) = (scattered(1000.0), scattered(30.0));
    let mut answers = vec![OceanPatch::default(); POINTS];
    let mut more = answers.clone();
    let [mut first, mut second] = [(); 2].map(|()| vec![0.0f32; POINTS]);
    let mut rows = Vec::new();
    for radius in [0.25f32, 0.5, 1.0, 2.0] {
        let radii = vec![radius; POINTS];
        let error = patch_error(&ocean, &points[..context.pick(200, 2000)], radius) * 100.0 / hs;
        let row = Row::new("patches", "points scattered over 1 km").param("radius_m", radius).error(
            error,
            "% of Hs",
            "mean of 256 samples over the disc; RMS",
        );
        if radius != 0.5 {
            rows.push(row);
            continue;
        }
        let [ours, plain, ours_near, plain_near] = one_core()?.install(|| {
            measure_together(
                effort,
                [
                    &mut || ocean.patches(black_box(&points), &radii, &mut answers),
                    &mut || bilinear(&ocean, black_box(&points), &mut first),
                    &mut || ocean.patches(black_box(&near), &radii, &mut more),
                    &mut || bilinear(&ocean, black_box(&near), &mut second),
                ],
            )
        });
        let plainly = "bilinear heights at the same points, chop ignored";
        rows.push(row.time("10,000 patches", &ours).baseline(plainly, &plain));
        rows.push(
            Row::new("patches", "points within 30 m")
                .param("radius_m", radius)
                .time("10,000 patches", &ours_near)
                .baseline(plainly, &plain_near),
        );
    }
    Ok(rows)
}

/// RMS difference of the patch's height and the mean over its disc, m.
fn patch_error(ocean: &Ocean, points: &[Vec2], radius: f32) -> f64 {
    // Fibonacci's spiral covers a disc evenly.
    let disc: Vec<Vec2> = (0..256)
        .map(|i| {
            let share = (i as f32 + 0.5) / 256.0;
            Vec2::from_angle(i as f32 * 2.399_963) * radius * share.sqrt()
        })
        .collect();
    let mut answers = vec![OceanSample::default(); disc.len()];
    let mut square = 0.0;
    for point in points {
        let around: Vec<Vec2> = disc.iter().map(|offset| *point + *offset).collect();
        ocean.sample(&around, &mut answers);
        let mean = answers.iter().map(|answer| f64::from(answer.height)).sum::<f64>() / answers.len() as f64;
        square += (f64::from(ocean.patch(*point, radius).height) - mean).powi(2);
    }
    (square / points.len() as f64).sqrt()
}

/// What one gets from a height map read in the simplest way.
fn bilinear(ocean: &Ocean, points: &[Vec2], out: &mut [f32]) {
    out.fill(0.0);
    for c in 0..ocean.modes().len() {
        let fields = ocean.fields(c);
        let (size, mask) = (fields.size as usize, fields.size as usize - 1);
        let scale = fields.size as f32 / fields.tile;
        for (point, out) in points.iter().zip(&mut *out) {
            let at = *point * scale;
            let (floor, part) = (at.floor(), at - at.floor());
            let (i, j) = (floor.x as i32 as usize & mask, floor.y as i32 as usize & mask);
            let (i1, j1) = ((i + 1) & mask, (j + 1) & mask);
            let h = |i: usize, j: usize| fields.displacement[j * size + i][1];
            let near = h(i, j) + part.x * (h(i1, j) - h(i, j));
            let far = h(i, j1) + part.x * (h(i1, j1) - h(i, j1));
            *out += near + part.y * (far - near);
        }
    }
}

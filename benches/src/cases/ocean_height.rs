//! Case `queries`: the sea at any point, and under a body.

use std::hint::black_box;

use glam::Vec2;
use ocean_spectrum::{Ocean, OceanSample};
use rayon::prelude::*;

use crate::{
    evidence::{Case, CaseError, Context, Row, measure_together},
    fixtures::{self, Random},
    truth::Waves,
};

/// See the module.
pub(super) const QUERIES: Case = Case {
    name: "queries",
    about: "heights at points with the chop inverted, and patches under bodies",
    plots: &[],
    run: queries,
};

fn queries(context: &Context) -> Result<Vec<Row>, CaseError> {
    const POINTS: usize = 10_000;
    let mut ocean = Ocean::new(fixtures::ocean(256))?;
    let time = ocean.desc().loop_time * 0.125;
    ocean.set_time(time);
    let mut random = Random::new(2);
    let mut place = || Vec2::new(random.within(-500.0, 500.0) as f32, random.within(-500.0, 500.0) as f32);
    let points: Vec<Vec2> = (0..POINTS).map(|_| place()).collect();
    let mut answers = vec![OceanSample::default(); POINTS];
    ocean.sample(&points, &mut answers);
    let hs = f64::from(ocean.significant_height());

    let waves = Waves::of(ocean.modes(), ocean.desc().choppiness, ocean.desc().loop_time);
    let checked = context.pick(48, 400);
    let square: f64 = points[..checked]
        .par_iter()
        .zip(&answers)
        .map(|(p, answer)| {
            let truth = waves.height_over(f64::from(p.x), f64::from(p.y), time);
            (f64::from(answer.height) - truth).powi(2)
        })
        .sum();
    let error = 100.0 * (square / checked as f64).sqrt() / hs;

    let (mut heights, mut patches) = (vec![0.0f32; POINTS], vec![0.0f32; POINTS]);
    let [ours, plain, patch] = measure_together(
        context.effort,
        [
            &mut || ocean.sample(black_box(&points), &mut answers),
            &mut || bilinear(&ocean, black_box(&points), &mut heights),
            &mut || {
                patches.par_iter_mut().zip(&points).with_min_len(256).for_each(|(height, p)| {
                    *height = ocean.patch(*p, 0.5).height;
                });
            },
        ],
    );
    let mut rows = vec![
        Row::new("queries", "sample")
            .param("points", POINTS)
            .param("checked", checked)
            .error(error, "% of Hs", "direct sum in f64 with the chop inverted by Newton's method; RMS")
            .bound(0.1)
            .time("10,000 points", &ours)
            .baseline("bilinear heights at the same points, chop ignored, one thread", &plain),
    ];
    for radius in [0.25f32, 0.5, 1.0, 2.0] {
        let error = patch_error(&ocean, &points[..context.pick(200, 2000)], radius) * 100.0 / hs;
        rows.push(
            Row::new("queries", "patch")
                .param("radius_m", radius)
                .error(error, "% of Hs", "mean of 256 samples over the disc; RMS")
                .time("10,000 patches on all threads", &patch)
                .baseline("10,000 samples", &ours),
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

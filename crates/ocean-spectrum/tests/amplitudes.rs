//! The map of amplitudes: what queries make of it.

use std::sync::Arc;

use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::{
    AmplitudeMap, CascadeDesc, CascadeFactors, Ocean, OceanDesc, OceanSample, Queries, SeaState, Spectrum, Spreading,
    TableRow,
};

fn points(n: u32, side: f32) -> Vec<Vec2> {
    let part = |i: u32, m: u32| ((i.wrapping_mul(m) >> 8) as f32 / 16_777_216.0 - 0.5) * side;
    (0..n).map(|i| Vec2::new(part(i + 1, 2_654_435_761), part(i + 1, 2_246_822_519))).collect()
}

fn answers(ocean: &Ocean, points: &[Vec2]) -> Vec<OceanSample> {
    let mut out = vec![OceanSample::default(); points.len()];
    ocean.sample(points, &mut out);
    out
}

fn sea() -> Ocean {
    let mut ocean = Ocean::new(OceanDesc::default()).unwrap();
    ocean.set_time(31.4);
    ocean
}

/// A map of texels `texel` apart, around the origin, from a function of the place.
fn map(texel: f32, size: u32, f: impl Fn(DVec2) -> CascadeFactors) -> Arc<AmplitudeMap> {
    let corner = DVec2::splat(-0.5 * f64::from(texel) * f64::from(size - 1));
    let place = |i: u32| corner + f64::from(texel) * DVec2::new(f64::from(i % size), f64::from(i / size));
    let factors = (0..size * size).map(|i| f(place(i))).collect();
    Arc::new(AmplitudeMap::new(corner, texel, [size, size], factors).unwrap())
}

/// Different for every cascade and axis, from 0 to 1 within 60 m.
fn hills(place: DVec2) -> CascadeFactors {
    std::array::from_fn(|c| {
        let c = c as f64;
        (0.5 + 0.25 * ((place.x / 19.0 + c).sin() + (place.y / (11.0 + c) - c).cos())) as f32
    })
}

#[test]
fn a_factor_of_one_changes_no_bit() {
    for queries in [Queries::Arrays, Queries::Largest(64)] {
        of_one(Ocean::new(OceanDesc { queries, ..OceanDesc::default() }).unwrap());
    }
}

fn of_one(mut ocean: Ocean) {
    ocean.set_time(31.4);
    let points = points(2000, 400.0);
    let (plain, patches): (_, Vec<_>) =
        (answers(&ocean, &points), points.iter().map(|&p| ocean.patch(p, 0.7)).collect());
    ocean.set_amplitudes(Some(map(5.0, 40, |_| [1.0; 8])));
    assert_eq!(answers(&ocean, &points), plain);
    assert!(points.iter().zip(&patches).all(|(&p, patch)| ocean.patch(p, 0.7) == *patch));
    // And it is the map that is read: one that changes things does.
    ocean.set_amplitudes(Some(map(5.0, 40, hills)));
    assert_ne!(answers(&ocean, &points), plain);
    ocean.set_amplitudes(None);
    assert!(ocean.amplitudes().is_none());
    assert_eq!(answers(&ocean, &points), plain);
}

#[test]
fn a_factor_of_zero_is_calm() {
    let mut ocean = sea();
    ocean.set_amplitudes(Some(map(5.0, 40, |_| [0.0; 8])));
    for point in points(200, 400.0) {
        let calm = OceanSample { rest: point, ..OceanSample::default() };
        assert_eq!(answers(&ocean, &[point])[0], calm);
        let patch = ocean.patch(point, 0.5);
        assert_eq!((patch.height, patch.gradient, patch.velocity), (0.0, Vec2::ZERO, Vec3::ZERO));
        assert!(patch.decay_wavenumber > 0.0);
    }
}

#[test]
fn each_cascade_has_its_own_factor() {
    // The last two off: what is left is the sea of the first alone.
    let mut ocean = sea();
    let first = OceanDesc { cascades: ocean.desc().cascades[..1].to_vec(), ..OceanDesc::default() };
    let mut alone = Ocean::new(first).unwrap();
    alone.set_time(31.4);
    ocean.set_amplitudes(Some(map(5.0, 40, |_| [1.0, 0.0, 0.0, 2.0, 2.0, 2.0, 2.0, 2.0])));
    // A band's upper end depends on the next cascade, so compare with the arrays of the same sea at rest points.
    for answer in answers(&ocean, &points(300, 400.0)) {
        assert!(answer.height.abs() < 1.2 * alone.significant_height());
        let f = ocean.fields(0);
        let at = |i: i64, j: i64| f.displacement[(j.rem_euclid(256) * 256 + i.rem_euclid(256)) as usize][1];
        let x = answer.rest / (f.tile / 256.0);
        let (i, j) = (x.x.floor() as i64, x.y.floor() as i64);
        let near = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        let (low, high) = near.iter().fold((f32::MAX, f32::MIN), |(l, h), &v| (l.min(v), h.max(v)));
        let slack = 0.15 * (high - low) + 1e-3;
        assert!((low - slack..=high + slack).contains(&answer.height), "{answer:?} of {near:?}");
    }
}

#[test]
fn outside_the_map_its_edge_goes_on() {
    let mut ocean = sea();
    ocean.set_amplitudes(Some(map(4.0, 20, hills)));
    let edge = hills(DVec2::new(38.0, 38.0));
    let far = [Vec2::new(60.0, 70.0), Vec2::new(4e3, 900.0), Vec2::new(1e5, 3e6)];
    let clamped = answers(&ocean, &far);
    ocean.set_amplitudes(Some(map(4.0, 20, |_| edge)));
    assert_eq!(clamped, answers(&ocean, &far));
    // Across the edge, and across texels within.
    ocean.set_amplitudes(Some(map(4.0, 20, hills)));
    for start in [Vec2::new(37.0, 0.3), Vec2::new(0.7, -39.0), Vec2::new(-1.3, 2.2)] {
        let line: Vec<_> = (0..2000).map(|i| start + Vec2::new(0.001, 0.0012) * i as f32).collect();
        for pair in answers(&ocean, &line).windows(2) {
            assert!((pair[0].height - pair[1].height).abs() < 3e-3);
        }
    }
}

#[test]
fn the_map_stays_when_the_origin_moves() {
    let mut ocean = sea();
    ocean.set_amplitudes(Some(map(4.0, 50, hills)));
    let points = points(300, 150.0);
    let before = answers(&ocean, &points);
    let shift = DVec2::new(64.0, -32.0);
    ocean.set_origin(shift);
    let moved: Vec<_> = points.iter().map(|&p| p - shift.as_vec2()).collect();
    for (a, b) in before.iter().zip(answers(&ocean, &moved)) {
        assert!((a.height - b.height).abs() < 2e-3, "{} {}", a.height, b.height);
    }
}

#[test]
fn slopes_are_those_of_the_heights_on_a_steep_map() {
    // Long waves alone, so that heights and slopes read by the kernel agree; from nothing to all within 12 m.
    let row = |frequency, density| TableRow { frequency, density, direction: 0.5, s: 6.0 };
    let rows = vec![row(0.1, 0.0), row(0.15, 8.0), row(0.25, 0.0)];
    let both = [Queries::Arrays, Queries::Largest(500)];
    for (choppiness, queries) in [0.0, 1.0].into_iter().flat_map(|chop| both.map(|queries| (chop, queries))) {
        let cascades = vec![CascadeDesc::new(256, 240.0)];
        let sea = SeaState::single(Spectrum::Table(rows.clone()), 0.0, Spreading::BothWays);
        let mut ocean = Ocean::new(OceanDesc { sea, cascades, choppiness, queries, ..Default::default() }).unwrap();
        ocean.set_time(12.0);
        ocean.set_amplitudes(Some(map(4.0, 60, |p| [(0.5 + (p.x + 0.5 * p.y) / 12.0).clamp(0.0, 1.0) as f32; 8])));
        let (mut worst, mut sum, mut n) = (0.0f32, 0.0, 0.0);
        let e = 0.05;
        for point in points(4000, 60.0) {
            let five = [point, point + e * Vec2::X, point - e * Vec2::X, point + e * Vec2::Y, point - e * Vec2::Y];
            let a = answers(&ocean, &five);
            // A factor's slope jumps at texels.
            let texel = |a: &OceanSample| ((a.rest + 118.0) / 4.0).floor();
            if a.iter().any(|other| texel(other) != texel(&a[0]) || other.folded) {
                continue;
            }
            let found = Vec2::new(-a[0].normal.x, -a[0].normal.z) / a[0].normal.y;
            let slope = Vec2::new(a[1].height - a[2].height, a[3].height - a[4].height) / (2.0 * e);
            worst = worst.max(found.distance(slope));
            sum += slope.length();
            n += 1.0;
        }
        assert!(n > 2000.0 && sum / n > 0.02, "{n} {}", sum / n);
        assert!(worst < 0.002, "chop {choppiness}: {worst} of {}", sum / n);
    }
}

#[test]
fn the_chop_is_inverted_on_steep_maps() {
    // All of the sea to nothing and back within two texels of 4 m, and a checkerboard of factors.
    let ridge = |p: DVec2| [(1.0 - (p.x.abs() / 8.0)).clamp(0.0, 1.0) as f32; 8];
    let board = |p: DVec2| [if ((p.x + p.y) / 4.0).round() % 2.0 == 0.0 { 1.0 } else { 0.2 }; 8];
    for map in [map(4.0, 61, ridge), map(4.0, 61, board)] {
        let mut ocean = sea();
        ocean.set_amplitudes(Some(map));
        for t in [0.0, 5.5, 200.0] {
            ocean.set_time(t);
            let answers = answers(&ocean, &points(5000, 240.0));
            let missed = answers.iter().filter(|a| a.residual > 1e-3).count();
            assert!(missed <= 5, "{t}: {missed}");
            assert!(answers.iter().all(|a| a.height.abs() < 3.0 && a.normal.is_normalized()));
        }
    }
}

#[test]
fn motion_and_decay_follow_the_factors() {
    let mut ocean = sea();
    let point = Vec2::new(3.0, 8.0);
    let open = ocean.patch(point, 0.5);
    // Only the finest cascade left: its waves fade within decimetres.
    ocean.set_amplitudes(Some(map(5.0, 40, |_| [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])));
    let fine = ocean.patch(point, 0.5);
    assert!(fine.decay_wavenumber > 5.0 * open.decay_wavenumber);
    assert!(fine.velocity.length() < 0.2 && fine.velocity.length() > 0.0 && fine.height.abs() < 0.2);
    // With twice the factor, a sea without chop does everything twice.
    let mut ocean = Ocean::new(OceanDesc { choppiness: 0.0, ..Default::default() }).unwrap();
    ocean.set_time(5.0);
    let one = answers(&ocean, &[point])[0];
    ocean.set_amplitudes(Some(map(5.0, 40, |_| [2.0; 8])));
    let two = answers(&ocean, &[point])[0];
    assert_eq!((two.height, two.velocity), (2.0 * one.height, 2.0 * one.velocity));
    assert_eq!(two.vertical_acceleration, 2.0 * one.vertical_acceleration);
}

#[test]
fn maps_out_of_bounds_are_refused() {
    let good = || vec![[1.0; 8]; 6];
    let zero = DVec2::ZERO;
    let with = |i: usize, value: f32| {
        let mut factors = good();
        factors[i][5] = value;
        factors
    };
    let bad = [
        AmplitudeMap::new(DVec2::new(f64::NAN, 0.0), 1.0, [3, 2], good()),
        AmplitudeMap::new(DVec2::new(0.0, 1e12), 1.0, [3, 2], good()),
        AmplitudeMap::new(zero, 0.0, [3, 2], good()),
        AmplitudeMap::new(zero, f32::INFINITY, [3, 2], good()),
        AmplitudeMap::new(zero, 1.0, [6, 1], good()),
        AmplitudeMap::new(zero, 1.0, [5000, 2], good()),
        AmplitudeMap::new(zero, 1.0, [2, 2], good()),
        AmplitudeMap::new(zero, 1.0, [3, 2], with(5, f32::NAN)),
        AmplitudeMap::new(zero, 1.0, [3, 2], with(2, -0.1)),
        AmplitudeMap::new(zero, 1.0, [3, 2], with(0, 4.1)),
    ];
    for map in bad {
        let error = map.err().unwrap().to_string();
        assert!(error.contains("map ") && error.contains("; allowed: "), "{error}");
    }
    assert!(AmplitudeMap::new(zero, 1.0, [3, 2], good()).is_ok());
}

#[test]
fn the_height_within_a_rectangle_is_the_largest_there() {
    let mut ocean = sea();
    let all = ocean.significant_height_within(Vec2::splat(-1e4), Vec2::splat(1e4));
    assert!((all / ocean.significant_height() - 1.0).abs() < 1e-3, "{all}");
    // Calm behind x = 40 m.
    let mole = |place: DVec2| [if place.x > 40.0 { 0.0 } else { 0.5 }; 8];
    ocean.set_amplitudes(Some(map(5.0, 41, mole)));
    let within = |low: [f32; 2], high: [f32; 2]| ocean.significant_height_within(low.into(), high.into());
    assert_eq!(within([46.0, -90.0], [80.0, 90.0]), 0.0);
    assert_eq!(within([300.0, 300.0], [301.0, 301.0]), 0.0);
    for (low, high) in [([44.0, 0.0], [60.0, 9.0]), ([-999.0, 0.0], [-998.0, 1.0]), ([60.0, 9.0], [30.0, 0.0])] {
        assert!((within(low, high) / all - 0.5).abs() < 1e-3, "{low:?}");
    }
    assert!((within([f32::NAN; 2], [60.0, 9.0]) / all - 0.5).abs() < 1e-3);
}

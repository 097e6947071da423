//! Queries by direct sum of the largest waves, and what both ways of answering have in common.

use glam::{DVec2, DVec3, Vec2};
use ocean_spectrum::reference::{self, Fields};
use ocean_spectrum::{CascadeDesc, Ocean, OceanDesc, OceanSample, Queries, SeaState};

fn points(n: u32, side: f32) -> Vec<Vec2> {
    let part = |i: u32, m: u32| ((i.wrapping_mul(m) >> 8) as f32 / 16_777_216.0 - 0.5) * side;
    (0..n).map(|i| Vec2::new(part(i + 1, 2_654_435_761), part(i + 1, 2_246_822_519))).collect()
}

fn answers(ocean: &Ocean, points: &[Vec2]) -> Vec<OceanSample> {
    let mut out = vec![OceanSample::default(); points.len()];
    ocean.sample(points, &mut out);
    out
}

/// A sea of so few modes that 4,096 hold them all.
fn small(queries: Queries) -> OceanDesc {
    let cascades = vec![CascadeDesc::new(32, 200.0), CascadeDesc::new(32, 31.0)];
    OceanDesc { cascades, queries, ..OceanDesc::default() }
}

/// The fields of some mode sets with their weights, in f64, at a place of the world.
fn sum(ocean: &Ocean, weights: [f32; 2], x: DVec2, t: f64) -> Fields {
    let (first, second) = ocean.mode_sets();
    let sets = [Some(first), second];
    let desc = ocean.desc();
    let mut all = Fields::default();
    for (modes, weight) in sets.into_iter().zip(weights) {
        for modes in modes.into_iter().flatten() {
            let f = reference::direct_sum(modes, desc.choppiness.into(), desc.loop_time, x, t);
            for n in 0..4 {
                all.displacement[n] += f64::from(weight) * f.displacement[n];
                all.derivative[n] += f64::from(weight) * f.derivative[n];
                all.velocity[n] += f64::from(weight) * f.velocity[n];
            }
        }
    }
    all
}

/// Holds answers against the direct sum in f64.
fn hold(ocean: &Ocean, weights: [f32; 2], origin: DVec2, t: f64, points: &[Vec2]) {
    for (point, a) in points.iter().zip(answers(ocean, points)) {
        let f = sum(ocean, weights, origin + a.rest.as_dvec2(), t);
        let at = a.rest.as_dvec2() + DVec2::new(f.displacement[0], f.displacement[2]);
        let [hx, hz, xx, zz] = f.derivative;
        let cross = f.displacement[3];
        let jacobian = (1.0 + xx) * (1.0 + zz) - cross * cross;
        let slope = DVec2::new((1.0 + zz) * hx - cross * hz, (1.0 + xx) * hz - cross * hx) / jacobian;
        let normal = a.normal.as_dvec3();
        let v = DVec3::new(f.velocity[0], f.velocity[1], f.velocity[2]);
        assert!(at.distance(point.as_dvec2()) < 3e-4, "{point} {}", at.distance(point.as_dvec2()));
        assert!((f64::from(a.height) - f.displacement[1]).abs() < 1e-4);
        assert!((DVec2::new(-normal.x, -normal.z) / normal.y).distance(slope) < 1e-4);
        assert!(a.velocity.as_dvec3().distance(v) < 1e-4);
        assert!((f64::from(a.vertical_acceleration) - f.velocity[3]).abs() < 1e-4);
        assert!((f64::from(a.jacobian) - jacobian).abs() < 1e-4);
        // Eigenvalues: their sum is the trace, their product the determinant.
        let [low, high] = a.stretch.map(f64::from);
        assert!(low <= high && (low + high - (2.0 + xx + zz)).abs() < 1e-4 && (low * high - jacobian).abs() < 1e-4);
    }
}

#[test]
fn all_waves_are_the_sea() {
    let mut ocean = Ocean::new(small(Queries::Largest(4096))).unwrap();
    hold(&ocean, [1.0, 0.0], DVec2::ZERO, ocean.time(), &points(300, 800.0));
    // Far away, late.
    let origin = DVec2::new(3.2e7, -5.4e7);
    ocean.set_origin(origin);
    ocean.set_time(1e7 + 0.3);
    hold(&ocean, [1.0, 0.0], origin, ocean.time(), &points(300, 800.0));
}

#[test]
fn a_change_mixes_both_seas() {
    let mut ocean = Ocean::new(small(Queries::Largest(4096))).unwrap();
    let next = OceanDesc { sea: SeaState::wind(14.0, 60e3, 0.4), ..small(Queries::Arrays) };
    ocean.change_to(next, 100.0, 60.0).unwrap();
    ocean.set_time(125.0);
    let weights = ocean.moment_at(125.0).weight;
    assert!(weights[0] > 0.1 && weights[1] > 0.1);
    hold(&ocean, weights, DVec2::ZERO, ocean.time(), &points(200, 500.0));
    ocean.set_time(200.0);
    hold(&ocean, [1.0, 0.0], DVec2::ZERO, ocean.time(), &points(50, 500.0));
}

#[test]
fn more_waves_come_nearer() {
    let point = points(400, 900.0);
    let all = Ocean::new(OceanDesc::default()).unwrap();
    let expected = answers(&all, &point);
    let mut last = f32::INFINITY;
    for count in [16, 64, 256, 1024] {
        let queries = Queries::Largest(count);
        let ocean = Ocean::new(OceanDesc { queries, ..OceanDesc::default() }).unwrap();
        let found = answers(&ocean, &point);
        let square = found.iter().zip(&expected).map(|(a, b)| (a.height - b.height).powi(2)).sum::<f32>();
        assert!(square < 0.8 * last, "{count}: {square} {last}");
        last = square;
    }
    assert!((last / 400.0).sqrt() < 0.1 * all.significant_height());
}

#[test]
fn a_body_feels_each_wave_by_its_own_length() {
    // One wave of 12.5 m: the mean over a disc of its length times .3 is 2 J1(x)/x of it, x = 2 pi .3.
    let ocean = Ocean::new(OceanDesc { choppiness: 0.0, ..small(Queries::Largest(1)) }).unwrap();
    let at = Vec2::new(3.0, 4.0);
    let k = ocean.decay_wavenumber(0.0);
    let radius = 0.6 * std::f32::consts::PI / k;
    let share = ocean.patch(at, radius).height / ocean.patch(at, 0.0).height;
    // J1(0.6 pi) = 0.58116 (Abramowitz and Stegun, table 9.1, interpolated).
    assert!((share - 2.0 * 0.58116 / (0.6 * std::f32::consts::PI)).abs() < 1e-3, "{share}");
    assert_eq!(ocean.patch(at, 3.9 / k).height, 0.0);
    assert!((ocean.decay_wavenumber(radius) / k - 1.0).abs() < 1e-5);
}

#[test]
fn counts_out_of_bounds_are_refused() {
    for count in [0, 4097, u32::MAX] {
        let error = Ocean::new(small(Queries::Largest(count))).err().unwrap().to_string();
        assert!(error.contains("queries") && error.contains("1 to 4096"), "{error}");
    }
}

#[test]
fn heights_at_any_time_are_those_of_samples() {
    for queries in [Queries::Arrays, Queries::Largest(50)] {
        let mut ocean = Ocean::new(OceanDesc { queries, ..OceanDesc::default() }).unwrap();
        let points = points(700, 300.0);
        let (mut heights, mut samples) = (vec![0.0; 700], vec![OceanSample::default(); 700]);
        for t in [60.0, -3.5, 1e7] {
            ocean.heights(&points, t, &mut heights);
            ocean.samples(&points, t, &mut samples);
            assert!(heights.iter().zip(&samples).all(|(h, s)| *h == s.height) && heights[1] != 0.0);
            assert_eq!(ocean.height(points[1]), heights[1]);
        }
        // The shorter slice counts.
        let mut few = [7.0; 3];
        ocean.heights(&points[..2], 0.0, &mut few);
        assert!(few[2] == 7.0 && few[0] != 7.0);
    }
}

#[test]
fn far_positions_are_as_exact_as_near_ones() {
    // 2^17 m away, f32 still holds these points exactly.
    let away = 131_072.0;
    let points: Vec<_> = points(400, 300.0).iter().map(|p| (p * 32.0).round() / 32.0).collect();
    let far: Vec<_> = points.iter().map(|p| p + Vec2::new(away, -away)).collect();
    for queries in [Queries::Arrays, Queries::Largest(100)] {
        let mut ocean = Ocean::new(OceanDesc { queries, ..OceanDesc::default() }).unwrap();
        let there = answers(&ocean, &far);
        ocean.set_origin(DVec2::new(away.into(), (-away).into()));
        for (a, b) in answers(&ocean, &points).iter().zip(&there) {
            assert!((a.height - b.height).abs() < 1e-4 && a.normal.distance(b.normal) < 2e-3, "{a:?} {b:?}");
        }
    }
}

//! Queries: the sea at world points.

use glam::{DVec2, Vec2, Vec3};
use ocean_spectrum::reference::{self, Fields};
use ocean_spectrum::{Ocean, OceanDesc, OceanSample};

fn points(n: u32, side: f32) -> Vec<Vec2> {
    let part = |i: u32, m: u32| ((i.wrapping_mul(m) >> 8) as f32 / 16_777_216.0 - 0.5) * side;
    (0..n).map(|i| Vec2::new(part(i + 1, 2_654_435_761), part(i + 1, 2_246_822_519))).collect()
}

fn answers(ocean: &Ocean, points: &[Vec2]) -> Vec<OceanSample> {
    let mut out = vec![OceanSample::default(); points.len()];
    ocean.sample(points, &mut out);
    out
}

fn sum(ocean: &Ocean, x: Vec2) -> Fields {
    let desc = ocean.desc();
    let mut all = Fields::default();
    for modes in ocean.modes() {
        let f = reference::direct_sum(modes, desc.choppiness.into(), desc.loop_time, x.as_dvec2(), ocean.time());
        for n in 0..4 {
            all.displacement[n] += f.displacement[n];
            all.derivative[n] += f.derivative[n];
            all.velocity[n] += f.velocity[n];
        }
    }
    all
}

fn default_sea(t: f64) -> Ocean {
    let mut ocean = Ocean::new(OceanDesc::default()).unwrap();
    ocean.set_time(t);
    ocean
}

#[test]
fn answers_are_those_of_the_direct_sum() {
    let ocean = default_sea(31.4);
    let points = points(60, 900.0);
    let (mut place, mut height, mut velocity, mut acceleration, mut slope) = (0.0f64, 0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for (&point, answer) in points.iter().zip(answers(&ocean, &points)) {
        let f = sum(&ocean, answer.rest);
        let at = answer.rest.as_dvec2() + DVec2::new(f.displacement[0], f.displacement[2]);
        place = place.max(at.distance(point.as_dvec2()));
        let [hx, hz, xx, zz] = f.derivative;
        let xz = f.displacement[3];
        let jacobian = (1.0 + xx) * (1.0 + zz) - xz * xz;
        let slopes = DVec2::new((1.0 + zz) * hx - xz * hz, (1.0 + xx) * hz - xz * hx) / jacobian;
        let normal = answer.normal.as_dvec3();
        slope = slope.max((DVec2::new(-normal.x, -normal.z) / normal.y).distance(slopes));
        height = height.max((f64::from(answer.height) - f.displacement[1]).abs());
        let v = glam::DVec3::new(f.velocity[0], f.velocity[1], f.velocity[2]);
        velocity = velocity.max(answer.velocity.as_dvec3().distance(v));
        acceleration = acceleration.max((f64::from(answer.vertical_acceleration) - f.velocity[3]).abs());
    }
    // What the cubic kernel loses of waves of a few texels.
    assert!(place < 5e-3 && height < 5e-3 && velocity < 0.06 && acceleration < 1.0 && slope < 0.1);
}

#[test]
fn velocity_is_how_the_particle_moves() {
    let (t, e) = (12.0, 0.01);
    let ocean = default_sea(t);
    for (point, answer) in points(20, 500.0).iter().zip(answers(&ocean, &points(20, 500.0))) {
        let at = |t| {
            let mut ocean = Fields::default();
            for modes in default_modes() {
                let f = reference::direct_sum(modes, 1.0, 1024.0, answer.rest.as_dvec2(), t);
                (0..4).for_each(|n| ocean.displacement[n] += f.displacement[n]);
            }
            Vec3::from_slice(&ocean.displacement[..3].iter().map(|&d| d as f32).collect::<Vec<_>>())
        };
        let velocity = (at(t + e) - at(t - e)) / (2.0 * e as f32);
        assert!(answer.velocity.distance(velocity) < 0.06, "{point}: {} {velocity}", answer.velocity);
    }
}

fn default_modes() -> &'static [ocean_spectrum::CascadeModes] {
    static OCEAN: std::sync::OnceLock<Ocean> = std::sync::OnceLock::new();
    OCEAN.get_or_init(|| default_sea(0.0)).modes()
}

#[test]
fn the_chop_is_inverted() {
    // Beyond a choppiness of 1 the fixed point alone does not get there.
    for choppiness in [1.0, 1.5] {
        let mut ocean = Ocean::new(OceanDesc { choppiness, ..Default::default() }).unwrap();
        for t in [0.0, 5.5, 200.0] {
            ocean.set_time(t);
            let answers = answers(&ocean, &points(5000, 1500.0));
            let missed = answers.iter().filter(|a| a.residual > 1e-3).count();
            // Where it folds, there may be no particle near.
            assert!(missed <= if choppiness > 1.0 { 2 } else { 0 }, "{choppiness}, {t}: {missed}");
            assert!(answers.iter().all(|a| a.folded || a.residual <= 1e-3));
        }
    }
}

#[test]
fn folding_seas_stay_finite() {
    let mut ocean = Ocean::new(OceanDesc { choppiness: 2.0, ..Default::default() }).unwrap();
    ocean.set_time(3.0);
    let answers = answers(&ocean, &points(20_000, 1500.0));
    assert!(answers.iter().any(|a| a.folded));
    for a in answers {
        assert!(a.height.abs() < 5.0 && a.normal.is_normalized() && a.velocity.is_finite(), "{a:?}");
    }
}

#[test]
fn heights_are_continuous() {
    let ocean = default_sea(7.0);
    // Across the edges of all three tiles.
    for start in [Vec2::new(-1.0, 0.3), Vec2::new(484.0, 484.0), Vec2::new(71.4, -72.9)] {
        let line: Vec<_> = (0..2000).map(|i| start + Vec2::new(0.001, 0.0007) * i as f32).collect();
        for pair in answers(&ocean, &line).windows(2) {
            assert!((pair[0].height - pair[1].height).abs() < 2.5e-3);
            assert!(pair[0].normal.distance(pair[1].normal) < 0.1);
        }
    }
}

#[test]
fn the_sea_stays_when_the_origin_moves() {
    let mut ocean = default_sea(2.0);
    let before = answers(&ocean, &points(200, 300.0));
    let origin = DVec2::new(-1_234_567.0, 987_654.0);
    let far: Vec<_> = points(200, 300.0);
    ocean.set_origin(origin);
    let moved = answers(&ocean, &far);
    assert!(before.iter().zip(&moved).any(|(a, b)| (a.height - b.height).abs() > 0.1));
    // Places a whole number of tiles of every cascade apart do not exist; so compare world points near both origins.
    ocean.set_origin(origin + DVec2::new(100.0, -50.0));
    let shifted: Vec<_> = far.iter().map(|p| *p - Vec2::new(100.0, -50.0)).collect();
    for (a, b) in moved.iter().zip(answers(&ocean, &shifted)) {
        assert!((a.height - b.height).abs() < 2e-3, "{} {}", a.height, b.height);
    }
    ocean.set_origin(DVec2::new(f64::NAN, 0.0));
    assert_eq!(answers(&ocean, &shifted[..1])[0].height, answers(&ocean, &shifted)[0].height);
}

#[test]
fn nonsense_points_find_calm_water() {
    let ocean = default_sea(1.0);
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -1e30];
    for x in bad {
        for point in [Vec2::new(x, 0.0), Vec2::new(0.0, x), Vec2::splat(x)] {
            assert_eq!(answers(&ocean, &[point])[0], OceanSample::default());
            let patch = ocean.patch(point, 1.0);
            assert!(patch.height == 0.0 && patch.velocity == Vec3::ZERO && patch.decay_wavenumber > 0.0);
        }
    }
    assert!(answers(&ocean, &[Vec2::splat(9e7)])[0].height.is_finite());
    assert!(ocean.patch(Vec2::ZERO, f32::NAN).height.is_finite());
    assert!(ocean.patch(Vec2::ZERO, f32::INFINITY).decay_wavenumber > 0.0);
    let mut ocean = ocean;
    ocean.set_time(f64::NAN);
    assert_eq!(ocean.phase(), 0);
    assert!(ocean.height(Vec2::ZERO).is_finite());
}

#[test]
fn an_answer_does_not_depend_on_its_company() {
    let ocean = default_sea(9.0);
    let points = points(1000, 700.0);
    let together = answers(&ocean, &points);
    for i in [0, 255, 256, 999] {
        assert_eq!(answers(&ocean, &points[i..=i])[0], together[i]);
    }
    // Large bodies do not even feel all cascades.
    let radii: Vec<f32> = (0..points.len()).map(|i| [0.0, 0.4, 1.1, 3.0, 20.0, 4000.0][i % 6]).collect();
    let mut patches = vec![ocean_spectrum::OceanPatch::default(); points.len()];
    ocean.patches(&points, &radii, &mut patches);
    for ((&point, &radius), patch) in points.iter().zip(&radii).zip(&patches) {
        assert_eq!(ocean.patch(point, radius), *patch, "{radius}");
    }
    let mut prepared = ocean.clone();
    prepared.prepare_patches(1.1);
    assert_eq!(prepared.patch(points[2], 1.1), patches[2]);
}

#[test]
fn a_patch_is_the_sample_filtered() {
    let ocean = default_sea(4.0);
    let (mut narrow, mut wide) = (0.0f32, 0.0f32);
    for point in points(300, 500.0) {
        let sample = answers(&ocean, &[point])[0];
        let patch = ocean.patch(point, 0.0);
        // Both end with a last step of 5 mm at most, from different places.
        assert!((patch.height - sample.height).abs() < 1e-3 && patch.velocity.distance(sample.velocity) < 1e-2);
        assert!((patch.vertical_acceleration - sample.vertical_acceleration).abs() < 0.2);
        narrow += ocean.patch(point, 0.5).gradient.length_squared();
        wide += ocean.patch(point, 5.0).gradient.length_squared();
    }
    assert!(wide < narrow, "{wide} {narrow}");
    assert_eq!(ocean.patch(Vec2::ZERO, 1e4).height, 0.0);
    // The longest cascade has 97 % of the variance, about its peak at .10 rad/m.
    let k = ocean.decay_wavenumber(1.0);
    assert!((0.1..0.25).contains(&k), "{k}");
    assert!(ocean.decay_wavenumber(0.0) > 1.01 * k);
}

#[test]
fn a_patch_is_the_plane_of_the_water_over_a_body() {
    let radius = 0.8f32;
    let mut ocean = default_sea(128.0);
    let points = points(200, 900.0);
    let spot = |i: u32| Vec2::from_angle(i as f32 * 2.399_963) * radius * ((i as f32 + 0.5) / 128.0).sqrt();
    let mut squares = [0.0f32; 5];
    for &point in &points {
        let around: Vec<Vec2> = (0..128).map(|i| point + spot(i)).collect();
        let (mut height, mut slope, mut velocity) = (0.0, Vec2::ZERO, Vec3::ZERO);
        for (place, sample) in around.iter().zip(answers(&ocean, &around)) {
            height += sample.height / 128.0;
            // The plane that fits best: the mean of r^2 along an axis of a disc is radius^2/4.
            slope += (*place - point) * sample.height / (32.0 * radius * radius);
            velocity += sample.velocity / 128.0;
        }
        let patch = ocean.patch(point, radius);
        squares[0] += (patch.height - height).powi(2);
        squares[1] += patch.gradient.distance_squared(slope);
        squares[2] += slope.length_squared();
        squares[3] += patch.velocity.distance_squared(velocity);
        squares[4] += velocity.length_squared();
    }
    let [height, slope, slopes, velocity, velocities] = squares.map(|s| (s / points.len() as f32).sqrt());
    assert!(height < 0.008 * ocean.significant_height(), "{height}");
    assert!(slope < 0.3 * slopes, "{slope} {slopes}");
    assert!(velocity < 0.12 * velocities, "{velocity} {velocities}");

    // Arrays that are there already change nothing.
    let radii = vec![radius; points.len()];
    let mut both = [(); 2].map(|()| vec![ocean_spectrum::OceanPatch::default(); points.len()]);
    ocean.set_time(129.0);
    ocean.patches(&points, &radii, &mut both[0]);
    ocean.prepare(ocean_spectrum::Outputs::ALL);
    ocean.patches(&points, &radii, &mut both[1]);
    assert_eq!(both[0], both[1]);
}

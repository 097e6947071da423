//! The FFT path against direct sums in f64.

use glam::DVec2;
use ocean_spectrum::reference::{self, Fields};
use ocean_spectrum::{CascadeDesc, CascadeModes, Ocean, OceanDesc};

fn sea() -> Ocean {
    let cascades = vec![CascadeDesc::new(128, 485.0), CascadeDesc::new(128, 72.4), CascadeDesc::new(64, 10.8)];
    Ocean::new(OceanDesc { cascades, seed: 5, choppiness: 0.8, ..Default::default() }).unwrap()
}

fn sum(ocean: &Ocean, c: usize, x: DVec2, t: f64) -> Fields {
    let desc = ocean.desc();
    reference::direct_sum(&ocean.modes()[c], desc.choppiness.into(), desc.loop_time, x, t)
}

/// Texels spread over the tile without a pattern.
fn probes(size: u32) -> impl Iterator<Item = (usize, usize)> {
    let size = size as usize;
    (0..60).map(move |i| ((i * 37 + 11) % size, (i * 53 + 5) % size))
}

/// Relative RMS error of each of the 12 fields.
fn errors(ocean: &Ocean, c: usize, t: f64) -> [f64; 12] {
    let f = ocean.fields(c);
    let (mut off, mut all) = ([0.0; 12], [0.0; 12]);
    for (i, j) in probes(f.size) {
        let h = f64::from(f.tile) / f64::from(f.size);
        let truth = sum(ocean, c, DVec2::new(i as f64 * h, j as f64 * h), t);
        let at = j * f.size as usize + i;
        let truths = truth.displacement.into_iter().chain(truth.derivative).chain(truth.velocity);
        let fields = [f.displacement[at], f.derivative[at], f.velocity[at]];
        for (n, (truth, field)) in truths.zip(fields.into_iter().flatten()).enumerate() {
            off[n] += (f64::from(field) - truth).powi(2);
            all[n] += truth * truth;
        }
    }
    std::array::from_fn(|n| (off[n] / all[n]).sqrt())
}

#[test]
fn the_reference_gives_a_known_wave() {
    // One wave of amplitude 0.5 along +x, wavelength 25 m, phase 90 degrees, 3 turns in 60 s.
    let mut amp = vec![[0.0; 4]; 256];
    let mut n = vec![0; 256];
    amp[4] = [0.0, 0.25, 0.0, 0.0];
    amp[12] = [0.0, 0.0, 0.0, -0.25];
    n[4] = 3;
    n[12] = 3;
    let modes = CascadeModes { size: 16, tile: 100.0, band: [0.0, 1.0], amp, n };
    let k = std::f64::consts::TAU / 25.0;
    let omega = std::f64::consts::TAU / 20.0;
    let (x, t) = (7.0, 4.0);
    let theta = k * x - omega * t + std::f64::consts::FRAC_PI_2;
    let f = reference::direct_sum(&modes, 0.5, 60.0, DVec2::new(x, 3.0), t);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(f.displacement[1], 0.5 * theta.cos());
    near(f.displacement[0], -0.25 * theta.sin());
    near(f.displacement[2], 0.0);
    near(f.derivative[0], -0.5 * k * theta.sin());
    near(f.velocity[1], 0.5 * omega * theta.sin());
    near(f.velocity[3], -0.5 * omega * omega * theta.cos());
}

#[test]
fn the_reference_agrees_with_its_own_differences() {
    let ocean = sea();
    let (x, t, e) = (DVec2::new(3.3, 8.1), 77.7, 1e-4);
    for c in 0..3 {
        let f = sum(&ocean, c, x, t);
        let slope = |a: Fields, b: Fields, n: usize| (b.displacement[n] - a.displacement[n]) / (2.0 * e);
        let dx = |n| slope(sum(&ocean, c, x - DVec2::X * e, t), sum(&ocean, c, x + DVec2::X * e, t), n);
        let dz = |n| slope(sum(&ocean, c, x - DVec2::Y * e, t), sum(&ocean, c, x + DVec2::Y * e, t), n);
        let dt = |n| slope(sum(&ocean, c, x, t - e), sum(&ocean, c, x, t + e), n);
        let rate = (sum(&ocean, c, x, t + e).velocity[1] - sum(&ocean, c, x, t - e).velocity[1]) / (2.0 * e);
        let pairs = [
            (f.derivative[0], dx(1)),
            (f.derivative[1], dz(1)),
            (f.derivative[2], dx(0)),
            (f.derivative[3], dz(2)),
            (f.displacement[3], dz(0)),
            (f.displacement[3], dx(2)),
            (f.velocity[0], dt(0)),
            (f.velocity[1], dt(1)),
            (f.velocity[2], dt(2)),
            (f.velocity[3], rate),
        ];
        for (n, (a, b)) in pairs.into_iter().enumerate() {
            assert!((a - b).abs() < 2e-5, "cascade {c}, field {n}: {a} {b}");
        }
    }
}

#[test]
fn arrays_match_the_direct_sum() {
    let mut ocean = sea();
    for t in [0.0, 123.456, -50.25, 1e7 + 0.3] {
        ocean.set_time(t);
        let turns = (ocean.time() - t) / ocean.desc().loop_time;
        assert!((turns - turns.round()).abs() < 2e-10);
        for c in 0..3 {
            let errors = errors(&ocean, c, ocean.time());
            assert!(errors.iter().all(|&e| e < 1e-6), "t = {t}, cascade {c}: {errors:?}");
        }
    }
}

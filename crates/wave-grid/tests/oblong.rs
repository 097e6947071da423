//! Cells twice as long along x as along z.

mod plane_wave;

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, GridDesc, GridSample, Medium, MediumCell, Scheme, Source, WaveGrid};

use plane_wave::turn;

const CELL: [f32; 2] = [1.0, 0.5];
const N: usize = 384;

/// c such that the grid is near its bound.
fn desc(scheme: Scheme) -> GridDesc {
    // 9-point: max(az, 2/3 (ax + az)) = 0.93, 5-point: ax + az = 0.97.
    let az = if scheme == Scheme::NinePoint { 0.93f64 } else { 0.97 / 1.25 };
    let wave_speed = (az.sqrt() * f64::from(CELL[1]) * 60.0) as f32;
    GridDesc { cells: [N as u32; 2], cell_size: CELL, scheme, wave_speed, substeps: Some(1), ..Default::default() }
}

/// Radians per step of a plane wave by the scheme's dispersion relation 4 sin^2(W/2) = ax X + az Z - (ax + az) X Z / 12,
/// X = 4 sin^2(kx/2); without the last term for the 5-point scheme.
fn closed_form(scheme: Scheme, [ax, az]: [f64; 2], k: [f64; 2]) -> f64 {
    let [x, z] = k.map(|k| 4.0 * (k / 2.0).sin().powi(2));
    let cross = if scheme == Scheme::NinePoint { (ax + az) * x * z / 12.0 } else { 0.0 };
    2.0 * ((ax * x + az * z - cross) / 4.0).sqrt().asin()
}

/// Deep water that does not say so.
struct Open;

impl Medium for Open {
    fn at(&self, _: DVec2, deep_speed: f32) -> MediumCell {
        MediumCell { speed: deep_speed, damping: 0.0, kind: CellKind::Open, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

#[test]
fn waves_travel_at_c_in_all_directions() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        // (m, l) periods in 64 cells: along x, along z, at 45 degrees.
        for (m, bound, felt) in [
            ([4.0, 0.0], 0.008, false),
            ([0.0, 8.0], 0.008, false),
            ([4.0, 2.0], 0.006, false),
            ([4.0, 2.0], 0.006, true),
        ] {
            let k = [0, 1].map(|axis| 2.0 * PI * m[axis] / 64.0);
            let mut grid = WaveGrid::new(desc(scheme)).unwrap();
            grid.set_medium(felt.then(|| Arc::new(Open) as Arc<dyn Medium>));
            let expected = closed_form(scheme, grid.stepping().a, k);
            let turn = turn(&mut grid, k, expected, 120);
            assert!((turn / expected - 1.0).abs() < 2e-6, "{scheme:?} {m:?}: {turn}, the scheme's {expected}");
            let wavenumber = (k[0] / f64::from(CELL[0])).hypot(k[1] / f64::from(CELL[1]));
            let exact = f64::from(grid.desc().wave_speed) * wavenumber * grid.stepping().dt;
            assert!((turn / exact - 1.0).abs() < bound, "{scheme:?} {m:?}: {turn}, exact {exact}");
        }
    }
}

/// A medium that differs from cell to cell: speeds from nearly none to all, pillars and held water.
struct Rough;

impl Medium for Rough {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let cell = (place / Vec2::from(CELL).as_dvec2()).floor();
        let word = (cell.x as i64 as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (cell.y as i64 as u64);
        let word = (word ^ (word >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let kind = match word >> 60 {
            0 => CellKind::Wall,
            1 => CellKind::Fixed,
            _ => CellKind::Open,
        };
        let speed = if (word >> 52) & 3 == 0 { 0.05 } else { 1.0 };
        MediumCell { speed: deep_speed * speed, damping: 0.0, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

#[test]
fn a_random_medium_stays_bounded() {
    for scheme in [Scheme::NinePoint, Scheme::FivePoint] {
        let mut grid = WaveGrid::new(GridDesc { cells: [96; 2], ..desc(scheme) }).unwrap();
        grid.set_medium(Some(Arc::new(Rough)));
        let rough: Vec<f32> =
            (0..96 * 96u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 8) as f32 / 1e8 - 0.08).collect();
        grid.impose(&rough, &rough).unwrap();
        let energy = grid.energy();
        assert!(energy > 0.0);
        let mut peak = 0.0f64;
        for _ in 0..6000 {
            grid.tick();
        }
        for _ in 0..10 {
            grid.tick();
            peak = peak.max(grid.energy());
        }
        assert!(grid.is_finite() && peak <= energy, "{scheme:?}: {peak} of {energy}");
    }
}

#[test]
fn what_leaves_through_any_side_does_not_come_back() {
    let mut grid = WaveGrid::new(GridDesc { cells: [96, 192], ..desc(Scheme::NinePoint) }).unwrap();
    grid.set_tile_skipping(false);
    for t in 0..60 {
        // Smooth in time, and no net volume, which would leave slowly.
        let volume = (-((f64::from(t) - 30.0) / 8.0).powi(2)).exp() * (f64::from(t) - 30.0) / 8.0;
        assert!(grid.add(Source::Displacement { center: Vec2::ZERO, radius: 3.0, volume: volume as f32 }));
        grid.tick();
    }
    let energy = grid.energy();
    for _ in 0..400 {
        grid.tick();
    }
    let left = 10.0 * (grid.energy() / energy).log10();
    assert!(left < -80.0, "{left} dB of the energy left");
}

#[test]
fn a_source_is_round_in_metres() {
    let mut grid = WaveGrid::new(desc(Scheme::NinePoint)).unwrap();
    assert!(grid.add(Source::Displacement { center: Vec2::ZERO, radius: 6.0, volume: 3.0 }));
    assert!((grid.volume() - 3.0).abs() < 1e-4);
    let mut out = [GridSample::default(); 2];
    grid.sample(&[Vec2::new(4.0, 0.0), Vec2::new(0.0, 4.0)], &mut out);
    // What is added for the fall is 1.5 cells, more metres along x.
    assert!((out[0].height / out[1].height - 1.0).abs() < 0.3, "{out:?}");
}

//! Wave makers and wave trains against the heights they are told.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use wave_grid::{CellKind, Edges, GridDesc, GridError, Medium, MediumCell, Scheme, WaveGrid, WaveMaker, WaveTrain};

/// A channel along x, 24 cells wide.
struct Channel;

impl Medium for Channel {
    fn at(&self, place: DVec2, deep_speed: f32) -> MediumCell {
        let kind = if place.y.abs() > 6.0 { CellKind::Wall } else { CellKind::Open };
        MediumCell { speed: deep_speed, kind, ..MediumCell::default() }
    }

    fn is_plain(&self, _: DVec2, _: DVec2, _: f32) -> bool {
        false
    }
}

#[test]
fn paddles_make_waves_of_their_height_on_both_sides() {
    for (wave_speed, cells_per_wave) in
        [(20.0, 8.0), (20.0, 12.0), (20.0, 24.0), (70.0, 12.0), (6.0, 12.0), (6.0, 20.0)]
    {
        let desc = GridDesc { cells: [512, 64], wave_speed, ..GridDesc::default() };
        let mut grid = WaveGrid::new(desc).unwrap();
        grid.set_medium(Some(Arc::new(Channel)));
        let period = (cells_per_wave * 0.5 / f64::from(wave_speed)) as f32;
        let maker = WaveMaker { from: Vec2::new(2.1, -6.0), to: Vec2::new(2.1, 6.0), height: 0.3, period };
        let mut squares = [[0.0f64; 2]; 2];
        let ticks = (110.0 / wave_speed * 60.0) as u32;
        for tick in 0..ticks {
            let time = f64::from(tick) / 60.0;
            assert!(grid.add(maker.source(&desc, wave_speed, time).unwrap()));
            grid.tick();
            if time > 60.0 / f64::from(wave_speed) + 3.0 * f64::from(period) {
                for (side, sum) in [156..206usize, 310..360].into_iter().zip(&mut squares) {
                    for z in &grid.heights()[32 * 512..33 * 512][side] {
                        *sum = [sum[0] + f64::from(*z).powi(2), sum[1] + 1.0];
                    }
                }
            }
        }
        let amplitudes = squares.map(|[sum, count]| (2.0 * sum / count).sqrt());
        println!("{cells_per_wave} cells per wave at {wave_speed} m/s: {amplitudes:?}");
        for amplitude in amplitudes {
            assert!((amplitude / 0.15 - 1.0).abs() < 0.02, "{cells_per_wave} cells, {wave_speed} m/s: {amplitude}");
        }
    }
}

#[test]
fn a_long_paddle_askew_makes_waves_of_its_height_too() {
    let desc = GridDesc { cells: [384; 2], wave_speed: 20.0, ..GridDesc::default() };
    let mut grid = WaveGrid::new(desc).unwrap();
    let along = Vec2::from_angle(0.6);
    // 9 m long waves; 130 m of line.
    let maker = WaveMaker { from: -65.0 * along, to: 65.0 * along, height: 0.2, period: 0.45 };
    let mut sums = [0.0f64; 2];
    let places: Vec<Vec2> = (0..20).map(|i| (4.5 + 0.45 * i as f32) * along.perp()).collect();
    let mut samples = vec![wave_grid::GridSample::default(); places.len()];
    for tick in 0..200 {
        let time = f64::from(tick) / 60.0;
        assert!(grid.add(maker.source(&desc, 20.0, time).unwrap()));
        grid.tick();
        // Before the ends of the line are heard.
        if (81..=161).contains(&tick) {
            grid.sample(&places, &mut samples);
            for sample in &samples {
                sums[0] += f64::from(sample.height).powi(2);
                sums[1] += 1.0;
            }
        }
    }
    let amplitude = (2.0 * sums[0] / sums[1]).sqrt();
    println!("amplitude {amplitude}");
    assert!((amplitude / 0.1 - 1.0).abs() < 0.03, "{amplitude}");
}

#[test]
fn trains_enter_without_a_trace_outside() {
    let all = Edges { low_x: true, high_x: true, low_z: true, high_z: true };
    for (scheme, heading, cells_per_wave, wave_speed) in [
        (Scheme::NinePoint, 0.4f32, 12.0f32, 20.0),
        (Scheme::FivePoint, -2.2, 20.0, 33.0),
        (Scheme::NinePoint, 1.2, 30.0, 60.0),
    ] {
        let desc = GridDesc { cells: [128; 2], wave_speed, scheme, ..GridDesc::default() };
        let mut grid = WaveGrid::new(desc).unwrap();
        grid.set_feed(all);
        let train = WaveTrain { height: 2.0, period: cells_per_wave * 0.5 / wave_speed, heading };
        let seconds = f64::from(train.period) * 9.0 + 5.0 * 64.0 / f64::from(wave_speed);
        let (mut inside, mut outside, mut growing) = (0.0f32, 0.0f32, 0.0f32);
        let ticks = (seconds * 60.0) as u32;
        for tick in 0..ticks {
            grid.tick_trains(&[train], f64::from(tick) / 60.0).unwrap();
            for (at, z) in grid.heights().iter().enumerate() {
                let (i, j) = (at % 128, at / 128);
                let within = (15..113).contains(&i) && (15..113).contains(&j);
                let most = if within { &mut inside } else { &mut outside };
                if tick + 60 > ticks {
                    *most = most.max(z.abs());
                } else if !within {
                    growing = growing.max(z.abs());
                }
            }
        }
        let decibels = 20.0 * (outside / inside).log10();
        println!(
            "{scheme:?} {heading} {cells_per_wave}: crest {inside}, outside {decibels} dB; while it grows {growing}"
        );
        assert!((inside - 1.0).abs() < 0.005, "{inside}");
        assert!(decibels < -100.0 && growing < 5e-3, "{decibels} dB");
    }
}

#[test]
fn bad_descriptions_are_named() {
    let desc = GridDesc::default();
    let maker = WaveMaker { from: Vec2::ZERO, to: Vec2::new(5.0, 0.0), height: 0.1, period: 2.0 };
    let train = WaveTrain { height: 0.1, period: 2.0, heading: 0.0 };
    assert!(maker.source(&desc, 6.0, 0.0).is_ok() && train.wavenumber(&desc, 6.0).is_ok());
    let field = |error: Option<GridError>| match error {
        Some(GridError::InvalidValue { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    // Three metres a wave are six cells.
    for period in [0.0, -1.0, 0.49, f32::NAN, f32::INFINITY] {
        let maker = WaveMaker { period, ..maker };
        let train = WaveTrain { period, ..train };
        assert_eq!(field(train.wavenumber(&desc, 6.0).err()), "period", "{period}");
        if period != f32::INFINITY {
            assert_eq!(field(maker.source(&desc, 6.0, 0.0).err()), "period", "{period}");
        }
    }
    assert_eq!(field(WaveMaker { height: f32::NAN, ..maker }.source(&desc, 6.0, 0.0).err()), "height");
    assert_eq!(field(WaveMaker { to: Vec2::ZERO, ..maker }.source(&desc, 6.0, 0.0).err()), "to");
    assert_eq!(field(WaveTrain { heading: f32::NAN, ..train }.wavenumber(&desc, 6.0).err()), "heading");
    let mut grid = WaveGrid::new(desc).unwrap();
    assert!(grid.tick_trains(&[WaveTrain { height: f32::NAN, ..train }], 0.0).is_err());
}
